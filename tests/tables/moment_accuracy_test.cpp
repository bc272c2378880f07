// Tables of the moment solver, at the default quality, against the kept truth of the path tracer:
// total radiance of a ray, by sun band, in the measure of docs/reference-solution.md. The bounds
// are the project's goals.
#include <cstdio>

#include "tests/tables/truth_errors.h"

namespace alpenglow::testing {
namespace {

using truth::Band;

/// Per cent: 95th percentile and greatest error of total radiance that a band may have; 0 for none.
struct Bound {
  double p95, most;
};

struct Goal {
  const char* set;
  Bound day, low, civil, nautical;

  const Bound& of(Band band) const {
    return band == Band::Day     ? day
           : band == Band::Low   ? low
           : band == Band::Civil ? civil
                                 : nautical;
  }
};

constexpr Bound kNone = {0.0, 0.0};
constexpr Goal kGoals[] = {{"earth", {0.5, 1.2}, {0.7, 2.0}, {2.0, 5.0}, {4.0, 8.0}},
                           {"earth-fig6", {0.5, 1.2}, {0.7, 2.0}, {2.0, 5.0}, {4.0, 8.0}},
                           {"earth-clear", {0.5, 1.2}, {0.7, 2.0}, {2.0, 5.0}, {4.0, 8.0}},
                           {"earth-hazy", {0.5, 1.2}, {0.7, 2.0}, {2.0, 5.0}, {4.0, 8.0}},
                           {"haze85", {3.0, 7.0}, {3.0, 6.0}, {5.0, 9.0}, {5.0, 15.0}},
                           {"haze93", {5.0, 10.0}, {5.0, 10.0}, {8.0, 15.0}, kNone},
                           {"thick5", {5.0, 10.0}, {5.0, 10.0}, {8.0, 15.0}, kNone},
                           {"mars", {5.0, 10.0}, {5.0, 10.0}, {8.0, 15.0}, kNone},
                           {"planet60km", {5.0, 10.0}, {5.0, 10.0}, {8.0, 15.0}, kNone},
                           {"rayleigh-only", {0.5, 1.2}, {0.7, 2.0}, {2.0, 5.0}, {4.0, 8.0}},
                           {"mie-only", {5.0, 10.0}, {5.0, 10.0}, {8.0, 15.0}, kNone}};

void print(const char* name, const TruthErrors& errors) {
  for (Band band : truth::kBands) {
    std::printf("%-13s %-12s n %3zu  error p95 %6.2f max %7.2f %%  truth p95 %5.2f %%\n", name,
                truth::bandName(band), errors.total.at(band).size(), 100 * errors.p95(band),
                100 * errors.most(band), 100 * truth::percentile(errors.noise.at(band), 95));
  }
  std::printf(
      "%-13s max: T %.4f %%, direct %.4f %%, sky irradiance %.3f %%, on the ground beyond the "
      "truth's noise %.3f %%\n",
      name, 100 * errors.transmittance, 100 * errors.direct, 100 * errors.irradiance,
      100 * std::max(errors.groundIrradiance, 0.0));
}

class MomentAccuracyTest : public TruthTest, public ::testing::WithParamInterface<Goal> {};

TEST_P(MomentAccuracyTest, IsWithinTheGoals) {
  const Goal& goal = GetParam();
  const auto set = truth::loadTruth(goal.set);
  ASSERT_TRUE(set) << set.error;
  const TruthErrors errors = errorsOf(*set, bakeTables(set->parameters, {}));
  ASSERT_FALSE(HasFailure());
  print(goal.set, errors);
  for (Band band : {Band::Day, Band::Low, Band::Civil, Band::Nautical}) {
    const Bound& bound = goal.of(band);
    if (bound.most == 0.0) continue;
    EXPECT_LE(100 * errors.p95(band), bound.p95) << truth::bandName(band);
    EXPECT_LE(100 * errors.most(band), bound.most) << truth::bandName(band);
  }
  EXPECT_LE(100 * errors.transmittance, 0.1);
  EXPECT_LE(100 * errors.direct, 0.1);
  EXPECT_LE(100 * errors.groundIrradiance, 0.3);
}

std::string nameOf(const ::testing::TestParamInfo<Goal>& info) {
  std::string name = info.param.set;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Sets, MomentAccuracyTest, ::testing::ValuesIn(kGoals), nameOf);

}  // namespace
}  // namespace alpenglow::testing
