// Opaque triangle meshes, several of them, and what rays meet there: in double, by a tree of boxes
// that comes out the same on every build.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "atmosphere/reference/directions.h"

namespace alpenglow::reference {

inline constexpr double kEndless = std::numeric_limits<double>::infinity();

struct MeshHit {
  double t = 0.0;         ///< Metres along the ray, whose direction is a unit vector.
  uint32_t mesh = 0;      ///< In the order of add().
  uint32_t triangle = 0;  ///< Of that mesh.
  Vector normal{0.0};     ///< Unit; the side from which the corners run counterclockwise.
};

/// Both sides of a triangle are opaque; one without area is not there. Edges that two triangles
/// share (the same corners, bit by bit) let no ray through.
class MeshRays {
 public:
  /// A mesh's corners are x, y, z in metres from `origin`, which is in the planet's frame like all
  /// rays; copied. Returns the mesh's number. Throws std::invalid_argument, one sentence, if an
  /// index or a position is out of its range.
  uint32_t add(const Vector& origin, std::span<const float> positions,
               std::span<const uint32_t> indices);
  uint32_t add(const Vector& origin, std::span<const double> positions,
               std::span<const uint32_t> indices);
  /// After the last add() and before the first ray.
  void build();

  size_t triangleCount() const { return triangles_.size(); }
  uint32_t meshCount() const { return meshCount_; }

  /// The nearest triangle with tmin < t < tmax. Rays that start on a surface pass a tmin above
  /// rounding (positions near an Earth's surface round to 1e-9 m).
  std::optional<MeshHit> closest(const Vector& origin, const Vector& direction, double tmin,
                                 double tmax) const;
  /// Whether there is any such triangle.
  bool blocked(const Vector& origin, const Vector& direction, double tmin, double tmax) const;

  /// Calls visit(corners) for the triangles of each leaf whose own box and all boxes above it have
  /// keep(low, high) true.
  template <class Keep, class Visit>
  void visit(const Keep& keep, const Visit& visit) const {
    std::array<uint32_t, kStack> stack;
    size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[stack[--depth]];
      if (!keep(node.low, node.high)) continue;
      if (node.count == 0) {
        stack[depth++] = node.first + 1;
        stack[depth++] = node.first;
      }
      for (uint32_t i = 0; i < node.count; ++i) visit(triangles_[node.first + i].corners);
    }
  }

 private:
  /// Deeper than any path to a leaf, as build() balances what lies deeper than kUnbalanced.
  static constexpr size_t kStack = 96;
  static constexpr uint32_t kUnbalanced = 48;

  struct Triangle {
    std::array<Vector, 3> corners;
    uint32_t mesh, index;
  };
  struct Node {
    Vector low, high;
    uint32_t first = 0;  ///< First triangle, or the first of two children side by side.
    uint32_t count = 0;  ///< Triangles; 0 for an inner node.
  };
  struct Builder;
  struct Ray;

  template <class T>
  uint32_t addMesh(const Vector& origin, std::span<const T> positions,
                   std::span<const uint32_t> indices);
  template <class Found>
  void traverse(const Ray& ray, double tmin, double tmax, const Found& found) const;

  std::vector<Triangle> triangles_;  ///< In the order of the leaves once built.
  std::vector<Node> nodes_;
  uint32_t meshCount_ = 0;
};

}  // namespace alpenglow::reference
