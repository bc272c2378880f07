#include "atmosphere/sky/shader_choice.h"

#include <alpenglow/shaders/air_fragment.h>
#include <alpenglow/shaders/air_fragment_shafts.h>
#include <alpenglow/shaders/air_fragment_standard.h>
#include <alpenglow/shaders/air_fragment_volume.h>
#include <alpenglow/shaders/air_fragment_volume_shafts.h>
#include <alpenglow/shaders/air_volume_rgba16f.h>
#include <alpenglow/shaders/air_volume_rgba32f.h>
#include <alpenglow/shaders/probe.h>
#include <alpenglow/shaders/probe_standard.h>
#include <alpenglow/shaders/sky_fragment.h>
#include <alpenglow/shaders/sky_fragment_map.h>
#include <alpenglow/shaders/sky_fragment_map_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_slice.h>
#include <alpenglow/shaders/sky_fragment_map_slice_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_slice_standard.h>
#include <alpenglow/shaders/sky_fragment_map_standard.h>
#include <alpenglow/shaders/sky_fragment_shafts.h>
#include <alpenglow/shaders/sky_fragment_slice.h>
#include <alpenglow/shaders/sky_fragment_slice_shafts.h>
#include <alpenglow/shaders/sky_fragment_slice_standard.h>
#include <alpenglow/shaders/sky_fragment_standard.h>
#include <alpenglow/shaders/sky_slice_rgba16f.h>
#include <alpenglow/shaders/sky_slice_rgba32f.h>
#include <alpenglow/shaders/sky_slice_standard_rgba16f.h>
#include <alpenglow/shaders/sky_slice_standard_rgba32f.h>

namespace alpenglow::sky {
namespace {

#define ALPENGLOW_SHADER(name) \
  engine::Shader { shaders::name, sizeof shaders::name, #name }

engine::Shader momentsSkyShader(const SkyText& text) {
  const engine::Shader shaders[2][2][2] = {
      {{ALPENGLOW_SHADER(kSkyFragment), ALPENGLOW_SHADER(kSkyFragmentShafts)},
       {ALPENGLOW_SHADER(kSkyFragmentSlice), ALPENGLOW_SHADER(kSkyFragmentSliceShafts)}},
      {{ALPENGLOW_SHADER(kSkyFragmentMap), ALPENGLOW_SHADER(kSkyFragmentMapShafts)},
       {ALPENGLOW_SHADER(kSkyFragmentMapSlice), ALPENGLOW_SHADER(kSkyFragmentMapSliceShafts)}}};
  return shaders[text.map][text.slice][text.shafts];
}

engine::Shader standardSkyShader(const SkyText& text) {
  const engine::Shader shaders[2][2] = {
      {ALPENGLOW_SHADER(kSkyFragmentStandard), ALPENGLOW_SHADER(kSkyFragmentSliceStandard)},
      {ALPENGLOW_SHADER(kSkyFragmentMapStandard), ALPENGLOW_SHADER(kSkyFragmentMapSliceStandard)}};
  return shaders[text.map][text.slice];
}

}  // namespace

engine::Shader skyShader(Solver solver, EffectFlags, const SkyText& text) {
  return solver == Solver::Moments ? momentsSkyShader(text) : standardSkyShader(text);
}

engine::Shader airShader(Solver solver, EffectFlags, bool volume, bool shafts) {
  if (solver != Solver::Moments) return ALPENGLOW_SHADER(kAirFragmentStandard);
  if (volume) {
    return shafts ? ALPENGLOW_SHADER(kAirFragmentVolumeShafts)
                  : ALPENGLOW_SHADER(kAirFragmentVolume);
  }
  return shafts ? ALPENGLOW_SHADER(kAirFragmentShafts) : ALPENGLOW_SHADER(kAirFragment);
}

engine::Shader sliceShader(Solver solver, EffectFlags, TableFormat format) {
  const bool wide = format == TableFormat::Float;
  if (solver == Solver::Moments)
    return wide ? ALPENGLOW_SHADER(kSkySliceFloat) : ALPENGLOW_SHADER(kSkySliceHalf);
  return wide ? ALPENGLOW_SHADER(kSkySliceStandardFloat) : ALPENGLOW_SHADER(kSkySliceStandardHalf);
}

engine::Shader volumeShader(Solver, EffectFlags, TableFormat format) {
  return format == TableFormat::Float ? ALPENGLOW_SHADER(kAirVolumeFloat)
                                      : ALPENGLOW_SHADER(kAirVolumeHalf);
}

engine::Shader probeShader(Solver solver, EffectFlags) {
  return solver == Solver::Moments ? ALPENGLOW_SHADER(kProbe) : ALPENGLOW_SHADER(kProbeStandard);
}

#undef ALPENGLOW_SHADER

}  // namespace alpenglow::sky
