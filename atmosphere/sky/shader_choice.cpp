#include "atmosphere/sky/shader_choice.h"

#include <alpenglow/shaders/air_fragment.h>
#include <alpenglow/shaders/air_fragment_molecules.h>
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
#include <alpenglow/shaders/probe_molecules.h>
#include <alpenglow/shaders/probe_single.h>
#include <alpenglow/shaders/probe_standard.h>
#include <alpenglow/shaders/shaft_surface_fragment.h>
#include <alpenglow/shaders/shaft_surface_fragment_molecules.h>
#include <alpenglow/shaders/shaft_surface_fragment_single.h>
#include <alpenglow/shaders/shaft_surface_fragment_volume.h>
#include <alpenglow/shaders/shaft_surface_fragment_volume_molecules.h>
#include <alpenglow/shaders/shaft_surface_fragment_volume_single.h>
#include <alpenglow/shaders/sky_fragment.h>
#include <alpenglow/shaders/sky_fragment_map.h>
#include <alpenglow/shaders/sky_fragment_map_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_map_single.h>
#include <alpenglow/shaders/sky_fragment_map_slice.h>
#include <alpenglow/shaders/sky_fragment_map_slice_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_slice_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_slice_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_slice_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_map_slice_single.h>
#include <alpenglow/shaders/sky_fragment_map_slice_standard.h>
#include <alpenglow/shaders/sky_fragment_map_standard.h>
#include <alpenglow/shaders/sky_fragment_molecules.h>
#include <alpenglow/shaders/sky_fragment_shafts.h>
#include <alpenglow/shaders/sky_fragment_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_single.h>
#include <alpenglow/shaders/sky_fragment_slice.h>
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

}  // namespace

engine::Shader skyShader(Solver solver, EffectFlags without, const SkyText& text) {
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
  const Kind kind = kindOf(solver, without);
  const engine::Shader integrated[4] = {ALPENGLOW_SHADERS(kAirFragment)};
  if (kind == kStandard || (!volume && !shafts)) return integrated[kind];
  const engine::Shader others[3][3] = {{ALPENGLOW_MOMENT_SHADERS(kAirFragmentVolume)},
                                       {ALPENGLOW_MOMENT_SHADERS(kAirFragmentShafts)},
                                       {ALPENGLOW_MOMENT_SHADERS(kAirFragmentVolumeShafts)}};
  return others[volume && shafts ? 2 : shafts ? 1 : 0][kind];
}

engine::Shader sliceShader(Solver solver, EffectFlags without, TableFormat format) {
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
  const engine::Shader shaders[4] = {ALPENGLOW_SHADERS(kProbe)};
  return shaders[kindOf(solver, without)];
}

#undef ALPENGLOW_SHADER
#undef ALPENGLOW_MOMENT_SHADERS
#undef ALPENGLOW_SHADERS

}  // namespace alpenglow::sky
