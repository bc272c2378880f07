#include "tests/passes/light_shafts/shadow_check.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/camera/world.h"
#include "atmosphere/parameters/physics_cpp.h"
#include "atmosphere/passes/light_shaft_frame.h"

namespace alpenglow::testing {
namespace {

using reference::RayInterval;
using reference::Vector;
using Intervals = std::vector<RayInterval>;

Vector vector(const Vec& v) { return {v[0], v[1], v[2]}; }

/// What lies in at least `least` of `sets`.
Intervals covered(const std::vector<Intervals>& sets, int least) {
  std::vector<std::pair<double, int>> ends;
  for (const Intervals& set : sets) {
    for (const RayInterval& i : set) {
      ends.push_back({i.from, 1});
      ends.push_back({i.to, -1});
    }
  }
  std::sort(ends.begin(), ends.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  });
  Intervals result;
  int depth = 0;
  for (const auto& [t, change] : ends) {
    const int before = depth;
    depth += change;
    if (before < least && depth >= least) result.push_back({t, t});
    if (before >= least && depth < least) result.back().to = t;
  }
  return result;
}

/// The segment of a ray inside the planet's own shadow, cut to its length.
RayInterval planetShadow(const reference::SceneRay& ray, double radius, double length) {
  const double nu = glm::dot(ray.view, ray.sun), along = glm::dot(ray.position, ray.sun);
  const double a = 1.0 - nu * nu, b = glm::dot(ray.position, ray.view) - along * nu;
  const double c = glm::dot(ray.position, ray.position) - along * along - radius * radius;
  const double root = b * b - a * c;
  if (a < 1e-12 || root <= 0.0) return {};
  double from = (-b - std::sqrt(root)) / a, to = (-b + std::sqrt(root)) / a;
  // Behind the planet: along + t nu < 0.
  if (nu > 0.0) to = std::min(to, -along / nu);
  if (nu < 0.0) from = std::max(from, -along / nu);
  from = std::max(from, 0.0);
  to = std::min(to, length);
  return from < to ? RayInterval{from, to} : RayInterval{};
}

/// Without `dark`.
Intervals lessDark(const Intervals& shadows, const RayInterval& dark) {
  if (!(dark.from < dark.to)) return shadows;
  Intervals result;
  for (const RayInterval& s : shadows) {
    if (s.from < std::min(s.to, dark.from)) result.push_back({s.from, std::min(s.to, dark.from)});
    if (std::max(s.from, dark.to) < s.to) result.push_back({std::max(s.from, dark.to), s.to});
  }
  return result;
}

/// Metres to the ground, or to the top of the atmosphere.
double airLength(const Parameters& parameters, const Vector& o, const Vector& v) {
  const double b = glm::dot(o, v), c = glm::dot(o, o);
  const double rg = parameters.bottomRadius_m, rt = parameters.topRadius_m;
  const double ground = b * b - c + rg * rg;
  if (b < 0.0 && ground > 0.0) return std::max(-b - std::sqrt(ground), 0.0);
  return -b + std::sqrt(std::max(b * b - c + rt * rt, 0.0));
}

}  // namespace

double lengthOf(const Intervals& intervals) {
  double sum = 0.0;
  for (const RayInterval& i : intervals) sum += i.to - i.from;
  return sum;
}

FrameState ShadowCheckTest::stage(const ShadowScene& scene) {
  clearCasters();
  for (const reference::test::Mesh& mesh : scene.casters) addCaster(mesh);
  return drawFrom(scene.camera, scene.heading, scene.pitch, scene.fov, kExtent, scene.sunElevation,
                  scene.sunAzimuth);
}

bool ShadowCheckTest::startsInShadow(const FrameState& draw) {
  return rays().blocked(vector(vec(draw.camera.position_m)), vector(vec(draw.sun.direction)), 0.0,
                        reference::kEndless);
}

double ShadowCheckTest::texel(const LightShaftSetup& setup, const FrameState& draw) const {
  const passes::ShadowMapPlace place =
      passes::placeShadowMap(passes::planetBox(passes::Placement(World{}), bounds()),
                             draw.sun.direction, setup.shadowMapSize);
  return 2.0 * std::max(place.halfU, place.halfV) / setup.shadowMapSize;
}

ShadowBand ShadowCheckTest::band(const LightShaftSetup& setup, const FrameState& draw, uint32_t x,
                                 uint32_t y, double slack) {
  const auto rayAt = [&](double px, double py) { return pixelRay(setup, draw, px, py); };
  const auto [o, v] = rayAt(x, y);
  ShadowBand band;
  band.ray = {vector(o), vector(v), vector(vec(draw.sun.direction))};
  const auto hit = rays().closest(band.ray.position, band.ray.view, 1e-3, reference::kEndless);
  band.length = airLength(parameters, band.ray.position, band.ray.view);
  band.onMesh = hit && hit->t < band.length;
  if (band.onMesh) band.length = hit->t;
  for (const auto& [dx, dy] :
       {std::pair(0.02, 0.0), std::pair(-0.02, 0.0), std::pair(0.0, 0.02), std::pair(0.0, -0.02)}) {
    const auto [p, w] = rayAt(x + dx, y + dy);
    const auto other = rays().closest(vector(p), vector(w), 1e-3, reference::kEndless);
    band.atEdge = band.atEdge || bool(other) != bool(hit) ||
                  (hit && std::abs(other->t - hit->t) > 0.02 * hit->t);
  }
  const Vector& sun = band.ray.sun;
  const Vector u =
      glm::normalize(glm::cross(std::abs(sun.x) < 0.9 ? Vector(1, 0, 0) : Vector(0, 1, 0), sun));
  const Vector w = glm::cross(sun, u);
  const auto shadowsAt = [&](const Vector& offset) {
    return reference::shadowIntervals(rays(), band.ray.position + offset, band.ray.view, sun,
                                      band.length);
  };
  const RayInterval dark = planetShadow(band.ray, parameters.bottomRadius_m, band.length);
  band.middle = lessDark(shadowsAt(Vector(0.0)), dark);
  std::vector<Intervals> sets;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = 0; k < 2; ++k)
        sets.push_back(shadowsAt(slack * (double(i) * u + double(j) * w + double(k) * sun)));
    }
  }
  band.least = lessDark(covered(sets, static_cast<int>(sets.size())), dark);
  band.most = lessDark(covered(sets, 1), dark);
  return band;
}

std::optional<bool> ShadowCheckTest::surfaceInShadow(const ShadowBand& band, double slack) {
  const auto hit = rays().closest(band.ray.position, band.ray.view, 1e-3, reference::kEndless);
  if (!hit || band.atEdge) return std::nullopt;
  const Vector n = glm::dot(hit->normal, band.ray.view) < 0.0 ? hit->normal : -hit->normal;
  if (glm::dot(n, band.ray.sun) < 0.02) return std::nullopt;
  const Vector a =
      glm::normalize(glm::cross(n, std::abs(n.x) < 0.9 ? Vector(1, 0, 0) : Vector(0, 1, 0)));
  const Vector b = glm::cross(n, a);
  const Vector on = band.ray.position + hit->t * band.ray.view;
  const bool touching = rays().blocked(on + 1e-3 * n, band.ray.sun, 0.0, reference::kEndless);
  const Vector at = on + 0.1 * slack * n;
  int dark = 0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const Vector p = at + slack * (double(i) * a + double(j) * b);
      dark += rays().blocked(p, band.ray.sun, 0.0, reference::kEndless) ? 1 : 0;
    }
  }
  if (dark != (touching ? 9 : 0)) return std::nullopt;
  return touching;
}

std::vector<double> ShadowCheckTest::losses(LightShaftSetup setup, const FrameState& d,
                                            LightShaftPicture* with,
                                            LightShaftPicture* unshadowed) {
  setup.shafts = true;
  *with = draw(setup, d);
  setup.shafts = false;
  *unshadowed = draw(setup, d);
  std::vector<double> losses;
  for (size_t i = 1; i < with->light.data.size(); i += 4)
    losses.push_back(double(unshadowed->light.data[i]) - with->light.data[i]);
  return losses;
}

}  // namespace alpenglow::testing
