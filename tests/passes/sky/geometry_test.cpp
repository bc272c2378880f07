// Where things are in a picture: projections, angles of the camera, the viewport.
#include <cmath>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

Vec sunAt(double elevation, double azimuth) {
  double sun[3];
  sunDirection(0.0, 0.0, elevation, azimuth, sun);
  return vec(sun);
}

/// The centre of what the disc adds to a picture, in pixels from its corner; (-1, -1): no disc.
struct Spot {
  double x = -1.0, y = -1.0;
};

class GeometryTools {
 public:
  static Spot centre(const Picture& with, const Picture& without) {
    double sum = 0.0, x = 0.0, y = 0.0;
    for (uint32_t j = 0; j < with.height; ++j) {
      for (uint32_t i = 0; i < with.width; ++i) {
        const double light = with.at(i, j)[1] - without.at(i, j)[1];
        sum += light;
        x += light * (i + 0.5);
        y += light * (j + 0.5);
      }
    }
    return sum > 0.0 ? Spot{x / sum, y / sum} : Spot{};
  }
};

struct Aim {
  const char* name;
  double heading, pitch, roll, fov;  ///< Of the camera, degrees.
  double azimuth, elevation;         ///< Of the sun, degrees.
  double right, up;                  ///< Where it must be: fractions of half the viewport's height.
};

// A camera in space whose local frame is that of the ground below it; the sun's place in the
// picture follows from docs/file-formats.md alone.
TEST_F(SkyTest, SunIsWhereTheAnglesSay) {
  const Parameters earth = preset("earth");
  const double t20 = std::tan(radians(20.0)), t30 = std::tan(radians(30.0));
  const Aim perspective[] = {
      {"ahead", 90, 10, 0, 60, 90, 10, 0, 0},
      {"above, fov is vertical", 90, 10, 0, 60, 90, 30, 0, t20 / t30},
      {"below", 45, 50, 0, 60, 45, 30, 0, -t20 / t30},
      {"clockwise is right", 0, 0, 0, 60, 20, 0, t20 / t30, 0},
      {"over north", 350, 0, 0, 60, 10, 0, t20 / t30, 0},
      {"the zenith", 0, 90, 0, 60, 0, 90, 0, 0},
      {"beyond the zenith", 0, 80, 0, 60, 180, 80, 0, t20 / t30},
      // A camera rolled clockwise sees the world turn counter-clockwise.
      {"roll, ahead", 90, 10, 90, 60, 90, 10, 0, 0},
      {"roll 90, above", 90, 10, 90, 60, 90, 30, -t20 / t30, 0},
      {"roll 180, above", 90, 10, 180, 60, 90, 30, 0, -t20 / t30},
      {"roll 90, right", 0, 0, 90, 60, 20, 0, 0, t20 / t30},
  };
  const Aim fisheye[] = {
      {"ahead", 90, 10, 0, 180, 90, 10, 0, 0},
      {"equidistant: 60 of 90", 90, 10, 0, 180, 90, 70, 0, 60.0 / 90.0},
      {"equidistant: 30 of 90", 90, 10, 0, 180, 90, 40, 0, 30.0 / 90.0},
      {"right", 0, 0, 0, 180, 60, 0, 60.0 / 90.0, 0},
      {"behind", 0, 0, 0, 360, 120, 0, 120.0 / 180.0, 0},
      {"all-sky, west", 0, 90, 0, 180, 270, 45, -45.0 / 90.0, 0},
      {"all-sky, south", 0, 90, 0, 180, 180, 45, 0, 45.0 / 90.0},
      {"roll 90, above", 90, 10, 90, 180, 90, 70, -60.0 / 90.0, 0},
  };
  const auto check = [&](const Aim& aim, Projection projection, VkExtent2D extent) {
    FrameState draw =
        makeDraw(cameraFromGeodetic(earth, 0.0, 0.0, 1e7, radians(aim.heading), radians(aim.pitch),
                                    radians(aim.roll), radians(aim.fov)),
                 sunAt(radians(aim.elevation), radians(aim.azimuth)), extent);
    draw.sun.discRadius = radians(3.0 * aim.fov / 60.0);
    const Picture with = picture(draw, projection);
    draw.sun.discRadius = 0.0;
    const Spot spot = GeometryTools::centre(with, picture(draw, projection));
    const double half =
        0.5 *
        (projection == Projection::Fisheye ? std::min(extent.width, extent.height) : extent.height);
    // The disc is stretched away from the centre, hence half a pixel of play.
    EXPECT_NEAR(spot.x, 0.5 * extent.width + half * aim.right, 0.6) << aim.name;
    EXPECT_NEAR(spot.y, 0.5 * extent.height - half * aim.up, 0.6) << aim.name;
  };
  for (const Aim& aim : perspective) {
    check(aim, Projection::Perspective, {64, 48});
    check(aim, Projection::Perspective, {48, 48});
  }
  for (const Aim& aim : fisheye) {
    check(aim, Projection::Fisheye, {64, 48});
    check(aim, Projection::Fisheye, {48, 64});
  }
}

TEST_F(SkyTest, FisheyeIsTheLargestCentredCircle) {
  const Parameters earth = preset("earth");
  for (const VkExtent2D extent : {VkExtent2D{64, 40}, VkExtent2D{40, 64}, VkExtent2D{41, 41}}) {
    const FrameState draw =
        makeDraw(cameraFromGeodetic(earth, 0.0, 0.0, 2.0, 0.0, radians(90.0), 0.0, radians(180.0)),
                 sunAt(radians(30.0), 1.0), extent);
    const Picture drawn = picture(draw, Projection::Fisheye);
    const double radius = 0.5 * std::min(extent.width, extent.height);
    for (uint32_t y = 0; y < extent.height; ++y) {
      for (uint32_t x = 0; x < extent.width; ++x) {
        const double r = std::hypot(x + 0.5 - 0.5 * extent.width, y + 0.5 - 0.5 * extent.height);
        const float* pixel = drawn.at(x, y);
        EXPECT_EQ(pixel[3], 1.0f);
        if (r > radius + 1e-3) {
          EXPECT_EQ(pixel[0] + pixel[1] + pixel[2], 0.0f) << x << " " << y;
        } else if (r < radius - 1e-3) {
          EXPECT_GT(std::min(std::min(pixel[0], pixel[1]), pixel[2]), 0.0f) << x << " " << y;
        }
      }
    }
  }
}

// A rectangle of the attachment: nothing else is touched, and what is in it is what the same
// rectangle would hold as an attachment of its own.
TEST_F(SkyTest, OnlyTheViewportIsDrawn) {
  const Parameters earth = preset("earth");
  TargetDesc target;
  target.extent = {40, 30};
  for (const Projection projection : {Projection::Perspective, Projection::Fisheye}) {
    for (const VkRect2D& area :
         {VkRect2D{{7, 5}, {24, 17}}, VkRect2D{{0, 13}, {40, 17}}, VkRect2D{{39, 29}, {1, 1}}}) {
      FrameState draw =
          makeDraw(cameraFromGeodetic(earth, 0.0, 0.0, 2.0, 0.0, radians(5.0), 0.0, 1.0),
                   sunAt(radians(30.0), 0.3), area.extent);
      draw.sun.discRadius = radians(5.0);
      const Picture alone = picture(draw, projection);
      draw.viewport = area;
      const Picture drawn = picture(view(projection), tables(), draw, target);
      for (uint32_t y = 0; y < target.extent.height; ++y) {
        for (uint32_t x = 0; x < target.extent.width; ++x) {
          const int ax = static_cast<int>(x) - area.offset.x;
          const int ay = static_cast<int>(y) - area.offset.y;
          const bool inside = ax >= 0 && ay >= 0 && ax < static_cast<int>(area.extent.width) &&
                              ay < static_cast<int>(area.extent.height);
          for (int c = 0; c < 4; ++c) {
            const float wanted =
                inside ? alone.at(static_cast<uint32_t>(ax), static_cast<uint32_t>(ay))[c] : kClear;
            // The rasterizer's interpolation differs in the last bits with the place.
            EXPECT_NEAR(drawn.at(x, y)[c], wanted, 2e-4f * std::abs(wanted) + 1e-6f)
                << x << " " << y << " of " << area.offset.x << " " << area.offset.y;
          }
        }
      }
    }
  }
}

// Cameras and sun directions by their angles, against vectors written down by hand.
TEST(CameraTest, AnglesOfTheGround) {
  Parameters earth;
  ASSERT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  const auto expect = [](const double got[3], const Vec& wanted, const char* what) {
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-9) << what << " " << i;
  };
  // Latitude 0, longitude 0: up is x, east is y, north is z.
  EyeCamera c = cameraFromGeodetic(earth, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0, 1.0);
  expect(c.position_m, {earth.bottomRadius_m + 100.0, 0.0, 0.0}, "position");
  expect(c.forward, {0.0, 0.0, 1.0}, "north");
  expect(c.up, {1.0, 0.0, 0.0}, "up");
  for (const double below : {-1.0, -earth.bottomRadius_m, -2.0 * earth.bottomRadius_m}) {
    c = cameraFromGeodetic(earth, 0.0, 0.0, below, 0.0, 0.0, 0.0, 1.0);
    expect(c.position_m, {earth.bottomRadius_m, 0.0, 0.0}, "below the ground");
  }
  c = cameraFromGeodetic(earth, 0.0, 0.0, 0.0, radians(90.0), 0.0, radians(90.0), 1.0);
  expect(c.forward, {0.0, 1.0, 0.0}, "east");
  expect(c.up, {0.0, 0.0, -1.0}, "rolled clockwise: up points right, to the south");
  c = cameraFromGeodetic(earth, 0.0, radians(90.0), 0.0, 0.0, radians(90.0), 0.0, 1.0);
  expect(c.forward, {0.0, 1.0, 0.0}, "zenith at longitude 90");
  expect(c.up, {0.0, 0.0, -1.0}, "pitched up from north, up points south");
  c = cameraFromGeodetic(earth, radians(90.0), 0.0, 0.0, radians(90.0), 0.0, 0.0, 1.0);
  expect(c.forward, {0.0, 1.0, 0.0}, "east at the pole, of longitude 0");
  double sun[3];
  sunDirection(radians(90.0), 0.0, radians(30.0), 0.0, sun);
  expect(sun, {-std::cos(radians(30.0)), 0.0, 0.5}, "sun at the pole, beyond it");
}

}  // namespace
}  // namespace alpenglow::testing
