// Rays through random atmospheres: the physics that the moment solver's users run, in float.
// Nothing may break; how far float is from double, and double from the truth, is printed. The seeds
// are fixed. ALPENGLOW_SWEEP sets the number of atmospheres.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <random>

#include "atmosphere/parameters/limits.h"
#include "atmosphere/reference/single_scattering.h"
#include "direct_light.h"
#include "physics_overloads.h"

#include "tests/parameters/heard.h"

namespace alpenglow::test {
namespace {

constexpr int kRays = 100;

class Sweep {
 public:
  explicit Sweep(uint32_t seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double logUniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  template <size_t N>
  double oneOf(const double (&values)[N]) {
    return values[std::uniform_int_distribution<size_t>(0, N - 1)(random_)];
  }

  /// Anything that the validator lets pass.
  Parameters anyValid() {
    constexpr double kRoom = parameters::kMaxRadius_m, kMost = parameters::kMaxLength_m;
    Parameters p = atmosphere();
    p.bottomRadius_m = logUniform(parameters::kMinRadius_m, 0.999 * kRoom);
    p.topRadius_m =
        p.bottomRadius_m + logUniform(parameters::kMinThickness_m, kRoom - p.bottomRadius_m);
    p.topRadius_m =
        std::clamp(p.topRadius_m, p.bottomRadius_m + parameters::kMinThickness_m, kRoom);
    p.rayleigh.scaleHeight_m = logUniform(parameters::kMinLength_m, kMost);
    p.mie.scaleHeight_m = logUniform(parameters::kMinLength_m, kMost);
    p.mie.asymmetry = uniform(-parameters::kMaxAsymmetry, parameters::kMaxAsymmetry);
    p.absorption.center_m = chance(0.2) ? 0.0 : logUniform(1.0, kMost);
    p.absorption.halfWidth_m = logUniform(parameters::kMinLength_m, kMost);
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      p.rayleigh.scattering_per_m[i] = coefficient();
      p.mie.extinction_per_m[i] = coefficient();
      p.mie.scattering_per_m[i] = p.mie.extinction_per_m[i] * uniform(0.0, 1.0);
      p.absorption.extinction_per_m[i] = coefficient();
    }
    p.sunAngularRadius = chance(0.5) ? 0.0 : uniform(0.0, 0.17);
    return p;
  }

  /// An atmosphere that float can hold: see `least`.
  Parameters atmosphere() {
    Parameters p = preset("earth");
    p.bottomRadius_m = logUniform(1e4, 1e8);
    const double thickness = logUniform(1e2, 1e6);
    p.topRadius_m = p.bottomRadius_m + thickness;
    // Zenith optical depths to 50, scale heights of a thousandth to all of the shell; but no less
    // than some steps of a float at the planet's radius (6 m on Earth), as altitudes along a ray
    // that grazes the ground come from there.
    const double least = std::max(1.0, 1e-6 * p.bottomRadius_m);
    p.rayleigh.present = chance(0.85);
    p.rayleigh.scaleHeight_m = std::max(least, thickness * logUniform(1e-3, 1.0));
    p.mie.present = chance(0.85);
    p.mie.scaleHeight_m = std::max(least, thickness * logUniform(1e-3, 1.0));
    p.mie.asymmetry = chance(0.1) ? oneOf({0.99, -0.99, 0.0}) : uniform(-0.99, 0.99);
    p.absorption.present = chance(0.5);
    p.absorption.center_m = uniform(0.0, thickness);
    p.absorption.halfWidth_m = std::max(1.0, thickness * logUniform(1e-2, 1.0));
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      p.rayleigh.scattering_per_m[i] = std::min(depth(25.0) / p.rayleigh.scaleHeight_m, 1.0);
      const double extinction = std::min(depth(25.0) / p.mie.scaleHeight_m, 1.0);
      p.mie.extinction_per_m[i] = extinction;
      p.mie.scattering_per_m[i] = extinction * (chance(0.2) ? 1.0 : uniform(0.0, 1.0));
      p.absorption.extinction_per_m[i] = std::min(depth(10.0) / p.absorption.halfWidth_m, 1.0);
      p.groundAlbedo[i] = uniform(0.0, 1.0);
    }
    p.sunAngularRadius = chance(0.5) ? 0.0 : uniform(0.0, 0.02);
    return p;
  }

  ProbeQuery query(const physics_f64::Medium& m) {
    ProbeQuery q;
    const double thickness = m.thickness;
    q.altitude_m = chance(0.1)   ? oneOf({0.0, 1.0, thickness, std::nextafter(thickness, 0.0),
                                          std::nextafter(thickness, 1e9), 1e10})
                   : chance(0.8) ? thickness * logUniform(1e-6, 1.0)
                                 : thickness * logUniform(1.0, 1e4);
    const double horizon = std::acos(std::max(-1.0, physics_f64::horizonMu(m, q.altitude_m)));
    q.zenith = angle(horizon);
    q.sunZenith = angle(horizon);
    q.azimuth = chance(0.2) ? oneOf({0.0, kPi}) : uniform(0.0, kPi);
    q.bounded = chance(0.3);
    if (q.bounded) q.distance_m = thickness * logUniform(1e-6, 1e3);
    return q;
  }

 private:
  static constexpr double kPi = std::numbers::pi;

  double coefficient() {
    return chance(0.1) ? 0.0 : logUniform(1e-12, parameters::kMaxCoefficient_per_m);
  }

  double depth(double most) { return chance(0.1) ? 0.0 : logUniform(1e-6, most); }

  // Special angles, the neighbourhood of the horizon, or any.
  double angle(double horizon) {
    if (chance(0.15)) return oneOf({0.0, 0.5 * kPi, kPi, horizon});
    if (chance(0.4)) return std::clamp(horizon + 0.1 * uniform(-1, 1) * uniform(0, 1), 0.0, kPi);
    return std::acos(uniform(-1.0, 1.0));
  }

  std::mt19937 random_;
};

/// Prints shares of some values in per cent, and returns the one above which a thousandth lies.
double printShares(const char* what, std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return 100.0 * values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
  };
  std::printf("%-34s p50 %.2g, p95 %.2g, p99 %.2g, p99.9 %.2g, max %.3g %% of %zu\n", what, at(0.5),
              at(0.95), at(0.99), at(0.999), at(1.0), values.size());
  return at(0.999);
}

struct Differences {
  std::vector<double> light, sunLine, transmittance;
};

std::string describe(const Parameters& p, const ProbeQuery& q) {
  char text[512];
  std::snprintf(
      text, sizeof text,
      "R %.9g, thickness %.9g, H_R %.9g (%d) beta %.3g, H_M %.9g (%d) beta %.3g, g %.3g; h %.9g, "
      "view %.9g, sun %.9g, azimuth %.9g, distance %.9g",
      p.bottomRadius_m, p.topRadius_m - p.bottomRadius_m, p.rayleigh.scaleHeight_m,
      p.rayleigh.present, p.rayleigh.scattering_per_m[0], p.mie.scaleHeight_m, p.mie.present,
      p.mie.extinction_per_m[0], p.mie.asymmetry, q.altitude_m, q.zenith, q.sunZenith, q.azimuth,
      q.distance_m);
  return text;
}

// A table of 32 x 16 optical depths each: what is tried here is that nothing breaks.
constexpr TableSizes kSmall = {32, 16};

// Altitudes along a ray have steps of some 1e-7 of the radius, and optical depths follow.
double depthTolerance(const physics_f64::Medium& m) {
  const double least = std::min(m.rayleighScaleHeight, m.mieScaleHeight);
  return 1e-5 + 4.0 * 6e-8 * (m.bottomRadius + m.thickness) / least;
}

// Optical depth grows along the ray, to float's digits.
bool depthGrows(Sweep* sweep, const physics_f64::Medium& medium,
                const light_f32::DirectLight& lights, const BothRays& ray) {
  const auto depth = [&](double share) {
    return physics_f32::opticalDepthOfSegment(lights.medium(), ray.rounded.h, ray.rounded.mu,
                                              static_cast<float>(share * ray.length));
  };
  const double share = sweep->uniform(0.0, 1.0);
  const auto near = depth(share * sweep->uniform(0.0, 1.0)), far = depth(share);
  const double most = 1.0 + depthTolerance(medium);
  for (int c = 0; c < 3; ++c)
    if (!(double(near[c]) <= double(far[c]) * most + 1e-6)) return false;
  return true;
}

void compare(light_f64::DirectLight* lights, const BothRays& ray,
             const light_f32::DirectLight::Light& light, Differences* differences) {
  const auto exact = lights->along(ray.exact, ray.length);
  // Within two degrees of the line through the sun a ray may lie in the edge of the planet's shadow
  // with all its length.
  const bool sunLine = std::abs(ray.exact.nu) > 0.9995;
  for (int c = 0; c < 3; ++c) {
    const double wanted = exact.rayleigh[c] + exact.mie[c];
    const double got = double(light.rayleigh[c]) + double(light.mie[c]);
    (sunLine ? differences->sunLine : differences->light)
        .push_back(std::abs(got - wanted) / std::max(wanted, 1e-6));
    differences->transmittance.push_back(
        std::abs(double(light.transmittance[c]) - exact.transmittance[c]) /
        std::max(exact.transmittance[c], 1e-3));
  }
}

// Returns false at the first unsound ray.
bool tryAtmosphere(Sweep* sweep, bool compared, Differences* differences) {
  const Parameters p = sweep->atmosphere();
  testing::Heard heard;
  EXPECT_EQ(validate(p, heard.sink()), Status::Ok) << heard.sentence;
  const physics_f64::Medium medium = makeMediumF64(p);
  light_f32::DirectLight lights = lightsInFloat(p, kSmall);
  std::optional<light_f64::DirectLight> exact;
  if (compared) exact = lightsInDouble(p, kSmall);
  for (int i = 0; i < kRays; ++i) {
    const ProbeQuery query = sweep->query(medium);
    const ResolvedQuery resolved = resolveQuery(medium, query);
    if (resolved.empty) continue;
    const BothRays ray = bothRays(resolved.ray, resolved.length);
    const auto light = lights.along(ray.rounded, static_cast<float>(ray.length));
    if (!isSound(light) || !isBalanced(light)) {
      for (int c = 0; c < 3; ++c)
        ADD_FAILURE() << describe(p, query) << "\n T " << light.transmittance[c] << " scattered "
                      << light.rayleigh[c] << " + " << light.mie[c];
      return false;
    }
    if (!depthGrows(sweep, medium, lights, ray)) {
      ADD_FAILURE() << describe(p, query) << "\n optical depth falls along the ray";
      return false;
    }
    if (compared) compare(&*exact, ray, light, differences);
  }
  return true;
}

TEST(Sweep, RandomAtmospheresStaySound) {
  const char* given = std::getenv("ALPENGLOW_SWEEP");
  const int atmospheres = given != nullptr ? std::max(std::atoi(given), 1) : 10'000;
  Sweep sweep(20080917);
  Differences differences;
  int bad = 0;
  for (int i = 0; i < atmospheres && bad < 10; ++i)
    bad += tryAtmosphere(&sweep, i % 20 == 0, &differences) ? 0 : 1;
  std::printf("%d atmospheres, %d rays each; float against double:\n", atmospheres, kRays);
  const double light = printShares("scattered light", differences.light);
  printShares("along the line through the sun", differences.sunLine);
  const double transmittance = printShares("transmittance", differences.transmittance);
  // The extremes are published; that a ray in a thousand comes near them would be a fault.
  EXPECT_LE(light, 0.01);
  EXPECT_LE(transmittance, 0.015);
}

// No balance here: a shell of a million scale heights, or of a thousand radii, has no altitudes
// left in float near its ground.
TEST(Sweep, AnythingValidIsFinite) {
  Sweep sweep(6420);
  for (int i = 0; i < 1000; ++i) {
    const Parameters p = sweep.anyValid();
    testing::Heard heard;
    ASSERT_EQ(validate(p, heard.sink()), Status::Ok) << heard.sentence;
    const physics_f64::Medium medium = makeMediumF64(p);
    light_f32::DirectLight lights = lightsInFloat(p, kSmall);
    for (int k = 0; k < kRays; ++k) {
      const ProbeQuery query = sweep.query(medium);
      const ResolvedQuery resolved = resolveQuery(medium, query);
      if (resolved.empty) continue;
      const BothRays ray = bothRays(resolved.ray, resolved.length);
      const auto light = lights.along(ray.rounded, static_cast<float>(ray.length));
      const auto radiance = lights.radiance(light, ray.rounded.nu);
      ASSERT_TRUE(isSound(light)) << describe(p, query);
      for (int c = 0; c < 3; ++c)
        ASSERT_TRUE(radiance[c] >= 0.0f && std::isfinite(radiance[c])) << describe(p, query);
    }
  }
}

// What the default quality's panels and table of optical depths cost at the extremes.
TEST(Sweep, AgainstTheTruth) {
  Sweep sweep(8);
  std::vector<double> light, transmittance;
  for (int i = 0; i < 60; ++i) {
    const Parameters p = sweep.atmosphere();
    const physics_f64::Medium medium = makeMediumF64(p);
    light_f64::DirectLight direct = lightsInDouble(p);
    for (int k = 0; k < 20; ++k) {
      const ProbeQuery query = sweep.query(medium);
      const ResolvedQuery resolved = resolveQuery(medium, query);
      if (resolved.empty) continue;
      const auto got = direct.along(resolved.ray, resolved.length);
      const auto radiance = direct.radiance(got, resolved.ray.nu);
      const ProbeAnswer truth = reference::singleScattering(medium, query, 1e-6).value;
      for (uint32_t c = 0; c < kSpectrumSize; ++c) {
        const auto at = static_cast<int>(c);
        light.push_back(std::abs(radiance[at] - truth.skyRadiance[c]) /
                        std::max(truth.skyRadiance[c], 1e-6));
        transmittance.push_back(std::abs(got.transmittance[at] - truth.transmittance[c]) /
                                std::max(truth.transmittance[c], 1e-3));
      }
    }
  }
  std::printf("default quality against the truth:\n");
  printShares("radiance", light);
  EXPECT_LE(printShares("transmittance", transmittance), 0.002);
}

}  // namespace
}  // namespace alpenglow::test
