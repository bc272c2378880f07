// Which compiled text reads which tables: the only place that knows the shaders' names.
#pragma once

#include <alpenglow/tables.h>

#include "engine/pipeline.h"

namespace alpenglow::sky {

/// What a sky shader is compiled for.
struct SkyText {
  bool map = false;     ///< An albedo map of the ground.
  bool slice = false;   ///< Reads a sky slice.
  bool shafts = false;  ///< Light shafts; of Solver::Moments.
};
engine::Shader skyShader(Solver solver, EffectFlags without, const SkyText& text);
/// Aerial perspective; `volume`: reads an air volume.
engine::Shader airShader(Solver solver, EffectFlags without, bool volume, bool shafts);
/// Fills a sky slice of texels of this format.
engine::Shader sliceShader(Solver solver, EffectFlags without, TableFormat format);
/// Fills an air volume; of Solver::Moments, as the next.
engine::Shader volumeShader(EffectFlags without, TableFormat format);
/// The surface between light and shadow; `volume`: reads an air volume.
engine::Shader surfaceShader(EffectFlags without, bool volume);
engine::Shader probeShader(Solver solver, EffectFlags without);

}  // namespace alpenglow::sky
