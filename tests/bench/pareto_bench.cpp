// What each quality level costs and how far it is from the truth: the curve of docs/accuracy.md, as
// its rows. User CPU of lavapipe, all threads, of a second bake; errors of total radiance in per
// cent, 95th percentile / greatest, by sun band.
#include <cstdio>

#include "tests/bench/cpu_time.h"
#include "tests/tables/truth_errors.h"

namespace alpenglow::testing {
namespace {

struct Level {
  const char* name;
  Quality quality;
};

class ParetoBench : public TruthTest {
 protected:
  /// A row of the table; also returns the worst 95th percentile of the bands down to -6 degrees.
  double row(const truth::TruthSet& set, const Level& level) {
    TableDesc desc;
    desc.quality = level.quality;
    bakeTables(set.parameters, desc);
    ResourceReport before, after;
    finishFrames(context());
    resourceReport(context(), &before);
    const double start = userSeconds();
    Tables* tables = bakeTables(set.parameters, desc);
    const double cpu_s = userSeconds() - start;
    finishFrames(context());
    resourceReport(context(), &after);
    const TruthErrors errors = errorsOf(set, tables);
    std::printf("| `%s` | `%s` | %.2f | %.1f |", set.name.c_str(), level.name, cpu_s,
                1e-6 * double(after.bytes - before.bytes));
    double worst = 0.0;
    for (truth::Band band : truth::kBands) {
      std::printf(" %.2f / %.2f |", 100 * errors.p95(band), 100 * errors.most(band));
      if (band <= truth::Band::Civil) worst = std::max(worst, errors.p95(band));
    }
    std::printf(" %.2f |\n", 100 * std::max(errors.groundIrradiance, 0.0));
    std::fflush(stdout);
    return worst;
  }
};

TEST_F(ParetoBench, FinerLevelsHaveSmallerErrors) {
  constexpr Level kLevels[] = {{"draft", Quality::Draft},
                               {"low", Quality::Low},
                               {"medium", Quality::Medium},
                               {"high", Quality::High},
                               {"ultra", Quality::Ultra}};
  std::printf(
      "| set | level | bake cpu-s | MB | day | low | civil | nautical | astronomical | "
      "ground irradiance |\n");
  for (const char* name : {"earth", "earth-hazy", "haze85", "mars"}) {
    const auto set = truth::loadTruth(name);
    ASSERT_TRUE(set) << set.error;
    double before = 1.0;
    for (const Level& level : kLevels) {
      const double worst = row(*set, level);
      // Where the truth's own noise is reached, steps may be small.
      EXPECT_LE(worst, 1.1 * before) << name << " " << level.name;
      before = worst;
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
