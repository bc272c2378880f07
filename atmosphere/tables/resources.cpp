#include "atmosphere/tables/resources.h"

#include <algorithm>
#include <new>

#include "atmosphere/tables/effect_constants.h"
#include "engine/sampler.h"

namespace alpenglow::tables {
namespace {

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
    binding(6, kSampled, kCompute), binding(7, kSampled, kCompute), binding(8, kSampled, kCompute)};
constexpr VkDescriptorSetLayoutBinding kOutputLayoutBindings[kMaxOutputs] = {
    binding(0, kStorage, kCompute), binding(1, kStorage, kCompute), binding(2, kStorage, kCompute)};

}  // namespace

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

Status Resources::create(engine::Device& device, VkShaderStageFlags setStages, Resources** out) {
  *out = nullptr;
  auto* resources = new (std::nothrow) Resources(device, setStages);
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
  VkDescriptorSetLayoutBinding bindings[kTableBindings];
  std::copy_n(kTableLayoutBindings, kTableBindings, bindings);
  for (VkDescriptorSetLayoutBinding& binding : bindings) binding.stageFlags |= setStages_;
  Status status =
      engine::createSetLayout(device_, bindings, kTableBindings, "Alpenglow tables", &tableLayout_);
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
  status = engine::createSampler(device_, sampler, &sampler_);
  if (status != Status::Ok) return status;
  sampler.filter = VK_FILTER_NEAREST;
  sampler.name = "Alpenglow texels";
  return engine::createSampler(device_, sampler, &nearestSampler_);
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
  for (VkSampler sampler : {resources->sampler_, resources->nearestSampler_})
    vk.DestroySampler(device.handle(), sampler, device.allocator());
  delete resources;
}

Status Resources::pipeline(const Stage& stage, VkPipeline* out) {
  Key key;
  engine::Shader used;
  const Status chosen = engine::chooseShader(device_, stage.shader, &used);
  if (chosen != Status::Ok) return chosen;
  key.code = stage.shader.code;
  // The host may pass other code at the same address.
  if (used.code != key.code) key.replacement = engine::variantKey(used, nullptr, 0);
  key.disabledEffects = stage.disabledEffects;
  engine::SpecConstant constants[kStageConstants + kEffectConstants];
  for (uint32_t i = 0; i < kStageConstants; ++i) {
    key.constants[i] = stage.constants[i];
    constants[i] = engine::specBool(i, stage.constants[i]);
  }
  std::ranges::copy(effectConstants(stage.disabledEffects), constants + kStageConstants);
  const std::scoped_lock lock(mutex_);
  VkPipeline& slot = pipelines_[key];  // First, because it may throw.
  *out = slot;
  if (slot != VK_NULL_HANDLE) return Status::Ok;
  engine::ComputePipelineDesc desc;
  desc.shader = stage.shader;
  desc.layout = pipelineLayout_;
  desc.constants = constants;
  desc.constantCount = kStageConstants + kEffectConstants;
  const Status status = engine::createComputePipeline(device_, desc, &slot);
  *out = slot;
  return status;
}

}  // namespace alpenglow::tables
