#include "atmosphere/bake/table_set.h"

#include <cstring>
#include <new>

namespace alpenglow {
namespace bake {
namespace {

Status checkSize(const engine::Device& device, const char* name, uint32_t value, uint32_t least,
                 uint32_t most) {
  if (value >= least && value <= most) return Status::Ok;
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "The table size %s is %u, but must be from %u to %u.", name, value, least,
                     most);
}

}  // namespace

TableDesc completed(const TableDesc& desc) {
  TableDesc full = desc;
  const TableSizes defaults = defaultTableSizes();
  const uint32_t* from = &defaults.transmittanceMu;
  uint32_t* to = &full.sizes.transmittanceMu;
  static_assert(sizeof(TableSizes) % sizeof(uint32_t) == 0);
  for (size_t i = 0; i < sizeof(TableSizes) / sizeof(uint32_t); ++i)
    if (to[i] == 0) to[i] = from[i];
  if (full.orders == 0) full.orders = 5;
  return full;
}

Status checkTableDesc(const engine::Device& device, const TableDesc& desc) {
  const TableSizes& s = desc.sizes;
  if (desc.solver != Solver::Standard || desc.format > TableFormat::Float ||
      desc.mie > MieStorage::Packed) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "TableDesc has solver %u, format %u and mie %u, but these enumerations "
                       "end at %u, %u and %u.",
                       static_cast<uint32_t>(desc.solver), static_cast<uint32_t>(desc.format),
                       static_cast<uint32_t>(desc.mie), 0u, 1u, 1u);
  }
  if (desc.orders > kMaxOrders) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "TableDesc::orders is %u, but must be from 1 to %u, or 0 for the default.",
                       desc.orders, kMaxOrders);
  }
  const uint32_t most2D = device.limits().maxImageDimension2D;
  const uint32_t most3D = device.limits().maxImageDimension3D;
  const struct {
    const char* name;
    uint32_t value, least, most;
  } sizes[] = {{"transmittanceMu", s.transmittanceMu, 2, most2D},
               {"transmittanceR", s.transmittanceR, 2, most2D},
               {"irradianceMuS", s.irradianceMuS, 2, most2D},
               {"irradianceR", s.irradianceR, 2, most2D},
               {"scatteringR", s.scatteringR, 2, most3D},
               {"scatteringMu", s.scatteringMu, 4, most3D},
               {"scatteringMuS", s.scatteringMuS, 2, most3D},
               {"scatteringNu", s.scatteringNu, 2, most3D}};
  for (const auto& size : sizes) {
    const Status status = checkSize(device, size.name, size.value, size.least, size.most);
    if (status != Status::Ok) return status;
  }
  if (s.scatteringMu % 2 != 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The table size scatteringMu is %u, but must be even: half of its texels "
                       "look at the ground, half at the sky.",
                       s.scatteringMu);
  }
  if (uint64_t(s.scatteringMuS) * s.scatteringNu > most3D) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The table sizes scatteringMuS %u times scatteringNu %u are %llu texels "
                       "side by side, but this device's 3D images end at %u.",
                       s.scatteringMuS, s.scatteringNu,
                       static_cast<unsigned long long>(uint64_t(s.scatteringMuS) * s.scatteringNu),
                       most3D);
  }
  const uint64_t side = uint64_t(s.scatteringMuS) * s.scatteringR;
  if (side > most2D) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The table sizes scatteringMuS %u times scatteringR %u are %llu rows of a "
                       "bake, but this device's 2D images end at %u.",
                       s.scatteringMuS, s.scatteringR, static_cast<unsigned long long>(side),
                       most2D);
  }
  return Status::Ok;
}

}  // namespace bake

inline namespace v1 {

using bake::kNoImage;

Tables::Tables(bake::Resources& resources, const Parameters& parameters, const TableDesc& desc,
               bool bakes)
    : resources_(resources),
      device_(resources.device()),
      id_(++resources.tablesMade),
      parameters_(parameters),
      desc_(desc),
      bakes_(bakes) {}

Status Tables::create(bake::Resources& resources, const Parameters& parameters,
                      const TableDesc& desc, bool bakes, Tables** out) {
  *out = nullptr;
  engine::Device& device = resources.device();
  auto* tables = new (std::nothrow) Tables(resources, parameters, desc, bakes);
  if (tables == nullptr) {
    return device.fail(Status::OutOfHostMemory, VK_SUCCESS, "Tables found no host memory.");
  }
  ++resources.liveTables;
  Status status = Status::Ok;
  try {
    tables->passes_ = bake::standardPasses(desc.sizes, desc.orders);
    for (const bake::Pass& pass : tables->passes_)
      tables->unitsTotal_ += pass.unitsPerRow * pass.rows;
    status = tables->makeImages();
    if (status == Status::Ok) status = tables->makeUniforms();
    if (status == Status::Ok) status = tables->makeDescriptors();
    if (status == Status::Ok && bakes) status = tables->makePipelines();
  } catch (const std::bad_alloc&) {  // No exception may reach the host.
    status = device.fail(Status::OutOfHostMemory, VK_SUCCESS, "Tables found no host memory.");
  }
  if (status != Status::Ok) {
    destroy(tables, FrameInfo{});  // Nothing was recorded with them: frame 0 has always completed.
    return status;
  }
  *out = tables;
  return Status::Ok;
}

void Tables::destroy(Tables* tables, const FrameInfo& frame) {
  if (tables == nullptr) return;
  --tables->resources_.liveTables;
  engine::Device& device = tables->device_;
  device.deletions().defer(frame.submitting, VK_OBJECT_TYPE_DESCRIPTOR_POOL,
                           engine::handleNumber(tables->pool_));
  for (engine::Image& image : tables->images_) engine::deferImage(device, frame.submitting, &image);
  engine::deferBuffer(device, frame.submitting, &tables->uniforms_);
  for (engine::MemoryBlock* block :
       {&tables->persistentBlock_, &tables->scratchBlock_, &tables->uniformBlock_})
    engine::deferBlock(device, frame.submitting, block);
  delete tables;
  device.deletions().collect(frame.completed);
}

bool Tables::persistent(uint32_t image) const {
  return image == bake::kOpticalDepth || image == bake::kIrradiance || image == bake::kScattering ||
         (image == bake::kDeltaMie && desc_.mie == MieStorage::Full);
}

Status Tables::makeImages() {
  static constexpr const char* kNames[bake::kImageCount] = {
      "Alpenglow T",  "Alpenglow E",  "Alpenglow S",  "Alpenglow single Mie", "Alpenglow dE",
      "Alpenglow dS", "Alpenglow dJ", "Alpenglow dL", "Alpenglow dL Mie"};
  const TableSizes& s = desc_.sizes;
  const VkFormat format = bake::vulkanFormat(desc_.format);
  const VkExtent3D scattering = {s.scatteringMuS * s.scatteringNu, s.scatteringMu, s.scatteringR};
  const VkExtent3D incident = {s.scatteringNu * bake::kSphereTheta, s.scatteringMuS * s.scatteringR,
                               1};
  const VkExtent3D irradiance = {s.irradianceMuS, s.irradianceR, 1};
  engine::Image* persistentImages[bake::kImageCount];
  engine::Image* scratchImages[bake::kImageCount];
  uint32_t persistentCount = 0, scratchCount = 0;
  for (uint32_t i = 0; i < bake::kImageCount; ++i) {
    if (!bakes_ && !persistent(i)) continue;
    const bool isIncident = i == bake::kIncident || i == bake::kIncidentMie;
    const bool isIrradiance = i == bake::kIrradiance || i == bake::kDeltaIrradiance;
    const bool is2D = i == bake::kOpticalDepth || isIncident || isIrradiance;
    engine::ImageDesc desc;
    desc.type = is2D ? VK_IMAGE_TYPE_2D : VK_IMAGE_TYPE_3D;
    desc.format = format;
    desc.extent = isIncident ? incident : isIrradiance ? irradiance : scattering;
    if (i == bake::kOpticalDepth) {
      // In 32 bits where it can be: the solver and the renderer take differences of optical depths,
      // and its 256 KB cost nothing.
      desc.format = bake::vulkanFormat(bake::finestFormat(device_, desc_.format));
      desc.extent = {s.transmittanceMu, s.transmittanceR, 1};
    }
    desc.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    desc.name = kNames[i];
    const Status status = engine::createImage(device_, desc, &images_[i]);
    if (status != Status::Ok) return status;
    if (persistent(i)) {
      persistentImages[persistentCount++] = &images_[i];
    } else {
      scratchImages[scratchCount++] = &images_[i];
    }
  }
  Status status =
      engine::allocateAndBind(device_, "Alpenglow tables", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                              persistentImages, persistentCount, nullptr, 0, &persistentBlock_);
  if (status != Status::Ok || !bakes_) return status;
  return engine::allocateAndBind(device_, "Alpenglow bake scratch",
                                 VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, scratchImages, scratchCount,
                                 nullptr, 0, &scratchBlock_);
}

Status Tables::makeUniforms() {
  Status status =
      engine::createBuffer(device_, sizeof(bake::AtmosphereConstants),
                           VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "Alpenglow parameters", &uniforms_);
  if (status != Status::Ok) return status;
  engine::Buffer* buffers[] = {&uniforms_};
  status = engine::allocateAndBind(
      device_, "Alpenglow parameters",
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, nullptr, 0,
      buffers, 1, &uniformBlock_);
  if (status != Status::Ok) return status;
  const TableSizes& s = desc_.sizes;
  const auto f = [](uint32_t size) { return static_cast<float>(size); };
  bake::AtmosphereConstants constants = {};
  constants.medium = makeMediumF32(parameters_);
  constants.shape = {f(s.transmittanceMu), f(s.transmittanceR), f(s.irradianceMuS),
                     f(s.irradianceR),     f(s.scatteringR),    f(s.scatteringMu),
                     f(s.scatteringMuS),   f(s.scatteringNu)};
  std::memcpy(uniforms_.mapped, &constants, sizeof constants);
  return Status::Ok;
}

Status Tables::makeDescriptors() {
  const engine::PoolPart parts[] = {
      {bake::Resources::tableLayoutBindings(), bake::kTableBindings, 1},
      {bake::Resources::inputLayoutBindings(), bake::kInputBindings, 1},
      {bake::Resources::outputLayoutBindings(), bake::kMaxOutputs, bake::kPassKindCount}};
  Status status = engine::createPool(device_, parts, bakes_ ? 3 : 1, "Alpenglow tables", &pool_);
  if (status != Status::Ok) return status;
  VkDescriptorSetLayout layouts[2 + bake::kPassKindCount];
  layouts[0] = resources_.tableLayout();
  layouts[1] = resources_.inputLayout();
  for (uint32_t i = 0; i < bake::kPassKindCount; ++i) layouts[2 + i] = resources_.outputLayout();
  VkDescriptorSet sets[2 + bake::kPassKindCount] = {};
  status = engine::allocateSets(device_, pool_, layouts, bakes_ ? 2 + bake::kPassKindCount : 1,
                                "Alpenglow tables", sets);
  if (status != Status::Ok) return status;
  tableSet_ = sets[0];
  inputSet_ = sets[1];
  for (uint32_t i = 0; i < bake::kPassKindCount; ++i) outputSets_[i] = sets[2 + i];
  status = writeTableSet();
  return status == Status::Ok && bakes_ ? writeBakeSets() : status;
}

Status Tables::writeTableSet() {
  const VkSampler sampler = resources_.sampler();
  // Packed tables have no single Mie of their own: the binding must hold an image all the same.
  const uint32_t mie = desc_.mie == MieStorage::Full ? bake::kDeltaMie : bake::kScattering;
  engine::DescriptorWriter table(tableSet_);
  table.uniformBuffer(0, uniforms_.handle)
      .sampledImage(1, images_[bake::kOpticalDepth].view, sampler)
      .sampledImage(2, images_[bake::kIrradiance].view, sampler)
      .sampledImage(3, images_[bake::kScattering].view, sampler)
      .sampledImage(4, images_[mie].view, sampler);
  return table.flush(device_);
}

Status Tables::writeBakeSets() {
  const VkSampler sampler = resources_.sampler();
  engine::DescriptorWriter input(inputSet_);
  input.uniformBuffer(0, uniforms_.handle)
      .sampledImage(1, images_[bake::kOpticalDepth].view, sampler)
      .sampledImage(2, images_[bake::kDeltaIrradiance].view, sampler)
      .sampledImage(3, images_[bake::kDeltaScattering].view, sampler)
      .sampledImage(4, images_[bake::kDeltaMie].view, sampler)
      .sampledImage(5, images_[bake::kDeltaSource].view, sampler)
      .sampledImage(6, images_[bake::kIncident].view, sampler)
      .sampledImage(7, images_[bake::kIncidentMie].view, sampler);
  Status status = input.flush(device_);
  for (uint32_t kind = 0; kind < bake::kPassKindCount && status == Status::Ok; ++kind) {
    const bake::PassIo& io = bake::passIo(static_cast<bake::PassKind>(kind));
    engine::DescriptorWriter output(outputSets_[kind]);
    for (uint32_t i = 0; i < bake::kMaxOutputs && io.outputs[i] != kNoImage; ++i)
      output.storageImage(i, images_[io.outputs[i]].view);
    status = output.flush(device_);
  }
  return status;
}

Status Tables::makePipelines() {
  for (const bake::Pass& pass : passes_) {
    const TableFormat format = pass.kind == bake::PassKind::OpticalDepth
                                   ? bake::finestFormat(device_, desc_.format)
                                   : desc_.format;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const Status status =
        resources_.pipeline(pass.kind, format, pass.firstOrder, desc_.mie, &pipeline);
    if (status != Status::Ok) return status;
    pipelines_.push_back(pipeline);
  }
  return Status::Ok;
}

}  // namespace v1
}  // namespace alpenglow
