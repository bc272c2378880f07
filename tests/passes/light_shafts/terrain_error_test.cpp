// Radiance under the shadows of the real terrain, by each method, against rays cast in double:
// exact shadow intervals, and single scattering integrated over the lit parts.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "atmosphere/parameters/physics_cpp.h"
#include "tests/passes/light_shafts/terrain_views.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;

constexpr VkExtent2D kSize = {256, 192};

Vector vector(const Vec& v) { return {v[0], v[1], v[2]}; }

/// The single scattering that shadows remove from a pixel.
struct Wanted {
  uint32_t x, y;
  bool edge;  ///< Next to an edge of the picture's depth, or of a shadow.
  double loss[3];
};

class TerrainErrors : public TerrainLightShaftTest {
 protected:
  /// Per cent of the radiance in the picture, of the worst channel; sorted.
  struct Errors {
    std::vector<double> all, inner;  ///< Inner: not next to an edge.
    static double at(const std::vector<double>& sorted, double share) {
      return sorted[std::min(sorted.size() - 1, size_t(share * double(sorted.size())))];
    }
  };

  /// Metres to what a pixel shows; the sky is far.
  static double distanceAt(const LightShaftPicture& p, uint32_t x, uint32_t y) {
    return 0.1 / std::max(double(p.depth[size_t{y} * kSize.width + x]), 1e-12);
  }

  static bool nextToEdge(const LightShaftPicture& p, uint32_t x, uint32_t y) {
    const double here = distanceAt(p, x, y);
    for (uint32_t j = y - 1; j <= y + 1; ++j)
      for (uint32_t i = x - 1; i <= x + 1; ++i)
        if (std::abs(distanceAt(p, i, j) - here) > 0.1 * here) return true;
    return false;
  }

  /// What a ray loses, and whether it ends on the ground's sphere in shadow.
  struct Loss {
    double of[3] = {};
    bool darkGround = false;
  };
  Loss lossOf(const FrameState& d, uint32_t x, uint32_t y) {
    const auto medium = makeMediumF64(parameters);
    const auto [o, view] = pixelRay(LightShaftSetup{}, d, x, y);
    const reference::SceneRay ray{vector(o), vector(view), vector(vec(d.sun.direction))};
    const auto hit = rays().closest(ray.position, ray.view, 1e-3, reference::kEndless);
    const ProbeQuery query = rayQuery(parameters, d.camera, view, vec(d.sun.direction));
    const double mu = std::cos(query.zenith), h = query.altitude_m;
    const bool ground = physics_f64::rayHitsGround(medium, h, mu);
    double length = ground ? physics_f64::distanceToGround(medium, h, mu)
                           : physics_f64::distanceToTop(medium, h, mu);
    if (hit) length = std::min(length, hit->t);
    const auto shadow = reference::shadowIntervals(rays(), ray.position, ray.view, ray.sun, length);
    Loss loss;
    if (shadow.empty()) return loss;
    loss.darkGround = !hit && ground && shadow.back().to > length - 1.0;
    const auto lit = reference::litScattering(medium, ray, length, shadow, 1e-5);
    const auto whole = reference::litScattering(medium, ray, length, {}, 1e-5);
    for (uint32_t c = 0; c < 3; ++c) loss.of[c] = whole.value[c] - lit.value[c];
    return loss;
  }

  /// Whether the light that is wanted changes by more than 5 % to a neighbour.
  bool nextToShadowEdge(const FrameState& d, const LightShaftPicture& off, const Wanted& w) {
    const int steps[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (const auto& step : steps) {
      const uint32_t x = w.x + static_cast<uint32_t>(step[0]);
      const uint32_t y = w.y + static_cast<uint32_t>(step[1]);
      const Loss there = lossOf(d, x, y);
      for (int c = 0; c < 3; ++c) {
        const double here = off.light.at(w.x, w.y)[c] - w.loss[c];
        if (std::abs(off.light.at(x, y)[c] - there.of[c] - here) > 0.05 * here) return true;
      }
    }
    return false;
  }

  std::vector<Wanted> reference(const FrameState& d, const LightShaftPicture& off) {
    std::vector<Wanted> wanted;
    for (uint32_t y = 3; y < kSize.height - 1; y += 11) {
      for (uint32_t x = 2; x < kSize.width - 1; x += 11) {
        const Loss loss = lossOf(d, x, y);
        if (loss.darkGround) continue;  // the sphere's pixels lose the light of the ground, too
        Wanted w{x, y, nextToEdge(off, x, y), {loss.of[0], loss.of[1], loss.of[2]}};
        wanted.push_back(w);
      }
    }
    return wanted;
  }

  Errors errorsOf(const FrameState& d, const LightShaftPicture& p, const LightShaftPicture& off,
                  std::vector<Wanted>& wanted) {
    Errors errors;
    for (Wanted& w : wanted) {
      double worst = 0.0;
      for (int c = 0; c < 3; ++c) {
        const double total = off.light.at(w.x, w.y)[c], is = p.light.at(w.x, w.y)[c];
        const double want = total - w.loss[c];
        worst = std::max(worst, 100.0 * std::abs(is - want) / want);
      }
      errors.all.push_back(worst);
      if (worst > 2.0 && !w.edge) w.edge = nextToShadowEdge(d, off, w);
      if (!w.edge) errors.inner.push_back(worst);
    }
    std::sort(errors.all.begin(), errors.all.end());
    std::sort(errors.inner.begin(), errors.inner.end());
    return errors;
  }

  /// All light, integrated through the tables: the loss in shadows is subtracted from it.
  LightShaftPicture unshadowed(const FrameState& d) {
    LightShaftSetup setup;
    setup.shafts = false;
    setup.fromLut = false;
    return draw(setup, d);
  }

  static void print(const char* what, uint32_t number, const Errors& e) {
    std::printf(
        "  %-6s %4u: median %.3f p95 %.3f p99 %.2f; not next to an edge p95 %.3f max %.2f\n", what,
        number, Errors::at(e.all, 0.5), Errors::at(e.all, 0.95), Errors::at(e.all, 0.99),
        Errors::at(e.inner, 0.95), e.inner.back());
  }
};

#ifndef ALPENGLOW_ALL_METHODS
TEST_F(TerrainErrors, LightVolumeMeetsItsGoals) {
  for (const TerrainView& v : kTerrainViews) {
    const FrameState d = drawOf(v, kSize);
    const LightShaftPicture off = unshadowed(d);
    std::vector<Wanted> wanted = reference(d, off);
    LightShaftSetup setup;
    setup.shadowMapSize = 2048;
    setup.closed = true;
    const Errors e = errorsOf(d, draw(setup, d), off, wanted);
    std::printf("%s, %zu rays, per cent\n", v.name, wanted.size());
    print("exact", 1024, e);
    EXPECT_LE(Errors::at(e.inner, 0.95), 0.5) << v.name;
    EXPECT_LE(e.inner.back(), 2.0) << v.name;
  }
}
#else
TEST_F(TerrainErrors, OfEachMethod) {
  for (const TerrainView& v : kTerrainViews) {
    const FrameState d = drawOf(v, kSize);
    const LightShaftPicture off = unshadowed(d);
    std::vector<Wanted> wanted = reference(d, off);
    std::printf("%s, %zu rays, per cent\n", v.name, wanted.size());
    LightShaftSetup setup;
    setup.shadowMapSize = 2048;
    setup.closed = true;
    for (const uint32_t side : {512u, 1024u, 2048u}) {
      setup.meshSize = side;
      print("exact", side, errorsOf(d, draw(setup, d), off, wanted));
    }
    setup.meshSize = 0;
    setup.method = LightShaftMethod::RayMarch;
    double most = 1e9;
    for (const uint32_t stepCount : {16u, 32u, 64u, 128u}) {
      setup.stepCount = stepCount;
      const Errors e = errorsOf(d, draw(setup, d), off, wanted);
      print("march", stepCount, e);
      EXPECT_LT(Errors::at(e.all, 0.95), most) << "more samples are no better";
      most = Errors::at(e.all, 0.95);
    }
    setup.method = LightShaftMethod::ShadowVolume;
    print("paper", 0, errorsOf(d, draw(setup, d), off, wanted));
  }
}
#endif

}  // namespace
}  // namespace alpenglow::testing
