// Frames that need disabled effects are refused with a sentence, and record nothing.
#include "tests/passes/light_shafts/light_shaft_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr EffectFlags kMie = effectBit(Effect::Mie), kGround = effectBit(Effect::Ground),
                      kDisc = effectBit(Effect::SunDisc), kSpace = effectBit(Effect::SpaceViews),
                      kMultiple = effectBit(Effect::MultipleScattering),
                      kAir = effectBit(Effect::AerialPerspective);
constexpr VkExtent2D kExtent = {24, 16};

class EffectRefusalsTest : public LightShaftTest {
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

  void expectSkyRefused(View* view, const Tables* tables, const FrameState& draw,
                        const char* parts) {
    run([&](VkCommandBuffer commands) {
      expectRefused(testing::recordSky(view, commands, tables, draw), parts);
      // One sentence is enough.
      EXPECT_EQ(alpenglow::recordSky(view, commands), Status::NotReady) << parts;
      EXPECT_EQ(message(), "");
      return true;
    });
  }

  void expectViewRefused(const Tables* tables, const ViewDesc& desc, const char* parts) {
    View* made = reinterpret_cast<View*>(uintptr_t{1});
    expectRefused(createView(context(), tables, desc, &made), parts);
    EXPECT_EQ(made, nullptr) << parts;
  }

  void expectTablesRefused(const TableDesc& desc, const char* parts) {
    Tables* made = reinterpret_cast<Tables*>(uintptr_t{1});
    expectRefused(createTables(context(), preset("earth"), desc, &made), parts);
    EXPECT_EQ(made, nullptr) << parts;
  }

  ViewDesc disabledEffects(EffectFlags effects) {
    ViewDesc desc = viewDesc();
    desc.disabledEffects = effects;
    return desc;
  }

  /// Of a host's depth, whose own view is as small as may be.
  static LightShaftSetup sceneSetup() {
    LightShaftSetup setup;
    setup.shafts = setup.fromLut = false;
    setup.disabledEffects = kViewEffects;
    return setup;
  }
  const LightShaftSetup scene_ = sceneSetup();

  /// Over the depth of a scene, with both LUTs.
  ViewDesc sceneDesc(EffectFlags effects) {
    ViewDesc desc = disabledEffects(effects);
    desc.depth = DepthConvention::Reversed;
    desc.sceneDepthFormat = scene_.depthFormat;
    desc.sky = SkyMethod::Lut;
    desc.aerialPerspective = AerialPerspective::On;
    return desc;
  }
  FrameDesc sceneFrame(const FrameState& draw) { return frameOf(rigOf(scene_, kExtent), draw); }
};

TEST_F(EffectRefusalsTest, DrawsThatNeedDisabledEffectsAreRefused) {
  View* const noGround = makeView(disabledEffects(kGround));
  View* const noDisc = makeView(disabledEffects(kDisc));
  View* const noSpace = makeView(disabledEffects(kSpace));
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

TEST_F(EffectRefusalsTest, LutsAndAtmosphereAreRefusedFromOutside) {
  View* const view = makeView(sceneDesc(kViewEffects), baked);
  ResourceReport start, end;
  resourceReport(context(), &start);
  run([&](VkCommandBuffer c) {
    FrameWork work;
    work.record = ~0u;
    expectRefused(beginFrame(view, sceneFrame(drawAt(300e3, -60)), &work),
                  "300000 m high|Effect::SpaceViews");
    EXPECT_EQ(work.record, 0u);
    EXPECT_EQ(alpenglow::recordLuts(view, c), Status::NotReady);
    EXPECT_EQ(recordAerialPerspective(view, c), Status::NotReady);
    EXPECT_EQ(message(), "");
    return true;
  });
  resourceReport(context(), &end);
  EXPECT_EQ(end.draws, start.draws);
  EXPECT_EQ(end.dispatches, start.dispatches);
}

TEST_F(EffectRefusalsTest, LutsOfThisFrameAreWanted) {
  View* const view = makeView(sceneDesc(kViewEffects), baked);
  const FrameState here = drawAt(500, 40), there = drawAt(501, 40);
  ResourceReport start, end;
  const auto refuseBoth = [&](const FrameState& draw) {
    ASSERT_EQ(beginFrame(view, sceneFrame(draw), nullptr), Status::Ok) << message();
    run([&](VkCommandBuffer c) {
      expectRefused(alpenglow::recordSky(view, c), "recordSky|recordLuts was not called");
      expectRefused(recordAerialPerspective(view, c),
                    "recordAerialPerspective|recordLuts was not called");
      return true;
    });
  };
  resourceReport(context(), &start);
  refuseBoth(here);
  ASSERT_EQ(beginFrame(view, sceneFrame(here), nullptr), Status::Ok) << message();
  run([&](VkCommandBuffer c) { return alpenglow::recordLuts(view, c) == Status::Ok; });
  refuseBoth(there);
  resourceReport(context(), &end);
  EXPECT_EQ(end.draws, start.draws);
  // LUTs of the same camera and sun serve on.
  FrameWork work;
  ASSERT_EQ(beginFrame(view, sceneFrame(here), &work), Status::Ok) << message();
  EXPECT_EQ(work.record, RecordFlags{kRecordAerialPerspective | kRecordSky});
  TargetDesc targetDesc;
  targetDesc.extent = kExtent;
  Target target(device(), targetDesc);
  const Picture seen = target.draw(
      [&](VkCommandBuffer commands) { return alpenglow::recordSky(view, commands) == Status::Ok; });
  EXPECT_EQ(badValue(seen), "") << message();
}

TEST_F(EffectRefusalsTest, DisabledEffectsOfViewsAndTablesMustAgree) {
  Tables* clear = nullptr;
  TableDesc clearDesc;
  clearDesc.quality = Quality::Draft;
  clearDesc.disabledEffects = kMie;
  ASSERT_EQ(createTables(context(), preset("earth"), clearDesc, &clear), Status::Ok) << message();
  bakeAll(device(), clear);
  const char* const sentence = "FrameDesc::tables|disabledEffects|create a view for these";
  View* const whole = makeView(disabledEffects(kViewEffects), baked);
  View* const part = makeView(disabledEffects(kViewEffects), clear);
  // Those of the tables may be named again.
  View* const named = makeView(disabledEffects(kMie | kViewEffects), clear);
  EXPECT_EQ(part->picture().disabledEffects, kMie | kViewEffects);
  EXPECT_EQ(named->picture().disabledEffects, kMie | kViewEffects);
  expectViewRefused(baked, disabledEffects(kMie | kViewEffects),
                    "ViewDesc::disabledEffects is|the tables lack");
  expectSkyRefused(whole, clear, drawAt(500, 40), sentence);
  expectSkyRefused(part, baked, drawAt(500, 40), sentence);
  expectSkyRefused(named, baked, drawAt(500, 40), sentence);
  EXPECT_EQ(badValue(picture(part, clear, drawAt(500, 40))), "");
  const auto expectFrameRefused = [&](View* view, const Tables* tables) {
    FrameDesc frame = sceneFrame(drawAt(500, 0));
    frame.tables = tables;
    expectRefused(beginFrame(view, frame, nullptr), sentence);
  };
  expectFrameRefused(makeView(sceneDesc(kViewEffects), baked), clear);
  expectFrameRefused(makeView(sceneDesc(kViewEffects), clear), baked);
  destroyTables(clear);
}

TEST_F(EffectRefusalsTest, DescriptionsThatMakeNoSense) {
  ViewDesc desc = disabledEffects(kSpace);
  desc.projection = Projection::Orthographic;
  expectViewRefused(baked, desc, "Effect::SpaceViews|orthographic");
  expectViewRefused(baked, disabledEffects(kAir),
                    "ViewDesc::disabledEffects is 0x100|kViewEffects");
  Tables* standard = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), smallTables(), &standard), Status::Ok);
  expectViewRefused(standard, disabledEffects(kMie),
                    "ViewDesc::disabledEffects is 0x2|the tables lack");
  destroyTables(standard);

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

TEST_F(EffectRefusalsTest, DisabledEffectsOfShaftsAndViewMustAgree) {
  Tables* clear = nullptr;
  TableDesc clearDesc;
  clearDesc.quality = Quality::Draft;
  clearDesc.disabledEffects = kMie;
  ASSERT_EQ(createTables(context(), preset("earth"), clearDesc, &clear), Status::Ok) << message();
  for (const EffectFlags effects : {EffectFlags{0}, kGround | kDisc, kViewEffects}) {
    ViewDesc desc = sceneDesc(effects);
    desc.lightShafts.method = LightShaftMethod::LightVolume;
    desc.lightShafts.shadowMapSize = 64;
    for (const Tables* tables :
         {static_cast<const Tables*>(baked), static_cast<const Tables*>(clear)}) {
      View* made = nullptr;
      ASSERT_EQ(createView(context(), tables, desc, &made), Status::Ok) << message();
      EXPECT_EQ(made->lightShafts().desc().disabledEffects, effects | (tables == clear ? kMie : 0));
      destroyView(made);
    }
    desc.disabledEffects |= kAir;
    expectViewRefused(baked, desc, "ViewDesc::disabledEffects is 0x");
  }
  destroyTables(clear);
}

}  // namespace
}  // namespace alpenglow::testing
