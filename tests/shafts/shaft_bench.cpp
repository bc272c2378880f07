// What light shafts cost over the real terrain, and how far they are from exact shadows: each
// method, each scene. `build/bin/shaft_bench`.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "atmosphere/model/physics_cpp.h"
#include "tests/shafts/real_terrain.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;

class ShaftBench : public ShaftTest {};

struct View3 {
  const char* name;
  double east, north, above, heading, pitch, fov, sunElevation, sunAzimuth;
};
constexpr View3 kViews[] = {
    {"valley, sun 8 deg ahead", -2000, -4000, 60, 80, 4, 60, 8, 70},
    {"summit, sun 5 deg aside", 3000, 2000, 400, 300, -6, 60, 5, 220},
    {"summit, sun 25 deg ahead", 3000, 2000, 400, 200, -8, 60, 25, 190},
    {"from 30 km, sun 10 deg", -20000, -20000, 30000, 45, -45, 60, 10, 90},
};

TEST_F(ShaftBench, Cost) {
  addCaster(realTerrain(parameters));
  const char* size = std::getenv("ALPENGLOW_BENCH_WIDTH");
  const uint32_t width = size != nullptr ? static_cast<uint32_t>(std::atoi(size)) : 1024;
  std::printf("ms of user CPU at %u x %u\n", width, width * 3 / 4);
  for (const View3& v : kViews) {
    const double ground = terrainAltitude(rays(), parameters, v.east, v.north);
    const SkyDraw d = drawFrom({ground + v.above, v.east, v.north}, v.heading, v.pitch, v.fov,
                               {width, width * 3 / 4}, v.sunElevation, v.sunAzimuth);
    std::printf("%s\n", v.name);
    for (int method = -1; method < 3; ++method) {
      ShaftSetup setup;
      setup.shafts = method >= 0;
      setup.method = static_cast<ShaftMethod>(std::max(method, 0));
      setup.sunMapSize = method == 0 ? 1024 : 2048;
      setup.passes = 2;
      const ShaftPicture p = draw(setup, d);
      const ShaftSeconds& s = p.seconds;
      const char* names[] = {"off", "exact", "paper", "march"};
      double layers = 0.0;
      if (method == 0)
        for (size_t i = 3; i < p.sums.size(); i += 4) layers += std::abs(p.sums[i]);
      std::printf("  %-6s depth %6.1f slice %6.1f sun map %6.1f shafts %6.1f air %6.1f\n",
                  names[method + 1], 1e3 * s.depth, 1e3 * s.slice, 1e3 * s.sunMap, 1e3 * s.shafts,
                  1e3 * s.air);
    }
  }
}

Vector vector(const Vec& v) { return {v[0], v[1], v[2]}; }

/// Per cent of the radiance without shafts, of the worst channel.
struct Errors {
  std::vector<double> values;
  double at(double share) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, size_t(share * double(values.size())))];
  }
};

// The light that shadows keep from a ray, as the picture has it, against the reference; next to an
// edge of the depth image or of the shadows nothing is asked.
TEST_F(ShaftBench, Error) {
  addCaster(realTerrain(parameters));
  const auto medium = makeMediumF64(parameters);
  for (const View3& v : kViews) {
    const double ground = terrainAltitude(rays(), parameters, v.east, v.north);
    const SkyDraw d = drawFrom({ground + v.above, v.east, v.north}, v.heading, v.pitch, v.fov,
                               {256, 192}, v.sunElevation, v.sunAzimuth);
    ShaftSetup setup;
    setup.shafts = false;
    const ShaftPicture off = draw(setup, d);
    struct Wanted {
      uint32_t x, y;
      double loss[3];
    };
    std::vector<Wanted> wanted;
    for (uint32_t y = 3; y < 192; y += 7) {
      for (uint32_t x = 2; x < 256; x += 7) {
        const auto [o, view] = pixelRay(setup, d, x, y);
        const reference::SceneRay ray{vector(o), vector(view), vector(vec(d.sun.direction))};
        const auto hit = rays().closest(ray.position, ray.view, 1e-3, reference::kEndless);
        ProbeQuery query = rayQuery(parameters, d.camera, view, vec(d.sun.direction));
        const auto mu = std::cos(query.viewZenith);
        const auto h = query.altitude_m;
        double length = physics_f64::rayHitsGround(medium, h, mu)
                            ? physics_f64::distanceToGround(medium, h, mu)
                            : physics_f64::distanceToTop(medium, h, mu);
        const bool onSphere = !hit && physics_f64::rayHitsGround(medium, h, mu);
        if (hit) length = std::min(length, hit->t);
        const auto shadow =
            reference::shadowIntervals(rays(), ray.position, ray.view, ray.sun, length);
        // A sphere's pixel in shadow loses the ground's own light too.
        if (onSphere && !shadow.empty() && shadow.back().to > length - 1.0) continue;
        Wanted w{x, y, {}};
        if (!shadow.empty()) {
          const auto lit = reference::litScattering(medium, ray, length, shadow, 1e-5);
          const auto whole = reference::litScattering(medium, ray, length, {}, 1e-5);
          for (int c = 0; c < 3; ++c) w.loss[c] = whole.value[c] - lit.value[c];
        }
        wanted.push_back(w);
      }
    }
    std::printf("%s: %zu rays\n", v.name, wanted.size());
    for (const uint32_t size : {512u, 1024u, 2048u}) {
      for (int method = 0; method < 3; ++method) {
        if (method == 1 && size != 2048) continue;
        for (const uint32_t samples : {16u, 128u}) {
          if (method != 2 && samples != 16) continue;
          if (method == 2 && size != 2048) continue;
          setup.shafts = true;
          setup.method = static_cast<ShaftMethod>(method);
          setup.sunMapSize = size;
          setup.samples = samples;
          const ShaftPicture p = draw(setup, d);
          Errors errors;
          for (const Wanted& w : wanted) {
            double worst = 0.0;
            for (int c = 0; c < 3; ++c) {
              const double total = off.light.at(w.x, w.y)[c];
              const double loss = total - p.light.at(w.x, w.y)[c];
              worst = std::max(worst, 100.0 * std::abs(loss - w.loss[c]) / (total - w.loss[c]));
            }
            errors.values.push_back(worst);
            if (method == 0 && size == 2048 && worst > 2.0 && std::getenv("DUMP")) {
              const auto [o, view] = pixelRay(setup, d, w.x, w.y);
              const auto shadow = reference::shadowIntervals(rays(), vector(o), vector(view),
                                                             vector(vec(d.sun.direction)), 3e5);
              const auto hit = rays().closest(vector(o), vector(view), 1e-3, reference::kEndless);
              std::printf("  (%u,%u) err %.1f count %g hit %.0f shadows:", w.x, w.y, worst,
                          p.sums[4 * (w.y * 256 + w.x) + 3], hit ? hit->t : -1.0);
              for (const auto& i : shadow)
                if (!hit || i.from < hit->t) std::printf(" %.1f-%.1f", i.from, i.to);
              std::printf(" want %.5f got %.5f\n", w.loss[1],
                          off.light.at(w.x, w.y)[1] - p.light.at(w.x, w.y)[1]);
            }
          }
          std::printf(
              "  %s map %u samples %u: median %.3f p90 %.3f p95 %.3f p98 %.2f p99 %.2f max %.1f\n",
              method == 0   ? "exact"
              : method == 1 ? "paper"
                            : "march",
              size, samples, errors.at(0.5), errors.at(0.9), errors.at(0.95), errors.at(0.98),
              errors.at(0.99), errors.at(1.0));
        }
      }
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
