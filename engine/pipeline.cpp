#include "engine/pipeline.h"

#include <bit>
#include <cstddef>

#include "engine/structure.h"

namespace alpenglow::engine {
namespace {

constexpr uint32_t kSpirvMagic = 0x07230203;
constexpr size_t kSpirvHeaderBytes = 20;

Status checkShader(const Device& device, const Shader& shader) {
  const bool whole = shader.bytes >= kSpirvHeaderBytes && shader.bytes % 4 == 0;
  if (shader.code == nullptr || !whole || shader.code[0] != kSpirvMagic) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Shader \"%s\" is %zu bytes %s, but SPIR-V, whole words that start with "
                       "0x07230203, is expected.",
                       shader.name, shader.bytes,
                       shader.code == nullptr ? "at a null pointer"
                       : whole                ? "of something else"
                                              : "long");
  }
  return Status::Ok;
}

Status checkConstants(const Device& device, const char* name, uint32_t count) {
  if (count <= kMaxSpecConstants) return Status::Ok;
  return device.fail(
      Status::InvalidArgument, VK_SUCCESS,
      "Pipeline \"%s\" has %u specialization constants, but at most %u are expected.", name, count,
      kMaxSpecConstants);
}

/// The constants as Vulkan takes them; points into itself.
class Specialization {
 public:
  Specialization(const SpecConstant* constants, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      const size_t offset = i * sizeof(SpecConstant) + offsetof(SpecConstant, value);
      entries_[i] = {constants[i].id, static_cast<uint32_t>(offset), sizeof(uint32_t)};
    }
    info_ = {count, entries_, count * sizeof(SpecConstant), constants};
  }
  Specialization(const Specialization&) = delete;
  Specialization& operator=(const Specialization&) = delete;

  const VkSpecializationInfo* info() const { return info_.mapEntryCount > 0 ? &info_ : nullptr; }

 private:
  VkSpecializationMapEntry entries_[kMaxSpecConstants];
  VkSpecializationInfo info_ = {};
};

/// The stages of a pipeline being made; its modules go with it.
class Stages {
 public:
  Stages(Device& device, const VkSpecializationInfo* specialization)
      : device_(device), specialization_(specialization) {}
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;
  ~Stages() {
    for (uint32_t i = 0; i < count_; ++i) {
      device_.destroyObject(VK_OBJECT_TYPE_SHADER_MODULE, stages_[i].module);
    }
  }

  Status add(VkShaderStageFlagBits stage, const Shader& shader) {
    if (Status status = checkShader(device_, shader); status != Status::Ok) return status;
    auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = shader.bytes;
    info.pCode = shader.code;
    VkShaderModule module = VK_NULL_HANDLE;
    const VkResult result =
        device_.vk().CreateShaderModule(device_.handle(), &info, device_.allocator(), &module);
    if (result < 0) return device_.failVk(result, "vkCreateShaderModule", "shader", shader.name);
    VkPipelineShaderStageCreateInfo& out = stages_[count_++];
    out = structure<VkPipelineShaderStageCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    out.stage = stage;
    out.module = module;
    out.pName = "main";
    out.pSpecializationInfo = specialization_;
    return Status::Ok;
  }

  uint32_t count() const { return count_; }
  const VkPipelineShaderStageCreateInfo* data() const { return stages_; }

 private:
  Device& device_;
  const VkSpecializationInfo* specialization_;
  VkPipelineShaderStageCreateInfo stages_[3] = {};
  uint32_t count_ = 0;
};

uint32_t colorCount(const GraphicsPipelineDesc& desc) {
  uint32_t count = 0;
  while (count < kMaxColorTargets && desc.colors[count].format != VK_FORMAT_UNDEFINED) ++count;
  return count;
}

VkPipelineColorBlendAttachmentState blendState(Blend blend) {
  VkPipelineColorBlendAttachmentState state = {};
  state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                         VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  if (blend == Blend::None) return state;
  const bool dual = blend == Blend::DualSource;
  state.blendEnable = VK_TRUE;
  state.srcColorBlendFactor = state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = dual ? VK_BLEND_FACTOR_SRC1_COLOR : VK_BLEND_FACTOR_ONE;
  state.dstAlphaBlendFactor = dual ? VK_BLEND_FACTOR_SRC1_ALPHA : VK_BLEND_FACTOR_ONE;
  state.colorBlendOp = state.alphaBlendOp = blend == Blend::Max ? VK_BLEND_OP_MAX : VK_BLEND_OP_ADD;
  return state;
}

/// Everything between the stages and the attachments: points into itself.
struct FixedFunctions {
  VkPipelineVertexInputStateCreateInfo vertexInput =
      structure<VkPipelineVertexInputStateCreateInfo>(
          VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  VkPipelineInputAssemblyStateCreateInfo assembly =
      structure<VkPipelineInputAssemblyStateCreateInfo>(
          VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  VkPipelineViewportStateCreateInfo viewport = structure<VkPipelineViewportStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  VkPipelineRasterizationStateCreateInfo rasterization =
      structure<VkPipelineRasterizationStateCreateInfo>(
          VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  VkPipelineMultisampleStateCreateInfo multisample =
      structure<VkPipelineMultisampleStateCreateInfo>(
          VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  VkPipelineDepthStencilStateCreateInfo depth = structure<VkPipelineDepthStencilStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  VkPipelineColorBlendAttachmentState attachments[kMaxColorTargets] = {};
  VkVertexInputBindingDescription binding = {};
  VkVertexInputAttributeDescription attribute = {};
  VkPipelineColorBlendStateCreateInfo blend = structure<VkPipelineColorBlendStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  VkDynamicState dynamicStates[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic = structure<VkPipelineDynamicStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);

  explicit FixedFunctions(const GraphicsPipelineDesc& desc) {
    assembly.topology = desc.topology == Topology::TriangleStrip
                            ? VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP
                        : desc.topology == Topology::TrianglesWithAdjacency
                            ? VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST_WITH_ADJACENCY
                            : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    if (desc.vertices.stride > 0) {
      binding = {0, desc.vertices.stride, VK_VERTEX_INPUT_RATE_VERTEX};
      attribute = {0, 0, VK_FORMAT_R32G32B32_SFLOAT, desc.vertices.offset};
      vertexInput.vertexBindingDescriptionCount = 1;
      vertexInput.pVertexBindingDescriptions = &binding;
      vertexInput.vertexAttributeDescriptionCount = 1;
      vertexInput.pVertexAttributeDescriptions = &attribute;
    }
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    rasterization.polygonMode = VK_POLYGON_MODE_FILL;
    rasterization.cullMode = desc.cull;
    rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    rasterization.depthClampEnable = desc.depthClamp ? VK_TRUE : VK_FALSE;
    rasterization.lineWidth = 1.0f;
    multisample.rasterizationSamples = desc.samples;
    depth.depthTestEnable = desc.depthTest ? VK_TRUE : VK_FALSE;
    depth.depthWriteEnable = desc.depthWrite ? VK_TRUE : VK_FALSE;
    depth.depthCompareOp = desc.depthCompare;
    blend.attachmentCount = colorCount(desc);
    for (uint32_t i = 0; i < blend.attachmentCount; ++i)
      attachments[i] = blendState(desc.colors[i].blend);
    blend.pAttachments = attachments;
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamicStates;
  }
  FixedFunctions(const FixedFunctions&) = delete;
  FixedFunctions& operator=(const FixedFunctions&) = delete;
};

Status checkTarget(const Device& device, const GraphicsPipelineDesc& desc) {
  if (desc.renderPass == VK_NULL_HANDLE && !device.enabled().dynamicRendering) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "Pipeline \"%s\" names no VkRenderPass, but the host's device was made "
                       "without dynamicRendering.",
                       desc.fragment.name);
  }
  if (desc.renderPass == VK_NULL_HANDLE && colorCount(desc) == 0 &&
      desc.depthFormat == VK_FORMAT_UNDEFINED) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Pipeline \"%s\" has no colour format and no depth format, but dynamic "
                       "rendering needs one.",
                       desc.vertex.name);
  }
  if (desc.renderPass != VK_NULL_HANDLE && desc.viewMask != 0) {
    return device.fail(
        Status::InvalidArgument, VK_SUCCESS,
        "Pipeline \"%s\" has view mask 0x%x beside a VkRenderPass, but a render pass "
        "brings its own: 0 is expected.",
        desc.fragment.name, desc.viewMask);
  }
  return checkConstants(device, desc.fragment.name, desc.constantCount);
}

VkPipelineRenderingCreateInfo renderingOf(const GraphicsPipelineDesc& desc,
                                          VkFormat colors[kMaxColorTargets]) {
  const VkFormat format = desc.depthFormat;
  const bool stencil = desc.stencil && (format == VK_FORMAT_D16_UNORM_S8_UINT ||
                                        format == VK_FORMAT_D24_UNORM_S8_UINT ||
                                        format == VK_FORMAT_D32_SFLOAT_S8_UINT);
  auto rendering =
      structure<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
  rendering.viewMask = desc.viewMask;
  rendering.colorAttachmentCount = colorCount(desc);
  for (uint32_t i = 0; i < kMaxColorTargets; ++i) colors[i] = desc.colors[i].format;
  rendering.pColorAttachmentFormats = colors;
  rendering.depthAttachmentFormat = format;
  rendering.stencilAttachmentFormat = stencil ? format : VK_FORMAT_UNDEFINED;
  return rendering;
}

uint64_t graphicsKey(const GraphicsPipelineDesc& desc) {
  uint64_t key = 0;
  for (const Shader* shader : {&desc.vertex, &desc.geometry, &desc.fragment}) {
    if (shader->code == nullptr) continue;
    key = std::rotl(key, 21) ^ variantKey(*shader, desc.constants, desc.constantCount);
  }
  return key;
}

}  // namespace

SpecConstant specUint(uint32_t id, uint32_t value) { return {id, value}; }
SpecConstant specInt(uint32_t id, int32_t value) { return {id, static_cast<uint32_t>(value)}; }
SpecConstant specBool(uint32_t id, bool value) { return {id, value ? VK_TRUE : VK_FALSE}; }
SpecConstant specFloat(uint32_t id, float value) { return {id, std::bit_cast<uint32_t>(value)}; }

uint64_t variantKey(const Shader& shader, const SpecConstant* constants, uint32_t constantCount) {
  // FNV-1a over 32-bit words: equal inputs give equal keys on every machine.
  uint64_t key = 14695981039346656037ull;
  const auto mix = [&key](uint32_t word) { key = (key ^ word) * 1099511628211ull; };
  for (size_t i = 0; i < shader.bytes / 4; ++i) mix(shader.code[i]);
  for (uint32_t i = 0; i < constantCount; ++i) {
    mix(constants[i].id);
    mix(constants[i].value);
  }
  return key;
}

void setArea(const Device& device, VkCommandBuffer commands, const VkRect2D& area) {
  const VkViewport viewport = {static_cast<float>(area.offset.x),
                               static_cast<float>(area.offset.y),
                               static_cast<float>(area.extent.width),
                               static_cast<float>(area.extent.height),
                               0.0f,
                               1.0f};
  device.vk().CmdSetViewport(commands, 0, 1, &viewport);
  device.vk().CmdSetScissor(commands, 0, 1, &area);
}

Status createPipelineLayout(Device& device, const VkDescriptorSetLayout* setLayouts,
                            uint32_t setLayoutCount, const VkPushConstantRange* ranges,
                            uint32_t rangeCount, const char* name, VkPipelineLayout* out) {
  *out = VK_NULL_HANDLE;
  for (uint32_t i = 0; i < rangeCount; ++i) {
    const uint32_t end = ranges[i].offset + ranges[i].size;
    if (end > device.limits().maxPushConstantsSize) {
      return device.fail(Status::Unsupported, VK_SUCCESS,
                         "Pipeline layout \"%s\" has push constants up to byte %u, but the device "
                         "allows %u bytes.",
                         name, end, device.limits().maxPushConstantsSize);
    }
  }
  auto info = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  info.setLayoutCount = setLayoutCount;
  info.pSetLayouts = setLayouts;
  info.pushConstantRangeCount = rangeCount;
  info.pPushConstantRanges = ranges;
  const VkResult result =
      device.vk().CreatePipelineLayout(device.handle(), &info, device.allocator(), out);
  if (result < 0) {
    *out = VK_NULL_HANDLE;
    return device.failVk(result, "vkCreatePipelineLayout", "layout", name);
  }
  device.setName(VK_OBJECT_TYPE_PIPELINE_LAYOUT, handleNumber(*out), name);
  return Status::Ok;
}

Status createComputePipeline(Device& device, const ComputePipelineDesc& given, VkPipeline* out) {
  *out = VK_NULL_HANDLE;
  ComputePipelineDesc desc = given;
  Status status = chooseShader(device, given.shader, &desc.shader);
  if (status == Status::Ok) status = checkConstants(device, desc.shader.name, desc.constantCount);
  if (status != Status::Ok) return status;
  const Specialization specialization(desc.constants, desc.constantCount);
  Stages stages(device, specialization.info());
  status = stages.add(VK_SHADER_STAGE_COMPUTE_BIT, desc.shader);
  if (status != Status::Ok) return status;

  auto info =
      structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage = stages.data()[0];
  info.layout = desc.layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult result = device.vk().CreateComputePipelines(
      device.handle(), device.pipelineCache(), 1, &info, device.allocator(), &pipeline);
  if (result < 0) {
    return device.failVk(result, "vkCreateComputePipelines", "shader", desc.shader.name);
  }
  *out = pipeline;
  device.setName(VK_OBJECT_TYPE_PIPELINE, handleNumber(pipeline), desc.shader.name);
  device.countPipeline(variantKey(desc.shader, desc.constants, desc.constantCount));
  return Status::Ok;
}

Status createGraphicsPipeline(Device& device, const GraphicsPipelineDesc& given, VkPipeline* out) {
  *out = VK_NULL_HANDLE;
  GraphicsPipelineDesc desc = given;
  for (Shader* shader : {&desc.vertex, &desc.geometry, &desc.fragment}) {
    const Status chosen = chooseShader(device, *shader, shader);
    if (chosen != Status::Ok) return chosen;
  }
  Status status = checkTarget(device, desc);
  if (status != Status::Ok) return status;
  const Specialization specialization(desc.constants, desc.constantCount);
  Stages stages(device, specialization.info());
  status = stages.add(VK_SHADER_STAGE_VERTEX_BIT, desc.vertex);
  if (status == Status::Ok && desc.geometry.code != nullptr) {
    status = stages.add(VK_SHADER_STAGE_GEOMETRY_BIT, desc.geometry);
  }
  if (status == Status::Ok && (desc.fragment.code != nullptr || colorCount(desc) > 0)) {
    status = stages.add(VK_SHADER_STAGE_FRAGMENT_BIT, desc.fragment);
  }
  if (status != Status::Ok) return status;

  const FixedFunctions fixed(desc);
  VkFormat colors[kMaxColorTargets];
  const VkPipelineRenderingCreateInfo rendering = renderingOf(desc, colors);
  auto info =
      structure<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.pNext = desc.renderPass == VK_NULL_HANDLE ? &rendering : nullptr;
  info.stageCount = stages.count();
  info.pStages = stages.data();
  info.pVertexInputState = &fixed.vertexInput;
  info.pInputAssemblyState = &fixed.assembly;
  info.pViewportState = &fixed.viewport;
  info.pRasterizationState = &fixed.rasterization;
  info.pMultisampleState = &fixed.multisample;
  info.pDepthStencilState = &fixed.depth;
  info.pColorBlendState = &fixed.blend;
  info.pDynamicState = &fixed.dynamic;
  info.layout = desc.layout;
  info.renderPass = desc.renderPass;
  info.subpass = desc.subpass;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult result = device.vk().CreateGraphicsPipelines(
      device.handle(), device.pipelineCache(), 1, &info, device.allocator(), &pipeline);
  if (result < 0) {
    return device.failVk(result, "vkCreateGraphicsPipelines", "shader", desc.fragment.name);
  }
  *out = pipeline;
  device.setName(VK_OBJECT_TYPE_PIPELINE, handleNumber(pipeline), desc.fragment.name);
  device.countPipeline(graphicsKey(desc));
  return Status::Ok;
}

}  // namespace alpenglow::engine
