// Cost of a view, computed from its description.
#pragma once

#include <alpenglow/plan.h>

#include "atmosphere/camera/picture.h"

namespace alpenglow::passes {

/// Images and pipelines that createView makes, and dispatches of recordLuts for a frame, for a view
/// of such tables on a device that stores and filters 32-bit floats. `tables` is completed.
/// Light shafts are not included.
PlanCost viewCost(const TableDesc& tables, const PictureDesc& view);

/// The images, at most kMaxViewImages of them; returns how many.
inline constexpr uint32_t kMaxViewImages = 5;
uint32_t viewImages(const TableDesc& tables, const PictureDesc& view,
                    ImageInfo out[kMaxViewImages]);

}  // namespace alpenglow::passes
