// Compute and graphics pipelines with specialization constants.
#pragma once

#include "engine/device.h"

namespace alpenglow::engine {

/// A 32-bit specialization constant; floats and bools by their bit pattern.
struct SpecConstant {
  uint32_t id = 0;
  uint32_t value = 0;
};

SpecConstant specUint(uint32_t id, uint32_t value);
SpecConstant specInt(uint32_t id, int32_t value);
SpecConstant specBool(uint32_t id, bool value);
SpecConstant specFloat(uint32_t id, float value);

/// SPIR-V with the entry point `main`; not owned.
struct Shader {
  const uint32_t* code = nullptr;
  size_t bytes = 0;
  const char* name = "";
};

/// The host's code in place of `own` (DeviceDesc::shaders), if it gives any, else `own`.
/// InvalidArgument for code that doesn't fit in its place. The calls below do this with each of
/// their shaders; also for caches, whose keys need the code that is used.
Status chooseShader(const Device& device, const Shader& own, Shader* out);

inline constexpr uint32_t kMaxSpecConstants = 32;

Status createPipelineLayout(Device& device, const VkDescriptorSetLayout* setLayouts,
                            uint32_t setLayoutCount, const VkPushConstantRange* ranges,
                            uint32_t rangeCount, const char* name, VkPipelineLayout* out);

struct ComputePipelineDesc {
  Shader shader;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  const SpecConstant* constants = nullptr;  ///< At most kMaxSpecConstants.
  uint32_t constantCount = 0;
};

/// InvalidArgument when the code is not SPIR-V (empty, not whole words, wrong magic number) or
/// there are too many constants; else what vkCreateShaderModule and vkCreateComputePipelines
/// answer. Named after its shader. On failure `*out` is null. May be called from several threads.
Status createComputePipeline(Device& device, const ComputePipelineDesc& desc, VkPipeline* out);

enum class Blend : uint32_t {
  None,
  Add,         ///< Source + destination.
  Max,         ///< Of source and destination.
  DualSource,  ///< Source + destination times the second source (index 1 of location 0).
};

struct ColorTarget {
  VkFormat format = VK_FORMAT_UNDEFINED;
  Blend blend = Blend::None;
};
inline constexpr uint32_t kMaxColorTargets = 2;

enum class Topology : uint32_t { Triangles, TrianglesWithAdjacency, TriangleStrip };

/// Positions of three floats, from a buffer that is bound at binding 0, at location 0.
struct VertexInput {
  uint32_t stride = 0;  ///< Bytes; 0: no vertex input.
  uint32_t offset = 0;
};

/// By default a pipeline for a triangle that covers the viewport: no vertex input, triangle list,
/// no blending, no depth write, no culling. Viewport and scissor are dynamic. The front of a
/// triangle is where its vertices run counter-clockwise in the picture as it is seen.
struct GraphicsPipelineDesc {
  Shader vertex;
  Shader geometry;  ///< Optional: no code, no stage.
  Shader fragment;  ///< Optional without colour.
  VkPipelineLayout layout = VK_NULL_HANDLE;
  const SpecConstant* constants = nullptr;  ///< The same list for every stage.
  uint32_t constantCount = 0;
  VertexInput vertices;
  Topology topology = Topology::Triangles;
  ColorTarget colors[kMaxColorTargets];        ///< Those before the first without a format.
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;  ///< UNDEFINED: no depth attachment.
  bool stencil = true;                         ///< A depthFormat with stencil is attached for both.
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  uint32_t viewMask = 0;                     ///< Of dynamic rendering.
  VkRenderPass renderPass = VK_NULL_HANDLE;  ///< Null: dynamic rendering with the formats above.
  uint32_t subpass = 0;
  VkCullModeFlags cull = VK_CULL_MODE_NONE;
  bool depthTest = false;
  bool depthWrite = false;
  /// Needs the feature: nothing is clipped at the near and far planes.
  bool depthClamp = false;
  VkCompareOp depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
};

/// As createComputePipeline; also Unsupported when renderPass is null and dynamicRendering is not
/// enabled.
Status createGraphicsPipeline(Device& device, const GraphicsPipelineDesc& desc, VkPipeline* out);

/// Sets viewport and scissor of the pipelines above; depth from 0 to 1.
void setArea(const Device& device, VkCommandBuffer commands, const VkRect2D& area);

/// 64-bit key of code and constants, equal for equal ones; what shaderVariants counts.
uint64_t variantKey(const Shader& shader, const SpecConstant* constants, uint32_t constantCount);

}  // namespace alpenglow::engine
