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

auto tied(const VkRect2D& r) {
  return std::tie(r.offset.x, r.offset.y, r.extent.width, r.extent.height);
}

bool same(const Camera& a, const Camera& b) {
  return sameVector(a.position, b.position) && sameVector(a.forward, b.forward) &&
         sameVector(a.up, b.up) && a.fov == b.fov && a.height == b.height &&
         a.nearPlane == b.nearPlane && a.farPlane == b.farPlane &&
         tied(a.viewport) == tied(b.viewport);
}

bool same(const Light& a, const Light& b) {
  return sameVector(a.direction, b.direction) && a.discRadius == b.discRadius &&
         a.dimming == b.dimming;
}

}  // namespace

bool samePicture(const FrameDesc& a, const FrameDesc& b) {
  return same(a.cameras[0], b.cameras[0]) && same(a.lights[0], b.lights[0]) &&
         a.radianceScale == b.radianceScale;
}

bool same(const TableSizes& a, const TableSizes& b) {
  static_assert(std::has_unique_object_representations_v<TableSizes>);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace alpenglow::samples
