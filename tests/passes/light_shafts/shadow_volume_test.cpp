// Shadow volumes of the paper: closed ones cancel to the last bit, and what is left in front of a
// surface is where its shadow begins.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "tests/passes/light_shafts/shadow_check.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;
using reference::test::Mesh;

class ShadowVolumeTest : public ShadowCheckTest {
 protected:
  static LightShaftSetup paper(bool hostDepth) {
    LightShaftSetup setup;
    setup.method = LightShaftMethod::ShadowVolume;
    setup.fromLut = false;
    setup.hostDepth = hostDepth;
    return setup;
  }
  /// Pixels whose faces don't cancel, without a depth test.
  int uncancelled(const LightShaftPicture& picture) {
    int count = 0;
    for (size_t i = 0; i < picture.sums.size(); i += 2) {
      if (picture.sums[i] == 0.0f) continue;
      if (++count < 4)
        ADD_FAILURE() << "pixel " << i / 2 % kExtent.width << ", " << i / 2 / kExtent.width
                      << " sums to " << picture.sums[i];
    }
    return count;
  }
  /// Faces that lie in a picture at all: nothing cancels where there is nothing.
  int covered(const LightShaftPicture& picture) {
    int count = 0;
    for (size_t i = 1; i < picture.bounds.size(); i += 2) count += picture.bounds[i] > 0.0f ? 1 : 0;
    return count;
  }
};

TEST_F(ShadowVolumeTest, ClosedVolumesCancel) {
  std::vector<ShadowScene> scenes = shadowScenes();
  for (uint32_t seed = 1; seed <= 3; ++seed) scenes.push_back(randomScene(seed));
  for (const ShadowScene& scene : scenes) {
    SCOPED_TRACE(scene.name);
    const LightShaftPicture picture = draw(paper(false), stage(scene));
    EXPECT_EQ(uncancelled(picture), 0);
    EXPECT_GT(covered(picture), 20);
  }
}

/// Of a polygon of up to eight corners, about a random axis.
void addPrism(Mesh& mesh, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto corners = static_cast<uint32_t>(3 + random() % 6);
  const Vector at(1500 + 900 * any(random), 4000 + 1500 * any(random), 1500 * any(random));
  const Vector axis = glm::normalize(Vector(any(random), any(random), any(random) + 2.0));
  const Vector a = glm::normalize(glm::cross(axis, Vector(1, 0.1, 0))), b = glm::cross(axis, a);
  const double radius = 60 + 40 * any(random), half = 60 + 50 * any(random);
  const auto first = static_cast<uint32_t>(mesh.positions.size() / 3);
  for (uint32_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * kPi * i / corners;
    const Vector p = at + radius * (std::cos(angle) * a + std::sin(angle) * b);
    addCorner(mesh, p - half * axis);
    addCorner(mesh, p + half * axis);
  }
  for (uint32_t i = 0; i < corners; ++i) {
    const uint32_t p = first + 2 * i, q = first + 2 * ((i + 1) % corners);
    mesh.indices.insert(mesh.indices.end(), {p, q, q + 1, p, q + 1, p + 1});
    if (i < 2) continue;
    const uint32_t o = p - 2;
    mesh.indices.insert(mesh.indices.end(), {first, p, o, first + 1, o + 1, p + 1});
  }
}

TEST_F(ShadowVolumeTest, SixHundredPrismsCancel) {
  std::mt19937 random(11);
  Mesh prisms;
  for (int i = 0; i < 600; ++i) addPrism(prisms, random);
  for (const auto& [elevation, azimuth] :
       {std::pair(50.0, 160.0), std::pair(10.0, 265.0), std::pair(25.0, 80.0)}) {
    ShadowScene scene = {"prisms", {prisms}, {50, 0, 0}, 90, 15, 70, elevation, azimuth};
    SCOPED_TRACE(azimuth);
    const LightShaftPicture picture = draw(paper(false), stage(scene));
    EXPECT_EQ(uncancelled(picture), 0);
    EXPECT_GT(covered(picture), 300);
  }
}

TEST_F(ShadowVolumeTest, OneConvexCasterGivesTheLengthOfItsShadow) {
  for (const ShadowScene& scene : shadowScenes()) {
    if (scene.casters.size() != 1) continue;
    SCOPED_TRACE(scene.name);
    const FrameState d = stage(scene);
    const LightShaftSetup setup = paper(false);
    const LightShaftPicture picture = draw(setup, d);
    int asked = 0, wrong = 0;
    double worst = 0.0;
    for (uint32_t y = 0; y < kExtent.height; ++y) {
      for (uint32_t x = 0; x < kExtent.width; ++x) {
        const auto [o, v] = pixelRay(setup, d, x, y);
        const Vector position(o[0], o[1], o[2]), view(v[0], v[1], v[2]);
        const Vector sun(d.sun.direction[0], d.sun.direction[1], d.sun.direction[2]);
        // Volumes begin behind the caster, its shadow before: ask beside it.
        if (rays().blocked(position, view, 0.0, reference::kEndless)) continue;
        const auto shadow = reference::shadowIntervals(rays(), position, view, sun, 1e6);
        const double want = lengthOf(shadow);
        const double far_ = shadow.empty() ? 0.0 : shadow.back().to;
        // Rays nearly along the beam leave its side at no one place, in floats.
        if (far_ > 1e5) continue;
        const float* s = &picture.sums[2 * (size_t{y} * kExtent.width + x)];
        const double error = std::abs(s[1] - want);
        asked += want > 0.0 ? 1 : 0;
        worst = std::max(worst, error);
        // The near plane is where a shadow about the camera begins.
        if (error > 0.1 + 0.2 + 2e-4 * far_ && ++wrong < 4)
          ADD_FAILURE() << x << ", " << y << ": " << s[1] << " m, but expected " << want;
      }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(asked, 10);
    std::printf("%-26s %4d rays in shadow, worst error %.3f m\n", scene.name, asked, worst);
  }
}

// Ground in shadow entered at a: dn = -1, dz = -a. Ground in light: dn = 0, dz the shadow's length;
// of a camera in shadow, from the near plane.
TEST_F(ShadowVolumeTest, ShadowsEndAtTheGround) {
  const Mesh ground = reference::test::box(Vector(-40, -6000, -6000), Vector(20, 9000, 6000));
  int allDark = 0, allLit = 0;
  for (ShadowScene scene : shadowScenes()) {
    if (scene.casters.size() != 1 || scene.sunElevation < 10.0) continue;
    SCOPED_TRACE(scene.name);
    if (std::string(scene.name).find("in shadow") == std::string::npos) {
      scene.camera = {900, 0, 0};
      scene.pitch = -20.0;
    }
    scene.casters.push_back(ground);
    const FrameState d = stage(scene);
    const LightShaftSetup setup = paper(true);
    const LightShaftPicture picture = draw(setup, d);
    int dark = 0, lit = 0, wrong = 0;
    for (uint32_t y = 0; y < kExtent.height; ++y) {
      for (uint32_t x = 0; x < kExtent.width; ++x) {
        const ShadowBand b = band(setup, d, x, y, 1.0);
        // Next to the shadow's edge on the ground, and on the caster itself, it is either.
        const bool onGround = b.onMesh && std::abs((b.ray.position + b.length * b.ray.view).x -
                                                   parameters.bottomRadius_m - 20.0) < 0.1;
        if (!onGround || b.atEdge || b.length > 8000.0) continue;
        const std::optional<bool> shadow = surfaceInShadow(b, 2.0);
        if (!shadow) continue;
        const bool inShadow = *shadow;
        const double near_ = startsInShadow(d) ? d.depth.near_m : 0.0;
        const double want = inShadow
                                ? -std::max(b.middle.empty() ? 0.0 : b.middle.back().from, near_)
                                : lengthOf(b.middle) - near_;
        const float* s = &picture.sums[2 * (size_t{y} * kExtent.width + x)];
        (inShadow ? dark : lit) += 1;
        const bool good = s[0] == (inShadow ? -1.0f : 0.0f) &&
                          (lengthOf(b.middle) > 0.0 ? std::abs(s[1] - want) < 0.3 + 2e-4 * b.length
                                                    : s[1] == 0.0f);
        if (!good && ++wrong < 4)
          ADD_FAILURE() << x << ", " << y << ": (" << s[0] << ", " << s[1] << "), but expected "
                        << (inShadow ? -1 : 0) << ", " << want;
      }
    }
    EXPECT_EQ(wrong, 0);
    std::printf("%-26s %4d pixels of ground in shadow, %d in light\n", scene.name, dark, lit);
    allDark += dark;
    allLit += lit;
  }
  EXPECT_GT(allDark, 500);
  EXPECT_GT(allLit, 1000);
}

// A camera just above wide hills, under a low sun: what lies kilometres away is projected onto a
// near plane of centimetres.
TEST_F(ShadowVolumeTest, WideHillsAreCountedCorrectly) {
  for (const double azimuth : {70.0, 160.0, 220.0, 300.0}) {
    SCOPED_TRACE(azimuth);
    const ShadowScene scene = hillScene(azimuth);
    const FrameState d = stage(scene);
    EXPECT_FALSE(startsInShadow(d));
    EXPECT_EQ(uncancelled(draw(paper(false), d)), 0);
    const LightShaftSetup setup = paper(true);
    const LightShaftPicture picture = draw(setup, d);
    int asked = 0, dark = 0, wrong = 0;
    for (uint32_t y = 0; y < kExtent.height; ++y) {
      for (uint32_t x = y % 2; x < kExtent.width; x += 2) {
        const ShadowBand b = band(setup, d, x, y, 5.0);
        if (!b.onMesh || b.atEdge) continue;
        const std::optional<bool> shadow = surfaceInShadow(b, 2.0);
        if (!shadow) continue;
        ++asked;
        dark += *shadow ? 1 : 0;
        const float dn = picture.sums[2 * (size_t{y} * kExtent.width + x)];
        // Hills in each other's shadow lie in several at once.
        if ((dn <= -1.0f) != *shadow && ++wrong < 4)
          ADD_FAILURE() << x << ", " << y << ": dn is " << dn << " where "
                        << (*shadow ? "shadow" : "light") << " is expected";
      }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(asked, 100);
    std::printf("hills, sun at %3.0f degrees: %d pixels, %d dark\n", azimuth, asked, dark);
  }
}

}  // namespace
}  // namespace alpenglow::testing
