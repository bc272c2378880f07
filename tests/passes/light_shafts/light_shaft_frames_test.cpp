// From frame to frame: when the shadow map is drawn again, other extents of the scene's depth,
// frames that never execute, and the reported states of images.
#include <algorithm>
#include <cmath>

#include "atmosphere/api/context_impl.h"
#include "engine/structure.h"
#include "tests/passes/light_shafts/shadow_check.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;
using reference::test::box;

class LightShaftFramesTest : public ShadowCheckTest {
 protected:
  void SetUp() override {
    ShadowCheckTest::SetUp();
    state_ = stage(scene());
    setup_.shadowMapSize = 256;
  }
  static ShadowScene scene() {
    return {
        "box", {box(Vector(600, 1500, -200), Vector(900, 1800, 200))}, {50, 0, 0}, 90, 15, 60, 35,
        200};
  }
  FrameDesc frameWith(uint64_t version) {
    FrameDesc desc = frameOf(rigOf(setup_, kExtent), state_);
    desc.casters.version = version;
    return desc;
  }
  /// Whether the frame reports that it draws the shadow map; checks that it does.
  bool drawsMap(const FrameDesc& frame) {
    View* const view = rigOf(setup_, kExtent).view;
    finishFrames(context());
    FrameWork work;
    EXPECT_EQ(beginFrame(view, frame, &work), Status::Ok) << message();
    const bool says = (work.record & kRecordShadowMap) != 0;
    EXPECT_NE(work.record & kRecordLightShafts, 0u);
    ResourceReport start, end;
    resourceReport(context(), &start);
    run([&](VkCommandBuffer c) {
      EXPECT_EQ(alpenglow::recordLuts(view, c), Status::Ok);
      EXPECT_EQ(recordShadowMap(view, c), Status::Ok);
      return true;
    });
    resourceReport(context(), &end);
    EXPECT_EQ(end.shadowMapUpdates - start.shadowMapUpdates, says ? 1u : 0u);
    EXPECT_EQ(end.shadowMapsSkipped - start.shadowMapsSkipped, says ? 0u : 1u);
    EXPECT_EQ(end.draws - start.draws, says ? 1u : 0u);
    run([&](VkCommandBuffer c) { return recordLightShafts(view, c) == Status::Ok; });
    return says;
  }
  /// A barrier that does nothing but in validation, which knows the layout.
  void expectLayout(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspects,
                    const ImageInfo& info) {
    auto barrier =
        engine::structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT;
    barrier.oldLayout = barrier.newLayout = info.layout;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {aspects, 0, 1, 0, 1};
    auto dependency = engine::structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    context()->device->vk().CmdPipelineBarrier2(commands, &dependency);
  }
  LightShaftSetup setup_;
  FrameState state_;
};

TEST_F(LightShaftFramesTest, TheShadowMapIsDrawnWhenSomethingChanges) {
  rigOf(setup_, kExtent);
  EXPECT_TRUE(drawsMap(frameWith(5)));
  EXPECT_FALSE(drawsMap(frameWith(5)));
  // The camera is none of it.
  const FrameState here = state_;
  state_.camera.position_m[0] += 10.0;
  EXPECT_FALSE(drawsMap(frameWith(5)));
  state_ = here;
  EXPECT_TRUE(drawsMap(frameWith(6))) << "Another version.";
  EXPECT_FALSE(drawsMap(frameWith(6)));
  EXPECT_TRUE(drawsMap(frameWith(5))) << "A version of before.";
  FrameDesc wider = frameWith(5);
  wider.casters.bounds.halfExtents[1] += 1.0;
  EXPECT_TRUE(drawsMap(wider)) << "Other bounds.";
  EXPECT_FALSE(drawsMap(wider));
  wider.casters.bounds.center[2] += 1.0;
  EXPECT_TRUE(drawsMap(wider)) << "Bounds elsewhere.";
  EXPECT_TRUE(drawsMap(frameWith(5)));
  state_ = drawFrom({50, 0, 0}, 90, 15, 60, kExtent, 35.1, 200);
  EXPECT_TRUE(drawsMap(frameWith(5))) << "Another sun.";
  EXPECT_FALSE(drawsMap(frameWith(5)));
  EXPECT_TRUE(drawsMap(frameWith(0))) << "No version.";
  EXPECT_TRUE(drawsMap(frameWith(0)));
  EXPECT_TRUE(drawsMap(frameWith(5)));
  // Null: nothing casts, and what is drawn before stays valid.
  FrameDesc nothing = frameWith(5);
  nothing.casters = {};
  EXPECT_FALSE(drawsMap(nothing));
  EXPECT_FALSE(drawsMap(frameWith(5)));
}

// A direction that a host computes again may differ in the last bit.
TEST_F(LightShaftFramesTest, RoundingIsNoOtherSun) {
  LightShaftPicture first = draw(setup_, state_);
  EXPECT_TRUE(drawsMap(frameWith(7)));
  const double east = state_.sun.direction[1];
  state_.sun.direction[1] = std::nextafter(east, 2.0);
  EXPECT_FALSE(drawsMap(frameWith(7)));
  state_.sun.direction[1] = east;
}

// A kept shadow map casts the same shadows as a new one.
TEST_F(LightShaftFramesTest, AKeptMapCastsTheSameShadows) {
  for (const LightShaftMethod method :
       {LightShaftMethod::LightVolume, LightShaftMethod::RayMarch}) {
    setup_.method = method;
    const LightShaftPicture fresh = draw(setup_, state_);
    drawsMap(frameWith(9));
    ASSERT_FALSE(drawsMap(frameWith(9)));
    LightShaftRig& rig = rigOf(setup_, kExtent);
    rig.used = 0;
    run([&](VkCommandBuffer c) { return recordDepth(c, setup_, state_, rig) == Status::Ok; });
    ASSERT_EQ(beginFrame(rig.view, frameWith(9), nullptr), Status::Ok) << message();
    run([&](VkCommandBuffer c) { return recordLightShafts(rig.view, c) == Status::Ok; });
    run([&](VkCommandBuffer c) {
      return recordLight(c, setup_, state_, rig.view, rig) == Status::Ok;
    });
    run([&](VkCommandBuffer c) {
      rig.copyBack(c, rig.color, VK_IMAGE_ASPECT_COLOR_BIT, 16);
      return true;
    });
    EXPECT_EQ(rig.floats(0, fresh.light.data.size()), fresh.light.data);
  }
}

TEST_F(LightShaftFramesTest, NullCastersTakeNoLight) {
  for (const LightShaftMethod method :
       {LightShaftMethod::LightVolume, LightShaftMethod::ShadowVolume,
        LightShaftMethod::RayMarch}) {
    SCOPED_TRACE(static_cast<int>(method));
    setup_.method = method;
    setup_.hostDepth = false;
    LightShaftRig& rig = rigOf(setup_, kExtent);
    LightShaftSetup sunny = setup_;
    sunny.shafts = false;
    const LightShaftPicture wanted = draw(sunny, state_);
    FrameDesc frame = frameOf(rig, state_);
    frame.casters = {};
    ASSERT_EQ(beginFrame(rig.view, frame, nullptr), Status::Ok) << message();
    rig.used = 0;
    run([&](VkCommandBuffer c) {
      EXPECT_EQ(recordDepth(c, setup_, state_, rig), Status::Ok);
      EXPECT_EQ(alpenglow::recordLuts(rig.view, c), Status::Ok);
      EXPECT_EQ(recordShadowMap(rig.view, c), Status::Ok);
      EXPECT_EQ(recordLightShafts(rig.view, c), Status::Ok) << message();
      EXPECT_EQ(recordLight(c, setup_, state_, rig.view, rig), Status::Ok) << message();
      rig.copyBack(c, rig.color, VK_IMAGE_ASPECT_COLOR_BIT, 16);
      return true;
    });
    EXPECT_EQ(rig.floats(0, wanted.light.data.size()), wanted.light.data);
  }
}

TEST_F(LightShaftFramesTest, AViewSurvivesOtherExtents) {
  constexpr VkExtent2D kSizes[] = {kExtent, {36, 40}};
  for (const LightShaftMethod method :
       {LightShaftMethod::LightVolume, LightShaftMethod::ShadowVolume,
        LightShaftMethod::RayMarch}) {
    SCOPED_TRACE(static_cast<int>(method));
    setup_.method = method;
    FrameState states[2];
    LightShaftPicture wanted[2];
    for (int i = 0; i < 2; ++i) {
      states[i] = state_;
      states[i].viewport.extent = kSizes[i];
      wanted[i] = draw(setup_, states[i]);
    }
    View* view = nullptr;
    ASSERT_EQ(createView(context(), baked, viewDescOf(setup_), &view), Status::Ok) << message();
    uint64_t images[2] = {};
    for (int i = 0; i < 6; ++i) {
      const int size = i % 2;
      const LightShaftPicture got = draw(setup_, states[size], view);
      EXPECT_EQ(got.light.data, wanted[size].light.data) << i;
      if (i < 2) continue;  // Twice within a frame.
      finishFrames(context());
      ResourceReport now;
      resourceReport(context(), &now);
      if (i >= 4) {
        EXPECT_EQ(now.images, images[size]) << "Old targets stay.";
      }
      images[size] = now.images;
    }
    FrameWork work;
    ASSERT_EQ(beginFrame(view, frameOf(rigOf(setup_, kSizes[0]), states[0]), &work), Status::Ok);
    EXPECT_EQ(work.images[kViewSceneDepth].extent.width, kSizes[0].width);
    if (method != LightShaftMethod::RayMarch) {
      EXPECT_EQ(work.images[kViewLightShafts].extent.height, kSizes[0].height);
    }
    destroyView(view);
  }
}

TEST_F(LightShaftFramesTest, AnAbandonedFrameDrewNoMap) {
  View* const view = rigOf(setup_, kExtent).view;
  EXPECT_TRUE(drawsMap(frameWith(3)));
  EXPECT_FALSE(drawsMap(frameWith(3)));
  const uint64_t frame = device().skipFrame();
  ASSERT_EQ(advanceFrame(context(), frame, frame - 1), Status::Ok) << message();
  // What was drawn in frames before stays.
  FrameWork work;
  ASSERT_EQ(beginFrame(view, frameWith(3), &work), Status::Ok) << message();
  ASSERT_EQ(abandonFrame(context(), frame), Status::Ok) << message();
  EXPECT_FALSE(drawsMap(frameWith(3)));
  const uint64_t next = device().skipFrame();
  ASSERT_EQ(advanceFrame(context(), next, next - 1), Status::Ok) << message();
  ASSERT_EQ(beginFrame(view, frameWith(4), &work), Status::Ok) << message();
  EXPECT_NE(work.record & kRecordShadowMap, 0u);
  run([&](VkCommandBuffer c) { return recordShadowMap(view, c) == Status::Ok; });
  ASSERT_EQ(abandonFrame(context(), next), Status::Ok) << message();
  ASSERT_EQ(beginFrame(view, frameWith(4), &work), Status::Ok) << message();
  EXPECT_NE(work.record & kRecordShadowMap, 0u) << "It never executed.";
  EXPECT_TRUE(drawsMap(frameWith(4)));
  EXPECT_FALSE(drawsMap(frameWith(4)));
}

TEST_F(LightShaftFramesTest, ImagesAreInTheReportedLayouts) {
  for (const LightShaftMethod method :
       {LightShaftMethod::LightVolume, LightShaftMethod::ShadowVolume,
        LightShaftMethod::RayMarch}) {
    SCOPED_TRACE(static_cast<int>(method));
    setup_.method = method;
    LightShaftRig& rig = rigOf(setup_, kExtent);
    View* view = nullptr;
    ASSERT_EQ(createView(context(), baked, viewDescOf(setup_), &view), Status::Ok) << message();
    const bool mapped = method != LightShaftMethod::ShadowVolume;
    const bool sums = method != LightShaftMethod::RayMarch;
    for (int frame = 0; frame < 2; ++frame) {
      FrameDesc desc = frameOf(rig, state_);
      desc.casters.version = 1;
      FrameWork work;
      ASSERT_EQ(beginFrame(view, desc, &work), Status::Ok) << message();
      const ImageInfo* images = work.images;
      EXPECT_EQ(images[kViewShadowMap].name != nullptr, mapped);
      EXPECT_EQ(images[kViewLightShafts].name != nullptr, sums);
      EXPECT_EQ(images[kViewSceneDepth].view, rig.scene.view);
      EXPECT_EQ(images[kViewSceneDepth].layout, rig.scene.layout);
      EXPECT_EQ(images[kViewSceneDepth].format, setup_.depthFormat);
      run([&](VkCommandBuffer c) {
        EXPECT_EQ(recordDepth(c, setup_, state_, rig), Status::Ok);
        EXPECT_EQ(alpenglow::recordLuts(view, c), Status::Ok);
        EXPECT_EQ(recordShadowMap(view, c), Status::Ok);
        EXPECT_EQ(recordLightShafts(view, c), Status::Ok) << message();
        EXPECT_EQ(recordLight(c, setup_, state_, view, rig), Status::Ok) << message();
        for (const ViewImage each : {kViewSkyLut, kViewAerialPerspectiveLut0, kViewLightShafts}) {
          if (images[each].name != nullptr)
            expectLayout(c, images[each].image, VK_IMAGE_ASPECT_COLOR_BIT, images[each]);
        }
        if (mapped)
          expectLayout(c, images[kViewShadowMap].image, VK_IMAGE_ASPECT_DEPTH_BIT,
                       images[kViewShadowMap]);
        expectLayout(c, rig.depth.handle, VK_IMAGE_ASPECT_DEPTH_BIT, images[kViewSceneDepth]);
        return true;
      });
    }
    destroyView(view);
  }
}

}  // namespace
}  // namespace alpenglow::testing
