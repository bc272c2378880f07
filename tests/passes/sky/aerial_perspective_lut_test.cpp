// The aerial-perspective LUT against the integrals that it stands for, at all distances: single and
// multiple scattering and optical depth, from the ground to space, by day and in twilight.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/passes/sky/aerial_perspective_fixture.h"
#include "tests/passes/sky/steps.h"

namespace alpenglow::testing {
namespace {

constexpr double kSunAzimuth = 0.5;
constexpr double kSuns[] = {50.0, 10.0, 3.0, -3.0};

struct Place {
  const char* name;
  double altitude;
};
constexpr Place kPlaces[] = {
    {"2 m", 2.0}, {"1500 m", 1500.0}, {"10 km", 1e4}, {"30 km", 3e4}, {"400 km", 4e5}};

double percent(std::vector<double>* errors, double share) {
  if (errors->empty()) return 0.0;
  const auto k = static_cast<std::ptrdiff_t>(share * double(errors->size() - 1));
  std::nth_element(errors->begin(), errors->begin() + k, errors->end());
  return 100.0 * (*errors)[static_cast<size_t>(k)];
}

/// Of what arrives from a segment, the worst channel, relative to ...
struct AerialErrors {
  std::vector<double> own;     ///< the segment itself, of at least 100 m
  std::vector<double> scene;   ///< the segment or a thousandth of the brightest ray
  std::vector<double> single;  ///< its single scattering, or a hundredth of the segment
  std::vector<double> depth;   ///< of its transmittance
};

class AerialPerspectiveLutTest : public AerialPerspectiveTest {
 protected:
  FrameState drawOf(double altitude, double elevation) {
    double sun[3];
    sunDirection(0.0, 0.0, radians(elevation), kSunAzimuth, sun);
    return makeDraw(
        cameraFromGeodetic(preset("earth"), 0.0, 0.0, altitude, 0.0, 0.0, 0.0, radians(60.0)),
        vec(sun), {64, 64});
  }

  /// A unit vector at an elevation and an azimuth from the sun.
  static AerialQuery query(double elevation, double azimuth, double inside) {
    AerialQuery q;
    double v[3];
    sunDirection(0.0, 0.0, elevation, kSunAzimuth + azimuth, v);
    for (size_t i = 0; i < 3; ++i) q.direction[i] = static_cast<float>(v[i]);
    q.inside = static_cast<float>(inside);
    return q;
  }

  /// Elevations that meet the atmosphere: all around, within 0.2 degrees of the horizon, about the
  /// sun.
  std::vector<AerialQuery> queriesOf(double altitude, double elevation) {
    const Parameters earth = preset("earth");
    const double dip = horizonDip(earth, altitude);
    const double r = earth.bottomRadius_m + altitude;
    const double top = r > earth.topRadius_m ? -std::acos(earth.topRadius_m / r) : 0.5 * kPi;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<AerialQuery> queries;
    for (int i = 0; i < 600; ++i) {
      const double azimuth = 2.0 * kPi * unit(random);
      double e = -dip + radians(0.4) * (unit(random) - 0.5);
      if (i % 3 == 1) {
        const double share = std::pow(unit(random), 2.0);
        e = i % 2 != 0 ? -dip + (top + dip) * share : -dip - (0.5 * kPi - dip) * share;
      }
      double a = azimuth;
      if (i % 3 == 2) {
        const double off = radians(6.0) * unit(random);
        e = std::clamp(radians(elevation) + off * std::cos(azimuth), -dip - radians(4.0), top);
        a = off * std::sin(azimuth);
      }
      e = std::clamp(e, -0.5 * kPi, top);
      for (int k = 0; k < 12; ++k)
        queries.push_back(query(e, a, 10.0 * std::pow(2e5, unit(random))));
      for (int k = 0; k < 6; ++k) queries.push_back(query(e, a, -unit(random)));
      queries.push_back(query(e, a, -1.0));
    }
    return queries;
  }

  static AerialErrors errorsOf(const std::vector<AerialAnswer>& answers) {
    double brightest = 0.0;
    for (const AerialAnswer& a : answers)
      for (int c = 0; c < 3; ++c)
        brightest = std::max(brightest, double(a.wantedSingle[c]) + double(a.wantedMultiple[c]));
    AerialErrors errors;
    for (const AerialAnswer& a : answers) {
      if (a.inAtmosphere == 0.0f || a.inside <= 0.0f) continue;
      double own = 0.0, scene = 0.0, single = 0.0, depth = 0.0;
      for (int c = 0; c < 3; ++c) {
        const double wanted = double(a.wantedSingle[c]) + double(a.wantedMultiple[c]);
        const double off = std::abs(double(a.single[c]) + double(a.multiple[c]) - wanted);
        own = std::max(own, off / std::max(wanted, 1e-12));
        scene = std::max(scene, off / std::max(wanted, 1e-3 * brightest));
        single = std::max(single, std::abs(double(a.single[c]) - double(a.wantedSingle[c])) /
                                      std::max(double(a.wantedSingle[c]), 1e-2 * wanted + 1e-12));
        depth = std::max(
            depth, std::abs(std::exp(-double(a.depth[c])) - std::exp(-double(a.wantedDepth[c]))) /
                       std::max(std::exp(-double(a.wantedDepth[c])), 1e-3));
      }
      if (a.inside >= 100.0f) {
        errors.own.push_back(own);
        errors.single.push_back(single);
      }
      errors.scene.push_back(scene);
      errors.depth.push_back(depth);
    }
    return errors;
  }

  static std::string badAnswer(const std::vector<AerialAnswer>& answers) {
    for (size_t i = 0; i < answers.size(); ++i) {
      const AerialAnswer& a = answers[i];
      for (int c = 0; c < 3; ++c)
        for (const float value : {a.single[c], a.multiple[c], a.depth[c], a.singleAlone[c]})
          if (!(std::isfinite(value) && value >= 0.0f))
            return "query " + std::to_string(i) + ": " + std::to_string(value);
    }
    return "";
  }
};

// By day and under a low sun the goal is 0.3 % (p95) and 1 % (p99) of what a segment sends. In
// twilight, and from space, where the terminator is in view and segments of the thin atmosphere are
// almost dark, it is missed: there errors count against a thousandth of the brightest ray.
TEST_F(AerialPerspectiveLutTest, MatchesIntegrationAtAllDistances) {
  std::printf("%u bytes\n", static_cast<unsigned>(volume()->lut().bytes()));
  std::printf("per cent, p95 p99 max: own segment (>= 100 m) | scene | single | transmittance\n");
  for (const Place& place : kPlaces) {
    for (const double sun : kSuns) {
      const FrameState draw = drawOf(place.altitude, sun);
      fill(draw);
      const std::vector<AerialAnswer> answers = ask(draw, queriesOf(place.altitude, sun));
      EXPECT_EQ(badAnswer(answers), "") << place.name << ", sun " << sun;
      AerialErrors e = errorsOf(answers);
      std::printf("%7s, sun %3.0f: ", place.name, sun);
      for (std::vector<double>* one : {&e.own, &e.scene, &e.single, &e.depth})
        std::printf("%6.3f %6.3f %6.2f | ", percent(one, 0.95), percent(one, 0.99),
                    percent(one, 1.0));
      std::printf("%zu\n", e.own.size());
      const bool space = place.altitude > 1e5;
      std::vector<double>* const counted = space || sun < 0.0 ? &e.scene : &e.own;
      EXPECT_LT(percent(counted, 0.95), space ? 1.0 : sun < 0.0 ? 0.6 : 0.3) << place.name << sun;
      EXPECT_LT(percent(counted, 0.99), space ? 2.0 : sun < 0.0 ? 1.3 : 1.0) << place.name << sun;
      EXPECT_LT(percent(&e.depth, 0.99), 5.0) << place.name << ", sun " << sun;
    }
  }
}

// What a segment of a ray sends is the difference of two lookups; and the short one is the long
// one's.
TEST_F(AerialPerspectiveLutTest, DifferencesAreThoseOfSegments) {
  for (const Place& place : kPlaces) {
    const FrameState draw = drawOf(place.altitude, 10.0);
    fill(draw);
    const double dip = horizonDip(preset("earth"), place.altitude);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<AerialQuery> queries;
    for (int i = 0; i < 4000; ++i) {
      const double e = -dip + radians(20.0) * (unit(random) - (place.altitude > 1e5 ? 1.0 : 0.5));
      const double azimuth = 2.0 * kPi * unit(random), share = unit(random);
      queries.push_back(query(std::max(e, -0.5 * kPi), azimuth, -share));
      queries.push_back(
          query(std::max(e, -0.5 * kPi), azimuth, -share * (0.5 + 0.5 * unit(random))));
    }
    const std::vector<AerialAnswer> answers = ask(draw, queries);
    std::vector<double> errors;
    for (size_t i = 0; i < answers.size(); i += 2) {
      const AerialAnswer &far = answers[i], &near = answers[i + 1];
      double error = 0.0;
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(far.singleAlone[c], far.single[c]);
        const double wanted = double(far.wantedSingle[c]) - double(near.wantedSingle[c]);
        const double got = double(far.singleAlone[c]) - double(near.singleAlone[c]);
        error =
            std::max(error, std::abs(got - wanted) / std::max(double(far.wantedSingle[c]), 1e-9));
      }
      errors.push_back(error);
    }
    std::printf("%7s: differences, per cent of the longer one, p95 %.3f, p99 %.3f, max %.3f\n",
                place.name, percent(&errors, 0.95), percent(&errors, 0.99), percent(&errors, 1.0));
    EXPECT_LT(percent(&errors, 0.95), place.altitude > 1e5 ? 1.0 : 0.3) << place.name;
    EXPECT_LT(percent(&errors, 0.99), place.altitude > 1e5 ? 2.5 : 1.0) << place.name;
  }
}

/// Of the LUT's light along a row of queries, relative to it.
Steps lightSteps(const std::vector<AerialAnswer>& answers) {
  Steps worst;
  for (size_t c = 0; c < 3; ++c)
    worst.add(stepsOf(answers.size(), 1e-12, [&](size_t i) {
      return double(answers[i].single[c]) + double(answers[i].multiple[c]);
    }));
  return worst;
}

TEST_F(AerialPerspectiveLutTest, HasNoStepInDistanceNorAtTheHorizon) {
  for (const Place& place : kPlaces) {
    if (place.altitude > 1e5)
      continue;  // from there the horizon is beyond the atmosphere that counts
    for (const double sun : {50.0, 3.0}) {
      const FrameState draw = drawOf(place.altitude, sun);
      fill(draw);
      const double dip = horizonDip(preset("earth"), place.altitude);
      const double reach = std::sqrt(2.0 * 6.36e6 * place.altitude);  // to the horizon
      for (const double off : {-1.0, 0.02, 3.0, 40.0}) {
        std::vector<AerialQuery> queries;
        for (int i = 0; i < 2000; ++i)
          queries.push_back(query(-dip + radians(off), 1.0, 10.0 * std::pow(1e5, i / 2000.0)));
        const Steps along = lightSteps(ask(draw, queries));
        EXPECT_LT(along.jump, 1e-3) << place.name << ", sun " << sun << ", " << off << " degrees";
      }
      for (const double share : {0.01, 0.1, 0.6}) {
        std::vector<AerialQuery> queries;
        for (int i = 0; i < 2000; ++i)
          queries.push_back(query(-dip + radians(0.2) * (i / 1000.0 - 1.0), 0.3, share * reach));
        const Steps across = lightSteps(ask(draw, queries));
        EXPECT_LT(across.jump, 1e-3) << place.name << ", sun " << sun << ", at " << share * reach;
      }
    }
  }
}

TEST_F(AerialPerspectiveLutTest, IsValidForItsCameraSunAndTablesOnly) {
  const FrameState draw = drawOf(1500.0, 10.0);
  ResourceReport before, after;
  resourceReport(context(), &before);
  fill(draw);
  resourceReport(context(), &after);
  EXPECT_EQ(after.dispatches, before.dispatches + 1);
  EXPECT_TRUE(volume()->current(*tables(), draw));
  EXPECT_FALSE(volume()->current(*tables(), drawOf(1501.0, 10.0)));
  EXPECT_FALSE(volume()->current(*tables(), drawOf(1500.0, 10.5)));
  EXPECT_FALSE(volume()->current(*tables("earth-hazy"), draw));
}

}  // namespace
}  // namespace alpenglow::testing
