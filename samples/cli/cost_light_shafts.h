// Light shafts for the cost report: each method over the sample terrain.
#pragma once

#include <alpenglow/cost.h>

namespace alpenglow::cli {

/// Rows of the sweep "shafts": what a method adds to the frame, and how far the picture is from one
/// with many samples along each ray. A failure is the sentence of the step that failed.
io::Result<std::vector<cost::Row>> measureLightShafts(const std::string& device, bool quick);

}  // namespace alpenglow::cli
