#include "atmosphere/tables/table_set.h"

#include <cstring>
#include <new>

#include "engine/exceptions.h"

namespace alpenglow {
inline namespace v1_0 {

Tables::Tables(tables::Resources& resources, const Parameters& parameters, const TableDesc& desc,
               bool bakes)
    : FrameObject(resources.device().frames()),
      resources_(resources),
      device_(resources.device()),
      id_(resources.nextTablesId()),
      parameters_(parameters),
      desc_(desc),
      bakes_(bakes) {}

Status Tables::create(tables::Resources& resources, const Parameters& parameters,
                      const TableDesc& desc, MakeGraph graph, bool bakes, Tables** out) {
  *out = nullptr;
  engine::Device& device = resources.device();
  auto* tables = new (std::nothrow) Tables(resources, parameters, desc, bakes);
  if (tables == nullptr) {
    return device.fail(Status::OutOfHostMemory, VK_SUCCESS, "Tables found no host memory.");
  }
  Status status = Status::Ok;
  ALPENGLOW_TRY {
    tables->graph_ = graph(parameters, desc, tables::finestFormat(device, desc.format));
    for (const tables::Pass& pass : tables->graph_.passes) {
      const tables::Stage& stage = tables->graph_.stages[pass.stage];
      tables->unitsTotal_ += stage.unitsPerRow() * stage.rows;
    }
    status = tables->makeImages();
    if (status == Status::Ok) status = tables->makeUniforms();
    if (status == Status::Ok) status = tables->makeHostCopies();
    if (status == Status::Ok) status = tables->makeDescriptors();
    if (status == Status::Ok && bakes) status = tables->makePipelines();
  }
  ALPENGLOW_CATCH_BAD_ALLOC {  // No exception may reach the host.
    status = device.fail(Status::OutOfHostMemory, VK_SUCCESS, "Tables found no host memory.");
  }
  if (status != Status::Ok) {
    destroy(tables, 0);  // Nothing was recorded with them: frame 0 has always completed.
    return status;
  }
  *out = tables;
  return Status::Ok;
}

void Tables::destroy(Tables* tables, uint64_t frame) {
  if (tables == nullptr) return;
  engine::Device& device = tables->device_;
  device.deletions().defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_POOL,
                           engine::handleNumber(tables->pool_));
  for (engine::Image& image : tables->images_) engine::deferImage(device, frame, &image);
  engine::deferBuffer(device, frame, &tables->uniforms_);
  for (engine::Buffer& copy : tables->hostCopies_) engine::deferBuffer(device, frame, &copy);
  for (engine::MemoryBlock* block : {&tables->persistentBlock_, &tables->scratchBlock_,
                                     &tables->uniformBlock_, &tables->hostBlock_})
    engine::deferBlock(device, frame, block);
  device.frames().announceDestruction(tables);
  delete tables;
  device.deletions().collect(device.completed());
}

Status Tables::makeImages() {
  std::vector<engine::Image*> persistent, scratch;
  images_.resize(graph_.images.size());
  imagesBefore_.resize(images_.size());  // So that recording allocates nothing.
  for (size_t i = 0; i < images_.size(); ++i) {
    const tables::BakeImage& graph = graph_.images[i];
    if (!bakes_ && !graph.persistent) continue;
    engine::ImageDesc desc;
    desc.type = graph.type;
    desc.format = graph.format;
    desc.extent = graph.extent;
    desc.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    desc.linearFilter = graph.filtered;
    desc.name = graph.name;
    (graph.persistent ? persistent : scratch).push_back(&images_[i]);
    const Status status = engine::createImage(device_, desc, &images_[i]);
    if (status != Status::Ok) return status;
  }
  const auto allocate = [this](const char* name, const std::vector<engine::Image*>& images,
                               engine::MemoryBlock* block) {
    return engine::allocateAndBind(device_, name, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                   images.data(), static_cast<uint32_t>(images.size()), nullptr, 0,
                                   block);
  };
  const Status status = allocate("Alpenglow tables", persistent, &persistentBlock_);
  if (status != Status::Ok || scratch.empty()) return status;
  return allocate("Alpenglow bake scratch", scratch, &scratchBlock_);
}

Status Tables::makeUniforms() {
  Status status =
      engine::createBuffer(device_, graph_.uniforms.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                           "Alpenglow parameters", &uniforms_);
  if (status != Status::Ok) return status;
  engine::Buffer* buffers[] = {&uniforms_};
  status = engine::allocateAndBind(
      device_, "Alpenglow parameters",
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, nullptr, 0,
      buffers, 1, &uniformBlock_);
  if (status != Status::Ok) return status;
  std::memcpy(uniforms_.mapped, graph_.uniforms.data(), graph_.uniforms.size());
  return Status::Ok;
}

namespace {

// Reads of memory that is not cached are slow; where there is none that is, they are correct still.
VkMemoryPropertyFlags hostMemory(const engine::Device& device) {
  constexpr VkMemoryPropertyFlags kMapped =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  constexpr VkMemoryPropertyFlags kCached = kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  const VkPhysicalDeviceMemoryProperties& memory = device.memoryProperties();
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((memory.memoryTypes[i].propertyFlags & kCached) == kCached) return kCached;
  return kMapped;
}

}  // namespace

Status Tables::makeHostCopies() {
  if (desc_.cpuQueries == CpuQueries::None) return Status::Ok;
  std::vector<engine::Buffer*> buffers;
  for (const TableId id : {kTableOpticalDepth, kTableMoments, kTableSource}) {
    if (id == kTableSource && desc_.cpuQueries != CpuQueries::All) continue;
    const uint32_t image = imageOf(id);
    if (image == tables::kNoImage) continue;  // Effects that are left out.
    const Status status = engine::createBuffer(device_, tables::bytesOf(graph_.images[image]),
                                               VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                               "Alpenglow CPU queries", &hostCopies_[id]);
    if (status != Status::Ok) return status;
    buffers.push_back(&hostCopies_[id]);
  }
  return engine::allocateAndBind(device_, "Alpenglow CPU queries", hostMemory(device_), nullptr, 0,
                                 buffers.data(), static_cast<uint32_t>(buffers.size()),
                                 &hostBlock_);
}

Status Tables::makeDescriptors() {
  const auto count = static_cast<uint32_t>(bakes_ ? graph_.stages.size() : 0);
  const engine::PoolPart parts[] = {
      {tables::Resources::tableLayoutBindings(), tables::kTableBindings, 1},
      {tables::Resources::inputLayoutBindings(), tables::kInputBindings, count},
      {tables::Resources::outputLayoutBindings(), tables::kMaxOutputs, count}};
  Status status = engine::createPool(device_, parts, bakes_ ? 3 : 1, "Alpenglow tables", &pool_);
  if (status != Status::Ok) return status;
  std::vector<VkDescriptorSetLayout> layouts = {resources_.tableLayout()};
  for (uint32_t i = 0; i < count; ++i)
    layouts.insert(layouts.end(), {resources_.inputLayout(), resources_.outputLayout()});
  std::vector<VkDescriptorSet> sets(layouts.size());
  status =
      engine::allocateSets(device_, pool_, layouts.data(), static_cast<uint32_t>(layouts.size()),
                           "Alpenglow tables", sets.data());
  if (status != Status::Ok) return status;
  tableSet_ = sets[0];
  stages_.resize(count);
  status = writeTableSet();
  for (uint32_t i = 0; i < count && status == Status::Ok; ++i) {
    stages_[i].inputs = sets[1 + 2 * i];
    stages_[i].outputs = sets[2 + 2 * i];
    status = writeStageSets(i);
  }
  return status;
}

void Tables::writeSampled(engine::DescriptorWriter* writer, uint32_t binding,
                          uint32_t image) const {
  writer->sampledImage(
      binding, images_[image].view,
      graph_.images[image].filtered ? resources_.sampler() : resources_.nearestSampler());
}

Status Tables::writeTableSet() {
  engine::DescriptorWriter writer(tableSet_);
  writer.uniformBuffer(0, uniforms_.handle);
  for (uint32_t i = 0; i < tables::kBoundTables; ++i) writeSampled(&writer, 1 + i, graph_.bound[i]);
  return writer.flush(device_);
}

Status Tables::writeStageSets(uint32_t stage) {
  const tables::Stage& graph = graph_.stages[stage];
  engine::DescriptorWriter inputs(stages_[stage].inputs);
  inputs.uniformBuffer(0, uniforms_.handle);
  uint32_t images[tables::kMaxInputs];
  // Bindings that the stage doesn't use are written all the same: lavapipe 22.3 crashes when a
  // bound set has a sampled image that never was.
  for (uint32_t& image : images) image = graph_.bound[0];
  for (const tables::StageInput& input : graph.inputs) images[input.binding - 1] = input.image;
  for (uint32_t i = 0; i < tables::kMaxInputs; ++i) writeSampled(&inputs, 1 + i, images[i]);
  const Status status = inputs.flush(device_);
  if (status != Status::Ok) return status;
  engine::DescriptorWriter outputs(stages_[stage].outputs);
  for (uint32_t i = 0; i < graph.outputs.size(); ++i)
    outputs.storageImage(i, images_[graph.outputs[i].image].view);
  return outputs.flush(device_);
}

Status Tables::makePipelines() {
  for (size_t i = 0; i < stages_.size(); ++i) {
    const Status status = resources_.pipeline(graph_.stages[i], &stages_[i].pipeline);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

}  // namespace v1_0
}  // namespace alpenglow
