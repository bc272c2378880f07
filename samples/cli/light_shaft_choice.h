// Which light shafts a picture has: the scene's or the option's choice, and what the device can do.
#pragma once

#include <alpenglow/io/scene_file.h>
#include <alpenglow/view.h>

#include <optional>

#include "arguments.h"
#include "session.h"

namespace alpenglow::cli {

struct LightShaftChoice {
  io::SceneLightShafts method = io::SceneLightShafts::Off;  ///< Auto: LightVolume if possible.
  uint32_t stepCount = 0;
  std::string whyOff;                    ///< A sentence, where Auto became Off.
  CapabilityFlags requirements() const;  ///< What the device must have.
  CapabilityFlags wishes() const;        ///< What it should have, if it can.
};

/// Checked before there is a device. Throws a Failure for what contradicts itself.
LightShaftChoice chooseLightShafts(const RenderArguments& arguments, const io::Scene& scene,
                                   Solver solver);

/// The final choice. Reports on stderr why Auto became Off.
LightShaftDesc describeLightShafts(const LightShaftChoice& choice, const Session& session);

}  // namespace alpenglow::cli
