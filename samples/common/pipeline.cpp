// Pipelines of a host's scene.
#include "gpu.h"

namespace alpenglow::samples {
namespace {

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, VkShaderModule code,
                                      const VkSpecializationInfo* constants) {
  VkPipelineShaderStageCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = bit;
  info.module = code;
  info.pName = "main";
  info.pSpecializationInfo = constants;
  return info;
}

VkPipelineColorBlendAttachmentState blendOf(const PipelineDesc& desc) {
  VkPipelineColorBlendAttachmentState blend = {};
  const bool adds = desc.blending == Blending::Add;
  blend.blendEnable = desc.blending != Blending::None;
  blend.srcColorBlendFactor = adds ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_SRC_ALPHA;
  blend.dstColorBlendFactor = adds ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  blend.colorBlendOp = VK_BLEND_OP_ADD;
  blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  blend.alphaBlendOp = VK_BLEND_OP_ADD;
  blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                         VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  return blend;
}

/// What is fixed about a pipeline. Points into itself and into the description.
struct FixedState {
  explicit FixedState(const PipelineDesc& desc);
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;

  VkVertexInputBindingDescription binding = {};
  VkPipelineVertexInputStateCreateInfo input = {};
  VkPipelineInputAssemblyStateCreateInfo assembly = {};
  VkPipelineViewportStateCreateInfo viewport = {};
  VkPipelineRasterizationStateCreateInfo raster = {};
  VkPipelineMultisampleStateCreateInfo samples = {};
  VkPipelineDepthStencilStateCreateInfo depth = {};
  VkPipelineColorBlendAttachmentState attachment = {};
  VkPipelineColorBlendStateCreateInfo blend = {};
  VkDynamicState dynamic[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamics = {};
  VkPipelineRenderingCreateInfo rendering = {};
};

FixedState::FixedState(const PipelineDesc& desc) {
  binding = {0, desc.vertexStride, VK_VERTEX_INPUT_RATE_VERTEX};
  input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  input.vertexBindingDescriptionCount = desc.vertexStride > 0 ? 1 : 0;
  input.pVertexBindingDescriptions = &binding;
  input.vertexAttributeDescriptionCount = static_cast<uint32_t>(desc.attributes.size());
  input.pVertexAttributeDescriptions = desc.attributes.data();
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.cullMode = VK_CULL_MODE_BACK_BIT;
  raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  raster.lineWidth = 1.0f;
  samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  // Reversed: the nearest is the greatest.
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth.depthTestEnable = desc.depth != VK_FORMAT_UNDEFINED;
  depth.depthWriteEnable = desc.writesDepth;
  depth.depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
  attachment = blendOf(desc);
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = desc.color != VK_FORMAT_UNDEFINED ? 1 : 0;
  blend.pAttachments = &attachment;
  dynamics.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamics.dynamicStateCount = 2;
  dynamics.pDynamicStates = dynamic;
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.colorAttachmentCount = blend.attachmentCount;
  rendering.pColorAttachmentFormats = &desc.color;
  rendering.depthAttachmentFormat = desc.depth;
}

}  // namespace

Owned<VkShaderModule> Gpu::shaderModule(Code code) const {
  VkShaderModuleCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = code.size_bytes();
  info.pCode = code.data();
  VkShaderModule made = VK_NULL_HANDLE;
  check(function<PFN_vkCreateShaderModule>("vkCreateShaderModule")(device_->device(), &info,
                                                                   nullptr, &made),
        "vkCreateShaderModule");
  return {*device_, "vkDestroyShaderModule", made};
}

Owned<VkPipeline> Gpu::pipeline(const PipelineDesc& desc) const {
  const Owned<VkShaderModule> vertex = shaderModule(desc.vertex);
  Owned<VkShaderModule> fragment;
  if (!desc.fragment.empty()) fragment = shaderModule(desc.fragment);
  const VkPipelineShaderStageCreateInfo stages[] = {
      stage(VK_SHADER_STAGE_VERTEX_BIT, vertex.get(), nullptr),
      stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get(), desc.fragmentConstants)};

  const FixedState state(desc);
  VkGraphicsPipelineCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = desc.renderPass == VK_NULL_HANDLE ? &state.rendering : nullptr;
  info.renderPass = desc.renderPass;
  info.stageCount = desc.fragment.empty() ? 1 : 2;
  info.pStages = stages;
  info.pVertexInputState = &state.input;
  info.pInputAssemblyState = &state.assembly;
  info.pViewportState = &state.viewport;
  info.pRasterizationState = &state.raster;
  info.pMultisampleState = &state.samples;
  info.pDepthStencilState = &state.depth;
  info.pColorBlendState = &state.blend;
  info.pDynamicState = &state.dynamics;
  info.layout = desc.layout;
  VkPipeline made = VK_NULL_HANDLE;
  check(function<PFN_vkCreateGraphicsPipelines>("vkCreateGraphicsPipelines")(
            device_->device(), VK_NULL_HANDLE, 1, &info, nullptr, &made),
        "vkCreateGraphicsPipelines");
  return {*device_, "vkDestroyPipeline", made};
}

}  // namespace alpenglow::samples
