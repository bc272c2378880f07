#include <alpenglow/shaders/interpolate_nodes.h>
#include <alpenglow/shaders/moment_depth.h>
#include <alpenglow/shaders/moment_field.h>
#include <alpenglow/shaders/moment_field_none.h>
#include <alpenglow/shaders/moment_field_sum.h>
#include <alpenglow/shaders/moment_harmonics.h>
#include <alpenglow/shaders/moment_legendre.h>
#include <alpenglow/shaders/moment_light.h>
#include <alpenglow/shaders/moment_light_molecules.h>
#include <alpenglow/shaders/moment_modes.h>
#include <alpenglow/shaders/moment_rotations.h>
#include <alpenglow/shaders/moment_single.h>
#include <alpenglow/shaders/moment_single_molecules.h>
#include <alpenglow/shaders/moment_source_modes.h>
#include <alpenglow/shaders/moment_source_none_rgba16f.h>
#include <alpenglow/shaders/moment_source_none_rgba32f.h>
#include <alpenglow/shaders/moment_source_rgba16f.h>
#include <alpenglow/shaders/moment_source_rgba32f.h>
#include <alpenglow/shaders/moment_source_sum_rgba16f.h>
#include <alpenglow/shaders/moment_source_sum_rgba32f.h>
#include <alpenglow/shaders/quadrature_rules.h>
#include <alpenglow/shaders/rotate_harmonics.h>

#include <cstring>

#include "atmosphere/tables/bake_graph.h"
#include "atmosphere/tables/moment_shape.h"

namespace alpenglow::tables {
namespace {

/// kFineZeniths of shaders/glsl/physics/moments.glsl.
constexpr uint32_t kFineZeniths = 2;

/// Bindings of shaders/glsl/tables/moment_common.glsl.
enum Binding : uint32_t {
  kDepth = 1,
  kField = 2,
  kSource = 3,
  kRadiance = 4,  ///< And the two next.
  kModes = 4,
  kMoments = 5,
  kSourceModes = 6,
  kRules = 7,
  kLegendre = 8,
  kRotations = 8,
  kSum = 4,
  kLast = 5,
  kBefore = 6,
};

struct MomentConstants {
  physics_f32::Medium medium;
  physics_f32::MomentShape shape;
};
static_assert(offsetof(MomentConstants, shape) % 16 == 0 && sizeof(MomentConstants) % 16 == 0);

#define ALPENGLOW_SHADER(name) \
  engine::Shader { shaders::name, sizeof shaders::name, #name }
#define ALPENGLOW_FORMAT_SHADER(name) \
  (half_ ? ALPENGLOW_SHADER(name##Half) : ALPENGLOW_SHADER(name##Float))

/// Builds the graph; its members are the sizes and the images that several stages share.
class Builder {
 public:
  Builder(const TableDesc& desc, uint32_t orders)
      : c_(desc.sizes),
        half_(desc.format == TableFormat::Half),
        orders_(orders),
        disabledEffects_(desc.disabledEffects),
        hasMie_(hasEffect(desc.disabledEffects, Effect::Mie)),
        reflects_(hasEffect(desc.disabledEffects, Effect::GroundReflection)),
        layers_(fieldLayers(desc)),
        nodes_(c_.nodesR * c_.nodesMuS),
        zeniths_(c_.zenithsSky + c_.zenithsLimb + c_.zenithsGround),
        modesPerZenith_(c_.degree + 1),
        harmonics_((c_.degree + 1) * (c_.degree + 2) / 2),
        fieldR_(fieldTexels(c_.nodesR)),
        fieldMuS_(fieldTexels(c_.nodesMuS)) {}

  BakeGraph build() {
    addTables();
    if (hasEffect(disabledEffects_, Effect::MultipleScattering)) {
      addFieldTables();
      if (orders_ > 1) {
        addPreparation();
        addOrders();
      }
      addSums();
    }
    for (Stage& stage : graph_.stages) stage.disabledEffects = disabledEffects_;
    return std::move(graph_);
  }

 private:
  uint32_t floats(const char* name, uint32_t width, uint32_t height, bool filtered = false) {
    BakeImage image;
    image.name = name;
    image.extent = {width, height, 1};
    image.format = VK_FORMAT_R32G32B32A32_SFLOAT;
    image.filtered = filtered;
    return graph_.addImage(image);
  }

  uint32_t scalars(const char* name, uint32_t width, uint32_t height) {
    const uint32_t image = floats(name, width, height);
    graph_.images[image].format = VK_FORMAT_R32_SFLOAT;
    return image;
  }

  uint32_t sources(const char* name, VkFormat format) {
    BakeImage image;
    image.name = name;
    image.type = VK_IMAGE_TYPE_3D;
    image.extent = {c_.sourceGamma * c_.sourcePsi, c_.nodesMuS, c_.nodesR};
    image.format = format;
    return graph_.addImage(image);
  }

  static Stage stage(const engine::Shader& shader, uint32_t width, uint32_t height,
                     uint64_t unitsPerTexel) {
    Stage stage;
    stage.shader = shader;
    stage.width = width;
    stage.height = stage.rows = height;
    stage.unitsPerTexel = unitsPerTexel;
    return stage;
  }

  void addTables() {
    t_ = floats("Alpenglow optical depth", c_.depthMu, c_.depthH, true);
    keep(kTableOpticalDepth, t_);
    // Shaders don't declare bindings of missing images, but lavapipe requires that every binding is
    // filled.
    for (uint32_t& bound : graph_.bound) bound = t_;

    Stage depth = stage(ALPENGLOW_SHADER(kMomentDepth), c_.depthMu, c_.depthH, 20);
    depth.outputs = {{t_}};
    graph_.addPass(graph_.addStage(depth), "T", 0);
  }

  void keep(TableId id, uint32_t image) {
    graph_.images[image].persistent = true;
    graph_.tables.push_back({id, image});
  }

  void addFieldTables() {
    total_ = floats("Alpenglow moments", fieldMuS_, fieldR_ * layers_, true);
    keep(kTableMoments, total_);
    graph_.bound[1] = total_;
    if (!hasMie_) return;
    source_ =
        sources("Alpenglow source", vulkanFormat(half_ ? TableFormat::Half : TableFormat::Float));
    keep(kTableSource, source_);
    graph_.bound[2] = graph_.bound[3] = source_;
  }

  // Images that every order uses, and those that orders pass on.
  void addPreparation() {
    const uint32_t rows =
        zeniths_ * (1 + kFineZeniths) * c_.nodesR + (hasMie_ ? c_.sourceGamma : 0);
    rules_ = floats("Alpenglow rules", zeniths_ * kFineZeniths, 2);
    legendre_ = scalars("Alpenglow Legendre", harmonics_, rows);
    modes_ = floats("Alpenglow modes", modesPerZenith_ * zeniths_ * kFineZeniths, nodes_);
    moments_ = floats("Alpenglow harmonics", harmonics_, nodes_);
    sum_ = nodeLayers("Alpenglow sum");
    // Two, by turns: the tail asks for the last two.
    for (uint32_t i = 0; i < (orders_ > 2 ? 2u : 1u); ++i)
      plain_[i] = nodeLayers("Alpenglow plain order");
    nodeField_ = nodeLayers("Alpenglow order");
    orderField_ = floats("Alpenglow order between", fieldMuS_, fieldR_ * layers_, true);
    graph_.tables.push_back({kTableOrderMoments, nodeField_});
    if (hasMie_) addSourcePreparation();

    Stage rules = stage(ALPENGLOW_SHADER(kQuadratureRules), zeniths_ * kFineZeniths, 2,
                        6 * kFineZeniths * zeniths_);
    rules.outputs = {{rules_}};
    graph_.addPass(graph_.addStage(rules), "Q", 0);

    Stage legendre = stage(ALPENGLOW_SHADER(kMomentLegendre), harmonics_, rows, c_.degree);
    legendre.inputs = {{kRules, rules_}};
    legendre.outputs = {{legendre_}};
    graph_.addPass(graph_.addStage(legendre), "Y", 0);
    if (hasMie_) addRotations();
  }

  // Images for aerosols alone.
  void addSourcePreparation() {
    rotations_ = scalars("Alpenglow rotations", modesPerZenith_ * modesPerZenith_,
                         modesPerZenith_ * c_.nodesMuS);
    turned_ = floats("Alpenglow turned harmonics", harmonics_, nodes_);
    sourceModes_ = floats("Alpenglow source modes", modesPerZenith_ * c_.sourceGamma, nodes_);
    orderSource_ = sources("Alpenglow order source", graph_.images[source_].format);
    sourceSum_ = sources("Alpenglow source sum", VK_FORMAT_R32G32B32A32_SFLOAT);
    graph_.images[sourceSum_].filtered = false;
    graph_.tables.push_back({kTableOrderSource, orderSource_});
  }

  void addRotations() {
    const VkExtent3D& turns = graph_.images[rotations_].extent;
    Stage rotations =
        stage(ALPENGLOW_SHADER(kMomentRotations), turns.width, turns.height, 2 * c_.degree);
    rotations.outputs = {{rotations_}};
    graph_.addPass(graph_.addStage(rotations), "W", 0);
  }

  // The layers of each node.
  uint32_t nodeLayers(const char* name) { return floats(name, c_.nodesMuS, c_.nodesR * layers_); }

  // L 1: along a ray that is cut about twice, each of two nodes of a panel reads T twice.
  uint32_t addSingle() {
    const uint32_t width = c_.azimuths * zeniths_ * kFineZeniths;
    // Of molecules, aerosols and the ground; those that are absent are not stored.
    for (uint32_t i = 0; i < 3; ++i) {
      const bool stored = i == 0 || (i == 1 ? hasMie_ : reflects_);
      single_[i] = stored ? floats("Alpenglow single scattering", width, nodes_) : single_[0];
    }
    Stage single =
        stage(hasMie_ ? ALPENGLOW_SHADER(kMomentSingle) : ALPENGLOW_SHADER(kMomentSingleMolecules),
              width, nodes_, uint64_t(c_.solverPanels) * 8);
    // The code for a ray's light declares field and source too. It never reads them here, but
    // Vulkan requires images.
    single.inputs = {{kDepth, t_}, {kField, orderField_}, {kRules, rules_}};
    if (hasMie_) single.inputs.push_back({kSource, orderSource_});
    single.outputs = {{single_[0]}, {single_[1]}, {single_[2]}};
    return graph_.addStage(single);
  }

  // L n: each of the nodes reads the field four times and the source twice.
  uint32_t addLight() {
    const uint32_t width = c_.azimuths * zeniths_;
    Stage light =
        stage(hasMie_ ? ALPENGLOW_SHADER(kMomentLight) : ALPENGLOW_SHADER(kMomentLightMolecules),
              width, nodes_, uint64_t(c_.solverPanels) * (hasMie_ ? 24 : 20));
    light.inputs = {{kDepth, t_}, {kField, orderField_}, {kRules, rules_}};
    if (hasMie_) light.inputs.push_back({kSource, orderSource_});
    light.outputs = {{light_}};
    return graph_.addStage(light);
  }

  uint32_t addModes(bool first) {
    const uint32_t fine = first ? kFineZeniths : 1;
    // An invocation makes eight modes.
    Stage modes = stage(ALPENGLOW_SHADER(kMomentModes), (modesPerZenith_ + 7) / 8 * zeniths_ * fine,
                        nodes_, uint64_t(c_.azimuths) * (first ? 3 : 1));
    modes.constants[0] = first;
    modes.inputs = {{kRules, rules_}};
    for (uint32_t i = 0; i < (first ? 3u : 1u); ++i)
      modes.inputs.push_back({kRadiance + i, first ? single_[i] : light_});
    modes.outputs = {{modes_}};
    return graph_.addStage(modes);
  }

  uint32_t addHarmonics(bool first) {
    const uint32_t fine = first ? kFineZeniths : 1;
    Stage harmonics = stage(ALPENGLOW_SHADER(kMomentHarmonics), harmonics_, nodes_,
                            uint64_t(zeniths_) * fine * 2);
    harmonics.constants[0] = first;
    harmonics.inputs = {{kModes, modes_}, {kLegendre, legendre_}};
    harmonics.outputs = {{moments_}};
    return graph_.addStage(harmonics);
  }

  uint32_t addTurned() {
    Stage turned = stage(ALPENGLOW_SHADER(kRotateHarmonics), harmonics_, nodes_, 2 * c_.degree);
    turned.inputs = {{kMoments, moments_}, {kRotations, rotations_}};
    turned.outputs = {{turned_}};
    return graph_.addStage(turned);
  }

  uint32_t addSourceModes() {
    Stage modes = stage(ALPENGLOW_SHADER(kMomentSourceModes), modesPerZenith_ * c_.sourceGamma,
                        nodes_, modesPerZenith_);
    modes.inputs = {{kMoments, turned_}, {kLegendre, legendre_}};
    modes.outputs = {{sourceModes_}};
    return graph_.addStage(modes);
  }

  uint32_t addField(bool first, uint32_t to) {
    Stage field = stage(ALPENGLOW_SHADER(kMomentField), c_.nodesMuS, c_.nodesR,
                        uint64_t(c_.zenithsSky) * (first ? kFineZeniths : 1) * 2 + 4 * layers_);
    field.constants[0] = first;
    field.inputs = {{kModes, modes_}, {kMoments, moments_}, {kRules, rules_}};
    field.outputs = {{nodeField_}, {plain_[to]}, {sum_, !first}};
    field.finishes = {{kTableOrderMoments, nodeField_}};
    return graph_.addStage(field);
  }

  // Cubics through 4 x 4 nodes.
  uint32_t addBetween(uint32_t to) {
    const VkExtent3D& extent = graph_.images[to].extent;
    Stage between = stage(ALPENGLOW_SHADER(kInterpolateNodes), extent.width, extent.height, 16);
    between.inputs = {{kField, nodeField_}};
    between.outputs = {{to}};
    return graph_.addStage(between);
  }

  uint32_t addSource(bool first) {
    const VkExtent3D& extent = graph_.images[orderSource_].extent;
    Stage source = stage(ALPENGLOW_FORMAT_SHADER(kMomentSource), extent.width, extent.height,
                         modesPerZenith_ + 4);
    source.rows *= extent.depth;
    source.constants[0] = first;
    source.inputs = {{kSourceModes, sourceModes_}, {kField, nodeField_}};
    source.outputs = {{orderSource_}, {sourceSum_, !first}};
    source.finishes = {{kTableOrderSource, orderSource_}};
    return graph_.addStage(source);
  }

  // The light of orders 1 ... N - 1, and the sources 2 ... N that it makes.
  void addOrders() {
    struct Stages {
      uint32_t light, modes, harmonics, field, source;
    };
    const uint32_t turned = hasMie_ ? addTurned() : 0, sourceModes = hasMie_ ? addSourceModes() : 0;
    const uint32_t between = addBetween(orderField_);
    const Stages first = {addSingle(), addModes(true), addHarmonics(true), addField(true, 0),
                          hasMie_ ? addSource(true) : 0};
    Stages further[2] = {};
    if (orders_ > 2) {
      light_ = floats("Alpenglow light", c_.azimuths * zeniths_, nodes_);
      const Stages any = {addLight(), addModes(false), addHarmonics(false), 0,
                          hasMie_ ? addSource(false) : 0};
      for (uint32_t i = 0; i < (orders_ > 3 ? 2u : 1u); ++i) {
        further[i] = any;
        further[i].field = addField(false, 1 - i);
      }
    }
    for (uint32_t order = 1; order < orders_; ++order) {
      const Stages& s = order == 1 ? first : further[order % 2];
      graph_.addPass(s.light, "L", order);
      graph_.addPass(s.modes, "F", order);
      graph_.addPass(s.harmonics, "M", order);
      if (hasMie_) graph_.addPass(turned, "R", order);
      if (hasMie_) graph_.addPass(sourceModes, "H", order);
      graph_.addPass(s.field, "N", order);
      graph_.addPass(between, "I", order);
      if (hasMie_) graph_.addPass(s.source, "J", order + 1);
    }
  }

  void addSums() {
    if (orders_ == 1) return addNoLight();
    // Order n lies in plain_[(n - 1) % 2], and the last is N - 1. If it is the only one, it stands
    // for the order before too: there is no tail then that would ask for it.
    const uint32_t last = orders_ % 2, before = orders_ > 2 ? 1 - last : last;
    Stage field = stage(ALPENGLOW_SHADER(kMomentFieldSum), c_.nodesMuS, c_.nodesR, 4 * layers_);
    field.inputs = {{kSum, sum_}, {kLast, plain_[last]}, {kBefore, plain_[before]}};
    field.outputs = {{nodeField_}};
    graph_.addPass(graph_.addStage(field), "N sum", 0);
    graph_.addPass(addBetween(total_), "I sum", 0);
    if (!hasMie_) return;
    Stage source = sourceStage(ALPENGLOW_FORMAT_SHADER(kMomentSourceSum));
    source.inputs = {{kField, nodeField_},
                     {kSource, orderSource_},
                     {kSum, sourceSum_},
                     {kLast, plain_[last]},
                     {kBefore, plain_[before]}};
    graph_.addPass(graph_.addStage(source), "J sum", 0);
  }

  // None was solved.
  void addNoLight() {
    Stage field = stage(ALPENGLOW_SHADER(kMomentFieldNone), fieldMuS_, fieldR_, layers_);
    field.outputs = {{total_}};
    graph_.addPass(graph_.addStage(field), "N sum", 0);
    if (!hasMie_) return;
    graph_.addPass(graph_.addStage(sourceStage(ALPENGLOW_FORMAT_SHADER(kMomentSourceNone))),
                   "J sum", 0);
  }

  Stage sourceStage(const engine::Shader& shader) {
    const VkExtent3D& extent = graph_.images[source_].extent;
    Stage source = stage(shader, extent.width, extent.height, 5);
    source.rows *= extent.depth;
    source.outputs = {{source_}};
    return source;
  }

  TableSizes c_;
  bool half_;
  uint32_t orders_;
  EffectFlags disabledEffects_;
  bool hasMie_, reflects_;
  uint32_t layers_, nodes_, zeniths_, modesPerZenith_, harmonics_, fieldR_, fieldMuS_;
  BakeGraph graph_;
  uint32_t t_ = 0, total_ = 0, source_ = 0;
  uint32_t rules_ = 0, legendre_ = 0, rotations_ = 0;
  uint32_t modes_ = 0, moments_ = 0, turned_ = 0, sourceModes_ = 0;
  uint32_t single_[3] = {}, light_ = 0;
  uint32_t nodeField_ = 0, orderField_ = 0, plain_[2] = {}, sum_ = 0;
  uint32_t orderSource_ = 0, sourceSum_ = 0;
};

#undef ALPENGLOW_SHADER
#undef ALPENGLOW_FORMAT_SHADER

}  // namespace

BakeGraph momentGraph(const Parameters& parameters, const TableDesc& desc) {
  BakeGraph graph = Builder(desc, solvedOrders(parameters, desc)).build();
  MomentConstants constants = {};
  constants.medium = makeMediumF32(parameters);
  constants.shape = makeMomentShapeF32(parameters, desc);
  graph.uniforms.resize(sizeof constants);
  std::memcpy(graph.uniforms.data(), &constants, sizeof constants);
  return graph;
}

}  // namespace alpenglow::tables
