#include "atmosphere/reference/shadow_intervals.h"

#include <gtest/gtest.h>

#include "atmosphere/reference/random.h"
#include "test_meshes.h"

namespace alpenglow::reference {
namespace {

using test::box;
using test::icosphere;
using test::kFar;
using test::Mesh;
using test::raysOf;

const Vector kX(1, 0, 0), kZ(0, 0, 1);

void expectIntervals(const std::vector<RayInterval>& actual,
                     const std::vector<RayInterval>& expected, double within) {
  ASSERT_EQ(actual.size(), expected.size());
  for (size_t i = 0; i < actual.size(); ++i) {
    EXPECT_NEAR(actual[i].from, expected[i].from, within) << i;
    EXPECT_NEAR(actual[i].to, expected[i].to, within) << i;
  }
}

TEST(ShadowIntervals, ABoxAbove) {
  for (const Vector& o : {Vector(0.0), kFar}) {
    const MeshRays rays = raysOf({box({10, -3, 5}, {14, 3, 7})}, o);
    expectIntervals(shadowIntervals(rays, o, kX, kZ, 100.0), {{10, 14}}, 1e-8);
    expectIntervals(shadowIntervals(rays, o, kX, kZ, 12.0), {{10, 12}}, 1e-8);
    expectIntervals(shadowIntervals(rays, o, kX, kZ, 9.0), {}, 0.0);
    expectIntervals(shadowIntervals(rays, o + 12.0 * kX, kX, kZ, 9.0), {{0, 2}}, 1e-8);
    expectIntervals(shadowIntervals(rays, o, kX, -kZ, 100.0), {}, 0.0);
    expectIntervals(shadowIntervals(rays, o + Vector(0, 4, 0), kX, kZ, 100.0), {}, 0.0);
    // Out of the box upwards: the part inside is in its shadow.
    expectIntervals(shadowIntervals(rays, o + 6.0 * kZ, kX, kZ, 100.0), {{10, 14}}, 1e-8);
    // A slanting sun at 45 degrees: from under the far lower edge to under the near upper one.
    const Vector slant = glm::normalize(Vector(1, 0, 1));
    expectIntervals(shadowIntervals(rays, o, kX, slant, 100.0), {{10 - 7, 14 - 5}}, 1e-8);
  }
}

TEST(ShadowIntervals, ARayInsideTheShadowIsDarkAllTheWay) {
  const MeshRays rays = raysOf({box({-1e4, -1e4, 1e3}, {1e4, 1e4, 2e3})}, kFar);
  const Vector view = glm::normalize(Vector(0.3, -0.5, 0.01));
  expectIntervals(shadowIntervals(rays, kFar, view, glm::normalize(Vector(0.1, 0.2, 1)), 500.0),
                  {{0, 500}}, 1e-8);
}

TEST(ShadowIntervals, ASphere) {
  // Of an icosphere the silhouette lies within its sag of the circle: 1 - cos of half an edge.
  const double radius = 1000.0;
  const MeshRays rays = raysOf({icosphere(radius, 6)}, kFar);
  Random random(1, 9);
  for (int k = 0; k < 200; ++k) {
    const Vector sun = around(kZ, 2 * random.uniform() - 1, random.uniform());
    const Vector view = around(sun, 1.8 * random.uniform() - 0.9, random.uniform());
    const Vector across = glm::normalize(glm::cross(view, sun));
    const double off = 0.9 * radius * random.uniform();
    // Three radii behind the centre, 5 km along the ray.
    const double middle = 5000.0;
    const Vector from = off * across - 3.0 * radius * sun - middle * view;
    const double sine = glm::length(glm::cross(view, sun));
    const double half = std::sqrt(radius * radius - off * off) / sine;
    const auto found = shadowIntervals(rays, kFar + from, view, sun, 20000.0);
    const double low = std::max(middle - half, 0.0), high = std::min(middle + half, 20000.0);
    const double sag = radius * 1.5e-4;
    expectIntervals(found, {{low, high}}, 2.0 * sag * radius / (half * sine) / sine + 1e-6);
  }
}

TEST(ShadowIntervals, ACombOfSlats) {
  std::vector<Mesh> slats;
  std::vector<RayInterval> expected;
  for (int i = 0; i < 40; ++i) {
    const double x = 10.0 * i + 3.0, width = 0.1 * (i + 1);
    slats.push_back(box({x, -1, 50}, {x + width, 1, 50.5 + i}));
    // The sun stands 60 degrees high ahead: shadows fall back by the height over tan 60.
    const double slope = 1.0 / std::sqrt(3.0);
    expected.push_back({x - (50.5 + i) * slope, x + width - 50.0 * slope});
  }
  std::vector<RayInterval> seen;
  for (const RayInterval& e : expected) {
    if (e.to <= 0.0) continue;
    const double from = std::max(e.from, 0.0);
    if (!seen.empty() && from <= seen.back().to) {
      seen.back().to = std::max(seen.back().to, e.to);
    } else {
      seen.push_back({from, e.to});
    }
  }
  EXPECT_GT(seen.size(), 10u);
  const Vector sun = glm::normalize(Vector(0.5, 0, 0.5 * std::sqrt(3.0)));
  expectIntervals(shadowIntervals(raysOf(slats, kFar), kFar, kX, sun, 1000.0), seen, 1e-7);
}

TEST(ShadowIntervals, NestedBoxesMakeOneShadow) {
  // Boxes within a box add nothing, boxes that reach out widen it, and touching ones join.
  const MeshRays rays =
      raysOf({box({10, -9, 5}, {30, 9, 25}), box({12, -3, 7}, {20, 3, 9}),
              box({25, -3, 7}, {34, 3, 9}), box({34, -3, 40}, {36, 3, 41}),
              box({36.00005, -3, 40}, {37, 3, 41}), box({37.01, -3, 40}, {38, 3, 41})},
             kFar);
  expectIntervals(shadowIntervals(rays, kFar, kX, kZ, 100.0), {{10, 37}, {37.01, 38}}, 1e-8);
  expectIntervals(shadowIntervals(rays, kFar, kX, kZ, 100.0, {0.1, 0.0}), {{10, 38}}, 1e-8);
  expectIntervals(shadowIntervals(rays, kFar, kX, kZ, 100.0, {1e-6, 0.0}),
                  {{10, 36}, {36.00005, 37}, {37.01, 38}}, 1e-8);
}

TEST(ShadowIntervals, AlongTheBeam) {
  const MeshRays rays = raysOf({box({10, -3, -3}, {14, 3, 3})}, kFar);
  for (const Vector& turn : {Vector(0.0), Vector(0, 0, 1e-10)}) {
    const Vector v = glm::normalize(kX + turn);
    expectIntervals(shadowIntervals(rays, kFar, v, kX, 100.0), {{0, 14}}, 1e-7);
    expectIntervals(shadowIntervals(rays, kFar, v, kX, 5.0), {{0, 5}}, 1e-7);
    expectIntervals(shadowIntervals(rays, kFar, v, -kX, 100.0), {{10, 100}}, 1e-7);
    expectIntervals(shadowIntervals(rays, kFar, v, -kX, 9.0), {}, 0.0);
    expectIntervals(shadowIntervals(rays, kFar, -v, kX, 9.0), {{0, 9}}, 1e-7);
    expectIntervals(shadowIntervals(rays, kFar, -v, -kX, 9.0), {}, 0.0);
  }
  expectIntervals(shadowIntervals(rays, kFar + 4.0 * kZ, kX, kX, 100.0), {}, 0.0);
  // Almost along it: a shadow of 6 m across, seen at 1e-6, has no end in sight.
  const Vector almost = glm::normalize(kX + 1e-6 * kZ);
  expectIntervals(shadowIntervals(rays, kFar, almost, kX, 100.0), {{0, 14}}, 1e-2);
}

/// Spiky closed meshes around each other, which rays pass through, over and under.
std::vector<Mesh> spikes(Random& random) {
  std::vector<Mesh> meshes;
  for (int k = 0; k < 6; ++k) {
    Mesh mesh = icosphere(1.0, 2);
    const Vector center(4e3 * random.uniform(), 4e3 * random.uniform(), 4e3 * random.uniform());
    for (size_t i = 0; i < mesh.positions.size(); i += 3) {
      const double size = 200.0 + 900.0 * random.uniform();
      for (size_t c = 0; c < 3; ++c) {
        mesh.positions[i + c] =
            center[static_cast<glm::length_t>(c)] + size * mesh.positions[i + c];
      }
    }
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

TEST(ShadowIntervals, RandomMeshesAgreeWithAnyHitSampling) {
  constexpr int kSamples = 10000;
  Random random(2, 5);
  size_t intervals = 0, dark = 0;
  for (int scene = 0; scene < 12; ++scene) {
    const MeshRays rays = raysOf(spikes(random), kFar);
    for (int k = 0; k < 6; ++k) {
      const Vector from = kFar + 4e3 * Vector(random.uniform(), random.uniform(), random.uniform());
      const Vector view = around(kZ, 2 * random.uniform() - 1, random.uniform());
      const Vector sun = around(kZ, 2 * random.uniform() - 1, random.uniform());
      const double length = 6e3;
      const auto shadow = shadowIntervals(rays, from, view, sun, length);
      intervals += shadow.size();
      for (size_t i = 0; i < shadow.size(); ++i) {
        EXPECT_LT(shadow[i].from, shadow[i].to);
        EXPECT_GE(shadow[i].from, 0.0);
        EXPECT_LE(shadow[i].to, length);
        EXPECT_TRUE(i == 0 || shadow[i].from > shadow[i - 1].to);
      }
      for (int i = 0; i < kSamples; ++i) {
        const double t = length * (i + 0.5) / kSamples;
        double edge = kEndless;
        bool inside = false;
        for (const RayInterval& s : shadow) {
          edge = std::min({edge, std::abs(t - s.from), std::abs(t - s.to)});
          inside = inside || (t >= s.from && t <= s.to);
        }
        if (edge < 0.02) continue;  // The tolerance of joined shadows, with room.
        ASSERT_EQ(inside, rays.blocked(from + t * view, sun, 0.0, kEndless))
            << scene << " " << k << " at " << t << ", " << edge << " m from an edge";
        dark += inside;
      }
    }
  }
  EXPECT_GT(intervals, 50u);
  EXPECT_GT(dark, size_t{72} * kSamples / 10);
}

}  // namespace
}  // namespace alpenglow::reference
