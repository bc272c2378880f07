#include "atmosphere/sky/air_set.h"

namespace alpenglow::sky {
namespace {

void describe(VkShaderStageFlags stages, VkDescriptorSetLayoutBinding* bindings) {
  for (uint32_t i = 0; i < AirVolume::kImages; ++i)
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages, nullptr};
}
constexpr const char* kName = "Alpenglow air volume";

}  // namespace

Status createAirSetLayout(engine::Device& device, VkShaderStageFlags stages,
                          VkDescriptorSetLayout* out) {
  VkDescriptorSetLayoutBinding bindings[AirVolume::kImages];
  describe(stages, bindings);
  return engine::createSetLayout(device, bindings, AirVolume::kImages, kName, out);
}

Status createAirSet(bake::Resources& resources, const AirVolume& volume,
                    VkDescriptorSetLayout layout, VkDescriptorPool* pool, VkDescriptorSet* out) {
  engine::Device& device = resources.device();
  VkDescriptorSetLayoutBinding bindings[AirVolume::kImages];
  describe(VK_SHADER_STAGE_FRAGMENT_BIT, bindings);  // A pool counts descriptors alone.
  const engine::PoolPart part = {bindings, AirVolume::kImages, 1};
  Status status = engine::createPool(device, &part, 1, kName, pool);
  if (status != Status::Ok) return status;
  status = engine::allocateSets(device, *pool, &layout, 1, kName, out);
  if (status != Status::Ok) return status;
  engine::DescriptorWriter writer(*out);
  for (uint32_t i = 0; i < AirVolume::kImages; ++i)
    writer.sampledImage(i, volume.image(i).view, resources.sampler());
  return writer.flush(device);
}

}  // namespace alpenglow::sky
