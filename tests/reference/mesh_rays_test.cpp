#include "atmosphere/reference/mesh_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "atmosphere/reference/random.h"
#include "test_meshes.h"

namespace alpenglow::reference {
namespace {

using test::box;
using test::icosphere;
using test::kFar;
using test::Mesh;
using test::raysOf;

Vector anyDirection(Random& random) {
  return around(Vector(0, 0, 1), 2.0 * random.uniform() - 1.0, random.uniform());
}

TEST(MeshRays, ABoxIsHitOnItsFaces) {
  for (const Vector& origin : {Vector(0.0), kFar}) {
    const MeshRays rays = raysOf({box({-1, -2, -3}, {1, 2, 3})}, origin);
    EXPECT_EQ(rays.triangleCount(), 12u);
    for (int axis = 0; axis < 3; ++axis) {
      for (double sign : {-1.0, 1.0}) {
        Vector d(0.0), off(0.3);
        d[axis] = sign;
        off[axis] = -10.0 * sign;
        const auto hit = rays.closest(origin + off, d, 0.0, kEndless);
        ASSERT_TRUE(hit) << axis;
        EXPECT_NEAR(hit->t, 10.0 - (axis + 1), 1e-8);
        EXPECT_NEAR(glm::dot(hit->normal, d), -1.0, 1e-12) << "normals look outwards";
        EXPECT_FALSE(rays.closest(origin + off, d, 0.0, 10.0 - (axis + 1) - 1e-6));
        const auto back = rays.closest(origin + off, d, hit->t + 1e-6, kEndless);
        ASSERT_TRUE(back);
        EXPECT_NEAR(back->t, 10.0 + (axis + 1), 1e-8);
        EXPECT_FALSE(rays.blocked(origin + off, d, back->t + 1e-6, kEndless));
        EXPECT_FALSE(rays.blocked(origin + off, -d, 0.0, kEndless));
      }
    }
  }
}

TEST(MeshRays, FlatBoundingBoxesAreHit) {
  // A grid of triangles in the plane z = 0, whose boxes have no height, and rays along its axes.
  Mesh grid;
  constexpr uint32_t kSide = 9;
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    test::addCorner(grid, Vector(i % kSide, i / kSide, 0.0));
  }
  for (uint32_t y = 0; y + 1 < kSide; ++y) {
    for (uint32_t x = 0; x + 1 < kSide; ++x) {
      const uint32_t a = y * kSide + x;
      grid.indices.insert(grid.indices.end(),
                          {a, a + 1, a + kSide, a + 1, a + kSide + 1, a + kSide});
    }
  }
  const MeshRays rays = raysOf({grid});
  // On corners, on edges, on diagonals, and inside.
  for (double x : {0.0, 1.0, 3.5, 4.25, 8.0}) {
    for (double y : {0.0, 2.0, 3.5, 6.125, 8.0}) {
      const auto hit = rays.closest({x, y, 5.0}, {0, 0, -1}, 0.0, kEndless);
      ASSERT_TRUE(hit) << x << " " << y;
      EXPECT_EQ(hit->t, 5.0);
      EXPECT_FALSE(rays.blocked({x, y, 5.0}, {0, 0, -1}, 5.0, kEndless)) << "tmin is left out";
      EXPECT_FALSE(rays.blocked({x, y, 0.0}, {0, 0, 1}, 0.0, kEndless)) << "on the surface";
    }
  }
  EXPECT_FALSE(rays.blocked({-1.0, 3.0, 0.0}, {1, 0, 0}, 0.0, kEndless)) << "in its plane";
  EXPECT_FALSE(rays.blocked({8.0 + 1e-9, 3.0, 1.0}, {0, 0, -1}, 0.0, kEndless));
}

TEST(MeshRays, NoRayLeavesAClosedMesh) {
  // Aimed at its corners and the middles of its edges, where a gap would be.
  const Mesh mesh = icosphere(1000.0, 3);
  const MeshRays rays = raysOf({mesh}, kFar);
  Random random(3, 1);
  const auto corner = [&](size_t i) {
    const double* p = &mesh.positions[3 * mesh.indices[i]];
    return kFar + Vector(p[0], p[1], p[2]);
  };
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vector from = kFar + 700.0 * random.uniform() * anyDirection(random);
    for (const Vector& target :
         {corner(i), 0.5 * (corner(i) + corner(i + 1)),
          corner(i + 1) + random.uniform() * (corner(i + 2) - corner(i + 1))}) {
      const Vector d = glm::normalize(target - from);
      const auto hit = rays.closest(from, d, 0.0, kEndless);
      ASSERT_TRUE(hit) << i;
      EXPECT_NEAR(hit->t, glm::length(target - from), 1e-6);
      EXPECT_TRUE(rays.blocked(from, d, 0.0, kEndless));
    }
  }
}

/// The same by trying all triangles, one mesh each.
TEST(MeshRays, TheTreeAgreesWithBruteForce) {
  Random random(4, 1);
  Mesh soup;
  for (uint32_t i = 0; i < 300; ++i) {
    const Vector center(random.uniform(), random.uniform(), random.uniform());
    for (uint32_t k = 0; k < 3; ++k) {
      test::addCorner(soup, center + 0.3 * random.uniform() * anyDirection(random));
      soup.indices.push_back(3 * i + k);
    }
  }
  const MeshRays rays = raysOf({soup});
  std::vector<MeshRays> each(300);
  for (uint32_t i = 0; i < 300; ++i) {
    each[i].add(Vector(0.0), std::span<const double>(soup.positions),
                std::span<const uint32_t>(soup.indices).subspan(3 * i, 3));
    each[i].build();
  }
  int hits = 0;
  for (int k = 0; k < 500; ++k) {
    const Vector from = Vector(random.uniform(), random.uniform(), random.uniform());
    const Vector d = anyDirection(random);
    double nearest = kEndless;
    uint32_t triangle = 0;
    for (uint32_t i = 0; i < 300; ++i) {
      const auto hit = each[i].closest(from, d, 0.0, nearest);
      if (hit) nearest = hit->t, triangle = i;
    }
    const auto hit = rays.closest(from, d, 0.0, kEndless);
    ASSERT_EQ(hit.has_value(), nearest < kEndless);
    EXPECT_EQ(rays.blocked(from, d, 0.0, kEndless), hit.has_value());
    if (!hit) continue;
    ++hits;
    EXPECT_EQ(hit->t, nearest);
    EXPECT_EQ(hit->triangle, triangle);
    EXPECT_EQ(hit->mesh, 0u);
  }
  EXPECT_GT(hits, 100);
}

TEST(MeshRays, SeveralMeshesKeepTheirNumbersAndFloatsWork) {
  const Mesh near = box({10, -1, -1}, {11, 1, 1}), far = box({20, -5, -5}, {21, 5, 5});
  const std::vector<float> floats(far.positions.begin(), far.positions.end());
  MeshRays rays;
  EXPECT_EQ(rays.add(kFar, std::span<const double>(near.positions), near.indices), 0u);
  EXPECT_EQ(rays.add(kFar, std::span<const float>(floats), far.indices), 1u);
  rays.build();
  const auto first = rays.closest(kFar, {1, 0, 0}, 0.0, kEndless);
  const auto second = rays.closest(kFar + Vector(0, 3, 0), {1, 0, 0}, 0.0, kEndless);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->mesh, 0u);
  EXPECT_EQ(second->mesh, 1u);
  EXPECT_NEAR(second->t, 20.0, 1e-8);
}

TEST(MeshRays, DegenerateTrianglesAreIgnored) {
  Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
  mesh.indices.insert(mesh.indices.end(), {0, 0, 1, 2, 2, 2});
  EXPECT_EQ(raysOf({mesh}).triangleCount(), 12u);
  const MeshRays nothing = raysOf({});
  EXPECT_FALSE(nothing.closest({0, 0, 0}, {1, 0, 0}, 0.0, kEndless));
}

TEST(MeshRays, BadArraysAreRefused) {
  Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
  mesh.indices[4] = 8;
  EXPECT_THROW(raysOf({mesh}), std::invalid_argument);
  mesh.indices[4] = 3;
  mesh.positions[0] = NAN;
  EXPECT_THROW(raysOf({mesh}), std::invalid_argument);
}

TEST(MeshRays, AllTrianglesInOnePlaceMakeATreeToo) {
  Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
  std::vector<Mesh> copies(200, mesh);
  const MeshRays rays = raysOf(copies);
  EXPECT_TRUE(rays.blocked({-5, 0.2, 0.1}, {1, 0, 0}, 0.0, kEndless));
}

TEST(MeshRays, AThirdOfAMillionTrianglesTakeTwoSeconds) {
  const Mesh mesh = icosphere(1000.0, 7);
  ASSERT_GT(mesh.triangles(), 320000u);
  const auto start = std::chrono::steady_clock::now();
  const MeshRays rays = raysOf({mesh});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(seconds.count()));
  EXPECT_LT(seconds.count(), 10.0) << "2 s on an idle core; the machine may be shared";
  EXPECT_NEAR(rays.closest(Vector(0.0), {0, 0.6, 0.8}, 0.0, kEndless)->t, 1000.0, 0.1);
}

}  // namespace
}  // namespace alpenglow::reference
