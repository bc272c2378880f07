#include "atmosphere/passes/shader_choice.h"

#include <alpenglow/shaders/aerial_perspective_fragment.h>
#include <alpenglow/shaders/aerial_perspective_fragment_hillaire.h>
#include <alpenglow/shaders/aerial_perspective_fragment_hoffman_preetham.h>
#include <alpenglow/shaders/aerial_perspective_fragment_lut.h>
#include <alpenglow/shaders/aerial_perspective_fragment_lut_molecules.h>
#include <alpenglow/shaders/aerial_perspective_fragment_lut_shafts.h>
#include <alpenglow/shaders/aerial_perspective_fragment_lut_shafts_molecules.h>
#include <alpenglow/shaders/aerial_perspective_fragment_lut_shafts_single.h>
#include <alpenglow/shaders/aerial_perspective_fragment_lut_single.h>
#include <alpenglow/shaders/aerial_perspective_fragment_molecules.h>
#include <alpenglow/shaders/aerial_perspective_fragment_oneil.h>
#include <alpenglow/shaders/aerial_perspective_fragment_schafhitzel.h>
#include <alpenglow/shaders/aerial_perspective_fragment_shafts.h>
#include <alpenglow/shaders/aerial_perspective_fragment_shafts_molecules.h>
#include <alpenglow/shaders/aerial_perspective_fragment_shafts_single.h>
#include <alpenglow/shaders/aerial_perspective_fragment_single.h>
#include <alpenglow/shaders/aerial_perspective_fragment_standard.h>
#include <alpenglow/shaders/aerial_perspective_lut_float.h>
#include <alpenglow/shaders/aerial_perspective_lut_float_molecules.h>
#include <alpenglow/shaders/aerial_perspective_lut_float_single.h>
#include <alpenglow/shaders/aerial_perspective_lut_half.h>
#include <alpenglow/shaders/aerial_perspective_lut_half_molecules.h>
#include <alpenglow/shaders/aerial_perspective_lut_half_single.h>
#include <alpenglow/shaders/light_volume_mesh_fragment.h>
#include <alpenglow/shaders/light_volume_mesh_fragment_lut.h>
#include <alpenglow/shaders/light_volume_mesh_fragment_lut_molecules.h>
#include <alpenglow/shaders/light_volume_mesh_fragment_lut_single.h>
#include <alpenglow/shaders/light_volume_mesh_fragment_molecules.h>
#include <alpenglow/shaders/light_volume_mesh_fragment_single.h>
#include <alpenglow/shaders/probe.h>
#include <alpenglow/shaders/probe_hillaire.h>
#include <alpenglow/shaders/probe_hoffman_preetham.h>
#include <alpenglow/shaders/probe_molecules.h>
#include <alpenglow/shaders/probe_oneil.h>
#include <alpenglow/shaders/probe_schafhitzel.h>
#include <alpenglow/shaders/probe_single.h>
#include <alpenglow/shaders/probe_standard.h>
#include <alpenglow/shaders/sky_fragment.h>
#include <alpenglow/shaders/sky_fragment_hillaire.h>
#include <alpenglow/shaders/sky_fragment_hoffman_preetham.h>
#include <alpenglow/shaders/sky_fragment_lut.h>
#include <alpenglow/shaders/sky_fragment_lut_hillaire.h>
#include <alpenglow/shaders/sky_fragment_lut_molecules.h>
#include <alpenglow/shaders/sky_fragment_lut_shafts.h>
#include <alpenglow/shaders/sky_fragment_lut_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_lut_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_lut_single.h>
#include <alpenglow/shaders/sky_fragment_lut_standard.h>
#include <alpenglow/shaders/sky_fragment_map.h>
#include <alpenglow/shaders/sky_fragment_map_hillaire.h>
#include <alpenglow/shaders/sky_fragment_map_hoffman_preetham.h>
#include <alpenglow/shaders/sky_fragment_map_lut.h>
#include <alpenglow/shaders/sky_fragment_map_lut_hillaire.h>
#include <alpenglow/shaders/sky_fragment_map_lut_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_lut_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_lut_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_lut_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_map_lut_single.h>
#include <alpenglow/shaders/sky_fragment_map_lut_standard.h>
#include <alpenglow/shaders/sky_fragment_map_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_oneil.h>
#include <alpenglow/shaders/sky_fragment_map_schafhitzel.h>
#include <alpenglow/shaders/sky_fragment_map_shafts.h>
#include <alpenglow/shaders/sky_fragment_map_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_map_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_map_single.h>
#include <alpenglow/shaders/sky_fragment_map_standard.h>
#include <alpenglow/shaders/sky_fragment_molecules.h>
#include <alpenglow/shaders/sky_fragment_oneil.h>
#include <alpenglow/shaders/sky_fragment_schafhitzel.h>
#include <alpenglow/shaders/sky_fragment_shafts.h>
#include <alpenglow/shaders/sky_fragment_shafts_molecules.h>
#include <alpenglow/shaders/sky_fragment_shafts_single.h>
#include <alpenglow/shaders/sky_fragment_single.h>
#include <alpenglow/shaders/sky_fragment_standard.h>
#include <alpenglow/shaders/sky_view_lut_float.h>
#include <alpenglow/shaders/sky_view_lut_float_molecules.h>
#include <alpenglow/shaders/sky_view_lut_float_single.h>
#include <alpenglow/shaders/sky_view_lut_float_standard.h>
#include <alpenglow/shaders/sky_view_lut_half.h>
#include <alpenglow/shaders/sky_view_lut_half_molecules.h>
#include <alpenglow/shaders/sky_view_lut_half_single.h>
#include <alpenglow/shaders/sky_view_lut_half_standard.h>
#include <alpenglow/shaders/sky_view_lut_hillaire_rgba16f.h>
#include <alpenglow/shaders/sky_view_lut_hillaire_rgba32f.h>

#include "atmosphere/parameters/solvers.h"

namespace alpenglow::passes {
namespace {

/// The kinds of tables; every shader that reads tables is compiled for each.
enum Kind : uint32_t { kFull, kMolecules, kSingle, kStandard };

Kind kindOf(Solver solver, EffectFlags disabledEffects) {
  if (solver != Solver::Moments) return kStandard;
  if (!hasEffect(disabledEffects, Effect::MultipleScattering)) return kSingle;
  return hasEffect(disabledEffects, Effect::Mie) ? kFull : kMolecules;
}

#define ALPENGLOW_SHADER(name) \
  engine::Shader { shaders::name, sizeof shaders::name, #name }
/// Of the moment solver, by kind.
#define ALPENGLOW_MOMENT_SHADERS(name) \
  ALPENGLOW_SHADER(name), ALPENGLOW_SHADER(name##Molecules), ALPENGLOW_SHADER(name##Single)
/// Of every solver.
#define ALPENGLOW_SHADERS(name) ALPENGLOW_MOMENT_SHADERS(name), ALPENGLOW_SHADER(name##Standard)

/// Shaders of a simpler model: no light shafts, and no LUT except for Hillaire's.
struct BaselineShaders {
  engine::Shader sky, skyMap, aerialPerspective, probe;
};
#define ALPENGLOW_BASELINE(name)                                                           \
  BaselineShaders {                                                                        \
    ALPENGLOW_SHADER(kSkyFragment##name), ALPENGLOW_SHADER(kSkyFragmentMap##name),         \
        ALPENGLOW_SHADER(kAerialPerspectiveFragment##name), ALPENGLOW_SHADER(kProbe##name) \
  }

BaselineShaders baselineShaders(Solver solver) {
  const BaselineShaders shaders[] = {ALPENGLOW_BASELINE(HoffmanPreetham), ALPENGLOW_BASELINE(Oneil),
                                     ALPENGLOW_BASELINE(Schafhitzel), ALPENGLOW_BASELINE(Hillaire)};
  return shaders[static_cast<uint32_t>(solver) - static_cast<uint32_t>(Solver::HoffmanPreetham)];
}

engine::Shader baselineSkyShader(Solver solver, const SkyVariant& wanted) {
  if (wanted.lut) {
    return wanted.map ? ALPENGLOW_SHADER(kSkyFragmentMapLutHillaire)
                      : ALPENGLOW_SHADER(kSkyFragmentLutHillaire);
  }
  return wanted.map ? baselineShaders(solver).skyMap : baselineShaders(solver).sky;
}

}  // namespace

engine::Shader skyShader(Solver solver, EffectFlags disabledEffects, const SkyVariant& wanted) {
  if (isModel(solver)) return baselineSkyShader(solver, wanted);
  const Kind kind = kindOf(solver, disabledEffects);
  const engine::Shader shaded[2][2][3] = {{{ALPENGLOW_MOMENT_SHADERS(kSkyFragmentShafts)},
                                           {ALPENGLOW_MOMENT_SHADERS(kSkyFragmentLutShafts)}},
                                          {{ALPENGLOW_MOMENT_SHADERS(kSkyFragmentMapShafts)},
                                           {ALPENGLOW_MOMENT_SHADERS(kSkyFragmentMapLutShafts)}}};
  if (wanted.shafts) return shaded[wanted.map][wanted.lut][kind];
  const engine::Shader plain[2][2][4] = {
      {{ALPENGLOW_SHADERS(kSkyFragment)}, {ALPENGLOW_SHADERS(kSkyFragmentLut)}},
      {{ALPENGLOW_SHADERS(kSkyFragmentMap)}, {ALPENGLOW_SHADERS(kSkyFragmentMapLut)}}};
  return plain[wanted.map][wanted.lut][kind];
}

engine::Shader aerialPerspectiveShader(Solver solver, EffectFlags disabledEffects, bool lut,
                                       bool shafts) {
  if (isModel(solver)) return baselineShaders(solver).aerialPerspective;
  const Kind kind = kindOf(solver, disabledEffects);
  const engine::Shader integrated[4] = {ALPENGLOW_SHADERS(kAerialPerspectiveFragment)};
  if (kind == kStandard || (!lut && !shafts)) return integrated[kind];
  const engine::Shader others[3][3] = {
      {ALPENGLOW_MOMENT_SHADERS(kAerialPerspectiveFragmentLut)},
      {ALPENGLOW_MOMENT_SHADERS(kAerialPerspectiveFragmentShafts)},
      {ALPENGLOW_MOMENT_SHADERS(kAerialPerspectiveFragmentLutShafts)}};
  return others[lut && shafts ? 2 : shafts ? 1 : 0][kind];
}

engine::Shader skyViewLutShader(Solver solver, EffectFlags disabledEffects, TableFormat format) {
  if (solver == Solver::Hillaire) {
    return format == TableFormat::Float ? ALPENGLOW_SHADER(kSkyViewLutHillaireFloat)
                                        : ALPENGLOW_SHADER(kSkyViewLutHillaireHalf);
  }
  const engine::Shader shaders[2][4] = {{ALPENGLOW_SHADERS(kSkyViewLutHalf)},
                                        {ALPENGLOW_SHADERS(kSkyViewLutFloat)}};
  return shaders[format == TableFormat::Float][kindOf(solver, disabledEffects)];
}

engine::Shader aerialPerspectiveLutShader(EffectFlags disabledEffects, TableFormat format) {
  const engine::Shader shaders[2][3] = {{ALPENGLOW_MOMENT_SHADERS(kAerialPerspectiveLutHalf)},
                                        {ALPENGLOW_MOMENT_SHADERS(kAerialPerspectiveLutFloat)}};
  return shaders[format == TableFormat::Float][kindOf(Solver::Moments, disabledEffects)];
}

engine::Shader lightVolumeMeshShader(EffectFlags disabledEffects, bool lut) {
  const engine::Shader shaders[2][3] = {{ALPENGLOW_MOMENT_SHADERS(kLightVolumeMeshFragment)},
                                        {ALPENGLOW_MOMENT_SHADERS(kLightVolumeMeshFragmentLut)}};
  return shaders[lut][kindOf(Solver::Moments, disabledEffects)];
}

engine::Shader probeShader(Solver solver, EffectFlags disabledEffects) {
  if (isModel(solver)) return baselineShaders(solver).probe;
  const engine::Shader shaders[4] = {ALPENGLOW_SHADERS(kProbe)};
  return shaders[kindOf(solver, disabledEffects)];
}

#undef ALPENGLOW_BASELINE
#undef ALPENGLOW_SHADER
#undef ALPENGLOW_MOMENT_SHADERS
#undef ALPENGLOW_SHADERS

}  // namespace alpenglow::passes
