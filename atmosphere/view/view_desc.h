// Checks of ViewDesc, and its resolved form.
#pragma once

#include "atmosphere/camera/picture.h"
#include "atmosphere/tables/table_set.h"

namespace alpenglow::view {

/// A ViewDesc with what the tables add.
struct ResolvedView {
  PictureDesc picture;
  bool hasLightShafts = false;
  LightShaftSettings shafts;  ///< Completed.
  VkPipelineStageFlags2 readers = 0;
};

/// Pure: of a completed TableDesc.
ResolvedView resolve(const TableDesc& tables, const ViewDesc& desc);

/// Ok, or a sentence that names the wrong member of ViewDesc.
Status checkViewDesc(const engine::Device& device, const TableDesc& tables, const ViewDesc& desc);

}  // namespace alpenglow::view
