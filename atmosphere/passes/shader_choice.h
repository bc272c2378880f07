// The compiled shader for each kind of tables: the only place with the shaders' names.
#pragma once

#include <alpenglow/tables.h>

#include "engine/pipeline.h"

namespace alpenglow::passes {

/// What a sky shader is compiled for.
struct SkyVariant {
  bool map = false;     ///< An albedo map of the ground.
  bool lut = false;     ///< Reads a sky-view LUT.
  bool shafts = false;  ///< Light shafts; of Solver::Moments.
};
engine::Shader skyShader(Solver solver, EffectFlags disabledEffects, const SkyVariant& wanted);
/// Aerial perspective; `volume`: reads an aerial-perspective LUT.
engine::Shader aerialPerspectiveShader(Solver solver, EffectFlags disabledEffects, bool lut,
                                       bool shafts);
/// Fills a sky-view LUT of texels of this format.
engine::Shader skyViewLutShader(Solver solver, EffectFlags disabledEffects, TableFormat format);
/// Fills an aerial-perspective LUT; of Solver::Moments, as the next.
engine::Shader aerialPerspectiveLutShader(EffectFlags disabledEffects, TableFormat format);
/// The light-volume mesh; `volume`: reads an aerial-perspective LUT.
engine::Shader lightVolumeMeshShader(EffectFlags disabledEffects, bool lut);
engine::Shader probeShader(Solver solver, EffectFlags disabledEffects);

}  // namespace alpenglow::passes
