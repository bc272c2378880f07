// The hard cases of rays: single scattering and transmittance in float, as the GPU computes them,
// against the same source in double and against the adaptive quadrature. docs/stability.md has the
// figures that these tests print.
#include <algorithm>
#include <cstdio>
#include <numbers>

#include "atmosphere/reference/optical_depth.h"
#include "atmosphere/reference/single_scattering.h"
#include "direct_light.h"
#include "physics_overloads.h"

namespace alpenglow::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLeastLight = 1e-6;  // Light is relative to itself, or to this.

ProbeQuery query(double altitude_m, double viewZenith_deg, double sunZenith_deg,
                 double azimuth_deg) {
  ProbeQuery result;
  result.altitude_m = altitude_m;
  result.zenith = viewZenith_deg * kDegree;
  result.sunZenith = sunZenith_deg * kDegree;
  result.azimuth = azimuth_deg * kDegree;
  return result;
}

/// Greatest errors of a hard case. Light is relative to itself, or to a millionth of the sun's
/// irradiance; transmittance to itself, or to a thousandth.
struct Errors {
  double rounding = 0.0;       ///< Of light, float against double.
  double quadrature = 0.0;     ///< Of light, double against the reference.
  double transmittance = 0.0;  ///< Float against the reference.

  void print(const char* name) const {
    std::printf("%-34s float %8.4f %%  quadrature %8.4f %%  T %.5f %%\n", name, 100 * rounding,
                100 * quadrature, 100 * transmittance);
  }
};

double relative(double value, double exact, double least) {
  const double error = std::abs(value - exact) / std::max(std::abs(exact), least);
  return std::isfinite(error) ? error : 1e30;  // A NaN is the worst of all.
}

class HardCase {
 public:
  explicit HardCase(const Parameters& parameters) : lights_(parameters) {}

  const physics_f64::Medium& medium() const { return lights_.medium; }

  /// The ray of a query: float against double, and both against the reference.
  void add(const ProbeQuery& query) {
    const ResolvedQuery resolved = resolveQuery(lights_.medium, query);
    if (resolved.empty) return;
    const BothRays ray = bothRays(resolved.ray, resolved.length);
    const light_f64::DirectLight::Light exact = lights_.inDouble.along(ray.exact, ray.length);
    const light_f32::DirectLight::Light light = along(ray);
    const light_f64::Spectrum wanted = lights_.inDouble.radiance(exact, ray.exact.nu);
    const light_f32::Spectrum got = lights_.inFloat.radiance(light, ray.rounded.nu);
    const ProbeAnswer truth =
        reference::singleScattering(lights_.medium, query, reference::kRelativeTolerance).value;
    const auto add = [](double* greatest, double error) { *greatest = std::max(*greatest, error); };
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      const auto c = static_cast<int>(i);
      add(&errors.rounding, relative(got[c], wanted[c], kLeastLight));
      add(&errors.quadrature, relative(wanted[c], truth.skyRadiance[i], kLeastLight));
      add(&errors.transmittance, relative(light.transmittance[c], truth.transmittance[i], 1e-3));
    }
  }

  /// In float, and sound.
  light_f32::DirectLight::Light along(const BothRays& ray) {
    const auto light = lights_.inFloat.along(ray.rounded, static_cast<float>(ray.length));
    EXPECT_TRUE(isSound(light) && isBalanced(light))
        << ray.exact.h << " " << ray.exact.mu << " " << ray.exact.muS;
    return light;
  }

  Errors errors;

 private:
  BothLights lights_;
};

/// Per cent.
void expectBelow(const HardCase& hard, const char* name, double rounding, double quadrature,
                 double transmittance) {
  hard.errors.print(name);
  EXPECT_LE(100 * hard.errors.rounding, rounding) << name;
  EXPECT_LE(100 * hard.errors.quadrature, quadrature) << name;
  EXPECT_LE(100 * hard.errors.transmittance, transmittance) << name;
}

double horizonZenith(const physics_f64::Medium& m, double h) {
  return std::acos(physics_f64::horizonMu(m, h)) / kDegree;
}

/// Each prints its own greatest errors.
constexpr const char* kPresets[] = {"earth", "earth-hazy", "mars"};
constexpr double kSuns[] = {0, 30, 75, 85, 89, 90, 91, 95, 100, 108};
constexpr double kHeights[] = {0.1, 2.0, 1e3, 1e4, 59.9e3};

TEST(HardCases, GrazingRays) {
  for (const char* name : kPresets) {
    HardCase hard(preset(name));
    for (double h : kHeights)
      for (double off : {-0.05, -0.005, 0.0, 0.005, 0.05})
        for (double sun : kSuns)
          for (double azimuth : {0.0, 90.0, 180.0})
            hard.add(query(h, horizonZenith(hard.medium(), h) - off, sun, azimuth));
    expectBelow(hard, (std::string("grazing rays, ") + name).c_str(), 1.5e-3, 1.5, 1.5e-3);
  }
}

TEST(HardCases, TheGroundAndTheTopAndAFloatStepBesideThem) {
  for (const char* name : kPresets) {
    HardCase hard(preset(name));
    const auto thickness = static_cast<float>(hard.medium().thickness);
    for (float h : {0.0f, std::nextafter(0.0f, 1.0f), 1e-30f, 1e-3f,
                    std::nextafter(thickness, 0.0f), thickness, std::nextafter(thickness, 1e9f)})
      for (double view : {0.0, 60.0, 89.999, 90.0, 90.001, 97.0, 120.0, 180.0})
        for (double sun : kSuns) hard.add(query(h, view, sun, 30.0));
    expectBelow(hard, (std::string("r at Rg, Rt and beside, ") + name).c_str(), 7e-4, 0.7, 4e-4);
  }
}

TEST(HardCases, CosinesOfOne) {
  for (const char* name : kPresets) {
    HardCase hard(preset(name));
    for (double h : {0.0, 2.0, 1e4, 6e4, 4e5, 3.6e7})
      for (double view : {0.0, 180.0})
        for (double sun : {0.0, 1e-5, 90.0, 180.0}) hard.add(query(h, view, sun, 0.0));
    expectBelow(hard, (std::string("mu, mu_s, nu at +-1, ") + name).c_str(), 3e-4, 0.5, 2e-5);
  }
}

TEST(HardCases, ViewAtTheSunAndOpposite) {
  for (const char* name : kPresets) {
    HardCase hard(preset(name));
    for (double h : {0.0, 2.0, 1e4, 59.9e3})
      // At the horizon a ray away from the sun lies in the shadow's edge with all its length.
      for (double sun : {0.0, 30.0, 85.0, 89.9, 90.01, 91.0})
        for (double off : {0.0, 1e-6, 1e-3, 0.1}) {
          hard.add(query(h, sun + off, sun, 0.0));
          hard.add(query(h, 180.0 - sun - off, sun, 180.0));
        }
    expectBelow(hard, (std::string("at the sun and opposite, ") + name).c_str(), 1.5e-3, 0.2, 3e-4);
  }
}

TEST(HardCases, ShortSegments) {
  HardCase hard(preset("earth-hazy"));
  for (double h : {0.0, 2.0, 1e3, 2e4})
    for (double length : {1e-3, 1.0, 100.0, 1e4})
      for (double view : {0.0, 89.9, 90.0, 91.0, 150.0})
        for (double sun : {20.0, 85.0, 91.0}) {
          ProbeQuery q = query(h, view, sun, 60.0);
          q.bounded = true;
          q.distance_m = length;
          hard.add(q);
        }
  expectBelow(hard, "segments of 1 mm to 10 km", 6e-4, 0.06, 5e-5);
}

TEST(HardCases, SunAtTheTerminator) {
  for (const char* name : kPresets) {
    HardCase hard(preset(name));
    for (double h : kHeights) {
      const double edge = horizonZenith(hard.medium(), h);
      for (double off : {-1e-3, -1e-6, 0.0, 1e-6, 1e-3})
        for (double view : {0.0, 80.0, 89.0, 93.0})
          for (double azimuth : {0.0, 90.0, 180.0}) hard.add(query(h, view, edge + off, azimuth));
    }
    expectBelow(hard, (std::string("sun at the terminator, ") + name).c_str(), 0.04, 2.2, 1.5e-4);
  }
}

// Towards a sun exactly at the horizon, and exactly away from it, the whole ray lies in the edge of
// the planet's shadow. What is lit of it is for rounding to say; it is no more than all.
TEST(HardCases, RaysInTheShadowsEdge) {
  for (const char* name : kPresets) {
    HardCase hard(preset(name));
    const auto light = [&](double h, double view, double sun, double azimuth) {
      const ResolvedQuery resolved = resolveQuery(hard.medium(), query(h, view, sun, azimuth));
      return hard.along(bothRays(resolved.ray, resolved.length));
    };
    for (double h : {0.0, 1e-3, 2.0, 1e3, 1e4, 59.9e3}) {
      const double edge = horizonZenith(hard.medium(), h), back = 180.0 - edge;
      const auto towards = light(h, edge, edge, 0.0), litTowards = light(h, edge, edge - 0.02, 0.0);
      const auto away = light(h, back, edge, 180.0), litAway = light(h, back, edge - 0.02, 180.0);
      for (int c = 0; c < 3; ++c) {
        EXPECT_LE(towards.rayleigh[c], 1.02f * litTowards.rayleigh[c]) << name << " " << h;
        EXPECT_LE(towards.mie[c], 1.02f * litTowards.mie[c]) << name << " " << h;
        EXPECT_LE(away.rayleigh[c], 1.02f * litAway.rayleigh[c]) << name << " " << h;
        EXPECT_LE(away.mie[c], 1.02f * litAway.mie[c]) << name << " " << h;
      }
    }
  }
}

// Air that does not thin out: the table of optical depths must not end in darkness at the top.
TEST(HardCases, SunNearTheTopOfADenseMedium) {
  Parameters p = preset("earth");
  p.rayleigh.scaleHeight_m = 30e3;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) p.rayleigh.scattering_per_m[i] *= 4.0;
  BothLights lights(p);
  double rounding = 0.0, interpolation = 0.0;
  for (double share : {0.9, 0.97, 0.99, 0.999, 0.99999, 1.0}) {
    const double h = share * lights.medium.thickness;
    for (double off : {-0.01, -1.0, -3.0, -6.0, -30.0, -80.0}) {
      const double muS = std::cos((horizonZenith(lights.medium, h) + off) * kDegree);
      const auto depth = reference::opticalDepthToTop(lights.medium, h, muS, {1e-12, 0.0});
      const light_f64::Spectrum wanted = lights.inDouble.sunlightAt(h, muS);
      const light_f32::Spectrum got =
          lights.inFloat.sunlightAt(static_cast<float>(h), static_cast<float>(muS));
      for (int c = 0; c < 3; ++c) {
        const double exact = std::exp(-depth.value[static_cast<size_t>(c)]);
        rounding = std::max(rounding, relative(got[c], wanted[c], kLeastLight));
        interpolation = std::max(interpolation, relative(wanted[c], exact, kLeastLight));
      }
    }
  }
  std::printf("%-34s float %8.4f %%  table      %8.4f %%\n", "sun near the top of dense air",
              100 * rounding, 100 * interpolation);
  EXPECT_LE(100 * rounding, 0.002);
  EXPECT_LE(100 * interpolation, 0.1);
}

/// Rays in all directions from some heights, in units of the thickness.
void addAllAround(HardCase* hard) {
  const double thickness = hard->medium().thickness;
  for (double share : {0.0, 1e-4, 0.1, 0.9, 20.0}) {
    const double horizon = horizonZenith(hard->medium(), share * thickness);
    for (double view : {0.0, 70.0, horizon - 0.05, horizon + 0.05, 170.0, 180.0})
      for (double sun : {0.0, 60.0, 89.0, 93.0})
        for (double azimuth : {0.0, 120.0}) hard->add(query(share * thickness, view, sun, azimuth));
  }
}

void expectAllAround(const Parameters& parameters, const char* name, double rounding,
                     double quadrature, double transmittance) {
  HardCase hard(parameters);
  addAllAround(&hard);
  expectBelow(hard, name, rounding, quadrature, transmittance);
}

TEST(HardCases, NarrowPeaks) {
  for (double g : {0.99, -0.99}) {
    Parameters p = preset("earth");
    p.mie.asymmetry = g;
    HardCase hard(p);
    addAllAround(&hard);
    for (double off : {0.0, 0.01, 0.3, 3.0}) {
      hard.add(query(2.0, 60.0 + off, 60.0, 0.0));
      hard.add(query(2.0, 180.0 - 91.0 - off, 91.0, 180.0));
    }
    expectBelow(hard, g > 0 ? "g = 0.99" : "g = -0.99", 0.06, 0.7, 7e-4);
  }
}

TEST(HardCases, ScaleHeights) {
  for (double height : {100.0, 50e3}) {
    Parameters p = preset("earth");
    p.rayleigh.scaleHeight_m = p.mie.scaleHeight_m = height;
    // The same columns as before.
    const double molecules = std::min(8000.0 / height, 80.0), aerosols = 1200.0 / height;
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      p.rayleigh.scattering_per_m[i] *= molecules;
      p.mie.scattering_per_m[i] *= aerosols;
      p.mie.extinction_per_m[i] *= aerosols;
    }
    if (height < 1e3) {
      expectAllAround(p, "scale heights of 100 m", 0.006, 2.2, 0.025);
    } else {
      expectAllAround(p, "scale heights of 50 km", 4e-4, 0.55, 1e-4);
    }
  }
}

TEST(HardCases, OpticalDepths) {
  for (double depth : {0.0, 1e-6, 50.0}) {
    Parameters p = preset("earth-fig6");
    p.mie.present = depth > 0.0;
    p.rayleigh.present = depth > 0.0;
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      p.rayleigh.scattering_per_m[i] = 0.5 * depth / p.rayleigh.scaleHeight_m;
      p.mie.scattering_per_m[i] = 0.45 * depth / p.mie.scaleHeight_m;
      p.mie.extinction_per_m[i] = 0.5 * depth / p.mie.scaleHeight_m;
    }
    char name[64];
    std::snprintf(name, sizeof name, "optical depth %g", depth);
    expectAllAround(p, name, 1.5e-3, depth > 1.0 ? 12 : 0.007, 1e-5);
  }
}

TEST(HardCases, Planets) {
  for (double radius : {10e3, 1e8}) {
    Parameters p = earthOfRadius(radius);
    if (radius < 1e6) {
      expectAllAround(p, "planet of 10 km", 1e-3, 0.025, 4e-4);
    } else {
      expectAllAround(p, "planet of 100,000 km", 1.5e-3, 3, 1.2e-3);
    }
  }
  // Its air as thin as its size.
  Parameters p = preset("earth");
  p.bottomRadius_m = 10e3;
  p.topRadius_m = 10.1e3;
  p.rayleigh.scaleHeight_m = 13.0;
  p.mie.scaleHeight_m = 2.0;
  p.absorption.present = false;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    p.rayleigh.scattering_per_m[i] *= 600.0;
    p.mie.scattering_per_m[i] *= 600.0;
    p.mie.extinction_per_m[i] *= 600.0;
  }
  expectAllAround(p, "planet of 10 km, air of 100 m", 5e-4, 0.13, 1.1e-3);
}

}  // namespace
}  // namespace alpenglow::test
