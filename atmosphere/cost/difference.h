// How far a picture is from another, as a picture.
#pragma once

#include <alpenglow/io/tone_map.h>

namespace alpenglow::cost {

/// Of luminance: blue where the image is darker, red where it is brighter, full at a factor of 2;
/// white where both are equal. Both have one size.
io::ByteImage differenceOf(const io::LinearImage& image, const io::LinearImage& finest);

}  // namespace alpenglow::cost
