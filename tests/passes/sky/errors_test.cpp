// What a view refuses, and that it is as it was afterwards.
#include <cmath>
#include <limits>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

FrameState goodDraw() {
  double sun[3];
  sunDirection(0.0, 0.0, radians(20.0), 0.3, sun);
  return makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, 2.0, 0.0, 0.1, 0.0, 1.0), vec(sun),
                  {16, 12});
}

struct BadDraw {
  const char* expected;  ///< Parts of the sentence, separated by '|'.
  std::function<void(FrameState&)> spoil;
};

TEST_F(SkyTest, BadDrawsAreRefusedWithTheValue) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const BadDraw cases[] = {
      {"Camera::position|(0, 0, 0)", [](FrameState& d) { d.camera.position_m[0] = 0.0; }},
      {"Camera::position|nan", [](FrameState& d) { d.camera.position_m[1] = kNan; }},
      {"Camera::position|inf", [](FrameState& d) { d.camera.position_m[2] = kInfinity; }},
      {"Camera::position|1e+20", [](FrameState& d) { d.camera.position_m[2] = 1e20; }},
      {"Camera::forward|unit", [](FrameState& d) { d.camera.forward[0] = 7.0; }},
      {"cameras[0] is absent|Camera::forward|radians",
       [](FrameState& d) { std::fill_n(d.camera.forward, 3, 0.0); }},
      {"Camera::forward|nan", [](FrameState& d) { d.camera.forward[2] = kNan; }},
      {"Camera::up|unit", [](FrameState& d) { d.camera.up[0] = d.camera.up[2] = 0.0; }},
      {"Camera::up|orthogonal",
       [](FrameState& d) { std::copy_n(d.camera.forward, 3, d.camera.up); }},
      {"Camera::fov|-1", [](FrameState& d) { d.camera.fov = -1.0; }},
      {"Camera::fov|3.14159", [](FrameState& d) { d.camera.fov = kPi; }},
      {"Camera::fov|nan", [](FrameState& d) { d.camera.fov = kNan; }},
      {"lights[0] is absent|Light::direction|radians",
       [](FrameState& d) { d.sun.direction[0] = d.sun.direction[1] = d.sun.direction[2] = 0.0; }},
      {"Light::direction|nan", [](FrameState& d) { d.sun.direction[0] = kNan; }},
      {"Light::discRadius|-0.1", [](FrameState& d) { d.sun.discRadius = -0.1; }},
      {"Light::discRadius|2", [](FrameState& d) { d.sun.discRadius = 2.0; }},
      {"FrameDesc::radianceScale|-2", [](FrameState& d) { d.radianceScale = -2.0; }},
      {"FrameDesc::radianceScale|inf", [](FrameState& d) { d.radianceScale = kInfinity; }},
      {"Camera::viewport|0 x 12", [](FrameState& d) { d.viewport.extent.width = 0; }},
      {"Camera::viewport|16 x 0", [](FrameState& d) { d.viewport.extent.height = 0; }},
      {"Camera::viewport|4000000000", [](FrameState& d) { d.viewport.extent.width = 4000000000u; }},
      {"Camera::viewport|(-1, 0)", [](FrameState& d) { d.viewport.offset.x = -1; }},
      {"Camera::viewport|2147483647", [](FrameState& d) { d.viewport.offset.y = 2147483647; }},
  };
  const Picture before = picture(goodDraw());
  TargetDesc desc;
  desc.extent = {16, 12};
  Target target(device(), desc);
  ResourceReport start, end;
  resourceReport(context(), &start);
  const Picture untouched = target.draw([&](VkCommandBuffer commands) {
    for (const BadDraw& bad : cases) {
      FrameState draw = goodDraw();
      bad.spoil(draw);
      message().clear();
      EXPECT_EQ(testing::recordSky(view(), commands, tables(), draw), Status::InvalidArgument)
          << bad.expected;
      EXPECT_TRUE(hasAll(message(), bad.expected)) << bad.expected << ": " << message();
    }
    return true;
  });
  for (const float value : untouched.data) ASSERT_EQ(value, kClear);
  resourceReport(context(), &end);
  EXPECT_EQ(end.draws, start.draws);
  EXPECT_EQ(picture(goodDraw()).data, before.data);
}

TEST_F(SkyTest, BadLightsAreRefusedWithTheValue) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [value, text] : {std::pair{-3.0, "-3"}, {kNan, "nan"}, {1e31, "1e+31"}}) {
    TableDesc desc;
    desc.lights[0].irradiance[1] = value;
    Tables* made = nullptr;
    message().clear();
    EXPECT_EQ(createTables(context(), preset("earth"), desc, &made), Status::InvalidArgument);
    EXPECT_EQ(made, nullptr);
    EXPECT_TRUE(hasAll(message(), std::string("TableDesc::lights[0].irradiance|") + text))
        << message();
  }
  for (const auto& [value, text] : {std::pair{-0.5, "-0.5"}, {1.5, "1.5"}, {kNan, "nan"}}) {
    FrameDesc frame = frameDesc(goodDraw(), tables());
    frame.lights[0].dimming = value;
    message().clear();
    EXPECT_EQ(beginFrame(view(), frame, nullptr), Status::InvalidArgument);
    EXPECT_TRUE(hasAll(message(), std::string("Light::dimming|0 to 1|") + text)) << message();
  }
}

// 0 stands for the default.
TEST_F(SkyTest, AFieldOfViewMayBeLeftOut) {
  for (const Projection projection : {Projection::Perspective, Projection::Fisheye}) {
    FrameState draw = goodDraw();
    draw.camera.fov = projection == Projection::Fisheye ? kPi : kPi / 3.0;
    const Picture given = picture(draw, projection);
    draw.camera.fov = 0.0;
    EXPECT_EQ(picture(draw, projection).data, given.data);
  }
}

TEST_F(SkyTest, FisheyesMayGoAllRound) {
  FrameState draw = goodDraw();
  draw.camera.fov = 2.0 * kPi;
  EXPECT_EQ(badValue(picture(draw, Projection::Fisheye)), "");
  TargetDesc desc;
  desc.extent = {16, 12};
  Target target(device(), desc);
  draw.camera.fov = 6.3;
  target.draw([&](VkCommandBuffer commands) {
    EXPECT_EQ(testing::recordSky(view(Projection::Fisheye), commands, tables(), draw),
              Status::InvalidArgument);
    EXPECT_TRUE(hasAll(message(), "Camera::fov|6.3|2 pi")) << message();
    return true;
  });
}

TEST_F(StandardSkyTest, TablesMustFitTheView) {
  Tables* unbaked = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), smallTables(), &unbaked), Status::Ok);
  Tables* const packed = tables("earth", MieStorage::Packed);
  ContextDesc otherDesc = contextDesc();
  Context* other = nullptr;
  ASSERT_EQ(createContext(otherDesc, &other), Status::Ok);
  Tables* otherTables = nullptr;
  ASSERT_EQ(createTables(other, preset("earth"), smallTables(), &otherTables), Status::Ok);
  View* foreign = nullptr;
  ASSERT_EQ(createView(other, otherTables, viewDesc(), &foreign), Status::Ok);
  View* none = nullptr;
  EXPECT_EQ(createView(other, tables(), viewDesc(), &none), Status::InvalidArgument);
  EXPECT_EQ(none, nullptr);
  EXPECT_TRUE(hasAll(lastDiagnostic(), "another context")) << lastDiagnostic();
  tables();
  TargetDesc desc;
  desc.extent = {16, 12};
  Target target(device(), desc);
  target.draw([&](VkCommandBuffer commands) {
    message().clear();
    EXPECT_EQ(testing::recordSky(view(), commands, unbaked, goodDraw()), Status::NotReady);
    EXPECT_EQ(message(), "");  // It is no error.
    EXPECT_EQ(testing::recordSky(view(), commands, packed, goodDraw()), Status::InvalidArgument);
    EXPECT_TRUE(hasAll(message(), "FrameDesc::tables|MieStorage")) << message();
    EXPECT_EQ(testing::recordSky(foreign, commands, tables(), goodDraw()), Status::InvalidArgument);
    EXPECT_TRUE(hasAll(lastDiagnostic(), "another context")) << lastDiagnostic();
    // Null tables are those of createView, which are not baked here.
    EXPECT_EQ(testing::recordSky(foreign, commands, nullptr, goodDraw()), Status::NotReady);
    EXPECT_EQ(testing::recordSky(nullptr, commands, tables(), goodDraw()), Status::InvalidArgument);
    EXPECT_EQ(testing::recordSky(view(), VK_NULL_HANDLE, tables(), goodDraw()),
              Status::InvalidArgument);
    return true;
  });
  destroyView(foreign);
  destroyTables(otherTables);
  destroyContext(other);
  destroyTables(unbaked);
}

TEST_F(SkyTest, BadViewsAreRefusedWithTheValue) {
  struct BadView {
    Status status;
    const char* expected;
    std::function<void(ViewDesc&)> spoil;
  };
  const BadView cases[] = {
      {Status::Unsupported, "colorFormat|VkFormat 0",
       [](ViewDesc& d) { d.colorFormat = VK_FORMAT_UNDEFINED; }},
      {Status::Unsupported, "colorFormat|VkFormat 131",
       [](ViewDesc& d) { d.colorFormat = VK_FORMAT_BC1_RGB_UNORM_BLOCK; }},
      {Status::Unsupported, "depthFormat|VkFormat 37",
       [](ViewDesc& d) { d.depthFormat = VK_FORMAT_R8G8B8A8_UNORM; }},
      {Status::Unsupported, "viewMask", [](ViewDesc& d) { d.viewMask = 3; }},
      {Status::Unsupported, "samples is 3", [](ViewDesc& d) { d.samples = 3; }},
      {Status::Unsupported, "samples is 64", [](ViewDesc& d) { d.samples = 64; }},
      {Status::InvalidArgument, "projection 9", [](ViewDesc& d) { d.projection = Projection(9); }},
      {Status::InvalidArgument, "depth 5", [](ViewDesc& d) { d.depth = DepthConvention(5); }},
      {Status::InvalidArgument, "sky 2", [](ViewDesc& d) { d.sky = SkyMethod(2); }},
      {Status::InvalidArgument, "aerialPerspective 4",
       [](ViewDesc& d) { d.aerialPerspective = AerialPerspective(4); }},
      {Status::InvalidArgument, "groundAlbedo|no sampler",
       [](ViewDesc& d) {
         d.groundAlbedo.view = reinterpret_cast<VkImageView>(uintptr_t{1});
         d.groundAlbedo.extent.height = 4;
       }},
  };
  tables();  // Before the count: its bake makes pipelines.
  ResourceReport start, end;
  resourceReport(context(), &start);
  for (const BadView& bad : cases) {
    ViewDesc desc;
    desc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
    bad.spoil(desc);
    message().clear();
    View* made = reinterpret_cast<View*>(uintptr_t{1});
    EXPECT_EQ(createView(context(), tables(), desc, &made), bad.status) << bad.expected;
    EXPECT_EQ(made, nullptr);
    EXPECT_TRUE(hasAll(message(), bad.expected)) << bad.expected << ": " << message();
  }
  resourceReport(context(), &end);
  EXPECT_EQ(end.pipelines, start.pipelines);
  View* made = nullptr;
  EXPECT_EQ(createView(nullptr, tables(), ViewDesc{}, &made), Status::InvalidArgument);
  EXPECT_EQ(createView(context(), nullptr, ViewDesc{}, &made), Status::InvalidArgument);
  EXPECT_EQ(createView(context(), tables(), ViewDesc{}, nullptr), Status::InvalidArgument);
  destroyView(nullptr);
}

}  // namespace
}  // namespace alpenglow::testing
