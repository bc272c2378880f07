// Where the tables of the moment solver hold what: the constants of
// shaders/glsl/physics/field.glsl.
#pragma once

#include <alpenglow/tables.h>

#include "atmosphere/model/physics_cpp.h"

namespace alpenglow::bake {

/// The shape of a completed description's tables, computed in double. Pure; thread-safe.
physics_f64::MomentShape makeMomentShapeF64(const Parameters& parameters, const TableDesc& desc);
/// The same as the GPU has it.
physics_f32::MomentShape makeMomentShapeF32(const Parameters& parameters, const TableDesc& desc);

/// Orders of scattering that are computed one by one: TableDesc::orders, or for 0 as many as the
/// air needs before the rest is a geometric series.
uint32_t solvedOrders(const Parameters& parameters, const TableDesc& desc);

/// How strongly the highest degrees of the harmonics are damped: MomentShape::taper.
double degreeTaper(const Parameters& parameters);

}  // namespace alpenglow::bake
