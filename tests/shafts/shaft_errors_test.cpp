// What light shafts refuse, each with its sentence, and that the object works as before; and what
// they don't cost when they are off.
#include <cmath>
#include <limits>

#include "tests/shafts/shaft_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr VkExtent2D kExtent = {24, 16};

class ShaftErrorsTest : public ShaftTest {
 protected:
  void SetUp() override {
    ShaftTest::SetUp();
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
  ShaftsDesc goodDesc(const ShaftRig& rig) const {
    ShaftsDesc desc;
    desc.sceneDepth = rig.scene;
    desc.adjacency = true;
    desc.shadowMapSize = 64;
    return desc;
  }
  ShaftSetup setup_;
  FrameState draw_;
};

TEST_F(ShaftErrorsTest, BadDescriptionsAreRefusedWithTheValue) {
  struct Case {
    const char* parts;
    Status status;
    std::function<void(ShaftsDesc&)> spoil;
  };
  constexpr Status kBad = Status::InvalidArgument, kNot = Status::Unsupported;
  const Case cases[] = {
      {"method 7", kBad, [](ShaftsDesc& d) { d.method = static_cast<LightShaftMethod>(7); }},
      {"depth 9", kBad, [](ShaftsDesc& d) { d.depth = static_cast<DepthConvention>(9); }},
      {"projection 8", kBad, [](ShaftsDesc& d) { d.projection = static_cast<Projection>(8); }},
      {"Fisheye", kNot, [](ShaftsDesc& d) { d.projection = Projection::Fisheye; }},
      {"shadowMapSize is 15", kBad, [](ShaftsDesc& d) { d.shadowMapSize = 15; }},
      {"shadowMapSize is 4000000000", kBad, [](ShaftsDesc& d) { d.shadowMapSize = 4000000000u; }},
      {"meshSize is 1,|64", kBad, [](ShaftsDesc& d) { d.meshSize = 1; }},
      {"meshSize is 65,|64", kBad, [](ShaftsDesc& d) { d.meshSize = 65; }},
      {"multipleLoss is 1.5", kBad, [](ShaftsDesc& d) { d.multipleLoss = 1.5; }},
      {"multipleLoss is nan", kBad, [](ShaftsDesc& d) { d.multipleLoss = std::nan(""); }},
      {"samples is 4097", kBad, [](ShaftsDesc& d) { d.samples = 4097; }},
      {"vertexStride 14", kBad, [](ShaftsDesc& d) { d.vertexStride = 14; }},
      {"vertexOffset 4", kBad, [](ShaftsDesc& d) { d.vertexOffset = 4; }},
      {"vertexOffset 4294967292", kBad, [](ShaftsDesc& d) { d.vertexOffset = 4294967292u; }},
      {"sceneDepth has no view", kBad, [](ShaftsDesc& d) { d.sceneDepth.view = VK_NULL_HANDLE; }},
      {"sceneDepth|0 x 16", kBad, [](ShaftsDesc& d) { d.sceneDepth.extent.width = 0; }},
      {"sceneDepth|24 x 4000000000", kBad,
       [](ShaftsDesc& d) { d.sceneDepth.extent.height = 4000000000u; }},
      {"sceneDepth|VkFormat 37", kNot,
       [](ShaftsDesc& d) { d.sceneDepth.format = VK_FORMAT_R8G8B8A8_UNORM; }},
      {"adjacency is false", kBad,
       [](ShaftsDesc& d) {
         d.method = LightShaftMethod::ShadowVolume;
         d.adjacency = false;
       }},
  };
  const ShaftRig& rig = rigOf(setup_, kExtent);
  ResourceReport start, end;
  resourceReport(context(), &start);
  for (const Case& bad : cases) {
    ShaftsDesc desc = goodDesc(rig);
    bad.spoil(desc);
    Shafts* made = reinterpret_cast<Shafts*>(uintptr_t{1});
    expectRefused(createShafts(context(), desc, &made), bad.status, bad.parts);
    EXPECT_EQ(made, nullptr) << bad.parts;
  }
  resourceReport(context(), &end);
  EXPECT_EQ(end.pipelines, start.pipelines);
  EXPECT_EQ(end.images, start.images);
  EXPECT_EQ(end.bytes, start.bytes);
  EXPECT_EQ(createShafts(nullptr, goodDesc(rig), nullptr), Status::InvalidArgument);
}

TEST_F(ShaftErrorsTest, ViewsNeedShaftsOfTheirOwnPicture) {
  ShaftRig& rig = rigOf(setup_, kExtent);
  ViewDesc good;
  good.colorFormat = kShaftColor;
  good.depthFormat = setup_.depthFormat;
  good.depth = setup_.depth;
  good.sceneDepth = rig.scene;
  good.shafts = rig.shafts;
  struct Case {
    const char* parts;
    std::function<void(ViewDesc&)> spoil;
  };
  const Case cases[] = {
      {"made for another picture", [](ViewDesc& d) { d.depth = DepthConvention::Standard; }},
      {"made for another picture", [](ViewDesc& d) { d.projection = Projection::Orthographic; }},
      {"made for another picture", [](ViewDesc& d) { d.sceneDepth.extent.width = 20; }},
      {"made for another picture", [](ViewDesc& d) { d.sceneDepth = SceneDepth{}; }},
      {"Solver::Standard", [](ViewDesc& d) { d.solver = Solver::Standard; }},
      {"sceneDepth|fisheye", [](ViewDesc& d) { d.projection = Projection::Fisheye; }},
      {"sceneDepth has 0 x 16", [](ViewDesc& d) { d.sceneDepth.extent.width = 0; }},
      {"sceneDepth|4 samples", [](ViewDesc& d) { d.samples = VK_SAMPLE_COUNT_4_BIT; }},
  };
  for (const Case& bad : cases) {
    ViewDesc desc = good;
    bad.spoil(desc);
    View* made = nullptr;
    expectRefused(createView(context(), desc, &made), Status::InvalidArgument, bad.parts);
    EXPECT_EQ(made, nullptr);
  }
}

TEST_F(ShaftErrorsTest, AnotherContextIsRefused) {
  ShaftRig& rig = rigOf(setup_, kExtent);
  Context* other = nullptr;
  ContextDesc all = contextDesc();
  all.capabilities = kCapabilityBake | kCapabilitySky | kCapabilityAir | kCapabilityShafts;
  ASSERT_EQ(createContext(all, &other), Status::Ok);
  ViewDesc desc;
  desc.colorFormat = kShaftColor;
  desc.depthFormat = setup_.depthFormat;
  desc.depth = setup_.depth;
  desc.sceneDepth = rig.scene;
  desc.shafts = rig.shafts;
  View* made = nullptr;
  EXPECT_EQ(createView(other, desc, &made), Status::InvalidArgument);
  EXPECT_TRUE(hasAll(lastDiagnostic(), "another context")) << lastDiagnostic();
  Shafts* shafts = nullptr;
  EXPECT_EQ(createShafts(other, goodDesc(rig), &shafts), Status::Ok);
  run([&](VkCommandBuffer c) {
    EXPECT_EQ(recordSunMap(shafts, c, draw_.sun.direction, casters()), Status::Ok);
    EXPECT_EQ(recordShafts(shafts, rig.view, c, baked, draw_, casters()),
              Status::InvalidArgument);
    return true;
  });
  EXPECT_TRUE(hasAll(lastDiagnostic(), "recordShafts|others")) << lastDiagnostic();
  destroyShafts(shafts);
  destroyContext(other);

  ContextDesc without = contextDesc();
  without.capabilities = kCapabilityBake | kCapabilitySky;
  ASSERT_EQ(createContext(without, &other), Status::Ok);
  EXPECT_EQ(createShafts(other, goodDesc(rig), &shafts), Status::Unsupported);
  EXPECT_TRUE(hasAll(lastDiagnostic(), "createShafts|kCapabilityShafts")) << lastDiagnostic();
  destroyContext(other);
}

TEST_F(ShaftErrorsTest, BadCallsRecordNothing) {
  const ShaftPicture before = draw(setup_, draw_);
  ShaftRig& rig = rigOf(setup_, kExtent);
  constexpr Status kBad = Status::InvalidArgument;
  ResourceReport start, end;
  resourceReport(context(), &start);
  run([&](VkCommandBuffer c) {
    const double* sun = draw_.sun.direction;
    const auto shaftsWith = [&](const FrameState& d, const Casters& casters) {
      return recordShafts(rig.shafts, rig.view, c, baked, d, casters);
    };
    Casters bad = casters();
    bad.draw = nullptr;
    expectRefused(recordSunMap(rig.shafts, c, sun, bad), kBad, "Casters::draw is null");
    expectRefused(shaftsWith(draw_, bad), kBad, "Casters::draw is null");
    bad = casters();
    bad.bounds.halfAxes_m[1][2] = std::numeric_limits<double>::infinity();
    expectRefused(recordSunMap(rig.shafts, c, sun, bad), kBad, "Casters::bounds");
    bad = casters();
    bad.bounds = Box{};
    expectRefused(shaftsWith(draw_, bad), kBad, "Casters::bounds|(0, 0, 0)");
    const double nowhere[3] = {0.0, 0.5, 0.0};
    expectRefused(recordSunMap(rig.shafts, c, nowhere, casters()), kBad, "sunDirection|0.5");
    FrameState d = drawFrom({50, 0, 0}, 90, 15, 60, kExtent, 36, 200);
    expectRefused(shaftsWith(d, casters()), kBad, "recordSunMap was called last for");
    d = draw_;
    d.viewport.offset = {4, 0};
    expectRefused(shaftsWith(d, casters()), kBad, "Camera::viewport|(28, 16)|24 x 16");
    d = draw_;
    d.depth.near_m = 0.0;
    expectRefused(shaftsWith(d, casters()), kBad, "Camera::nearPlane|0");
    d = draw_;
    d.camera.fov = 0.0;
    expectRefused(shaftsWith(d, casters()), kBad, "Camera::fov");
    // Shadows of another camera.
    d = draw_;
    d.camera.position_m[0] += 1.0;
    expectRefused(recordSky(rig.view, c, baked, d), kBad, "recordShafts was not called");
    expectRefused(recordAir(rig.view, c, baked, d), kBad, "recordShafts was not called");
    EXPECT_EQ(recordSunMap(nullptr, c, sun, casters()), kBad);
    EXPECT_EQ(recordShafts(rig.shafts, nullptr, c, baked, d, casters()), kBad);
    return true;
  });
  resourceReport(context(), &end);
  EXPECT_EQ(end.draws, start.draws);
  EXPECT_EQ(end.dispatches, start.dispatches);
  const ShaftPicture after = draw(setup_, draw_);
  EXPECT_EQ(after.light.data, before.light.data);
}

TEST_F(ShaftErrorsTest, AirNeedsAFormatThatBlends) {
  ViewDesc desc;
  desc.colorFormat = VK_FORMAT_R32G32B32A32_UINT;
  desc.sceneDepth = rigOf(setup_, kExtent).scene;
  View* view = nullptr;
  expectRefused(createView(context(), desc, &view), Status::Unsupported, "VkFormat 107|blend");
}

TEST_F(ShaftErrorsTest, OnlyThePaperNeedsGeometryShaders) {
  Requirements exact, paper;
  const auto query = [&](CapabilityFlags wanted, Requirements* out) {
    ContextDesc desc = contextDesc();
    desc.capabilities = wanted;
    return queryRequirements(desc, out);
  };
  ASSERT_EQ(query(kCapabilityShafts, &exact), Status::Ok);
  ASSERT_EQ(query(kCapabilityShafts | kCapabilityShadowVolumes, &paper), Status::Ok);
  EXPECT_EQ(exact.features.geometryShader, VK_FALSE);
  EXPECT_EQ(exact.features.depthClamp, VK_TRUE);
  EXPECT_EQ(paper.features.geometryShader, VK_TRUE);

  ContextDesc desc = contextDesc();
  desc.capabilities = kCapabilitySky | kCapabilityAir | kCapabilityShafts;
  Context* without = nullptr;
  ASSERT_EQ(createContext(desc, &without), Status::Ok);
  ShaftsDesc shafts = goodDesc(rigOf(setup_, kExtent));
  Shafts* made = nullptr;
  EXPECT_EQ(createShafts(without, shafts, &made), Status::Ok) << lastDiagnostic();
  destroyShafts(made);
  shafts.method = LightShaftMethod::ShadowVolume;
  EXPECT_EQ(createShafts(without, shafts, &made), Status::Unsupported);
  EXPECT_TRUE(hasAll(lastDiagnostic(), "Paper|kCapabilityShadowVolumes")) << lastDiagnostic();
  destroyContext(without);
}

TEST_F(ShaftErrorsTest, AMapComesFirst) {
  ShaftRig& rig = rigOf(setup_, kExtent);
  Shafts* fresh = nullptr;
  ASSERT_EQ(createShafts(context(), goodDesc(rig), &fresh), Status::Ok);
  ViewDesc desc;
  desc.colorFormat = kShaftColor;
  desc.depthFormat = setup_.depthFormat;
  desc.sceneDepth = rig.scene;
  desc.shafts = fresh;
  View* view = nullptr;
  ASSERT_EQ(createView(context(), desc, &view), Status::Ok) << message();
  run([&](VkCommandBuffer c) {
    expectRefused(recordShafts(fresh, rig.view, c, baked, draw_, casters()),
                  Status::InvalidArgument, "made with others");
    expectRefused(recordShafts(fresh, view, c, baked, draw_, casters()),
                  Status::InvalidArgument, "recordSunMap");
    EXPECT_EQ(recordSunMap(fresh, c, draw_.sun.direction, casters()), Status::Ok);
    EXPECT_EQ(recordShafts(fresh, view, c, baked, draw_, casters()), Status::Ok);
    return true;
  });
  destroyView(view);
  destroyShafts(fresh);
}

/// What making an object added.
struct Added {
  uint64_t pipelines, images, buffers;
};

TEST_F(ShaftErrorsTest, NothingIsMadeOfAMethodThatIsNotChosen) {
  const ShaftRig& rig = rigOf(setup_, kExtent);
  const auto addedBy = [&](LightShaftMethod method) {
    ShaftsDesc desc = goodDesc(rig);
    desc.method = method;
    ResourceReport start, end;
    resourceReport(context(), &start);
    Shafts* shafts = nullptr;
    EXPECT_EQ(createShafts(context(), desc, &shafts), Status::Ok) << message();
    resourceReport(context(), &end);
    destroyShafts(shafts);
    return Added{end.pipelines - start.pipelines, end.images - start.images,
                 end.buffers - start.buffers};
  };
  // Exact: the map, blocks, the surface with and without an air volume; sums.
  const Added exact = addedBy(LightShaftMethod::LightVolume);
  EXPECT_EQ(exact.pipelines, 4u);
  EXPECT_EQ(exact.images, 2u);
  EXPECT_EQ(exact.buffers, 2u);
  // Paper: volumes; sums and bounds, no map.
  const Added paper = addedBy(LightShaftMethod::ShadowVolume);
  EXPECT_EQ(paper.pipelines, 1u);
  EXPECT_EQ(paper.images, 2u);
  EXPECT_EQ(paper.buffers, 1u);
  // March: the map alone, no geometry shader.
  const Added march = addedBy(LightShaftMethod::RayMarch);
  EXPECT_EQ(march.pipelines, 1u);
  EXPECT_EQ(march.images, 1u);
  EXPECT_EQ(march.buffers, 1u);
}

TEST_F(ShaftErrorsTest, AViewWithoutAirMakesNoneOfIt) {
  const ShaftRig& rig = rigOf(setup_, kExtent);
  const auto pipelinesOf = [&](const SceneDepth& scene, uint64_t* images) {
    ViewDesc desc;
    desc.colorFormat = kShaftColor;
    desc.depthFormat = setup_.depthFormat;
    desc.depth = setup_.depth;
    desc.sceneDepth = scene;
    desc.skySlice = baked;
    ResourceReport start, end;
    resourceReport(context(), &start);
    View* made = nullptr;
    EXPECT_EQ(createView(context(), desc, &made), Status::Ok) << message();
    resourceReport(context(), &end);
    destroyView(made);
    *images = end.images - start.images;
    return end.pipelines - start.pipelines;
  };
  uint64_t images = 0, airImages = 0;
  const uint64_t without = pipelinesOf(SceneDepth{}, &images);
  const uint64_t with = pipelinesOf(rig.scene, &airImages);
  // Air by integration, from the volume, and the volume's own.
  EXPECT_EQ(with, without + 3);
  EXPECT_EQ(airImages, images + 3);
}

}  // namespace
}  // namespace alpenglow::testing
