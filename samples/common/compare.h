// Whether two of the library's descriptions say the same, member by member.
#pragma once

#include <alpenglow/view.h>

namespace alpenglow::samples {

bool same(const SkyDraw& a, const SkyDraw& b);
bool same(const MomentSettings& a, const MomentSettings& b);

}  // namespace alpenglow::samples
