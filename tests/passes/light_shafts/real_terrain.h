// The real terrain of samples/data, as a caster of LightShaftTest.
#pragma once

#include <alpenglow/io/height_field.h>
#include <alpenglow/mesh/terrain.h>

#include "tests/passes/light_shafts/light_shaft_fixture.h"

namespace alpenglow::testing {

/// Three times as high as it is, its border faded; local coordinates (groundOrigin). Every `step`th
/// sample along either side.
inline reference::test::Mesh realTerrain(const Parameters& parameters, uint32_t step = 1) {
  const auto map = io::readHeightMap(ALPENGLOW_SAMPLE_DATA "/jacksboro.png");
  EXPECT_TRUE(map) << map.error;
  reference::test::Mesh mesh;
  if (!map) return mesh;
  const uint32_t width = (map->width - 1) / step + 1, height = (map->height - 1) / step + 1;
  std::vector<float> heights;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      heights.push_back(map->heights_m[size_t{y} * step * map->width + x * step]);
  TerrainDesc desc;
  desc.field = {heights.data(), width, height, {74.0 * step, 92.6 * step}};
  desc.radius_m = parameters.bottomRadius_m;
  desc.base_m = 236.0;
  desc.heightScale = 3.0;
  desc.fade_m = 3000.0;
  TerrainSize size;
  EXPECT_EQ(terrainSize(desc, &size, {}), Status::Ok);
  std::vector<TerrainVertex> vertices(size.vertexCount);
  mesh.indices.resize(size.indexCount);
  TerrainPlace place;
  EXPECT_EQ(buildTerrain(desc, vertices.data(), mesh.indices.data(), &place, {}), Status::Ok);
  const Vec origin = groundOrigin(parameters);
  for (const TerrainVertex& v : vertices)
    for (size_t i = 0; i < 3; ++i)
      mesh.positions.push_back(v.position[i] + (place.origin_m[i] - origin[i]));
  return mesh;
}

/// Altitude of the terrain above a place, metres.
inline double terrainAltitude(const reference::MeshRays& rays, const Parameters& parameters,
                              double east, double north) {
  const Vec o = groundOrigin(parameters);
  const auto hit = rays.closest(reference::Vector(o[0] + 1e5, east, north),
                                reference::Vector(-1, 0, 0), 0.0, 2e5);
  if (!hit) return 0.0;
  const double x = o[0] + 1e5 - hit->t;
  return std::sqrt(x * x + east * east + north * north) - o[0];
}

}  // namespace alpenglow::testing
