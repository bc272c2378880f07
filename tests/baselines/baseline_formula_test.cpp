// What probes answer is what the papers' formulas give.
#include <algorithm>
#include <cmath>

#include "tests/baselines/baseline_reference.h"

namespace alpenglow::testing {
namespace {

ProbeQuery ray(double altitude, double view, double sun, double azimuth, double distance = -1.0) {
  ProbeQuery q;
  q.altitude_m = altitude;
  q.zenith = radians(view);
  q.sunZenith = radians(sun);
  q.azimuth = radians(azimuth);
  q.bounded = distance >= 0.0;
  q.distance_m = std::max(distance, 0.0);
  return q;
}

/// From the ground, an airliner and near the top; up, to the horizon and down; by day and evening.
std::vector<ProbeQuery> rays() {
  std::vector<ProbeQuery> list;
  for (const double altitude : {2.0, 1e4, 5e4})
    for (const double view : {20.0, 75.0, 89.0, 110.0})
      for (const double sun : {30.0, 80.0}) list.push_back(ray(altitude, view, sun, 50.0));
  return list;
}

void expectNear(const Spectrum& got, const Spectrum& wanted, double tolerance,
                const ProbeQuery& q) {
  const double greatest = *std::max_element(wanted.value, wanted.value + kSpectrumSize);
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    EXPECT_NEAR(got[c], wanted[c], tolerance * std::max(greatest, 1e-6))
        << "channel " << c << " at " << q.altitude_m << " m, zenith " << q.zenith << ", sun "
        << q.sunZenith;
  }
}

template <Solver kSolver>
class BaselineTest : public SkyTest {
 protected:
  BaselineTest() : SkyTest(kSolver) {}

  template <typename Formula>
  void compare(const std::vector<ProbeQuery>& queries, double tolerance, const Formula& formula) {
    const std::vector<ProbeAnswer> answers = probeAll(queries);
    ASSERT_EQ(answers.size(), queries.size());
    for (size_t i = 0; i < queries.size(); ++i)
      expectNear(answers[i].skyRadiance, formula(queries[i]), tolerance, queries[i]);
  }
};

using ONeilTest = BaselineTest<Solver::ONeil>;
using HillaireTest = BaselineTest<Solver::Hillaire>;
using HoffmanPreethamTest = BaselineTest<Solver::HoffmanPreetham>;
using SchafhitzelTest = BaselineTest<Solver::Schafhitzel>;

// What differs is the table of optical depths towards the sun: 256 x 64 texels against integrals.
TEST_F(ONeilTest, IsTheMidpointRule) {
  const BaselineReference reference(preset("earth"));
  compare(rays(), 0.01, [&](const ProbeQuery& q) { return reference.oneil(q, 10); });
}

TEST_F(ONeilTest, TakesAsManyPointsAsAsked) {
  const BaselineReference reference(preset("earth"));
  TableDesc desc;
  desc.solver = Solver::ONeil;
  desc.sizes.stepCount = 3;
  Tables* three = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), desc, &three), Status::Ok) << message();
  bakeAll(device(), three);
  const ProbeQuery query = ray(2.0, 88.0, 50.0, 90.0);
  const ProbeAnswer answer = probeAll({query}, three)[0];
  expectNear(answer.skyRadiance, reference.oneil(query, 3), 0.01, query);
  EXPECT_GT(std::abs(answer.skyRadiance[2] / reference.oneil(query, 10)[2] - 1.0), 0.05);
  destroyTables(three);
}

// At texels of the 32 x 32 table, by way of the sky's irradiance, pi Psi.
TEST_F(HillaireTest, TableIsSecondOrderOverOneLessFactor) {
  const Parameters earth = preset("earth");
  const BaselineReference reference(earth);
  const double thickness = earth.topRadius_m - earth.bottomRadius_m;
  std::vector<ProbeQuery> queries;
  for (const int y : {0, 3, 12, 30}) {
    for (const int x : {17, 20, 26, 31}) {
      ProbeQuery q;
      q.kind = QueryKind::Irradiance;
      q.altitude_m = thickness * y / 31.0;
      q.sunZenith = std::acos(2.0 * x / 31.0 - 1.0);
      queries.push_back(q);
    }
  }
  const std::vector<ProbeAnswer> answers = probeAll(queries);
  for (size_t i = 0; i < queries.size(); ++i) {
    Spectrum wanted = reference.multiple(queries[i].altitude_m, std::cos(queries[i].sunZenith));
    for (double& value : wanted.value) value *= kPi;
    expectNear(answers[i].sky, wanted, 0.01, queries[i]);
  }
}

// Psi is interpolated between texels, the reference takes it at each point.
TEST_F(HillaireTest, RaysAreSingleAndMultipleScattering) {
  const BaselineReference reference(preset("earth"));
  compare({ray(2.0, 20.0, 30.0, 50.0), ray(2.0, 75.0, 60.0, 120.0), ray(1e4, 110.0, 40.0, 50.0)},
          0.02, [&](const ProbeQuery& q) { return reference.hillaire(q, 32); });
}

TEST_F(HoffmanPreethamTest, IsTheClosedForm) {
  const BaselineReference reference(preset("earth"));
  std::vector<ProbeQuery> queries = rays();
  for (const double distance : {1.0, 1e3, 3e4})
    queries.push_back(ray(2.0, 80.0, 50.0, 20.0, distance));
  queries.push_back(ray(2.0, 80.0, 97.0, 20.0));  // The sun below: as at the horizon.
  compare(queries, 1e-4, [&](const ProbeQuery& q) { return reference.hoffmanPreetham(q); });
}

TEST_F(HoffmanPreethamTest, DimsByOpticalMass) {
  const ProbeAnswer answer = probeAll({ray(2.0, 60.0, 30.0, 0.0)})[0];
  const Parameters earth = preset("earth");
  const double mass = 1.0 / (0.5 + 0.15 * std::pow(33.885, -1.253));
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    const double depth = mass * (8400.0 * earth.rayleigh.scattering_per_m[c] +
                                 1250.0 * earth.mie.extinction_per_m[c]);
    EXPECT_NEAR(answer.transmittance[c], std::exp(-depth), 1e-5);
  }
}

// Between texels of the table of rays; those that end near the horizon are the coarsest.
TEST_F(SchafhitzelTest, TableHoldsSingleScatteringAtARightAngle) {
  const BaselineReference reference(preset("earth"));
  std::vector<ProbeQuery> queries;
  for (const double altitude : {2.0, 1e4})
    for (const double view : {20.0, 75.0, 85.0})
      for (const double sun : {30.0, 80.0}) queries.push_back(ray(altitude, view, sun, 50.0));
  compare(queries, 0.03, [&](const ProbeQuery& q) { return reference.schafhitzel(q); });
}

/// Twilight at the antisolar point and opposite of it: radiance without the phase function, which
/// in air of molecules alone is the same for both.
double azimuthRatio(const std::vector<ProbeAnswer>& answers, const std::vector<ProbeQuery>& q) {
  const auto plain = [&](size_t i) {
    const double nu = std::cos(q[i].zenith) * std::cos(q[i].sunZenith) +
                      std::sin(q[i].zenith) * std::sin(q[i].sunZenith) * std::cos(q[i].azimuth);
    return answers[i].skyRadiance[0] / (1.0 + nu * nu);
  };
  return plain(0) / plain(1);
}

TEST_F(SchafhitzelTest, CanNotShowTheEarthsShadow) {
  Parameters molecules = preset("earth");
  molecules.mie.present = false;
  const std::vector<ProbeQuery> queries = {ray(100.0, 86.0, 94.0, 180.0),
                                           ray(100.0, 86.0, 94.0, 0.0)};
  const std::vector<ProbeAnswer> answers = probeAll(queries, tables("molecules", molecules));
  EXPECT_GT(answers[0].skyRadiance[0], 1e-6);
  EXPECT_NEAR(azimuthRatio(answers, queries), 1.0, 1e-3);

  TableDesc desc;  // The full model, of one event and of all.
  desc.quality = Quality::Draft;
  for (const uint32_t orders : {1u, 0u}) {
    desc.orders = orders;
    Tables* full = nullptr;
    ASSERT_EQ(createTables(context(), molecules, desc, &full), Status::Ok) << message();
    bakeAll(device(), full);
    EXPECT_LT(azimuthRatio(probeAll(queries, full), queries), orders == 1 ? 1e-3 : 0.05);
    destroyTables(full);
  }
}

}  // namespace
}  // namespace alpenglow::testing
