// A host's images, and the library's objects for them.
#pragma once

#include "atmosphere/view/view.h"
#include "engine/memory.h"
#include "engine/pipeline.h"
#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {

inline constexpr VkFormat kLightShaftColor = VK_FORMAT_R32G32B32A32_SFLOAT;

/// What is drawn how.
struct LightShaftSetup {
  LightShaftMethod method = LightShaftMethod::LightVolume;
  DepthConvention depth = DepthConvention::Reversed;
  Projection projection = Projection::Perspective;
  bool fromLut = true;  ///< Light from LUTs, else integrated.
  VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;
  uint32_t shadowMapSize = 1024;
  uint32_t meshSize = 0;
  uint32_t stepCount = 0;
  double multipleLoss = -1.0;
  bool hostDepth = true;            ///< The casters are drawn into the depth image too.
  bool closed = false;              ///< The casters are.
  EffectFlags disabledEffects = 0;  ///< Of the view.
  bool shafts = true;               ///< Else aerial perspective alone.
  uint32_t passes = 1;              ///< Drawn so often; the last is timed.
};

/// Push constants of host_depth.vert.
struct HostConstants {
  float clipFromCamera[16];
  float fromCamera[4];
};

/// Of a view that draws so.
ViewDesc viewDescOf(const LightShaftSetup& setup);

/// All that pictures of one setup need; nothing of a frame.
struct LightShaftRig {
  LightShaftRig(Context* context, headless::Device& host, const LightShaftSetup& setup,
                VkExtent2D size, const Tables* tables);
  ~LightShaftRig();
  LightShaftRig(const LightShaftRig&) = delete;
  LightShaftRig& operator=(const LightShaftRig&) = delete;

  bool isValidFor(const LightShaftSetup& other, VkExtent2D size) const;
  /// Appends a copy of the image to the readback buffer; returns its offset.
  VkDeviceSize copyBack(VkCommandBuffer commands, engine::Image& image, VkImageAspectFlags aspect,
                        uint32_t texelBytes);
  std::vector<float> floats(VkDeviceSize offset, size_t count) const;

  engine::Device& device;
  const LightShaftSetup setup;
  engine::Image color, depth;
  engine::MemoryBlock block;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;  ///< Draws the casters' depth.
  headless::HostBuffer readback;
  VkDeviceSize used = 0;
  HostImage scene;  ///< What a frame states of the depth.
  View* view = nullptr;

 private:
  void makeHost(headless::Device& host);
  void makeView(Context* context, const Tables* tables);
};

}  // namespace alpenglow::testing
