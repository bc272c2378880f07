// A solver's bake as a graph: its images, the compute shaders that fill them, their inputs and
// order, and the images that hold tables of the public API. The rest of this folder (table_set.h,
// table_record.cpp) executes any such graph.
#pragma once

#include <alpenglow/tables.h>

#include <vector>

#include "engine/pipeline.h"

namespace alpenglow::tables {

struct BakeImage {
  const char* name = "";  ///< For error sentences and debug names.
  VkImageType type = VK_IMAGE_TYPE_2D;
  VkExtent3D extent = {1, 1, 1};
  VkFormat format = VK_FORMAT_UNDEFINED;
  bool persistent = false;  ///< Outlives the bake; all such images are what an upload fills.
  bool filtered = true;     ///< Read with linear filtering; else with texelFetch only.
};

/// An image that a stage samples, at this binding of set 0. Binding 0 is the uniform block.
struct StageInput {
  uint32_t binding = 0;
  uint32_t image = 0;
};

/// An image that a stage stores; the binding of set 1 is its place in the list.
struct StageOutput {
  uint32_t image = 0;
  bool accumulates = false;  ///< Read and written in place, each texel by its own invocation.
};

/// The image that holds a table of the public API.
struct TableImage {
  TableId id = kTableOpticalDepth;
  uint32_t image = 0;
};

inline constexpr uint32_t kStageConstants = 2;

/// A compute shader with its images: one invocation makes one texel of a 2D or 3D table of
/// width x rows, rows = height x depth. Passes that differ in nothing else share their stage.
struct Stage {
  engine::Shader shader;
  bool constants[kStageConstants] = {};  ///< Specialization constants 0 ...
  EffectFlags disabledEffects = 0;       ///< What it is compiled without.
  uint32_t width = 0, height = 0, rows = 0;
  uint64_t unitsPerTexel = 0;  ///< Work units: about one table fetch each.
  std::vector<StageInput> inputs;
  std::vector<StageOutput> outputs;
  std::vector<TableImage> finishes;  ///< Tables of its order that can be read right after it.

  uint64_t unitsPerRow() const { return width * unitsPerTexel; }
};

struct Pass {
  uint32_t stage = 0;
  uint32_t order = 0;  ///< 0: belongs to none.
  char name[16] = "";
};

inline constexpr uint32_t kBoundTables = 4;  ///< Sampled images of the set that hosts bind.
inline constexpr uint32_t kMaxInputs = 8;    ///< Sampled images of a stage, bindings 1 ... 8.
inline constexpr uint32_t kMaxOutputs = 3;
inline constexpr uint32_t kNoImage = ~0u;

struct BakeGraph {
  std::vector<BakeImage> images;
  std::vector<Stage> stages;
  std::vector<Pass> passes;
  /// Where each table is; those of single orders (isOrderTable) for their shape alone.
  std::vector<TableImage> tables;
  uint32_t bound[kBoundTables] = {};    ///< Images of bindings 1 ... of the set that hosts bind.
  std::vector<unsigned char> uniforms;  ///< Bytes of the uniform block, std140.

  uint32_t addImage(const BakeImage& image);
  uint32_t addStage(const Stage& stage);
  /// Named "symbol order", or "symbol" for order 0.
  void addPass(uint32_t stage, const char* symbol, uint32_t order);

  /// kNoImage when this plan has no such table.
  uint32_t imageOf(TableId id) const;
  /// The image of a table of an order right after this pass; kNoImage when the pass finishes none.
  uint32_t imageAfter(const Pass& pass, TableId id) const;
};

/// Cost of a graph's images and passes in an unsliced bake.
struct TableCost {
  uint64_t bytes = 0;      ///< Of images that stay.
  uint64_t bakeBytes = 0;  ///< Of images that only the bake needs.
  uint64_t texels = 0;     ///< Of images that stay.
  uint64_t images = 0;     ///< That stay.
  uint64_t pipelines = 0;
  uint64_t dispatches = 0;
  uint64_t units = 0;
};
TableCost costOf(const BakeGraph& graph);
uint64_t bytesOf(const BakeImage& image);
/// Without the library's own name before it.
const char* shortName(const BakeImage& image);

/// Tables of single orders, which only TableDesc::keepOrders shows.
constexpr bool isOrderTable(TableId id) { return id >= kTableOrderMoments; }

/// Algorithm 4.1 of the paper: T; dE 1; dS 1; then dL n, dJ n, dE n, dS n for n = 2 ... orders.
/// `desc` is completed; `finest` is the format of tables that differences are taken of.
BakeGraph standardGraph(const Parameters& parameters, const TableDesc& desc, TableFormat finest);

/// The moment solver: T; the rules Q, Legendre functions Y and rotations W; then for each order
/// n = 1 ... N - 1 its light on rays L n, in modes F n, in harmonics M n, about the sun R n, then
/// modes H n, the field N n and between its nodes I n, and the source J n + 1; last the sums of
/// field and source, with their tail. `desc` is completed.
BakeGraph momentGraph(const Parameters& parameters, const TableDesc& desc);

VkFormat vulkanFormat(TableFormat format);

/// Rows of the smallest part of a pass that is dispatched alone: the height of a workgroup.
inline constexpr uint32_t kTileRows = 8;

}  // namespace alpenglow::tables
