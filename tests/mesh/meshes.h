// Meshes to test with, and what neighbours must be, found by brute force.
#pragma once

#include <alpenglow/mesh/adjacency.h>

#include <array>
#include <cstdint>
#include <vector>

namespace alpenglow::testing {

using Point = std::array<float, 3>;

struct Mesh {
  std::vector<Point> points;
  std::vector<uint32_t> indices;

  MeshView view() const {
    MeshView view;
    view.positions = points.empty() ? nullptr : points[0].data();
    view.vertexCount = static_cast<uint32_t>(points.size());
    view.indices = indices.data();
    view.indexCount = static_cast<uint32_t>(indices.size());
    return view;
  }
};

/// Four corners, wound outwards.
inline Mesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}};
}

/// Six sides of two triangles over eight corners; bit 0 of a corner's number is x, 1 y, 2 z.
inline Mesh cube() {
  Mesh mesh;
  for (uint32_t i = 0; i < 8; ++i) {
    mesh.points.push_back({static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                           static_cast<float>(i >> 2 & 1)});
  }
  const uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    for (const uint32_t index : {q[0], q[1], q[2], q[0], q[2], q[3]}) mesh.indices.push_back(index);
  }
  return mesh;
}

/// Every corner of every triangle becomes a vertex of its own.
inline Mesh exploded(const Mesh& mesh) {
  Mesh result;
  for (const uint32_t index : mesh.indices) {
    result.indices.push_back(static_cast<uint32_t>(result.points.size()));
    result.points.push_back(mesh.points[index]);
  }
  return result;
}

}  // namespace alpenglow::testing
