#include "atmosphere/bake/resources.h"

#include <alpenglow/shaders/diffuse_irradiance_rgba16f.h>
#include <alpenglow/shaders/diffuse_irradiance_rgba32f.h>
#include <alpenglow/shaders/direct_irradiance_rgba16f.h>
#include <alpenglow/shaders/direct_irradiance_rgba32f.h>
#include <alpenglow/shaders/incident_radiance_rgba16f.h>
#include <alpenglow/shaders/incident_radiance_rgba32f.h>
#include <alpenglow/shaders/multiple_scattering_rgba16f.h>
#include <alpenglow/shaders/multiple_scattering_rgba32f.h>
#include <alpenglow/shaders/optical_depth_rgba16f.h>
#include <alpenglow/shaders/optical_depth_rgba32f.h>
#include <alpenglow/shaders/scattering_density_rgba16f.h>
#include <alpenglow/shaders/scattering_density_rgba32f.h>
#include <alpenglow/shaders/single_scattering_rgba16f.h>
#include <alpenglow/shaders/single_scattering_rgba32f.h>

#include <new>

#include "engine/sampler.h"

namespace alpenglow::bake {
namespace {

using engine::Shader;

Shader shaderOf(PassKind kind, TableFormat format) {
  namespace s = alpenglow::shaders;
  const bool half = format == TableFormat::Half;
#define ALPENGLOW_SHADER(name)                                                      \
  half ? Shader{s::name##Half, sizeof s::name##Half, #name " (rgba16f)"} : Shader { \
    s::name##Float, sizeof s::name##Float, #name " (rgba32f)"                       \
  }
  switch (kind) {
    case PassKind::OpticalDepth:
      return ALPENGLOW_SHADER(kOpticalDepth);
    case PassKind::DirectIrradiance:
      return ALPENGLOW_SHADER(kDirectIrradiance);
    case PassKind::SingleScattering:
      return ALPENGLOW_SHADER(kSingleScattering);
    case PassKind::IncidentRadiance:
      return ALPENGLOW_SHADER(kIncidentRadiance);
    case PassKind::ScatteringDensity:
      return ALPENGLOW_SHADER(kScatteringDensity);
    case PassKind::DiffuseIrradiance:
      return ALPENGLOW_SHADER(kDiffuseIrradiance);
    case PassKind::MultipleScattering:
      return ALPENGLOW_SHADER(kMultipleScattering);
  }
#undef ALPENGLOW_SHADER
  return {};
}

constexpr VkDescriptorSetLayoutBinding binding(uint32_t index, VkDescriptorType type,
                                               VkShaderStageFlags stages) {
  return {index, type, 1, stages, nullptr};
}

constexpr VkShaderStageFlags kCompute = VK_SHADER_STAGE_COMPUTE_BIT;
constexpr VkShaderStageFlags kBoth = kCompute | VK_SHADER_STAGE_FRAGMENT_BIT;
constexpr VkDescriptorType kUniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
constexpr VkDescriptorType kSampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;

constexpr VkDescriptorSetLayoutBinding kTableLayoutBindings[kTableBindings] = {
    binding(0, kUniform, kBoth), binding(1, kSampled, kBoth), binding(2, kSampled, kBoth),
    binding(3, kSampled, kBoth), binding(4, kSampled, kBoth)};
constexpr VkDescriptorSetLayoutBinding kInputLayoutBindings[kInputBindings] = {
    binding(0, kUniform, kCompute), binding(1, kSampled, kCompute), binding(2, kSampled, kCompute),
    binding(3, kSampled, kCompute), binding(4, kSampled, kCompute), binding(5, kSampled, kCompute),
    binding(6, kSampled, kCompute), binding(7, kSampled, kCompute)};
constexpr VkDescriptorSetLayoutBinding kOutputLayoutBindings[kMaxOutputs] = {
    binding(0, kStorage, kCompute), binding(1, kStorage, kCompute), binding(2, kStorage, kCompute)};

}  // namespace

VkFormat vulkanFormat(TableFormat format) {
  return format == TableFormat::Half ? VK_FORMAT_R16G16B16A16_SFLOAT
                                     : VK_FORMAT_R32G32B32A32_SFLOAT;
}

TableFormat finestFormat(const engine::Device& device, TableFormat otherwise) {
  const VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT |
                                      VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT |
                                      VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT;
  const VkFormatProperties properties = device.formatProperties(vulkanFormat(TableFormat::Float));
  return (properties.optimalTilingFeatures & needed) == needed ? TableFormat::Float : otherwise;
}

const VkDescriptorSetLayoutBinding* Resources::tableLayoutBindings() {
  return kTableLayoutBindings;
}
const VkDescriptorSetLayoutBinding* Resources::inputLayoutBindings() {
  return kInputLayoutBindings;
}
const VkDescriptorSetLayoutBinding* Resources::outputLayoutBindings() {
  return kOutputLayoutBindings;
}

Status Resources::create(engine::Device& device, Resources** out) {
  *out = nullptr;
  auto* resources = new (std::nothrow) Resources(device);
  if (resources == nullptr) {
    return device.fail(Status::OutOfHostMemory, VK_SUCCESS,
                       "The bake's shared objects found no host memory.");
  }
  const Status status = resources->makeLayouts();
  if (status != Status::Ok) {
    destroy(resources);
    return status;
  }
  *out = resources;
  return Status::Ok;
}

Status Resources::makeLayouts() {
  Status status = engine::createSetLayout(device_, kTableLayoutBindings, kTableBindings,
                                          "Alpenglow tables", &tableLayout_);
  if (status != Status::Ok) return status;
  status = engine::createSetLayout(device_, kInputLayoutBindings, kInputBindings,
                                   "Alpenglow bake inputs", &inputLayout_);
  if (status != Status::Ok) return status;
  status = engine::createSetLayout(device_, kOutputLayoutBindings, kMaxOutputs,
                                   "Alpenglow bake outputs", &outputLayout_);
  if (status != Status::Ok) return status;
  const VkDescriptorSetLayout sets[] = {inputLayout_, outputLayout_};
  const VkPushConstantRange range = {kCompute, 0, sizeof(TileConstants)};
  status =
      engine::createPipelineLayout(device_, sets, 2, &range, 1, "Alpenglow bake", &pipelineLayout_);
  if (status != Status::Ok) return status;
  engine::SamplerDesc sampler;
  sampler.name = "Alpenglow tables";
  return engine::createSampler(device_, sampler, &sampler_);
}

void Resources::destroy(Resources* resources) {
  if (resources == nullptr) return;
  const engine::Device& device = resources->device_;
  const engine::Dispatch& vk = device.vk();
  for (const auto& [key, pipeline] : resources->pipelines_)
    vk.DestroyPipeline(device.handle(), pipeline, device.allocator());
  vk.DestroyPipelineLayout(device.handle(), resources->pipelineLayout_, device.allocator());
  for (VkDescriptorSetLayout layout :
       {resources->tableLayout_, resources->inputLayout_, resources->outputLayout_})
    vk.DestroyDescriptorSetLayout(device.handle(), layout, device.allocator());
  vk.DestroySampler(device.handle(), resources->sampler_, device.allocator());
  delete resources;
}

Status Resources::pipeline(PassKind kind, TableFormat format, bool firstOrder, MieStorage mie,
                           VkPipeline* out) {
  // Only the passes that look at a constant come in variants.
  const bool readsOrderBefore = kind == PassKind::IncidentRadiance ||
                                kind == PassKind::ScatteringDensity ||
                                kind == PassKind::DiffuseIrradiance;
  const Key key = {kind, format, readsOrderBefore && firstOrder,
                   kind == PassKind::SingleScattering ? mie : MieStorage::Full};
  const std::scoped_lock lock(mutex_);
  VkPipeline& slot = pipelines_[key];  // First, because it may throw.
  *out = slot;
  if (slot != VK_NULL_HANDLE) return Status::Ok;
  const engine::SpecConstant constants[] = {
      engine::specBool(0, std::get<2>(key)),
      engine::specBool(1, std::get<3>(key) == MieStorage::Packed)};
  engine::ComputePipelineDesc desc;
  desc.shader = shaderOf(kind, format);
  desc.layout = pipelineLayout_;
  desc.constants = constants;
  desc.constantCount = 2;
  const Status status = engine::createComputePipeline(device_, desc, &slot);
  *out = slot;
  return status;
}

}  // namespace alpenglow::bake
