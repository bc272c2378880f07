#include "landscape_pipelines.h"

#include <alpenglow/mesh/terrain.h>
#include <alpenglow/shaders/sample_balloon.h>
#include <alpenglow/shaders/sample_balloon_hillaire.h>
#include <alpenglow/shaders/sample_balloon_hoffman_preetham.h>
#include <alpenglow/shaders/sample_balloon_oneil.h>
#include <alpenglow/shaders/sample_balloon_schafhitzel.h>
#include <alpenglow/shaders/sample_balloon_shafts.h>
#include <alpenglow/shaders/sample_balloon_standard.h>
#include <alpenglow/shaders/sample_balloon_vertex.h>
#include <alpenglow/shaders/sample_terrain.h>
#include <alpenglow/shaders/sample_terrain_hillaire.h>
#include <alpenglow/shaders/sample_terrain_hoffman_preetham.h>
#include <alpenglow/shaders/sample_terrain_oneil.h>
#include <alpenglow/shaders/sample_terrain_schafhitzel.h>
#include <alpenglow/shaders/sample_terrain_shafts.h>
#include <alpenglow/shaders/sample_terrain_standard.h>
#include <alpenglow/shaders/sample_terrain_vertex.h>

#include "common/tables_info.h"
#include "terrain_mesh.h"

namespace alpenglow::samples {
namespace {

constexpr VkShaderStageFlags kBoth = LandscapePipelines::kPushStages;
constexpr VkDescriptorSetLayoutBinding kFrameBinding = {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1,
                                                        kBoth, nullptr};
constexpr VkDescriptorSetLayoutBinding kAlbedoBinding = {
    0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
/// The larger of what terrain and balloons push.
constexpr VkPushConstantRange kPush = {kBoth, 0, 12 * sizeof(float)};

constexpr VkVertexInputAttributeDescription kAttributes[] = {
    {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(TerrainVertex, position)},
    {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(TerrainVertex, normal)},
    {2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(TerrainVertex, uv)}};

Owned<VkDescriptorPool> makePool(const Gpu& gpu) {
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
                                        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}};
  VkDescriptorPoolCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = 2;
  info.poolSizeCount = 2;
  info.pPoolSizes = sizes;
  VkDescriptorPool made = VK_NULL_HANDLE;
  Gpu::check(gpu.function<PFN_vkCreateDescriptorPool>("vkCreateDescriptorPool")(
                 gpu.device().device(), &info, nullptr, &made),
             "vkCreateDescriptorPool");
  return {gpu.device(), "vkDestroyDescriptorPool", made};
}

VkDescriptorSet allocateSet(const Gpu& gpu, VkDescriptorPool pool, VkDescriptorSetLayout layout) {
  VkDescriptorSetAllocateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  Gpu::check(gpu.function<PFN_vkAllocateDescriptorSets>("vkAllocateDescriptorSets")(
                 gpu.device().device(), &info, &set),
             "vkAllocateDescriptorSets");
  return set;
}

void write(const Gpu& gpu, VkDescriptorSet set, VkDescriptorType type,
           const VkDescriptorBufferInfo* buffer, const VkDescriptorImageInfo* image) {
  VkWriteDescriptorSet info = {};
  info.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  info.dstSet = set;
  info.descriptorCount = 1;
  info.descriptorType = type;
  info.pBufferInfo = buffer;
  info.pImageInfo = image;
  gpu.function<PFN_vkUpdateDescriptorSets>("vkUpdateDescriptorSets")(gpu.device().device(), 1,
                                                                     &info, 0, nullptr);
}

/// A shader's text for each solver's tables.
Code codeOf(Solver solver, bool shafts, bool terrain) {
  namespace s = alpenglow::shaders;
  const auto pick = [&](Code ofTerrain, Code ofBalloon) { return terrain ? ofTerrain : ofBalloon; };
  switch (solver) {
    case Solver::Moments:
      return shafts ? pick(s::kSampleTerrainShafts, s::kSampleBalloonShafts)
                    : pick(s::kSampleTerrain, s::kSampleBalloon);
    case Solver::Standard:
      return pick(s::kSampleTerrainStandard, s::kSampleBalloonStandard);
    case Solver::HoffmanPreetham:
      return pick(s::kSampleTerrainHoffmanPreetham, s::kSampleBalloonHoffmanPreetham);
    case Solver::ONeil:
      return pick(s::kSampleTerrainOneil, s::kSampleBalloonOneil);
    case Solver::Schafhitzel:
      return pick(s::kSampleTerrainSchafhitzel, s::kSampleBalloonSchafhitzel);
    case Solver::Hillaire:
      return pick(s::kSampleTerrainHillaire, s::kSampleBalloonHillaire);
  }
  return {};
}

}  // namespace

LandscapePipelines::LandscapePipelines(const Gpu* gpu, const LandscapePipelinesDesc& desc)
    : gpu_(gpu), lightShaftLayout_(desc.lightShaftLayout) {
  makeSets(desc);
  makePipelines(desc);
}

void LandscapePipelines::makeSets(const LandscapePipelinesDesc& desc) {
  frame_ = gpu_->buffer(sizeof(FrameBlock),
                        VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  frameLayout_ = gpu_->setLayout({&kFrameBinding, 1});
  albedoLayout_ = gpu_->setLayout({&kAlbedoBinding, 1});
  pool_ = makePool(*gpu_);
  frameSet_ = allocateSet(*gpu_, pool_.get(), frameLayout_.get());
  const VkDescriptorBufferInfo buffer = {frame_.buffer(), 0, sizeof(FrameBlock)};
  write(*gpu_, frameSet_, kFrameBinding.descriptorType, &buffer, nullptr);
  if (desc.terrainAlbedo != nullptr) {
    sampler_ = gpu_->sampler(VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    albedoSet_ = allocateSet(*gpu_, pool_.get(), albedoLayout_.get());
    const VkDescriptorImageInfo image = {sampler_.get(), desc.terrainAlbedo->view(),
                                         kSampled.layout};
    write(*gpu_, albedoSet_, kAlbedoBinding.descriptorType, nullptr, &image);
  }
  const VkDescriptorSetLayout sets[] = {infoOf(desc.tables).setLayout, frameLayout_.get(),
                                        albedoLayout_.get(), lightShaftLayout_};
  layout_ = gpu_->pipelineLayout(
      {sets, lightShaftLayout_ != VK_NULL_HANDLE ? size_t{4} : size_t{3}}, kPush);
}

void LandscapePipelines::makePipelines(const LandscapePipelinesDesc& desc) {
  namespace s = alpenglow::shaders;
  const bool terrain = desc.terrainAlbedo != nullptr;
  PipelineDesc pipeline;
  pipeline.layout = layout_.get();
  pipeline.depth = terrain ? kDepthFormat : VK_FORMAT_UNDEFINED;
  if (terrain) {
    pipeline.vertex = s::kSampleTerrainVertex;
    pipeline.vertexStride = sizeof(TerrainVertex);
    pipeline.attributes = kAttributes;
    pipeline.writesDepth = true;
    depth_ = gpu_->pipeline(pipeline);
    pipeline.writesDepth = false;
    pipeline.color = desc.colorFormat;
    pipeline.fragment = codeOf(desc.solver, lightShaftLayout_ != VK_NULL_HANDLE, true);
    terrain_ = gpu_->pipeline(pipeline);
  }
  if (!desc.balloons) return;
  pipeline.vertex = s::kSampleBalloonVertex;
  pipeline.vertexStride = 0;
  pipeline.attributes = {};
  pipeline.color = desc.colorFormat;
  pipeline.blending = Blending::Alpha;
  pipeline.fragment = codeOf(desc.solver, lightShaftLayout_ != VK_NULL_HANDLE, false);
  const VkBool32 packed = desc.mie == MieStorage::Packed;
  const VkSpecializationMapEntry entry = {0, 0, sizeof packed};
  const VkSpecializationInfo constants = {1, &entry, sizeof packed, &packed};
  if (desc.solver == Solver::Standard) pipeline.fragmentConstants = &constants;
  balloon_ = gpu_->pipeline(pipeline);
}

void LandscapePipelines::bind(VkCommandBuffer commands, VkPipeline pipeline, const Tables* tables,
                              VkDescriptorSet shafts) const {
  const auto bindSets = gpu_->function<PFN_vkCmdBindDescriptorSets>("vkCmdBindDescriptorSets");
  const auto bindSet = [&](uint32_t index, VkDescriptorSet set) {
    if (set == VK_NULL_HANDLE) return;
    bindSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), index, 1, &set, 0, nullptr);
  };
  gpu_->function<PFN_vkCmdBindPipeline>("vkCmdBindPipeline")(
      commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  bindSet(0, infoOf(tables).set);
  bindSet(1, frameSet_);
  bindSet(2, albedoSet_);
  bindSet(3, shafts);
}

void LandscapePipelines::bindDepth(VkCommandBuffer commands) const {
  bind(commands, depth_.get(), nullptr, VK_NULL_HANDLE);
}

void LandscapePipelines::bindTerrain(VkCommandBuffer commands, const Tables* tables,
                                     VkDescriptorSet shafts) const {
  bind(commands, terrain_.get(), tables, shafts);
}

void LandscapePipelines::bindBalloons(VkCommandBuffer commands, const Tables* tables,
                                      VkDescriptorSet shafts) const {
  bind(commands, balloon_.get(), tables, shafts);
}

void LandscapePipelines::push(VkCommandBuffer commands, const void* data, uint32_t bytes) const {
  gpu_->function<PFN_vkCmdPushConstants>("vkCmdPushConstants")(commands, layout_.get(), kPushStages,
                                                               0, bytes, data);
}

}  // namespace alpenglow::samples
