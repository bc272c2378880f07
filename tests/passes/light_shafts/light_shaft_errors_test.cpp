// What light shafts refuse, each with its sentence, and that the object works as before; and what
// they don't cost when they are off.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/passes/light_shafts/light_shaft_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr VkExtent2D kExtent = {24, 16};

class LightShaftErrorsTest : public LightShaftTest {
 protected:
  void SetUp() override {
    LightShaftTest::SetUp();
    addCaster(reference::test::box(reference::Vector(600, 1500, -200),
                                   reference::Vector(900, 1800, 200)));
    draw_ = drawFrom({50, 0, 0}, 90, 15, 60, kExtent, 35, 200);
  }
  /// `parts` of the sentence are separated by '|'.
  void expectRefused(Status got, Status expected, const char* parts) {
    EXPECT_EQ(got, expected) << parts;
    EXPECT_TRUE(hasAll(message(), parts)) << parts << ": " << message();
    message().clear();
  }
  ViewDesc goodDesc() const {
    ViewDesc desc = viewDescOf(setup_);
    desc.lightShafts.shadowMapSize = 64;
    return desc;
  }
  void expectViewRefused(const Tables* tables, const ViewDesc& desc, Status status,
                         const char* parts) {
    View* made = reinterpret_cast<View*>(uintptr_t{1});
    expectRefused(createView(context(), tables, desc, &made), status, parts);
    EXPECT_EQ(made, nullptr) << parts;
  }
  LightShaftSetup setup_;
  FrameState draw_;
};

TEST_F(LightShaftErrorsTest, BadDescriptionsAreRefusedWithTheValue) {
  struct Case {
    const char* parts;
    Status status;
    std::function<void(ViewDesc&, LightShaftDesc&)> spoil;
  };
  constexpr Status kBad = Status::InvalidArgument, kNot = Status::Unsupported;
  const Case cases[] = {
      {"LightShaftDesc::method is 7", kBad,
       [](ViewDesc&, LightShaftDesc& s) { s.method = static_cast<LightShaftMethod>(7); }},
      {"depth 9", kBad,
       [](ViewDesc& d, LightShaftDesc&) { d.depth = static_cast<DepthConvention>(9); }},
      {"projection 8", kBad,
       [](ViewDesc& d, LightShaftDesc&) { d.projection = static_cast<Projection>(8); }},
      {"aerialPerspective|fisheye", kBad,
       [](ViewDesc& d, LightShaftDesc&) { d.projection = Projection::Fisheye; }},
      {"shadowMapSize is 15", kBad, [](ViewDesc&, LightShaftDesc& s) { s.shadowMapSize = 15; }},
      {"shadowMapSize is 4000000000", kBad,
       [](ViewDesc&, LightShaftDesc& s) { s.shadowMapSize = 4000000000u; }},
      {"meshSize is 1,|64", kBad, [](ViewDesc&, LightShaftDesc& s) { s.meshSize = 1; }},
      {"meshSize is 65,|64", kBad, [](ViewDesc&, LightShaftDesc& s) { s.meshSize = 65; }},
      {"multipleLoss is 1.5", kBad, [](ViewDesc&, LightShaftDesc& s) { s.multipleLoss = 1.5; }},
      {"multipleLoss is nan", kBad,
       [](ViewDesc&, LightShaftDesc& s) { s.multipleLoss = std::nan(""); }},
      {"stepCount is 4097", kBad, [](ViewDesc&, LightShaftDesc& s) { s.stepCount = 4097; }},
      {"LightShaftDesc|vertexStride 14", kBad,
       [](ViewDesc&, LightShaftDesc& s) { s.vertexStride = 14; }},
      {"LightShaftDesc|vertexOffset 4", kBad,
       [](ViewDesc&, LightShaftDesc& s) { s.vertexOffset = 4; }},
      {"vertexOffset 4294967292", kBad,
       [](ViewDesc&, LightShaftDesc& s) { s.vertexOffset = 4294967292u; }},
      {"sceneDepthFormat is VkFormat 37", kNot,
       [](ViewDesc& d, LightShaftDesc&) { d.sceneDepthFormat = VK_FORMAT_R8G8B8A8_UNORM; }},
      {"aerialPerspective|VkFormat 0", kBad,
       [](ViewDesc& d, LightShaftDesc&) { d.depthFormat = VK_FORMAT_UNDEFINED; }},
      {"aerialPerspective|4 samples", kBad, [](ViewDesc& d, LightShaftDesc&) { d.samples = 4; }},
      {"lightShafts|ViewDesc::aerialPerspective", kBad,
       [](ViewDesc& d, LightShaftDesc&) { d.aerialPerspective = AerialPerspective::Off; }},
      {"adjacency is false", kBad,
       [](ViewDesc&, LightShaftDesc& s) {
         s.method = LightShaftMethod::ShadowVolume;
         s.adjacency = false;
       }},
      // Reserved for later versions.
      {"lightMask|version", kNot, [](ViewDesc&, LightShaftDesc& s) { s.lightMask = 2; }},
      {"lightMask|version", kNot, [](ViewDesc&, LightShaftDesc& s) { s.lightMask = 3; }},
      {"listLength|version", kNot, [](ViewDesc&, LightShaftDesc& s) { s.listLength = 8; }},
      {"hostPipelines|version", kNot, [](ViewDesc&, LightShaftDesc& s) { s.hostPipelines = true; }},
  };
  Tables* standard = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), smallTables(), &standard), Status::Ok);
  finishFrames(context());
  ResourceReport start, end;
  resourceReport(context(), &start);
  for (const Case& bad : cases) {
    ViewDesc desc = goodDesc();
    bad.spoil(desc, desc.lightShafts);
    expectViewRefused(baked, desc, bad.status, bad.parts);
  }
  expectViewRefused(standard, goodDesc(), kBad, "lightShafts|Solver::Standard");
  resourceReport(context(), &end);
  destroyTables(standard);
  EXPECT_EQ(end.pipelines, start.pipelines);
  EXPECT_EQ(end.images, start.images);
  EXPECT_EQ(end.bytes, start.bytes);
  EXPECT_EQ(createView(nullptr, baked, goodDesc(), nullptr), Status::InvalidArgument);
  // The one light that there is may be named.
  ViewDesc desc = goodDesc();
  desc.lightShafts.lightMask = 1;
  View* made = nullptr;
  EXPECT_EQ(createView(context(), baked, desc, &made), Status::Ok) << message();
  destroyView(made);
}

TEST_F(LightShaftErrorsTest, AnotherContextIsRefused) {
  Context* other = nullptr;
  ContextDesc all = contextDesc();
  all.capabilities =
      kCapabilityBake | kCapabilitySky | kCapabilityAerialPerspective | kCapabilityLightShafts;
  ASSERT_EQ(createContext(all, &other), Status::Ok);
  View* made = nullptr;
  EXPECT_EQ(createView(other, baked, goodDesc(), &made), Status::InvalidArgument);
  EXPECT_TRUE(hasAll(lastDiagnostic(), "createView|another context")) << lastDiagnostic();
  Tables* own = nullptr;
  TableDesc draft;
  draft.quality = Quality::Draft;
  ASSERT_EQ(createTables(other, parameters, draft, &own), Status::Ok);
  ASSERT_EQ(createView(other, own, goodDesc(), &made), Status::Ok) << lastDiagnostic();
  LightShaftRig& rig = rigOf(setup_, kExtent);
  FrameDesc frame = frameOf(rig, draw_);
  EXPECT_EQ(beginFrame(made, frame, nullptr), Status::InvalidArgument);
  EXPECT_TRUE(hasAll(lastDiagnostic(), "FrameDesc::tables|another context")) << lastDiagnostic();
  destroyView(made);
  destroyTables(own);
  destroyContext(other);

  ContextDesc reduced = contextDesc();
  reduced.capabilities = kCapabilityBake | kCapabilitySky | kCapabilityAerialPerspective;
  ASSERT_EQ(createContext(reduced, &other), Status::Ok);
  ASSERT_EQ(createTables(other, parameters, draft, &own), Status::Ok);
  EXPECT_EQ(createView(other, own, goodDesc(), &made), Status::Unsupported);
  EXPECT_TRUE(hasAll(lastDiagnostic(), "lightShafts|kCapabilityLightShafts")) << lastDiagnostic();
  destroyTables(own);
  destroyContext(other);
}

TEST_F(LightShaftErrorsTest, BadCallsRecordNothing) {
  const LightShaftPicture before = draw(setup_, draw_);
  LightShaftRig& rig = rigOf(setup_, kExtent);
  View* const view = rig.view;
  constexpr Status kBad = Status::InvalidArgument;
  ResourceReport start, end;
  resourceReport(context(), &start);
  const auto refuse = [&](const FrameDesc& frame, const char* parts) {
    expectRefused(beginFrame(view, frame, nullptr), kBad, parts);
    // Reported once.
    run([&](VkCommandBuffer c) {
      EXPECT_EQ(alpenglow::recordLuts(view, c), Status::NotReady);
      EXPECT_EQ(recordShadowMap(view, c), Status::NotReady);
      EXPECT_EQ(recordLightShafts(view, c), Status::NotReady);
      EXPECT_EQ(recordAerialPerspective(view, c), Status::NotReady);
      EXPECT_EQ(alpenglow::recordSky(view, c), Status::NotReady);
      return true;
    });
    EXPECT_EQ(message(), "") << parts;
  };
  const FrameDesc good = frameOf(rig, draw_);
  FrameDesc bad = good;
  bad.casters.bounds.halfExtents[1] = std::numeric_limits<double>::infinity();
  refuse(bad, "Casters::bounds");
  bad = good;
  bad.casters.bounds = Box{};
  refuse(bad, "Casters::bounds|(0, 0, 0)");
  bad = good;
  std::copy_n(std::array{0.0, 0.5, 0.0}.data(), 3, bad.lights[0].direction);
  refuse(bad, "Light::direction|0.5");
  bad = good;
  bad.cameras[0].viewport.offset = {4, 0};
  refuse(bad, "Camera::viewport|(28, 16)|24 x 16");
  bad = good;
  bad.cameras[0].nearPlane = 0.0;
  refuse(bad, "Camera::nearPlane|0");
  bad = good;
  bad.cameras[0].fov = -1.0;
  refuse(bad, "Camera::fov|-1");
  bad = good;
  bad.sceneDepth.view = VK_NULL_HANDLE;
  refuse(bad, "FrameDesc::sceneDepth has no view");
  bad = good;
  bad.sceneDepth.extent.width = 0;
  refuse(bad, "FrameDesc::sceneDepth|0 x 16");
  EXPECT_EQ(beginFrame(nullptr, good, nullptr), kBad);
  run([&](VkCommandBuffer c) {
    EXPECT_EQ(recordShadowMap(nullptr, c), kBad);
    EXPECT_EQ(recordLightShafts(nullptr, c), kBad);
    expectRefused(recordShadowMap(view, VK_NULL_HANDLE), kBad, "recordShadowMap|null");
    expectRefused(recordLightShafts(view, VK_NULL_HANDLE), kBad, "recordLightShafts|null");
    return true;
  });
  resourceReport(context(), &end);
  EXPECT_EQ(end.draws, start.draws);
  EXPECT_EQ(end.dispatches, start.dispatches);
  const LightShaftPicture after = draw(setup_, draw_);
  EXPECT_EQ(after.light.data, before.light.data);
}

// A planet-centred position instead of one in the world; the view reports it once.
TEST_F(LightShaftErrorsTest, CastersFarOutsideTheirBoundsAreWarnedOf) {
  LightShaftRig& rig = rigOf(setup_, kExtent);
  View* view = nullptr;
  ASSERT_EQ(createView(context(), baked, goodDesc(), &view), Status::Ok) << message();
  FrameDesc frame = frameOf(rig, draw_);
  struct Place {
    double origin[3];
  } near = {}, far = {};
  std::copy_n(frame.casters.bounds.center, 3, near.origin);
  far.origin[0] = -frame.casters.bounds.center[0];
  frame.casters.draw = [](void* user, VkCommandBuffer commands, const CasterPass& pass) {
    placeCaster(pass, commands, static_cast<Place*>(user)->origin, nullptr);
  };
  const auto drawMap = [&](Place* place) {
    frame.casters.user = place;
    message().clear();
    EXPECT_EQ(beginFrame(view, frame, nullptr), Status::Ok) << message();
    run([&](VkCommandBuffer c) {
      EXPECT_EQ(recordShadowMap(view, c), Status::Ok) << message();
      return true;
    });
    return message();
  };
  EXPECT_EQ(drawMap(&near), "");
  const std::string said = drawMap(&far);
  EXPECT_TRUE(hasAll(said, "placeCaster|Casters::bounds|world units")) << said;
  EXPECT_EQ(drawMap(&far), "");
  destroyView(view);
}

// Each function needs what the earlier ones of the frame record.
TEST_F(LightShaftErrorsTest, FunctionsAreCalledInTheirOrder) {
  constexpr Status kBad = Status::InvalidArgument;
  LightShaftRig& rig = rigOf(setup_, kExtent);
  draw(setup_, draw_);
  View* const view = rig.view;
  finishFrames(context());
  // Of a frame that has not begun.
  run([&](VkCommandBuffer c) {
    expectRefused(alpenglow::recordLuts(view, c), kBad, "recordLuts|beginFrame");
    expectRefused(recordShadowMap(view, c), kBad, "recordShadowMap|beginFrame");
    expectRefused(recordLightShafts(view, c), kBad, "recordLightShafts|beginFrame");
    expectRefused(recordAerialPerspective(view, c), kBad, "recordAerialPerspective|beginFrame");
    expectRefused(alpenglow::recordSky(view, c), kBad, "recordSky|beginFrame");
    return true;
  });
  FrameState moved = drawFrom({51, 0, 0}, 90, 15, 60, kExtent, 36, 200);
  // The last picture's shadow map, light shafts and LUTs belong to another frame; those of casters
  // without a version always do.
  for (const FrameState& state : {draw_, moved}) {
    ResourceReport start, end;
    resourceReport(context(), &start);
    ASSERT_EQ(beginFrame(view, frameOf(rig, state), nullptr), Status::Ok) << message();
    run([&](VkCommandBuffer c) {
      expectRefused(recordLightShafts(view, c), kBad, "recordLightShafts|recordShadowMap");
      if (state.sun.direction[0] == draw_.sun.direction[0]) return true;
      expectRefused(recordAerialPerspective(view, c), kBad, "recordAerialPerspective|recordLuts");
      expectRefused(alpenglow::recordSky(view, c), kBad, "recordSky|recordLuts");
      return true;
    });
    run([&](VkCommandBuffer c) {
      EXPECT_EQ(alpenglow::recordLuts(view, c), Status::Ok);
      expectRefused(recordAerialPerspective(view, c), kBad,
                    "recordAerialPerspective|recordLightShafts");
      expectRefused(alpenglow::recordSky(view, c), kBad, "recordSky|recordLightShafts");
      return true;
    });
    resourceReport(context(), &end);
    EXPECT_EQ(end.draws, start.draws);
  }
  // The LUTs are those of `moved` and need no update, but light shafts do.
  ASSERT_EQ(beginFrame(view, frameOf(rig, draw_), nullptr), Status::Ok) << message();
  run([&](VkCommandBuffer c) {
    EXPECT_EQ(recordShadowMap(view, c), Status::Ok);
    expectRefused(recordLightShafts(view, c), kBad, "recordLightShafts|recordLuts");
    EXPECT_EQ(alpenglow::recordLuts(view, c), Status::Ok);
    EXPECT_EQ(recordLightShafts(view, c), Status::Ok) << message();
    return true;
  });
}

TEST_F(LightShaftErrorsTest, AerialPerspectiveNeedsABlendableFormat) {
  ViewDesc desc = goodDesc();
  desc.lightShafts = {};
  desc.colorFormat = VK_FORMAT_R32G32B32A32_UINT;
  expectViewRefused(baked, desc, Status::Unsupported, "colorFormat|VkFormat 107");
  desc = goodDesc();
  desc.lightShafts = {};
  desc.sceneDepthFormat = VK_FORMAT_R32_SFLOAT;
  expectViewRefused(baked, desc, Status::Unsupported, "sceneDepthFormat|VkFormat 100");
}

TEST_F(LightShaftErrorsTest, OnlyShadowVolumesNeedGeometryShaders) {
  Requirements exact, paper;
  const auto query = [&](CapabilityFlags wanted, Requirements* out) {
    ContextDesc desc = contextDesc();
    desc.capabilities = wanted;
    return queryRequirements(desc, out);
  };
  ASSERT_EQ(query(kCapabilityLightShafts, &exact), Status::Ok);
  ASSERT_EQ(query(kCapabilityLightShafts | kCapabilityShadowVolumes, &paper), Status::Ok);
  EXPECT_EQ(exact.features.geometryShader, VK_FALSE);
  EXPECT_EQ(exact.features.depthClamp, VK_TRUE);
  EXPECT_EQ(paper.features.geometryShader, VK_TRUE);

  ContextDesc desc = contextDesc();
  desc.capabilities = kCapabilitySky | kCapabilityAerialPerspective | kCapabilityLightShafts;
  Context* reduced = nullptr;
  ASSERT_EQ(createContext(desc, &reduced), Status::Ok);
  TableDesc draft;
  draft.quality = Quality::Draft;
  Tables* own = nullptr;
  ASSERT_EQ(createTables(reduced, parameters, draft, &own), Status::Ok) << lastDiagnostic();
  ViewDesc view = goodDesc();
  View* made = nullptr;
  EXPECT_EQ(createView(reduced, own, view, &made), Status::Ok) << lastDiagnostic();
  destroyView(made);
  view.lightShafts.method = LightShaftMethod::ShadowVolume;
  EXPECT_EQ(createView(reduced, own, view, &made), Status::Unsupported);
  EXPECT_TRUE(hasAll(lastDiagnostic(), "ShadowVolume|kCapabilityShadowVolumes"))
      << lastDiagnostic();
  destroyTables(own);
  destroyContext(reduced);
}

/// Additional objects of a view with light shafts: made by createView, and by the first frame.
struct Added {
  uint64_t pipelines, images, buffers, frameImages;
};

TEST_F(LightShaftErrorsTest, UnusedMethodsCreateNothing) {
  const LightShaftRig& rig = rigOf(setup_, kExtent);
  const auto madeBy = [&](LightShaftMethod method) {
    ViewDesc desc = goodDesc();
    desc.lightShafts.method = method;
    finishFrames(context());
    ResourceReport start, made, begun;
    resourceReport(context(), &start);
    View* view = nullptr;
    EXPECT_EQ(createView(context(), baked, desc, &view), Status::Ok) << message();
    resourceReport(context(), &made);
    EXPECT_EQ(beginFrame(view, frameOf(rig, draw_), nullptr), Status::Ok) << message();
    resourceReport(context(), &begun);
    EXPECT_EQ(begun.pipelines, made.pipelines);
    EXPECT_EQ(begun.buffers, made.buffers);
    destroyView(view);
    return Added{made.pipelines - start.pipelines, made.images - start.images,
                 made.buffers - start.buffers, begun.images - made.images};
  };
  const Added off = madeBy(LightShaftMethod::Off);
  EXPECT_EQ(off.buffers, 0u);
  EXPECT_EQ(off.frameImages, 0u);
  // Shadow map, blocks, light-volume mesh with and without a LUT; sums.
  const Added exact = madeBy(LightShaftMethod::LightVolume);
  EXPECT_EQ(exact.pipelines - off.pipelines, 4u);
  EXPECT_EQ(exact.images - off.images, 1u);
  EXPECT_EQ(exact.buffers, 2u);
  EXPECT_EQ(exact.frameImages, 1u);
  // Volumes; sums and bounds, no map.
  const Added paper = madeBy(LightShaftMethod::ShadowVolume);
  EXPECT_EQ(paper.pipelines - off.pipelines, 1u);
  EXPECT_EQ(paper.images, off.images);
  EXPECT_EQ(paper.buffers, 1u);
  EXPECT_EQ(paper.frameImages, 2u);
  // The map alone, no geometry shader.
  const Added march = madeBy(LightShaftMethod::RayMarch);
  EXPECT_EQ(march.pipelines - off.pipelines, 1u);
  EXPECT_EQ(march.images - off.images, 1u);
  EXPECT_EQ(march.buffers, 1u);
  EXPECT_EQ(march.frameImages, 0u);
}

TEST_F(LightShaftErrorsTest, DisabledAerialPerspectiveCreatesNothing) {
  const auto pipelinesOf = [&](AerialPerspective air, uint64_t* images) {
    ViewDesc desc = goodDesc();
    desc.lightShafts = {};
    desc.aerialPerspective = air;
    ResourceReport start, end;
    resourceReport(context(), &start);
    View* made = nullptr;
    EXPECT_EQ(createView(context(), baked, desc, &made), Status::Ok) << message();
    resourceReport(context(), &end);
    destroyView(made);
    *images = end.images - start.images;
    return end.pipelines - start.pipelines;
  };
  uint64_t images = 0, aerialPerspectiveImages = 0, integratedImages = 0;
  const uint64_t reduced = pipelinesOf(AerialPerspective::Off, &images);
  const uint64_t with = pipelinesOf(AerialPerspective::On, &aerialPerspectiveImages);
  const uint64_t integrated = pipelinesOf(AerialPerspective::Integrate, &integratedImages);
  // Aerial perspective from its LUT, and the LUT's own objects; or by integration.
  EXPECT_EQ(with, reduced + 2);
  EXPECT_EQ(aerialPerspectiveImages, images + 3);
  EXPECT_EQ(integrated, reduced + 1);
  EXPECT_EQ(integratedImages, images);
}

}  // namespace
}  // namespace alpenglow::testing
