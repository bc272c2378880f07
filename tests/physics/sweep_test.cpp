// Rays through random atmospheres, all that a validated one may be: the physics that the moment
// solver's users run, in float. Nothing may break; how far float is from double there is printed,
// not bounded. The seed is fixed. ALPENGLOW_SWEEP sets the number of atmospheres.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>

#include "direct_light.h"
#include "physics_overloads.h"

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
    q.viewZenith = angle(horizon);
    q.sunZenith = angle(horizon);
    q.azimuth = chance(0.2) ? oneOf({0.0, kPi}) : uniform(0.0, kPi);
    if (chance(0.3)) q.distance_m = thickness * logUniform(1e-6, 1e3);
    return q;
  }

 private:
  static constexpr double kPi = std::numbers::pi;

  double depth(double most) { return chance(0.1) ? 0.0 : logUniform(1e-6, most); }

  // Special angles, the neighbourhood of the horizon, or any.
  double angle(double horizon) {
    if (chance(0.15)) return oneOf({0.0, 0.5 * kPi, kPi, horizon});
    if (chance(0.4)) return std::clamp(horizon + 0.1 * uniform(-1, 1) * uniform(0, 1), 0.0, kPi);
    return std::acos(uniform(-1.0, 1.0));
  }

  std::mt19937 random_;
};

struct Differences {
  std::vector<double> light, transmittance;

  static void print(const char* what, std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
      return 100.0 * values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
    };
    std::printf("%s, float against double: p50 %.2g, p95 %.2g, p99 %.2g, max %.3g %% of %zu\n",
                what, at(0.5), at(0.95), at(0.99), at(1.0), values.size());
  }
};

// Along a ray the light that is scattered towards its beginning without phase functions, the
// integral of T beta_s T_sun, is at most the integral of T (beta_s + beta_a), which is 1 - T: no
// more can be scattered out of a beam than it loses. So their sum is at most what comes in, 1.
bool isSound(const light_f32::DirectLight::Light& light) {
  for (int c = 0; c < 3; ++c) {
    const float t = light.transmittance[c], r = light.rayleigh[c], m = light.mie[c];
    if (!(t >= 0.0f && t <= 1.0f && r >= 0.0f && m >= 0.0f && t + r + m <= 1.02f)) return false;
  }
  return true;
}

std::string describe(const Parameters& p, const ProbeQuery& q) {
  char text[512];
  std::snprintf(
      text, sizeof text,
      "R %.9g, thickness %.9g, H_R %.9g (%d) beta %.3g, H_M %.9g (%d) beta %.3g, g %.3g; h %.9g, "
      "view %.9g, sun %.9g, azimuth %.9g, distance %.9g",
      p.bottomRadius_m, p.topRadius_m - p.bottomRadius_m, p.rayleigh.scaleHeight_m,
      p.rayleigh.present, p.rayleigh.scattering_per_m[0], p.mie.scaleHeight_m, p.mie.present,
      p.mie.extinction_per_m[0], p.mie.asymmetry, q.altitude_m, q.viewZenith, q.sunZenith,
      q.azimuth, q.distance_m);
  return text;
}

// A table of 32 x 16 optical depths each: what is tried here is that nothing breaks.
constexpr MomentSettings kSmall = {32, 16};

// Returns false at the first unsound ray.
bool tryAtmosphere(Sweep* sweep, bool compare, Differences* differences) {
  const Parameters p = sweep->atmosphere();
  char message[320] = "";
  EXPECT_EQ(validate(p, message, sizeof message), Status::Ok) << message;
  BothLights lights(p, kSmall, Quality::Draft);
  for (int i = 0; i < kRays; ++i) {
    const ProbeQuery query = sweep->query(lights.medium);
    const ResolvedQuery resolved = resolveQuery(lights.medium, query);
    if (resolved.empty) continue;
    const BothRays ray = bothRays(resolved.ray, resolved.length);
    const auto length = static_cast<float>(ray.length);
    const auto light = lights.inFloat.along(ray.rounded, length);
    if (!isSound(light)) {
      for (int c = 0; c < 3; ++c)
        ADD_FAILURE() << describe(p, query) << "\n T " << light.transmittance[c] << " scattered "
                      << light.rayleigh[c] << " + " << light.mie[c];
      return false;
    }
    const auto half = lights.inFloat.along(ray.rounded, 0.5f * length);
    for (int c = 0; c < 3; ++c) {
      // Optical depth grows along the ray, to float's digits.
      const double part = -std::log(half.transmittance[c]);
      const double whole = -std::log(light.transmittance[c]);
      if (part <= whole * (1.0 + 1e-5) + 1e-6) continue;
      ADD_FAILURE() << describe(p, query) << "\n optical depth of the half " << part
                    << ", of the whole " << whole;
      return false;
    }
    if (!compare) continue;
    const auto exact = lights.inDouble.along(ray.exact, ray.length);
    for (int c = 0; c < 3; ++c) {
      const double wanted = exact.rayleigh[c] + exact.mie[c];
      const double got = double(light.rayleigh[c]) + double(light.mie[c]);
      differences->light.push_back(std::abs(got - wanted) / std::max(wanted, 1e-6));
      differences->transmittance.push_back(
          std::abs(double(light.transmittance[c]) - exact.transmittance[c]) /
          std::max(exact.transmittance[c], 1e-3));
    }
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
  std::printf("%d atmospheres, %d rays each\n", atmospheres, kRays);
  Differences::print("scattered light", differences.light);
  Differences::print("transmittance", differences.transmittance);
}

}  // namespace
}  // namespace alpenglow::test
