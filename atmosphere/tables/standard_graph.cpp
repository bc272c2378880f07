#include <alpenglow/shaders/diffuse_irradiance_rgba16f.h>
#include <alpenglow/shaders/diffuse_irradiance_rgba32f.h>
#include <alpenglow/shaders/direct_irradiance_rgba16f.h>
#include <alpenglow/shaders/direct_irradiance_rgba32f.h>
#include <alpenglow/shaders/incident_radiance_rgba16f.h>
#include <alpenglow/shaders/incident_radiance_rgba32f.h>
#include <alpenglow/shaders/multiple_scattering_rgba16f.h>
#include <alpenglow/shaders/multiple_scattering_rgba32f.h>
#include <alpenglow/shaders/optical_depth_rgba16f.h>
#include <alpenglow/shaders/optical_depth_rgba32f.h>
#include <alpenglow/shaders/scattering_density_rgba16f.h>
#include <alpenglow/shaders/scattering_density_rgba32f.h>
#include <alpenglow/shaders/single_scattering_rgba16f.h>
#include <alpenglow/shaders/single_scattering_rgba32f.h>

#include <cstring>

#include "atmosphere/parameters/physics_cpp.h"
#include "atmosphere/tables/bake_graph.h"

namespace alpenglow::tables {
namespace {

/// Zenith angles of the quadrature of J: kSphereTheta of shaders/glsl/physics/standard.glsl.
constexpr uint32_t kSphereTheta = 16;

/// Twin of TableShape in shaders/glsl/physics/lookup.glsl.
struct ShapeConstants {
  float transmittanceMu, transmittanceR, irradianceMuS, irradianceR;
  float scatteringR, scatteringMu, scatteringMuS, scatteringNu;
};

/// The uniform block of set 0, binding 0 (std140).
struct AtmosphereConstants {
  physics_f32::Medium medium;
  ShapeConstants shape;
};
static_assert(sizeof(AtmosphereConstants) == 144);

// A shader in the build for a format.
#define ALPENGLOW_SHADER(name, format)                                                       \
  ((format) == TableFormat::Half                                                             \
       ? engine::Shader{shaders::name##Half, sizeof shaders::name##Half, #name " (rgba16f)"} \
       : engine::Shader{shaders::name##Float, sizeof shaders::name##Float, #name " (rgba32f)"})

/// Builds the graph; its members are the images that several stages share.
class Builder {
 public:
  Builder(const TableDesc& desc, TableFormat finest) : desc_(desc), finest_(finest) {}

  BakeGraph build() {
    addTables();
    addFirstOrder();
    if (desc_.orders > 1) addFurtherOrders();
    return std::move(graph_);
  }

 private:
  uint32_t image(const char* name, VkImageType type, VkExtent3D extent, bool persistent) {
    BakeImage image;
    image.name = name;
    image.type = type;
    image.extent = extent;
    image.format = vulkanFormat(desc_.format);
    image.persistent = persistent;
    return graph_.addImage(image);
  }

  Stage stageFor(uint32_t image, const engine::Shader& shader, uint64_t unitsPerTexel) const {
    const VkExtent3D& extent = graph_.images[image].extent;
    Stage stage;
    stage.shader = shader;
    stage.width = extent.width;
    stage.height = extent.height;
    stage.rows = extent.height * extent.depth;
    stage.unitsPerTexel = unitsPerTexel;
    return stage;
  }

  void addTables() {
    const TableSizes& s = desc_.sizes;
    const bool full = desc_.mie == MieStorage::Full;
    scatteringExtent_ = {s.scatteringMuS * s.scatteringNu, s.scatteringMu, s.scatteringR};
    irradianceExtent_ = {s.irradianceMuS, s.irradianceR, 1};
    t_ = image("Alpenglow T", VK_IMAGE_TYPE_2D, {s.transmittanceMu, s.transmittanceR, 1}, true);
    // In 32 bits where it can be: the solver and the renderer take differences of optical depths,
    // and its 256 KB cost nothing.
    graph_.images[t_].format = vulkanFormat(finest_);
    e_ = image("Alpenglow E", VK_IMAGE_TYPE_2D, irradianceExtent_, true);
    s_ = image("Alpenglow S", VK_IMAGE_TYPE_3D, scatteringExtent_, true);
    // The order's Mie part is the table of single Mie scattering when that is stored in full.
    dMie_ = image("Alpenglow single Mie", VK_IMAGE_TYPE_3D, scatteringExtent_, full);
    dE_ = image("Alpenglow dE", VK_IMAGE_TYPE_2D, irradianceExtent_, false);
    dS_ = image("Alpenglow dS", VK_IMAGE_TYPE_3D, scatteringExtent_, false);
    graph_.tables = {{kTableOpticalDepth, t_},     {kTableIrradiance, e_},
                     {kTableScattering, s_},       {kTableOrderIrradiance, dE_},
                     {kTableOrderScattering, dS_}, {kTableOrderSingleMie, dMie_}};
    if (full) graph_.tables.push_back({kTableSingleMie, dMie_});
    // Packed tables have no single Mie of their own: the binding must hold an image all the same.
    const uint32_t bound[kBoundTables] = {t_, e_, s_, full ? dMie_ : s_};
    std::memcpy(graph_.bound, bound, sizeof bound);
  }

  // Work units are table fetches of one texel, from the loops of standard.glsl. T fetches nothing;
  // a trapezoid of it takes about as long as 0.4 fetches.
  void addFirstOrder() {
    Stage t = stageFor(t_, ALPENGLOW_SHADER(kOpticalDepth, finest_), 200);
    t.outputs = {{t_}};
    graph_.addPass(graph_.addStage(t), "T", 0);

    Stage direct = stageFor(dE_, ALPENGLOW_SHADER(kDirectIrradiance, desc_.format), 1);
    direct.inputs = {{1, t_}};
    direct.outputs = {{dE_}, {e_}};
    graph_.addPass(graph_.addStage(direct), "dE", 1);

    Stage single = stageFor(s_, ALPENGLOW_SHADER(kSingleScattering, desc_.format), 51 * 3);
    single.constants[1] = desc_.mie == MieStorage::Packed;
    single.inputs = {{1, t_}};
    single.outputs = {{dS_}, {dMie_}, {s_}};
    single.finishes = {
        {kTableOrderIrradiance, dE_}, {kTableOrderScattering, dS_}, {kTableOrderSingleMie, dMie_}};
    graph_.addPass(graph_.addStage(single), "dS", 1);
  }

  void addFurtherOrders() {
    const TableSizes& s = desc_.sizes;
    const VkExtent3D incident = {s.scatteringNu * kSphereTheta, s.scatteringMuS * s.scatteringR, 1};
    dJ_ = image("Alpenglow dJ", VK_IMAGE_TYPE_3D, scatteringExtent_, false);
    dL_ = image("Alpenglow dL", VK_IMAGE_TYPE_2D, incident, false);
    dLMie_ = image("Alpenglow dL Mie", VK_IMAGE_TYPE_2D, incident, false);
    // Order 2 differs: the order before it is single scattering, kept without phase functions.
    const uint32_t second = addOrderStages(true);
    const uint32_t further = desc_.orders > 2 ? addOrderStages(false) : second;
    Stage multiple = stageFor(s_, ALPENGLOW_SHADER(kMultipleScattering, desc_.format), 51 * 4);
    multiple.inputs = {{1, t_}, {5, dJ_}};
    multiple.outputs = {{dS_}, {s_, true}};
    multiple.finishes = {{kTableOrderIrradiance, dE_}, {kTableOrderScattering, dS_}};
    const uint32_t gather = graph_.addStage(multiple);
    for (uint32_t order = 2; order <= desc_.orders; ++order) {
      const uint32_t first = order == 2 ? second : further;
      graph_.addPass(first, "dL", order);
      graph_.addPass(first + 1, "dJ", order);
      graph_.addPass(first + 2, "dE", order);
      graph_.addPass(gather, "dS", order);
    }
  }

  /// dL, dJ and dE of an order; returns the first.
  uint32_t addOrderStages(bool second) {
    Stage incident = stageFor(dL_, ALPENGLOW_SHADER(kIncidentRadiance, desc_.format), 4);
    incident.constants[0] = second;
    incident.inputs = {{3, dS_}, {4, dMie_}};
    incident.outputs = {{dL_}, {dLMie_}};
    const uint32_t first = graph_.addStage(incident);

    // Half of the directions see the ground: one fetch more.
    const uint64_t directions = kSphereTheta * 2 * kSphereTheta * (second ? 2 : 1);
    Stage density =
        stageFor(dJ_, ALPENGLOW_SHADER(kScatteringDensity, desc_.format), directions * 3 / 2);
    density.constants[0] = second;
    density.inputs = {{1, t_}, {2, dE_}, {6, dL_}, {7, dLMie_}};
    density.outputs = {{dJ_}};
    graph_.addStage(density);

    Stage irradiance = stageFor(dE_, ALPENGLOW_SHADER(kDiffuseIrradiance, desc_.format),
                                16 * 64 * (second ? 4 : 2));
    irradiance.constants[0] = second;
    irradiance.inputs = {{3, dS_}, {4, dMie_}};
    irradiance.outputs = {{dE_}, {e_, true}};
    graph_.addStage(irradiance);
    return first;
  }

  const TableDesc& desc_;
  TableFormat finest_;
  BakeGraph graph_;
  VkExtent3D scatteringExtent_ = {}, irradianceExtent_ = {};
  uint32_t t_ = 0, e_ = 0, s_ = 0, dMie_ = 0, dE_ = 0, dS_ = 0, dJ_ = 0, dL_ = 0, dLMie_ = 0;
};

#undef ALPENGLOW_SHADER

}  // namespace

BakeGraph standardGraph(const Parameters& parameters, const TableDesc& desc, TableFormat finest) {
  BakeGraph graph = Builder(desc, finest).build();
  const TableSizes& s = desc.sizes;
  const auto f = [](uint32_t size) { return static_cast<float>(size); };
  AtmosphereConstants constants = {};
  constants.medium = makeMediumF32(parameters);
  constants.shape = {f(s.transmittanceMu), f(s.transmittanceR), f(s.irradianceMuS),
                     f(s.irradianceR),     f(s.scatteringR),    f(s.scatteringMu),
                     f(s.scatteringMuS),   f(s.scatteringNu)};
  graph.uniforms.resize(sizeof constants);
  std::memcpy(graph.uniforms.data(), &constants, sizeof constants);
  return graph;
}

}  // namespace alpenglow::tables
