#include "engine/barriers.h"

#include "engine/structure.h"

namespace alpenglow::engine {
namespace {

constexpr VkAccessFlags2 kWriteAccess =
    VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;

bool covers(const ImageState& state, const ImageState& part) {
  return (part.stage & ~state.stage) == 0 && (part.access & ~state.access) == 0;
}

VkImageMemoryBarrier2 barrierOf(VkImage image, VkImageLayout oldLayout, VkImageLayout newLayout,
                                const VkImageSubresourceRange& range) {
  auto barrier = structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
  barrier.oldLayout = oldLayout;
  barrier.newLayout = newLayout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = range;
  return barrier;
}

}  // namespace

bool writes(VkAccessFlags2 access) { return (access & kWriteAccess) != 0; }

VkImageMemoryBarrier2* Barriers::find(VkImage image) {
  for (uint32_t i = 0; i < imageCount_; ++i) {
    if (images_[i].image == image) return &images_[i];
  }
  return nullptr;
}

VkImageMemoryBarrier2* Barriers::add() {
  if (imageCount_ == kImageCapacity) {
    ++refused_;
    return nullptr;
  }
  return &images_[imageCount_++];
}

void Barriers::image(Image& image, const ImageState& after) { transition(image, after, false); }

void Barriers::discard(Image& image, const ImageState& after) { transition(image, after, true); }

void Barriers::transition(Image& image, const ImageState& after, bool discard) {
  const bool sameLayout = image.state.layout == after.layout;
  const bool reads = !writes(image.state.access) && !writes(after.access);

  // Nothing runs between two calls in one batch, so the merged barrier waits for the earlier
  // accesses, and only the target state changes.
  if (VkImageMemoryBarrier2* pending = find(image.handle)) {
    ImageState joined = after;
    if (sameLayout) {
      joined.stage |= image.state.stage;
      joined.access |= image.state.access;
    }
    pending->newLayout = joined.layout;
    pending->dstStageMask = joined.stage;
    pending->dstAccessMask = joined.access;
    if (discard) pending->oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    image.state = joined;
    image.writeStage = writes(joined.access) ? joined.stage : image.writeStage;
    image.writeAccess = writes(joined.access) ? joined.access & kWriteAccess : image.writeAccess;
    return;
  }
  if (sameLayout && reads && !discard && covers(image.state, after)) return;

  VkImageMemoryBarrier2* barrier = add();
  if (barrier == nullptr) return;
  *barrier = barrierOf(image.handle, discard ? VK_IMAGE_LAYOUT_UNDEFINED : image.state.layout,
                       after.layout, wholeImage(image));
  // The readers' stages are waited for too: after them comes their own barrier's layout change, and
  // a write must not overtake a read. What the last writer wrote is made available once more, which
  // costs nothing where it already is.
  barrier->srcStageMask = image.state.stage | image.writeStage;
  barrier->srcAccessMask = image.writeAccess;
  barrier->dstStageMask = after.stage;
  barrier->dstAccessMask = after.access;

  const bool alsoReaders = sameLayout && reads && !discard;
  const ImageState before = image.state;
  image.state = after;
  if (alsoReaders) {
    image.state.stage |= before.stage;
    image.state.access |= before.access;
  }
  if (writes(after.access)) {
    image.writeStage = after.stage;
    image.writeAccess = after.access & kWriteAccess;
  }
}

void Barriers::foreign(VkImage image, const ImageState& before, const ImageState& after,
                       const VkImageSubresourceRange& range) {
  VkImageMemoryBarrier2* barrier = add();
  if (barrier == nullptr) return;
  *barrier = barrierOf(image, before.layout, after.layout, range);
  barrier->srcStageMask = before.stage;
  barrier->srcAccessMask = before.access;
  barrier->dstStageMask = after.stage;
  barrier->dstAccessMask = after.access;
}

void Barriers::memory(VkPipelineStageFlags2 sourceStage, VkAccessFlags2 sourceAccess,
                      VkPipelineStageFlags2 destinationStage, VkAccessFlags2 destinationAccess) {
  memory_.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  memory_.srcStageMask |= sourceStage;
  memory_.srcAccessMask |= sourceAccess;
  memory_.dstStageMask |= destinationStage;
  memory_.dstAccessMask |= destinationAccess;
  hasMemory_ = true;
}

Status Barriers::record(const Device& device, VkCommandBuffer commandBuffer) {
  const uint32_t asked = imageCount_ + refused_;
  const bool fits = refused_ == 0;
  auto info = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.memoryBarrierCount = hasMemory_ ? 1 : 0;
  info.pMemoryBarriers = &memory_;
  info.imageMemoryBarrierCount = imageCount_;
  info.pImageMemoryBarriers = images_;
  if (fits && !empty()) device.vk().CmdPipelineBarrier2(commandBuffer, &info);
  imageCount_ = 0;
  refused_ = 0;
  memory_ = {};
  hasMemory_ = false;
  if (fits) return Status::Ok;
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "A batch of barriers has %u images, but at most %u are expected.", asked,
                     kImageCapacity);
}

Status assertLayout(const Device& device, const Image& image, VkImageLayout expected) {
  if (image.state.layout == expected) return Status::Ok;
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "Image \"%s\" is used in layout %s (%d) while it is in %s (%d).", image.name,
                     layoutName(expected), static_cast<int>(expected),
                     layoutName(image.state.layout), static_cast<int>(image.state.layout));
}

const char* layoutName(VkImageLayout layout) {
  switch (layout) {
    case VK_IMAGE_LAYOUT_UNDEFINED:
      return "VK_IMAGE_LAYOUT_UNDEFINED";
    case VK_IMAGE_LAYOUT_GENERAL:
      return "VK_IMAGE_LAYOUT_GENERAL";
    case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
      return "VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL";
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
      return "VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL";
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL:
      return "VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL";
    case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
      return "VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL";
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
      return "VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL";
    case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
      return "VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL";
    case VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL:
      return "VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL";
    case VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL:
      return "VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL";
    default:
      return "VkImageLayout";
  }
}

}  // namespace alpenglow::engine
