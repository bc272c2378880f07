#include <alpenglow/effects.h>

namespace alpenglow {
inline namespace v1_0 {

const char* effectName(Effect effect) {
  constexpr const char* kNames[kEffectCount] = {
      "rayleigh",          "mie",      "absorption", "multiple_scattering", "ground_reflection",
      "ground_irradiance", "ground",   "sun_disc",   "aerial_perspective",  "light_shafts",
      "space_views",       "twilight", "night"};
  const auto index = static_cast<uint32_t>(effect);
  return index < kEffectCount ? kNames[index] : "";
}

}  // namespace v1_0
}  // namespace alpenglow
