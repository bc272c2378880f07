#include <alpenglow/mesh/terrain.h>
#include <alpenglow/view.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/passes/light_shafts/refusal.h"

namespace alpenglow::testing {
namespace {

using glm::dvec3;

constexpr double kRadius_m = 6.36e6;
constexpr double kPi = std::numbers::pi;

/// A height field with what it is described by; `desc` points into it.
struct Patch {
  std::vector<float> heights;
  TerrainDesc desc;

  Patch(uint32_t width, uint32_t height, double spacing_m, float (*shape)(uint32_t, uint32_t)) {
    for (uint32_t row = 0; row < height; ++row) {
      for (uint32_t column = 0; column < width; ++column) heights.push_back(shape(column, row));
    }
    desc.field = {heights.data(), width, height, {spacing_m, spacing_m}};
    desc.radius_m = kRadius_m;
    desc.latitude = 0.6;
    desc.longitude = -1.4;
    desc.heading = 0.3;
  }
  Patch(Patch&&) = default;
};

float flat(uint32_t, uint32_t) { return 0.0f; }
float hills(uint32_t column, uint32_t row) {
  const float x = static_cast<float>(column), y = static_cast<float>(row);
  return 400.0f + 300.0f * std::sin(0.7f * x) * std::cos(0.45f * y) + 90.0f * std::sin(2.0f * y);
}

struct Terrain {
  std::vector<TerrainVertex> vertices;
  std::vector<uint32_t> indices;
  TerrainPlace place;
  uint32_t width = 0, height = 0;

  /// In the planet's frame.
  dvec3 position(size_t i) const {
    const float* p = vertices[i].position;
    return origin() + dvec3(p[0], p[1], p[2]);
  }
  dvec3 normal(size_t i) const {
    const float* n = vertices[i].normal;
    return {n[0], n[1], n[2]};
  }
  dvec3 origin() const { return {place.origin_m[0], place.origin_m[1], place.origin_m[2]}; }
  dvec3 up() const { return glm::normalize(origin()); }
  double altitude(size_t i) const { return glm::length(position(i)) - glm::length(origin()); }
  size_t points() const { return size_t{width} * height; }
  size_t at(uint32_t column, uint32_t row) const { return size_t{row} * width + column; }
};

Terrain built(const TerrainDesc& desc) {
  Terrain terrain;
  terrain.width = desc.field.width;
  terrain.height = desc.field.height;
  Refusal refusal;
  TerrainSize size;
  EXPECT_EQ(terrainSize(desc, &size, {&Refusal::take, &refusal}), Status::Ok) << refusal.sentence;
  terrain.vertices.resize(size.vertexCount);
  terrain.indices.assign(size.indexCount, UINT32_MAX);
  EXPECT_EQ(buildTerrain(desc, terrain.vertices.data(), terrain.indices.data(), &terrain.place,
                         {&Refusal::take, &refusal}),
            Status::Ok)
      << refusal.sentence;
  return terrain;
}

AdjacencyReport reportOf(const Terrain& terrain) {
  MeshView view;
  view.positions = terrain.vertices[0].position;
  view.positionStride = sizeof(TerrainVertex);
  view.vertexCount = static_cast<uint32_t>(terrain.vertices.size());
  view.indices = terrain.indices.data();
  view.indexCount = static_cast<uint32_t>(terrain.indices.size());
  std::vector<uint32_t> adjacency(terrain.indices.size() * 2);
  AdjacencyReport report;
  EXPECT_EQ(buildAdjacency(view, adjacency.data(), &report, {}), Status::Ok);
  return report;
}

void expectClosed(const Terrain& terrain) {
  const AdjacencyReport report = reportOf(terrain);
  EXPECT_EQ(report.borderEdges, 0u);
  EXPECT_EQ(report.nonManifoldEdges, 0u);
  EXPECT_EQ(report.inconsistentEdges, 0u);
  EXPECT_EQ(report.degenerateTriangles, 0u);
  const size_t border = 2 * size_t{terrain.width - 1} + 2 * size_t{terrain.height - 1};
  EXPECT_EQ(report.duplicateVertices, border) << "The skirt's upper vertices, and no other.";
}

/// Signed: above 0 when the triangles are counter-clockwise seen from outside.
double volumeOf(const Terrain& terrain) {
  double volume = 0.0;
  for (size_t i = 0; i < terrain.indices.size(); i += 3) {
    const dvec3 a = terrain.position(terrain.indices[i]) - terrain.origin();
    const dvec3 b = terrain.position(terrain.indices[i + 1]) - terrain.origin();
    const dvec3 c = terrain.position(terrain.indices[i + 2]) - terrain.origin();
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return volume;
}

TEST(TerrainMesh, IsClosedAtAnySizeAndPlace) {
  for (const auto& [width, height] :
       {std::pair(2u, 2u), {2u, 9u}, {9u, 2u}, {3u, 3u}, {40u, 17u}, {131u, 200u}}) {
    Patch patch(width, height, 90.0, hills);
    expectClosed(built(patch.desc));
    patch.desc.fade_m = 500.0;
    expectClosed(built(patch.desc));
    patch.desc.latitude = kPi / 2.0;
    expectClosed(built(patch.desc));
    patch.desc.latitude = -kPi / 2.0;
    patch.desc.radius_m = 30e3;
    expectClosed(built(patch.desc));
  }
}

TEST(TerrainMesh, EnclosesAVolumeAboveItsBottom) {
  Patch patch(30, 20, 100.0, flat);
  const double area = 2900.0 * 1900.0;
  // A flat slab of 50 m, but that the bottom is a fan of chords: the ground bends by 0.24 m there.
  EXPECT_NEAR(volumeOf(built(patch.desc)), area * 50.0, area * 0.3);
  patch.desc.skirtDepth_m = 200.0;
  EXPECT_NEAR(volumeOf(built(patch.desc)), area * 200.0, area * 0.3);
}

TEST(TerrainMesh, TrianglesAndNormalsLookOutwards) {
  Patch patch(40, 30, 90.0, hills);
  patch.desc.heightScale = 0.2;  // A facet of a sharp ridge may turn away from a smooth normal.
  const Terrain terrain = built(patch.desc);
  const size_t cells = size_t{39} * 29 * 6;
  for (size_t i = 0; i < terrain.indices.size(); i += 3) {
    const uint32_t* index = terrain.indices.data() + i;
    const dvec3 a = terrain.position(index[0]);
    const dvec3 face = glm::cross(terrain.position(index[1]) - a, terrain.position(index[2]) - a);
    ASSERT_GT(glm::length(face), 0.0);
    if (i < cells) {
      ASSERT_GT(glm::dot(face, terrain.up()), 0.0);
    }
    if (i < cells || terrain.vertices[index[0]].uv[0] != 0.5f) {
      ASSERT_GT(glm::dot(face, terrain.normal(index[0])), 0.0) << i;
    }
  }
  for (size_t i = 0; i < terrain.vertices.size(); ++i) {
    ASSERT_NEAR(glm::length(terrain.normal(i)), 1.0, 1e-6);
    const double upwards = glm::dot(terrain.normal(i), terrain.up());
    if (i < terrain.points()) {
      ASSERT_GT(upwards, 0.0);
    } else if (i + 1 < terrain.vertices.size()) {
      ASSERT_NEAR(upwards, 0.0, 1e-6);
      ASSERT_GT(glm::dot(terrain.normal(i), terrain.position(i) - terrain.origin()), 0.0);
    }
  }
}

TEST(TerrainMesh, EveryPointHasItsAltitude) {
  Patch patch(61, 47, 500.0, hills);  // 30 km wide.
  patch.desc.base_m = 150.0;
  patch.desc.heightScale = 2.5;
  const Terrain terrain = built(patch.desc);
  double highest = 0.0;
  for (size_t i = 0; i < terrain.points(); ++i) {
    const double expected = std::max(0.0, (double{patch.heights[i]} - 150.0) * 2.5);
    ASSERT_NEAR(terrain.altitude(i), expected, 1.5e-3);  // Floats have 1 mm at 16 km.
    highest = std::max(highest, expected);
  }
  EXPECT_EQ(terrain.place.maxAltitude_m, highest);
  EXPECT_GT(highest, 1000.0);
}

TEST(TerrainMesh, WhatLiesBelowTheBaseIsAtAltitudeZero) {
  Patch patch(20, 20, 90.0, hills);
  patch.desc.base_m = 400.0;
  const Terrain terrain = built(patch.desc);
  size_t low = 0;
  for (size_t i = 0; i < terrain.points(); ++i) {
    ASSERT_GT(terrain.altitude(i), -1e-3);
    low += patch.heights[i] < 400.0f ? 1 : 0;
    if (patch.heights[i] < 400.0f) {
      ASSERT_NEAR(terrain.altitude(i), 0.0, 1e-3);
    }
  }
  EXPECT_GT(low, 100u);
}

// The middle of the east edge is 30 km from the centre: that far along the sphere, and 70.8 m below
// the centre's horizontal plane.
TEST(TerrainMesh, BendsOverTheSphere) {
  Patch patch(61, 41, 1000.0, flat);
  patch.desc.heading = 0.0;
  const Terrain terrain = built(patch.desc);
  const dvec3 east = terrain.position(terrain.at(60, 20));
  const double angle = std::acos(glm::dot(glm::normalize(east), terrain.up()));
  EXPECT_NEAR(angle * kRadius_m, 30e3, 0.1);
  EXPECT_NEAR(kRadius_m - glm::dot(east, terrain.up()), 70.755, 0.005);
  EXPECT_NEAR(30e3 * 30e3 / (2 * kRadius_m), 70.755, 0.005) << "The test's own figure.";
}

TEST(TerrainMesh, LiesWhereItsLatitudeLongitudeAndHeadingSay) {
  Patch patch(5, 7, 1000.0, flat);
  patch.desc.heading = 0.0;
  Parameters earth;
  ASSERT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  const auto camera = [&](double heading) {
    return cameraAt(earth, World{}, patch.desc.latitude, patch.desc.longitude, 0.0, heading, 0.0,
                    0.0);
  };
  const auto vector = [](const double v[3]) { return dvec3(v[0], v[1], v[2]); };
  for (const double heading : {0.0, 0.5, 3.0, -2.0}) {
    patch.desc.heading = heading;
    const Terrain terrain = built(patch.desc);
    const Camera ahead = camera(heading), right = camera(heading + kPi / 2.0);
    EXPECT_NEAR(glm::distance(terrain.up(), glm::normalize(vector(ahead.position))), 0.0, 1e-12);
    const dvec3 north = terrain.position(terrain.at(2, 0)) - terrain.origin();
    const dvec3 east = terrain.position(terrain.at(4, 3)) - terrain.origin();
    EXPECT_NEAR(glm::dot(north, vector(ahead.forward)), 3000.0, 0.01);
    EXPECT_NEAR(glm::dot(north, vector(right.forward)), 0.0, 0.01);
    EXPECT_NEAR(glm::dot(east, vector(right.forward)), 2000.0, 0.01);
    EXPECT_NEAR(glm::dot(east, vector(ahead.forward)), 0.0, 0.01);
  }
}

TEST(TerrainMesh, NormalsAreThoseOfTheSlope) {
  Patch patch(21, 21, 100.0,
              [](uint32_t column, uint32_t) { return 20.0f * static_cast<float>(column); });
  patch.desc.heading = 0.0;
  patch.desc.radius_m = 1e9;  // Flat.
  const Terrain terrain = built(patch.desc);
  Parameters earth;
  ASSERT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  const Camera east =
      cameraAt(earth, World{}, patch.desc.latitude, patch.desc.longitude, 0.0, kPi / 2.0, 0.0, 0.0);
  for (size_t i = 0; i < terrain.points(); ++i) {  // Rises eastwards by 1 in 5.
    ASSERT_NEAR(
        glm::dot(terrain.normal(i), dvec3(east.forward[0], east.forward[1], east.forward[2])),
        -0.2 / std::sqrt(1.04), 1e-5);
  }
}

TEST(TerrainMesh, OfASphereHasItsNormals) {
  Patch patch(31, 31, 20e3, flat);  // A patch of 600 km: 2.7 degrees to the edge.
  const Terrain terrain = built(patch.desc);
  for (uint32_t row = 1; row < 30; ++row) {
    for (uint32_t column = 1; column < 30; ++column) {
      const size_t i = terrain.at(column, row);
      ASSERT_NEAR(glm::distance(terrain.normal(i), glm::normalize(terrain.position(i))), 0.0, 1e-4);
    }
  }
}

TEST(TerrainMesh, FadesSmoothlyToZeroAtTheBorder) {
  Patch patch(41, 41, 100.0, [](uint32_t, uint32_t) { return 800.0f; });
  patch.desc.fade_m = 1000.0;
  const Terrain terrain = built(patch.desc);
  double before = 0.0;
  for (uint32_t column = 0; column <= 20; ++column) {
    const double altitude = terrain.altitude(terrain.at(column, 20));
    const double t = std::min(column / 10.0, 1.0);
    EXPECT_NEAR(altitude, 800.0 * t * t * (3.0 - 2.0 * t), 1e-3);
    EXPECT_NEAR(terrain.altitude(terrain.at(40 - column, 20)), altitude, 1e-3);
    EXPECT_NEAR(terrain.altitude(terrain.at(20, column)), altitude, 1e-3);
    EXPECT_NEAR(terrain.altitude(terrain.at(20, 40 - column)), altitude, 1e-3);
    EXPECT_LE(before, altitude + 1e-3);
    before = altitude;
  }
  for (uint32_t i = 0; i < 41; ++i) {
    for (const size_t at :
         {terrain.at(i, 0), terrain.at(i, 40), terrain.at(0, i), terrain.at(40, i)})
      EXPECT_NEAR(terrain.altitude(at), 0.0, 1e-3);
  }
}

TEST(TerrainMesh, TheBottomIsBelowTheGroundEverywhere) {
  Patch patch(45, 45, 1000.0, flat);
  for (const double radius : {6.36e6, 60e3}) {
    patch.desc.radius_m = radius;
    const Terrain terrain = built(patch.desc);
    const size_t cells = size_t{44} * 44 * 6;
    for (size_t i = cells; i < terrain.indices.size();
         i += 9) {  // The fan is every third triangle.
      const uint32_t* fan = terrain.indices.data() + i + 6;
      for (int a = 0; a <= 10; ++a) {
        for (int b = 0; a + b <= 10; ++b) {
          const dvec3 p = 0.1 * a * terrain.position(fan[0]) + 0.1 * b * terrain.position(fan[1]) +
                          0.1 * (10 - a - b) * terrain.position(fan[2]);
          ASSERT_LT(glm::length(p), radius - 49.9);
        }
      }
    }
  }
}

TEST(TerrainMesh, LargeCellsHaveADeeperSkirt) {
  const Patch patch(2, 2, 400e3, flat);  // Chords across it dip by 6.3 km.
  const Terrain terrain = built(patch.desc);
  const dvec3 middle = 0.5 * (terrain.position(0) + terrain.position(3));
  const double dip = kRadius_m - glm::length(middle);
  EXPECT_NEAR(dip, 6282.0, 20.0);
  EXPECT_NEAR(terrain.altitude(terrain.vertices.size() - 1), -2.0 * dip, 0.01 * dip);
  expectClosed(terrain);
}

TEST(TerrainMesh, TextureCoordinatesHitTexelsMiddles) {
  const Patch patch(4, 5, 100.0, hills);
  const Terrain terrain = built(patch.desc);
  EXPECT_EQ(terrain.vertices[0].uv[0], 0.125f);
  EXPECT_EQ(terrain.vertices[0].uv[1], 0.1f);
  EXPECT_EQ(terrain.vertices[terrain.at(3, 4)].uv[0], 0.875f);
  EXPECT_EQ(terrain.vertices[terrain.at(3, 4)].uv[1], 0.9f);
}

TEST(TerrainMesh, TheBoxHoldsThePointsAndTouchesThem) {
  Patch patch(50, 30, 700.0, hills);
  patch.desc.heading = 1.0;
  const Terrain terrain = built(patch.desc);
  const Box& box = terrain.place.box;
  const dvec3 center = {box.center[0], box.center[1], box.center[2]};
  const auto axisOf = [&](int i) { return dvec3(box.axes[i][0], box.axes[i][1], box.axes[i][2]); };
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box.halfExtents[axis];
    EXPECT_NEAR(glm::length(axisOf(axis)), 1.0, 1e-12);
    double least = 0.0, most = 0.0;
    for (size_t i = 0; i < terrain.points(); ++i) {
      const double along = glm::dot(terrain.position(i) - center, axisOf(axis));
      least = std::min(least, along);
      most = std::max(most, along);
    }
    EXPECT_NEAR(most, length, 1e-6);
    EXPECT_NEAR(least, -length, 1e-6);
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      EXPECT_NEAR(box.halfExtents[other] * glm::dot(axisOf(axis), axisOf(other)), 0.0, 1e-6);
    }
  }
  EXPECT_GT(glm::dot(terrain.up(), axisOf(2)), 0.0);
}

void expectRefused(const TerrainDesc& desc, std::initializer_list<const char*> words,
                   bool sizeToo = true) {
  TerrainSize size;
  size.vertexCount = 77;
  Refusal refusal;
  if (sizeToo) {
    refusal.expect(terrainSize(desc, &size, {&Refusal::take, &refusal}), Status::InvalidArgument,
                   words);
    EXPECT_EQ(size.vertexCount, 77u);
  }
  std::vector<TerrainVertex> vertices(1000);
  std::vector<uint32_t> indices(6000, 77u);
  TerrainPlace place;
  Refusal other;
  const Status status =
      buildTerrain(desc, vertices.data(), indices.data(), &place, {&Refusal::take, &other});
  other.expect(status, Status::InvalidArgument, words);
  EXPECT_EQ(std::count(indices.begin(), indices.end(), 77u), 6000);
}

TEST(TerrainMesh, RefusesBadFieldsWithTheirValues) {
  const Patch patch(5, 4, 100.0, hills);
  const auto with = [&](auto change) {
    TerrainDesc desc = patch.desc;
    change(&desc);
    return desc;
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  expectRefused(with([](auto* d) { d->field.width = 1; }), {"1x4", "2x2"});
  expectRefused(with([](auto* d) { d->field.height = 0; }), {"5x0", "2x2"});
  expectRefused(with([](auto* d) { d->field.width = d->field.height = 20000; }), {"20000x20000"});
  expectRefused(with([](auto* d) { d->field.width = UINT32_MAX; }), {"4294967295x4"});
  expectRefused(with([](auto* d) { d->field.spacing_m[0] = 0.0; }), {"spacing_m[0]", "is 0,"});
  expectRefused(with([](auto* d) { d->field.spacing_m[1] = kNaN; }), {"spacing_m[1]", "nan"});
  expectRefused(with([](auto* d) { d->field.spacing_m[1] = -4.0; }), {"spacing_m[1]", "-4"});
  expectRefused(with([](auto* d) { d->field.spacing_m[0] = 3e6; }), {"reaches", "eighth"});
  expectRefused(with([](auto* d) { d->radius_m = 0.0; }), {"radius_m is 0", "1000"});
  expectRefused(with([](auto* d) { d->latitude = 1.6; }), {"latitude is 1.6"});
  expectRefused(with([](auto* d) { d->longitude = kNaN; }), {"longitude is nan"});
  expectRefused(with([](auto* d) { d->heading = HUGE_VAL; }), {"heading is inf"});
  expectRefused(with([](auto* d) { d->base_m = kNaN; }), {"base_m is nan"});
  expectRefused(with([](auto* d) { d->heightScale = -1.0; }), {"heightScale is -1"});
  expectRefused(with([](auto* d) { d->fade_m = -1.0; }), {"fade_m is -1"});
  expectRefused(with([](auto* d) { d->skirtDepth_m = 4e6; }), {"skirtDepth_m is 4000000"});
  expectRefused(with([](auto* d) { d->field.heights = nullptr; }), {"heights is null"}, false);
  expectRefused(with([](auto* d) { d->field.spacing_m[0] = 1e-5; }),
                {"spacing_m[0] is 1e-05", "single precision"}, false);
  expectRefused(with([](auto* d) { d->heightScale = 1e5; }), {"column", "row", "radius"}, false);
}

TEST(TerrainMesh, RefusesHeightsThatAreNotFinite) {
  Patch patch(5, 4, 100.0, hills);
  patch.heights[2 * 5 + 3] = std::numeric_limits<float>::quiet_NaN();
  expectRefused(patch.desc, {"column 3", "row 2", "nan"}, false);
  patch.heights[2 * 5 + 3] = -std::numeric_limits<float>::infinity();
  expectRefused(patch.desc, {"column 3", "row 2", "-inf"}, false);
}

TEST(TerrainMesh, NeedsItsArraysButNotItsPlace) {
  const Patch patch(2, 2, 100.0, hills);
  std::vector<TerrainVertex> vertices(13);
  std::vector<uint32_t> indices(42);
  Refusal refusal;
  EXPECT_EQ(buildTerrain(patch.desc, vertices.data(), indices.data(), nullptr, {}), Status::Ok);
  refusal.expect(
      buildTerrain(patch.desc, nullptr, indices.data(), nullptr, {&Refusal::take, &refusal}),
      Status::InvalidArgument, {"vertices is null"});
  refusal.expect(
      buildTerrain(patch.desc, vertices.data(), nullptr, nullptr, {&Refusal::take, &refusal}),
      Status::InvalidArgument, {"indices is null"});
}

TEST(TerrainMesh, SizesAreWhatIsWritten) {
  const Patch patch(7, 5, 100.0, hills);
  const Terrain terrain = built(patch.desc);
  EXPECT_EQ(terrain.vertices.size(), 35u + 2 * 20 + 1);
  EXPECT_EQ(terrain.indices.size(), 6u * 6 * 4 + 9 * 20);
  std::vector<bool> used(terrain.vertices.size());
  for (const uint32_t index : terrain.indices) {
    ASSERT_LT(index, used.size());
    used[index] = true;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), true), static_cast<long>(used.size()));
}

TEST(TerrainMesh, Of512x512PointsTakesUnderASecond) {
  const Patch patch(512, 512, 90.0, hills);
  const std::clock_t start = std::clock();  // CPU time, which a busy machine doesn't stretch.
  const Terrain terrain = built(patch.desc);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%.3f CPU seconds\n", seconds);
  EXPECT_LT(seconds, 1.0);
  expectClosed(terrain);
}

}  // namespace
}  // namespace alpenglow::testing
