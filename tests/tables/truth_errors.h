// Errors of a solver's tables against the kept truth, by sun band.
#pragma once

#include <cmath>
#include <map>

#include "tests/reference/kept_truth.h"
#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {

/// As fractions, in the measure of docs/reference-solution.md.
struct TruthErrors {
  std::map<truth::Band, std::vector<double>> total;  ///< Of rays: what a pixel shows.
  std::map<truth::Band, std::vector<double>> noise;  ///< Standard errors of the truth itself.
  double transmittance = 0.0, direct = 0.0;          ///< Greatest.
  double irradiance = 0.0;        ///< Greatest of sky irradiance, on the ground and above it, while
                                  ///< the sun is up.
  double groundIrradiance = 0.0;  ///< The same on the ground, less twice the truth's noise.

  double p95(truth::Band band) const { return truth::percentile(total.at(band), 95); }
  double most(truth::Band band) const { return truth::percentile(total.at(band), 100); }
};

/// The greater of two; a NaN is the worst of all.
inline double worse(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

/// Device tests that compare with the truth.
class TruthTest : public BakeTest {
 protected:
  /// Fails, and returns nothing, without the set.
  TruthErrors errorsOf(const truth::TruthSet& set, Tables* tables);
};

inline TruthErrors TruthTest::errorsOf(const truth::TruthSet& set, Tables* tables) {
  std::vector<ProbeQuery> queries;
  for (const auto& query : set.queries) queries.push_back(query.query);
  const std::vector<ProbeAnswer> answers = probe(tables, queries);
  TruthErrors result;
  for (size_t i = 0; i < answers.size(); ++i) {
    const truth::TruthQuery& query = set.queries[i];
    const truth::AnswerError error = truth::errorOf(query, answers[i]);
    const truth::AnswerError noise = truth::truthError(query);
    result.transmittance = worse(result.transmittance, error.transmittance);
    result.direct = worse(result.direct, error.direct);
    if (query.query.kind == QueryKind::Ray) {
      EXPECT_TRUE(std::isfinite(error.total)) << query.id;
      result.total[query.band].push_back(error.total);
      result.noise[query.band].push_back(noise.total);
    } else if (query.band <= truth::Band::Low) {
      result.irradiance = worse(result.irradiance, error.skyIrradiance);
      if (query.query.altitude_m == 0.0)
        result.groundIrradiance =
            worse(result.groundIrradiance, error.skyIrradiance - 2.0 * noise.skyIrradiance);
    }
  }
  return result;
}

}  // namespace alpenglow::testing
