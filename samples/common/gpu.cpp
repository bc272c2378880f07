#include "gpu.h"

#include <cstring>
#include <vector>

namespace alpenglow::samples {
namespace {

VkImageAspectFlags aspectOf(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

}  // namespace

void Gpu::check(VkResult result, const char* what) {
  if (result >= 0) return;
  throw Error(std::string(what) + " failed with VkResult " + std::to_string(result) + ".");
}

PFN_vkVoidFunction Gpu::require(const char* name) const {
  const PFN_vkVoidFunction found = device_->function(name);
  if (found == nullptr) throw Error(std::string("The driver lacks ") + name + ".");
  return found;
}

headless::Image Gpu::image(VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
                           uint32_t levels) const {
  std::string error;
  headless::Image image = device_->createImage(extent, format, usage, levels, &error);
  if (!error.empty()) throw Error(error);
  return image;
}

headless::HostBuffer Gpu::buffer(VkDeviceSize bytes, VkBufferUsageFlags usage,
                                 const void* data) const {
  std::string error;
  headless::HostBuffer buffer = device_->createHostBuffer(bytes, usage, &error);
  if (!error.empty()) throw Error(error);
  if (data != nullptr) std::memcpy(buffer.data(), data, bytes);
  return buffer;
}

headless::Image Gpu::upload(VkExtent2D extent, VkFormat format,
                            std::span<const std::span<const std::byte>> levels) const {
  VkDeviceSize bytes = 0;
  for (const auto& level : levels) bytes += level.size();
  const headless::HostBuffer staging = buffer(bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  std::vector<VkBufferImageCopy> copies;
  VkDeviceSize offset = 0;
  VkExtent3D size = {extent.width, extent.height, 1};
  for (const auto& level : levels) {
    std::memcpy(static_cast<std::byte*>(staging.data()) + offset, level.data(), level.size());
    VkBufferImageCopy copy = {};
    copy.bufferOffset = offset;
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, static_cast<uint32_t>(copies.size()), 0, 1};
    copy.imageExtent = size;
    copies.push_back(copy);
    offset += level.size();
    size.width = size.width > 1 ? size.width / 2 : 1;
    size.height = size.height > 1 ? size.height / 2 : 1;
  }
  const auto count = static_cast<uint32_t>(copies.size());
  headless::Image made =
      image(extent, format, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, count);
  run_("upload", [&](VkCommandBuffer commands) {
    barrier(commands, made, kUndefined, kCopyTarget);
    function<PFN_vkCmdCopyBufferToImage>("vkCmdCopyBufferToImage")(
        commands, staging.buffer(), made.image(), kCopyTarget.layout, count, copies.data());
    barrier(commands, made, kCopyTarget, kSampled);
  });
  return made;
}

headless::Image Gpu::texture(const io::AlbedoMap& map) const {
  std::vector<std::span<const std::byte>> levels;
  for (const io::AlbedoMap::Level& level : map.levels)
    levels.push_back(std::as_bytes(std::span(level.rgba)));
  return upload({map.levels[0].width, map.levels[0].height}, VK_FORMAT_R8G8B8A8_SRGB, levels);
}

headless::Image Gpu::texel(const float rgba[4]) const {
  const std::span<const std::byte> level = std::as_bytes(std::span(rgba, 4));
  return upload({1, 1}, VK_FORMAT_R32G32B32A32_SFLOAT, {&level, 1});
}

Owned<VkSampler> Gpu::sampler(VkSamplerAddressMode modeU) const {
  VkSamplerCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = VK_FILTER_LINEAR;
  info.minFilter = VK_FILTER_LINEAR;
  info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  info.addressModeU = modeU;
  info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.maxLod = VK_LOD_CLAMP_NONE;
  VkSampler made = VK_NULL_HANDLE;
  check(function<PFN_vkCreateSampler>("vkCreateSampler")(device_->device(), &info, nullptr, &made),
        "vkCreateSampler");
  return {*device_, "vkDestroySampler", made};
}

Owned<VkDescriptorSetLayout> Gpu::setLayout(
    std::span<const VkDescriptorSetLayoutBinding> bindings) const {
  VkDescriptorSetLayoutCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = static_cast<uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  VkDescriptorSetLayout made = VK_NULL_HANDLE;
  check(function<PFN_vkCreateDescriptorSetLayout>("vkCreateDescriptorSetLayout")(
            device_->device(), &info, nullptr, &made),
        "vkCreateDescriptorSetLayout");
  return {*device_, "vkDestroyDescriptorSetLayout", made};
}

Owned<VkPipelineLayout> Gpu::pipelineLayout(std::span<const VkDescriptorSetLayout> sets,
                                            const VkPushConstantRange& push) const {
  VkPipelineLayoutCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = static_cast<uint32_t>(sets.size());
  info.pSetLayouts = sets.data();
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &push;
  VkPipelineLayout made = VK_NULL_HANDLE;
  check(function<PFN_vkCreatePipelineLayout>("vkCreatePipelineLayout")(device_->device(), &info,
                                                                       nullptr, &made),
        "vkCreatePipelineLayout");
  return {*device_, "vkDestroyPipelineLayout", made};
}

void Gpu::render(VkCommandBuffer commands, const headless::Image& target, const VkRect2D& area,
                 VkAttachmentLoadOp load, const VkRenderingAttachmentInfo* depth,
                 const std::function<void()>& record) const {
  VkRenderingAttachmentInfo color = {};
  color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  color.imageView = target.view();
  color.imageLayout = kColorDrawn.layout;
  color.loadOp = load;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo rendering = {};
  rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  rendering.renderArea = area;
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  rendering.pDepthAttachment = depth;
  function<PFN_vkCmdBeginRendering>("vkCmdBeginRendering")(commands, &rendering);
  record();
  function<PFN_vkCmdEndRendering>("vkCmdEndRendering")(commands);
}

void Gpu::barrier(VkCommandBuffer commands, const headless::Image& image, const ImageState& from,
                  const ImageState& to) const {
  VkImageMemoryBarrier2 barrier = {};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = from.stage;
  barrier.srcAccessMask = from.access;
  barrier.dstStageMask = to.stage;
  barrier.dstAccessMask = to.access;
  barrier.oldLayout = from.layout;
  barrier.newLayout = to.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.image();
  barrier.subresourceRange = {aspectOf(image.format()), 0, image.levels(), 0, 1};
  VkDependencyInfo dependency = {};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  function<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(commands, &dependency);
}

void Gpu::barrier(VkCommandBuffer commands, const ImageState& from, const ImageState& to) const {
  VkMemoryBarrier2 barrier = {};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = from.stage;
  barrier.srcAccessMask = from.access;
  barrier.dstStageMask = to.stage;
  barrier.dstAccessMask = to.access;
  VkDependencyInfo dependency = {};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &barrier;
  function<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(commands, &dependency);
}

}  // namespace alpenglow::samples
