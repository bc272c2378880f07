// A scene's terrain as arrays for buffers, made on the CPU before there is a device.
#pragma once

#include <alpenglow/io/scene_file.h>
#include <alpenglow/mesh/terrain.h>

#include <vector>

namespace alpenglow::samples {

struct TerrainMesh {
  std::vector<TerrainVertex> vertices;
  std::vector<uint32_t> indices;  ///< Plain triangles.
  TerrainPlace place;
};

/// Reads the height map and bends it over the ground. Throws an Error.
TerrainMesh loadTerrain(const Parameters& parameters, const io::SceneTerrain& terrain);

/// Indices of its triangles with adjacency, for the paper's shadow volumes. Throws an Error.
std::vector<uint32_t> withAdjacency(const TerrainMesh& mesh);

/// Least and greatest distance along `direction`, a unit vector, between `point` and the box.
struct Reach {
  double least = 0.0;
  double most = 0.0;
};
Reach reachOf(const Box& box, const double point[3], const double direction[3]);

}  // namespace alpenglow::samples
