#include "atmosphere/reference/shadow_intervals.h"

#include <algorithm>

namespace alpenglow::reference {
namespace {

/// Below this sine between view and sun they count as parallel.
constexpr double kParallel = 1e-8;

/// Range of a linear function over a box.
struct Range {
  double low, high;
};
Range rangeOf(const Vector& gradient, const Vector& low, const Vector& high) {
  const double center = 0.5 * glm::dot(gradient, low + high);
  const double half = 0.5 * glm::dot(glm::abs(gradient), high - low);
  const double rounding = 1e-15 * glm::dot(glm::abs(gradient), glm::abs(low) + glm::abs(high));
  return {center - half - rounding, center + half + rounding};
}

/// A point of the plane of view and sun: x + t v + lambda s.
struct PlanePoint {
  double t, lambda;
};

/// Coordinates about the ray's start x: Q - x = t v + lambda s + a n. All linear in Q, so that they
/// cull boxes as well.
class ShadowPlane {
 public:
  ShadowPlane(const Vector& view, const Vector& sun, double sine)
      : normal_(glm::cross(view, sun) / sine) {
    const Vector across = glm::cross(normal_, view);  // Unit, towards the sun's side.
    lambda_ = across / sine;
    t_ = view - glm::dot(view, sun) * lambda_;
  }

  bool mayShadow(const Vector& low, const Vector& high, double length) const {
    const Range side = rangeOf(normal_, low, high);
    if (side.low > 0.0 || side.high < 0.0) return false;
    if (rangeOf(lambda_, low, high).high < 0.0) return false;
    const Range along = rangeOf(t_, low, high);
    return along.high >= 0.0 && along.low <= length;
  }

  /// The segment of the ray behind a triangle, seen from the sun; false for none.
  bool shadowOf(const std::array<Vector, 3>& corners, RayInterval& shadow) const {
    double side[3];
    for (size_t i = 0; i < 3; ++i) side[i] = glm::dot(normal_, corners[i]);
    PlanePoint ends[2];
    size_t count = 0;
    for (size_t i = 0; i < 3; ++i) {
      const size_t j = (i + 1) % 3;
      // A corner in the plane counts as above it, for all of its triangles alike.
      if ((side[i] >= 0.0) == (side[j] >= 0.0)) continue;
      // From above to below whichever triangle the edge is seen from: neighbours join exactly.
      const size_t above = side[i] >= 0.0 ? i : j, below = side[i] >= 0.0 ? j : i;
      const double share = side[above] / (side[above] - side[below]);
      const Vector cut = corners[above] + share * (corners[below] - corners[above]);
      if (count < 2) ends[count++] = {glm::dot(t_, cut), glm::dot(lambda_, cut)};
    }
    if (count < 2) return false;
    if (ends[0].lambda > ends[1].lambda) std::swap(ends[0], ends[1]);
    if (!(ends[1].lambda > 0.0)) return false;
    if (ends[0].lambda < 0.0) {
      const double share = ends[0].lambda / (ends[0].lambda - ends[1].lambda);
      ends[0] = {ends[0].t + share * (ends[1].t - ends[0].t), 0.0};
    }
    shadow = {std::min(ends[0].t, ends[1].t), std::max(ends[0].t, ends[1].t)};
    return shadow.to > shadow.from;
  }

 private:
  Vector normal_, lambda_, t_;
};

/// The ray runs along the beam: behind the first triangle that the light meets all is dark.
std::vector<RayInterval> alongTheBeam(const MeshRays& meshes, const Vector& origin,
                                      const Vector& sun, bool towardsSun, double length) {
  // From beyond everything in the sun's direction; the nearest triangle from there.
  double beyond = 0.0;
  meshes.visit(
      [&](const Vector& low, const Vector& high) {
        beyond = std::max(beyond, rangeOf(sun, low - origin, high - origin).high + 1.0);
        return false;
      },
      [](const auto&) {});
  const std::optional<MeshHit> hit =
      meshes.closest(origin + beyond * sun, -sun, 0.0, beyond + length);
  if (!hit) return {};
  const double sunward = beyond - hit->t;  // From the ray's start to the triangle.
  const RayInterval shadow = towardsSun ? RayInterval{0.0, std::min(sunward, length)}
                                        : RayInterval{std::max(-sunward, 0.0), length};
  if (!(shadow.to > shadow.from)) return {};
  return {shadow};
}

std::vector<RayInterval> joined(std::vector<RayInterval> parts, const ShadowGap& gap) {
  std::sort(parts.begin(), parts.end(), [](const RayInterval& a, const RayInterval& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  std::vector<RayInterval> result;
  for (const RayInterval& part : parts) {
    if (!result.empty() &&
        part.from <= result.back().to + gap.absolute_m + gap.relative * result.back().to) {
      result.back().to = std::max(result.back().to, part.to);
    } else {
      result.push_back(part);
    }
  }
  return result;
}

}  // namespace

std::vector<RayInterval> shadowIntervals(const MeshRays& meshes, const Vector& origin,
                                         const Vector& view, const Vector& sun, double length,
                                         const ShadowGap& gap) {
  if (!(length > 0.0)) return {};
  const double sine = glm::length(glm::cross(view, sun));
  if (sine < kParallel) {
    return alongTheBeam(meshes, origin, sun, glm::dot(view, sun) > 0.0, length);
  }
  const ShadowPlane plane(view, sun, sine);
  std::vector<RayInterval> parts;
  meshes.visit(
      [&](const Vector& low, const Vector& high) {
        return plane.mayShadow(low - origin, high - origin, length);
      },
      [&](const std::array<Vector, 3>& corners) {
        RayInterval shadow;
        if (!plane.shadowOf({corners[0] - origin, corners[1] - origin, corners[2] - origin},
                            shadow)) {
          return;
        }
        shadow = {std::max(shadow.from, 0.0), std::min(shadow.to, length)};
        if (shadow.to > shadow.from) parts.push_back(shadow);
      });
  return joined(std::move(parts), gap);
}

}  // namespace alpenglow::reference
