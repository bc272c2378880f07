// A pixel shows what a probe answers for the same ray.
#include <algorithm>
#include <cmath>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

struct Case {
  const char* name;
  double altitude, pitch, fov;  ///< Metres, degrees.
  Projection projection;
};

constexpr Case kCases[] = {
    {"on the ground", 0.0, 10.0, 60.0, Projection::Perspective},
    {"eye height", 2.0, 3.0, 90.0, Projection::Perspective},
    {"eye height, whole sphere", 2.0, 90.0, 360.0, Projection::Fisheye},
    {"airliner", 1e4, -5.0, 70.0, Projection::Perspective},
    {"airliner, whole sphere", 1e4, -90.0, 360.0, Projection::Fisheye},
    {"just outside, limb", 1e5, -10.0, 30.0, Projection::Perspective},
    {"just outside, down", 1e5, -90.0, 170.0, Projection::Fisheye},
    {"geostationary", 3.6e7, -90.0, 20.0, Projection::Perspective},
    {"geostationary, fisheye", 3.6e7, -88.0, 22.0, Projection::Fisheye},
};

/// Rays this near to the horizon may be taken for the other side of it: the shader's direction of a
/// pixel is a float vector, some 2e-7 rad off.
constexpr double kHorizonSlack = 3e-6;

double horizonZenith(const Parameters& parameters, double altitude) {
  return kPi - std::asin(parameters.bottomRadius_m / (parameters.bottomRadius_m + altitude));
}

/// The rays of a picture's pixels, away from the horizon.
struct Rays {
  std::vector<ProbeQuery> queries;
  std::vector<std::pair<uint32_t, uint32_t>> pixels;
};

Rays raysOf(const Parameters& parameters, const FrameState& draw, Projection projection) {
  Rays rays;
  for (uint32_t y = 0; y < draw.viewport.extent.height; ++y) {
    for (uint32_t x = 0; x < draw.viewport.extent.width; ++x) {
      const auto direction = pixelDirection(draw, projection, x, y);
      if (!direction) continue;
      const ProbeQuery query =
          rayQuery(parameters, draw.camera, *direction, vec(draw.sun.direction));
      const double horizon = horizonZenith(parameters, query.altitude_m);
      if (std::abs(query.zenith - horizon) < kHorizonSlack) continue;
      rays.queries.push_back(query);
      rays.pixels.emplace_back(x, y);
    }
  }
  return rays;
}

class PixelTest : public EitherSkyTest {};
INSTANTIATE_TEST_SUITE_P(Solvers, PixelTest, kBothSolvers, solverName);

struct Comparison {
  double worst = 0.0;  ///< Relative to the pixel, or to a thousandth of the brightest one.
  size_t index = 0;
  double brightest = 0.0;
};

Comparison compare(const Picture& drawn, const Rays& rays,
                   const std::vector<ProbeAnswer>& answers) {
  Comparison result;
  for (const ProbeAnswer& a : answers)
    for (uint32_t c = 0; c < kSpectrumSize; ++c)
      result.brightest = std::max(result.brightest, a.skyRadiance[c] + a.groundRadiance[c]);
  for (size_t i = 0; i < answers.size(); ++i) {
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const double wanted = answers[i].skyRadiance[c] + answers[i].groundRadiance[c];
      const double got = drawn.at(rays.pixels[i].first, rays.pixels[i].second)[c];
      const double error = std::abs(got - wanted) / std::max(wanted, 1e-3 * result.brightest);
      if (error > result.worst) {
        result.worst = error;
        result.index = i;
      }
    }
  }
  return result;
}

// Both read the same tables through the same functions. What differs: the picture's ray is computed
// in float, and its position in a table along mu amplifies the rounding like a square root at the
// horizon and at the limb; the ground's transmittance takes 12 points where the probe takes 48,
// which shows in rays from space. Over these pictures that comes to 2e-5 inside the atmosphere and
// 4.4e-4 outside, with either solver; the bounds are 5 and 2 times as much. Only where a ray
// towards the azimuth of a set sun leaves the Earth's shadow is there more, 1.5e-4: it is cut there
// by the moment solver's quadrature, and where that is depends on 1 - nu^2, which has few digits
// left.
TEST_P(PixelTest, PixelsAreWhatProbesAnswer) {
  const Parameters earth = preset("earth");
  for (const Case& one : kCases) {
    for (const double elevation : {40.0, 1.0, -6.0}) {
      const EyeCamera camera =
          cameraFromGeodetic(earth, radians(30.0), radians(-70.0), one.altitude, radians(100.0),
                             radians(one.pitch), radians(20.0), radians(one.fov));
      double sun[3];
      sunDirection(radians(30.0), radians(-70.0), radians(elevation), radians(80.0), sun);
      const FrameState draw = makeDraw(camera, vec(sun), {40, 32});
      const Rays rays = raysOf(earth, draw, one.projection);
      const std::vector<ProbeAnswer> answers = probeAll(rays.queries);
      ASSERT_GT(answers.size(), 600u);
      const Comparison found = compare(picture(draw, one.projection), rays, answers);
      const ProbeQuery& worst = rays.queries[found.index];
      EXPECT_GT(found.brightest, elevation > 0.0 ? 1e-3 : 1e-7) << one.name;
      const bool atShadow = solver() == Solver::Moments && one.altitude == 1e4 && elevation < 0.0;
      EXPECT_LT(found.worst, one.altitude > 6e4 ? 1e-3
                             : atShadow         ? 3e-4
                                                : 1e-4)
          << one.name << ", sun at " << elevation << " degrees, pixel ("
          << rays.pixels[found.index].first << ", " << rays.pixels[found.index].second
          << "), zenith angle " << worst.zenith << ", azimuth " << worst.azimuth;
    }
  }
}

// Packed tables, and another planet.
TEST_F(StandardSkyTest, PixelsAreWhatProbesAnswerForOtherTables) {
  View* const packedView = makeView(viewDesc(), tables("earth", MieStorage::Packed));
  for (const char* name : {"earth", "mars"}) {
    const bool isPacked = name[0] == 'e';
    const Parameters parameters = preset(name);
    Tables* const baked = tables(name, isPacked ? MieStorage::Packed : MieStorage::Full);
    const EyeCamera camera =
        cameraFromGeodetic(parameters, 0.0, 0.0, 500.0, 0.0, radians(5.0), 0.0, radians(80.0));
    double sun[3];
    sunDirection(0.0, 0.0, radians(8.0), radians(20.0), sun);
    const FrameState draw = makeDraw(camera, vec(sun), {40, 32});
    const Rays rays = raysOf(parameters, draw, Projection::Perspective);
    TargetDesc target;
    target.extent = draw.viewport.extent;
    const Picture drawn = picture(isPacked ? packedView : view(), baked, draw, target);
    const Comparison found = compare(drawn, rays, probeAll(rays.queries, baked));
    EXPECT_GT(found.brightest, 1e-3) << name;
    EXPECT_LT(found.worst, 1e-4) << name;
  }
}

// The radiance scale and the sun's irradiance are plain factors, channel by channel.
TEST_F(SkyTest, IrradianceAndScaleMultiply) {
  const Parameters earth = preset("earth");
  const EyeCamera camera =
      cameraFromGeodetic(earth, 0.0, 0.0, 2.0, 0.0, radians(5.0), 0.0, radians(80.0));
  double sun[3];
  sunDirection(0.0, 0.0, radians(20.0), radians(20.0), sun);
  FrameState draw = makeDraw(camera, vec(sun), {24, 16});
  const Picture plain = picture(draw);
  Parameters colored = earth;
  colored.solarIrradiance = {{2.0, 0.5, 0.0}};
  draw.radianceScale = 1024.0;
  const Picture scaled = picture(draw, Projection::Perspective, tables("earth, 2 0.5 0", colored));
  for (uint32_t y = 0; y < plain.height; ++y) {
    for (uint32_t x = 0; x < plain.width; ++x) {
      const float* p = plain.at(x, y);
      const float* s = scaled.at(x, y);
      EXPECT_EQ(s[0], 2048.0f * p[0]);  // Powers of two: exact.
      EXPECT_EQ(s[1], 512.0f * p[1]);
      EXPECT_EQ(s[2], 0.0f);
      EXPECT_EQ(s[3], 1.0f);
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
