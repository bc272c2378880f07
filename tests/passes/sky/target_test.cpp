// What the sky is drawn into: render passes, depth, samples, half floats.
#include <algorithm>
#include <cmath>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

FrameState horizonDraw(const Parameters& parameters, VkExtent2D extent, double elevation = 20.0) {
  double sun[3];
  sunDirection(0.0, 0.0, radians(elevation), 0.3, sun);
  FrameState draw = makeDraw(
      cameraFromGeodetic(parameters, 0.0, 0.0, 2.0, 0.0, radians(3.0), 0.0, 1.0), vec(sun), extent);
  draw.sun.discRadius = radians(2.0);
  return draw;
}

TEST_F(SkyTest, RenderPassesAndDynamicRenderingDrawTheSame) {
  const Parameters earth = preset("earth");
  TargetDesc desc;
  const FrameState draw = horizonDraw(earth, desc.extent);
  const Picture dynamic = picture(draw);
  for (const VkFormat depth : {VK_FORMAT_UNDEFINED, VK_FORMAT_D32_SFLOAT}) {
    desc.depth = depth;
    desc.renderPass = true;
    Target target(device(), desc);
    ViewDesc viewDesc = SkyTest::viewDesc();
    viewDesc.colorFormat = desc.color;
    viewDesc.depthFormat = depth;
    viewDesc.renderPass = target.renderPass();
    View* const made = makeView(viewDesc);
    const Picture drawn = target.draw([&](VkCommandBuffer commands) {
      return testing::recordSky(made, commands, tables(), draw) == Status::Ok;
    });
    EXPECT_EQ(drawn.data, dynamic.data) << message();
  }
}

// A host's nearer object keeps its pixels; everything else, at the far plane, becomes sky.
TEST_F(SkyTest, NearerObjectsKeepTheirPixels) {
  const Parameters earth = preset("earth");
  for (const bool reversed : {false, true}) {
    for (const VkFormat format : {VK_FORMAT_D32_SFLOAT, VK_FORMAT_D16_UNORM}) {
      TargetDesc desc;
      desc.depth = format;
      desc.clearDepth = reversed ? 0.0f : 1.0f;
      const FrameState draw = horizonDraw(earth, desc.extent);
      const Picture plain = picture(draw);
      ViewDesc viewDesc = SkyTest::viewDesc();
      viewDesc.depthFormat = format;
      viewDesc.depth = reversed ? DepthConvention::Reversed : DepthConvention::Standard;
      View* const made = makeView(viewDesc);
      Target target(device(), desc);
      const VkRect2D object = {{10, 6}, {9, 13}};
      const float nearly = reversed ? 1e-4f : 1.0f - 1e-4f;  // Far away, but not at the far plane.
      const Picture drawn = target.draw([&](VkCommandBuffer commands) {
        target.fill(commands, object, 3.0f, nearly);
        return testing::recordSky(made, commands, tables(), draw) == Status::Ok;
      });
      for (uint32_t y = 0; y < drawn.height; ++y) {
        for (uint32_t x = 0; x < drawn.width; ++x) {
          const bool covered = x >= 10 && x < 19 && y >= 6 && y < 19;
          for (int c = 0; c < 4; ++c) {
            EXPECT_EQ(drawn.at(x, y)[c], covered ? 3.0f : plain.at(x, y)[c])
                << x << " " << y << " reversed " << reversed;
          }
        }
      }
    }
  }
}

TEST_F(SkyTest, MultisampledTargetsHoldTheSamePicture) {
  const Parameters earth = preset("earth");
  TargetDesc desc;
  desc.samples = VK_SAMPLE_COUNT_4_BIT;
  for (const VkFormat depth : {VK_FORMAT_UNDEFINED, VK_FORMAT_D32_SFLOAT}) {
    desc.depth = depth;
    const FrameState draw = horizonDraw(earth, desc.extent);
    const Picture plain = picture(draw);
    ViewDesc viewDesc = SkyTest::viewDesc();
    viewDesc.samples = desc.samples;
    viewDesc.depthFormat = depth;
    const Picture drawn = picture(makeView(viewDesc), tables(), draw, desc);
    // The rasterizer interpolates the last bits differently.
    for (size_t i = 0; i < plain.data.size(); ++i)
      EXPECT_NEAR(drawn.data[i], plain.data[i], 3e-5f * plain.data[i]) << i;
  }
}

// In nautical twilight radiance falls below what a half float can hold with digits; with the scale
// it doesn't.
TEST_F(SkyTest, RadianceScaleSavesNightInHalfFloats) {
  const Parameters earth = preset("earth");
  FrameState draw = horizonDraw(earth, {48, 32}, -11.0);
  draw.sun.discRadius = 0.0;
  const Picture floats = picture(draw);
  ViewDesc viewDesc = SkyTest::viewDesc();
  viewDesc.colorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
  View* const halves = makeView(viewDesc);
  TargetDesc desc;
  desc.color = viewDesc.colorFormat;
  const auto worst = [&](double scale) {
    draw.radianceScale = scale;
    const Picture drawn = picture(halves, tables(), draw, desc);
    double largest = 0.0;
    for (size_t i = 0; i < floats.data.size(); ++i) {
      const double wanted = static_cast<double>(floats.data[i]);
      if (i % 4 == 3 || wanted < 1e-9) continue;
      const double got = static_cast<double>(drawn.data[i]) / (scale == 0.0 ? 1.0 : scale);
      largest = std::max(largest, std::abs(got - wanted) / wanted);
    }
    return largest;
  };
  EXPECT_GT(worst(0.0), 0.02);  // Else this test shows nothing.
  EXPECT_LT(worst(1048576.0), 1.1e-3);
}

}  // namespace
}  // namespace alpenglow::testing
