// Random atmospheres in coarse tables of the moment solver: numbers stay numbers, and no light is
// made.
#include <cmath>
#include <cstdio>
#include <random>

#include "atmosphere/parameters/physics_cpp.h"
#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kAtmospheres = ALPENGLOW_SWEEP_COUNT;

/// The least of everything, in half floats and floats by turns.
TableDesc tinyDesc(int index) {
  TableDesc desc;
  desc.sizes = kTinySettings;
  desc.format = index % 2 == 0 ? TableFormat::Half : TableFormat::Float;
  return desc;
}

/// The directions and panels of a draft, with fewer nodes.
TableDesc smallDesc(int index) {
  TableDesc desc = tinyDesc(index);
  desc.quality = Quality::Draft;
  desc.sizes = {32, 16, 8, 12, 6, 3, 4, 8, 8, 10, 5, 0, 0};
  return desc;
}

class RandomAtmospheres {
 public:
  /// One in three loses no light, neither in the atmosphere nor on the ground.
  Parameters next() {
    Parameters p;
    conservative_ = index_++ % 3 == 0;
    p.bottomRadius_m = logarithmic(1e5, 1e8);
    const double scaleHeight = p.bottomRadius_m * logarithmic(1e-4, 1e-2);
    p.topRadius_m = p.bottomRadius_m + scaleHeight * uniform(4.0, 12.0);
    p.wavelengths_nm = {{680.0, 550.0, 440.0}};
    p.solarIrradiance = {{1.0, 1.0, 1.0}};
    p.rayleigh.present = uniform(0.0, 1.0) < 0.9;
    p.rayleigh.scaleHeight_m = scaleHeight;
    p.mie.present = !p.rayleigh.present || uniform(0.0, 1.0) < 0.8;
    p.mie.scaleHeight_m = scaleHeight * logarithmic(0.1, 1.0);
    p.mie.asymmetry = uniform(-0.3, 0.8);
    p.absorption.present = !conservative_ && uniform(0.0, 1.0) < 0.5;
    p.absorption.center_m = scaleHeight * uniform(0.0, 4.0);
    p.absorption.halfWidth_m = scaleHeight * uniform(0.2, 3.0);
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      p.rayleigh.scattering_per_m[c] = logarithmic(1e-3, 4.0) / p.rayleigh.scaleHeight_m;
      p.mie.scattering_per_m[c] = logarithmic(1e-3, 2.0) / p.mie.scaleHeight_m;
      p.mie.extinction_per_m[c] =
          p.mie.scattering_per_m[c] * (conservative_ ? 1.0 : uniform(1.0, 3.0));
      p.absorption.extinction_per_m[c] = logarithmic(1e-3, 1.0) / p.absorption.halfWidth_m;
      p.groundAlbedo[c] = conservative_ ? 1.0 : uniform(0.0, 1.0);
    }
    return p;
  }
  bool conservative() const { return conservative_; }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double logarithmic(double low, double high) {
    return low * std::pow(high / low, uniform(0.0, 1.0));
  }

 private:
  std::mt19937 random_{20260};
  uint32_t index_ = 0;
  bool conservative_ = false;
};

/// An integral as a sum.
struct Node {
  double at, weight;
};
void addRule(std::vector<Node>* rule, double from, double to) {
  for (int i = 0; i < 12; ++i) {
    const auto node = physics_f64::gaussLegendre12(i);
    rule->push_back({from + (to - from) * node[0], (to - from) * node[1]});
  }
}

/// Shares of the light that meets the planet: what leaves it, and what the ground keeps.
struct Balance {
  Spectrum out, ground;
  double total(uint32_t c) const { return out[c] + ground[c]; }
};

void expectAnswer(const std::string& name, const ProbeAnswer& a) {
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    EXPECT_TRUE(a.transmittance[c] >= 0.0 && a.transmittance[c] <= 1.0)
        << name << ", transmittance " << a.transmittance[c];
    for (const Spectrum* s : {&a.skyRadiance, &a.groundRadiance, &a.direct, &a.sky})
      EXPECT_TRUE(std::isfinite((*s)[c]) && (*s)[c] >= 0.0) << name << ", light " << (*s)[c];
  }
}

class SweepTest : public BakeTest {
 protected:
  /// Logarithms of N and of E, so that both are positive where they are finite; and T = exp(-tau).
  void expectTables(const std::string& name, Tables* tables) {
    for (TableId id : {kTableOpticalDepth, kTableMoments, kTableSource}) {
      const CpuTable table = read(tables, id);
      bool good = true;
      for (float v : table.values)
        good = good && std::isfinite(v) && (v >= 0.0f || id == kTableMoments);
      EXPECT_TRUE(good) << name << " " << table.info.name;
    }
  }

  /// Of rays and surfaces inside and outside, some of rays that end on their way.
  void expectAnswers(const std::string& name, const Parameters& p, Tables* tables,
                     RandomAtmospheres* random) {
    std::vector<ProbeQuery> queries;
    const double thickness = p.topRadius_m - p.bottomRadius_m;
    for (int i = 0; i < 400; ++i) {
      ProbeQuery q;
      q.kind = i % 8 == 0 ? QueryKind::Irradiance : QueryKind::Ray;
      q.altitude_m =
          i % 3 == 0 ? 0.0 : thickness * random->logarithmic(1e-4, i % 2 == 0 ? 1.0 : 1e2);
      q.zenith = random->uniform(0.0, kPi);
      q.sunZenith = random->uniform(0.0, kPi);
      q.azimuth = random->uniform(0.0, kPi);
      q.bounded = i % 4 == 1;
      if (q.bounded) q.distance_m = thickness * random->logarithmic(1e-4, 10.0);
      if (q.kind == QueryKind::Irradiance) q.zenith = q.azimuth = 0.0;
      queries.push_back(q);
    }
    for (const ProbeAnswer& a : probe(tables, queries)) expectAnswer(name, a);
  }

  Balance balanceOf(const std::string& name, const Parameters& p, Tables* tables);

  /// Of the balance, channel by channel.
  struct Errors {
    std::vector<double> conservative, lossy;
  };
  Errors sweep(TableDesc (*descOf)(int));
  static void print(const char* name, const Errors& errors) {
    std::printf("%s tables, %zu + %zu channels: shares of light - 1\n", name,
                errors.conservative.size(), errors.lossy.size());
    for (double share : {0.0, 0.05, 0.5, 0.95, 1.0})
      std::printf("  p%-3.0f conservative %+.4f, with losses %+.4f\n", 100 * share,
                  percentile(errors.conservative, share), percentile(errors.lossy, share));
  }
};

SweepTest::Errors SweepTest::sweep(TableDesc (*descOf)(int)) {
  RandomAtmospheres atmospheres, queries;
  Errors errors;
  for (int i = 0; i < kAtmospheres && !HasFailure(); ++i) {
    const Parameters p = atmospheres.next();
    const std::string name = "atmosphere " + std::to_string(i);
    Tables* tables = bakeTables(p, descOf(i));
    expectTables(name, tables);
    expectAnswers(name, p, tables, &queries);
    const Balance balance = balanceOf(name, p, tables);
    std::vector<double>& kind = atmospheres.conservative() ? errors.conservative : errors.lossy;
    for (uint32_t c = 0; c < kSpectrumSize; ++c) kind.push_back(balance.total(c) - 1.0);
  }
  return errors;
}

// The whole planet is a closed sphere of radius Rt in a parallel beam: what falls in is Rt^2 pi,
// whatever is inside. In a steady state it leaves through the same sphere or stays. Through it
// comes light that was scattered or reflected, whose radiance an observer on the sphere sees when
// looking down, and the sun's own that passes through the limb; nothing else comes in from above.
// So without absorption the shares sum up to 1, and to less with it. Rays are answered in full, so
// this holds for any field that solves the equation of transfer, and no error of the tables can
// hide in what is not asked. Night's sun is integrated apart: there, the limb alone is lit.
Balance SweepTest::balanceOf(const std::string& name, const Parameters& p, Tables* tables) {
  const double rt = p.topRadius_m, rg = p.bottomRadius_m;
  const double horizon = -std::sqrt((rt - rg) * (rt + rg)) / rt;
  const double night = std::sin(2.0 * std::asin(horizon));
  std::vector<Node> sunDirections, views, azimuths;
  for (const auto& [from, to] : {std::pair{-1.0, night}, {night, 0.0}, {0.0, 1.0}})
    addRule(&sunDirections, from, to);
  addRule(&views, -1.0, horizon);
  addRule(&views, horizon, 0.0);
  addRule(&azimuths, 0.0, kPi);
  std::vector<ProbeQuery> queries;
  std::vector<double> weights;  // of radiance; of irradiance on the ground
  for (const Node& sun : sunDirections) {
    ProbeQuery q;
    q.sunZenith = std::acos(sun.at);
    q.kind = QueryKind::Irradiance;
    queries.push_back(q);
    weights.push_back(2.0 * (rg / rt) * (rg / rt) * sun.weight);
    q.kind = QueryKind::Ray;
    q.altitude_m = rt - rg;
    for (const Node& view : views)
      for (const Node& azimuth : azimuths) {
        q.zenith = std::acos(view.at);
        q.azimuth = azimuth.at;
        queries.push_back(q);
        weights.push_back(4.0 * sun.weight * view.weight * azimuth.weight * -view.at);
      }
  }
  const std::vector<ProbeAnswer> answers = probe(tables, queries);
  Balance result;
  for (size_t i = 0; i < answers.size(); ++i) {
    expectAnswer(name, answers[i]);
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const ProbeAnswer& a = answers[i];
      if (queries[i].kind == QueryKind::Irradiance)
        result.ground[c] += weights[i] * (1.0 - p.groundAlbedo[c]) * (a.direct[c] + a.sky[c]);
      else
        result.out[c] += weights[i] * (a.skyRadiance[c] + a.groundRadiance[c]);
    }
  }
  // The sun's light that passes through the limb; b^2 = rt^2 (1 - mu^2).
  for (size_t i = 0; i < views.size(); ++i) {
    if (views[i].at < horizon) continue;
    const ProbeAnswer& a = answers[1 + i * azimuths.size()];
    for (uint32_t c = 0; c < kSpectrumSize; ++c)
      result.out[c] += a.transmittance[c] * 2.0 * views[i].weight * -views[i].at;
  }
  return result;
}

// Four altitudes and two panels are far from enough for optical depths of 4, and lose up to 42 %;
// but they make 0.7 % at most, because no panel scatters more than its beam loses.
TEST_F(SweepTest, TheTiniestTablesMakeNoLight) {
  const Errors errors = sweep(tinyDesc);
  print("tiny", errors);
  EXPECT_LE(percentile(errors.conservative, 1.0), 0.02);
  EXPECT_LE(percentile(errors.lossy, 1.0), 0.02);
}

// Measured over 240 atmospheres: at most 1.3 % too much, and half of the conservative channels
// within 0.05 %. The 11.6 % that the worst one lacks are orders: see below.
TEST_F(SweepTest, SmallTablesMakeNoLight) {
  const Errors errors = sweep(smallDesc);
  print("small", errors);
  EXPECT_LE(percentile(errors.conservative, 1.0), 0.02);
  EXPECT_LE(percentile(errors.lossy, 1.0), 0.02);
  EXPECT_LT(std::abs(percentile(errors.conservative, 0.5)), 2e-3);
  EXPECT_GE(percentile(errors.conservative, 0.0), -0.15);
}

// Thick air over a white ground: light leaves it after hundreds of events. The solver goes on from
// its 18th order by a geometric series, and that lacks 9 % here. With 300 orders 3 % are missing.
TEST_F(SweepTest, ThickWhiteMediaTakeManyOrders) {
  Parameters p = preset("earth");
  p.rayleigh.scattering_per_m = {{3.6 / p.rayleigh.scaleHeight_m, 1.0 / p.rayleigh.scaleHeight_m,
                                  0.1 / p.rayleigh.scaleHeight_m}};
  p.mie.present = false;
  p.absorption.present = false;
  p.groundAlbedo = {{1.0, 1.0, 1.0}};
  p.sunAngularRadius = 0.0;
  TableDesc desc = smallDesc(1);
  for (const uint32_t orders : {0u, 300u}) {
    desc.orders = orders;
    const Balance balance = balanceOf("thick air", p, bakeTables(p, desc));
    std::printf("%3u orders:", orders);
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      std::printf(" %.4f", balance.out[c]);
      EXPECT_NEAR(balance.out[c], 1.0, orders == 0 ? 0.15 : 0.04) << "channel " << c;
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace alpenglow::testing
