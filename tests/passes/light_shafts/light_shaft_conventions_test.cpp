// The same rays give the same light, whatever depth means: each method with each convention, range,
// projection and format.
#include <cmath>
#include <cstdio>

#include "atmosphere/api/context_impl.h"
#include "tests/passes/light_shafts/shadow_check.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;

constexpr LightShaftMethod kMethods[] = {
    LightShaftMethod::LightVolume, LightShaftMethod::ShadowVolume, LightShaftMethod::RayMarch};
const char* nameOf(LightShaftMethod method) {
  return method == LightShaftMethod::LightVolume    ? "exact"
         : method == LightShaftMethod::ShadowVolume ? "paper"
                                                    : "march";
}

class LightShaftConventionsTest : public ShadowCheckTest {
 protected:
  /// One caster and a lit wall behind it.
  static ShadowScene scene() {
    return {"box and wall",
            {reference::test::box(Vector(600, 1500, -200), Vector(900, 1800, 200)),
             reference::test::box(Vector(-20, 3000, -900), Vector(500, 3300, 900))},
            {300, 0, 0},
            90,
            5,
            60,
            35,
            200};
  }
  /// Greatest difference of two pictures, relative to the light there, but for pixels whose rays
  /// pass an edge.
  double difference(const LightShaftSetup& setup, const FrameState& d, const LightShaftPicture& a,
                    const LightShaftPicture& b) {
    double worst = 0.0;
    for (uint32_t y = 0; y < kExtent.height; ++y) {
      for (uint32_t x = 0; x < kExtent.width; ++x) {
        if (band(setup, d, x, y, 1.0).atEdge) continue;
        const float *p = a.light.at(x, y), *q = b.light.at(x, y);
        for (int i = 0; i < 3; ++i)
          worst = std::max(worst, std::abs(double(p[i]) - q[i]) / std::max<double>(p[i], 1e-6));
      }
    }
    return worst;
  }
  /// Total light that light shafts remove from a picture.
  double shade(LightShaftSetup setup, const FrameState& d, const LightShaftPicture& picture) {
    setup.shafts = false;
    const LightShaftPicture unshadowed = draw(setup, d);
    double sum = 0.0;
    for (size_t i = 1; i < unshadowed.light.data.size(); i += 4)
      sum += double(unshadowed.light.data[i]) - picture.light.data[i];
    return sum;
  }
};

TEST_F(LightShaftConventionsTest, PerspectiveDepthChangesNothing) {
  FrameState d = stage(scene());
  d.depth.near_m = 10.0;
  for (const LightShaftMethod method : kMethods) {
    SCOPED_TRACE(nameOf(method));
    LightShaftSetup setup;
    setup.method = method;
    const LightShaftPicture base = draw(setup, d);
    EXPECT_GT(shade(setup, d, base), 0.0);
    double worst = 0.0;
    for (const DepthConvention depth : {DepthConvention::Standard, DepthConvention::Reversed}) {
      // Beyond everything, and so near that shadows in the sky lie behind it.
      for (const double far_ : {0.0, 1e5, 3600.0}) {
        setup.depth = depth;
        FrameState other = d;
        other.depth.far_m = far_;
        const LightShaftPicture picture = draw(setup, other);
        const double error = difference(setup, d, base, picture);
        EXPECT_LT(error, 1e-3) << "depth " << static_cast<int>(depth) << " far " << far_;
        worst = std::max(worst, error);
      }
    }
    std::printf("%s, perspective: %.2g relative between depth conventions\n", nameOf(method),
                worst);
  }
}

TEST_F(LightShaftConventionsTest, OrthographicDepthChangesNothing) {
  FrameState d = stage(scene());
  d.camera.height_m = 2000.0;
  d.depth = {10.0, 1e5};
  for (const LightShaftMethod method : kMethods) {
    SCOPED_TRACE(nameOf(method));
    LightShaftSetup setup;
    setup.method = method;
    setup.projection = Projection::Orthographic;
    const LightShaftPicture base = draw(setup, d);
    EXPECT_GT(shade(setup, d, base), 0.0);
    EXPECT_EQ(badValue(base.light), "");
    double worst = 0.0;
    for (const DepthConvention depth : {DepthConvention::Standard, DepthConvention::Reversed}) {
      for (const DepthRange range : {DepthRange{10.0, 1e5}, DepthRange{10.0, 3800.0}}) {
        setup.depth = depth;
        FrameState other = d;
        other.depth = range;
        const double error = difference(setup, d, base, draw(setup, other));
        EXPECT_LT(error, 1e-3) << "depth " << static_cast<int>(depth) << " far " << range.far_m;
        worst = std::max(worst, error);
      }
    }
    std::printf("%s, orthographic: %.2g relative between depth conventions\n", nameOf(method),
                worst);
  }
}

TEST_F(LightShaftConventionsTest, DepthWithStencilIsReadToo) {
  FrameState d = stage(scene());
  d.depth.near_m = 10.0;
  int formats = 0;
  for (const VkFormat format : {VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_D32_SFLOAT_S8_UINT}) {
    constexpr VkFormatFeatureFlags kNeeded =
        VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    const VkFormatFeatureFlags features =
        context()->device->formatProperties(format).optimalTilingFeatures;
    if ((features & kNeeded) != kNeeded) continue;
    ++formats;
    for (const LightShaftMethod method : kMethods) {
      if (formats > 1 && method != LightShaftMethod::LightVolume)
        continue;  // each compiles for seconds
      LightShaftSetup setup;
      setup.method = method;
      // Fixed point resolves what is near: let that be where depth is.
      setup.depth = DepthConvention::Standard;
      const LightShaftPicture base = draw(setup, d);
      setup.depthFormat = format;
      EXPECT_LT(difference(setup, d, base, draw(setup, d)), 2e-3)
          << nameOf(method) << " with VkFormat " << format;
    }
  }
  EXPECT_GT(formats, 0);
}

// LightVolume against the reference with parallel rays, half of which begin in shadow.
TEST_F(LightShaftConventionsTest, OrthographicLengthsAreThoseOfTheReference) {
  useThinMedium();
  FrameState d = stage({"box above",
                        {reference::test::box(Vector(900, -400, -400), Vector(1000, 1200, 300))},
                        {500, 0, 0},
                        90,
                        0,
                        60,
                        75,
                        200});
  d.camera.height_m = 900.0;
  d.depth = {0.5, 1e5};
  LightShaftSetup setup;
  setup.projection = Projection::Orthographic;
  LightShaftPicture with, unshadowed;
  const std::vector<double> loss = losses(setup, d, &with, &unshadowed);
  int shadowed = 0, wrong = 0;
  for (uint32_t y = 0; y < kExtent.height; ++y) {
    for (uint32_t x = y % 2; x < kExtent.width; x += 2) {
      const ShadowBand b = band(setup, d, x, y, 1.5 * texel(setup, d));
      if (b.atEdge) continue;
      const double nu = glm::dot(b.ray.view, b.ray.sun);
      const double got =
          loss[size_t{y} * kExtent.width + x] / (1e-9 * 3.0 / (16.0 * kPi) * (1.0 + nu * nu));
      const double slack = 1.0 + 2e-6 * b.length + 2e-3 * lengthOf(b.most);
      shadowed += b.middle.empty() ? 0 : 1;
      if ((got < lengthOf(b.least) - slack || got > lengthOf(b.most) + slack) && ++wrong < 5)
        ADD_FAILURE() << x << ", " << y << ": " << got << " m, but expected " << lengthOf(b.least)
                      << " to " << lengthOf(b.most);
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(shadowed, 100);
}

}  // namespace
}  // namespace alpenglow::testing
