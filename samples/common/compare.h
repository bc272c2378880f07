// Compares two of the library's descriptions, member by member.
#pragma once

#include <alpenglow/view.h>

namespace alpenglow::samples {

/// Camera, light and scale.
bool samePicture(const FrameDesc& a, const FrameDesc& b);
bool same(const TableSizes& a, const TableSizes& b);

}  // namespace alpenglow::samples
