#include "atmosphere/sky/shader_choice.h"

#include <alpenglow/shaders/air_fragment.h>
#include <alpenglow/shaders/air_fragment_hillaire.h>
#include <alpenglow/shaders/air_fragment_hoffman_preetham.h>
#include <alpenglow/shaders/air_fragment_oneil.h>
#include <alpenglow/shaders/air_fragment_schafhitzel.h>
#include <alpenglow/shaders/air_fragment_shafts.h>
#include <alpenglow/shaders/air_fragment_standard.h>
#include <alpenglow/shaders/air_fragment_volume.h>
#include <alpenglow/shaders/air_fragment_volume_shafts.h>
#include <alpenglow/shaders/air_volume_rgba16f.h>
#include <alpenglow/shaders/air_volume_rgba32f.h>
#include <alpenglow/shaders/probe.h>
#include <alpenglow/shaders/probe_hillaire.h>
#include <alpenglow/shaders/probe_hoffman_preetham.h>
#include <alpenglow/shaders/probe_oneil.h>
#include <alpenglow/shaders/probe_schafhitzel.h>
#include <alpenglow/shaders/probe_standard.h>
#include <alpenglow/shaders/sky_fragment.h>
#include <alpenglow/shaders/sky_fragment_hillaire.h>
#include <alpenglow/shaders/sky_fragment_hoffman_preetham.h>
#include <alpenglow/shaders/sky_fragment_map.h>
#include <alpenglow/shaders/sky_fragment_map_hillaire.h>
#include <alpenglow/shaders/sky_fragment_map_hoffman_preetham.h>
#include <alpenglow/shaders/sky_fragment_map_oneil.h>
#include <alpenglow/shaders/sky_fragment_map_schafhitzel.h>
#include <alpenglow/shaders/sky_fragment_map_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_slice.h>
#include <alpenglow/shaders/sky_fragment_map_slice_hillaire.h>
#include <alpenglow/shaders/sky_fragment_map_slice_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_slice_standard.h>
#include <alpenglow/shaders/sky_fragment_map_standard.h>
#include <alpenglow/shaders/sky_fragment_oneil.h>
#include <alpenglow/shaders/sky_fragment_schafhitzel.h>
#include <alpenglow/shaders/sky_fragment_shafts.h>
#include <alpenglow/shaders/sky_fragment_slice.h>
#include <alpenglow/shaders/sky_fragment_slice_hillaire.h>
#include <alpenglow/shaders/sky_fragment_slice_shafts.h>
#include <alpenglow/shaders/sky_fragment_slice_standard.h>
#include <alpenglow/shaders/sky_fragment_standard.h>
#include <alpenglow/shaders/sky_slice_hillaire_rgba16f.h>
#include <alpenglow/shaders/sky_slice_hillaire_rgba32f.h>
#include <alpenglow/shaders/sky_slice_rgba16f.h>
#include <alpenglow/shaders/sky_slice_rgba32f.h>
#include <alpenglow/shaders/sky_slice_standard_rgba16f.h>
#include <alpenglow/shaders/sky_slice_standard_rgba32f.h>

#include "atmosphere/model/solvers.h"

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

/// What a simpler model has compiled; without shafts, and without slice unless it is Hillaire's.
struct ModelText {
  engine::Shader sky, skyMap, air, probe;
};
#define ALPENGLOW_MODEL(name)                                                      \
  ModelText {                                                                      \
    ALPENGLOW_SHADER(kSkyFragment##name), ALPENGLOW_SHADER(kSkyFragmentMap##name), \
        ALPENGLOW_SHADER(kAirFragment##name), ALPENGLOW_SHADER(kProbe##name)       \
  }

const ModelText& modelText(Solver solver) {
  static const ModelText texts[] = {ALPENGLOW_MODEL(HoffmanPreetham), ALPENGLOW_MODEL(Oneil),
                                    ALPENGLOW_MODEL(Schafhitzel), ALPENGLOW_MODEL(Hillaire)};
  return texts[static_cast<uint32_t>(solver) - static_cast<uint32_t>(Solver::HoffmanPreetham)];
}

engine::Shader modelSkyShader(Solver solver, const SkyText& text) {
  if (text.slice) {
    return text.map ? ALPENGLOW_SHADER(kSkyFragmentMapSliceHillaire)
                    : ALPENGLOW_SHADER(kSkyFragmentSliceHillaire);
  }
  return text.map ? modelText(solver).skyMap : modelText(solver).sky;
}

}  // namespace

engine::Shader skyShader(Solver solver, EffectFlags, const SkyText& text) {
  if (isModel(solver)) return modelSkyShader(solver, text);
  return solver == Solver::Moments ? momentsSkyShader(text) : standardSkyShader(text);
}

engine::Shader airShader(Solver solver, EffectFlags, bool volume, bool shafts) {
  if (isModel(solver)) return modelText(solver).air;
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
  if (solver == Solver::Hillaire) {
    return wide ? ALPENGLOW_SHADER(kSkySliceHillaireFloat)
                : ALPENGLOW_SHADER(kSkySliceHillaireHalf);
  }
  return wide ? ALPENGLOW_SHADER(kSkySliceStandardFloat) : ALPENGLOW_SHADER(kSkySliceStandardHalf);
}

engine::Shader volumeShader(Solver, EffectFlags, TableFormat format) {
  return format == TableFormat::Float ? ALPENGLOW_SHADER(kAirVolumeFloat)
                                      : ALPENGLOW_SHADER(kAirVolumeHalf);
}

engine::Shader probeShader(Solver solver, EffectFlags) {
  if (isModel(solver)) return modelText(solver).probe;
  return solver == Solver::Moments ? ALPENGLOW_SHADER(kProbe) : ALPENGLOW_SHADER(kProbeStandard);
}

#undef ALPENGLOW_MODEL
#undef ALPENGLOW_SHADER

}  // namespace alpenglow::sky
