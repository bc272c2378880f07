// Frames of a view: what beginFrame answers and refuses, which LUTs are kept, what an abandoned
// frame takes back, and the host's world.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr VkExtent2D kExtent = {24, 16};
const VkCommandBuffer kNoCommands = reinterpret_cast<VkCommandBuffer>(uintptr_t{1});

struct RecordCall {
  const char* name;
  Status (*record)(View*, VkCommandBuffer);
};
constexpr RecordCall kRecordCalls[] = {{"recordLuts", alpenglow::recordLuts},
                                       {"recordShadowMap", recordShadowMap},
                                       {"recordLightShafts", recordLightShafts},
                                       {"recordAerialPerspective", recordAerialPerspective},
                                       {"recordSky", alpenglow::recordSky}};

/// The sun at an elevation, seen from 0 degrees north, 0 degrees east.
Vec sunAt(double elevation, double azimuth = 0.5) {
  double sun[3];
  sunDirection(0.0, 0.0, elevation, azimuth, sun);
  return vec(sun);
}

class FrameTest : public SkyTest {
 protected:
  static FrameState drawAt(double altitude, double elevation, double heading = 0.0) {
    return makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, altitude, heading, 0.1, 0.0, 1.0),
                    sunAt(elevation), kExtent);
  }

  /// A frame number that nothing has been recorded in.
  uint64_t nextFrame() {
    finishFrames(context());
    return device().frame();
  }

  ResourceReport report() {
    ResourceReport result;
    resourceReport(context(), &result);
    return result;
  }

  /// Records something whose commands never execute.
  void recordInVain(const std::function<void(VkCommandBuffer)>& record) {
    std::string error;
    EXPECT_FALSE(device().run(
        [&](VkCommandBuffer commands) {
          record(commands);
          return false;
        },
        &error));
  }

  Picture pictureOf(View* with, const FrameDesc& desc) {
    run([&](VkCommandBuffer commands) {
      return beginFrame(with, desc, nullptr) == Status::Ok &&
             alpenglow::recordLuts(with, commands) == Status::Ok;
    });
    TargetDesc targetDesc;
    targetDesc.extent = kExtent;
    Target target(device(), targetDesc);
    return target.draw([&](VkCommandBuffer commands) {
      return alpenglow::recordSky(with, commands) == Status::Ok;
    });
  }
};

/// Moved about the axis towards the sun: neither altitude nor the sun's elevation change. And
/// turned.
FrameState movedSideways(const FrameState& draw, double angle, double heading) {
  const Vec k = vec(draw.sun.direction), p = vec(draw.camera.position_m), across = cross(k, p);
  const double along = dot(k, p) * (1.0 - std::cos(angle));
  Vec q;
  for (size_t i = 0; i < 3; ++i)
    q[i] = p[i] * std::cos(angle) + across[i] * std::sin(angle) + k[i] * along;
  const Parameters earth = preset("earth");
  FrameState moved = draw;
  moved.camera = cameraFromGeodetic(earth, std::asin(q[2] / length(q)), std::atan2(q[1], q[0]),
                                    length(q) - earth.bottomRadius_m, heading, -0.2, 0.3, 1.2);
  return moved;
}

TEST_F(FrameTest, LutsAreKeptWhileAltitudeSunAndTablesStay) {
  View* const view = makeView({});
  View* const fresh = makeView({});
  const FrameState draw = drawAt(1000.0, 0.4);
  const auto frame = [&](const FrameState& state, Tables* with, bool recorded) {
    nextFrame();
    const ResourceReport before = report();
    FrameWork work;
    run([&](VkCommandBuffer commands) {
      EXPECT_EQ(beginFrame(view, frameDesc(state, with), &work), Status::Ok) << message();
      EXPECT_EQ((work.record & kRecordLuts) != 0, recorded);
      EXPECT_NE(work.record & kRecordSky, 0u);
      EXPECT_EQ(alpenglow::recordLuts(view, commands), Status::Ok) << message();
      return true;
    });
    const ResourceReport after = report();
    EXPECT_EQ(after.lutUpdates - before.lutUpdates, recorded ? 1u : 0u);
    EXPECT_EQ(after.lutsSkipped - before.lutsSkipped, recorded ? 0u : 1u);
    EXPECT_EQ(after.dispatches - before.dispatches, recorded ? 1u : 0u);
    // What was kept is what would be recorded.
    recordViewLuts(fresh, with, state);
    EXPECT_EQ(picture(view, with, state).data, picture(fresh, with, state).data);
  };
  Tables* const earth = tables();
  Tables* const hazy = tables("earth-hazy");
  frame(draw, earth, true);
  frame(draw, earth, false);
  frame(drawAt(1000.0, 0.4, 2.0), earth, false);
  frame(movedSideways(draw, 0.02, 1.0), earth, false);
  frame(movedSideways(draw, -1.3, 4.0), earth, false);
  FrameState brighter = draw;
  brighter.radianceScale = 64.0;
  frame(brighter, earth, false);
  frame(drawAt(1000.5, 0.4), earth, true);
  frame(drawAt(1000.5, 0.401), earth, true);
  frame(drawAt(1000.5, 0.401), hazy, true);
  frame(drawAt(1000.5, 0.401), earth, true);
  frame(drawAt(1000.5, 0.401), earth, false);
}

TEST_F(FrameTest, RecordingNeedsBeginFrameOfThisFrame) {
  View* const view = makeView({});
  const auto expectRefused = [&] {
    for (const RecordCall& call : kRecordCalls) {
      message().clear();
      EXPECT_EQ(call.record(view, kNoCommands), Status::InvalidArgument) << call.name;
      const std::string frame = "frame " + std::to_string(device().frame());
      EXPECT_TRUE(hasAll(message(), call.name + ("|without beginFrame|" + frame))) << message();
    }
  };
  nextFrame();
  expectRefused();
  EXPECT_EQ(beginFrame(view, frameDesc(drawAt(2.0, 0.4)), nullptr), Status::Ok) << message();
  nextFrame();
  expectRefused();
}

TEST_F(FrameTest, NothingIsRecordedAfterAFailure) {
  View* const view = makeView({});
  TableDesc draft;
  draft.quality = Quality::Draft;
  Tables* unbaked = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), draft, &unbaked), Status::Ok);
  const FrameDesc good = frameDesc(drawAt(2.0, 0.4));
  const auto expectNotReady = [&] {
    message().clear();
    for (const RecordCall& call : kRecordCalls)
      EXPECT_EQ(call.record(view, kNoCommands), Status::NotReady) << call.name;
    EXPECT_EQ(message(), "");
  };
  const auto expectZero = [](const FrameWork& work) {
    EXPECT_EQ(work.record, 0u);
    EXPECT_EQ(work.visible, 0u);
    EXPECT_EQ(work.altitude_m, 0.0);
    EXPECT_EQ(work.illuminance[0], 0.0);
    EXPECT_EQ(work.sets[kViewSetTables], VK_NULL_HANDLE);
    EXPECT_EQ(work.images[kViewSkyLut].name, nullptr);
  };
  const ResourceReport before = report();
  FrameWork work;
  ASSERT_EQ(beginFrame(view, good, &work), Status::Ok);
  EXPECT_NEAR(work.altitude_m, 2.0, 1e-6);
  EXPECT_NE(work.visible & kVisibleSky, 0u);
  EXPECT_NE(work.sets[kViewSetTables], VK_NULL_HANDLE);
  EXPECT_NE(work.images[kViewSkyLut].name, nullptr);
  FrameDesc bad = good;
  bad.cameras[0].up[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(beginFrame(view, bad, &work), Status::InvalidArgument);
  expectZero(work);
  expectNotReady();
  FrameDesc early = good;
  early.tables = unbaked;
  message().clear();
  ASSERT_EQ(beginFrame(view, good, &work), Status::Ok);
  EXPECT_EQ(beginFrame(view, early, &work), Status::NotReady);
  EXPECT_EQ(message(), "");
  expectZero(work);
  expectNotReady();
  const ResourceReport after = report();
  EXPECT_EQ(after.dispatches, before.dispatches);
  EXPECT_EQ(after.draws, before.draws);
  // The view is as it was.
  recordViewLuts(view, tables(), drawAt(2.0, 0.4));
  EXPECT_EQ(badValue(picture(view, tables(), drawAt(2.0, 0.4))), "");
  destroyTables(unbaked);
}

TEST_F(FrameTest, AbandonedLutsAreRecordedAgain) {
  View* const view = makeView({});
  const FrameState draw = drawAt(2.0, 0.4);
  recordViewLuts(view, tables(), draw);
  const Picture before = picture(view, tables(), draw);
  const FrameState later = drawAt(2.0, 0.5);
  const uint64_t frame = nextFrame();
  recordInVain([&](VkCommandBuffer commands) {
    EXPECT_EQ(testing::recordLuts(view, commands, tables(), later), Status::Ok) << message();
  });
  ASSERT_EQ(abandonFrame(context(), frame), Status::Ok) << message();
  for (const FrameState& state : {later, draw}) {
    nextFrame();
    expectNeedsSlice(view, tables(), state);
    const uint64_t updates = report().lutUpdates;
    recordViewLuts(view, tables(), state);
    EXPECT_EQ(report().lutUpdates, updates + 1);
  }
  EXPECT_EQ(picture(view, tables(), draw).data, before.data);
}

class StandardFrameTest : public StandardSkyTest {
 protected:
  std::vector<unsigned char> bytesOf(Tables* tables, TableId id) {
    const ImageInfo info = imageOf(tables, id);
    std::string error;
    const headless::HostBuffer buffer =
        device().createHostBuffer(info.bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
    run([&](VkCommandBuffer commands) {
      return recordTableReadback(tables, commands, id, buffer.buffer(), 0) == Status::Ok;
    });
    const auto* bytes = static_cast<const unsigned char*>(buffer.data());
    return {bytes, bytes + info.bytes};
  }
};

TEST_F(StandardFrameTest, AnAbandonedBakeCompletesWithTheSameBytes) {
  Tables* const whole = tables();
  Tables* resumed = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), smallTables(), &resumed), Status::Ok);
  BakeProgress progress;
  finishFrames(context());
  run([&](VkCommandBuffer commands) {
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(recordBake(resumed, commands, 0, &progress), Status::Ok) << message();
    return true;
  });
  const uint64_t done = progress.unitsDone;
  finishFrames(context());
  const uint64_t frame = device().frame();
  std::string error;
  EXPECT_FALSE(device().run(
      [&](VkCommandBuffer commands) {
        while (!progress.done)
          if (recordBake(resumed, commands, 0, &progress) != Status::Ok) break;
        return false;
      },
      &error));
  EXPECT_TRUE(progress.done);
  EXPECT_TRUE(ready(resumed));
  const FrameDesc desc =
      frameDesc(makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, 2.0, 0.0, 0.1, 0.0, 1.0),
                         sunAt(0.4), kExtent),
                resumed);
  EXPECT_EQ(beginFrame(view(), desc, nullptr), Status::Ok) << message();
  ASSERT_EQ(abandonFrame(context(), frame), Status::Ok) << message();
  EXPECT_EQ(infoOf(resumed).state, TablesState::Baking);
  finishFrames(context());
  EXPECT_EQ(beginFrame(view(), desc, nullptr), Status::NotReady);
  EXPECT_EQ(alpenglow::recordSky(view(), kNoCommands), Status::NotReady);
  progress = {};
  run([&](VkCommandBuffer commands) {
    EXPECT_EQ(recordBake(resumed, commands, 0, &progress), Status::Ok) << message();
    EXPECT_EQ(progress.unitsDone, done + progress.unitsRecorded);
    return true;
  });
  bakeAll(device(), resumed);
  EXPECT_TRUE(ready(resumed));
  EXPECT_EQ(beginFrame(view(), desc, nullptr), Status::Ok) << message();
  for (const TableId id : {kTableOpticalDepth, kTableIrradiance, kTableScattering, kTableSingleMie})
    EXPECT_EQ(bytesOf(resumed, id), bytesOf(whole, id)) << id;
  destroyTables(resumed);
}

TEST_F(FrameTest, DestroyedTablesAreNoDefault) {
  TableDesc desc;
  desc.solver = Solver::Moments;
  desc.quality = Quality::Draft;
  Tables* first = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), desc, &first), Status::Ok);
  View* const view = makeView({}, first);
  const FrameState draw = drawAt(2.0, 0.4);
  EXPECT_EQ(beginFrame(view, frameDesc(draw), nullptr), Status::NotReady);  // They aren't baked.
  destroyTables(first);
  message().clear();
  EXPECT_EQ(beginFrame(view, frameDesc(draw), nullptr), Status::InvalidArgument);
  EXPECT_TRUE(hasAll(message(), "FrameDesc::tables is null|createView|destroyed")) << message();
  EXPECT_EQ(beginFrame(view, frameDesc(draw, tables()), nullptr), Status::Ok) << message();

  // Nor can a frame be recorded whose tables have gone since.
  Tables* second = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), desc, &second), Status::Ok);
  bakeAll(device(), second);
  EXPECT_EQ(beginFrame(view, frameDesc(draw, second), nullptr), Status::Ok) << message();
  destroyTables(second);
  for (const RecordCall& call : kRecordCalls)
    EXPECT_EQ(call.record(view, kNoCommands), Status::NotReady) << call.name;
}

TEST_F(FrameTest, WhatLaterVersionsTakeIsRefused) {
  struct BadFrame {
    const char* expected;  ///< Parts of the sentence, separated by '|'.
    std::function<void(FrameDesc&)> spoil;
  };
  const float horizon = 0.0f;
  const BadFrame frames[] = {
      {"FrameDesc::cameras", [](FrameDesc& d) { d.cameras[1] = d.cameras[0]; }},
      {"FrameDesc::cameras", [](FrameDesc& d) { d.cameras[3] = d.cameras[0]; }},
      {"FrameDesc::lights", [](FrameDesc& d) { d.lights[1] = d.lights[0]; }},
      {"FrameDesc::lights", [](FrameDesc& d) { d.lights[3] = d.lights[0]; }},
      {"cameras[0].jitter", [](FrameDesc& d) { d.cameras[0].jitter[1] = 0.5; }},
      {"cameras[0].tangents", [](FrameDesc& d) { d.cameras[0].tangents[2] = 0.3; }},
      {"lights[0].litFrom", [](FrameDesc& d) { d.lights[0].litFrom[0] = 1.0; }},
      {"lights[0].shadowMap",
       [](FrameDesc& d) { d.lights[0].shadowMap = reinterpret_cast<const LightMap*>(&d); }},
      {"lights[0].clouds",
       [](FrameDesc& d) { d.lights[0].clouds = reinterpret_cast<const LightMap*>(&d); }},
      {"World::metersPerUnit|1000", [](FrameDesc& d) { d.world.metersPerUnit = 1000.0; }},
      {"World::equatorialRadius_m", [](FrameDesc& d) { d.world.equatorialRadius_m = 6378137.0; }},
      {"polarRadius_m", [](FrameDesc& d) { d.world.polarRadius_m = 6356752.0; }},
      {"FrameDesc::horizon", [&](FrameDesc& d) { d.horizon = &horizon; }},
      {"FrameDesc::horizon", [](FrameDesc& d) { d.horizonCount = 4; }},
  };
  View* const view = makeView({});
  for (const BadFrame& bad : frames) {
    FrameDesc desc = frameDesc(drawAt(2.0, 0.4), tables());
    bad.spoil(desc);
    message().clear();
    EXPECT_EQ(beginFrame(view, desc, nullptr), Status::Unsupported) << bad.expected;
    EXPECT_TRUE(hasAll(message(), bad.expected)) << bad.expected << ": " << message();
  }
  struct BadView {
    const char* expected;
    std::function<void(ViewDesc&)> spoil;
  };
  const BadView views[] = {
      {"ViewDesc::viewMask", [](ViewDesc& d) { d.viewMask = 3; }},
      {"ViewDesc::color", [](ViewDesc& d) { d.color = ColorSpace::Rec2020; }},
      {"ViewDesc::color", [](ViewDesc& d) { d.color = ColorSpace::Xyz; }},
      {"ViewDesc::skyLightDegree", [](ViewDesc& d) { d.skyLightDegree = 2; }},
      {"ViewDesc::environmentSize", [](ViewDesc& d) { d.environmentSize = 64; }},
      {"ViewDesc::environmentLevels", [](ViewDesc& d) { d.environmentLevels = 5; }},
      {"ViewDesc::environmentFlags", [](ViewDesc& d) { d.environmentFlags = 1; }},
      {"ViewDesc::lutTolerance", [](ViewDesc& d) { d.lutTolerance = 0.01; }},
      {"ViewDesc::lutFrames", [](ViewDesc& d) { d.lutFrames = 2; }},
      {"ViewDesc::aerialPerspective|LutOnly",
       [](ViewDesc& d) { d.aerialPerspective = AerialPerspective::LutOnly; }},
  };
  for (const BadView& bad : views) {
    ViewDesc desc;
    desc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
    bad.spoil(desc);
    message().clear();
    View* made = reinterpret_cast<View*>(uintptr_t{1});
    EXPECT_EQ(createView(context(), tables(), desc, &made), Status::Unsupported) << bad.expected;
    EXPECT_EQ(made, nullptr);
    EXPECT_TRUE(hasAll(message(), bad.expected)) << bad.expected << ": " << message();
  }
}

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
        placeWorld(earth, 0.79, -1.12, 30.0, axes, &world);
        expectSame(pictureOf(drawn, descIn(world, altitude)), wanted, "in a world");
      }
      // A floating origin: the world follows the camera, which stays at 0.
      World world;
      placeWorld(earth, 0.79, -1.12, 30.0, WorldAxes::YUp, &world);
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
  placeWorld(earth, kLatitude, kLongitude, 0.0, WorldAxes::YUp, &skewed);
  FrameDesc bad = descIn(skewed, 2.0);
  bad.world.axes[1][0] += 0.1;
  EXPECT_EQ(beginFrame(view(), bad, nullptr), Status::InvalidArgument);
  EXPECT_TRUE(hasAll(message(), "World::axes|orthonormal")) << message();
}

}  // namespace
}  // namespace alpenglow::testing
