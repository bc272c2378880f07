// What a view costs, told from its description.
#pragma once

#include <alpenglow/plan.h>

namespace alpenglow::sky {

/// Images and pipelines that createView makes, and what recordSkySlice dispatches for a frame, for
/// a view of such tables; of a device that stores and filters 32-bit floats. `tables` is completed;
/// of the view's handles only whether they are null counts. Shafts have costs of their own.
PlanCost viewCost(const TableDesc& tables, const ViewDesc& view);

/// The images, at most kMaxViewTables of them; returns how many.
inline constexpr uint32_t kMaxViewTables = 5;
uint32_t viewTables(const TableDesc& tables, const ViewDesc& view, PlanTable out[kMaxViewTables]);

}  // namespace alpenglow::sky
