#include "picture.h"

#include <alpenglow/shaders/view_tone.h>
#include <alpenglow/shaders/view_tone_vertex.h>

#include <cstring>

namespace alpenglow::view {
namespace {

using samples::Gpu;
using samples::ImageState;

constexpr VkExtent2D kSmall = {96, 54};
constexpr VkImageUsageFlags kCopied =
    VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
    VK_IMAGE_USAGE_SAMPLED_BIT;  // Never, but every image has a view.
constexpr ImageState kShown = {
    samples::kSampled.layout,
    samples::kSampled.stage | VK_PIPELINE_STAGE_2_BLIT_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
    samples::kSampled.access | VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr ImageState kBlitSource = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                    VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr ImageState kBlitTarget = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                    VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr ImageState kHostRead = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_HOST_BIT,
                                  VK_ACCESS_2_HOST_READ_BIT};
constexpr VkImageSubresourceLayers kColor = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

struct TonePush {
  float factor[4];
  float texture[4];
};
constexpr VkPushConstantRange kPush = {VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(TonePush)};

io::LinearImage imageOf(const headless::HostBuffer& texels, VkExtent2D size) {
  const size_t pixels = size_t{size.width} * size.height;
  io::LinearImage image{size.width, size.height, std::vector<float>(pixels * 3)};
  const float* rgba = static_cast<const float*>(texels.data());
  for (size_t i = 0; i < pixels; ++i) {
    std::memcpy(&image.pixels[i * 3], rgba + i * 4, 3 * sizeof(float));
  }
  return image;
}

VkDeviceSize bytesOf(VkExtent2D size) { return VkDeviceSize{16} * size.width * size.height; }

}  // namespace

Picture::Picture(const Gpu* gpu, const Presenter* presenter, VkExtent2D size)
    : gpu_(gpu), vk_(*gpu) {
  target_ = gpu->image(size, kRadianceFormat,
                       VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                           VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                       1);
  for (Measure& measure : measures_) {
    measure.small = gpu->image(kSmall, kRadianceFormat, kCopied, 1);
    measure.texels = gpu->buffer(bytesOf(kSmall), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  }
  sampler_ = gpu->sampler(VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
  makeSet();
  const VkDescriptorSetLayout set = setLayout_.get();
  layout_ = gpu->pipelineLayout({&set, 1}, kPush);
  samples::PipelineDesc desc;
  desc.vertex = shaders::kViewToneVertex;
  desc.fragment = shaders::kViewTone;
  desc.layout = layout_.get();
  desc.color = kRadianceFormat;  // There is one; its format is the pass's.
  desc.renderPass = presenter->renderPass();
  pipeline_ = gpu->pipeline(desc);
}

void Picture::makeSet() {
  const VkDevice device = gpu_->device().device();
  const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                                VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
  setLayout_ = gpu_->setLayout({&binding, 1});
  const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
  const VkDescriptorPoolCreateInfo pool = {
      VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, 1, 1, &size};
  pool_ = make<VkDescriptorPool>(*gpu_, vk_.CreateDescriptorPool, pool, "vkDestroyDescriptorPool");
  const VkDescriptorSetLayout layout = setLayout_.get();
  const VkDescriptorSetAllocateInfo set = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr,
                                           pool_.get(), 1, &layout};
  Gpu::check(vk_.AllocateDescriptorSets(device, &set, &set_), "vkAllocateDescriptorSets");
  const VkDescriptorImageInfo image = {sampler_.get(), target_.view(), kShown.layout};
  VkWriteDescriptorSet write = {};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  write.pImageInfo = &image;
  vk_.UpdateDescriptorSets(device, 1, &write, 0, nullptr);
}

void Picture::beginDrawing(VkCommandBuffer commands) const {
  gpu_->barrier(commands, target_, {VK_IMAGE_LAYOUT_UNDEFINED, kShown.stage, VK_ACCESS_2_NONE},
                samples::kColorDrawn);
}

void Picture::endDrawing(VkCommandBuffer commands) const {
  gpu_->barrier(commands, target_, samples::kColorDrawn, kShown);
}

void Picture::measure(const Frame& frame, VkExtent2D drawn) {
  Measure& measure = measures_[frame.slot];
  gpu_->barrier(frame.commands, target_, kShown, kBlitSource);
  gpu_->barrier(frame.commands, measure.small,
                {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_NONE},
                kBlitTarget);
  VkImageBlit blit = {};
  blit.srcSubresource = blit.dstSubresource = kColor;
  blit.srcOffsets[1] = {static_cast<int>(drawn.width), static_cast<int>(drawn.height), 1};
  blit.dstOffsets[1] = {static_cast<int>(kSmall.width), static_cast<int>(kSmall.height), 1};
  vk_.CmdBlitImage(frame.commands, target_.image(), kBlitSource.layout, measure.small.image(),
                   kBlitTarget.layout, 1, &blit, VK_FILTER_NEAREST);
  gpu_->barrier(frame.commands, target_, kBlitSource, kShown);
  gpu_->barrier(frame.commands, measure.small, kBlitTarget, samples::kCopySource);
  VkBufferImageCopy copy = {};
  copy.imageSubresource = kColor;
  copy.imageExtent = {kSmall.width, kSmall.height, 1};
  vk_.CmdCopyImageToBuffer(frame.commands, measure.small.image(), samples::kCopySource.layout,
                           measure.texels.buffer(), 1, &copy);
  gpu_->barrier(frame.commands, samples::kCopyTarget, kHostRead);
  measure.written = true;
}

std::optional<double> Picture::measured(const Frame& frame) {
  Measure& measure = measures_[frame.slot];
  if (!std::exchange(measure.written, false)) return std::nullopt;
  return io::automaticExposure(imageOf(measure.texels, kSmall));
}

void Picture::show(const Frame& frame, VkExtent2D drawn, const Tone& tone) const {
  const auto narrow = [](double value) { return static_cast<float>(value); };
  const VkExtent2D size = target_.extent();
  const double width = drawn.width, height = drawn.height;
  TonePush push = {};
  for (int i = 0; i < 3; ++i) push.factor[i] = narrow(tone.exposure) * tone.balance[i];
  push.factor[3] = static_cast<float>(tone.map);
  push.texture[0] = narrow(width / size.width / frame.size.width);
  push.texture[1] = narrow(height / size.height / frame.size.height);
  push.texture[2] = narrow((width - 0.5) / size.width);
  push.texture[3] = narrow((height - 0.5) / size.height);
  const VkViewport viewport = {0.0f, 0.0f, narrow(frame.size.width), narrow(frame.size.height),
                               0.0f, 1.0f};
  const VkRect2D scissor = {{0, 0}, frame.size};
  vk_.CmdSetViewport(frame.commands, 0, 1, &viewport);
  vk_.CmdSetScissor(frame.commands, 0, 1, &scissor);
  vk_.CmdBindPipeline(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
  vk_.CmdBindDescriptorSets(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1,
                            &set_, 0, nullptr);
  vk_.CmdPushConstants(frame.commands, layout_.get(), kPush.stageFlags, 0, sizeof push, &push);
  vk_.CmdDraw(frame.commands, 3, 1, 0, 0);
}

io::LinearImage Picture::read(VkExtent2D drawn) const {
  gpu_->device().waitIdle();
  const headless::HostBuffer texels =
      gpu_->buffer(bytesOf(drawn), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  gpu_->run("readback", [&](VkCommandBuffer commands) {
    gpu_->barrier(commands, target_, kShown, samples::kCopySource);
    VkBufferImageCopy copy = {};
    copy.imageSubresource = kColor;
    copy.imageExtent = {drawn.width, drawn.height, 1};
    vk_.CmdCopyImageToBuffer(commands, target_.image(), samples::kCopySource.layout,
                             texels.buffer(), 1, &copy);
    gpu_->barrier(commands, samples::kCopyTarget, kHostRead);
    gpu_->barrier(commands, target_, samples::kCopySource, kShown);
  });
  return imageOf(texels, drawn);
}

}  // namespace alpenglow::view
