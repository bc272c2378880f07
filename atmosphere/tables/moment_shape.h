// The layout of the moment solver's tables: the constants of
// shaders/glsl/physics/field.glsl.
#pragma once

#include <alpenglow/tables.h>

#include <alpenglow/table_limits.h>
#include "atmosphere/parameters/physics_cpp.h"

namespace alpenglow::tables {

/// The shape of a completed description's tables, computed in double. Pure; thread-safe.
physics_f64::MomentShape makeMomentShapeF64(const Parameters& parameters, const TableDesc& desc);
/// The same in float, as in the uniform block.
physics_f32::MomentShape makeMomentShapeF32(const Parameters& parameters, const TableDesc& desc);

/// Whether a description's tables are for any zenith angle of the sun.
inline bool allSuns(const TableDesc& desc) {
  return desc.sunZenithFrom == 0.0 && desc.sunZenithTo == 0.0;
}

/// Nodes over mu_s that a description's range of sun elevations takes, as dense as `all` of them
/// are over every sun. Cubics need four.
uint32_t nodesOfSunRange(const Parameters& parameters, const TableDesc& desc, uint32_t all);
inline constexpr uint32_t kLeastSunNodes = 4;

/// The sizes of a quality level for an atmosphere, by the rule of docs/moment-solver.md; sizes in
/// `given` override it.
TableSizes momentSizes(const Parameters& parameters, Quality quality, const TableSizes& given);

/// Orders of scattering that are computed one by one: TableDesc::orders, or for 0 as many as the
/// atmosphere needs before the rest is a geometric series.
uint32_t solvedOrders(const Parameters& parameters, const TableDesc& desc);

/// Layers of the table of moments: MomentShape::layers. E is the last, if it is needed.
inline uint32_t fieldLayers(const TableDesc& desc) {
  constexpr EffectFlags kGround =
      effectBit(Effect::GroundReflection) | effectBit(Effect::GroundIrradiance);
  return (desc.disabledEffects & kGround) == kGround ? 4 : 5;
}

/// How strongly the highest degrees of the harmonics are damped: MomentShape::taper.
double degreeTaper(const Parameters& parameters);

}  // namespace alpenglow::tables
