// The sky-view LUT of a frame's camera, for all its rays: light along rays (Moments), or S at its
// altitude (Standard). After Hillaire 2020.
#pragma once

#include "atmosphere/camera/camera_math.h"
#include "atmosphere/passes/lut.h"

namespace alpenglow::passes {

/// Owned by a view; externally synchronised.
class SkyViewLut {
 public:
  explicit SkyViewLut(tables::Resources& resources) : lut_(resources) {}
  /// For tables of this completed description, and a view with these disabled effects.
  Status make(const TableDesc& desc, EffectFlags disabledEffects, VkPipelineStageFlags2 readers);
  void destroy(uint64_t frame) { lut_.destroy(frame); }
  bool made() const { return lut_.made(); }

  /// Texels of an image of it, and how many there are.
  static VkExtent3D extentFor(const TableDesc& desc, EffectFlags disabledEffects);
  static uint32_t countFor(const TableDesc& desc, EffectFlags disabledEffects);
  /// Whether there is one for the draw's camera: Moments always, else inside the atmosphere.
  static bool possible(const Tables& tables, const FrameState& draw);

  /// Whether it is up to date for this draw.
  bool current(const Tables& tables, const FrameState& draw) const;
  Status record(VkCommandBuffer commands, const Tables& tables, const FrameState& draw);
  Lut& lut() { return lut_; }
  const Lut& lut() const { return lut_; }

  /// Moments: ln of radiance, and the share of Mie in it. Standard: C_*, and C_M (when packed the
  /// first image again, so that each binding has one). Hillaire: one image with all light.
  const engine::Image& image() const { return lut_.image(0); }
  const engine::Image& mieImage() const { return lut_.image(1); }
  /// Columns that skyViewGrid counts, and rows.
  uint32_t columns() const { return columns_; }
  uint32_t rows() const { return extent_.height; }

 private:
  Lut lut_;
  Solver solver_ = Solver::Moments;
  VkExtent3D extent_ = {};
  uint32_t columns_ = 0;
};

}  // namespace alpenglow::passes
