#include "atmosphere/passes/aerial_perspective_set.h"

namespace alpenglow::passes {
namespace {

void describe(VkShaderStageFlags stages, VkDescriptorSetLayoutBinding* bindings) {
  for (uint32_t i = 0; i < AerialPerspectiveLut::kImages; ++i)
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages, nullptr};
}
constexpr const char* kName = "Alpenglow aerial-perspective LUT";

}  // namespace

Status createAerialPerspectiveSetLayout(engine::Device& device, VkShaderStageFlags stages,
                                        VkDescriptorSetLayout* out) {
  VkDescriptorSetLayoutBinding bindings[AerialPerspectiveLut::kImages];
  describe(stages, bindings);
  return engine::createSetLayout(device, bindings, AerialPerspectiveLut::kImages, kName, out);
}

Status createAerialPerspectiveSet(tables::Resources& resources, const AerialPerspectiveLut& volume,
                                  VkDescriptorSetLayout layout, VkDescriptorPool* pool,
                                  VkDescriptorSet* out) {
  engine::Device& device = resources.device();
  VkDescriptorSetLayoutBinding bindings[AerialPerspectiveLut::kImages];
  describe(VK_SHADER_STAGE_FRAGMENT_BIT, bindings);  // A pool counts descriptors alone.
  const engine::PoolPart part = {bindings, AerialPerspectiveLut::kImages, 1};
  Status status = engine::createPool(device, &part, 1, kName, pool);
  if (status != Status::Ok) return status;
  status = engine::allocateSets(device, *pool, &layout, 1, kName, out);
  if (status != Status::Ok) return status;
  engine::DescriptorWriter writer(*out);
  for (uint32_t i = 0; i < AerialPerspectiveLut::kImages; ++i)
    writer.sampledImage(i, volume.image(i).view, resources.sampler());
  return writer.flush(device);
}

}  // namespace alpenglow::passes
