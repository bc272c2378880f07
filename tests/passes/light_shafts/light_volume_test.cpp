// LightVolume against exact shadow intervals in double: lengths, and light.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "atmosphere/parameters/physics_cpp.h"
#include "tests/passes/light_shafts/shadow_check.h"

namespace alpenglow::testing {
namespace {

/// Texels that an edge of a shadow may be off: one of the map's cells, and what the light-volume
/// mesh hides under the lit surface.
constexpr double kTexels = 1.5;

class LightVolumeTest : public ShadowCheckTest {
 protected:
  /// Shadows entered minus shadows left, to where each pixel's ray ends: 0 in light, 1 in shadow.
  void expectCounts(const char* name, const FrameState& d, const LightShaftPicture& picture) {
    const float start = startsInShadow(d) ? 1.0f : 0.0f;
    int bad = 0;
    for (size_t i = 3; i < picture.sums.size(); i += 4) {
      const float count = picture.sums[i] + start;
      if (count == 0.0f || count == 1.0f) continue;
      if (++bad < 5)
        ADD_FAILURE() << name << ": pixel " << i / 4 % kExtent.width << ", "
                      << i / 4 / kExtent.width << " lies in " << count << " shadows";
    }
    EXPECT_EQ(bad, 0) << name;
  }
  void expectLengths(const ShadowScene& scene);
  void expectRadiance(const ShadowScene& scene, bool fromLut);
};

void LightVolumeTest::expectLengths(const ShadowScene& scene) {
  SCOPED_TRACE(scene.name);
  useThinMedium();
  const FrameState d = stage(scene);
  LightShaftSetup setup;
  setup.fromLut = false;
  setup.shadowMapSize = 256;
  LightShaftPicture with, unshadowed;
  const std::vector<double> loss = losses(setup, d, &with, &unshadowed);
  EXPECT_EQ(badValue(with.light), "");
  expectCounts(scene.name, d, with);
  const double texel_m = texel(setup, d);
  int asked = 0, shadowed = 0, wrong = 0;
  double worst = 0.0, sum = 0.0, whole = 0.0;
  for (uint32_t y = 0; y < kExtent.height; y += 2) {
    for (uint32_t x = y / 2 % 2; x < kExtent.width; x += 2) {
      const ShadowBand b = band(setup, d, x, y, kTexels * texel_m);
      if (b.atEdge) continue;
      const double nu = glm::dot(b.ray.view, b.ray.sun);
      const double lightOfMetre = 1e-9 * 3.0 / (16.0 * kPi) * (1.0 + nu * nu) * d.sun.irradiance[1];
      const double got = loss[size_t{y} * kExtent.width + x] / lightOfMetre;
      const double want = lengthOf(b.middle);
      // Floats of the whole ray's light, whose density falls by a thousandth on the way up.
      const double rounding = 1.0 + 1e-6 * b.length + 2e-3 * lengthOf(b.most);
      const double excess = std::max(lengthOf(b.least) - got, got - lengthOf(b.most));
      ++asked;
      shadowed += want > 0.0 ? 1 : 0;
      sum += std::abs(got - want);
      whole += want;
      worst = std::max(worst, excess);
      if (excess <= rounding) continue;
      if (++wrong < 6)
        ADD_FAILURE() << "pixel " << x << ", " << y << ": " << got << " m of shadow of " << b.length
                      << " m, but expected " << lengthOf(b.least) << " to " << lengthOf(b.most)
                      << " (" << want << ")";
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(shadowed, 6);
  std::printf(
      "%-26s %4d of %4d pixels shadowed, texel %.2f m, mean error %.3f %%, worst beyond "
      "the band %.2f m, wrong %d\n",
      scene.name, shadowed, asked, texel_m, 100.0 * sum / whole, worst, wrong);
}

TEST_F(LightVolumeTest, ShadowsAreAsLongAsTheReferenceSays) {
  for (const ShadowScene& scene : shadowScenes()) expectLengths(scene);
}

TEST_F(LightVolumeTest, ShadowsOfRandomMeshesAreAsLongAsTheReferenceSays) {
  for (uint32_t seed = 1; seed <= 4; ++seed) expectLengths(randomScene(seed));
}

void LightVolumeTest::expectRadiance(const ShadowScene& scene, bool fromLut) {
  SCOPED_TRACE(scene.name);
  const FrameState d = stage(scene);
  LightShaftSetup setup;
  setup.fromLut = fromLut;
  setup.shadowMapSize = 256;
  LightShaftPicture with, unshadowed;
  const std::vector<double> loss = losses(setup, d, &with, &unshadowed);
  EXPECT_EQ(badValue(with.light), "");
  expectCounts(scene.name, d, with);
  const auto medium = makeMediumF64(parameters);
  const double texel_m = texel(setup, d);
  int asked = 0, wrong = 0;
  double worst = 0.0, worstOfMiddle = 0.0;
  for (uint32_t y = 1; y < kExtent.height; y += 4) {
    for (uint32_t x = 1; x < kExtent.width; x += 4) {
      const ShadowBand b = band(setup, d, x, y, kTexels * texel_m);
      const double total = unshadowed.light.at(x, y)[1];
      const double got = loss[size_t{y} * kExtent.width + x];
      if (b.atEdge || b.most.empty()) {
        EXPECT_TRUE(b.atEdge || std::abs(got) < 1e-3 * total) << x << ", " << y << ": " << got;
        continue;
      }
      const auto lightOf = [&](const std::vector<reference::RayInterval>& shadow) {
        return reference::litScattering(medium, b.ray, b.length, shadow, 1e-5).value[1];
      };
      const double whole = lightOf({});
      const double least = whole - lightOf(b.least), most = whole - lightOf(b.most);
      const double excess = std::max(least - got, got - most) / total;
      ++asked;
      worst = std::max(worst, excess);
      worstOfMiddle = std::max(worstOfMiddle, std::abs(got - (whole - lightOf(b.middle))) / total);
      if (excess <= 0.005) continue;
      if (++wrong < 6)
        ADD_FAILURE() << "pixel " << x << ", " << y << ": shadows keep " << got << " of " << total
                      << ", but expected " << least << " to " << most;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(asked, 0);
  std::printf("%-26s %s %3d pixels, error %.3f %% of the light, %.3f %% beyond the band\n",
              scene.name, fromLut ? "volume  " : "integral", asked, 100.0 * worstOfMiddle,
              100.0 * std::max(worst, 0.0));
}

TEST_F(LightVolumeTest, LightIsThatOfTheReference) {
  for (const ShadowScene& scene : shadowScenes()) expectRadiance(scene, true);
  expectRadiance(randomScene(7), true);
}

TEST_F(LightVolumeTest, IntegratedLightIsThatOfTheReference) {
  const std::vector<ShadowScene> scenes = shadowScenes();
  for (size_t i = 0; i < scenes.size(); i += 4) expectRadiance(scenes[i], false);
}

}  // namespace
}  // namespace alpenglow::testing
