#include "atmosphere/passes/view_cost.h"

#include <algorithm>

#include "atmosphere/camera/viewport_partition.h"
#include "atmosphere/passes/aerial_perspective_lut.h"
#include "atmosphere/passes/sky_view_lut.h"

namespace alpenglow::passes {
namespace {

constexpr uint64_t kTexelBytes = 16;

ImageInfo imageOf(const char* name, const VkExtent3D& extent) {
  ImageInfo info;
  info.name = name;
  info.extent = extent;
  info.bytes = uint64_t{extent.width} * extent.height * extent.depth * kTexelBytes;
  return info;
}

}  // namespace

uint32_t viewImages(const TableDesc& tables, const PictureDesc& view,
                    ImageInfo out[kMaxViewImages]) {
  uint32_t count = 0;
  if (view.skyLut) {
    constexpr const char* kNames[] = {"sky-view LUT", "sky-view LUT Mie"};
    for (uint32_t i = 0; i < SkyViewLut::countFor(tables, view.disabledEffects); ++i)
      out[count++] = imageOf(kNames[i], SkyViewLut::extentFor(tables, view.disabledEffects));
  }
  if (view.aerialLut) {
    for (uint32_t i = 0; i < AerialPerspectiveLut::kImages; ++i)
      out[count++] =
          imageOf("aerial-perspective LUT", AerialPerspectiveLut::extentFor(view.disabledEffects));
  }
  return count;
}

PlanCost viewCost(const TableDesc& tables, const PictureDesc& view) {
  PlanCost cost;
  ImageInfo images[kMaxViewImages];
  cost.images = viewImages(tables, view, images);
  for (uint32_t i = 0; i < cost.images; ++i) {
    cost.bytes += images[i].bytes;
    cost.texels += images[i].bytes / kTexelBytes;
  }
  const auto variants = static_cast<uint64_t>(std::ranges::count_if(
      kCombinations, [&](const Visible& seen) { return drawn(view.disabledEffects, seen); }));
  cost.pipelines =
      variants * ((view.skyLut ? 1 : 0) + (view.onlyLut ? 0 : 1)) + (view.skyLut ? 1 : 0);
  if (view.aerial) cost.pipelines += view.aerialLut ? 2 : 1;
  cost.dispatches = (view.skyLut ? 1 : 0) + (view.aerialLut ? 1 : 0);
  return cost;
}

}  // namespace alpenglow::passes
