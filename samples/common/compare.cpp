#include "compare.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <tuple>
#include <type_traits>

namespace alpenglow::samples {
namespace {

bool sameVector(const double (&a)[3], const double (&b)[3]) {
  return std::equal(std::begin(a), std::end(a), std::begin(b));
}

bool same(const Camera& a, const Camera& b) {
  return sameVector(a.position_m, b.position_m) && sameVector(a.forward, b.forward) &&
         sameVector(a.up, b.up) && a.fov == b.fov && a.height_m == b.height_m;
}

bool same(const Sun& a, const Sun& b) {
  for (uint32_t i = 0; i < kSpectrumSize; ++i)
    if (a.irradiance[i] != b.irradiance[i]) return false;
  return sameVector(a.direction, b.direction) && a.discRadius == b.discRadius;
}

auto tied(const VkRect2D& r) {
  return std::tie(r.offset.x, r.offset.y, r.extent.width, r.extent.height);
}

}  // namespace

bool same(const SkyDraw& a, const SkyDraw& b) {
  return same(a.camera, b.camera) && same(a.sun, b.sun) && a.radianceScale == b.radianceScale &&
         tied(a.viewport) == tied(b.viewport) && a.depth.near_m == b.depth.near_m &&
         a.depth.far_m == b.depth.far_m;
}

bool same(const TableSizes& a, const TableSizes& b) {
  static_assert(std::has_unique_object_representations_v<TableSizes>);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace alpenglow::samples
