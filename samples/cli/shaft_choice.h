// Which light shafts a picture has: the scene's or the option's choice, and what the device can do.
#pragma once

#include <alpenglow/io/scene_file.h>
#include <alpenglow/view.h>

#include <optional>

#include "arguments.h"
#include "session.h"

namespace alpenglow::cli {

struct ShaftChoice {
  io::SceneShafts method = io::SceneShafts::Off;  ///< Auto: Exact where the device can.
  uint32_t samples = 0;
  std::string whyOff;              ///< A sentence, where Auto became Off.
  CapabilityFlags needs() const;   ///< What the device must have.
  CapabilityFlags wishes() const;  ///< What it would be nice to have.
};

/// Checked before there is a device. Throws a Failure for what contradicts itself.
ShaftChoice chooseShafts(const RenderArguments& arguments, const io::Scene& scene, Solver solver);

/// What to make. Says on stderr why there are none where they were left to us.
LightShaftDesc describeShafts(const ShaftChoice& choice, const Session& session);

}  // namespace alpenglow::cli
