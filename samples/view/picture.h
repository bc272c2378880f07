// The window's picture: linear radiance in a target of its own, and how it comes to the window.
#pragma once

#include <alpenglow/io/tone_map.h>

#include <optional>

#include "presenter.h"

namespace alpenglow::view {

inline constexpr VkFormat kRadianceFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

/// How radiance is shown.
struct Tone {
  double exposure = 1.0;
  io::ToneMap map = io::ToneMap::Filmic;
  float balance[3] = {1.0f, 1.0f, 1.0f};
};

class Picture {
 public:
  /// Of at most `size` pixels. All outlive it. Throws.
  Picture(const samples::Gpu* gpu, const Presenter* presenter, VkExtent2D size);

  const headless::Image& target() const { return target_; }
  /// Between these two the target is drawn into, in kColorDrawn.
  void beginDrawing(VkCommandBuffer commands) const;
  void endDrawing(VkCommandBuffer commands) const;

  /// Copies a small picture of what was drawn, for exposures.
  void measure(const Frame& frame, VkExtent2D drawn);
  /// The exposure of what was measured when this slot was last used, once.
  std::optional<double> measured(const Frame& frame);

  /// Into the window's pass: the `drawn` pixels, scaled to the whole of it.
  void show(const Frame& frame, VkExtent2D drawn, const Tone& tone) const;

  /// What was drawn, for files. Waits.
  io::LinearImage read(VkExtent2D drawn) const;

 private:
  void makeSet();

  const samples::Gpu* gpu_;
  Functions vk_;
  headless::Image target_;
  struct Measure {
    headless::Image small;
    headless::HostBuffer texels;
    bool written = false;
  };
  Measure measures_[kFramesInFlight];
  samples::Owned<VkSampler> sampler_;
  samples::Owned<VkDescriptorSetLayout> setLayout_;
  samples::Owned<VkDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  samples::Owned<VkPipelineLayout> layout_;
  samples::Owned<VkPipeline> pipeline_;
};

}  // namespace alpenglow::view
