// Effects that can be simulated or left out. A plan (alpenglow/plan.h) chooses them for a scene; a
// host may choose them itself.
#pragma once

#include <alpenglow/export.h>

#include <cstdint>

namespace alpenglow {
inline namespace v1_0 {

enum class Effect : uint32_t {
  Rayleigh,            ///< Air molecules.
  Mie,                 ///< Aerosols.
  Absorption,          ///< The layer that only absorbs (ozone).
  MultipleScattering,  ///< Paths of two or more events.
  GroundReflection,    ///< Light that the ground sends back into the atmosphere.
  GroundIrradiance,    ///< Sky light on surfaces; without it they are lit by the sun alone.
  Ground,              ///< The planet's surface, drawn.
  SunDisc,             ///< The sun's disc, drawn.
  AerialPerspective,   ///< The atmosphere in front of a host's scene.
  LightShafts,         ///< Shadows of casters in the atmosphere.
  SpaceViews,  ///< Cameras above the top of the atmosphere, and pixels that miss the atmosphere.
  Twilight,    ///< The sun from the horizon down to 18 degrees below it.
  Night,       ///< The sun lower than that.
};
inline constexpr uint32_t kEffectCount = 13;

/// Bits of effects.
using EffectFlags = uint32_t;
constexpr EffectFlags effectBit(Effect effect) { return 1u << static_cast<uint32_t>(effect); }

/// Effects that tables hold: the bits of TableDesc::disabledEffects.
inline constexpr EffectFlags kTableEffects =
    effectBit(Effect::Rayleigh) | effectBit(Effect::Mie) | effectBit(Effect::Absorption) |
    effectBit(Effect::MultipleScattering) | effectBit(Effect::GroundReflection) |
    effectBit(Effect::GroundIrradiance);
/// Effects that only views draw: the bits of ViewDesc::disabledEffects.
inline constexpr EffectFlags kViewEffects =
    effectBit(Effect::Ground) | effectBit(Effect::SunDisc) | effectBit(Effect::SpaceViews);

constexpr bool hasEffect(EffectFlags disabledEffects, Effect effect) {
  return (disabledEffects & effectBit(effect)) == 0;
}

/// As files spell it: "ground_irradiance". Never null; "" past the end.
ALPENGLOW_API const char* effectName(Effect effect);

}  // namespace v1_0
}  // namespace alpenglow
