// Disabled effects of tables create nothing: pipelines, images, memory and dispatches of a bake.
#include <alpenglow/table_limits.h>
#include "tests/passes/sky/sky_fixture.h"
#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr EffectFlags kRayleigh = effectBit(Effect::Rayleigh), kMie = effectBit(Effect::Mie),
                      kAbsorption = effectBit(Effect::Absorption),
                      kMultiple = effectBit(Effect::MultipleScattering),
                      kReflection = effectBit(Effect::GroundReflection),
                      kIrradiance = effectBit(Effect::GroundIrradiance);

/// Of createTables and a bake.
struct TableCost {
  uint64_t pipelines = 0, variants = 0, dispatches = 0;
  uint64_t images = 0, bytes = 0;          ///< Right after createTables.
  uint64_t imagesLeft = 0, bytesLeft = 0;  ///< After the bake.
};

/// As lavapipe stores an image: rows of whole lines of 64 bytes, and four rows at a time.
uint64_t bytesOf(uint64_t width, uint64_t height, uint64_t depth, uint64_t texelBytes) {
  return (width * texelBytes + 63) / 64 * 64 * ((height + 3) / 4 * 4) * depth;
}

// Sizes of kTinySettings.
constexpr uint64_t kTexel = 16, kScalar = 4;
constexpr uint64_t kNodesR = kTinySettings.nodesR, kNodesMuS = kTinySettings.nodesMuS,
                   kNodes = kNodesR * kNodesMuS, kModes = kTinySettings.degree + 1,
                   kHarmonics = kModes * (kModes + 1) / 2,
                   kRings = kTinySettings.zenithsSky + kTinySettings.zenithsLimb +
                            kTinySettings.zenithsGround;

uint64_t sourceBytes() {
  return bytesOf(kTinySettings.sourceGamma * kTinySettings.sourcePsi, kNodesMuS, kNodesR, kTexel);
}
uint64_t singleBytes() { return bytesOf(2 * kRings * kTinySettings.azimuths, kNodes, 1, kTexel); }
uint64_t legendreBytes(uint64_t rows) { return bytesOf(kHarmonics, rows, 1, kScalar); }
/// The table of moments, and that of an order between the nodes, of so many layers.
uint64_t fieldBytes(uint64_t layers) {
  return bytesOf(fieldTexels(kNodesMuS), fieldTexels(kNodesR) * layers, 1, kTexel);
}
uint64_t nodeBytes(uint64_t layers) { return bytesOf(kNodesMuS, kNodesR * layers, 1, kTexel); }

class TableCostsTest : public DeviceTest {
 protected:
  /// In a context of its own, whose pipelines are all new.
  TableCost cost(EffectFlags disabledEffects) {
    Context* context = nullptr;
    EXPECT_EQ(createContext(contextDesc(), &context), Status::Ok) << lastDiagnostic();
    const auto report = [&] {
      finishFrames(context);
      ResourceReport now;
      resourceReport(context, &now);
      return now;
    };
    TableDesc desc;
    desc.sizes = kTinySettings;
    desc.format = TableFormat::Float;
    desc.disabledEffects = disabledEffects;
    desc.orders = hasEffect(disabledEffects, Effect::MultipleScattering) ? 4 : 0;
    const ResourceReport start = report();
    Tables* tables = nullptr;
    EXPECT_EQ(createTables(context, preset("earth"), desc, &tables), Status::Ok)
        << lastDiagnostic();
    const ResourceReport made = report();
    if (tables != nullptr) bakeAll(device(), tables);
    const ResourceReport end = report();
    EXPECT_EQ(end.pipelines, made.pipelines) << disabledEffects;
    EXPECT_EQ(end.draws, start.draws) << disabledEffects;
    destroyTables(tables);
    EXPECT_EQ(report().bytes, start.bytes) << disabledEffects;
    destroyContext(context);
    return {made.pipelines - start.pipelines,
            made.shaderVariants - start.shaderVariants,
            end.dispatches - start.dispatches,
            made.images - start.images,
            made.bytes - start.bytes,
            end.images - start.images,
            end.bytes - start.bytes};
  }

  /// What `whole` costs more than tables with these disabled effects.
  static void expectGone(const TableCost& whole, const TableCost& part, const TableCost& gone) {
    EXPECT_EQ(whole.pipelines - part.pipelines, gone.pipelines);
    EXPECT_EQ(whole.variants - part.variants, gone.variants);
    EXPECT_EQ(whole.dispatches - part.dispatches, gone.dispatches);
    EXPECT_EQ(whole.images - part.images, gone.images);
    EXPECT_EQ(whole.bytes - part.bytes, gone.bytes);
    EXPECT_EQ(whole.imagesLeft - part.imagesLeft, gone.imagesLeft);
    EXPECT_EQ(whole.bytesLeft - part.bytesLeft, gone.bytesLeft);
  }

  const TableCost& whole() {
    static const TableCost cost_ = cost(0);
    return cost_;
  }
};

// Four orders: T, Q, Y, W; three times L F M R H N I J; the sums N I J.
TEST_F(TableCostsTest, DefaultTablesHaveEveryObject) {
  EXPECT_EQ(whole().pipelines, 19u);
  EXPECT_EQ(whole().variants, 19u);
  EXPECT_EQ(whole().dispatches, 4u + 3u * 8u + 3u);
  EXPECT_EQ(whole().images, 21u);
  EXPECT_EQ(whole().imagesLeft, 3u);
}

// They are terms of a sum and own no object. code_test.cpp tests their code.
TEST_F(TableCostsTest, MoleculesAndAbsorptionCostNoObjects) {
  expectGone(whole(), cost(kRayleigh), {});
  expectGone(whole(), cost(kAbsorption), {});
}

// W, R, H, J (of the first order and of others) and "J sum"; the sources of all, of an order and
// their sum, rotations, turned harmonics, modes of sources, the aerosols' part of order 1; rows of
// the associated Legendre functions at the sources' angles.
TEST_F(TableCostsTest, DisabledAerosolsRemoveTheirSources) {
  const uint64_t rows = kRings * 3 * kNodesR;
  TableCost gone;
  gone.pipelines = gone.variants = 6;
  gone.dispatches = 1 + 3 * 3 + 1;
  gone.images = 7;
  gone.bytes = 3 * sourceBytes() + bytesOf(kModes * kModes, kModes * kNodesMuS, 1, kScalar) +
               bytesOf(kHarmonics, kNodes, 1, kTexel) +
               bytesOf(kModes * kTinySettings.sourceGamma, kNodes, 1, kTexel) + singleBytes() +
               legendreBytes(rows + kTinySettings.sourceGamma) - legendreBytes(rows);
  gone.imagesLeft = 1;
  gone.bytesLeft = sourceBytes();
  expectGone(whole(), cost(kMie), gone);
}

// Left is T: one image, pipeline and dispatch, whatever else is left out.
TEST_F(TableCostsTest, SingleScatteringKeepsOpticalDepthsOnly) {
  const TableCost single = cost(kMultiple), air = cost(kMultiple | kMie);
  EXPECT_EQ(single.pipelines, 1u);
  EXPECT_EQ(single.variants, 1u);
  EXPECT_EQ(single.dispatches, 1u);
  EXPECT_EQ(single.images, 1u);
  EXPECT_EQ(single.bytes, single.bytesLeft);
  const uint64_t depths = bytesOf(kTinySettings.depthMu, kTinySettings.depthH, 1, kTexel);
  EXPECT_EQ(whole().bytesLeft - single.bytesLeft, fieldBytes(5) + sourceBytes());
  EXPECT_GE(single.bytes, depths);
  EXPECT_LT(single.bytes, depths + 1024) << "The uniforms.";
  expectGone(single, air, {});
}

TEST_F(TableCostsTest, DisabledGroundEffectsRemoveTheirObjects) {
  // The ground's part of order 1.
  TableCost gone;
  gone.images = 1;
  gone.bytes = singleBytes();
  expectGone(whole(), cost(kReflection), gone);
  // E of the sky is what the ground reflects, too.
  expectGone(whole(), cost(kIrradiance), {});
  // A layer of all that has layers: the moments and an order between nodes; an order, two plain
  // ones and their sum.
  gone.bytesLeft = fieldBytes(5) - fieldBytes(4);
  gone.bytes += 2 * gone.bytesLeft + 4 * (nodeBytes(5) - nodeBytes(4));
  expectGone(whole(), cost(kReflection | kIrradiance), gone);
}

}  // namespace
}  // namespace alpenglow::testing
