#include "atmosphere/passes/lut.h"

#include <cstring>

#include "engine/pipeline.h"

namespace alpenglow::passes {

Status Lut::make(const LutDesc& desc, const engine::Shader& shader,
                 const engine::SpecConstant* constants, uint32_t constantCount) {
  count_ = desc.count;
  constantBytes_ = desc.constantBytes;
  readable_ = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               desc.readers | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
               VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
  Status status = makeImages(desc);
  if (status == Status::Ok) status = makeSet(desc);
  if (status != Status::Ok) return status;
  const VkDescriptorSetLayout sets[] = {resources_.tableLayout(), setLayout_};
  const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, constantBytes_};
  status = engine::createPipelineLayout(device_, sets, 2, &range, 1, desc.name, &layout_);
  if (status != Status::Ok) return status;
  engine::ComputePipelineDesc pipeline;
  pipeline.shader = shader;
  pipeline.layout = layout_;
  pipeline.constants = constants;
  pipeline.constantCount = constantCount;
  return engine::createComputePipeline(device_, pipeline, &pipeline_);
}

Status Lut::makeImages(const LutDesc& desc) {
  engine::Image* images[kMostImages];
  for (uint32_t i = 0; i < count_; ++i) {
    engine::ImageDesc image;
    image.type = desc.type;
    image.format = tables::vulkanFormat(desc.format);
    image.extent = desc.extent;
    image.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    image.name = desc.name;
    images[i] = &images_[i];
    const Status made = engine::createImage(device_, image, images[i]);
    if (made != Status::Ok) return made;
  }
  return engine::allocateAndBind(device_, desc.name, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, images,
                                 count_, nullptr, 0, &block_);
}

Status Lut::makeSet(const LutDesc& desc) {
  VkDescriptorSetLayoutBinding bindings[kMostImages];
  for (uint32_t i = 0; i < desc.bindings; ++i)
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  Status status = engine::createSetLayout(device_, bindings, desc.bindings, desc.name, &setLayout_);
  if (status != Status::Ok) return status;
  const engine::PoolPart part = {bindings, desc.bindings, 1};
  status = engine::createPool(device_, &part, 1, desc.name, &pool_);
  if (status == Status::Ok)
    status = engine::allocateSets(device_, pool_, &setLayout_, 1, desc.name, &set_);
  if (status != Status::Ok) return status;
  engine::DescriptorWriter writer(set_);
  for (uint32_t i = 0; i < desc.bindings; ++i) writer.storageImage(i, image(i).view);
  return writer.flush(device_);
}

void Lut::destroy(uint64_t frame) {
  engine::DeletionQueue& deletions = device_.deletions();
  const auto defer = [&](VkObjectType type, auto handle) {
    deletions.defer(frame, type, engine::handleNumber(handle));
  };
  defer(VK_OBJECT_TYPE_PIPELINE, pipeline_);
  defer(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, setLayout_);
  for (engine::Image& image : images_) engine::deferImage(device_, frame, &image);
  engine::deferBlock(device_, frame, &block_);
}

bool Lut::current(const Tables& tables, const void* constants) const {
  return tablesId_ == tables.id() && std::memcmp(constants_, constants, constantBytes_) == 0;
}

Status Lut::record(VkCommandBuffer commands, const Tables& tables, const void* constants,
                   uint32_t groupsX, uint32_t groupsY) {
  if (current(tables, constants)) return Status::Ok;
  tablesId_ = 0;
  engine::Barriers barriers;
  for (uint32_t i = 0; i < count_; ++i) barriers.discard(images_[i], engine::kComputeWrite);
  Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  const engine::Dispatch& vk = device_.vk();
  const VkDescriptorSet sets[] = {tables.descriptorSet(), set_};
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 2, sets, 0,
                           nullptr);
  vk.CmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, constantBytes_, constants);
  vk.CmdDispatch(commands, groupsX, groupsY, 1);
  ++device_.counters().dispatches;
  for (uint32_t i = 0; i < count_; ++i) barriers.image(images_[i], readable_);
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  tablesId_ = tables.id();
  frame_ = device_.submitting();
  std::memcpy(constants_, constants, constantBytes_);
  return Status::Ok;
}

void Lut::abandon(uint64_t frame) {
  if (frame_ >= frame) tablesId_ = 0;
}

Status Lut::assertReadable() const {
  for (uint32_t i = 0; i < count_; ++i) {
    const Status status =
        engine::assertLayout(device_, images_[i], VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

uint64_t Lut::bytes() const {
  uint64_t sum = 0;
  for (const engine::Image& image : images_) sum += image.bytes;
  return sum;
}

}  // namespace alpenglow::passes
