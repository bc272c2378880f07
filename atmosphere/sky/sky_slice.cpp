#include "atmosphere/sky/sky_slice.h"

#include <algorithm>
#include <iterator>
#include <new>

#include "atmosphere/bake/effect_constants.h"
#include "atmosphere/sky/shader_choice.h"

namespace alpenglow::sky {
namespace {

/// Push constants of sky_slice.comp; the standard solver's reads the first two, Hillaire's three.
struct SliceConstants {
  float altitude, muS, horizon, span, bend;
};

/// Texels by quality, Draft ... Ultra: no finer than what the tables hold is right. Whole groups;
/// half of the columns is used inside the atmosphere. Errors of each: docs/stability.md.
constexpr VkExtent3D kMomentSlices[] = {
    {48, 64, 1}, {64, 96, 1}, {128, 160, 1}, {128, 160, 1}, {128, 160, 1}};
static_assert(std::size(kMomentSlices) == static_cast<size_t>(Quality::Ultra));

VkExtent3D momentSlice(Quality quality) {
  const Quality level = quality == Quality::Default ? Quality::Medium : quality;
  return kMomentSlices[static_cast<size_t>(level) - 1];
}

constexpr VkDescriptorSetLayoutBinding kBindings[2] = {
    {0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
    {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};

}  // namespace

void RecordedFor::set(const Tables& tables, const SkyDraw& draw) {
  tablesId_ = tables.id();
  std::copy_n(draw.camera.position_m, 3, position_);
  std::copy_n(draw.sun.direction, 3, sun_);
}

bool RecordedFor::is(const Tables& tables, const SkyDraw& draw) const {
  return tablesId_ == tables.id() && std::equal(position_, position_ + 3, draw.camera.position_m) &&
         std::equal(sun_, sun_ + 3, draw.sun.direction);
}

VkExtent3D SkySlice::extentFor(const TableDesc& desc, EffectFlags without) {
  if (desc.solver == Solver::Hillaire) return {192, 108, 1};  // The paper's.
  if (desc.solver != Solver::Moments) return {desc.sizes.scatteringNu, desc.sizes.scatteringMu, 1};
  VkExtent3D extent = momentSlice(desc.quality);
  if (!hasEffect(without, Effect::SpaceViews)) extent.width /= 2;
  return extent;
}

uint32_t SkySlice::countFor(const TableDesc& desc, EffectFlags without) {
  const bool mie = desc.mie == MieStorage::Full && hasEffect(without, Effect::Mie);
  return mie && desc.solver != Solver::Hillaire ? 2 : 1;
}

Status SkySlice::create(bake::Resources& resources, const TableDesc& tables, EffectFlags without,
                        SkySlice** out) {
  *out = nullptr;
  auto* slice = new (std::nothrow) SkySlice(resources, tables, without);
  if (slice == nullptr) {
    return resources.device().fail(Status::OutOfHostMemory, VK_SUCCESS,
                                   "A sky slice found no host memory.");
  }
  const Status status = slice->make();
  if (status != Status::Ok) {
    destroy(slice, 0);  // Nothing was recorded with it: frame 0 has always completed.
    return status;
  }
  *out = slice;
  return Status::Ok;
}

void SkySlice::destroy(SkySlice* slice, uint64_t frame) {
  if (slice == nullptr) return;
  engine::Device& device = slice->device_;
  engine::DeletionQueue& deletions = device.deletions();
  const auto defer = [&](VkObjectType type, auto handle) {
    deletions.defer(frame, type, engine::handleNumber(handle));
  };
  defer(VK_OBJECT_TYPE_PIPELINE, slice->pipeline_);
  defer(VK_OBJECT_TYPE_PIPELINE_LAYOUT, slice->layout_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_POOL, slice->pool_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, slice->setLayout_);
  for (engine::Image& image : slice->images_) engine::deferImage(device, frame, &image);
  engine::deferBlock(device, frame, &slice->block_);
  delete slice;
  deletions.collect(device.completed());
}

Status SkySlice::make() {
  const TableFormat format = bake::finestFormat(device_, TableFormat::Half);
  engine::Image* images[] = {&images_[0], &images_[1]};
  for (uint32_t i = 0; i < count_; ++i) {
    engine::ImageDesc desc;
    desc.format = bake::vulkanFormat(format);
    desc.extent = extent_;
    desc.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    desc.name = i == 0 ? "Alpenglow sky slice" : "Alpenglow sky slice Mie";
    const Status made = engine::createImage(device_, desc, images[i]);
    if (made != Status::Ok) return made;
  }
  Status status =
      engine::allocateAndBind(device_, "Alpenglow sky slice", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                              images, count_, nullptr, 0, &block_);
  if (status != Status::Ok) return status;
  status = engine::createSetLayout(device_, kBindings, 2, "Alpenglow sky slice", &setLayout_);
  if (status != Status::Ok) return status;
  const engine::PoolPart part = {kBindings, 2, 1};
  status = engine::createPool(device_, &part, 1, "Alpenglow sky slice", &pool_);
  if (status != Status::Ok) return status;
  status = engine::allocateSets(device_, pool_, &setLayout_, 1, "Alpenglow sky slice", &set_);
  if (status != Status::Ok) return status;
  engine::DescriptorWriter writer(set_);
  writer.storageImage(0, image().view).storageImage(1, mieImage().view);
  status = writer.flush(device_);
  if (status != Status::Ok) return status;
  return makePipeline(format);
}

Status SkySlice::makePipeline(TableFormat format) {
  const VkDescriptorSetLayout sets[] = {resources_.tableLayout(), setLayout_};
  const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(SliceConstants)};
  const Status status =
      engine::createPipelineLayout(device_, sets, 2, &range, 1, "Alpenglow sky slice", &layout_);
  if (status != Status::Ok) return status;
  engine::ComputePipelineDesc desc;
  desc.shader = sliceShader(solver_, without_, format);
  desc.layout = layout_;
  engine::SpecConstant constants[3 + bake::kEffectConstants] = {
      engine::specBool(0, mie_ == MieStorage::Packed),
      engine::specFloat(11, static_cast<float>(columns_)),
      engine::specFloat(12, static_cast<float>(extent_.height))};
  std::ranges::copy(bake::effectConstants(without_), constants + 3);
  desc.constants = constants;
  desc.constantCount = 3 + bake::kEffectConstants;
  return engine::createComputePipeline(device_, desc, &pipeline_);
}

bool SkySlice::possible(const Tables& tables, const SkyDraw& draw) {
  if (tables.desc().solver == Solver::Moments) return true;
  const Parameters& p = tables.parameters();
  return cameraAltitude(p, draw.camera) <= p.topRadius_m - p.bottomRadius_m;
}

Status SkySlice::record(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw) {
  engine::Barriers barriers;
  for (uint32_t i = 0; i < count_; ++i) barriers.discard(images_[i], engine::kComputeWrite);
  Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;

  const Camera& camera = draw.camera;
  const double altitude = cameraAltitude(tables.parameters(), camera);
  const double r = cameraRadius(camera);
  double muS = 0.0;
  for (int i = 0; i < 3; ++i) muS += camera.position_m[i] / r * draw.sun.direction[i];
  const physics_f64::SliceView view = sliceView(tables.parameters(), altitude);
  const SliceConstants constants = {static_cast<float>(altitude), static_cast<float>(muS),
                                    static_cast<float>(view.horizon), static_cast<float>(view.span),
                                    static_cast<float>(view.bend)};
  const engine::Dispatch& vk = device_.vk();
  const VkDescriptorSet sets[] = {tables.descriptorSet(), set_};
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 2, sets, 0,
                           nullptr);
  vk.CmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants,
                      &constants);
  const uint32_t columns = solver_ == Solver::Moments
                               ? static_cast<uint32_t>(physics_f64::sliceAzimuths(view, columns_))
                               : extent_.width;
  vk.CmdDispatch(commands, (columns + 7) / 8, (extent_.height + 7) / 8, 1);
  ++device_.counters().dispatches;

  for (uint32_t i = 0; i < count_; ++i) barriers.image(images_[i], engine::kFragmentSampled);
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  recorded_.set(tables, draw);
  return Status::Ok;
}

Status SkySlice::assertReadable() const {
  for (uint32_t i = 0; i < count_; ++i) {
    const Status status =
        engine::assertLayout(device_, images_[i], VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

}  // namespace alpenglow::sky
