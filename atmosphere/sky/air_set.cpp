#include "atmosphere/sky/air_set.h"

namespace alpenglow::sky {
namespace {

constexpr VkDescriptorSetLayoutBinding binding(uint32_t i) {
  return {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
}
constexpr VkDescriptorSetLayoutBinding kBindings[] = {binding(0), binding(1), binding(2)};
static_assert(std::size(kBindings) == AirVolume::kImages);
constexpr const char* kName = "Alpenglow air volume";

}  // namespace

Status createAirSetLayout(engine::Device& device, VkDescriptorSetLayout* out) {
  return engine::createSetLayout(device, kBindings, AirVolume::kImages, kName, out);
}

Status createAirSet(bake::Resources& resources, const AirVolume& volume,
                    VkDescriptorSetLayout layout, VkDescriptorPool* pool, VkDescriptorSet* out) {
  engine::Device& device = resources.device();
  const engine::PoolPart part = {kBindings, AirVolume::kImages, 1};
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
