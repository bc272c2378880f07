// Closed meshes that the tests of rays and shadows share: corners in metres, triangles of three
// indices, counterclockwise from outside.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "atmosphere/reference/mesh_rays.h"

namespace alpenglow::reference::test {

/// Where the planet's surface is, rounding is 1e-9 m.
inline const Vector kFar(3.1e6, -2.2e6, 5.1e6);

struct Mesh {
  std::vector<double> positions;
  std::vector<uint32_t> indices;
  size_t triangles() const { return indices.size() / 3; }
};

inline uint32_t addCorner(Mesh& mesh, const Vector& p) {
  mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
  return static_cast<uint32_t>(mesh.positions.size() / 3 - 1);
}

/// The box between two corners, turned by `frame` (its columns are the box's axes).
inline Mesh box(const Vector& low, const Vector& high, const glm::dmat3& frame = glm::dmat3(1.0)) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    addCorner(mesh, frame * Vector(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                                   i & 4 ? high.z : low.z));
  }
  mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return mesh;
}

/// An icosahedron whose triangles are quartered `levels` times, the corners on the sphere.
inline Mesh icosphere(double radius, int levels) {
  Mesh mesh;
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  for (const auto& [a, b] : {std::pair(1.0, golden), std::pair(-1.0, golden),
                             std::pair(1.0, -golden), std::pair(-1.0, -golden)}) {
    for (const Vector& p : {Vector(a, b, 0), Vector(0, a, b), Vector(b, 0, a)}) {
      addCorner(mesh, radius * glm::normalize(p));
    }
  }
  const auto at = [&mesh](uint32_t i) {
    return Vector(mesh.positions[3 * i], mesh.positions[3 * i + 1], mesh.positions[3 * i + 2]);
  };
  const double edge = 1.1 * radius;  // Nearest corners lie 1.05 radii apart, the next 1.7.
  for (uint32_t a = 0; a < 12; ++a) {
    for (uint32_t b = a + 1; b < 12; ++b) {
      for (uint32_t c = b + 1; c < 12; ++c) {
        if (glm::length(at(a) - at(b)) > edge || glm::length(at(b) - at(c)) > edge ||
            glm::length(at(c) - at(a)) > edge) {
          continue;
        }
        const bool outwards = glm::dot(glm::cross(at(b) - at(a), at(c) - at(a)), at(a)) > 0.0;
        mesh.indices.insert(mesh.indices.end(), {a, outwards ? b : c, outwards ? c : b});
      }
    }
  }
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), 0);
      if (isNew) place->second = addCorner(mesh, radius * glm::normalize(at(a) + at(b)));
      return place->second;
    };
    std::vector<uint32_t> finer;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      const uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    mesh.indices = std::move(finer);
  }
  return mesh;
}

inline MeshRays raysOf(const std::vector<Mesh>& meshes, const Vector& origin = Vector(0.0)) {
  MeshRays rays;
  for (const Mesh& mesh : meshes) {
    rays.add(origin, std::span<const double>(mesh.positions), mesh.indices);
  }
  rays.build();
  return rays;
}

}  // namespace alpenglow::reference::test
