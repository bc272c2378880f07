// Whether two of the library's descriptions say the same, member by member.
#pragma once

#include <alpenglow/view.h>

namespace alpenglow::samples {

bool same(const SkyDraw& a, const SkyDraw& b);
bool same(const TableSizes& a, const TableSizes& b);

}  // namespace alpenglow::samples
