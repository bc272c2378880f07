// What a picture is drawn into and read back through.
#pragma once

#include <alpenglow/io/tone_map.h>

#include "session.h"

namespace alpenglow::cli {

inline constexpr VkFormat kPictureFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

/// Destroyed before its session.
struct PictureTarget {
  headless::Image image;          ///< A colour attachment in kPictureFormat, to be copied from.
  headless::HostBuffer readback;  ///< As large as the image's texels.
};

/// Made before the tables, so that no bake is lost to a picture that doesn't fit. Throws a Failure
/// that names the size, the bytes and the limit.
PictureTarget createPictureTarget(Session* session, uint32_t width, uint32_t height);

/// Copies what was drawn into host memory; the image is in kCopySource.
io::LinearImage readPicture(Session* session, const PictureTarget& target);

}  // namespace alpenglow::cli
