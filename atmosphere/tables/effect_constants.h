// The effects that a shader is compiled for, as its specialization constants:
// shaders/glsl/common/effect_constants.glsl.
#pragma once

#include <alpenglow/effects.h>

#include <array>

#include "engine/pipeline.h"

namespace alpenglow::tables {

inline constexpr uint32_t kEffectConstants = 6;

/// All constants; Vulkan ignores those that a shader doesn't declare.
inline std::array<engine::SpecConstant, kEffectConstants> effectConstants(
    EffectFlags disabledEffects) {
  constexpr Effect kEffects[kEffectConstants] = {Effect::Rayleigh,         Effect::Mie,
                                                 Effect::Absorption,       Effect::GroundReflection,
                                                 Effect::GroundIrradiance, Effect::SpaceViews};
  constexpr uint32_t kFirst = 20;
  std::array<engine::SpecConstant, kEffectConstants> constants;
  for (uint32_t i = 0; i < kEffectConstants; ++i)
    constants[i] = engine::specBool(kFirst + i, (disabledEffects & effectBit(kEffects[i])) == 0);
  return constants;
}

}  // namespace alpenglow::tables
