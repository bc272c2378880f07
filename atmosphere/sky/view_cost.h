// What a view costs, told from its description.
#pragma once

#include <alpenglow/plan.h>

namespace alpenglow::sky {

/// Images and pipelines that createView makes, and what recordSkySlice dispatches for a frame, for
/// a view of such tables; of a device that stores and filters 32-bit floats. `tables` is completed.
/// The view's handles don't count: `sliced` says whether it has a sky slice, `air` a scene's depth.
/// Shafts have costs of their own.
PlanCost viewCost(const TableDesc& tables, const ViewDesc& view, bool sliced, bool air);

/// The images, at most kMaxViewImages of them; returns how many.
inline constexpr uint32_t kMaxViewImages = 5;
uint32_t viewImages(const TableDesc& tables, const ViewDesc& view, bool sliced, bool air,
                    ImageInfo out[kMaxViewImages]);

}  // namespace alpenglow::sky
