#include "atmosphere/sky/view_cost.h"

#include <algorithm>

#include "atmosphere/sky/air_volume.h"
#include "atmosphere/sky/parts.h"
#include "atmosphere/sky/sky_slice.h"

namespace alpenglow::sky {
namespace {

constexpr uint64_t kTexelBytes = 16;

ImageInfo imageOf(const char* name, const VkExtent3D& extent) {
  ImageInfo info;
  info.name = name;
  info.extent = extent;
  info.bytes = uint64_t{extent.width} * extent.height * extent.depth * kTexelBytes;
  return info;
}

bool hasSlice(const ViewDesc& view, bool sliced) {
  return sliced && view.projection != Projection::Orthographic;
}

bool hasVolume(const TableDesc& tables, const ViewDesc& view, bool sliced, bool air) {
  return hasSlice(view, sliced) && air && tables.solver == Solver::Moments;
}

}  // namespace

uint32_t viewImages(const TableDesc& tables, const ViewDesc& view, bool sliced, bool air,
                    ImageInfo out[kMaxViewImages]) {
  uint32_t count = 0;
  if (hasSlice(view, sliced)) {
    constexpr const char* kNames[] = {"sky slice", "sky slice Mie"};
    for (uint32_t i = 0; i < SkySlice::countFor(tables, view.without); ++i)
      out[count++] = imageOf(kNames[i], SkySlice::extentFor(tables, view.without));
  }
  if (hasVolume(tables, view, sliced, air)) {
    for (uint32_t i = 0; i < AirVolume::kImages; ++i)
      out[count++] = imageOf("air volume", AirVolume::extentFor(view.without));
  }
  return count;
}

PlanCost viewCost(const TableDesc& tables, const ViewDesc& view, bool sliced, bool air) {
  PlanCost cost;
  ImageInfo images[kMaxViewImages];
  cost.images = viewImages(tables, view, sliced, air, images);
  for (uint32_t i = 0; i < cost.images; ++i) {
    cost.bytes += images[i].bytes;
    cost.texels += images[i].bytes / kTexelBytes;
  }
  const bool slice = hasSlice(view, sliced), volume = hasVolume(tables, view, sliced, air);
  const auto variants = static_cast<uint64_t>(std::ranges::count_if(
      kCombinations, [&](const Visible& seen) { return drawn(view.without, seen); }));
  const bool unsliced = !view.alwaysSliced;
  cost.pipelines = variants * ((slice ? 1 : 0) + (unsliced ? 1 : 0)) + (slice ? 1 : 0);
  if (air) cost.pipelines += (volume ? 2 : 0) + (unsliced || !volume ? 1 : 0);
  cost.dispatches = (slice ? 1 : 0) + (volume ? 1 : 0);
  return cost;
}

}  // namespace alpenglow::sky
