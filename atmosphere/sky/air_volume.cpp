#include "atmosphere/sky/air_volume.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "atmosphere/bake/effect_constants.h"
#include "atmosphere/sky/parts.h"
#include "atmosphere/sky/shader_choice.h"

namespace alpenglow::sky {
namespace {

/// Push constants of air_volume.comp.
struct VolumeConstants {
  float altitude, muS, horizon, span, bend, extinction, startHeight, height;
};

/// Seen from inside, half of the columns are in use.
constexpr VkExtent3D kExtent = {physics_f32::kAirColumns, physics_f32::kAirRows,
                                physics_f32::kAirDistances};
static_assert(kExtent.width % 16 == 0 && kExtent.height % 8 == 0);

/// Readable by whatever draws or queries.
constexpr ImageState kSampled = {
    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

constexpr VkDescriptorSetLayoutBinding binding(uint32_t i) {
  return {i, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
}
constexpr VkDescriptorSetLayoutBinding kBindings[] = {binding(0), binding(1), binding(2)};
static_assert(std::size(kBindings) == AirVolume::kImages);

}  // namespace

physics_f64::AirView airView(const Parameters& parameters, double altitude) {
  return physics_f64::airView(makeMediumF64(parameters), sliceView(parameters, altitude), altitude);
}

AirLookup airLookup(const Parameters& parameters, const SkyDraw& draw) {
  AirLookup lookup = {};
  lookup.view = airView(parameters, cameraAltitude(parameters, draw.camera));
  const double r = cameraRadius(draw.camera);
  for (int i = 0; i < 3; ++i) lookup.up[i] = draw.camera.position_m[i] / r;
  sunAzimuth(draw, lookup.sunAzimuth);
  return lookup;
}

VkExtent3D AirVolume::extentFor(EffectFlags without) {
  VkExtent3D extent = kExtent;
  if (!hasEffect(without, Effect::SpaceViews)) extent.width /= 2;
  return extent;
}

Status AirVolume::create(bake::Resources& resources, EffectFlags without, AirVolume** out) {
  *out = nullptr;
  auto* volume = new (std::nothrow) AirVolume(resources, without);
  if (volume == nullptr) {
    return resources.device().fail(Status::OutOfHostMemory, VK_SUCCESS,
                                   "An air volume found no host memory.");
  }
  const Status status = volume->make();
  if (status != Status::Ok) {
    destroy(volume, 0);  // Nothing was recorded with it: frame 0 has always completed.
    return status;
  }
  *out = volume;
  return Status::Ok;
}

void AirVolume::destroy(AirVolume* volume, uint64_t frame) {
  if (volume == nullptr) return;
  engine::Device& device = volume->device_;
  engine::DeletionQueue& deletions = device.deletions();
  const auto defer = [&](VkObjectType type, auto handle) {
    deletions.defer(frame, type, engine::handleNumber(handle));
  };
  defer(VK_OBJECT_TYPE_PIPELINE, volume->pipeline_);
  defer(VK_OBJECT_TYPE_PIPELINE_LAYOUT, volume->layout_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_POOL, volume->pool_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, volume->setLayout_);
  for (engine::Image& image : volume->images_) engine::deferImage(device, frame, &image);
  engine::deferBlock(device, frame, &volume->block_);
  delete volume;
  deletions.collect(device.completed());
}

Status AirVolume::make() {
  format_ = bake::finestFormat(device_, TableFormat::Half);
  engine::Image* images[kImages];
  for (uint32_t i = 0; i < kImages; ++i) {
    images[i] = &images_[i];
    engine::ImageDesc desc;
    desc.type = VK_IMAGE_TYPE_3D;
    desc.format = bake::vulkanFormat(format_);
    desc.extent = extentFor(without_);
    desc.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    desc.name = "Alpenglow air volume";
    const Status made = engine::createImage(device_, desc, images[i]);
    if (made != Status::Ok) return made;
  }
  Status status =
      engine::allocateAndBind(device_, "Alpenglow air volume", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                              images, kImages, nullptr, 0, &block_);
  if (status == Status::Ok) status = makeSet();
  if (status == Status::Ok) status = makePipeline();
  return status;
}

Status AirVolume::makeSet() {
  const char* const name = "Alpenglow air volume";
  Status status = engine::createSetLayout(device_, kBindings, kImages, name, &setLayout_);
  if (status != Status::Ok) return status;
  const engine::PoolPart part = {kBindings, kImages, 1};
  status = engine::createPool(device_, &part, 1, name, &pool_);
  if (status != Status::Ok) return status;
  status = engine::allocateSets(device_, pool_, &setLayout_, 1, name, &set_);
  if (status != Status::Ok) return status;
  engine::DescriptorWriter writer(set_);
  for (uint32_t i = 0; i < kImages; ++i) writer.storageImage(i, images_[i].view);
  return writer.flush(device_);
}

Status AirVolume::makePipeline() {
  const VkDescriptorSetLayout sets[] = {resources_.tableLayout(), setLayout_};
  const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(VolumeConstants)};
  const Status status =
      engine::createPipelineLayout(device_, sets, 2, &range, 1, "Alpenglow air volume", &layout_);
  if (status != Status::Ok) return status;
  engine::ComputePipelineDesc desc;
  desc.shader = volumeShader(without_, format_);
  desc.layout = layout_;
  const auto constants = bake::effectConstants(without_);
  desc.constants = constants.data();
  desc.constantCount = bake::kEffectConstants;
  return engine::createComputePipeline(device_, desc, &pipeline_);
}

Status AirVolume::record(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw) {
  engine::Barriers barriers;
  for (engine::Image& image : images_) barriers.discard(image, engine::kComputeWrite);
  Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;

  const Camera& camera = draw.camera;
  const double altitude = cameraAltitude(tables.parameters(), camera);
  const double muS = dot(camera.position_m, draw.sun.direction) / cameraRadius(camera);
  const physics_f64::AirView view = airView(tables.parameters(), altitude);
  const auto f = [](double value) { return static_cast<float>(value); };
  const VolumeConstants constants = {f(altitude),           f(muS),
                                     f(view.slice.horizon), f(view.slice.span),
                                     f(view.slice.bend),    f(view.extinction_),
                                     f(view.startHeight),   f(view.height)};
  const engine::Dispatch& vk = device_.vk();
  const VkDescriptorSet sets[] = {tables.descriptorSet(), set_};
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 2, sets, 0,
                           nullptr);
  vk.CmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants,
                      &constants);
  const auto columns = static_cast<uint32_t>(physics_f64::airGrid(view.slice).columns);
  vk.CmdDispatch(commands, (columns + 7) / 8, kExtent.height / 8, 1);
  ++device_.counters().dispatches;

  for (engine::Image& image : images_) barriers.image(image, kSampled);
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  recorded_.set(tables, draw);
  return Status::Ok;
}

Status AirVolume::assertReadable() const {
  for (const engine::Image& image : images_) {
    const Status status =
        engine::assertLayout(device_, image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

uint64_t AirVolume::bytes() const {
  uint64_t sum = 0;
  for (const engine::Image& image : images_) sum += image.bytes;
  return sum;
}

}  // namespace alpenglow::sky
