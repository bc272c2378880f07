#include "atmosphere/sky/shader_choice.h"

#include <alpenglow/shaders/air_fragment.h>
#include <alpenglow/shaders/air_fragment_hillaire.h>
#include <alpenglow/shaders/air_fragment_hoffman_preetham.h>
#include <alpenglow/shaders/air_fragment_molecules.h>
#include <alpenglow/shaders/air_fragment_oneil.h>
#include <alpenglow/shaders/air_fragment_schafhitzel.h>
#include <alpenglow/shaders/air_fragment_shafts.h>
#include <alpenglow/shaders/air_fragment_shafts_molecules.h>
#include <alpenglow/shaders/air_fragment_shafts_single.h>
#include <alpenglow/shaders/air_fragment_single.h>
#include <alpenglow/shaders/air_fragment_standard.h>
#include <alpenglow/shaders/air_fragment_volume.h>
#include <alpenglow/shaders/air_fragment_volume_molecules.h>
#include <alpenglow/shaders/air_fragment_volume_shafts.h>
#include <alpenglow/shaders/air_fragment_volume_shafts_molecules.h>
#include <alpenglow/shaders/air_fragment_volume_shafts_single.h>
#include <alpenglow/shaders/air_fragment_volume_single.h>
#include <alpenglow/shaders/air_volume_float.h>
#include <alpenglow/shaders/air_volume_float_molecules.h>
#include <alpenglow/shaders/air_volume_float_single.h>
#include <alpenglow/shaders/air_volume_half.h>
#include <alpenglow/shaders/air_volume_half_molecules.h>
#include <alpenglow/shaders/air_volume_half_single.h>
#include <alpenglow/shaders/probe.h>
#include <alpenglow/shaders/probe_hillaire.h>
#include <alpenglow/shaders/probe_hoffman_preetham.h>
#include <alpenglow/shaders/probe_molecules.h>
#include <alpenglow/shaders/probe_oneil.h>
#include <alpenglow/shaders/probe_schafhitzel.h>
#include <alpenglow/shaders/probe_single.h>
#include <alpenglow/shaders/probe_standard.h>
#include <alpenglow/shaders/shaft_surface_fragment.h>
#include <alpenglow/shaders/shaft_surface_fragment_molecules.h>
#include <alpenglow/shaders/shaft_surface_fragment_single.h>
#include <alpenglow/shaders/shaft_surface_fragment_volume.h>
#include <alpenglow/shaders/shaft_surface_fragment_volume_molecules.h>
#include <alpenglow/shaders/shaft_surface_fragment_volume_single.h>
#include <alpenglow/shaders/sky_fragment.h>
#include <alpenglow/shaders/sky_fragment_hillaire.h>
#include <alpenglow/shaders/sky_fragment_hoffman_preetham.h>
#include <alpenglow/shaders/sky_fragment_map.h>
#include <alpenglow/shaders/sky_fragment_map_hillaire.h>
#include <alpenglow/shaders/sky_fragment_map_hoffman_preetham.h>
#include <alpenglow/shaders/sky_fragment_map_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_oneil.h>
#include <alpenglow/shaders/sky_fragment_map_schafhitzel.h>
#include <alpenglow/shaders/sky_fragment_map_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_map_single.h>
#include <alpenglow/shaders/sky_fragment_map_slice.h>
#include <alpenglow/shaders/sky_fragment_map_slice_hillaire.h>
#include <alpenglow/shaders/sky_fragment_map_slice_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_slice_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_slice_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_slice_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_map_slice_single.h>
#include <alpenglow/shaders/sky_fragment_map_slice_standard.h>
#include <alpenglow/shaders/sky_fragment_map_standard.h>
#include <alpenglow/shaders/sky_fragment_molecules.h>
#include <alpenglow/shaders/sky_fragment_oneil.h>
#include <alpenglow/shaders/sky_fragment_schafhitzel.h>
#include <alpenglow/shaders/sky_fragment_shafts.h>
#include <alpenglow/shaders/sky_fragment_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_single.h>
#include <alpenglow/shaders/sky_fragment_slice.h>
#include <alpenglow/shaders/sky_fragment_slice_hillaire.h>
#include <alpenglow/shaders/sky_fragment_slice_molecules.h>
#include <alpenglow/shaders/sky_fragment_slice_shafts.h>
#include <alpenglow/shaders/sky_fragment_slice_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_slice_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_slice_single.h>
#include <alpenglow/shaders/sky_fragment_slice_standard.h>
#include <alpenglow/shaders/sky_fragment_standard.h>
#include <alpenglow/shaders/sky_slice_float.h>
#include <alpenglow/shaders/sky_slice_float_molecules.h>
#include <alpenglow/shaders/sky_slice_float_single.h>
#include <alpenglow/shaders/sky_slice_float_standard.h>
#include <alpenglow/shaders/sky_slice_half.h>
#include <alpenglow/shaders/sky_slice_half_molecules.h>
#include <alpenglow/shaders/sky_slice_half_single.h>
#include <alpenglow/shaders/sky_slice_half_standard.h>
#include <alpenglow/shaders/sky_slice_hillaire_rgba16f.h>
#include <alpenglow/shaders/sky_slice_hillaire_rgba32f.h>

#include "atmosphere/model/solvers.h"

namespace alpenglow::sky {
namespace {

/// What tables hold, by which every text that reads them comes.
enum Kind : uint32_t { kFull, kMolecules, kSingle, kStandard };

Kind kindOf(Solver solver, EffectFlags without) {
  if (solver != Solver::Moments) return kStandard;
  if (!hasEffect(without, Effect::MultipleScattering)) return kSingle;
  return hasEffect(without, Effect::Mie) ? kFull : kMolecules;
}

#define ALPENGLOW_SHADER(name) \
  engine::Shader { shaders::name, sizeof shaders::name, #name }
/// Of the moment solver, by kind.
#define ALPENGLOW_MOMENT_SHADERS(name) \
  ALPENGLOW_SHADER(name), ALPENGLOW_SHADER(name##Molecules), ALPENGLOW_SHADER(name##Single)
/// Of every solver.
#define ALPENGLOW_SHADERS(name) ALPENGLOW_MOMENT_SHADERS(name), ALPENGLOW_SHADER(name##Standard)

/// What a simpler model has compiled; without shafts, and without slice unless it is Hillaire's.
struct ModelText {
  engine::Shader sky, skyMap, air, probe;
};
#define ALPENGLOW_MODEL(name)                                                      \
  ModelText {                                                                      \
    ALPENGLOW_SHADER(kSkyFragment##name), ALPENGLOW_SHADER(kSkyFragmentMap##name), \
        ALPENGLOW_SHADER(kAirFragment##name), ALPENGLOW_SHADER(kProbe##name)       \
  }

ModelText modelText(Solver solver) {
  const ModelText texts[] = {ALPENGLOW_MODEL(HoffmanPreetham), ALPENGLOW_MODEL(Oneil),
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

engine::Shader skyShader(Solver solver, EffectFlags without, const SkyText& text) {
  if (isModel(solver)) return modelSkyShader(solver, text);
  const Kind kind = kindOf(solver, without);
  const engine::Shader shaded[2][2][3] = {{{ALPENGLOW_MOMENT_SHADERS(kSkyFragmentShafts)},
                                           {ALPENGLOW_MOMENT_SHADERS(kSkyFragmentSliceShafts)}},
                                          {{ALPENGLOW_MOMENT_SHADERS(kSkyFragmentMapShafts)},
                                           {ALPENGLOW_MOMENT_SHADERS(kSkyFragmentMapSliceShafts)}}};
  if (text.shafts) return shaded[text.map][text.slice][kind];
  const engine::Shader plain[2][2][4] = {
      {{ALPENGLOW_SHADERS(kSkyFragment)}, {ALPENGLOW_SHADERS(kSkyFragmentSlice)}},
      {{ALPENGLOW_SHADERS(kSkyFragmentMap)}, {ALPENGLOW_SHADERS(kSkyFragmentMapSlice)}}};
  return plain[text.map][text.slice][kind];
}

engine::Shader airShader(Solver solver, EffectFlags without, bool volume, bool shafts) {
  if (isModel(solver)) return modelText(solver).air;
  const Kind kind = kindOf(solver, without);
  const engine::Shader integrated[4] = {ALPENGLOW_SHADERS(kAirFragment)};
  if (kind == kStandard || (!volume && !shafts)) return integrated[kind];
  const engine::Shader others[3][3] = {{ALPENGLOW_MOMENT_SHADERS(kAirFragmentVolume)},
                                       {ALPENGLOW_MOMENT_SHADERS(kAirFragmentShafts)},
                                       {ALPENGLOW_MOMENT_SHADERS(kAirFragmentVolumeShafts)}};
  return others[volume && shafts ? 2 : shafts ? 1 : 0][kind];
}

engine::Shader sliceShader(Solver solver, EffectFlags without, TableFormat format) {
  if (solver == Solver::Hillaire) {
    return format == TableFormat::Float ? ALPENGLOW_SHADER(kSkySliceHillaireFloat)
                                        : ALPENGLOW_SHADER(kSkySliceHillaireHalf);
  }
  const engine::Shader shaders[2][4] = {{ALPENGLOW_SHADERS(kSkySliceHalf)},
                                        {ALPENGLOW_SHADERS(kSkySliceFloat)}};
  return shaders[format == TableFormat::Float][kindOf(solver, without)];
}

engine::Shader volumeShader(EffectFlags without, TableFormat format) {
  const engine::Shader shaders[2][3] = {{ALPENGLOW_MOMENT_SHADERS(kAirVolumeHalf)},
                                        {ALPENGLOW_MOMENT_SHADERS(kAirVolumeFloat)}};
  return shaders[format == TableFormat::Float][kindOf(Solver::Moments, without)];
}

engine::Shader surfaceShader(EffectFlags without, bool volume) {
  const engine::Shader shaders[2][3] = {{ALPENGLOW_MOMENT_SHADERS(kShaftSurfaceFragment)},
                                        {ALPENGLOW_MOMENT_SHADERS(kShaftSurfaceFragmentVolume)}};
  return shaders[volume][kindOf(Solver::Moments, without)];
}

engine::Shader probeShader(Solver solver, EffectFlags without) {
  if (isModel(solver)) return modelText(solver).probe;
  const engine::Shader shaders[4] = {ALPENGLOW_SHADERS(kProbe)};
  return shaders[kindOf(solver, without)];
}

#undef ALPENGLOW_MODEL
#undef ALPENGLOW_SHADER
#undef ALPENGLOW_MOMENT_SHADERS
#undef ALPENGLOW_SHADERS

}  // namespace alpenglow::sky
