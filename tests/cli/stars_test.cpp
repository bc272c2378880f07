// Stars in pictures: their light against the catalogue and the reference's transmittance.
#include <alpenglow/camera.h>
#include <alpenglow/io/image_file.h>
#include <alpenglow/reference/reference.h>

#include <algorithm>
#include <cmath>

#include "program.h"
#include "samples/stars/stars.h"

namespace alpenglow::test {
namespace {

using io::LinearImage;
using samples::Star;

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegrees = 180.0 / kPi;
constexpr double kLatitude = 40.0;

/// Where a star stands for an observer at latitude 40, longitude 0.
struct Place {
  double elevation_deg = 0.0;
  double azimuth_deg = 0.0;
};

Place placeOf(const Star& star, double siderealHours) {
  double d[3];
  samples::starDirection(star, siderealHours, d);
  const double lat = kLatitude / kDegrees;
  const double up = std::cos(lat) * d[0] + std::sin(lat) * d[2];
  const double north = -std::sin(lat) * d[0] + std::cos(lat) * d[2];
  return {std::asin(up) * kDegrees, std::atan2(d[1], north) * kDegrees};
}

double angleBetween(const Star& a, const Star& b) {
  double p[3], q[3];
  samples::starDirection(a, 0.0, p);
  samples::starDirection(b, 0.0, q);
  return std::acos(std::min(1.0, p[0] * q[0] + p[1] * q[1] + p[2] * q[2])) * kDegrees;
}

/// The brightest stars that have none of the others about them.
std::vector<Star> loneStars(size_t count) {
  const std::vector<Star> all = samples::starCatalogue();
  std::vector<Star> lone;
  for (const Star& star : all) {
    const auto near = std::count_if(
        all.begin(), all.end(), [&](const Star& other) { return angleBetween(star, other) < 1.2; });
    if (near == 1) lone.push_back(star);
    if (lone.size() == count) break;
  }
  return lone;
}

struct Shot {
  double sunElevation_deg = -40.0;
  double altitude_m = 2.0;
  double siderealHours = 6.0;
  Place aim;
  double roll_deg = 0.0;
  std::string projection = "perspective";
  double fov_deg = 2.0;
  uint32_t width = 48, height = 48;
};

class Stars : public Program {
 protected:
  static void SetUpTestSuite() {
    tables_ = new TemporaryFolder;
    const Outcome baked =
        runProgram(joined({"bake", "earth", "-o", *tables_ / "t.exr"}, smallMoments()));
    ASSERT_EQ(baked.status, 0) << baked.err;
  }
  static void TearDownTestSuite() {
    delete tables_;
    tables_ = nullptr;
  }

  LinearImage render(const Shot& shot, bool stars, const nlohmann::json& more = {}) {
    nlohmann::json scene = {
        {"atmosphere", "earth"},
        {"sun", {{"elevation_deg", shot.sunElevation_deg}, {"azimuth_deg", 300}}},
        {"camera",
         {{"latitude_deg", kLatitude},
          {"altitude_m", shot.altitude_m},
          {"heading_deg", shot.aim.azimuth_deg},
          {"pitch_deg", shot.aim.elevation_deg},
          {"roll_deg", shot.roll_deg},
          {"projection", shot.projection},
          {"fov_deg", shot.fov_deg}}},
        {"size", {shot.width, shot.height}}};
    if (stars) scene["stars"] = {{"sidereal_hours", shot.siderealHours}};
    if (more.is_object()) scene.update(more);
    expectGood({"render", folder_.write("s.json", scene.dump()), "-o", folder_ / "s.exr",
                "--tables", *tables_ / "t.exr"});
    io::Result<LinearImage> image = io::readExr(folder_ / "s.exr");
    EXPECT_TRUE(image) << image.error;
    return image ? *image : LinearImage{};
  }

  /// Irradiance that the picture's pixels add up to: radiance times solid angle.
  static Spectrum irradiance(const LinearImage& image, const Shot& shot) {
    const bool fisheye = shot.projection == "fisheye";
    const double fov = shot.fov_deg / kDegrees, side = std::min(image.width, image.height);
    const double focal = fisheye ? side / fov : 0.5 * image.height / std::tan(0.5 * fov);
    Spectrum sum;
    for (uint32_t y = 0; y < image.height; ++y) {
      for (uint32_t x = 0; x < image.width; ++x) {
        const double theta =
            std::hypot(x + 0.5 - 0.5 * image.width, y + 0.5 - 0.5 * image.height) / focal;
        const double shape = fisheye ? (theta > 0.0 ? std::sin(theta) / theta : 1.0)
                                     : std::pow(1.0 + theta * theta, -1.5);
        for (uint32_t c = 0; c < 3; ++c) {
          const float value = image.pixels[(size_t{y} * image.width + x) * 3 + c];
          sum[c] += static_cast<double>(value) * shape / (focal * focal);
        }
      }
    }
    return sum;
  }

  static TemporaryFolder* tables_;
};
TemporaryFolder* Stars::tables_ = nullptr;

Spectrum transmittance(double altitude_m, double elevation_deg) {
  Parameters earth;
  EXPECT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  ProbeQuery query;
  query.altitude_m = altitude_m;
  query.zenith = (90.0 - elevation_deg) / kDegrees;
  query.sunZenith = 0.5 * kPi;
  ReferenceAnswer answer;
  EXPECT_EQ(referenceSingleScattering(earth, query, &answer, {}), Status::Ok);
  return answer.value.transmittance;
}

TEST(StarCatalogue, HasTheSkysBrightest) {
  const std::vector<Star> stars = samples::starCatalogue();
  ASSERT_EQ(stars.size(), 8870u);
  EXPECT_NEAR(stars[0].magnitude, -1.44, 1e-6) << "Sirius";
  EXPECT_NEAR(stars[0].rightAscension * kDegrees, 101.28854, 1e-4);
  EXPECT_NEAR(stars[0].declination * kDegrees, -16.71314, 1e-4);
  for (size_t i = 1; i < stars.size(); ++i) {
    ASSERT_GE(stars[i].magnitude, stars[i - 1].magnitude);
    ASSERT_LE(stars[i].magnitude, 6.5);
  }
  // V = 0 is 2.54e-6 lux, and the sun 1.27e5 to 1.28e5 above the atmosphere.
  EXPECT_NEAR(samples::shareOfSun({0.0, 0.0, 0.0}) * 1.275e5, 2.54e-6, 0.03e-6);
  // On the meridian at the sidereal time of its right ascension.
  EXPECT_NEAR(placeOf(stars[0], stars[0].rightAscension * kDegrees / 15.0).azimuth_deg, 180.0,
              1e-9);
}

TEST_F(Stars, FluxIsTheCataloguesTimesTheTransmittance) {
  int low = 0, high = 0;
  for (const Star& star : loneStars(2)) {
    for (const double hours : {2.0, 4.5, 11.0}) {
      Shot shot;
      shot.siderealHours = hours;
      shot.aim = placeOf(star, hours);
      if (shot.aim.elevation_deg < 2.0) continue;
      (shot.aim.elevation_deg < 25.0 ? low : high) += 1;
      const Spectrum detected = irradiance(render(shot, true), shot);
      const Spectrum t = transmittance(shot.altitude_m, shot.aim.elevation_deg);
      for (uint32_t c = 0; c < 3; ++c) {
        const double expected = samples::shareOfSun(star) * t[c];
        EXPECT_NEAR(detected[c], expected, 0.01 * expected)
            << "V " << star.magnitude << " at " << shot.aim.elevation_deg;
      }
    }
  }
  EXPECT_GE(low, 1);
  EXPECT_GE(high, 1);
}

TEST_F(Stars, InSpaceNothingDimsThem) {
  const Star star = loneStars(1)[0];
  Shot shot;
  shot.altitude_m = 1e6;
  shot.aim = placeOf(star, shot.siderealHours);
  ASSERT_GT(shot.aim.elevation_deg, 5.0);
  const Spectrum detected = irradiance(render(shot, true), shot);
  for (uint32_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(detected[c] / samples::shareOfSun(star), 1.0, 1e-4);
  }
}

TEST_F(Stars, TheSumIsTheSameBetweenPixelsAtAnySizeAndProjection) {
  const Star star = loneStars(1)[0];
  Shot shot;
  shot.aim = placeOf(star, shot.siderealHours);
  const double expected = irradiance(render(shot, true), shot)[1];
  std::vector<Shot> shots(9, shot);
  const double pixel_deg = shot.fov_deg / shot.height;
  shots[0].aim.elevation_deg += 0.25 * pixel_deg;
  shots[1].aim.elevation_deg += 0.5 * pixel_deg;
  shots[2].aim.azimuth_deg += 0.4 * pixel_deg / std::cos(shot.aim.elevation_deg / kDegrees);
  shots[3].roll_deg = 33.0;
  shots[3].aim.elevation_deg += 0.3;
  shots[4].width = shots[4].height = 17;
  shots[5].width = 90;
  shots[5].height = 64;
  shots[5].fov_deg = 1.0;  // Wider, it would show a neighbour.
  shots[6].fov_deg = 0.5;
  for (const size_t i : {size_t{7}, size_t{8}}) shots[i].projection = "fisheye";
  shots[8].aim.elevation_deg += 0.5;
  for (const Shot& other : shots) {
    EXPECT_NEAR(irradiance(render(other, true), other)[1], expected, 1e-4 * expected)
        << &other - shots.data();
  }
}

TEST_F(Stars, GroundAndTerrainHideThem) {
  Shot shot;
  shot.aim = {-12.0, 200.0};
  shot.fov_deg = 20.0;
  EXPECT_EQ(render(shot, true).pixels, render(shot, false).pixels);
  LinearImage wall{9, 9, std::vector<float>(9 * 9 * 3, 0.0f)};
  for (size_t column = 0; column < 9; ++column) wall.pixels[(6 * 9 + column) * 3] = 800.0f;
  ASSERT_TRUE(io::writeExr(folder_ / "wall.exr", wall));
  shot.aim = {20.0, 180.0};
  shot.fov_deg = 30.0;
  const nlohmann::json terrain = {
      {"terrain", {{"height_map", "wall.exr"}, {"meters_per_pixel", 1000}}}, {"shafts", "off"}};
  const LinearImage with = render(shot, true, terrain), starless = render(shot, false, terrain);
  const size_t half = with.pixels.size() / 2;  // The wall's top stands 22 degrees high.
  EXPECT_FALSE(std::equal(with.pixels.begin(), with.pixels.begin() + static_cast<long>(half) / 2,
                          starless.pixels.begin()));
  EXPECT_TRUE(std::equal(with.pixels.begin() + static_cast<long>(half), with.pixels.end(),
                         starless.pixels.begin() + static_cast<long>(half)));
  EXPECT_GT(irradiance(render(shot, true), shot)[1], irradiance(with, shot)[1]);
}

/// A star of a picture, and how it shows.
struct DetectedStar {
  double magnitude = 0.0;
  double light = 0.0;  ///< Of its brightest pixel, above the sky's.
  double sky = 0.0;    ///< There.
};

std::vector<DetectedStar> starsOf(const LinearImage& with, const LinearImage& starless,
                                  const Shot& shot) {
  Parameters earth;
  EXPECT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  Camera camera = cameraAt(earth, {}, kLatitude / kDegrees, 0.0, shot.altitude_m,
                           shot.aim.azimuth_deg / kDegrees, shot.aim.elevation_deg / kDegrees, 0.0);
  camera.fov = shot.fov_deg / kDegrees;
  camera.viewport.extent = {shot.width, shot.height};
  camera.nearPlane = 1.0;
  float m[16];
  EXPECT_EQ(clipFromCamera(Projection::Perspective, DepthConvention::Reversed, camera, m),
            Status::Ok);
  std::vector<DetectedStar> detected;
  for (const Star& star : samples::starCatalogue()) {
    double d[3];
    samples::starDirection(star, shot.siderealHours, d);
    const auto row = [&](int i) { return m[i] * d[0] + m[4 + i] * d[1] + m[8 + i] * d[2]; };
    if (placeOf(star, shot.siderealHours).elevation_deg < 5.0 || row(3) <= 0.0) continue;
    const double x = (row(0) / row(3) + 1.0) * 0.5 * shot.width;
    const double y = (row(1) / row(3) + 1.0) * 0.5 * shot.height;
    if (x < 0.0 || y < 0.0 || x >= shot.width || y >= shot.height) continue;
    const size_t i = (static_cast<size_t>(y) * shot.width + static_cast<size_t>(x)) * 3 + 1;
    detected.push_back({star.magnitude, static_cast<double>(with.pixels[i] - starless.pixels[i]),
                        static_cast<double>(starless.pixels[i])});
  }
  return detected;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

TEST_F(Stars, TheBrightestComeFirstInTwilight) {
  Shot shot;
  shot.aim = {50.0, 190.0};
  shot.fov_deg = 55.0;
  shot.width = 400;
  shot.height = 300;
  std::vector<bool> before;
  double medianBefore = -9.0;
  size_t countBefore = 0;
  for (const double sun : {-8.0, -10.0, -12.0, -14.0}) {
    shot.sunElevation_deg = sun;
    const std::vector<DetectedStar> stars = starsOf(render(shot, true), render(shot, false), shot);
    before.resize(stars.size(), false);
    std::vector<double> fresh;
    for (size_t i = 0; i < stars.size(); ++i) {
      const bool shows = stars[i].light > stars[i].sky;
      EXPECT_TRUE(shows || !before[i]) << "none goes while the sky grows darker";
      if (shows && !before[i]) fresh.push_back(stars[i].magnitude);
      before[i] = shows;
    }
    const auto count = static_cast<size_t>(std::count(before.begin(), before.end(), true));
    ASSERT_FALSE(fresh.empty()) << sun;
    EXPECT_GT(count, countBefore);
    EXPECT_GT(median(fresh), medianBefore) << sun;
    medianBefore = median(fresh);
    countBefore = count;
  }
}

TEST_F(Stars, ExposureBringsThemOutBrightestFirst) {
  Shot shot;
  shot.sunElevation_deg = -18.0;
  shot.aim = {50.0, 190.0};
  shot.fov_deg = 55.0;
  shot.width = 400;
  shot.height = 300;
  const std::vector<DetectedStar> stars = starsOf(render(shot, true), render(shot, false), shot);
  size_t countBefore = 0;
  double faintestBefore = -9.0;
  for (const double exposure : {1e5, 1e6, 1e7, 1e8}) {
    std::vector<double> shown, hidden;
    for (const DetectedStar& star : stars) {
      (exposure * star.light > 0.1 ? shown : hidden).push_back(star.magnitude);
    }
    ASSERT_FALSE(shown.empty());
    const double faintest = *std::max_element(shown.begin(), shown.end());
    EXPECT_GT(shown.size(), countBefore);
    EXPECT_GE(faintest, faintestBefore);
    countBefore = shown.size();
    faintestBefore = faintest;
  }
}

}  // namespace
}  // namespace alpenglow::test
