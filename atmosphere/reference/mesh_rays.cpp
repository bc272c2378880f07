#include "atmosphere/reference/mesh_rays.h"

#include <stdexcept>
#include <string>

namespace alpenglow::reference {
namespace {

constexpr uint32_t kLeaf = 4;  ///< So many triangles are not split any more.
constexpr size_t kBins = 16;

struct Box {
  Vector low{kEndless}, high{-kEndless};
  void add(const Vector& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Box& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
};

/// A box by more than rounding larger: a ray in a face, or in a box without height, is inside.
Box padded(const Box& box) {
  const auto some = [](const Vector& p) { return glm::max(1e-15 * glm::abs(p), Vector(1e-100)); };
  return {box.low - some(box.low), box.high + some(box.high)};
}

/// Half of a box's surface.
double areaOf(const Box& box) {
  const Vector e = box.high - box.low;
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace

template <class T>
uint32_t MeshRays::addMesh(const Vector& origin, std::span<const T> positions,
                           std::span<const uint32_t> indices) {
  const size_t vertices = positions.size() / 3;
  const auto at = [&](size_t i) {
    if (indices[i] >= vertices) {
      throw std::invalid_argument("Index " + std::to_string(indices[i]) + " at place " +
                                  std::to_string(i) + " of a mesh names no vertex; it has " +
                                  std::to_string(vertices) + " vertices.");
    }
    const T* p = &positions[size_t{3} * indices[i]];
    const Vector point = origin + Vector(static_cast<double>(p[0]), static_cast<double>(p[1]),
                                         static_cast<double>(p[2]));
    if (!(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z))) {
      throw std::invalid_argument("Vertex " + std::to_string(indices[i]) +
                                  " of a mesh is not finite; expected metres in three numbers.");
    }
    return point;
  };
  triangles_.reserve(triangles_.size() + indices.size() / 3);
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const std::array<Vector, 3> corners = {at(i), at(i + 1), at(i + 2)};
    const Vector normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(glm::dot(normal, normal) > 0.0)) continue;
    triangles_.push_back({corners, meshCount_, static_cast<uint32_t>(i / 3)});
  }
  return meshCount_++;
}

uint32_t MeshRays::add(const Vector& origin, std::span<const float> positions,
                       std::span<const uint32_t> indices) {
  return addMesh(origin, positions, indices);
}
uint32_t MeshRays::add(const Vector& origin, std::span<const double> positions,
                       std::span<const uint32_t> indices) {
  return addMesh(origin, positions, indices);
}

/// Boxes around triangles, split where the surface area heuristic finds it cheapest among equal
/// bins of their centres (Wald 2007).
struct MeshRays::Builder {
  struct Item {
    Box box;
    Vector center;
    uint32_t triangle;
  };
  std::vector<Item> items;
  std::vector<Node>& nodes;

  void build(uint32_t node, uint32_t first, uint32_t count, uint32_t depth) {
    Box box, centers;
    for (uint32_t i = first; i < first + count; ++i) {
      box.add(items[i].box);
      centers.add(items[i].center);
    }
    const Box roomy = padded(box);
    nodes[node] = {roomy.low, roomy.high, first, count};
    if (count <= kLeaf) return;
    uint32_t left = depth < kUnbalanced ? split(first, count, centers) : 0;
    if (left == 0) left = halve(first, count, centers);
    const auto children = static_cast<uint32_t>(nodes.size());
    nodes.resize(nodes.size() + 2);
    nodes[node].first = children;
    nodes[node].count = 0;
    build(children, first, left, depth + 1);
    build(children + 1, first + left, count - left, depth + 1);
  }

  /// Triangles of the left side after the cheapest split; 0 where the bins separate nothing.
  uint32_t split(uint32_t first, uint32_t count, const Box& centers) {
    double best = kEndless;
    int bestAxis = 0;
    size_t bestBin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centers.high[axis] > centers.low[axis])) continue;
      std::array<Box, kBins> boxes;
      std::array<uint32_t, kBins> counts{};
      for (uint32_t i = first; i < first + count; ++i) {
        const size_t bin = binOf(items[i], centers, axis);
        boxes[bin].add(items[i].box);
        ++counts[bin];
      }
      const std::array<double, kBins> costs = costsOf(boxes, counts);
      for (size_t bin = 0; bin + 1 < kBins; ++bin) {
        if (!(costs[bin] < best)) continue;
        best = costs[bin];
        bestAxis = axis;
        bestBin = bin;
      }
    }
    if (!(best < kEndless)) return 0;
    const auto begin = items.begin() + first;
    const auto middle = std::stable_partition(begin, begin + count, [&](const Item& item) {
      return binOf(item, centers, bestAxis) <= bestBin;
    });
    return static_cast<uint32_t>(middle - begin);
  }

  static size_t binOf(const Item& item, const Box& centers, int axis) {
    const double x = (item.center[axis] - centers.low[axis]) /
                     (centers.high[axis] - centers.low[axis]) * static_cast<double>(kBins);
    return std::min(static_cast<size_t>(std::max(x, 0.0)), kBins - 1);
  }

  /// Of a split behind each bin: each side's triangles times its surface. Endless for empty sides.
  static std::array<double, kBins> costsOf(const std::array<Box, kBins>& boxes,
                                           const std::array<uint32_t, kBins>& counts) {
    std::array<double, kBins> costs;
    costs.fill(kEndless);
    Box right;
    uint32_t some = 0;
    for (size_t bin = kBins - 1; bin > 0; --bin) {
      right.add(boxes[bin]);
      some += counts[bin];
      if (some > 0) costs[bin - 1] = areaOf(right) * some;
    }
    Box left;
    some = 0;
    for (size_t bin = 0; bin + 1 < kBins; ++bin) {
      left.add(boxes[bin]);
      some += counts[bin];
      costs[bin] = some > 0 ? costs[bin] + areaOf(left) * some : kEndless;
    }
    return costs;
  }

  /// By the order along the longest side of the centres' box.
  uint32_t halve(uint32_t first, uint32_t count, const Box& centers) {
    const Vector size = centers.high - centers.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto begin = items.begin() + first;
    std::sort(begin, begin + count, [axis](const Item& a, const Item& b) {
      return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis]
                                              : a.triangle < b.triangle;
    });
    return count / 2;
  }
};

void MeshRays::build() {
  nodes_.clear();
  if (triangles_.empty()) return;
  Builder builder{{}, nodes_};
  builder.items.resize(triangles_.size());
  for (size_t i = 0; i < triangles_.size(); ++i) {
    Builder::Item& item = builder.items[i];
    for (const Vector& corner : triangles_[i].corners) item.box.add(corner);
    item.center = 0.5 * (item.box.low + item.box.high);
    item.triangle = static_cast<uint32_t>(i);
  }
  nodes_.reserve(triangles_.size());
  nodes_.resize(1);
  builder.build(0, 0, static_cast<uint32_t>(triangles_.size()), 0);
  std::vector<Triangle> sorted;
  sorted.reserve(triangles_.size());
  for (const Builder::Item& item : builder.items) sorted.push_back(triangles_[item.triangle]);
  triangles_ = std::move(sorted);
}

/// A ray made ready: for boxes its direction's reciprocal, for triangles a frame in which it runs
/// along z (Woop, Benthin & Wald 2013: an edge's two triangles see the same number, so none of them
/// misses what the other leaves to it).
struct MeshRays::Ray {
  Vector origin, inverse;
  int x, y, z;
  double shearX, shearY, scale;

  Ray(const Vector& from, const Vector& direction) : origin(from) {
    const Vector size = glm::abs(direction);
    z = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    x = (z + 1) % 3;
    y = (z + 2) % 3;
    shearX = direction[x] / direction[z];
    shearY = direction[y] / direction[z];
    scale = 1.0 / direction[z];
    // Not infinity, which times a distance of 0 has no value.
    for (int i = 0; i < 3; ++i) {
      inverse[i] = size[i] > 1e-300 ? 1.0 / direction[i] : std::copysign(1e300, direction[i]);
    }
  }

  /// Where the ray enters a box, or endless. The far end gets what its rounding may have lost (Ize
  /// 2013).
  double enters(const Vector& low, const Vector& high, double tmin, double tmax) const {
    constexpr double kRounding = 1.0 + 8.0 * std::numeric_limits<double>::epsilon();
    const Vector a = (low - origin) * inverse, b = (high - origin) * inverse;
    const Vector near = glm::min(a, b), far = glm::max(a, b);
    const double from = std::max(std::max(near.x, near.y), std::max(near.z, tmin));
    const double to = std::min(std::min(far.x, far.y), std::min(far.z, tmax));
    return from <= to * kRounding ? from : kEndless;
  }

  /// Distance to a triangle in (tmin, tmax), or endless.
  double meets(const std::array<Vector, 3>& corners, double tmin, double tmax) const {
    double px[3], py[3], pz[3];
    for (size_t i = 0; i < 3; ++i) {
      const Vector q = corners[i] - origin;
      px[i] = q[x] - shearX * q[z];
      py[i] = q[y] - shearY * q[z];
      pz[i] = scale * q[z];
    }
    const double u = px[2] * py[1] - py[2] * px[1];
    const double v = px[0] * py[2] - py[0] * px[2];
    const double w = px[1] * py[0] - py[1] * px[0];
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return kEndless;
    const double sum = u + v + w;
    if (sum == 0.0) return kEndless;
    const double t = (u * pz[0] + v * pz[1] + w * pz[2]) / sum;
    return t > tmin && t < tmax ? t : kEndless;
  }
};

/// Leaves nearest first. found(triangle, t) gives the new tmax: below tmin to stop.
template <class Found>
void MeshRays::traverse(const Ray& ray, double tmin, double tmax, const Found& found) const {
  struct Entry {
    uint32_t node;
    double t;
  };
  std::array<Entry, kStack> stack;
  size_t depth = 0;
  if (nodes_.empty()) return;
  const double root = ray.enters(nodes_[0].low, nodes_[0].high, tmin, tmax);
  if (root < kEndless) stack[depth++] = {0, root};
  while (depth > 0) {
    const Entry entry = stack[--depth];
    if (entry.t > tmax) continue;
    const Node& node = nodes_[entry.node];
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const double t = ray.meets(triangles_[i].corners, tmin, tmax);
      if (t < kEndless) tmax = found(triangles_[i], t);
      if (tmax < tmin) return;
    }
    if (node.count > 0) continue;
    Entry near{node.first, 0.0}, far{node.first + 1, 0.0};
    for (Entry* e : {&near, &far}) {
      e->t = ray.enters(nodes_[e->node].low, nodes_[e->node].high, tmin, tmax);
    }
    if (far.t < near.t) std::swap(near, far);
    if (far.t < kEndless) stack[depth++] = far;
    if (near.t < kEndless) stack[depth++] = near;
  }
}

std::optional<MeshHit> MeshRays::closest(const Vector& origin, const Vector& direction, double tmin,
                                         double tmax) const {
  const Triangle* nearest = nullptr;
  double distance = tmax;
  traverse(Ray(origin, direction), tmin, tmax, [&](const Triangle& triangle, double t) {
    nearest = &triangle;
    return distance = t;
  });
  if (nearest == nullptr) return std::nullopt;
  const auto& [a, b, c] = nearest->corners;
  return MeshHit{distance, nearest->mesh, nearest->index, glm::normalize(glm::cross(b - a, c - a))};
}

bool MeshRays::blocked(const Vector& origin, const Vector& direction, double tmin,
                       double tmax) const {
  bool any = false;
  traverse(Ray(origin, direction), tmin, tmax, [&](const Triangle&, double) {
    any = true;
    return -kEndless;
  });
  return any;
}

}  // namespace alpenglow::reference
