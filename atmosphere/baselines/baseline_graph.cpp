#include "atmosphere/baselines/baseline_graph.h"

#include <alpenglow/shaders/hillaire_multiple_rgba16f.h>
#include <alpenglow/shaders/hillaire_multiple_rgba32f.h>
#include <alpenglow/shaders/optical_depth_rgba16f.h>
#include <alpenglow/shaders/optical_depth_rgba32f.h>
#include <alpenglow/shaders/schafhitzel_single_rgba16f.h>
#include <alpenglow/shaders/schafhitzel_single_rgba32f.h>

#include <algorithm>
#include <cstring>

#include "atmosphere/parameters/physics_cpp.h"

namespace alpenglow::baselines {
namespace {

using tables::BakeGraph;
using tables::Stage;

/// Texels of Hillaire's table of multiple scattering; also in multipleCoordinate of
/// shaders/glsl/baselines/hillaire.glsl.
constexpr uint32_t kMultipleSide = 32;
/// Of Schafhitzel's table, mu_s x mu x r.
constexpr VkExtent3D kSingleExtent = {32, 128, 32};

/// The uniform block of set 0, binding 0 (std140): alpenglow/baseline_tables.glsl.
struct BaselineConstants {
  physics_f32::Medium medium;
  float transmittanceMu, transmittanceR, irradianceMuS, irradianceR;
  float scatteringR, scatteringMu, scatteringMuS, scatteringNu;
  float stepCount, unused[3];
};
static_assert(sizeof(BaselineConstants) == 160);

// The variant of a shader for a table format.
#define ALPENGLOW_SHADER(name, format)                                                       \
  ((format) == TableFormat::Half                                                             \
       ? engine::Shader{shaders::name##Half, sizeof shaders::name##Half, #name " (rgba16f)"} \
       : engine::Shader{shaders::name##Float, sizeof shaders::name##Float, #name " (rgba32f)"})

uint32_t addImage(BakeGraph* graph, const char* name, VkImageType type, VkExtent3D extent,
                  TableFormat format) {
  tables::BakeImage image;
  image.name = name;
  image.type = type;
  image.extent = extent;
  image.format = tables::vulkanFormat(format);
  image.persistent = true;
  return graph->addImage(image);
}

Stage stageFor(const VkExtent3D& extent, const engine::Shader& shader, uint64_t unitsPerTexel) {
  Stage stage;
  stage.shader = shader;
  stage.width = extent.width;
  stage.height = extent.height;
  stage.rows = extent.height * extent.depth;
  stage.unitsPerTexel = unitsPerTexel;
  return stage;
}

/// Pass "T". A model without tables has it too, with the fewest texels, because each binding of the
/// set that hosts bind must hold an image.
void addOpticalDepth(BakeGraph* graph, VkExtent3D extent, TableFormat finest) {
  const uint32_t t = addImage(graph, "Alpenglow T", VK_IMAGE_TYPE_2D, extent, finest);
  Stage stage = stageFor(extent, ALPENGLOW_SHADER(kOpticalDepth, finest), 200);
  stage.outputs = {{t}};
  graph->addPass(graph->addStage(stage), "T", 0);
  std::fill_n(graph->bound, tables::kBoundTables, t);
}

void addMultiple(BakeGraph* graph, TableFormat finest) {
  const VkExtent3D extent = {kMultipleSide, kMultipleSide, 1};
  const uint32_t psi = addImage(graph, "Alpenglow Psi", VK_IMAGE_TYPE_2D, extent, finest);
  // For 64 directions with 20 steps, and the ground.
  Stage stage = stageFor(extent, ALPENGLOW_SHADER(kHillaireMultiple, finest), uint64_t{64} * 21);
  stage.inputs = {{1, graph->bound[0]}};
  stage.outputs = {{psi}};
  graph->addPass(graph->addStage(stage), "Psi", 0);
  graph->bound[1] = psi;
}

void addSingle(BakeGraph* graph, TableFormat format) {
  const auto add = [&](const char* name) {
    return addImage(graph, name, VK_IMAGE_TYPE_3D, kSingleExtent, format);
  };
  const uint32_t rayleigh = add("Alpenglow S Rayleigh"), mie = add("Alpenglow S Mie");
  Stage stage = stageFor(kSingleExtent, ALPENGLOW_SHADER(kSchafhitzelSingle, format), 51 * 3);
  stage.inputs = {{1, graph->bound[0]}};
  stage.outputs = {{rayleigh}, {mie}};
  graph->addPass(graph->addStage(stage), "S", 1);
  graph->bound[1] = rayleigh;
  graph->bound[2] = mie;
}

#undef ALPENGLOW_SHADER

}  // namespace

BakeGraph baselineGraph(const Parameters& parameters, const TableDesc& desc, TableFormat finest) {
  const bool tables = desc.solver != Solver::HoffmanPreetham;
  const VkExtent3D t = tables ? VkExtent3D{256, 64, 1} : VkExtent3D{2, 2, 1};
  BakeGraph graph;
  addOpticalDepth(&graph, t, finest);
  if (desc.solver == Solver::Hillaire) addMultiple(&graph, finest);
  if (desc.solver == Solver::Schafhitzel) addSingle(&graph, desc.format);

  const auto f = [](uint32_t size) { return static_cast<float>(size); };
  BaselineConstants constants = {};
  constants.medium = makeMediumF32(parameters);
  constants.transmittanceMu = f(t.width);
  constants.transmittanceR = f(t.height);
  constants.scatteringMuS = f(kSingleExtent.width);
  constants.scatteringMu = f(kSingleExtent.height);
  constants.scatteringR = f(kSingleExtent.depth);
  constants.scatteringNu = 1.0f;
  constants.stepCount = f(desc.sizes.stepCount);
  graph.uniforms.resize(sizeof constants);
  std::memcpy(graph.uniforms.data(), &constants, sizeof constants);
  return graph;
}

}  // namespace alpenglow::baselines
