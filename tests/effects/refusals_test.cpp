// What is left out is refused in a sentence, and nothing is recorded of it.
#include "tests/shafts/shaft_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr EffectFlags kMie = effectBit(Effect::Mie), kGround = effectBit(Effect::Ground),
                      kDisc = effectBit(Effect::SunDisc), kSpace = effectBit(Effect::SpaceViews),
                      kMultiple = effectBit(Effect::MultipleScattering),
                      kAir = effectBit(Effect::AerialPerspective);
constexpr VkExtent2D kExtent = {24, 16};

class EffectRefusalsTest : public ShaftTest {
 protected:
  FrameState drawAt(double altitude, double pitch, double discRadius = 0.0) {
    FrameState draw = drawFrom({altitude, 0, 0}, 90, pitch, 40, kExtent, 15, 90);
    draw.sun.discRadius = discRadius;
    return draw;
  }

  void expectRefused(Status got, const char* parts) {
    EXPECT_EQ(got, Status::InvalidArgument) << parts;
    EXPECT_TRUE(hasAll(message(), parts)) << parts << ": " << message();
    message().clear();
  }

  void expectSkyRefused(View* view, const Tables* tables, const FrameState& draw, const char* parts) {
    run([&](VkCommandBuffer commands) {
      expectRefused(recordSky(view, commands, tables, draw), parts);
      return true;
    });
  }

  void expectViewRefused(const ViewDesc& desc, const char* parts) {
    View* made = reinterpret_cast<View*>(uintptr_t{1});
    expectRefused(createView(context(), desc, &made), parts);
    EXPECT_EQ(made, nullptr) << parts;
  }

  void expectTablesRefused(const TableDesc& desc, const char* parts) {
    Tables* made = reinterpret_cast<Tables*>(uintptr_t{1});
    expectRefused(createTables(context(), preset("earth"), desc, &made), parts);
    EXPECT_EQ(made, nullptr) << parts;
  }

  ViewDesc without(EffectFlags effects) {
    ViewDesc desc = viewDesc();
    desc.without = effects;
    return desc;
  }

  /// Of a host's depth, whose own view is as small as may be.
  static ShaftSetup sceneSetup() {
    ShaftSetup setup;
    setup.shafts = setup.sliced = false;
    setup.without = kViewEffects;
    return setup;
  }
  const ShaftSetup scene_ = sceneSetup();

  /// With the depth of a scene, for recordAir and shafts.
  ViewDesc sceneDesc(EffectFlags effects) {
    ViewDesc desc = without(effects);
    desc.depth = DepthConvention::Reversed;
    desc.sceneDepth = rigOf(scene_, kExtent).scene;
    return desc;
  }
};

TEST_F(EffectRefusalsTest, DrawsThatMaySeeWhatAViewIsWithout) {
  View* const noGround = makeView(without(kGround));
  View* const noDisc = makeView(without(kDisc));
  View* const noSpace = makeView(without(kSpace));
  ResourceReport start, end;
  resourceReport(context(), &start);
  expectSkyRefused(noGround, baked, drawAt(500, -10), "see the ground|Effect::Ground");
  expectSkyRefused(noDisc, baked, drawAt(500, 15, 0.005), "the sun's disc|Effect::SunDisc");
  expectSkyRefused(noSpace, baked, drawAt(300e3, -60), "300000 m|Effect::SpaceViews");
  resourceReport(context(), &end);
  EXPECT_EQ(end.draws, start.draws);
  // What they see besides is theirs.
  EXPECT_EQ(badValue(picture(noGround, baked, drawAt(500, 40))), "");
  EXPECT_EQ(badValue(picture(noDisc, baked, drawAt(500, 15))), "");
  EXPECT_EQ(badValue(picture(noDisc, baked, drawAt(500, -30, 0.005))), "");
  EXPECT_EQ(badValue(picture(noSpace, baked, drawAt(59e3, -60))), "");
}

TEST_F(EffectRefusalsTest, SlicesAndAirAreRefusedFromOutside) {
  ViewDesc desc = sceneDesc(kViewEffects);
  desc.skySlice = baked;
  desc.alwaysSliced = true;
  View* const view = makeView(desc);
  ResourceReport start, end;
  resourceReport(context(), &start);
  run([&](VkCommandBuffer c) {
    const FrameState outside = drawAt(300e3, -60);
    const char* const sentence = "300000 m high|Effect::SpaceViews";
    expectRefused(recordSkySlice(view, c, baked, outside), sentence);
    expectRefused(recordAir(view, c, baked, outside), sentence);
    return true;
  });
  resourceReport(context(), &end);
  EXPECT_EQ(end.draws, start.draws);
  EXPECT_EQ(end.dispatches, start.dispatches);
}

TEST_F(EffectRefusalsTest, AlwaysSlicedWantsASliceOfThisDraw) {
  ViewDesc desc = sceneDesc(kViewEffects);
  desc.skySlice = baked;
  desc.alwaysSliced = true;
  View* const view = makeView(desc);
  const FrameState here = drawAt(500, 40), there = drawAt(501, 40);
  ResourceReport start, end;
  const auto refuseBoth = [&](const FrameState& draw) {
    run([&](VkCommandBuffer c) {
      expectRefused(recordSky(view, c, baked, draw), "recordSky|alwaysSliced");
      expectRefused(recordAir(view, c, baked, draw), "recordAir|alwaysSliced");
      return true;
    });
  };
  resourceReport(context(), &start);
  refuseBoth(here);
  recordSlice(view, baked, here);
  refuseBoth(there);
  resourceReport(context(), &end);
  EXPECT_EQ(end.draws, start.draws);
  EXPECT_EQ(badValue(picture(view, baked, here)), "");
}

TEST_F(EffectRefusalsTest, ViewsAndTablesAreWithoutTheSame) {
  Tables* clear = nullptr;
  TableDesc clearDesc;
  clearDesc.quality = Quality::Draft;
  clearDesc.disabledEffects = kMie;
  ASSERT_EQ(createTables(context(), preset("earth"), clearDesc, &clear), Status::Ok) << message();
  bakeAll(device(), clear);
  View* const whole = makeView(without(kViewEffects));
  View* const part = makeView(without(kMie | kViewEffects));
  expectSkyRefused(whole, clear, drawAt(500, 40), "0x2|must agree");
  expectSkyRefused(part, baked, drawAt(500, 40), "0x0|must agree");
  EXPECT_EQ(badValue(picture(part, clear, drawAt(500, 40))), "");
  View* const air = makeView(sceneDesc(kViewEffects));
  run([&](VkCommandBuffer c) {
    expectRefused(recordAir(air, c, clear, drawAt(500, 0)), "0x2|must agree");
    return true;
  });
  ViewDesc sliced = without(kViewEffects);
  sliced.skySlice = clear;
  sliced.alwaysSliced = true;
  expectViewRefused(sliced, "0x2|must agree");
  sliced.without = kMie | kViewEffects;
  View* const slicedPart = makeView(sliced);
  run([&](VkCommandBuffer c) {
    expectRefused(recordSkySlice(slicedPart, c, baked, drawAt(500, 0)),
                  "0x0|must agree");
    return true;
  });
  destroyTables(clear);
}

TEST_F(EffectRefusalsTest, DescriptionsThatMakeNoSense) {
  ViewDesc desc = without(kSpace);
  desc.projection = Projection::Orthographic;
  expectViewRefused(desc, "Effect::SpaceViews|orthographic");
  desc = viewDesc();
  desc.alwaysSliced = true;
  expectViewRefused(desc, "alwaysSliced|no skySlice");
  desc.skySlice = baked;
  desc.projection = Projection::Orthographic;
  expectViewRefused(desc, "alwaysSliced|orthographic");
  expectViewRefused(without(kAir), "ViewDesc::without is 0x100|kViewEffects");
  desc = without(kMie);
  desc.solver = Solver::Standard;
  expectViewRefused(desc, "ViewDesc::without is 0x2|kTableEffects");

  TableDesc tables;
  tables.disabledEffects = kMultiple;
  tables.orders = 3;
  expectTablesRefused(tables, "3 orders|Effect::MultipleScattering");
  tables = {};
  tables.disabledEffects = kGround;
  expectTablesRefused(tables, "TableDesc::disabledEffects is 0x40|kTableEffects");
  tables = smallTables();
  tables.disabledEffects = kMie;
  expectTablesRefused(tables, "Solver::Standard|TableDesc::disabledEffects");
}

TEST_F(EffectRefusalsTest, ShaftsAreWithoutWhatTheirViewIs) {
  ShaftsDesc desc;
  desc.sceneDepth = rigOf(scene_, kExtent).scene;
  desc.depth = DepthConvention::Reversed;
  desc.shadowMapSize = 64;
  desc.without = kViewEffects;
  Shafts* shafts = nullptr;
  ASSERT_EQ(createShafts(context(), desc, &shafts), Status::Ok) << message();
  for (const EffectFlags other : {EffectFlags{0}, kSpace, kMie | kViewEffects}) {
    ViewDesc view = sceneDesc(other);
    view.shafts = shafts;
    expectViewRefused(view, "ViewDesc::shafts|without");
  }
  ViewDesc same = sceneDesc(kViewEffects);
  same.shafts = shafts;
  View* made = nullptr;
  EXPECT_EQ(createView(context(), same, &made), Status::Ok) << message();
  destroyView(made);
  destroyShafts(shafts);
  desc.without = kAir;
  expectRefused(createShafts(context(), desc, &shafts), "ShaftsDesc::without is 0x100");
}

}  // namespace
}  // namespace alpenglow::testing
