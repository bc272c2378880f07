// Disabled effects of views create nothing: pipelines, images and memory, and a frame's dispatches
// and draws.
#include "atmosphere/passes/view_cost.h"
#include "atmosphere/tables/table_set.h"
#include "atmosphere/view/view_desc.h"
#include "tests/passes/light_shafts/light_shaft_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr EffectFlags kMie = effectBit(Effect::Mie),
                      kMultiple = effectBit(Effect::MultipleScattering),
                      kGround = effectBit(Effect::Ground), kDisc = effectBit(Effect::SunDisc),
                      kSpace = effectBit(Effect::SpaceViews);
constexpr VkExtent2D kExtent = {24, 16};

/// An image of a draft's sky-view LUT, and one of an aerial-perspective LUT.
constexpr uint64_t kSkyLut = uint64_t{48} * 64 * 16;
constexpr uint64_t kAirLut = uint64_t{physics_f32::kAerialColumns} * physics_f32::kAerialRows *
                             physics_f32::kAerialDistances * 16;

/// What making a view adds.
struct Added {
  uint64_t pipelines, images, bytes;
};

class ViewCostsTest : public LightShaftTest {
 protected:
  ResourceReport reportOf(Context* context) {
    finishFrames(context);
    ResourceReport now;
    resourceReport(context, &now);
    return now;
  }

  /// In a context of its own that can't bake.
  void expectAdded(const ViewDesc& desc, const Added& expected) {
    ContextDesc plain = contextDesc();
    plain.capabilities = kCapabilitySky | kCapabilityAerialPerspective;
    Context* own = nullptr;
    ASSERT_EQ(createContext(plain, &own), Status::Ok) << lastDiagnostic();
    TableDesc draft;
    draft.quality = Quality::Draft;
    draft.disabledEffects = desc.disabledEffects & kTableEffects;
    Tables* tables = nullptr;
    ASSERT_EQ(createTables(own, preset("earth"), draft, &tables), Status::Ok) << lastDiagnostic();
    const ResourceReport before = reportOf(own);
    View* made = nullptr;
    EXPECT_EQ(createView(own, tables, desc, &made), Status::Ok) << lastDiagnostic();
    const ResourceReport after = reportOf(own);
    EXPECT_EQ(after.pipelines - before.pipelines, expected.pipelines) << desc.disabledEffects;
    // Not one of them is another's.
    EXPECT_EQ(after.shaderVariants - before.shaderVariants, expected.pipelines)
        << desc.disabledEffects;
    EXPECT_EQ(after.images - before.images, expected.images) << desc.disabledEffects;
    EXPECT_EQ(after.bytes - before.bytes, expected.bytes) << desc.disabledEffects;
    EXPECT_EQ(after.buffers, before.buffers);
    const PlanCost told =
        passes::viewCost(tables->desc(), view::resolve(tables->desc(), desc).picture);
    EXPECT_EQ(told.pipelines, expected.pipelines) << desc.disabledEffects;
    EXPECT_EQ(told.images, expected.images) << desc.disabledEffects;
    EXPECT_EQ(told.bytes, expected.bytes) << desc.disabledEffects;
    destroyView(made);
    destroyTables(tables);
    destroyContext(own);
  }

  ViewDesc disabledEffects(EffectFlags effects, SkyMethod sky,
                           AerialPerspective air = AerialPerspective::Off) {
    ViewDesc desc = viewDesc();
    desc.disabledEffects = effects;
    desc.sky = sky;
    desc.aerialPerspective = air;
    desc.depth = DepthConvention::Reversed;
    if (air != AerialPerspective::Off) desc.sceneDepthFormat = VK_FORMAT_D32_SFLOAT;
    return desc;
  }
  static constexpr SkyMethod kLut = SkyMethod::Lut, kIntegrate = SkyMethod::Integrate;

  /// Of the frame that `record` records.
  ResourceReport frame(const std::function<void()>& record) {
    const ResourceReport before = reportOf(context());
    record();
    const ResourceReport after = reportOf(context());
    ResourceReport difference;
    difference.draws = after.draws - before.draws;
    difference.dispatches = after.dispatches - before.dispatches;
    EXPECT_EQ(after.pipelines, before.pipelines);
    EXPECT_EQ(after.bytes, before.bytes);
    return difference;
  }
};

// Six kinds of pixels: two with ground, three with the disc, two without atmosphere; and the LUT's.
// With a LUT nothing that integrates is compiled.
TEST_F(ViewCostsTest, PixelKindsNeverDrawnHaveNoPipeline) {
  expectAdded(disabledEffects(0, kLut), {7, 2, 2 * kSkyLut});
  expectAdded(disabledEffects(0, kIntegrate), {6, 0, 0});
  expectAdded(disabledEffects(kGround, kLut), {5, 2, 2 * kSkyLut});
  expectAdded(disabledEffects(kDisc, kLut), {4, 2, 2 * kSkyLut});
  expectAdded(disabledEffects(kGround | kDisc, kIntegrate), {2, 0, 0});
  expectAdded(disabledEffects(kViewEffects, kIntegrate), {1, 0, 0});
}

// Of tables that have no LUT from space each comes twice, but for views that never go there.
TEST_F(ViewCostsTest, StandardIntegratesAboveTheAtmosphere) {
  Tables* standard = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), smallTables(), &standard), Status::Ok)
      << message();
  for (const EffectFlags effects : {EffectFlags{0}, kSpace}) {
    const ViewDesc desc = disabledEffects(effects, kLut);
    const ResourceReport before = reportOf(context());
    View* made = nullptr;
    ASSERT_EQ(createView(context(), standard, desc, &made), Status::Ok) << message();
    const uint64_t pipelines = reportOf(context()).pipelines - before.pipelines;
    destroyView(made);
    EXPECT_EQ(pipelines, effects == 0 ? 13u : 5u);
    const PictureDesc picture = view::resolve(standard->desc(), desc).picture;
    EXPECT_EQ(passes::viewCost(standard->desc(), picture).pipelines, pipelines);
  }
  destroyTables(standard);
}

// Cameras inside need half of the rays.
TEST_F(ViewCostsTest, WithoutSpaceLutsAreHalfAsLarge) {
  expectAdded(disabledEffects(kSpace, kLut), {5, 2, kSkyLut});
  expectAdded(disabledEffects(kViewEffects, kLut, AerialPerspective::On),
              {4, 5, kSkyLut + 3 * kAirLut / 2});
}

TEST_F(ViewCostsTest, LutsLackWhatTheirTablesLack) {
  expectAdded(disabledEffects(kMie | kViewEffects, kLut), {2, 1, kSkyLut / 2});
  expectAdded(disabledEffects(kMultiple | kViewEffects, kLut), {2, 2, kSkyLut});
}

// From its LUT: three images, the pipeline that fills them, the one that reads them.
TEST_F(ViewCostsTest, AerialPerspectiveOwnsItsLut) {
  constexpr EffectFlags kPlain = kGround | kDisc;
  expectAdded(disabledEffects(kPlain, kIntegrate, AerialPerspective::Integrate), {2 + 1, 0, 0});
  expectAdded(disabledEffects(kPlain, kLut, AerialPerspective::On),
              {3 + 2, 2 + 3, 2 * kSkyLut + 3 * kAirLut});
  expectAdded(disabledEffects(kPlain, kLut, AerialPerspective::Integrate), {3 + 1, 2, 2 * kSkyLut});
  expectAdded(disabledEffects(kPlain, kIntegrate, AerialPerspective::On), {2 + 2, 3, 3 * kAirLut});
  expectAdded(disabledEffects(kPlain, kLut), {3, 2, 2 * kSkyLut});
}

// Shadow map, blocks, light-volume mesh with and without a LUT; the map's image; frame and blocks.
// Sums follow with the first frame, which knows the extent.
TEST_F(ViewCostsTest, LightShaftsHaveTheirOwn) {
  ContextDesc plain = contextDesc();
  plain.capabilities = kCapabilitySky | kCapabilityAerialPerspective | kCapabilityLightShafts;
  Context* own = nullptr;
  ASSERT_EQ(createContext(plain, &own), Status::Ok) << lastDiagnostic();
  TableDesc draft;
  draft.quality = Quality::Draft;
  Tables* tables = nullptr;
  ASSERT_EQ(createTables(own, preset("earth"), draft, &tables), Status::Ok) << lastDiagnostic();
  ViewDesc desc = disabledEffects(kViewEffects, kIntegrate, AerialPerspective::Integrate);
  const ResourceReport start = reportOf(own);
  View* sunny = nullptr;
  ASSERT_EQ(createView(own, tables, desc, &sunny), Status::Ok) << lastDiagnostic();
  const ResourceReport made = reportOf(own);
  EXPECT_EQ(made.pipelines - start.pipelines, 2u) << "Sky and air.";
  EXPECT_EQ(made.images, start.images);
  EXPECT_EQ(made.bytes, start.bytes);
  desc.lightShafts.method = LightShaftMethod::LightVolume;
  desc.lightShafts.shadowMapSize = 64;
  View* shaded = nullptr;
  ASSERT_EQ(createView(own, tables, desc, &shaded), Status::Ok) << lastDiagnostic();
  const ResourceReport seen = reportOf(own);
  EXPECT_EQ(seen.pipelines - made.pipelines, 2u + 4u);
  EXPECT_EQ(seen.shaderVariants - made.shaderVariants, 2u + 4u);
  EXPECT_EQ(seen.images - made.images, 1u);
  EXPECT_EQ(seen.buffers - made.buffers, 2u);
  EXPECT_GE(seen.bytes - made.bytes, 64u * 64 * 4);
  destroyView(shaded);
  destroyView(sunny);
  EXPECT_EQ(reportOf(own).images, start.images);
  EXPECT_EQ(reportOf(own).bytes, start.bytes);
  destroyTables(tables);
  destroyContext(own);
}

TEST_F(ViewCostsTest, DisabledEffectsRecordNothing) {
  addCaster(
      reference::test::box(reference::Vector(600, 1500, -200), reference::Vector(900, 1800, 200)));
  const FrameState looking = drawFrom({50, 0, 0}, 90, 50, 40, kExtent, 35, 200);
  LightShaftSetup shaded, plain;
  shaded.shadowMapSize = plain.shadowMapSize = 64;
  shaded.disabledEffects = plain.disabledEffects = kViewEffects;
  plain.shafts = false;
  rigOf(plain, kExtent);
  rigOf(shaded, kExtent);
  // The first frame makes what depends on the extent of the scene's depth.
  const ResourceReport before = reportOf(context());
  draw(shaded, looking);
  const ResourceReport made = reportOf(context());
  EXPECT_EQ(made.images - before.images, 1u) << "Sums.";
  EXPECT_GE(made.bytes - before.bytes, 24u * 16 * 8);
  FrameState other = looking;
  other.camera.position_m[0] += 1.0;  // No LUT serves on.
  View* const skyAlone = makeView(disabledEffects(kViewEffects, kLut), baked);
  const ResourceReport withLightShafts = frame([&] { draw(shaded, other); });
  const ResourceReport withAerialPerspective = frame([&] { draw(plain, looking); });
  const ResourceReport sky = frame([&] {
    recordViewLuts(skyAlone, baked, looking);
    picture(skyAlone, baked, looking);
  });
  EXPECT_EQ(sky.dispatches, 1u);
  EXPECT_EQ(sky.draws, 1u);
  EXPECT_EQ(withAerialPerspective.dispatches - sky.dispatches, 1u)
      << "The LUT of aerial perspective.";
  EXPECT_EQ(withAerialPerspective.draws - sky.draws, 1u) << "The atmosphere.";
  EXPECT_EQ(withLightShafts.dispatches - withAerialPerspective.dispatches, 1u) << "Blocks.";
  EXPECT_EQ(withLightShafts.draws - withAerialPerspective.draws, 2u) << "Map and surface.";
}

}  // namespace
}  // namespace alpenglow::testing
