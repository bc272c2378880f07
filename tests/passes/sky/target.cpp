#include <stdexcept>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {

Target::Target(headless::Device& device, const TargetDesc& desc) : device_(device), desc_(desc) {
  std::string error;
  target_ = headless::Target::create(device, desc, &error);
  if (target_ == nullptr) throw std::runtime_error(error);  // GoogleTest fails the test.
}

void Target::fill(VkCommandBuffer commands, const VkRect2D& area, float color, float depth) {
  VkClearAttachment clears[2] = {};
  clears[0].aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
  for (float& channel : clears[0].clearValue.color.float32) channel = color;
  clears[1].aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
  clears[1].clearValue.depthStencil.depth = depth;
  const VkClearRect rect = {area, 0, 1};
  reinterpret_cast<PFN_vkCmdClearAttachments>(device_.function("vkCmdClearAttachments"))(
      commands, 2, clears, 1, &rect);
}

Picture Target::draw(const std::function<bool(VkCommandBuffer)>& inside) {
  Picture picture;
  std::string error = "What was to be drawn was refused.";
  const bool ran = device_.run(
      [&](VkCommandBuffer commands) {
        target_->prepare(commands);
        target_->begin(commands, {{0, 0}, desc_.extent}, VK_ATTACHMENT_LOAD_OP_CLEAR,
                       {kClear, desc_.clearDepth});
        const bool recorded = inside(commands);
        target_->end(commands);
        target_->copy(commands, desc_.extent);
        return recorded;
      },
      &error);
  EXPECT_TRUE(ran) << error;
  if (!ran) return picture;
  picture.width = desc_.extent.width;
  picture.height = desc_.extent.height;
  picture.data = target_->pixels(desc_.extent);
  return picture;
}

}  // namespace alpenglow::testing
