// Deep twilight as a long exposure sees it: the sun 6 to 34 degrees below the horizon, radiance
// times 1e5. No blocks, no steps, no glow that stays; from the tables and from a sky-view LUT.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/passes/sky/sky_fixture.h"
#include "tests/passes/sky/steps.h"

namespace alpenglow::testing {
namespace {

constexpr double kExposure = 1e5;
constexpr double kSunAzimuth = 0.7;

/// From the tables, and from the LUT.
using Pair = std::array<Picture, 2>;

class TwilightTest : public SkyTest {
 protected:
  static EyeCamera camera(double altitude, double azimuth, double pitch, double roll, double fov) {
    return cameraFromGeodetic(preset("earth"), 0.3, 0.2, altitude, kSunAzimuth + azimuth, pitch,
                              roll, fov);
  }

  static FrameState drawOf(const EyeCamera& camera, double elevation, VkExtent2D extent) {
    double sun[3];
    sunDirection(0.3, 0.2, radians(elevation), kSunAzimuth, sun);
    FrameState draw = makeDraw(camera, vec(sun), extent);
    draw.radianceScale = kExposure;
    return draw;
  }

  Pair bothPictures(const FrameState& draw, Projection projection = Projection::Perspective) {
    View* const fromLut = lutView(projection);
    recordViewLuts(fromLut, tables(), draw);
    return {picture(draw, projection), picture(fromLut, tables(), draw)};
  }
};

double brightness(const Picture& picture) {
  double sum = 0.0;
  for (size_t i = 0; i < picture.data.size(); ++i)
    if (i % 4 != 3) sum += static_cast<double>(picture.data[i]);
  return sum / (3.0 * picture.width * picture.height);
}

/// Down the columns of a picture, above the horizon's row and below it.
Steps stepsDown(const Picture& p, double horizon) {
  const auto above = static_cast<uint32_t>(std::clamp(horizon - 2.0, 0.0, double(p.height)));
  const auto below = static_cast<uint32_t>(std::clamp(horizon + 3.0, 0.0, double(p.height)));
  Steps result;
  for (uint32_t x = 0; x < p.width; ++x) {
    for (int c = 0; c < 3; ++c) {
      for (const auto& [first, end] : {std::pair{0u, above}, {below, p.height}}) {
        const auto at = [&, from = first](size_t i) {
          return static_cast<double>(p.at(x, from + static_cast<uint32_t>(i))[c]);
        };
        result.add(stepsOf(end - first, 1e-9 * kExposure, at));
      }
    }
  }
  return result;
}

constexpr double kFov = radians(16.0);
constexpr VkExtent2D kColumn = {4, 1024};  ///< A 64th of a degree a pixel.

/// Row of the horizon in an upright column whose centre looks `pitch` high.
double horizonRow(double altitude, double pitch) {
  const double dip = horizonDip(preset("earth"), altitude);
  return 0.5 * kColumn.height * (1.0 + std::tan(pitch + dip) / std::tan(0.5 * kFov));
}

// Columns of the sky, upright and along the horizon. Where light falls by a factor of ten in a
// degree, above the night's edge as an airliner sees it, a 64th of a degree is 20 %; a block's edge
// would be a step between smaller ones.
TEST_F(TwilightTest, NoBlocksAndNoStepsAtExposure1e5) {
  for (const double altitude : {2.0, 1e4}) {
    for (const double elevation : {-6.0, -9.0, -12.0, -15.0, -18.0}) {
      Steps worst[2];
      const auto look = [&](double azimuth, double pitch, double roll, double horizon) {
        const FrameState draw =
            drawOf(camera(altitude, azimuth, pitch, roll, kFov), elevation, kColumn);
        const Pair pictures = bothPictures(draw);
        for (size_t i = 0; i < 2; ++i) {
          EXPECT_EQ(badValue(pictures[i]), "") << altitude << " m, sun " << elevation;
          worst[i].add(stepsDown(pictures[i], horizon));
        }
      };
      for (const double azimuth : {0.0, 40.0, 90.0, 180.0}) {
        for (const double pitch : {radians(4.0), radians(20.0), radians(82.0)})
          look(radians(azimuth), pitch, 0.0, horizonRow(altitude, pitch));
        for (const double pitch : {radians(1.0), radians(10.0)})
          look(radians(azimuth), pitch, radians(90.0), 0.0);
      }
      std::printf("%7.0f m, sun %4.0f: largest step %.3f, jump %.1e; from the LUT %.3f, %.1e\n",
                  altitude, elevation, worst[0].largest, worst[0].jump, worst[1].largest,
                  worst[1].jump);
      for (const Steps& found : worst) {
        EXPECT_LT(found.largest, 0.25) << altitude << " " << elevation;
        EXPECT_LT(found.jump, 2e-4) << altitude << " " << elevation;
      }
    }
  }
}

// From the ground twilight darkens by a factor of 2.3 to 3.7 a degree, all the way down; from space
// the lit limb sinks behind the planet.
TEST_F(TwilightTest, NightLeavesNoResidualGlow) {
  for (const double altitude : {2.0, 1e4, 4e5}) {
    double before[2] = {};
    std::printf("%7.0f m:", altitude);
    for (double elevation = -6.0; elevation >= -34.0; elevation -= 1.0) {
      const FrameState draw =
          drawOf(camera(altitude, 0.0, radians(90.0), 0.0, 2.0 * kPi), elevation, {48, 48});
      const Pair pictures = bothPictures(draw, Projection::Fisheye);
      for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(badValue(pictures[i]), "") << altitude << " m, sun " << elevation;
        const double now = brightness(pictures[i]);
        if (elevation < -6.0) {
          EXPECT_LT(now, before[i] / (altitude < 1e5 ? 2.0 : 1.1)) << altitude << " " << elevation;
          EXPECT_GT(now, before[i] / (altitude < 1e5 ? 4.0 : 8.0)) << altitude << " " << elevation;
        }
        before[i] = now;
      }
      if (std::fmod(elevation, 6.0) == 0.0) std::printf(" %.2g", before[0]);
    }
    std::printf(" at exposure 1e5, sun -6 to -30\n");
    for (const double last : before) EXPECT_LT(last, 1e-4);
  }
}

// Ray by ray: down to 40 degrees each quarter of a degree is a step into the dark, and below that,
// where the tables end, what stays is 1e-17 of the sun at most.
TEST_F(TwilightTest, EachRayDarkensWithTheSun) {
  constexpr size_t kSuns = 4 * 89;
  std::vector<ProbeQuery> queries;
  for (const double altitude : {2.0, 1e4}) {
    for (const double zenith : {0.0, 30.0, 60.0, 80.0, 88.0}) {
      for (const double azimuth : {0.0, 90.0, 180.0}) {
        for (size_t i = 0; i < kSuns; ++i) {
          ProbeQuery query;
          query.altitude_m = altitude;
          query.zenith = radians(zenith);
          query.azimuth = radians(azimuth);
          query.sunZenith = radians(91.0 + 0.25 * double(i));
          queries.push_back(query);
        }
      }
    }
  }
  const std::vector<ProbeAnswer> answers = probeAll(queries);
  ASSERT_EQ(answers.size(), queries.size());
  for (size_t i = 0; i < answers.size(); ++i) {
    const double depth = queries[i].sunZenith / radians(1.0) - 90.0;
    const double most = depth < 18.0 ? 1.0 : depth < 30.0 ? 3e-8 : depth < 40.0 ? 2e-13 : 1e-17;
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const double now = answers[i].skyRadiance[c];
      ASSERT_TRUE(now >= 0.0 && now < most) << now << ", sun " << depth << " degrees down";
      if (i % kSuns != 0 && depth <= 40.0) {
        ASSERT_LT(now, answers[i - 1].skyRadiance[c])
            << "sun " << depth << " degrees down, " << queries[i].altitude_m << " m, zenith angle "
            << queries[i].zenith << ", azimuth " << queries[i].azimuth;
      }
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
