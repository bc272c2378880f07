// The way out of the atmosphere: no jump at its top nor anywhere between the ground and space.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/passes/sky/sky_fixture.h"
#include "tests/passes/sky/steps.h"

namespace alpenglow::testing {
namespace {

constexpr double kSuns[] = {40.0, 2.0, -5.0, -10.0};

class PassageTest : public SkyTest {
 protected:
  PassageTest() : earth_(preset("earth")) {}

  double top() const { return earth_.topRadius_m - earth_.bottomRadius_m; }
  double dip(double altitude) const { return horizonDip(earth_, altitude); }

  /// A ray `below` radians under the horizontal.
  static ProbeQuery ray(double altitude, double below, double elevation) {
    ProbeQuery query;
    query.altitude_m = altitude;
    query.zenith = 0.5 * kPi + below;
    query.sunZenith = 0.5 * kPi - radians(elevation);
    query.azimuth = radians(50.0);
    return query;
  }

  Parameters earth_;
};

double light(const ProbeAnswer& answer, uint32_t c) {
  return answer.skyRadiance[c] + answer.groundRadiance[c];
}

Steps stepsAlong(const ProbeAnswer* row, size_t count, double dark) {
  Steps result;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    for (size_t i = 0; i < count; ++i)
      EXPECT_TRUE(std::isfinite(light(row[i], c)) && light(row[i], c) >= 0.0) << i;
    result.add(stepsOf(count, dark, [&](size_t i) { return light(row[i], c); }));
  }
  return result;
}

double brightest(const std::vector<ProbeAnswer>& answers) {
  double most = 0.0;
  for (const ProbeAnswer& a : answers)
    for (uint32_t c = 0; c < kSpectrumSize; ++c) most = std::max(most, light(a, c));
  return most;
}

// In steps of 0.1 m through the top, along rays to the ground, past it and away from it.
TEST_F(PassageTest, NoJumpThroughTheTop) {
  constexpr size_t kSteps = 101;
  const double horizon = dip(top());
  std::vector<double> directions = {radians(90.0),  radians(60.0),  radians(30.0), radians(10.0),
                                    horizon + 1e-3, horizon - 1e-3, radians(-5.0), radians(-60.0)};
  // Past the ground, at 10, 30 and 50 km.
  for (const double lowest : {1e4, 3e4, 5e4})
    directions.push_back(std::acos((earth_.bottomRadius_m + lowest) / earth_.topRadius_m));
  for (const double elevation : kSuns) {
    std::vector<ProbeQuery> queries;
    for (const double below : directions)
      for (size_t i = 0; i < kSteps; ++i)
        queries.push_back(ray(top() + 0.1 * (double(i) - 50.0), below, elevation));
    const std::vector<ProbeAnswer> answers = probeAll(queries);
    Steps worst;
    for (size_t i = 0; i < directions.size(); ++i) {
      worst.add(stepsAlong(&answers[i * kSteps], kSteps, 1e-3 * brightest(answers)));
    }
    std::printf("through the top, sun %4.0f: largest step %.1e, jump %.1e\n", elevation,
                worst.largest, worst.jump);
    EXPECT_LT(worst.largest, 2e-4) << elevation;
    EXPECT_LT(worst.jump, 1e-5) << elevation;
  }
}

// From 2 m to 10,000 km, each 2 % higher: down, slantwise to the ground, and next to the horizon.
TEST_F(PassageTest, NoJumpFromTheGroundToSpace) {
  std::vector<double> altitudes;
  for (double altitude = 2.0; altitude < 1e7; altitude *= 1.02) altitudes.push_back(altitude);
  for (const double elevation : kSuns) {
    std::vector<ProbeQuery> queries;
    for (const double share : {1.0, 0.5, 0.1, 0.01, -0.003})
      for (const double altitude : altitudes)
        queries.push_back(
            ray(altitude, dip(altitude) + share * (0.5 * kPi - dip(altitude)), elevation));
    const std::vector<ProbeAnswer> answers = probeAll(queries);
    Steps worst;
    for (size_t i = 0; i < queries.size(); i += altitudes.size()) {
      worst.add(stepsAlong(&answers[i], altitudes.size(), 1e-3 * brightest(answers)));
    }
    std::printf("to space, sun %4.0f: largest step %.1e, jump %.1e\n", elevation, worst.largest,
                worst.jump);
    EXPECT_LT(worst.largest, 0.2) << elevation;
    EXPECT_LT(worst.jump, 1e-4) << elevation;
  }
}

// A LUT has other rows on either side of the top; the greatest difference is at its edge, which
// no row meets from inside. Relative to a pixel, or to a hundredth of the brightest.
TEST_F(PassageTest, LutsAgreeOnBothSidesOfTheTop) {
  View* const fromLut = lutView(Projection::Fisheye);
  for (const double elevation : kSuns) {
    double sun[3];
    sunDirection(0.0, 0.0, radians(elevation), 0.5, sun);
    const auto drawn = [&](double altitude) {
      const FrameState draw = makeDraw(
          cameraFromGeodetic(earth_, 0.0, 0.0, altitude, 0.0, radians(-90.0), 0.0, 2.0 * kPi),
          vec(sun), {64, 64});
      recordViewLuts(fromLut, tables(), draw);
      return picture(fromLut, tables(), draw);
    };
    const Picture inside = drawn(top() - 0.05), outside = drawn(top() + 0.05);
    float most = 0.0f;
    for (size_t i = 0; i < inside.data.size(); ++i)
      if (i % 4 != 3) most = std::max(most, inside.data[i]);
    std::vector<double> differences;
    for (size_t i = 0; i < inside.data.size(); ++i) {
      const double scale = std::max(inside.data[i], 0.01f * most);
      if (i % 4 != 3)
        differences.push_back(std::abs(static_cast<double>(inside.data[i] - outside.data[i])) /
                              scale);
    }
    std::sort(differences.begin(), differences.end());
    const double p95 = differences[differences.size() * 95 / 100];
    std::printf("slices 5 cm on either side of the top, sun %4.0f: p95 %.4f, greatest %.4f\n",
                elevation, p95, differences.back());
    EXPECT_LT(p95, 1e-3) << elevation;
    EXPECT_LT(differences.back(), 0.05) << elevation;
  }
}

}  // namespace
}  // namespace alpenglow::testing
