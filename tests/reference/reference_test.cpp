// The public path tracer: what it promises about orders, errors, threads and arguments.
#include <alpenglow/reference/reference.h>

#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "test_atmospheres.h"

namespace alpenglow {
namespace {

using namespace test;

ReferenceOptions samplesOf(uint64_t samples, uint32_t orders = 0, uint64_t seed = 0) {
  ReferenceOptions options;
  options.pathCount = samples;
  options.orders = orders;
  options.seed = seed;
  return options;
}

/// A reference with an owner.
class Truth {
 public:
  explicit Truth(const Parameters& p) {
    EXPECT_EQ(createReference(p, &reference_, {}), Status::Ok);
  }
  explicit Truth(const char* name) : Truth(preset(name)) {}
  Truth(const Truth&) = delete;
  ~Truth() { destroyReference(reference_); }
  ReferenceAnswer operator()(const ProbeQuery& query, const ReferenceOptions& options) const {
    ReferenceAnswer a;
    EXPECT_EQ(evaluateReference(reference_, query, options, &a, {}), Status::Ok);
    return a;
  }

 private:
  Reference* reference_ = nullptr;
};

// On a planet so large that its air is plane-parallel, the reflectance of air and ground together
// is the same with the sun and the eye exchanged (Helmholtz).
TEST(Reference, IsReciprocal) {
  Parameters p = preset("earth");
  p.bottomRadius_m = 9e7;
  p.topRadius_m = 9e7 + 60e3;
  p.groundAlbedo = {{0.3, 0.5, 0.8}};
  const Truth truth(p);
  for (const auto& [a, b, azimuth] :
       {std::tuple(10.0, 55.0, 40.0), std::tuple(30.0, 70.0, 180.0)}) {
    // Looking down along the direction whose zenith angle is the other's.
    const auto reflectance = [&, phi = azimuth + 180](double view, double sun) {
      // `azimuth` lies between the sun and the place that the light leaves to.
      return truth(rayQuery(60e3, 180 - view, sun, phi), samplesOf(131072));
    };
    const ReferenceAnswer one = reflectance(a, b), other = reflectance(b, a);
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const auto sum = [&](const ProbeAnswer& v) { return v.skyRadiance[c] + v.groundRadiance[c]; };
      const double x = sum(one.value) / std::cos(b * kDegree);
      const double y = sum(other.value) / std::cos(a * kDegree);
      const double error = std::hypot(sum(one.standardError) / std::cos(b * kDegree),
                                      sum(other.standardError) / std::cos(a * kDegree));
      EXPECT_LT(error, 0.002 * x);
      // What curvature is left: a scale height over the radius, 1e-4, and more for slanted rays.
      EXPECT_NEAR(x, y, 4.0 * error + 1e-3 * x) << a << " " << b << " channel " << c;
    }
  }
}

TEST(Reference, StandardErrorsAreHonest) {
  const Truth truth("earth");
  const ProbeQuery queries[] = {rayQuery(2, 80, 60, 60), rayQuery(2, 60, 98, 60),
                                irradianceQuery(0, 85)};
  for (const ProbeQuery& query : queries) {
    constexpr int kSeeds = 20;
    double sum = 0.0, squares = 0.0, claimed = 0.0;
    for (uint64_t seed = 0; seed < kSeeds; ++seed) {
      const ReferenceAnswer a = truth(query, samplesOf(16384, 0, seed));
      const double x =
          query.kind == QueryKind::Irradiance ? a.value.sky[2] : a.value.skyRadiance[2];
      const double e = query.kind == QueryKind::Irradiance ? a.standardError.sky[2]
                                                           : a.standardError.skyRadiance[2];
      sum += x;
      squares += x * x;
      claimed += e * e / kSeeds;
    }
    const double mean = sum / kSeeds;
    const double spread = std::sqrt((squares / kSeeds - mean * mean) * kSeeds / (kSeeds - 1));
    // With 20 seeds, and 16 batches behind each claim, the ratio itself scatters by about 0.17.
    EXPECT_GT(spread / std::sqrt(claimed), 0.5);
    EXPECT_LT(spread / std::sqrt(claimed), 1.6);
    EXPECT_GT(spread, 0.0);
  }
}

TEST(Reference, MoreSamplesAgreeWithFewer) {
  const Truth truth("earth-hazy");
  const ProbeQuery query = rayQuery(2, 45, 95, 30);
  const ReferenceAnswer few = truth(query, samplesOf(16384)),
                        more = truth(query, samplesOf(262144));
  EXPECT_EQ(few.pathCount, 16384u);
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    const double error = few.standardError.skyRadiance[c];
    EXPECT_LT(more.standardError.skyRadiance[c], 0.5 * error);
    EXPECT_NEAR(few.value.skyRadiance[c], more.value.skyRadiance[c], 4.0 * error);
  }
}

/// Deals the indices out to threads, the last ones first.
template <int kThreads>
void onThreads(void*, uint32_t count, void (*body)(void*, uint32_t), void* context) {
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([=] {
      for (uint32_t i = count; i-- > 0;) {
        if (i % kThreads == static_cast<uint32_t>(t)) body(context, i);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(Reference, ResultsDoNotDependOnThreads) {
  const Truth truth("earth");
  const ProbeQuery query = rayQuery(10e3, 120, 70, 60);
  const ReferenceAnswer alone = truth(query, samplesOf(20000));
  EXPECT_EQ(alone.pathCount, 20480u) << "whole batches";
  for (ParallelFor parallelFor : {onThreads<1>, onThreads<4>}) {
    ReferenceOptions options = samplesOf(20000);
    options.parallelFor = parallelFor;
    const ReferenceAnswer a = truth(query, options);
    expectClose(a.value.skyRadiance, alone.value.skyRadiance, 0, "sky");
    expectClose(a.value.groundRadiance, alone.value.groundRadiance, 0, "ground");
    expectClose(a.standardError.skyRadiance, alone.standardError.skyRadiance, 0, "error");
  }
  EXPECT_NE(truth(query, samplesOf(20000, 0, 1)).value.skyRadiance[0], alone.value.skyRadiance[0]);
}

TEST(Reference, OrdersAddUp) {
  const Truth truth("earth");
  const ProbeQuery ray = rayQuery(10e3, 120, 50, 60), surface = irradianceQuery(0, 50);
  ReferenceAnswer exact;
  ASSERT_EQ(referenceSingleScattering(preset("earth"), ray, &exact, {}), Status::Ok);
  const ReferenceAnswer one = truth(ray, samplesOf(8192, 1));
  expectClose(one.value.skyRadiance, exact.value.skyRadiance, 0, "order 1");
  expectAll(truth(surface, samplesOf(8192, 1)).value.sky, 0.0, "no event before the surface");
  ReferenceAnswer before = one, beforeSky = truth(surface, samplesOf(8192, 1));
  for (uint32_t orders : {2u, 3u, 5u, 0u}) {
    const ReferenceAnswer a = truth(ray, samplesOf(65536, orders));
    const ReferenceAnswer e = truth(surface, samplesOf(65536, orders));
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const double slack = a.standardError.skyRadiance[c] + before.standardError.skyRadiance[c];
      EXPECT_GT(a.value.skyRadiance[c] + 3 * slack, before.value.skyRadiance[c]) << orders;
      EXPECT_GT(e.value.sky[c], 0.99 * beforeSky.value.sky[c]) << orders;
    }
    if (orders == 2) {
      EXPECT_GT(a.value.skyRadiance[2], 1.1 * one.value.skyRadiance[2]);
    }
    before = a;
    beforeSky = e;
  }
}

// The ground's light is that of its irradiance, order by order.
TEST(Reference, GroundReflectsItsIrradiance) {
  const Truth truth("earth");
  for (uint32_t orders : {2u, 3u, 0u}) {
    const ReferenceAnswer ground = truth(rayQuery(0, 180, 40, 0), samplesOf(65536, orders));
    const ReferenceAnswer light = truth(irradianceQuery(0, 40), samplesOf(65536, orders, 3));
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const double expected = 0.1 / std::numbers::pi * (light.value.direct[c] + light.value.sky[c]);
      const double error = std::hypot(ground.standardError.groundRadiance[c],
                                      0.1 / std::numbers::pi * light.standardError.sky[c]);
      EXPECT_NEAR(ground.value.groundRadiance[c], expected, 4 * error + 1e-9) << orders;
    }
  }
}

TEST(Reference, StopsAtItsTarget) {
  const Truth truth("earth");
  ReferenceOptions options;
  options.targetError = 0.02;
  const ReferenceAnswer rough = truth(rayQuery(2, 60, 50, 60), options);
  options.targetError = 0.0006;
  const ReferenceAnswer fine = truth(rayQuery(2, 60, 50, 60), options);
  EXPECT_GT(fine.pathCount, rough.pathCount);
  EXPECT_LT(fine.pathCount, uint64_t{1} << 19);
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    EXPECT_LE(fine.standardError.skyRadiance[c], 0.0006 * fine.value.skyRadiance[c]);
  }
  options.maxPathCount = 4096;
  EXPECT_EQ(truth(rayQuery(2, 60, 98, 60), options).pathCount, 4096u);
}

// The sun at -12 degrees: 2 seconds are enough for 1 %.
TEST(Reference, ConvergesInTwilight) {
  const Truth truth("earth-fig6");
  const ReferenceAnswer a = truth(rayQuery(2, 80, 102, 30), samplesOf(131072));
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    EXPECT_GT(a.value.skyRadiance[c], 0.0);
    EXPECT_LT(a.standardError.skyRadiance[c], 0.01 * a.value.skyRadiance[c]) << c;
  }
}

TEST(Reference, AirlessAndEmptyCases) {
  Parameters p = preset("earth");
  p.rayleigh.present = p.mie.present = p.absorption.present = false;
  const Truth bare(p);
  expectAll(bare(irradianceQuery(0, 30), samplesOf(2048)).value.sky, 0.0, "airless");
  const ReferenceAnswer ground = bare(rayQuery(1000, 120, 60, 0), samplesOf(2048));
  EXPECT_NEAR(ground.value.groundRadiance[0], 0.1 / std::numbers::pi * 0.5, 1e-5);
  const Truth truth("earth");
  expectAll(truth(irradianceQuery(100e3, 30), samplesOf(2048)).value.sky, 0.0, "above the top");
  expectAll(truth(rayQuery(400e3, 0, 30, 0), samplesOf(2048)).value.skyRadiance, 0.0, "space");
  for (const ProbeQuery& odd :
       {rayQuery(60e3, 0, 30, 0), rayQuery(60e3, 90, 91, 0), rayQuery(0, 90, 90, 0),
        rayQuery(0, 0, 0, 0), rayQuery(0, 180, 180, 0), rayQuery(2, 0, 180, 0)}) {
    const ReferenceAnswer a = truth(odd, samplesOf(4096));
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      EXPECT_TRUE(std::isfinite(a.value.skyRadiance[c]) && a.value.skyRadiance[c] >= 0.0);
      EXPECT_TRUE(std::isfinite(a.value.groundRadiance[c]) && a.value.groundRadiance[c] >= 0.0);
      EXPECT_TRUE(std::isfinite(a.standardError.skyRadiance[c]));
    }
  }
}

// Whatever a valid atmosphere is, an answer is finite, not negative and no brighter than the light
// that comes in allows for.
TEST(Reference, ExtremeAtmospheresStayFinite) {
  Parameters tiny = preset("earth-fig6"), thin = tiny, tall = tiny, thick = tiny, peaked = tiny,
             back = tiny;
  tiny.bottomRadius_m = 10e3;
  tiny.topRadius_m = 70e3;
  thin.mie.scaleHeight_m = 100.0;
  tall.rayleigh.scaleHeight_m = 50e3;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    thick.mie.scattering_per_m[c] = thick.mie.extinction_per_m[c] = 50.0 / 1200.0;
  }
  thick.bottomRadius_m = 1e8;
  thick.topRadius_m = 1e8 + 60e3;
  peaked.mie.asymmetry = 0.99;
  back.mie.asymmetry = -0.9;
  for (const Parameters& p : {tiny, thin, tall, thick, peaked, back}) {
    const Truth truth(p);
    for (const ProbeQuery& query :
         {rayQuery(0, 90, 90, 0), rayQuery(2, 89.95, 60, 60), rayQuery(1000, 180, 95, 0),
          rayQuery(2, 30, 30, 0), rayQuery(30e3, 100, 100, 180), irradianceQuery(0, 80)}) {
      const ReferenceAnswer a = truth(query, samplesOf(2048));
      for (const Spectrum* s : {&a.value.skyRadiance, &a.value.groundRadiance, &a.value.sky}) {
        for (double value : s->value) {
          EXPECT_TRUE(std::isfinite(value) && value >= 0.0) << p.bottomRadius_m;
        }
      }
      for (double value : a.value.sky.value) EXPECT_LT(value, 1.1);
      for (double value : a.standardError.skyRadiance.value) EXPECT_TRUE(std::isfinite(value));
    }
  }
}

TEST(Reference, BandsFollowTheSunWhereTheRayLooks) {
  const Parameters p = preset("earth");
  EXPECT_NEAR(bandSunElevation(p, rayQuery(2, 80, 95, 0)), -5 * kDegree, 1e-12);
  EXPECT_NEAR(bandSunElevation(p, irradianceQuery(10e3, 40)), 50 * kDegree, 1e-12);
  EXPECT_NEAR(bandSunElevation(p, rayQuery(36e6, 180, 40, 0)), 50 * kDegree, 1e-9);
  // The limb seen from 400 km lies 19.8 degrees further round the planet, towards the sun.
  const double limb = std::asin(6370.0 / 6760.0);
  const ProbeQuery query = rayQuery(400e3, 180 - limb / kDegree, 80, 0);
  EXPECT_NEAR(bandSunElevation(p, query), 10 * kDegree + 0.5 * std::numbers::pi - limb, 1e-6);
  EXPECT_EQ(bandSunElevation(p, rayQuery(-1, 80, 95, 0)), 0.0);
}

TEST(Reference, BadArgumentsAreRefused) {
  const Parameters p = preset("earth");
  Reference* reference = nullptr;
  EXPECT_EQ(createReference(Parameters{}, &reference, {}), Status::InvalidArgument);
  EXPECT_EQ(createReference(p, nullptr, {}), Status::InvalidArgument);
  EXPECT_EQ(reference, nullptr);
  ASSERT_EQ(createReference(p, &reference, {}), Status::Ok);
  ReferenceAnswer a;
  a.pathCount = 7;
  ProbeQuery bad = rayQuery(2, 70, 80, 50);
  bad.azimuth = std::numeric_limits<double>::quiet_NaN();
  const ReferenceOptions options = samplesOf(2048);
  EXPECT_EQ(evaluateReference(reference, bad, options, &a, {}), Status::InvalidArgument);
  EXPECT_EQ(evaluateReference(reference, rayQuery(2, 70, 80, 50), options, nullptr, {}),
            Status::InvalidArgument);
  EXPECT_EQ(evaluateReference(nullptr, rayQuery(2, 70, 80, 50), options, &a, {}),
            Status::InvalidArgument);
  ReferenceOptions endless;
  endless.targetError = -1.0;
  EXPECT_EQ(evaluateReference(reference, rayQuery(2, 70, 80, 50), endless, &a, {}),
            Status::InvalidArgument);
  EXPECT_EQ(a.pathCount, 7u) << "a failed call changed the answer";
  destroyReference(reference);
  destroyReference(nullptr);
  EXPECT_EQ(evaluateReference(Parameters{}, rayQuery(2, 70, 80, 50), options, &a, {}),
            Status::InvalidArgument);
}

}  // namespace
}  // namespace alpenglow
