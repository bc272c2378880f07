// The sky-view LUT of the moment solver against the rays that it stands for: pictures from the LUT
// and by integrating each pixel's ray through the same tables.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

/// A view, and how far its picture from the LUT may be from an integrated one.
struct Look {
  const char* name;
  double altitude;
  double p95, p99;        ///< Relative errors.
  double wildest = 5e-3;  ///< See LutErrors.
};

struct Shot {
  Projection projection;
  double heading, pitch, fov;  ///< Radians.
  VkExtent2D extent;
};

constexpr double kSunAzimuth = 0.5;
// Day, low sun, civil, nautical and astronomical twilight.
constexpr double kSuns[] = {50.0, 3.0, -4.0, -9.0, -15.0};

/// Relative to the pixel, or to a thousandth of the picture's brightest, or to a night sky's 1e-9.
struct LutErrors {
  std::vector<double> errors;
  size_t steps = 0, wildSteps = 0;  ///< Between neighbours; more than 3 of the direct ones + 0.1 %.
  double wildest = 0.0;             ///< By how much more.

  void add(const Picture& direct, const Picture& fromLut) {
    float brightest = 0.0f;
    for (size_t i = 0; i < direct.data.size(); ++i)
      if (i % 4 != 3) brightest = std::max(brightest, direct.data[i]);
    const double dark = std::max(1e-3 * static_cast<double>(brightest), 1e-9);
    for (uint32_t y = 0; y < direct.height; ++y)
      for (uint32_t x = 0; x < direct.width; ++x) addPixel(direct, fromLut, x, y, dark);
  }

 private:
  void addPixel(const Picture& direct, const Picture& fromLut, uint32_t x, uint32_t y,
                double dark) {
    double error = 0.0, excess = 0.0;
    for (int c = 0; c < 3; ++c) {
      const auto step = [&](const Picture& p) {
        return y > 0 ? std::abs(static_cast<double>(p.at(x, y)[c] - p.at(x, y - 1)[c])) : 0.0;
      };
      const double wanted = direct.at(x, y)[c], got = fromLut.at(x, y)[c];
      const double scale = std::max(wanted, dark);
      if (!std::isfinite(got) || !std::isfinite(wanted)) error = 1e30;
      error = std::max(error, std::abs(got - wanted) / scale);
      excess = std::max(excess, (step(fromLut) - 3.0 * step(direct)) / scale - 1e-3);
    }
    errors.push_back(error);
    ++steps;
    wildSteps += excess > 0.0 ? 1 : 0;
    wildest = std::max(wildest, excess);
  }
};

class MomentSkyViewLutTest : public SkyTest {
 protected:
  FrameState drawOf(const Shot& shot, double altitude, double elevation) {
    double sun[3];
    sunDirection(0.0, 0.0, radians(elevation), kSunAzimuth, sun);
    return makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, altitude,
                                       kSunAzimuth + shot.heading, shot.pitch, 0.0, shot.fov),
                    vec(sun), shot.extent);
  }

  /// All shots of one sun look into one LUT, whichever way they turn.
  LutErrors errorsOf(const Look& look, double elevation, const std::vector<Shot>& shots) {
    LutErrors found;
    View* const fromLut = lutView(shots[0].projection);
    recordViewLuts(fromLut, tables(), drawOf(shots[0], look.altitude, elevation));
    for (const Shot& shot : shots) {
      const FrameState draw = drawOf(shot, look.altitude, elevation);
      found.add(picture(draw, shot.projection), picture(fromLut, tables(), draw));
    }
    std::sort(found.errors.begin(), found.errors.end());
    return found;
  }

  /// Compares and prints; the shots may depend on the sun's elevation in degrees.
  void expectClose(const Look& look, const std::function<std::vector<Shot>(double)>& shots) {
    std::printf("%-9s %9.0f m ", look.name, look.altitude);
    for (const double elevation : kSuns) {
      const LutErrors found = errorsOf(look, elevation, shots(elevation));
      const std::vector<double>& e = found.errors;
      const double p95 = e[e.size() * 95 / 100], p99 = e[e.size() * 99 / 100];
      const double wild = double(found.wildSteps) / double(found.steps);
      std::printf("| %5.3f %5.3f, %.3f %4.2f ", 100 * p95, 100 * p99, 100 * wild,
                  100 * found.wildest);
      EXPECT_LT(p95, look.p95) << look.name << " " << look.altitude << ", sun " << elevation;
      EXPECT_LT(p99, look.p99) << look.name << " " << look.altitude << ", sun " << elevation;
      EXPECT_LT(wild, 6e-3) << look.name << " " << look.altitude << ", sun " << elevation;
      EXPECT_LT(found.wildest, look.wildest)
          << look.name << " " << look.altitude << ", sun " << elevation;
    }
    std::printf("\n");
  }

  static double dip(double altitude) { return horizonDip(preset("earth"), altitude); }
  /// Angle from the horizon to the top of the atmosphere, or 3 degrees inside it.
  static double limb(double altitude) {
    const Parameters earth = preset("earth");
    const double r = earth.bottomRadius_m + altitude;
    return r > earth.topRadius_m ? dip(altitude) - std::acos(earth.topRadius_m / r) : radians(3.0);
  }
};

// At 61 km the pixels, 4 degrees apart, straddle the edge of the night in the limb.
TEST_F(MomentSkyViewLutTest, WholePicturesAreThoseOfTheTables) {
  for (const Look& look : {Look{"whole", 2.0, 2e-3, 5e-3}, Look{"whole", 1e4, 2e-3, 5e-3},
                           Look{"whole", 5.9e4, 1e-3, 6e-3}, Look{"whole", 6.1e4, 3e-4, 3e-3, 0.05},
                           Look{"whole", 4e5, 3e-4, 2e-3}, Look{"whole", 3.6e7, 7e-3, 3e-2}}) {
    const double fov = look.altitude > 1e7 ? radians(18.5) : 2.0 * kPi;
    expectClose(look, [&](double) -> std::vector<Shot> {
      return {{Projection::Fisheye, 0.0, radians(-90.0), fov, {96, 96}}};
    });
  }
}

TEST_F(MomentSkyViewLutTest, TheHorizonIsThatOfTheTables) {
  for (const Look& look : {Look{"horizon", 2.0, 1e-3, 2e-3}, Look{"horizon", 1e4, 1e-2, 1.5e-2},
                           Look{"horizon", 4e5, 8e-3, 1e-2}, Look{"horizon", 3.6e7, 4e-3, 5e-3}}) {
    expectClose(look, [&](double) {
      std::vector<Shot> shots;
      for (const double azimuth : {0.0, 15.0, 60.0, 180.0})
        shots.push_back({Projection::Perspective,
                         radians(azimuth),
                         -dip(look.altitude),
                         radians(0.1),
                         {4, 64}});
      return shots;
    });
  }
}

TEST_F(MomentSkyViewLutTest, TheLimbIsThatOfTheTables) {
  for (const Look& look : {Look{"limb", 2.0, 2e-3, 3e-3}, Look{"limb", 1e4, 4e-2, 6e-2},
                           Look{"limb", 4e5, 1e-2, 2e-2}, Look{"limb", 3.6e7, 4e-3, 5e-3}}) {
    const double high = limb(look.altitude);
    expectClose(look, [&](double) {
      std::vector<Shot> shots;
      for (const double azimuth : {0.0, 60.0, 180.0})
        shots.push_back({Projection::Perspective,
                         radians(azimuth),
                         0.5 * high - dip(look.altitude),
                         1.3 * high,
                         {8, 96}});
      return shots;
    });
  }
}

TEST_F(MomentSkyViewLutTest, TheAureoleIsThatOfTheTables) {
  for (const Look& look : {Look{"aureole", 2.0, 5e-4, 1e-3}, Look{"aureole", 1e4, 4e-3, 8e-3}}) {
    expectClose(look, [&](double elevation) -> std::vector<Shot> {
      return {{Projection::Perspective, 0.0, radians(elevation), radians(6.0), {48, 48}}};
    });
  }
}

/// Greatest relative difference.
double difference(const Picture& a, const Picture& b) {
  double worst = 0.0;
  for (size_t i = 0; i < a.data.size(); ++i) {
    const double step = std::abs(static_cast<double>(a.data[i]) - static_cast<double>(b.data[i]));
    if (!std::isfinite(step)) return 1e30;
    worst = std::max(worst, step / std::max(static_cast<double>(b.data[i]), 1e-30));
  }
  return worst;
}

// A picture from the LUT differs by more than rounding.
TEST_F(MomentSkyViewLutTest, IsNotReadForAnotherCameraSunOrTables) {
  constexpr double kLut = 3e-5;
  Tables* const earth = tables();
  Tables* const hazy = tables("earth-hazy");
  View* const fromLut = lutView(Projection::Perspective);
  const Shot ahead = {Projection::Perspective, 0.2, 0.1, 1.2, {24, 16}};
  const FrameState draw = drawOf(ahead, 2.0, 20.0);
  const Picture ofEarth = picture(draw), ofHaze = picture(draw, ahead.projection, hazy);
  recordViewLuts(fromLut, earth, draw);
  EXPECT_GT(difference(picture(fromLut, earth, draw), ofEarth), kLut);
  for (const FrameState& other :
       {drawOf(ahead, 2.5, 20.0), drawOf(ahead, 2.0, 20.1), drawOf(ahead, 4e5, 20.0)})
    expectNeedsSlice(fromLut, earth, other);
  expectNeedsSlice(fromLut, hazy, draw);
  // One LUT for the tables of any atmosphere.
  recordViewLuts(fromLut, hazy, draw);
  EXPECT_GT(difference(picture(fromLut, hazy, draw), ofHaze), kLut);
  expectNeedsSlice(fromLut, earth, draw);
}

// No finer than what the tables hold is right: docs/accuracy.md has the errors of the levels.
TEST_F(MomentSkyViewLutTest, CoarserLevelsHaveCoarserLuts) {
  struct Level {
    const char* name;
    Quality quality;
    double p95;
  };
  uint64_t bytes = 0;
  for (const Level& level : {Level{"draft", Quality::Draft, 1e-2}, Level{"low", Quality::Low, 5e-3},
                             Level{"medium", Quality::Medium, 2e-3}}) {
    TableDesc desc;
    desc.quality = level.quality;
    Tables* tables = nullptr;
    ASSERT_EQ(createTables(context(), preset("earth"), desc, &tables), Status::Ok) << message();
    bakeAll(device(), tables);
    ViewDesc viewDesc;
    viewDesc.projection = Projection::Fisheye;
    ResourceReport before, after;
    resourceReport(context(), &before);
    View* const fromLut = makeView(viewDesc, tables);
    resourceReport(context(), &after);
    EXPECT_GT(after.bytes - before.bytes, bytes) << level.name;
    bytes = after.bytes - before.bytes;
    std::printf("%-7s", level.name);
    const Shot shot = {Projection::Fisheye, 0.0, radians(-90.0), 2.0 * kPi, {96, 96}};
    for (const double altitude : {2.0, 1e4}) {
      for (const double elevation : kSuns) {
        const FrameState draw = drawOf(shot, altitude, elevation);
        LutErrors found;
        recordViewLuts(fromLut, tables, draw);
        found.add(picture(draw, shot.projection, tables), picture(fromLut, tables, draw));
        std::sort(found.errors.begin(), found.errors.end());
        const double p95 = found.errors[found.errors.size() * 95 / 100];
        std::printf(" %5.3f", 100 * p95);
        EXPECT_LT(p95, level.p95) << level.name << " " << altitude << ", sun " << elevation;
      }
    }
    std::printf("\n");
    destroyTables(tables);
  }
}

TEST_F(MomentSkyViewLutTest, IsOneDispatchInsideAndOutside) {
  View* const fromLut = lutView(Projection::Perspective);
  for (const double altitude : {2.0, 4e5}) {
    ResourceReport before, after;
    resourceReport(context(), &before);
    recordViewLuts(fromLut, tables(),
                   drawOf({Projection::Perspective, 0.2, 0.1, 1.2, {24, 16}}, altitude, 20.0));
    resourceReport(context(), &after);
    EXPECT_EQ(after.dispatches, before.dispatches + 1);
  }
}

}  // namespace
}  // namespace alpenglow::testing
