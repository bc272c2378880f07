#include <cmath>
#include <cstring>

#include "tests/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr ImageState kUndefined = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_NONE,
                                   VK_ACCESS_2_NONE};
constexpr ImageState kColor = {
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT};
constexpr ImageState kDepth = {
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT};
constexpr ImageState kCopied = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                VK_ACCESS_2_TRANSFER_READ_BIT};

float halfToFloat(uint16_t half) {
  const int sign = half >> 15, exponent = half >> 10 & 31, mantissa = half & 1023;
  double value =
      exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  if (exponent == 31) value = mantissa != 0 ? NAN : INFINITY;
  return static_cast<float>(sign != 0 ? -value : value);
}

}  // namespace

Target::Target(headless::Device& device, const TargetDesc& desc) : device_(device), desc_(desc) {
  const VkImageUsageFlags readable =
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  color_ = makeImage(desc.color, desc.samples, readable, VK_IMAGE_ASPECT_COLOR_BIT);
  if (multisampled())
    resolved_ = makeImage(desc.color, VK_SAMPLE_COUNT_1_BIT, readable, VK_IMAGE_ASPECT_COLOR_BIT);
  if (desc.depth != VK_FORMAT_UNDEFINED)
    depth_ = makeImage(desc.depth, desc.samples, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                       VK_IMAGE_ASPECT_DEPTH_BIT);
  if (desc.renderPass) makeRenderPass();
  std::string error;
  readback_ = device.createHostBuffer(VkDeviceSize{16} * desc.extent.width * desc.extent.height,
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
  EXPECT_TRUE(error.empty()) << error;
}

Target::~Target() {
  const VkDevice device = device_.device();
  function<PFN_vkDestroyFramebuffer>("vkDestroyFramebuffer")(device, framebuffer_, nullptr);
  function<PFN_vkDestroyRenderPass>("vkDestroyRenderPass")(device, renderPass_, nullptr);
  for (RawImage* image : {&color_, &resolved_, &depth_}) {
    function<PFN_vkDestroyImageView>("vkDestroyImageView")(device, image->view, nullptr);
    function<PFN_vkDestroyImage>("vkDestroyImage")(device, image->image, nullptr);
    function<PFN_vkFreeMemory>("vkFreeMemory")(device, image->memory, nullptr);
  }
}

Target::RawImage Target::makeImage(VkFormat format, VkSampleCountFlagBits samples,
                                   VkImageUsageFlags usage, VkImageAspectFlags aspect) {
  const VkDevice device = device_.device();
  RawImage out;
  VkImageCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {desc_.extent.width, desc_.extent.height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = samples;
  info.usage = usage;
  EXPECT_EQ(function<PFN_vkCreateImage>("vkCreateImage")(device, &info, nullptr, &out.image),
            VK_SUCCESS);
  VkMemoryRequirements needed = {};
  function<PFN_vkGetImageMemoryRequirements>("vkGetImageMemoryRequirements")(device, out.image,
                                                                             &needed);
  VkMemoryAllocateInfo memory = {};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  memory.allocationSize = needed.size;
  while ((needed.memoryTypeBits >> memory.memoryTypeIndex & 1u) == 0) ++memory.memoryTypeIndex;
  EXPECT_EQ(
      function<PFN_vkAllocateMemory>("vkAllocateMemory")(device, &memory, nullptr, &out.memory),
      VK_SUCCESS);
  EXPECT_EQ(function<PFN_vkBindImageMemory>("vkBindImageMemory")(device, out.image, out.memory, 0),
            VK_SUCCESS);
  VkImageViewCreateInfo view = {};
  view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view.image = out.image;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {aspect, 0, 1, 0, 1};
  EXPECT_EQ(function<PFN_vkCreateImageView>("vkCreateImageView")(device, &view, nullptr, &out.view),
            VK_SUCCESS);
  return out;
}

void Target::makeRenderPass() {
  VkAttachmentDescription attachments[2] = {};
  attachments[0].format = desc_.color;
  attachments[0].samples = desc_.samples;
  attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachments[0].initialLayout = attachments[0].finalLayout = kColor.layout;
  attachments[1] = attachments[0];
  attachments[1].format = desc_.depth;
  attachments[1].initialLayout = attachments[1].finalLayout =
      VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
  const VkAttachmentReference colorReference = {0, kColor.layout};
  const VkAttachmentReference depthReference = {1,
                                                VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  const bool hasDepth = desc_.depth != VK_FORMAT_UNDEFINED;
  VkSubpassDescription subpass = {};
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &colorReference;
  subpass.pDepthStencilAttachment = hasDepth ? &depthReference : nullptr;
  VkRenderPassCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = hasDepth ? 2 : 1;
  info.pAttachments = attachments;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  EXPECT_EQ(function<PFN_vkCreateRenderPass>("vkCreateRenderPass")(device_.device(), &info, nullptr,
                                                                   &renderPass_),
            VK_SUCCESS);
  const VkImageView views[2] = {color_.view, depth_.view};
  VkFramebufferCreateInfo framebuffer = {};
  framebuffer.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  framebuffer.renderPass = renderPass_;
  framebuffer.attachmentCount = info.attachmentCount;
  framebuffer.pAttachments = views;
  framebuffer.width = desc_.extent.width;
  framebuffer.height = desc_.extent.height;
  framebuffer.layers = 1;
  EXPECT_EQ(function<PFN_vkCreateFramebuffer>("vkCreateFramebuffer")(device_.device(), &framebuffer,
                                                                     nullptr, &framebuffer_),
            VK_SUCCESS);
}

void Target::barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                     const ImageState& before, const ImageState& after) {
  VkImageMemoryBarrier2 one = {};
  one.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  one.srcStageMask = before.stage;
  one.srcAccessMask = before.access;
  one.dstStageMask = after.stage;
  one.dstAccessMask = after.access;
  one.oldLayout = before.layout;
  one.newLayout = after.layout;
  one.srcQueueFamilyIndex = one.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  one.image = image;
  one.subresourceRange = {aspect, 0, 1, 0, 1};
  VkDependencyInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &one;
  function<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(commands, &info);
}

void Target::begin(VkCommandBuffer commands) {
  ImageState depth = kDepth;
  if (desc_.renderPass) depth.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
  barrier(commands, color_.image, VK_IMAGE_ASPECT_COLOR_BIT, kUndefined, kColor);
  if (multisampled())
    barrier(commands, resolved_.image, VK_IMAGE_ASPECT_COLOR_BIT, kUndefined, kColor);
  if (depth_.image != VK_NULL_HANDLE)
    barrier(commands, depth_.image, VK_IMAGE_ASPECT_DEPTH_BIT, kUndefined, depth);
  VkClearValue clear[2] = {};
  for (float& channel : clear[0].color.float32) channel = kClear;
  clear[1].depthStencil.depth = desc_.clearDepth;
  const VkRect2D area = {{0, 0}, desc_.extent};
  if (desc_.renderPass) {
    VkRenderPassBeginInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = renderPass_;
    info.framebuffer = framebuffer_;
    info.renderArea = area;
    info.clearValueCount = 2;
    info.pClearValues = clear;
    function<PFN_vkCmdBeginRenderPass>("vkCmdBeginRenderPass")(commands, &info,
                                                               VK_SUBPASS_CONTENTS_INLINE);
    return;
  }
  VkRenderingAttachmentInfo color = {};
  color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  color.imageView = color_.view;
  color.imageLayout = kColor.layout;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  color.clearValue = clear[0];
  if (multisampled()) {
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = resolved_.view;
    color.resolveImageLayout = kColor.layout;
  }
  VkRenderingAttachmentInfo depthInfo = color;
  depthInfo.imageView = depth_.view;
  depthInfo.imageLayout = depth.layout;
  depthInfo.resolveMode = VK_RESOLVE_MODE_NONE;
  depthInfo.resolveImageView = VK_NULL_HANDLE;
  depthInfo.clearValue = clear[1];
  VkRenderingInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea = area;
  info.layerCount = 1;
  info.colorAttachmentCount = 1;
  info.pColorAttachments = &color;
  info.pDepthAttachment = depth_.image != VK_NULL_HANDLE ? &depthInfo : nullptr;
  function<PFN_vkCmdBeginRendering>("vkCmdBeginRendering")(commands, &info);
}

void Target::end(VkCommandBuffer commands) {
  if (desc_.renderPass) {
    function<PFN_vkCmdEndRenderPass>("vkCmdEndRenderPass")(commands);
  } else {
    function<PFN_vkCmdEndRendering>("vkCmdEndRendering")(commands);
  }
  const VkImage image = multisampled() ? resolved_.image : color_.image;
  barrier(commands, image, VK_IMAGE_ASPECT_COLOR_BIT, kColor, kCopied);
  VkBufferImageCopy copy = {};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {desc_.extent.width, desc_.extent.height, 1};
  function<PFN_vkCmdCopyImageToBuffer>("vkCmdCopyImageToBuffer")(commands, image, kCopied.layout,
                                                                 readback_.buffer(), 1, &copy);
  VkMemoryBarrier2 host = {};
  host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  host.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  host.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  VkDependencyInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &host;
  function<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(commands, &info);
}

void Target::fill(VkCommandBuffer commands, const VkRect2D& area, float color, float depth) {
  VkClearAttachment clears[2] = {};
  clears[0].aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
  for (float& channel : clears[0].clearValue.color.float32) channel = color;
  clears[1].aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
  clears[1].clearValue.depthStencil.depth = depth;
  const VkClearRect rect = {area, 0, 1};
  function<PFN_vkCmdClearAttachments>("vkCmdClearAttachments")(commands, 2, clears, 1, &rect);
}

Picture Target::draw(const std::function<bool(VkCommandBuffer)>& inside) {
  Picture picture;
  std::string error = "What was to be drawn was refused.";
  const bool ran = device_.run(
      [&](VkCommandBuffer commands) {
        begin(commands);
        const bool recorded = inside(commands);
        end(commands);
        return recorded;
      },
      &error);
  EXPECT_TRUE(ran) << error;
  if (!ran) return picture;
  picture.width = desc_.extent.width;
  picture.height = desc_.extent.height;
  picture.data.resize(size_t{4} * picture.width * picture.height);
  if (desc_.color == VK_FORMAT_R32G32B32A32_SFLOAT) {
    std::memcpy(picture.data.data(), readback_.data(), picture.data.size() * sizeof(float));
  } else {
    const auto* halves = static_cast<const uint16_t*>(readback_.data());
    for (size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = halfToFloat(halves[i]);
  }
  return picture;
}

}  // namespace alpenglow::testing
