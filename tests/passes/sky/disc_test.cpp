// The sun's disc: T times irradiance over its solid angle, the same power at any resolution.
#include <cmath>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr double kSunRadius = radians(0.2667);

/// Looks at the sun, `off` radians beside it.
FrameState towardsSun(const Parameters& parameters, double altitude, double elevation, double fov,
                      VkExtent2D extent, double off = 0.0) {
  const EyeCamera camera = cameraFromGeodetic(parameters, 0.2, 0.3, altitude, 1.0 + off,
                                              elevation + 0.7 * off, 0.0, fov);
  double sun[3];
  sunDirection(0.2, 0.3, elevation, 1.0, sun);
  FrameState draw = makeDraw(camera, vec(sun), extent);
  draw.sun.discRadius = kSunRadius;
  return draw;
}

/// The disc alone: the picture less the same without a disc.
Picture discOnly(const Picture& with, const Picture& discless) {
  Picture disc = with;
  for (size_t i = 0; i < disc.data.size(); ++i) disc.data[i] -= discless.data[i];
  return disc;
}

/// Integral of radiance over solid angle, first channel. The picture's pixels are small.
double power(const Picture& picture, const FrameState& draw, Projection projection) {
  double sum = 0.0;
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) {
      const auto a = pixelDirection(draw, projection, x - 0.5, y - 0.5);
      const auto b = pixelDirection(draw, projection, x + 0.5, y - 0.5);
      const auto c = pixelDirection(draw, projection, x - 0.5, y + 0.5);
      if (!a || !b || !c) continue;
      const Vec right = {(*b)[0] - (*a)[0], (*b)[1] - (*a)[1], (*b)[2] - (*a)[2]};
      const Vec below = {(*c)[0] - (*a)[0], (*c)[1] - (*a)[1], (*c)[2] - (*a)[2]};
      sum += length(cross(right, below)) * static_cast<double>(picture.at(x, y)[0]);
    }
  }
  return sum;
}

TEST_F(SkyTest, DiscHasTheSunsRadiance) {
  Parameters earth = preset("earth");
  earth.solarIrradiance = {{1.0, 2.0, 4.0}};
  Tables* const colored = tables("earth, 1 2 4", earth);
  const double solidAngle = 2.0 * kPi * (1.0 - std::cos(kSunRadius));
  for (const double altitude : {2.0, 1e4, 3.6e7}) {
    for (const double elevation : {radians(50.0), radians(5.0)}) {
      // 1/60 degree a pixel: the radius is 16 of them.
      FrameState draw = towardsSun(earth, altitude, elevation, radians(0.8), {48, 48});
      draw.sun.irradiance = earth.solarIrradiance;
      const Picture with = picture(draw, Projection::Perspective, colored);
      draw.sun.discRadius = 0.0;
      const Picture disc = discOnly(with, picture(draw, Projection::Perspective, colored));
      const Vec sun = vec(draw.sun.direction);
      std::vector<ProbeQuery> queries;
      for (uint32_t y = 0; y < disc.height; ++y)
        for (uint32_t x = 0; x < disc.width; ++x)
          queries.push_back(rayQuery(earth, draw.camera,
                                     *pixelDirection(draw, Projection::Perspective, x, y), sun));
      const std::vector<ProbeAnswer> answers = probeAll(queries, colored);
      int inside = 0, outside = 0;
      for (uint32_t i = 0; i < answers.size(); ++i) {
        const uint32_t x = i % disc.width, y = i / disc.width;
        const Vec view = *pixelDirection(draw, Projection::Perspective, x, y);
        const double pixels =
            (length(cross(view, sun)) - kSunRadius) / (radians(0.8) / disc.height);
        for (uint32_t c = 0; c < 3; ++c) {
          const double whole = answers[i].transmittance[c] * draw.sun.irradiance[c] / solidAngle;
          // The sky behind is subtracted; T is read from the small table, which is 2 % off here.
          if (pixels < -1.0) {
            EXPECT_NEAR(disc.at(x, y)[c], whole, 0.03 * whole);
          } else if (pixels > 1.0) {
            EXPECT_EQ(disc.at(x, y)[c], 0.0f);
          }
        }
        inside += pixels < -1.0 ? 1 : 0;
        outside += pixels > 1.0 ? 1 : 0;
      }
      EXPECT_GT(inside, 600);
      EXPECT_GT(outside, 600);
    }
  }
}

// From a disc of 16 pixels' radius to one of a twentieth: the drawn power stays. A disc smaller
// than a pixel is a cone one pixel in radius, whose sum over the pixels varies by up to 12 % with
// where its centre lies between them; averaged over centres it doesn't.
TEST_F(SkyTest, DiscHasTheSunsPowerAtAnyResolution) {
  const Parameters earth = preset("earth");
  for (const double fov :
       {radians(0.8), radians(3.0), radians(10.0), radians(40.0), radians(100.0)}) {
    for (const Projection projection : {Projection::Perspective, Projection::Fisheye}) {
      double sum = 0.0;
      int count = 0;
      // In space: T is 1, the sky is black.
      for (int i = 0; i < 12; ++i) {
        const double pixel = fov / 48.0;
        const FrameState draw = towardsSun(earth, 1e7, 1.2, fov, {48, 48}, pixel * 0.37 * i);
        sum += power(picture(draw, projection), draw, projection);
        ++count;
      }
      EXPECT_NEAR(sum / count, 1.0, 0.03) << fov << (projection == Projection::Fisheye);
    }
  }
}

// The power stays even where the square of the radius is no longer a number.
TEST_F(SkyTest, DiscOfNoWidthIsFinite) {
  const Parameters earth = preset("earth");
  FrameState draw = towardsSun(earth, 1e7, 1.2, radians(20.0), {48, 48});
  draw.sun.discRadius = 1e-200;
  EXPECT_NEAR(power(picture(draw), draw, Projection::Perspective), 1.0, 0.25);
}

TEST_F(SkyTest, NoDiscBehindTheGround) {
  const Parameters earth = preset("earth");
  for (const double altitude : {0.0, 2.0, 1e4, 3.6e7}) {
    // Just below the horizon, by more than the disc's radius.
    const double dip = horizonDip(earth, altitude);
    FrameState draw = towardsSun(earth, altitude, -dip - radians(0.4), radians(3.0), {32, 32});
    const Picture with = picture(draw);
    draw.sun.discRadius = 0.0;
    const Picture discless = picture(draw);
    EXPECT_EQ(with.data, discless.data) << altitude;
  }
  // Half set: the upper half of the disc is there, the lower is not.
  FrameState draw = towardsSun(earth, 1e4, -horizonDip(earth, 1e4), radians(1.0), {32, 32});
  const Picture with = picture(draw);
  draw.sun.discRadius = 0.0;
  const Picture disc = discOnly(with, picture(draw));
  for (uint32_t x = 0; x < 32; ++x) {
    for (uint32_t y = 17; y < 32; ++y) EXPECT_EQ(disc.at(x, y)[0], 0.0f) << x << " " << y;
  }
  EXPECT_GT(disc.at(16, 14)[0], 0.0f);
}

TEST_F(SkyTest, NoDiscBesideTheFisheyesCircle) {
  const Parameters earth = preset("earth");
  FrameState draw = towardsSun(earth, 2.0, radians(40.0), radians(60.0), {48, 32});
  draw.sun.discRadius = radians(40.0);  // Larger than the circle.
  const Picture drawn = picture(draw, Projection::Fisheye);
  EXPECT_GT(drawn.at(24, 16)[0], 0.0f);
  for (const uint32_t x : {0u, 4u, 43u, 47u})
    for (int c = 0; c < 3; ++c) EXPECT_EQ(drawn.at(x, 16)[c], 0.0f);
}

}  // namespace
}  // namespace alpenglow::testing
