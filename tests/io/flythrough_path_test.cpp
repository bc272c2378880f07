// What lies between the keys of a flythrough, against closed forms.
#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/flythrough_file.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/parameters/heard.h"

namespace alpenglow::io {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

double smooth(double u) { return u * u * (3.0 - 2.0 * u); }

class FlythroughPath : public ::testing::Test {
 protected:
  void keys(const std::string& list) {
    const std::string text =
        R"({ "frames_per_second": 10, "scene": { "atmosphere": "earth",
             "sun": { "elevation_deg": 10, "azimuth_deg": 350 },
             "camera": { "altitude_m": 9, "heading_deg": 10 }, "exposure": 2,
             "stars": { "sidereal_hours": 23 } }, "keys": [)" +
        list + "] }";
    Result<Flythrough> flythrough = parseFlythrough(text, "w.json", "");
    ASSERT_TRUE(flythrough) << flythrough.error;
    flythrough_ = *flythrough;
  }
  Scene at(double time_s) { return sceneAt(flythrough_, time_s); }

  Flythrough flythrough_;
};

TEST_F(FlythroughPath, FramesRunFromTheFirstKeyToTheLast) {
  keys(R"({ "time_s": 0, "caption": "a" }, { "time_s": 0.7, "caption": "b" })");
  EXPECT_EQ(frameCount(flythrough_), 8u);
  EXPECT_EQ(timeOfFrame(flythrough_, 7), 0.7);
  EXPECT_EQ(keyAt(flythrough_, 0.69).caption, "a");
  EXPECT_EQ(keyAt(flythrough_, timeOfFrame(flythrough_, 7)).caption, "b");
  EXPECT_EQ(keyAt(flythrough_, 99.0).caption, "b");
  flythrough_.framesPerSecond = 100.0;
  flythrough_.keys.back().time_s = 0.29;
  EXPECT_EQ(frameCount(flythrough_), 30u) << "though 0.29 * 100 is less than 29 in doubles";
  keys(R"({ "time_s": 0 })");
  EXPECT_EQ(frameCount(flythrough_), 1u);
}

TEST_F(FlythroughPath, TwoKeysAreJoinedBySmoothSteps) {
  keys(R"({ "time_s": 0 }, { "time_s": 4, "exposure": 200, "stars": { "sidereal_hours": 25 },
          "sun": { "elevation_deg": -20, "azimuth_deg": 30, "disc_radius_deg": 1.2667 },
          "camera": { "altitude_m": 99999, "heading_deg": 270, "pitch_deg": 45, "roll_deg": -8,
                      "fov_deg": 15 } })");
  for (const double u : {0.125, 0.25, 0.5, 0.875}) {
    const Scene scene = at(4.0 * u);
    const double s = smooth(u);
    EXPECT_NEAR(scene.sun.elevation, (10 - 30 * s) * kRadians, 1e-12);
    EXPECT_NEAR(scene.sun.azimuth, (350 + 40 * s) * kRadians, 1e-12) << "through north";
    EXPECT_NEAR(scene.sun.discRadius, (0.2667 + s) * kRadians, 1e-12);
    EXPECT_NEAR(scene.camera.heading, (10 - 100 * s) * kRadians, 1e-12) << "the shorter way";
    EXPECT_NEAR(scene.camera.pitch, 45 * s * kRadians, 1e-12);
    EXPECT_NEAR(scene.camera.roll, -8 * s * kRadians, 1e-12);
    EXPECT_NEAR(scene.camera.fov, 60 * std::pow(4.0, -s) * kRadians, 1e-12);
    EXPECT_NEAR(scene.camera.altitude_m, std::pow(10.0, 1.0 + 4.0 * s) - 1.0, 1e-6);
    EXPECT_NEAR(*scene.exposure, 2.0 * std::pow(100.0, s), 1e-9);
    EXPECT_NEAR(scene.stars->siderealHours, 23.0 + 2.0 * s, 1e-12) << "as the numbers stand";
  }
}

TEST_F(FlythroughPath, KeysAreMetExactly) {
  keys(R"({ "time_s": 0 }, { "time_s": 0.3, "camera": { "latitude_deg": 47.3, "longitude_deg": 11.7,
          "altitude_m": 1234.5 }, "exposure": 0.1 }, { "time_s": 1, "sun": { "elevation_deg": 1 } })");
  for (const FlythroughKey& key : flythrough_.keys) {
    for (const double time :
         {key.time_s, timeOfFrame(flythrough_, static_cast<uint32_t>(key.time_s * 10.0 + 0.5))}) {
      const Scene scene = at(time);
      EXPECT_EQ(scene.camera.latitude, key.scene.camera.latitude);
      EXPECT_EQ(scene.camera.altitude_m, key.scene.camera.altitude_m);
      EXPECT_EQ(scene.sun.elevation, key.scene.sun.elevation);
      EXPECT_EQ(scene.exposure, key.scene.exposure);
    }
  }
  EXPECT_EQ(at(-1.0).camera.altitude_m, 9.0);
  EXPECT_EQ(at(100.0).sun.elevation, kRadians);
}

TEST_F(FlythroughPath, PlacesLieOnGreatCircles) {
  keys(R"({ "time_s": 0, "camera": { "latitude_deg": 30, "longitude_deg": 170 } },
          { "time_s": 2, "move": "linear", "camera": { "latitude_deg": 30, "longitude_deg": -150 } })");
  // Halfway between two places of one latitude: tan = tan(30) / cos(20), and over the date line.
  const Scene half = at(1.0);
  EXPECT_NEAR(std::tan(half.camera.latitude), std::tan(30 * kRadians) / std::cos(20 * kRadians),
              1e-12);
  EXPECT_NEAR(std::remainder(half.camera.longitude - 190 * kRadians, 360 * kRadians), 0.0, 1e-12);
  // At one speed: the arc from the start grows with time.
  const auto arc = [&](const Scene& scene) {
    const double a = 30 * kRadians, b = scene.camera.latitude;
    return std::acos(std::sin(a) * std::sin(b) +
                     std::cos(a) * std::cos(b) * std::cos(scene.camera.longitude - 170 * kRadians));
  };
  EXPECT_NEAR(arc(at(0.5)), 0.25 * arc(at(2.0)), 1e-9);
  EXPECT_NEAR(arc(at(1.5)), 0.75 * arc(at(2.0)), 1e-9);
}

TEST_F(FlythroughPath, SpeedIsContinuousAtSmoothKeysAndNothingOvershoots) {
  keys(R"({ "time_s": 0 }, { "time_s": 1, "sun": { "elevation_deg": 12 } },
          { "time_s": 3, "sun": { "elevation_deg": 40 } },
          { "time_s": 4, "sun": { "elevation_deg": 41 } },
          { "time_s": 5, "sun": { "elevation_deg": 0 } })");
  const auto elevation = [&](double t) { return at(t).sun.elevation / kRadians; };
  const double step = 1e-5;
  for (const double t : {1.0, 3.0, 4.0}) {
    const double before = (elevation(t) - elevation(t - step)) / step;
    const double after = (elevation(t + step) - elevation(t)) / step;
    EXPECT_NEAR(before, after, 1e-2) << t;
  }
  EXPECT_NEAR((elevation(step) - elevation(0)) / step, 0.0, 1e-2) << "from rest";
  // Fritsch and Butland: at 1 s between slopes 2 over 1 s and 14 over 2 s.
  EXPECT_NEAR((elevation(1 + step) - elevation(1)) / step, 9.0 / (5.0 / 2.0 + 4.0 / 14.0), 1e-2);
  double last = 0.0;
  for (int i = 0; i <= 400; ++i) {
    const double now = elevation(0.01 * i);
    EXPECT_GE(now, last - 1e-12) << i;
    EXPECT_LE(now, 41.0 + 1e-12) << i;
    last = now;
  }
}

TEST_F(FlythroughPath, CutsJumpAndTheKeyBeforeRests) {
  keys(R"({ "time_s": 0 }, { "time_s": 1, "sun": { "elevation_deg": 20 } },
          { "time_s": 2, "move": "cut", "sun": { "elevation_deg": -30 } },
          { "time_s": 3, "sun": { "elevation_deg": -20 } })");
  EXPECT_EQ(at(1.5).sun.elevation, 20 * kRadians);
  EXPECT_EQ(at(1.999).sun.elevation, 20 * kRadians);
  EXPECT_EQ(at(2.0).sun.elevation, -30 * kRadians);
  EXPECT_NEAR(at(0.25).sun.elevation, (10 + 10 * smooth(0.25)) * kRadians, 1e-12);
  EXPECT_NEAR(at(2.25).sun.elevation, (-30 + 10 * smooth(0.25)) * kRadians, 1e-12);
}

TEST_F(FlythroughPath, AtmospheresMixAndStayValid) {
  keys(R"({ "time_s": 0 }, { "time_s": 1 },
          { "time_s": 3, "move": "linear", "atmosphere": { "top_radius_m": 6500000,
            "mie": { "asymmetry": -0.24, "scattering_per_m": [1e-3, 1e-3, 1e-3],
                     "extinction_per_m": [1e-3, 1e-3, 1e-3] } } })");
  const Parameters& earth = flythrough_.keys[0].scene.atmosphere;
  EXPECT_EQ(firstDifference(at(0.5).atmosphere, earth), "") << "nothing to rebake";
  const Parameters half = at(2.0).atmosphere;
  EXPECT_DOUBLE_EQ(half.topRadius_m, 6460000.0);
  EXPECT_DOUBLE_EQ(half.mie.asymmetry, 0.26);
  EXPECT_DOUBLE_EQ(half.mie.scattering_per_m[1], 0.5 * (2e-5 + 1e-3));
  EXPECT_EQ(half.rayleigh.scaleHeight_m, earth.rayleigh.scaleHeight_m);
  for (double t = 1.0; t <= 3.0; t += 0.05) {
    testing::Heard heard;
    EXPECT_EQ(validate(at(t).atmosphere, heard.sink()), Status::Ok) << heard.sentence;
  }
}

TEST_F(FlythroughPath, StaticObjectsFollowTheFirstKey) {
  const Result<Flythrough> flythrough = parseFlythrough(
      R"({ "scene": { "atmosphere": "earth", "sun": { "elevation_deg": 10 },
             "camera": { "latitude_deg": 5 }, "size": [64, 32], "terrain":
             { "height_map": "h.png", "meters_per_pixel": 5 } }, "keys": [ { "time_s": 0 },
             { "time_s": 1, "camera": { "latitude_deg": 6 },
               "atmosphere": { "ground_albedo": [0.5, 0.5, 0.5] } }] })",
      "w.json", "folder");
  ASSERT_TRUE(flythrough) << flythrough.error;
  const Scene scene = sceneAt(*flythrough, 1.0);
  EXPECT_EQ(scene.terrain->latitude, 5 * kRadians);
  EXPECT_EQ(scene.terrain->albedo[0], 0.1);
  EXPECT_EQ(scene.terrain->heightMap, "folder/h.png");
  EXPECT_EQ(scene.camera.latitude, 6 * kRadians);
  EXPECT_EQ(scene.width, 64u);
}

}  // namespace
}  // namespace alpenglow::io
