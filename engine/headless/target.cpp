#include <alpenglow/headless_target.h>

#include <cmath>
#include <cstring>

#include "engine/headless/instance.h"
#include "engine/structure.h"

namespace alpenglow::headless {
namespace {

using engine::structure;

constexpr ImageState kDepth = {VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kDepthDrawn.stage,
                               kDepthDrawn.access};
constexpr VkImageLayout kRenderPassDepth = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

float halfToFloat(uint16_t half) {
  const int sign = half >> 15, exponent = half >> 10 & 31, mantissa = half & 1023;
  double value =
      exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  if (exponent == 31) value = mantissa != 0 ? NAN : INFINITY;
  return static_cast<float>(sign != 0 ? -value : value);
}

}  // namespace

std::unique_ptr<Target> Target::create(Device& device, const TargetDesc& desc, std::string* error) {
  std::unique_ptr<Target> target(new Target(device, desc));
  return target->make(error) ? std::move(target) : nullptr;
}

bool Target::make(std::string* error) {
  const VkImageUsageFlags readable =
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  color_ = device_.createImage(desc_.extent, desc_.color, readable, 1, error, desc_.samples);
  if (color_.view() == VK_NULL_HANDLE) return false;
  if (multisampled()) {
    resolved_ = device_.createImage(desc_.extent, desc_.color, readable, 1, error);
    if (resolved_.view() == VK_NULL_HANDLE) return false;
  }
  if (desc_.depth != VK_FORMAT_UNDEFINED) {
    depth_ =
        device_.createImage(desc_.extent, desc_.depth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                            1, error, desc_.samples);
    if (depth_.view() == VK_NULL_HANDLE) return false;
  }
  if (desc_.renderPass && !makeRenderPass(error)) return false;
  readback_ = device_.createHostBuffer(VkDeviceSize{16} * desc_.extent.width * desc_.extent.height,
                                       VK_BUFFER_USAGE_TRANSFER_DST_BIT, error);
  return readback_.data() != nullptr;
}

Target::~Target() {
  const VkDevice device = device_.device();
  function<PFN_vkDestroyFramebuffer>("vkDestroyFramebuffer")(device, framebuffer_, nullptr);
  function<PFN_vkDestroyRenderPass>("vkDestroyRenderPass")(device, renderPass_, nullptr);
}

bool Target::makeRenderPass(std::string* error) {
  VkAttachmentDescription attachments[2] = {};
  attachments[0].format = desc_.color;
  attachments[0].samples = desc_.samples;
  attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachments[0].initialLayout = attachments[0].finalLayout = kColorDrawn.layout;
  attachments[1] = attachments[0];
  attachments[1].format = desc_.depth;
  attachments[1].initialLayout = attachments[1].finalLayout = kRenderPassDepth;
  const VkAttachmentReference colorReference = {0, kColorDrawn.layout};
  const VkAttachmentReference depthReference = {1, kRenderPassDepth};
  const bool hasDepth = desc_.depth != VK_FORMAT_UNDEFINED;
  VkSubpassDescription subpass = {};
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &colorReference;
  subpass.pDepthStencilAttachment = hasDepth ? &depthReference : nullptr;
  auto info = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  info.attachmentCount = hasDepth ? 2 : 1;
  info.pAttachments = attachments;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  VkResult result = function<PFN_vkCreateRenderPass>("vkCreateRenderPass")(device_.device(), &info,
                                                                           nullptr, &renderPass_);
  if (result < 0) {
    renderPass_ = VK_NULL_HANDLE;
    return setError(error, resultSentence("vkCreateRenderPass", result));
  }
  const VkImageView views[2] = {color_.view(), depth_.view()};
  auto framebuffer = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  framebuffer.renderPass = renderPass_;
  framebuffer.attachmentCount = info.attachmentCount;
  framebuffer.pAttachments = views;
  framebuffer.width = desc_.extent.width;
  framebuffer.height = desc_.extent.height;
  framebuffer.layers = 1;
  result = function<PFN_vkCreateFramebuffer>("vkCreateFramebuffer")(device_.device(), &framebuffer,
                                                                    nullptr, &framebuffer_);
  if (result >= 0) return true;
  framebuffer_ = VK_NULL_HANDLE;
  return setError(error, resultSentence("vkCreateFramebuffer", result));
}

void Target::barrier(VkCommandBuffer commands, const Image& image, VkImageAspectFlags aspect,
                     const ImageState& before, const ImageState& after) {
  auto one = structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
  one.srcStageMask = before.stage;
  one.srcAccessMask = before.access;
  one.dstStageMask = after.stage;
  one.dstAccessMask = after.access;
  one.oldLayout = before.layout;
  one.newLayout = after.layout;
  one.srcQueueFamilyIndex = one.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  one.image = image.image();
  one.subresourceRange = {aspect, 0, 1, 0, 1};
  auto info = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &one;
  function<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(commands, &info);
}

void Target::prepare(VkCommandBuffer commands) {
  // A copy of this queue may still read what is drawn over now.
  ImageState before = kUndefined;
  before.stage = kColorDrawn.stage | kCopySource.stage;
  barrier(commands, color_, VK_IMAGE_ASPECT_COLOR_BIT, before, kColorDrawn);
  if (multisampled()) barrier(commands, resolved_, VK_IMAGE_ASPECT_COLOR_BIT, before, kColorDrawn);
  if (depth_.image() == VK_NULL_HANDLE) return;
  ImageState depth = kDepth;
  if (desc_.renderPass) depth.layout = kRenderPassDepth;
  before.stage = kDepth.stage;
  barrier(commands, depth_, VK_IMAGE_ASPECT_DEPTH_BIT, before, depth);
}

void Target::beginRenderPass(VkCommandBuffer commands, const VkRect2D& area,
                             const TargetClear& clear) {
  VkClearValue values[2] = {};
  for (float& channel : values[0].color.float32) channel = clear.color;
  values[1].depthStencil.depth = clear.depth;
  auto info = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
  info.renderPass = renderPass_;
  info.framebuffer = framebuffer_;
  info.renderArea = area;
  info.clearValueCount = 2;
  info.pClearValues = values;
  function<PFN_vkCmdBeginRenderPass>("vkCmdBeginRenderPass")(commands, &info,
                                                             VK_SUBPASS_CONTENTS_INLINE);
}

void Target::begin(VkCommandBuffer commands, const VkRect2D& area, VkAttachmentLoadOp load,
                   const TargetClear& clear) {
  if (desc_.renderPass) {
    beginRenderPass(commands, area, clear);
    return;
  }
  auto color = structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  color.imageView = color_.view();
  color.imageLayout = kColorDrawn.layout;
  color.loadOp = load;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  auto depth = color;
  for (float& channel : color.clearValue.color.float32) channel = clear.color;
  if (multisampled()) {
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = resolved_.view();
    color.resolveImageLayout = kColorDrawn.layout;
  }
  depth.imageView = depth_.view();
  depth.imageLayout = kDepth.layout;
  depth.clearValue.depthStencil.depth = clear.depth;
  auto info = structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  info.renderArea = area;
  info.layerCount = 1;
  info.colorAttachmentCount = 1;
  info.pColorAttachments = &color;
  info.pDepthAttachment = depth_.image() != VK_NULL_HANDLE ? &depth : nullptr;
  function<PFN_vkCmdBeginRendering>("vkCmdBeginRendering")(commands, &info);
}

void Target::end(VkCommandBuffer commands) {
  if (desc_.renderPass) {
    function<PFN_vkCmdEndRenderPass>("vkCmdEndRenderPass")(commands);
  } else {
    function<PFN_vkCmdEndRendering>("vkCmdEndRendering")(commands);
  }
}

void Target::copy(VkCommandBuffer commands, VkExtent2D size) {
  const Image& image = multisampled() ? resolved_ : color_;
  barrier(commands, image, VK_IMAGE_ASPECT_COLOR_BIT, kColorDrawn, kCopySource);
  VkBufferImageCopy copy = {};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {size.width, size.height, 1};
  function<PFN_vkCmdCopyImageToBuffer>("vkCmdCopyImageToBuffer")(
      commands, image.image(), kCopySource.layout, readback_.buffer(), 1, &copy);
  auto host = structure<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  host.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  host.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  auto info = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &host;
  function<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(commands, &info);
}

std::vector<float> Target::pixels(VkExtent2D size) const {
  std::vector<float> rgba(size_t{4} * size.width * size.height);
  if (desc_.color == VK_FORMAT_R32G32B32A32_SFLOAT) {
    std::memcpy(rgba.data(), readback_.data(), rgba.size() * sizeof(float));
  } else {
    const auto* halves = static_cast<const uint16_t*>(readback_.data());
    for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = halfToFloat(halves[i]);
  }
  return rgba;
}

}  // namespace alpenglow::headless
