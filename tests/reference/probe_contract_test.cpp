// What point queries answer at the edges of their domain, as the probe file's documentation has it.
#include <alpenglow/reference/reference.h>

#include <cmath>
#include <limits>

#include "test_atmospheres.h"

namespace alpenglow {
namespace {

using namespace test;

ProbeAnswer ask(const ProbeQuery& query, const char* name = "earth") {
  ReferenceAnswer answer;
  EXPECT_EQ(referenceSingleScattering(preset(name), query, &answer, {}), Status::Ok);
  return answer.value;
}

void expectNothing(const ProbeAnswer& a) {
  EXPECT_FALSE(a.hitsGround);
  expectAll(a.transmittance, 1.0, "transmittance");
  expectAll(a.skyRadiance, 0.0, "sky");
  expectAll(a.groundRadiance, 0.0, "ground");
}

TEST(ProbeContract, RaysThatMissAnswerNothing) {
  expectNothing(ask(rayQuery(400e3, 0, 30, 0)));
  expectNothing(ask(rayQuery(400e3, 90, 30, 0)));
  expectNothing(ask(rayQuery(36e6, 171, 30, 0)));  // The planet's limb is at 171.3 degrees.
  EXPECT_LT(ask(rayQuery(36e6, 171.4, 30, 0)).transmittance[0], 1.0);
}

TEST(ProbeContract, SpaceInFrontAddsNothing) {
  // The same ray, from where it enters and from 1,000 km further out.
  const double top = 60e3, rt = 6420e3, out = 1000e3;
  const double zenith = 110 * kDegree;  // At the entry.
  const double x = out * std::sin(zenith), z = rt - out * std::cos(zenith);
  const double turn = std::atan2(x, z);
  const ProbeAnswer entry = ask(rayQuery(top, 110, 40, 0));
  // Going back along the ray turns the vertical away from the view's side.
  ProbeQuery query;
  query.altitude_m = std::hypot(x, z) - 6360e3;
  query.zenith = zenith + turn;
  query.sunZenith = 40 * kDegree + turn;
  const ProbeAnswer far = ask(query);
  EXPECT_TRUE(far.hitsGround);
  expectClose(far.transmittance, entry.transmittance, 1e-8, "transmittance");
  expectClose(far.skyRadiance, entry.skyRadiance, 1e-8, "sky");
  expectClose(far.groundRadiance, entry.groundRadiance, 1e-8, "ground");

  query.bounded = true;
  query.distance_m = 0.999 * out;
  expectNothing(ask(query));
  query.distance_m = out + 1000.0;
  const ProbeAnswer part = ask(query);
  EXPECT_FALSE(part.hitsGround);
  EXPECT_GT(part.skyRadiance[0], 0.0);
  ProbeQuery cut = rayQuery(top, 110, 40, 0, 1000.0);
  expectClose(part.skyRadiance, ask(cut).skyRadiance, 1e-6, "first kilometre");
}

TEST(ProbeContract, DistanceIsCutAtTheEnd) {
  const ProbeAnswer whole = ask(rayQuery(1000, 120, 50, 30));
  ASSERT_TRUE(whole.hitsGround);
  const ProbeAnswer cut = ask(rayQuery(1000, 120, 50, 30, 1e9));
  EXPECT_TRUE(cut.hitsGround);
  expectClose(cut.skyRadiance, whole.skyRadiance, 0, "sky");
  expectClose(cut.groundRadiance, whole.groundRadiance, 0, "ground");

  const ProbeAnswer shortOne = ask(rayQuery(1000, 120, 50, 30, 1990));  // 2,000.3 m to the ground
  EXPECT_FALSE(shortOne.hitsGround);
  expectAll(shortOne.groundRadiance, 0.0, "ground of a segment that stops short");
  EXPECT_GT(shortOne.transmittance[2], whole.transmittance[2]);
  EXPECT_LT(shortOne.skyRadiance[2], whole.skyRadiance[2]);
}

TEST(ProbeContract, DistanceZeroAnswersNothing) {
  expectNothing(ask(rayQuery(1000, 30, 50, 30, 0)));
  expectNothing(ask(rayQuery(36e6, 180, 50, 30, 0)));
}

TEST(ProbeContract, DownwardAtAltitudeZeroSeesTheGround) {
  for (double view : {91.0, 120.0, 180.0}) {
    const ProbeAnswer a = ask(rayQuery(0, view, 60, 0));
    EXPECT_TRUE(a.hitsGround);
    expectAll(a.transmittance, 1.0, "transmittance");
    expectAll(a.skyRadiance, 0.0, "sky");
    const ProbeAnswer light = ask(irradianceQuery(0, 60));
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      EXPECT_NEAR(a.groundRadiance[i], 0.1 / std::numbers::pi * light.direct[i], 1e-12);
    }
  }
}

TEST(ProbeContract, TangentRayMisses) {
  const ProbeAnswer a = ask(rayQuery(0, 90, 60, 0));
  EXPECT_FALSE(a.hitsGround);
  EXPECT_LT(a.transmittance[2], 0.1) << "a ray along the whole horizon";
  // Each side of the horizon of an observer at 2 m, 0.0454 degrees down.
  EXPECT_FALSE(ask(rayQuery(2, 90.045, 60, 0)).hitsGround);
  EXPECT_TRUE(ask(rayQuery(2, 90.046, 60, 0)).hitsGround);
}

TEST(ProbeContract, DirectIrradianceIsTransmittedSunlight) {
  const ProbeAnswer ground = ask(irradianceQuery(0, 60));
  const ProbeAnswer ray = ask(rayQuery(0, 60, 60, 0));  // Towards the sun.
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    EXPECT_NEAR(ground.direct[i], 0.5 * ray.transmittance[i], 1e-10);
    EXPECT_EQ(ground.sky[i], 0.0);
  }
  expectAll(ask(irradianceQuery(0, 90.0001)).direct, 0.0, "sun below the surface");
  expectAll(ask(irradianceQuery(0, 180)).direct, 0.0, "midnight");
  expectAll(ask(irradianceQuery(36e6, 170)).direct, 0.0, "in the planet's shadow");
  for (double value : ask(irradianceQuery(100e3, 60)).direct.value) {
    EXPECT_NEAR(value, 0.5, 1e-15) << "above the top";
  }
}

TEST(ProbeContract, GroundAfterSunsetIsDark) {
  const ProbeAnswer a = ask(rayQuery(10e3, 150, 100, 0));
  EXPECT_TRUE(a.hitsGround);
  expectAll(a.groundRadiance, 0.0, "ground");
}

TEST(ProbeContract, AzimuthIsPeriodicAndEven) {
  const ProbeAnswer a = ask(rayQuery(2, 70, 80, 50));
  for (double azimuth : {-50.0, 410.0, -310.0, 36050.0}) {
    expectClose(ask(rayQuery(2, 70, 80, azimuth)).skyRadiance, a.skyRadiance, 1e-9, "sky");
  }
}

TEST(ProbeContract, BadQueriesAreRefused) {
  const Parameters p = preset("earth");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  ReferenceAnswer a;
  a.value.skyRadiance[0] = 7;
  for (double ProbeQuery::*field :
       {&ProbeQuery::altitude_m, &ProbeQuery::zenith, &ProbeQuery::sunZenith, &ProbeQuery::azimuth,
        &ProbeQuery::distance_m}) {
    for (double value : {nan, infinity, -infinity}) {
      ProbeQuery query = rayQuery(2, 70, 80, 50);
      query.*field = value;
      EXPECT_EQ(referenceSingleScattering(p, query, &a, {}), Status::InvalidArgument);
    }
  }
  EXPECT_EQ(referenceSingleScattering(p, rayQuery(-1, 0, 0, 0), &a, {}), Status::InvalidArgument);
  EXPECT_EQ(referenceSingleScattering(p, rayQuery(0, -1, 0, 0), &a, {}), Status::InvalidArgument);
  EXPECT_EQ(referenceSingleScattering(p, rayQuery(0, 181, 0, 0), &a, {}), Status::InvalidArgument);
  EXPECT_EQ(referenceSingleScattering(p, rayQuery(0, 0, 181, 0), &a, {}), Status::InvalidArgument);
  EXPECT_EQ(referenceSingleScattering(p, rayQuery(0, 0, 0, 0), nullptr, {}),
            Status::InvalidArgument);
  EXPECT_EQ(referenceSingleScattering(Parameters{}, rayQuery(0, 0, 0, 0), &a, {}),
            Status::InvalidArgument);
  EXPECT_EQ(a.value.skyRadiance[0], 7) << "a failed call changed the object";
}

TEST(ProbeContract, AirlessPlanetShowsItsGround) {
  Parameters p = preset("earth");
  p.rayleigh.present = p.mie.present = p.absorption.present = false;
  ReferenceAnswer a;
  ASSERT_EQ(referenceSingleScattering(p, rayQuery(1000, 120, 60, 0), &a, {}), Status::Ok);
  expectAll(a.value.transmittance, 1.0, "transmittance");
  expectAll(a.value.skyRadiance, 0.0, "sky");
  EXPECT_NEAR(a.value.groundRadiance[0], 0.1 / std::numbers::pi * 0.5, 1e-5);
}

}  // namespace
}  // namespace alpenglow
