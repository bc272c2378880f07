// The path tracer's parts and its physics: energy, reciprocity, and order 1 against the quadrature.
#include "atmosphere/reference/path_tracer.h"

#include <cmath>
#include <functional>
#include <set>

#include "atmosphere/reference/estimate.h"
#include "atmosphere/reference/optical_depth.h"
#include "atmosphere/reference/rough_exp.h"
#include "atmosphere/reference/single_scattering.h"
#include "test_atmospheres.h"

namespace alpenglow::reference {
namespace {

using test::irradianceQuery;
using test::kDegree;
using test::preset;
using test::rayQuery;

/// No absorption anywhere, and a white ground.
Parameters conservative(const char* name) {
  Parameters p = preset(name);
  p.absorption.present = false;
  p.mie.extinction_per_m = p.mie.scattering_per_m;
  p.groundAlbedo = {{1.0, 1.0, 1.0}};
  return p;
}

TEST(Columns, AgreeWithTheAdaptiveIntegral) {
  Parameters small = preset("earth");
  small.bottomRadius_m = 60e3;
  small.topRadius_m = 120e3;
  for (const Parameters& p : {preset("earth"), preset("earth-hazy"), preset("mars"), small}) {
    const Medium m = makeMediumF64(p);
    const Columns columns(m);
    for (double h : {0.0, 2.0, 500.0, 9e3, 24e3, 41e3, 59e3}) {
      for (double mu : {1.0, 0.5, 0.1, 0.02, 0.003, 0.0, -0.001, -0.01, -0.05, -0.3}) {
        if (physics_f64::rayHitsGround(m, h, mu)) continue;
        const SpectrumIntegral exact = opticalDepthToTop(m, h, mu, {1e-11, 0.0});
        const physics_f64::Spectrum fast = columns.depth(columns.toTop(h, mu));
        for (uint32_t c = 0; c < kSpectrumSize; ++c) {
          EXPECT_NEAR(fast[static_cast<glm::length_t>(c)], exact.value[c], 1e-6 * exact.value[c])
              << p.bottomRadius_m << " " << h << " " << mu;
        }
      }
    }
  }
}

TEST(Columns, PartsOfARayAgreeToo) {
  const Medium m = makeMediumF64(preset("earth"));
  const Columns columns(m);
  for (const RaySegment& s :
       {RaySegment{2, 0.0, 1e3}, RaySegment{9e3, -0.05, 6e5}, RaySegment{9e3, -0.05, 2e5},
        RaySegment{1e3, -0.5, 1.5e3}, RaySegment{20e3, 0.3, 5e4}}) {
    const double h = physics_f64::altitudeAt(m, s.h, s.mu, s.length);
    const double mu = physics_f64::muAt(m, s.h, s.mu, s.length, h);
    const Column start = columns.upwards(s.h, std::abs(s.mu));
    const auto fast = columns.depth(columns.between(s.h, s.mu, start, h, mu));
    const SpectrumIntegral exact = opticalDepth(m, s, {1e-11, 0.0});
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      EXPECT_NEAR(fast[static_cast<glm::length_t>(c)], exact.value[c],
                  1e-6 * exact.value[c] + 1e-9);
    }
  }
}

TEST(PathSampler, ABatchIsSpreadEvenly) {
  for (size_t dimension = 0; dimension < PathSampler::kDimensions; ++dimension) {
    PathSampler sampler(7, 3);
    std::set<int> cells;
    for (int i = 0; i < 1024; ++i) {
      sampler.nextPath();
      double value = 0.0;
      for (size_t d = 0; d <= dimension; ++d) value = sampler.leading();
      ASSERT_GT(value, 0.0);
      ASSERT_LT(value, 1.0);
      cells.insert(static_cast<int>(value * 1024));
    }
    EXPECT_EQ(cells.size(), 1024u) << dimension;
  }
}

TEST(PathSampler, LobesAreNormalised) {
  Random random(1, 2);
  double rayleigh = 0.0, greensteinSum = 0.0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    // With samples of density p the mean of q / p is the integral of q.
    const double a = sampleRayleigh(random.uniform());
    rayleigh += greenstein(0.3, a) / physics_f64::rayleighPhase(a) / kCount;
    const double b = sampleGreenstein(0.6, random.uniform());
    greensteinSum += physics_f64::miePhase(0.6, b) / greenstein(0.6, b) / kCount;
  }
  EXPECT_NEAR(rayleigh, 1.0, 0.005);
  EXPECT_NEAR(greensteinSum, 1.0, 0.005);
}

TEST(RoughExp, IsRoughlyExp) {
  for (double x = -699.0; x <= 1.0; x += 0.0137) {
    EXPECT_NEAR(roughExp(x) / std::exp(x), 1.0, 2e-4) << x;
  }
  EXPECT_GT(roughExp(-1e300), 0.0);
  EXPECT_LT(roughExp(-1e300), 1e-300);
}

TEST(LightGuide, DirectionsAreDrawnWithTheirDensity) {
  const PathTracer tracer(makeMediumF64(preset("earth")));
  const LightGuide guide(tracer.medium(), tracer.columns());
  Random random(5, 1);
  for (const auto& [h, elevation] : {std::pair(0.0, 30.0), std::pair(5e3, -8.0)}) {
    const DirectionGrid grid = guide.directionsAt(h, std::sin(elevation * kDegree));
    double sphere = 0.0;
    constexpr int kCount = 100000;
    for (int i = 0; i < kCount; ++i) {
      const auto angles = grid.sample(random.uniform(), random.uniform(), random.uniform());
      sphere += 1.0 / grid.density(angles.mu, std::cos(angles.phi)) / kCount;
    }
    EXPECT_NEAR(sphere / (4.0 * std::numbers::pi), 1.0, 0.03) << h;
  }
}

struct Case {
  const char* name;
  ProbeQuery query;
};

Task airTask(const Medium& medium, const ProbeQuery& query) {
  const ResolvedQuery resolved = resolveQuery(medium, query);
  Task task = rayTask(medium, query, {}, kAllOrders);
  task.surface = false;
  EXPECT_FALSE(resolved.empty);
  return task;
}

TEST(PathTracer, OrderOneIsTheExactOne) {
  const Case cases[] = {
      {"earth", rayQuery(2, 30, 60, 60)},          {"earth", rayQuery(2, 85, 30, 0)},
      {"earth-hazy", rayQuery(2, 29, 30, 0)},      {"earth", rayQuery(2, 80, 85, 60)},
      {"earth-clear", rayQuery(2, 80, 96, 0)},     {"mars", rayQuery(400e3, 180, 30, 0)},
      {"earth", rayQuery(10e3, 120, 60, 60)},      {"earth", rayQuery(400e3, 109.7, 80, 60)},
      {"earth", rayQuery(400e3, 109.7, 100, 20)},  {"earth", rayQuery(2, 90, 60, 60, 1000)},
      {"earth-fig6", rayQuery(10e3, 91, 100, 60)},
  };
  for (const Case& c : cases) {
    const PathTracer tracer(makeMediumF64(preset(c.name)));
    Task task = airTask(tracer.medium(), c.query);
    task.least = task.most = 1;
    ReferenceOptions options;
    options.pathCount = 64 * kBatchPaths;
    const TaskResult traced = run(tracer, task, options, 0.0);
    const ReferenceAnswer exact = singleScattering(tracer.medium(), c.query, 1e-9);
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      const double value = exact.value.skyRadiance[i];
      ASSERT_GT(value, 0.0);
      EXPECT_LT(traced.air.error[i], 3e-3 * value);
      // The columns' table may be off by as much as its own test allows.
      EXPECT_NEAR(traced.air.value[i], value, 4.0 * traced.air.error[i] + 3e-6 * value)
          << c.name << " " << c.query.zenith / kDegree << " channel " << i;
    }
  }
}

/// Mean of a function of the sun's direction, uniform over the sphere, with its standard error.
struct Mean {
  physics_f64::Spectrum value{0.0}, error{0.0};
};
Mean overAllSuns(int batches,
                 const std::function<physics_f64::Spectrum(const Vector&, PathSampler&)>& sample) {
  constexpr int kPaths = 2048;
  std::vector<physics_f64::Spectrum> means;
  Mean result;
  for (int b = 0; b < batches; ++b) {
    PathSampler sampler(11, static_cast<uint64_t>(b));
    Random sunDirections(12, static_cast<uint64_t>(b));
    physics_f64::Spectrum sum(0.0);
    for (int i = 0; i < kPaths; ++i) {
      const double mu = 2.0 * ((i + sunDirections.uniform()) / kPaths) - 1.0;
      sum += sample(around(Vector(0, 0, 1), mu, sunDirections.uniform()), sampler);
    }
    means.push_back(sum / static_cast<double>(kPaths));
    result.value += means.back() / static_cast<double>(batches);
  }
  for (const auto& mean : means) {
    const auto off = mean - result.value;
    result.error += off * off / static_cast<double>(batches * (batches - 1));
  }
  result.error = sqrt(result.error);
  return result;
}

// Light out is light in: lit from all directions with radiance 1, everything that neither
// absorbs nor emits has radiance 1, and a ray's air the share 1 - T of it.
void expectEnergyConserved(const PathTracer& tracer, const ProbeQuery& query) {
  const Medium& medium = tracer.medium();
  const ResolvedQuery ray = resolveQuery(medium, query);
  const SpectrumIntegral depth =
      opticalDepth(medium, {ray.ray.h, ray.ray.mu, ray.length}, {1e-10, 0.0});
  physics_f64::Spectrum expected;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    expected[static_cast<glm::length_t>(c)] =
        -std::expm1(-depth.value[c]) / (4.0 * std::numbers::pi);
  }
  const Vector view(std::sin(query.zenith), 0.0, std::cos(query.zenith));
  const Mean mean = overAllSuns(64, [&](const Vector& sun, PathSampler& sampler) {
    return tracer.skySample({ray.ray.h, sun}, view, ray.length, 1, kAllOrders,
                            1.0 / (3.0 * expected), sampler);
  });
  for (glm::length_t c = 0; c < 3; ++c) {
    EXPECT_LT(mean.error[c], 0.005 * expected[c]);
    EXPECT_NEAR(mean.value[c], expected[c], 4.0 * mean.error[c]);
  }
}

TEST(PathTracer, EnergyOfAClearMediumIsConserved) {
  const PathTracer tracer(makeMediumF64(conservative("earth")));
  expectEnergyConserved(tracer, rayQuery(0, 88, 0, 0));
  expectEnergyConserved(tracer, rayQuery(59e3, 170, 0, 0));
}

TEST(PathTracer, EnergyOfHazeIsConserved) {
  const PathTracer tracer(makeMediumF64(conservative("earth-hazy")));
  expectEnergyConserved(tracer, rayQuery(0, 20, 0, 0));
  expectEnergyConserved(tracer, rayQuery(10e3, 140, 0, 0));
}

TEST(PathTracer, EnergyOfTheGroundIsConserved) {
  const PathTracer tracer(makeMediumF64(conservative("earth-hazy")));
  const Mean mean = overAllSuns(96, [&](const Vector& sun, PathSampler& sampler) {
    return tracer.irradianceSample({0.0, sun}, kAllOrders, sampler);
  });
  for (glm::length_t c = 0; c < 3; ++c) {
    double direct = 0.0;  // Of all sun elevations: 2 pi times the integral of T mu, by midpoints.
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
      const double mu = (i + 0.5) / kSteps;
      const double depth = tracer.columns().depth(tracer.columns().toTop(0.0, mu))[c];
      direct += 2.0 * std::numbers::pi * mu * std::exp(-depth) / kSteps;
    }
    const double expected = (std::numbers::pi - direct) / (4.0 * std::numbers::pi);
    EXPECT_LT(mean.error[c], 0.005 * expected);
    EXPECT_NEAR(mean.value[c], expected, 4.0 * mean.error[c] + 1e-5 * expected) << c;
  }
}

}  // namespace
}  // namespace alpenglow::reference
