// The reference against an evaluation that shares nothing with it: vectors instead of cosines, its
// own densities, phase functions and shadow, and Simpson's rule with 100,000 intervals.
#include <alpenglow/reference/reference.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "test_atmospheres.h"

namespace alpenglow {
namespace {

using namespace test;

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector along(const Vector& p, const Vector& d, double t) {
  return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
}

class BruteForce {
 public:
  explicit BruteForce(const Parameters& parameters) : p_(parameters) {}

  struct Answer {
    Spectrum transmittance, sky;
  };

  Answer evaluate(const ProbeQuery& q) const {
    const double sinView = std::sin(q.zenith), sinSun = std::sin(q.sunZenith);
    const Vector eye = {0, 0, p_.bottomRadius_m + q.altitude_m};
    const Vector view = {sinView, 0, std::cos(q.zenith)};
    const Vector sun = {sinSun * std::cos(q.azimuth), sinSun * std::sin(q.azimuth),
                        std::cos(q.sunZenith)};
    const std::array<double, 2> air = insideSphere(eye, view, p_.topRadius_m);
    const std::array<double, 2> ground = insideSphere(eye, view, p_.bottomRadius_m);
    const double start = std::max(air[0], 0.0);
    const double end = ground[0] < ground[1] && ground[0] > 0 ? ground[0] : air[1];
    Sums sums;
    const double edge = shadowEdge(eye, view, sun, start, end);
    for (const auto& [from, to] : {std::pair(start, edge), std::pair(edge, end)}) {
      if (to > from) {
        const bool lit = !inShadow(along(eye, view, 0.5 * (from + to)), sun);
        integrate(eye, view, sun, from, to, lit, sums);
      }
    }
    return phased(sums, dot(view, sun));
  }

 private:
  /// Distances at which a line enters and leaves a sphere about the origin; equal if it misses.
  static std::array<double, 2> insideSphere(const Vector& p, const Vector& d, double radius) {
    const double b = dot(p, d);
    const Vector nearest = along(p, d, -b);
    const double h2 = radius * radius - dot(nearest, nearest);
    const double half = h2 > 0 ? std::sqrt(h2) : 0;
    return {-b - half, -b + half};
  }

  Spectrum extinctionAt(const Vector& p) const {
    const double h = std::sqrt(dot(p, p)) - p_.bottomRadius_m;
    Spectrum result;
    const double air = std::exp(-h / p_.rayleigh.scaleHeight_m);
    const double dust = std::exp(-h / p_.mie.scaleHeight_m);
    const double ozone =
        p_.absorption.present
            ? std::max(0.0, 1 - std::abs(h - p_.absorption.center_m) / p_.absorption.halfWidth_m)
            : 0.0;
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      result[i] = p_.rayleigh.scattering_per_m[i] * air + p_.mie.extinction_per_m[i] * dust +
                  p_.absorption.extinction_per_m[i] * ozone;
    }
    return result;
  }

  /// Optical depth from p along d, with samples that crowd at p or at the lowest point.
  Spectrum depthToSun(const Vector& p, const Vector& d) const {
    const double end = insideSphere(p, d, p_.topRadius_m)[1];
    const double lowest = std::clamp(-dot(p, d), 0.0, end);
    Spectrum sum;
    for (double side : {-lowest, end - lowest}) {
      constexpr int kIntervals = 400;
      for (int i = 0; i <= kIntervals && side != 0; ++i) {
        const double x = static_cast<double>(i) / kIntervals;  // t = lowest + side x^2
        const double weight = (i == 0 || i == kIntervals ? 1
                               : i % 2 == 1              ? 4
                                                         : 2) /
                              3.0 / kIntervals;
        const Spectrum e = extinctionAt(along(p, d, lowest + side * x * x));
        for (uint32_t c = 0; c < kSpectrumSize; ++c) {
          sum[c] += weight * 2 * x * std::abs(side) * e[c];
        }
      }
    }
    return sum;
  }

  bool inShadow(const Vector& p, const Vector& sun) const {
    const double toSun = dot(p, sun);
    return toSun < 0 && dot(p, p) - toSun * toSun < p_.bottomRadius_m * p_.bottomRadius_m;
  }

  /// Where the ray passes the shadow's edge, or its end. The cases here pass it once at most.
  double shadowEdge(const Vector& eye, const Vector& view, const Vector& sun, double start,
                    double end) const {
    const bool first = inShadow(along(eye, view, start + 1e-6), sun);
    constexpr int kSamples = 1000;
    for (int i = 1; i <= kSamples; ++i) {
      double low = start + (end - start) * (i - 1) / kSamples;
      double high = start + (end - start) * i / kSamples;
      if (inShadow(along(eye, view, high), sun) != first) {
        for (int k = 0; k < 60; ++k) {
          const double middle = 0.5 * (low + high);
          (inShadow(along(eye, view, middle), sun) == first ? low : high) = middle;
        }
        return low;
      }
    }
    return end;
  }

  /// Optical depth so far, and scattered light without phase functions.
  struct Sums {
    Spectrum depth, rayleigh, mie;
  };

  void integrate(const Vector& eye, const Vector& view, const Vector& sun, double start, double end,
                 bool lit, Sums& sums) const {
    constexpr int kIntervals = 100000;
    const double step = (end - start) / kIntervals;
    Spectrum before = extinctionAt(along(eye, view, start));
    for (int i = 0; i <= kIntervals; ++i) {
      const Vector p = along(eye, view, start + i * step);
      const Spectrum here = extinctionAt(p);
      if (i > 0) {
        const Spectrum middle = extinctionAt(along(eye, view, start + (i - 0.5) * step));
        for (uint32_t c = 0; c < kSpectrumSize; ++c) {
          sums.depth[c] += step / 6 * (before[c] + 4 * middle[c] + here[c]);
        }
      }
      before = here;
      if (!lit) {
        continue;
      }
      const double weight = (i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2) * step / 3;
      const Spectrum toSun = depthToSun(p, sun);
      const double h = std::sqrt(dot(p, p)) - p_.bottomRadius_m;
      for (uint32_t c = 0; c < kSpectrumSize; ++c) {
        const double light = weight * std::exp(-sums.depth[c] - toSun[c]);
        sums.rayleigh[c] += light * std::exp(-h / p_.rayleigh.scaleHeight_m);
        sums.mie[c] += light * std::exp(-h / p_.mie.scaleHeight_m);
      }
    }
  }

  Answer phased(const Sums& sums, double nu) const {
    const double g = p_.mie.asymmetry, pi = std::numbers::pi;
    const double phaseR = 3 / (16 * pi) * (1 + nu * nu);
    const double phaseM = 3 / (8 * pi) * (1 - g * g) * (1 + nu * nu) /
                          ((2 + g * g) * std::pow(1 + g * g - 2 * g * nu, 1.5));
    Answer answer;
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      answer.transmittance[c] = std::exp(-sums.depth[c]);
      answer.sky[c] = phaseR * p_.rayleigh.scattering_per_m[c] * sums.rayleigh[c] +
                      phaseM * p_.mie.scattering_per_m[c] * sums.mie[c];
    }
    return answer;
  }

  Parameters p_;
};

struct BruteForceCase {
  const char* preset;
  ProbeQuery query;
  double
      tolerance;  // Of Simpson's rule: kinks of the ozone tent on the way to the sun cost digits.
};

class ReferenceAgainstBruteForce : public testing::TestWithParam<int> {};

const std::vector<BruteForceCase>& bruteForceCases() {
  static const std::vector<BruteForceCase> cases = {
      {"earth", rayQuery(2, 30, 60, 20), 1e-7},
      {"earth", rayQuery(9000, 92.5, 85, 10), 1e-7},     // Dips below 3 km, leaves again.
      {"earth-fig6", rayQuery(2, 89.5, 88, 150), 1e-7},  // Along the horizon, low sun behind.
      {"mars", rayQuery(36e6, 176, 40, 0), 1e-7},        // From space onto the ground.
      {"earth", rayQuery(2, 60, 96, 170), 1e-5},         // Twilight: leaves the shadow on the way.
      {"earth-fig6", rayQuery(400e3, 109.2, 97, 0), 1e-7},  // Limb, across the terminator.
  };
  return cases;
}

TEST_P(ReferenceAgainstBruteForce, Agrees) {
  const BruteForceCase& c = bruteForceCases()[static_cast<size_t>(GetParam())];
  const Parameters p = preset(c.preset);
  ReferenceAnswer reference;
  ASSERT_EQ(referenceSingleScattering(p, c.query, &reference, {}), Status::Ok);
  const BruteForce::Answer brute = BruteForce(p).evaluate(c.query);
  ASSERT_GT(brute.sky[0], 0.0);
  expectClose(reference.value.transmittance, brute.transmittance, 1e-8, "transmittance");
  expectClose(reference.value.skyRadiance, brute.sky, c.tolerance, "sky");
}

INSTANTIATE_TEST_SUITE_P(Rays, ReferenceAgainstBruteForce, testing::Range(0, 6));

}  // namespace
}  // namespace alpenglow
