// The tables as pictures in the panel, drawn straight from the images that the sky is drawn with.
#pragma once

#include <alpenglow/tables.h>

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "presenter.h"

struct ImDrawCmd;
struct ImDrawList;

namespace alpenglow::view {

class TablePictures {
 public:
  /// All outlive it. Throws.
  TablePictures(const samples::Gpu* gpu, VkRenderPass renderPass);

  /// A choice of table, layer and brightness, and the picture, at the cursor of the panel. Throws.
  void make(const Tables* tables, const TableDesc& desc);

 private:
  /// The values of black and white, or their logarithms.
  struct Look {
    float from, to;
    bool logarithm;
  };
  /// A binding of TablesInfo::set, as alpenglow/*_tables.glsl declare them.
  struct Shown {
    const char* name;
    const char* axes;
    uint32_t binding;
    bool volume;
    Look look;  ///< A useful range for an atmosphere like the Earth's.
  };
  static std::vector<Shown> tablesOf(const TableDesc& desc);
  VkPipeline pipelineFor(const Shown& shown);
  struct Push {
    float area[4];
    float look[4];
  };
  struct Draw {
    const TablePictures* owner;
    VkPipeline pipeline;
    VkDescriptorSet set;
    Push push;
  };
  static void draw(const ImDrawList* list, const ImDrawCmd* command);

  const samples::Gpu* gpu_;
  VkRenderPass renderPass_;
  Functions vk_;
  samples::Owned<VkPipelineLayout> layout_;
  std::map<std::pair<uint32_t, bool>, samples::Owned<VkPipeline>> pipelines_;
  std::deque<Draw> draws_;  ///< Of this frame.
  size_t chosen_ = 0;
  float layer_ = 0.0f;
  std::map<std::string, Look> looks_;  ///< By the table's name.
};

}  // namespace alpenglow::view
