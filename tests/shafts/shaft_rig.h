// A host's images, and the library's objects for them.
#pragma once

#include <alpenglow/shafts.h>

#include "engine/memory.h"
#include "engine/pipeline.h"
#include "tests/sky/sky_fixture.h"

namespace alpenglow::testing {

inline constexpr VkFormat kShaftColor = VK_FORMAT_R32G32B32A32_SFLOAT;

/// What is drawn how.
struct ShaftSetup {
  ShaftMethod method = ShaftMethod::Exact;
  DepthConvention depth = DepthConvention::Reversed;
  Projection projection = Projection::Perspective;
  bool sliced = true;  ///< Light from an air volume, else integrated.
  VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;
  uint32_t sunMapSize = 1024;
  uint32_t reliefSize = 0;
  uint32_t samples = 0;
  double multipleLoss = -1.0;
  bool hostDepth = true;    ///< The casters are drawn into the depth image too.
  bool closed = false;      ///< The casters are.
  EffectFlags without = 0;  ///< Of view and shafts.
  bool shafts = true;       ///< Else aerial perspective alone.
  uint32_t passes = 1;      ///< Drawn so often; the last is timed.
};

/// Push constants of host_depth.vert.
struct HostConstants {
  float clipFromCamera[16];
  float fromCamera[4];
};

/// All that pictures of one setup need; nothing of a frame.
struct ShaftRig {
  ShaftRig(Context* context, headless::Device& host, const ShaftSetup& setup, VkExtent2D size,
           const Tables* slice);
  ~ShaftRig();
  ShaftRig(const ShaftRig&) = delete;
  ShaftRig& operator=(const ShaftRig&) = delete;

  bool serves(const ShaftSetup& other, VkExtent2D size) const;
  /// Appends a copy of the image to the readback buffer; returns its offset.
  VkDeviceSize copyBack(VkCommandBuffer commands, engine::Image& image, VkImageAspectFlags aspect,
                        uint32_t texelBytes);
  std::vector<float> floats(VkDeviceSize offset, size_t count) const;

  engine::Device& device;
  const ShaftSetup setup;
  engine::Image color, depth;
  engine::MemoryBlock block;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;  ///< Draws the casters' depth.
  headless::HostBuffer readback;
  VkDeviceSize used = 0;
  SceneDepth scene;
  Shafts* shafts = nullptr;
  View* view = nullptr;
  bool sliced = false;

 private:
  void makeHost(headless::Device& host);
  void makeView(Context* context, const Tables* slice);
};

}  // namespace alpenglow::testing
