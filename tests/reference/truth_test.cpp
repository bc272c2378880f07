// The kept truth: that it is whole, that it covers what it is for, that its errors are those it
// claims, and that the reference of today still gives it.
#include "tests/reference/kept_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>

namespace alpenglow::truth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

class TruthData : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const io::Result<TruthSet> loaded = loadTruth(GetParam());
    ASSERT_TRUE(loaded) << loaded.error;
    set_ = *loaded;
  }
  TruthSet set_;
};

TEST_P(TruthData, CoversEachBand) {
  std::map<Band, std::set<std::string>> kinds;
  for (const TruthQuery& q : set_.queries) kinds[q.band].insert(q.kind);
  if (set_.name == "evening") {  // A sun that stands still.
    ASSERT_EQ(kinds.size(), 1u);
    EXPECT_GE(kinds[Band::Low].size(), 7u);
    return;
  }
  for (const Band band : kBands) {
    for (const char* kind : {"sky", "horizon", "irradiance", "segment", "limb", "down"}) {
      // Bands of a single sun don't hold every kind in the small sets.
      const bool small = band == Band::Civil || band == Band::Nautical || band == Band::Low ||
                         band == Band::Astronomical;
      if (small && (std::string(kind) == "limb" || std::string(kind) == "down")) continue;
      EXPECT_TRUE(kinds[band].count(kind)) << bandName(band) << " " << kind;
    }
  }
  EXPECT_TRUE(kinds[Band::Day].count("aureole"));
}

TEST_P(TruthData, ErrorsAreSmall) {
  // The presets that were sampled until the target, and those with a fixed number of paths, whose
  // goals are coarser too.
  const bool fine = set_.name == "earth" || set_.name == "earth-fig6" || set_.name == "evening";
  std::printf("| %s |", set_.name.c_str());
  std::map<Band, std::vector<double>> errors;
  for (const TruthQuery& q : set_.queries) {
    const AnswerError error = truthError(q);
    errors[q.band].push_back(std::max(error.total, error.skyIrradiance));
    EXPECT_LT(error.transmittance, 1e-8);
  }
  // What tracing stops at, docs/reference-solution.md.
  const std::map<Band, double> allowed = {{Band::Day, 0.001},
                                          {Band::Low, 0.001},
                                          {Band::Civil, 0.003},
                                          {Band::Nautical, 0.005},
                                          {Band::Astronomical, 0.01}};
  for (const auto& [band, limit] : allowed) {
    const double median = percentile(errors[band], 50), p95 = percentile(errors[band], 95);
    EXPECT_LT(median, (fine ? 1.0 : 15.0) * limit) << bandName(band);
    EXPECT_LT(p95, (fine ? 2.0 : 30.0) * limit) << bandName(band);
    std::printf(" %.2f / %.2f / %.2f |", 100 * median, 100 * p95,
                100 * percentile(errors[band], 100));
  }
  std::printf("\n");
}

// One query of each kind, again, with other random numbers.
TEST_P(TruthData, TheReferenceStillGivesIt) {
  std::set<std::string> seen;
  size_t turn = 0;
  for (const TruthQuery& q : set_.queries) {
    if (turn++ % 7 != 0 || !seen.insert(q.kind).second) continue;
    ReferenceOptions options;
    options.pathCount = 16384;
    options.seed = 1234;
    ReferenceAnswer again;
    ASSERT_EQ(evaluateReference(set_.parameters, q.query, options, &again, {}), Status::Ok);
    EXPECT_EQ(again.value.hitsGround, q.truth.value.hitsGround);
    const auto expectSame = [&](Spectrum ProbeAnswer::*field, const char* what) {
      for (uint32_t c = 0; c < kSpectrumSize; ++c) {
        const double kept = (q.truth.value.*field)[c];
        const double error =
            std::hypot((q.truth.standardError.*field)[c], (again.standardError.*field)[c]);
        EXPECT_NEAR((again.value.*field)[c], kept, 5.0 * error + 1e-8 * kept)
            << q.id << " " << what;
      }
    };
    expectSame(&ProbeAnswer::transmittance, "transmittance");
    expectSame(&ProbeAnswer::skyRadiance, "sky_radiance");
    expectSame(&ProbeAnswer::groundRadiance, "ground_radiance");
    expectSame(&ProbeAnswer::direct, "direct");
    expectSame(&ProbeAnswer::sky, "sky");
  }
  EXPECT_GE(seen.size(), 4u);
}

std::string testName(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}
INSTANTIATE_TEST_SUITE_P(Sets, TruthData, testing::ValuesIn(truthNames()), testName);

TEST(Truth, HasItsSets) {
  const std::vector<std::string> names = truthNames();
  const std::vector<std::string> expected = {
      "earth",  "earth-fig6", "earth-clear", "earth-hazy", "mars",          "evening",
      "haze85", "haze93",     "mie-only",    "planet60km", "rayleigh-only", "thick5"};
  EXPECT_EQ(names, expected);
}

TEST(Truth, SaysWhatIsMissing) {
  const io::Result<TruthSet> none = loadTruth("no-such-planet");
  EXPECT_FALSE(none);
  EXPECT_NE(none.error.find("no-such-planet"), std::string::npos) << none.error;
}

TEST(Truth, BandsAreHalfOpen) {
  EXPECT_EQ(bandOf(90 * kDegree), Band::Day);
  EXPECT_EQ(bandOf(10 * kDegree), Band::Day);
  EXPECT_EQ(bandOf(9.999 * kDegree), Band::Low);
  EXPECT_EQ(bandOf(0.0), Band::Low);
  EXPECT_EQ(bandOf(-6 * kDegree), Band::Civil);
  EXPECT_EQ(bandOf(-6.001 * kDegree), Band::Nautical);
  EXPECT_EQ(bandOf(-18 * kDegree), Band::Astronomical);
  EXPECT_EQ(bandOf(-18.1 * kDegree), Band::Night);
}

TEST(Truth, MeasuresErrorsAsDefined) {
  EXPECT_DOUBLE_EQ(relativeError(1.1, 1.0, 1.0), 0.1 * (1.1 - 1.0) / 0.1);
  EXPECT_NEAR(relativeError(0.002, 0.001, 1.0), 0.001 / (0.02 / std::numbers::pi), 1e-12);
  EXPECT_NEAR(relativeError(2e-10, 1e-10, 0.0), 0.1, 1e-9);
  TruthQuery q;
  q.groundIrradiance = {{0.1, 0.1, 0.1}};
  q.truth.value.skyRadiance = {{0.01, 0.02, 0.03}};
  q.truth.value.transmittance = {{0.5, 0.5, 1e-6}};
  ProbeAnswer off = q.truth.value;
  EXPECT_EQ(errorOf(q, off).total, 0.0);
  off.skyRadiance[1] *= 1.05;
  off.transmittance[2] = 2e-6;
  EXPECT_NEAR(errorOf(q, off).total, 0.05, 1e-12);
  EXPECT_NEAR(errorOf(q, off).transmittance, 1e-3, 1e-12);
  off.skyRadiance[0] = std::nan("");
  EXPECT_TRUE(std::isnan(errorOf(q, off).sky));
  EXPECT_EQ(percentile({3, 1, 2}, 50), 2.0);
  EXPECT_DOUBLE_EQ(percentile({0, 1}, 95), 0.95);
  EXPECT_EQ(percentile({}, 95), 0.0);
}

}  // namespace
}  // namespace alpenglow::truth
