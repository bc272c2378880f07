#include "atmosphere/tables/bake_graph.h"

#include <cstdio>
#include <string_view>

namespace alpenglow::tables {
namespace {

uint32_t find(const std::vector<TableImage>& tables, TableId id) {
  for (const TableImage& table : tables)
    if (table.id == id) return table.image;
  return kNoImage;
}

}  // namespace

uint32_t BakeGraph::addImage(const BakeImage& image) {
  images.push_back(image);
  return static_cast<uint32_t>(images.size() - 1);
}

uint32_t BakeGraph::addStage(const Stage& stage) {
  stages.push_back(stage);
  return static_cast<uint32_t>(stages.size() - 1);
}

void BakeGraph::addPass(uint32_t stage, const char* symbol, uint32_t order) {
  Pass pass;
  pass.stage = stage;
  pass.order = order;
  if (order == 0) {
    std::snprintf(pass.name, sizeof pass.name, "%s", symbol);
  } else {
    std::snprintf(pass.name, sizeof pass.name, "%s %u", symbol, order);
  }
  passes.push_back(pass);
}

uint32_t BakeGraph::imageOf(TableId id) const { return find(tables, id); }

uint32_t BakeGraph::imageAfter(const Pass& pass, TableId id) const {
  return find(stages[pass.stage].finishes, id);
}

uint64_t bytesOf(const BakeImage& image) {
  const uint64_t texel = image.format == VK_FORMAT_R32G32B32A32_SFLOAT   ? 16
                         : image.format == VK_FORMAT_R16G16B16A16_SFLOAT ? 8
                                                                         : 4;
  return texel * image.extent.width * image.extent.height * image.extent.depth;
}

const char* shortName(const BakeImage& image) {
  constexpr std::string_view kOwn = "Alpenglow ";
  return image.name + (std::string_view(image.name).starts_with(kOwn) ? kOwn.size() : 0);
}

TableCost costOf(const BakeGraph& graph) {
  TableCost cost;
  for (const BakeImage& image : graph.images) {
    (image.persistent ? cost.bytes : cost.bakeBytes) += bytesOf(image);
    if (!image.persistent) continue;
    ++cost.images;
    cost.texels += uint64_t{image.extent.width} * image.extent.height * image.extent.depth;
  }
  cost.pipelines = graph.stages.size();
  cost.dispatches = graph.passes.size();
  for (const Pass& pass : graph.passes)
    cost.units += graph.stages[pass.stage].unitsPerRow() * graph.stages[pass.stage].rows;
  return cost;
}

VkFormat vulkanFormat(TableFormat format) {
  return format == TableFormat::Half ? VK_FORMAT_R16G16B16A16_SFLOAT
                                     : VK_FORMAT_R32G32B32A32_SFLOAT;
}

}  // namespace alpenglow::tables
