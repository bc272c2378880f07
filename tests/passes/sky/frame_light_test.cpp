// Frames of a view: the light's colour, warnings, and the host's world.
#include "tests/passes/sky/frame_fixture.h"

namespace alpenglow::testing {
namespace {

// Against a probe of the ray towards the sun, and, where the sun is above the horizontal, of a
// horizontal surface. The sun is a beam, which sets in an instant.
TEST_F(FrameTest, TheLightsColorIsThatOfProbes) {
  Parameters earth = preset("earth");
  earth.sunAngularRadius = 0.0;
  earth.solarIrradiance = {{1.5, 1.2, 0.9}};
  TableDesc fine;
  fine.quality = Quality::Draft;
  fine.format = TableFormat::Float;
  fine.sizes.depthMu = 512;
  fine.sizes.depthH = 128;
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(context(), earth, fine, &baked), Status::Ok) << message();
  bakeAll(device(), baked);
  double worst = 0.0, worstOnGround = 0.0;
  for (const double altitude : {0.0, 2.0, 1e4}) {
    const double dip = horizonDip(earth, altitude) / radians(1.0);  // Degrees.
    for (const double elevation : {90.0, 60.0, 30.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.1, 0.0,
                                   -dip + 1e-4, -dip - 1e-4, -0.5, -dip - 0.5, -30.0}) {
      const FrameState draw = drawAt(altitude, radians(elevation));
      FrameDesc desc = frameDesc(draw, baked);
      desc.radianceScale = 8.0;
      FrameWork work;
      ASSERT_EQ(beginFrame(view(), desc, &work), Status::Ok) << message();
      ProbeQuery ray;
      ray.altitude_m = altitude;
      ray.sunZenith = ray.zenith = radians(90.0 - elevation);
      ProbeQuery surface;
      surface.kind = QueryKind::Irradiance;
      surface.altitude_m = altitude;
      surface.sunZenith = ray.sunZenith;
      const std::vector<ProbeAnswer> answers = probeAll({ray, surface}, baked);
      ASSERT_EQ(answers.size(), 2u);
      const bool set = elevation < -dip - 1e-9;
      double luminance = 0.0;
      for (uint32_t c = 0; c < kSpectrumSize; ++c) {
        const double got = work.color[0][c] / 8.0 / earth.solarIrradiance[c];
        luminance += std::array{0.2126, 0.7152, 0.0722}[c] * work.color[0][c] / 8.0;
        if (set) {
          EXPECT_EQ(got, 0.0) << altitude << " m, sun " << elevation;
          continue;
        }
        EXPECT_GT(got, 0.0) << altitude << " m, sun " << elevation;
        // Exactly at the horizon half of it is taken to have set.
        const double half = elevation == 0.0 && altitude == 0.0 ? 0.5 : 1.0;
        const double arrives = half * answers[0].transmittance[c];
        EXPECT_NEAR(got, arrives, 1e-3 * arrives + 1e-12)
            << altitude << " m, sun " << elevation << ", channel " << c;
        worst = std::max(worst, std::abs(got / arrives - 1.0));
        if (elevation <= 0.0) continue;
        const double direct = answers[1].direct[c] / std::sin(radians(elevation));
        EXPECT_NEAR(got, direct, 1e-3 * direct + 1e-12)
            << altitude << " m, sun " << elevation << ", channel " << c;
        worstOnGround = std::max(worstOnGround, std::abs(got / direct - 1.0));
      }
      EXPECT_NEAR(work.illuminance[0], luminance, 1e-12);
    }
  }
  std::printf(
      "color of the light, greatest relative difference: %.1e of a ray's probe, %.1e of a "
      "surface's\n",
      worst, worstOnGround);
  destroyTables(baked);
}

// A disc sets bit by bit, and gets no brighter on its way down.
TEST_F(FrameTest, TheLightsColorFadesWhileItsDiscSets) {
  Parameters earth = preset("earth");
  earth.sunAngularRadius = radians(0.2667);
  Tables* const baked = tables("earth, disc", earth);
  for (const double altitude : {0.0, 2.0, 1e4}) {
    const double dip = horizonDip(earth, altitude);
    double before[3] = {1e30, 1e30, 1e30};
    for (int i = -40; i <= 40; ++i) {
      const FrameState draw = drawAt(altitude, -dip - radians(0.3) * i / 40.0);
      FrameWork work;
      ASSERT_EQ(beginFrame(view(), frameDesc(draw, baked), &work), Status::Ok) << message();
      for (uint32_t c = 0; c < kSpectrumSize; ++c) {
        const double now = work.color[0][c];
        EXPECT_LE(now, before[c]) << altitude << " m, step " << i << ", channel " << c;
        if (i > -40 && i < 30) {
          EXPECT_GT(now, 0.5 * before[c]) << altitude << " m, step " << i;
        }
        before[c] = now;
      }
    }
    for (const double last : before) EXPECT_EQ(last, 0.0);
  }
}

TEST_F(FrameTest, WarningsComeOnceForAView) {
  struct Heard {
    Severity severity;
    std::string text;
  };
  std::vector<Heard> heard;
  ContextDesc contextDesc = device().contextDesc();
  contextDesc.diagnostics = {
      [](void* user, const Diagnostic& d) {
        static_cast<std::vector<Heard>*>(user)->push_back({d.severity, d.message});
      },
      &heard};
  Context* made = nullptr;
  ASSERT_EQ(createContext(contextDesc, &made), Status::Ok);
  TableDesc tableDesc;
  tableDesc.solver = Solver::HoffmanPreetham;
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), tableDesc, &baked), Status::Ok);
  bakeAll(device(), baked);
  ViewDesc viewDesc;
  viewDesc.colorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
  View* views[2] = {};
  for (View*& view : views) ASSERT_EQ(createView(made, baked, viewDesc, &view), Status::Ok);
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  View* floats = nullptr;
  ASSERT_EQ(createView(made, baked, viewDesc, &floats), Status::Ok);

  FrameDesc good = frameDesc(drawAt(2.0, 0.4));
  good.lights[0].discRadius = radians(0.2667);
  FrameDesc deep = good, dark = good, bright = good;
  for (double& x : deep.cameras[0].position) x *= 1e-3;  // Kilometres.
  dark.lights[0].dimming = 1.0;
  bright.radianceScale = 1e3;
  const struct {
    const FrameDesc& desc;
    const char* expected;
  } cases[] = {{deep, "below the ground|kilometres|FrameDesc::world"},
               {dark, "irradiance|black|Light::dimming"},
               {bright, "FrameDesc::radianceScale|1000|65504"}};
  for (View* view : views) {
    heard.clear();
    EXPECT_EQ(beginFrame(view, good, nullptr), Status::Ok);
    EXPECT_TRUE(heard.empty());
    for (const auto& one : cases) {
      heard.clear();
      for (int i = 0; i < 3; ++i) EXPECT_EQ(beginFrame(view, one.desc, nullptr), Status::Ok);
      ASSERT_EQ(heard.size(), 1u) << one.expected;
      EXPECT_EQ(heard[0].severity, Severity::Warning);
      EXPECT_TRUE(hasAll(heard[0].text, one.expected)) << heard[0].text;
    }
  }
  heard.clear();
  EXPECT_EQ(beginFrame(floats, bright, nullptr), Status::Ok);
  EXPECT_TRUE(heard.empty());
  // A host that never states its frames.
  for (int i = 0; i < 2500; ++i) ASSERT_EQ(beginFrame(floats, good, nullptr), Status::Ok);
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_TRUE(hasAll(heard[0].text, "advanceFrame|once a frame")) << heard[0].text;
  EXPECT_EQ(heard[0].severity, Severity::Warning);
  destroyContext(made);
}

// The same place, seen from a host's world: y up, near or far, with its origin in the camera.
TEST_F(FrameTest, WorldsShowWhatThePlanetFrameShows) {
  const Parameters earth = preset("earth");
  constexpr double kLatitude = 0.8, kLongitude = -1.1;
  const double heading = 0.7, pitch = 0.05, roll = 0.2;
  const auto descIn = [&](const World& world, double altitude) {
    FrameDesc desc;
    desc.tables = tables();
    desc.world = world;
    desc.cameras[0] = cameraAt(earth, world, kLatitude, kLongitude, altitude, heading, pitch, roll);
    desc.cameras[0].fov = 1.1;
    desc.cameras[0].viewport.extent = kExtent;
    directionAt(world, kLatitude, kLongitude, 0.15, 0.9, desc.lights[0].direction);
    desc.lights[0].discRadius = radians(2.0);
    return desc;
  };
  const auto expectSame = [](const Picture& got, const Picture& wanted, const char* what) {
    ASSERT_EQ(got.data.size(), wanted.data.size());
    float most = 0.0f;
    for (const float value : wanted.data) most = std::max(most, value);
    EXPECT_GT(most, 1.0f);
    for (size_t i = 0; i < got.data.size(); ++i)
      ASSERT_NEAR(got.data[i], wanted.data[i], 1e-5f * wanted.data[i]) << what << ", value " << i;
  };
  View* const views[] = {view(), makeView({})};
  for (View* const drawn : views) {
    for (const double altitude : {2.0, 9000.0}) {
      const Picture wanted = pictureOf(drawn, descIn({}, altitude));
      for (const WorldAxes axes : {WorldAxes::EarthCentered, WorldAxes::ZUp, WorldAxes::YUp,
                                   WorldAxes::ZUpLeftHanded, WorldAxes::YUpLeftHanded}) {
        World world;
        ASSERT_EQ(placeWorld(earth, 0.79, -1.12, 30.0, axes, &world, {}), Status::Ok);
        expectSame(pictureOf(drawn, descIn(world, altitude)), wanted, "in a world");
      }
      // A floating origin: the world follows the camera, which stays at 0.
      World world;
      ASSERT_EQ(placeWorld(earth, 0.79, -1.12, 30.0, WorldAxes::YUp, &world, {}), Status::Ok);
      const FrameDesc fixed = descIn(world, altitude);
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i)
          world.origin_m[k] += fixed.cameras[0].position[i] * world.axes[i][k];
      const FrameDesc floating = descIn(world, altitude);
      for (const double x : floating.cameras[0].position) EXPECT_NEAR(x, 0.0, 1e-8);
      expectSame(pictureOf(drawn, floating), wanted, "with a floating origin");
    }
  }
  World skewed;
  ASSERT_EQ(placeWorld(earth, kLatitude, kLongitude, 0.0, WorldAxes::YUp, &skewed, {}), Status::Ok);
  FrameDesc bad = descIn(skewed, 2.0);
  bad.world.axes[1][0] += 0.1;
  EXPECT_EQ(beginFrame(view(), bad, nullptr), Status::InvalidArgument);
  EXPECT_TRUE(hasAll(message(), "World::axes|orthonormal")) << message();
}

}  // namespace
}  // namespace alpenglow::testing
