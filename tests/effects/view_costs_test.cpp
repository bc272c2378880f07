// What views are without is made by nobody: pipelines, images and memory, and a frame's dispatches
// and draws.
#include "atmosphere/bake/table_set.h"
#include "atmosphere/sky/view_cost.h"
#include "tests/shafts/shaft_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr EffectFlags kMie = effectBit(Effect::Mie),
                      kMultiple = effectBit(Effect::MultipleScattering),
                      kGround = effectBit(Effect::Ground), kDisc = effectBit(Effect::SunDisc),
                      kSpace = effectBit(Effect::SpaceViews);
constexpr VkExtent2D kExtent = {24, 16};

/// An image of a draft's sky slice, and one of an air volume.
constexpr uint64_t kSlice = uint64_t{48} * 64 * 16;
constexpr uint64_t kVolume =
    uint64_t{physics_f32::kAirColumns} * physics_f32::kAirRows * physics_f32::kAirDistances * 16;

/// What making a view adds.
struct Added {
  uint64_t pipelines, images, bytes;
};

class ViewCostsTest : public ShaftTest {
 protected:
  ResourceReport reportOf(Context* context) {
    finishFrames(context);
    ResourceReport now;
    resourceReport(context, &now);
    return now;
  }

  /// In a context of its own that can't bake, with the shape of drafts for a slice.
  void expectAdded(ViewDesc desc, bool sliced, const Added& expected) {
    ContextDesc plain = contextDesc();
    plain.capabilities = kCapabilitySky | kCapabilityAir;
    Context* own = nullptr;
    ASSERT_EQ(createContext(plain, &own), Status::Ok) << lastDiagnostic();
    TableDesc draft;
    draft.quality = Quality::Draft;
    draft.disabledEffects = desc.without & kTableEffects;
    Tables* tables = nullptr;
    ASSERT_EQ(createTables(own, preset("earth"), draft, &tables), Status::Ok) << lastDiagnostic();
    const ResourceReport before = reportOf(own);
    if (sliced) desc.skySlice = tables;
    View* made = nullptr;
    EXPECT_EQ(createView(own, desc, &made), Status::Ok) << lastDiagnostic();
    const ResourceReport after = reportOf(own);
    EXPECT_EQ(after.pipelines - before.pipelines, expected.pipelines) << desc.without;
    // Not one of them is another's.
    EXPECT_EQ(after.shaderVariants - before.shaderVariants, expected.pipelines) << desc.without;
    EXPECT_EQ(after.images - before.images, expected.images) << desc.without;
    EXPECT_EQ(after.bytes - before.bytes, expected.bytes) << desc.without;
    EXPECT_EQ(after.buffers, before.buffers);
    const bool air = desc.sceneDepth.view != VK_NULL_HANDLE;
    const PlanCost told = sky::viewCost(tables->desc(), desc, sliced, air);
    EXPECT_EQ(told.pipelines, expected.pipelines) << desc.without;
    EXPECT_EQ(told.images, expected.images) << desc.without;
    EXPECT_EQ(told.bytes, expected.bytes) << desc.without;
    destroyView(made);
    destroyTables(tables);
    destroyContext(own);
  }

  /// Of a host's depth, whose own view is as small as may be.
  static ShaftSetup sceneSetup() {
    ShaftSetup setup;
    setup.shafts = setup.sliced = false;
    setup.without = kViewEffects;
    return setup;
  }
  const ShaftSetup scene_ = sceneSetup();

  ViewDesc without(EffectFlags effects, bool always) {
    ViewDesc desc = viewDesc();
    desc.without = effects;
    desc.alwaysSliced = always;
    return desc;
  }

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

// Six ways of pixels: two of ground, three of the disc, two without air. With a slice each comes
// twice, but for those that always have one; the slice's own besides.
TEST_F(ViewCostsTest, PixelsThatAViewNeverDrawsHaveNoPipeline) {
  expectAdded(without(0, false), true, {13, 2, 2 * kSlice});
  expectAdded(without(0, true), true, {7, 2, 2 * kSlice});
  expectAdded(without(kGround, true), true, {5, 2, 2 * kSlice});
  expectAdded(without(kDisc, true), true, {4, 2, 2 * kSlice});
  expectAdded(without(kGround | kDisc, false), false, {2, 0, 0});
  expectAdded(without(kViewEffects, false), false, {1, 0, 0});
}

// Cameras inside need half of the rays.
TEST_F(ViewCostsTest, WithoutSpaceSlicesAndVolumesAreHalfAsLarge) {
  expectAdded(without(kSpace, true), true, {5, 2, kSlice});
  ViewDesc air = without(kViewEffects, true);
  air.sceneDepth = rigOf(scene_, kExtent).scene;
  expectAdded(air, true, {4, 5, kSlice + 3 * kVolume / 2});
}

TEST_F(ViewCostsTest, WhatTablesAreWithoutASliceIsWithout) {
  expectAdded(without(kMie | kViewEffects, true), true, {2, 1, kSlice / 2});
  expectAdded(without(kMultiple | kViewEffects, true), true, {2, 2, kSlice});
}

// With a slice: the volume's three images, what fills it, what looks light up, what integrates.
TEST_F(ViewCostsTest, AirInFrontOfASceneOwnsItsVolume) {
  const SceneDepth scene = rigOf(scene_, kExtent).scene;
  ViewDesc desc = without(kGround | kDisc, false);
  desc.sceneDepth = scene;
  expectAdded(desc, false, {2 + 1, 0, 0});
  expectAdded(desc, true, {5 + 3, 2 + 3, 2 * kSlice + 3 * kVolume});
  desc.alwaysSliced = true;
  expectAdded(desc, true, {3 + 2, 2 + 3, 2 * kSlice + 3 * kVolume});
  desc.sceneDepth = {};
  expectAdded(desc, true, {3, 2, 2 * kSlice});
}

// The map from the sun, blocks, the surface with and without a volume; map and sums; their frame
// and blocks.
TEST_F(ViewCostsTest, ShaftsAreAnObjectOfTheirOwn) {
  ContextDesc plain = contextDesc();
  plain.capabilities = kCapabilitySky | kCapabilityAir | kCapabilityShafts;
  Context* own = nullptr;
  ASSERT_EQ(createContext(plain, &own), Status::Ok) << lastDiagnostic();
  ShaftsDesc desc;
  desc.sceneDepth = rigOf(scene_, kExtent).scene;
  desc.shadowMapSize = 64;
  desc.without = kViewEffects;
  const ResourceReport start = reportOf(own);
  Shafts* shafts = nullptr;
  ASSERT_EQ(createShafts(own, desc, &shafts), Status::Ok) << lastDiagnostic();
  const ResourceReport made = reportOf(own);
  EXPECT_EQ(made.pipelines - start.pipelines, 4u);
  EXPECT_EQ(made.shaderVariants - start.shaderVariants, 4u);
  EXPECT_EQ(made.images - start.images, 2u);
  EXPECT_EQ(made.buffers - start.buffers, 2u);
  EXPECT_GE(made.bytes - start.bytes, 64u * 64 * 4 + 24u * 16 * 16);
  ViewDesc view = without(kViewEffects, false);
  view.sceneDepth = desc.sceneDepth;
  view.shafts = shafts;
  View* shaded = nullptr;
  ASSERT_EQ(createView(own, view, &shaded), Status::Ok) << lastDiagnostic();
  const ResourceReport seen = reportOf(own);
  EXPECT_EQ(seen.pipelines - made.pipelines, 2u) << "Sky and air.";
  EXPECT_EQ(seen.images, made.images);
  EXPECT_EQ(seen.bytes, made.bytes);
  destroyView(shaded);
  destroyShafts(shafts);
  EXPECT_EQ(reportOf(own).images, start.images);
  EXPECT_EQ(reportOf(own).bytes, start.bytes);
  destroyContext(own);
}

TEST_F(ViewCostsTest, AFrameRecordsNothingOfWhatIsOff) {
  addCaster(
      reference::test::box(reference::Vector(600, 1500, -200), reference::Vector(900, 1800, 200)));
  const FrameState looking = drawFrom({50, 0, 0}, 90, 50, 40, kExtent, 35, 200);
  ShaftSetup shaded, plain;
  shaded.shadowMapSize = plain.shadowMapSize = 64;
  shaded.without = plain.without = kViewEffects;
  plain.shafts = false;
  rigOf(plain, kExtent);
  rigOf(shaded, kExtent);
  ViewDesc desc = without(kViewEffects, true);
  desc.skySlice = baked;
  View* const skyAlone = makeView(desc);
  const ResourceReport withShafts = frame([&] { draw(shaded, looking); });
  const ResourceReport withAir = frame([&] { draw(plain, looking); });
  const ResourceReport sky = frame([&] {
    recordSlice(skyAlone, baked, looking);
    picture(skyAlone, baked, looking);
  });
  EXPECT_EQ(sky.dispatches, 1u);
  EXPECT_EQ(sky.draws, 1u);
  EXPECT_EQ(withAir.dispatches - sky.dispatches, 1u) << "The volume.";
  EXPECT_EQ(withAir.draws - sky.draws, 1u) << "The air.";
  EXPECT_EQ(withShafts.dispatches - withAir.dispatches, 1u) << "Blocks.";
  EXPECT_EQ(withShafts.draws - withAir.draws, 2u) << "Map and surface.";
}

}  // namespace
}  // namespace alpenglow::testing
