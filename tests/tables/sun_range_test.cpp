// Tables for a range of sun zenith angles: as good there as those for every sun, and smaller.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Rays from the ground and above it into all directions, and the light on the ground.
std::vector<ProbeQuery> queriesUnder(double sunZenith) {
  std::vector<ProbeQuery> queries;
  for (const double altitude : {2.0, 1000.0, 10000.0}) {
    for (const double zenith : {0.0, 40.0, 70.0, 83.0, 88.0, 89.7, 91.0, 120.0}) {
      for (const double azimuth : {0.0, 20.0, 90.0, 180.0}) {
        ProbeQuery query;
        query.altitude_m = altitude;
        query.zenith = zenith * kDegree;
        query.sunZenith = sunZenith;
        query.azimuth = azimuth * kDegree;
        queries.push_back(query);
      }
    }
  }
  ProbeQuery ground;
  ground.kind = QueryKind::Irradiance;
  ground.sunZenith = sunZenith;
  queries.push_back(ground);
  return queries;
}

class SunRangeTest : public BakeTest {
 protected:
  static TableDesc rangeOf(double from, double to) {
    TableDesc desc;
    desc.sunZenithFrom = from;
    desc.sunZenithTo = to;
    return desc;
  }

  ImageInfo info(const Tables* tables, TableId id) {
    const ImageInfo out = imageOf(tables, id);
    EXPECT_NE(out.name, nullptr);
    return out;
  }

  /// 95th percentile of how far light is from that of the whole tables, in the error measure.
  double difference(const std::vector<ProbeAnswer>& whole, const std::vector<ProbeAnswer>& part) {
    std::vector<double> differences;
    for (size_t i = 0; i < whole.size(); ++i) {
      double worst = 0.0;
      for (uint32_t c = 0; c < kSpectrumSize; ++c) {
        const auto light = [c](const ProbeAnswer& a) {
          return a.skyRadiance[c] + a.groundRadiance[c] + a.sky[c];
        };
        const double floor = std::max(0.02 * whole.back().sky[c] / std::numbers::pi, 1e-9);
        const double off =
            std::abs(light(part[i]) - light(whole[i])) / std::max(light(whole[i]), floor);
        EXPECT_TRUE(std::isfinite(off)) << i;
        worst = std::max(worst, off);
      }
      differences.push_back(worst);
    }
    return percentile(differences, 0.95);
  }
};

// Where nodes lie elsewhere light differs by what the nodes cost in accuracy anyway.
TEST_F(SunRangeTest, LimitedRangesMatchUnlimitedTables) {
  const Parameters earth = preset("earth");
  Tables* whole = bakeTables(earth, {});
  struct Case {
    double elevation_deg, bound;
    uint32_t nodes;
  };
  for (const Case& c : {Case{30.0, 0.001, 6},
                        {5.0, 0.001, 12},
                        {-2.0, 0.004, 16},
                        {-5.0, 0.004, 18},
                        {-11.0, 0.004, 22}}) {
    const double zenith = (90.0 - c.elevation_deg) * kDegree;
    Tables* part = bakeTables(earth, rangeOf(zenith, zenith));
    const auto queries = queriesUnder(zenith);
    EXPECT_LE(difference(probe(whole, queries), probe(part, queries)), c.bound)
        << c.elevation_deg << " degrees";
    EXPECT_LE(info(part, kTableSource).extent.height, c.nodes) << c.elevation_deg << " degrees";
  }
}

TEST_F(SunRangeTest, AWiderRangeTakesMoreNodesUpToAll) {
  const Parameters earth = preset("earth");
  const uint32_t all = info(makeTables(earth, {}), kTableSource).extent.height;
  uint32_t before = 0;
  for (const double half : {0.0, 5.0, 20.0, 40.0, 89.0}) {
    Tables* tables = makeTables(earth, rangeOf((90.0 - half) * kDegree, (90.0 + half) * kDegree));
    const uint32_t nodes = info(tables, kTableSource).extent.height;
    EXPECT_GE(nodes, before) << half;
    EXPECT_LE(nodes, all) << half;
    before = nodes;
  }
  EXPECT_EQ(before, all);
  EXPECT_EQ(info(makeTables(earth, rangeOf(0.0, std::numbers::pi)), kTableSource).extent.height,
            all);
}

// Suns out of the range have the light of its ends; nothing else happens.
TEST_F(SunRangeTest, SunsOutsideTheRangeAreFinite) {
  for (const char* name : {"earth", "mars"}) {
    Tables* tables = bakeTables(preset(name), rangeOf(2.0 * kDegree, 2.0 * kDegree));
    for (const double zenith : {0.0, 60.0, 90.0, 110.0, 180.0}) {
      for (const ProbeAnswer& answer : probe(tables, queriesUnder(zenith * kDegree))) {
        for (uint32_t c = 0; c < kSpectrumSize; ++c) {
          EXPECT_TRUE(std::isfinite(answer.skyRadiance[c]) && answer.skyRadiance[c] >= 0.0);
          EXPECT_TRUE(std::isfinite(answer.sky[c]) && answer.sky[c] >= 0.0);
        }
      }
    }
  }
}

// A sun in the middle of the planet's night needs its tables too.
TEST_F(SunRangeTest, AnyRangeBakes) {
  for (const double zenith : {0.001, 90.0, 130.0, 180.0}) {
    Tables* tables = bakeTables(preset("earth"), rangeOf(zenith * kDegree, zenith * kDegree));
    EXPECT_TRUE(ready(tables)) << zenith;
    for (const ProbeAnswer& answer : probe(tables, queriesUnder(zenith * kDegree)))
      EXPECT_TRUE(std::isfinite(answer.skyRadiance[2])) << zenith;
  }
}

TEST_F(SunRangeTest, WrongRangesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [from, to] : {std::pair{1.0, 0.5}, {-0.1, 1.0}, {1.0, 3.2}, {nan, 1.0}}) {
    Tables* tables = nullptr;
    EXPECT_EQ(createTables(context(), preset("earth"), rangeOf(from, to), &tables),
              Status::InvalidArgument);
    EXPECT_NE(lastDiagnostic().find("must rise from 0"), std::string::npos) << lastDiagnostic();
  }
  TableDesc standard = rangeOf(1.0, 1.1);
  standard.solver = Solver::Standard;
  Tables* tables = nullptr;
  EXPECT_EQ(createTables(context(), preset("earth"), standard, &tables), Status::InvalidArgument);
  EXPECT_NE(lastDiagnostic().find("a range of sun zenith angles"), std::string::npos)
      << lastDiagnostic();
}

}  // namespace
}  // namespace alpenglow::testing
