// Tables of the moment solver, at the default quality, against the kept truth of the path tracer:
// total radiance of a ray, by sun band, in the measure of docs/reference.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/bake/bake_fixture.h"
#include "tests/reference/truth.h"

namespace alpenglow::testing {
namespace {

using truth::Band;

/// Fractions: 95th percentile and greatest error of total radiance that a band may have.
struct Bound {
  double p95, most;
};

struct Errors {
  std::vector<double> raw, noise;
};

class MomentAccuracyTest : public BakeTest {
 protected:
  /// Prints a line for each band; what was asked for is returned by band.
  std::map<Band, Errors> measure(const std::string& name, Quality quality) {
    const auto set = truth::loadTruth(name);
    EXPECT_TRUE(set) << name;
    if (!set) return {};
    TableDesc desc;
    desc.quality = quality;
    Tables* tables = bakeTables(set->parameters, desc);
    std::vector<ProbeQuery> queries;
    for (const auto& query : set->queries) queries.push_back(query.query);
    const std::vector<ProbeAnswer> answers = probe(tables, queries);
    std::map<Band, Errors> result;
    double transmittance = 0.0, direct = 0.0, irradiance = 0.0;
    for (size_t i = 0; i < answers.size(); ++i) {
      const truth::TruthQuery& query = set->queries[i];
      const truth::AnswerError error = truth::errorOf(query, answers[i]);
      transmittance = std::max(transmittance, error.transmittance);
      direct = std::max(direct, error.direct);
      if (query.band <= Band::Low) irradiance = std::max(irradiance, error.skyIrradiance);
      if (query.query.irradiance) continue;
      const double noise = truth::truthError(query).total;
      Errors& band = result[query.band];
      band.raw.push_back(error.total);
      band.noise.push_back(noise);
    }
    for (Band band : truth::kBands) {
      const Errors& e = result[band];
      std::printf("%-13s %-12s n %3zu  error p95 %6.2f max %7.2f %%  truth p95 %5.2f %%\n",
                  name.c_str(), truth::bandName(band), e.raw.size(),
                  100 * truth::percentile(e.raw, 95), 100 * truth::percentile(e.raw, 100),
                  100 * truth::percentile(e.noise, 95));
    }
    std::printf("%-13s T %.4f %%, direct %.4f %%, sky irradiance by day %.3f %% (max)\n",
                name.c_str(), 100 * transmittance, 100 * direct, 100 * irradiance);
    return result;
  }

  void expect(const std::string& name, const std::map<Band, Bound>& bounds) {
    std::map<Band, Errors> errors = measure(name, Quality::Default);
    for (const auto& [band, bound] : bounds) {
      EXPECT_LE(truth::percentile(errors[band].raw, 95), bound.p95)
          << name << ' ' << truth::bandName(band);
      EXPECT_LE(truth::percentile(errors[band].raw, 100), bound.most)
          << name << ' ' << truth::bandName(band);
    }
  }
};

// Each set is a test of its own: a bake stops at the first failure of its test.
TEST_F(MomentAccuracyTest, EarthAgainstTheTruth) {
  expect("earth", {{Band::Day, {0.0065, 0.017}},
                   {Band::Low, {0.014, 0.020}},
                   {Band::Civil, {0.020, 0.050}},
                   {Band::Nautical, {0.040, 0.080}}});
}

TEST_F(MomentAccuracyTest, HazyEarthAgainstTheTruth) {
  expect("earth-hazy", {{Band::Day, {0.011, 0.016}},
                        {Band::Low, {0.016, 0.020}},
                        {Band::Civil, {0.036, 0.050}},
                        {Band::Nautical, {0.050, 0.080}}});
}

// The other sets have no bound: their figures are printed, and must be finite.
class MomentAccuracyOfSet : public MomentAccuracyTest,
                            public ::testing::WithParamInterface<const char*> {};

TEST_P(MomentAccuracyOfSet, IsFinite) {
  for (const auto& [band, errors] : measure(GetParam(), Quality::Default))
    for (double error : errors.raw) ASSERT_TRUE(std::isfinite(error)) << truth::bandName(band);
}

INSTANTIATE_TEST_SUITE_P(Sets, MomentAccuracyOfSet,
                         ::testing::Values("earth-fig6", "earth-clear", "mars", "haze85", "haze93",
                                           "thick5", "planet60km", "rayleigh-only", "mie-only"));

}  // namespace
}  // namespace alpenglow::testing
