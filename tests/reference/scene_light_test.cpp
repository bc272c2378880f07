// Light among meshes: single scattering between shadows, and the path tracer against it and against
// scenes whose answer is known.
#include "atmosphere/reference/scene_light.h"

#include "atmosphere/reference/single_scattering.h"
#include "test_atmospheres.h"
#include "test_meshes.h"

namespace alpenglow::reference {
namespace {

using alpenglow::test::expectClose;
using alpenglow::test::kDegree;
using alpenglow::test::preset;
using alpenglow::test::rayQuery;
using test::box;
using test::icosphere;
using test::Mesh;
using test::raysOf;

constexpr double kTolerance = 1e-9;

/// A ray of the probe's angles, from a place that is nobody's axis.
SceneRay rayFrom(double bottomRadius, const ProbeQuery& query) {
  const LocalFrame frame(glm::normalize(Vector(0.3, -0.5, 0.7)), Vector(0, 0, 1));
  SceneRay ray;
  ray.position = (bottomRadius + query.altitude_m) * frame.z;
  ray.sun = frame.direction(std::cos(query.sunZenith), 0.0);
  ray.view = frame.direction(std::cos(query.zenith), query.azimuth);
  return ray;
}

/// A scene of meshes whose corners are metres east, north and up about a ray's start.
Scene sceneAbout(const SceneRay& ray, const std::vector<Mesh>& meshes, double albedo) {
  const LocalFrame frame(glm::normalize(ray.position), ray.sun);
  Scene scene;
  for (Mesh mesh : meshes) {
    for (size_t i = 0; i < mesh.positions.size(); i += 3) {
      double* p = &mesh.positions[i];
      const Vector turned = p[0] * frame.x + p[1] * frame.y + p[2] * frame.z;
      for (int c = 0; c < 3; ++c) p[c] = turned[c];
    }
    scene.meshes.add(ray.position, std::span<const double>(mesh.positions), mesh.indices);
    scene.albedo.emplace_back(albedo);
  }
  scene.meshes.build();
  return scene;
}

ReferenceOptions paths(uint64_t count) {
  ReferenceOptions options;
  options.pathCount = count;
  return options;
}

void expectWithin(const Estimate& actual, const Spectrum& expected, double most, const char* what) {
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    EXPECT_LT(actual.error[c], most * expected[c]) << what << " " << c;
    EXPECT_NEAR(actual.value[c], expected[c], 4.0 * actual.error[c] + 3e-6 * expected[c])
        << what << " " << c;
  }
}

TEST(LitScattering, WithoutShadowsIsSingleScattering) {
  const Medium m = makeMediumF64(preset("earth"));
  for (const ProbeQuery& q : {rayQuery(500, 88, 70, 40, 20e3), rayQuery(2000, 95, 30, 170, 20e3),
                              rayQuery(2, 90, 95, 10, 300e3), rayQuery(2, 0, 95, 10, 60e3),
                              rayQuery(2, 40, 40, 0, 3e3)}) {
    const Estimate lit = litScattering(m, rayFrom(m.bottomRadius, q), q.distance_m, {}, kTolerance);
    expectClose(lit.value, singleScattering(m, q, kTolerance).value.skyRadiance, 1e-8, "lit");
  }
}

TEST(LitScattering, AShadowTakesADifferenceAway) {
  for (double disc : {0.0, 0.0047}) {
    Parameters p = preset("earth");
    p.sunAngularRadius = disc;
    const Medium m = makeMediumF64(p);
    const SceneRay ray = rayFrom(m.bottomRadius, rayQuery(500, 88, 88.5, 40));
    const auto upTo = [&](double d) { return litScattering(m, ray, d, {}, kTolerance).value; };
    const RayInterval shadow[] = {{3e3, 9e3}};
    const Spectrum lit = litScattering(m, ray, 25e3, shadow, kTolerance).value;
    const Spectrum all = upTo(25e3), near = upTo(3e3), far = upTo(9e3);
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      EXPECT_NEAR(lit[c], near[c] + all[c] - far[c], 2e-8 * lit[c]) << disc;
    }
  }
}

TEST(LitScattering, LightAndShadowAddUp) {
  const Medium m = makeMediumF64(preset("earth"));
  const SceneRay ray = rayFrom(m.bottomRadius, rayQuery(3000, 91, 60, 100));
  const std::vector<RayInterval> dark = {{0, 100}, {2e3, 2.5e3}, {9e3, 11e3}, {29e3, 30e3}};
  const std::vector<RayInterval> light = {{100, 2e3}, {2.5e3, 9e3}, {11e3, 29e3}};
  const Spectrum a = litScattering(m, ray, 30e3, dark, kTolerance).value;
  const Spectrum b = litScattering(m, ray, 30e3, light, kTolerance).value;
  const Spectrum all = litScattering(m, ray, 30e3, {}, kTolerance).value;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) EXPECT_NEAR(a[c] + b[c], all[c], 1e-8 * all[c]);
  const RayInterval whole[] = {{0, 30e3}}, beyond[] = {{31e3, 40e3}};
  alpenglow::test::expectAll(litScattering(m, ray, 30e3, whole, kTolerance).value, 0.0, "dark");
  expectClose(litScattering(m, ray, 30e3, beyond, kTolerance).value, all, 1e-8, "beyond");
}

TEST(LitScattering, DistancesAreTheObserversFromSpaceToo) {
  const Medium m = makeMediumF64(preset("earth"));
  const ProbeQuery nadir = rayQuery(400e3, 180, 40, 0);
  const SceneRay ray = rayFrom(m.bottomRadius, nadir);
  const RayInterval lowest[] = {{395e3, 400e3}};
  const Spectrum lit = litScattering(m, ray, 400e3, lowest, kTolerance).value;
  expectClose(lit, litScattering(m, ray, 395e3, {}, kTolerance).value, 1e-8, "lit");
  const ReferenceAnswer ground = singleScattering(m, nadir, kTolerance, lowest);
  EXPECT_TRUE(ground.value.hitsGround);
  alpenglow::test::expectAll(ground.value.groundRadiance, 0.0, "ground in shadow");
}

TEST(ScenePaths, AnEmptySceneIsTheBarePlanet) {
  const Medium m = makeMediumF64(preset("earth"));
  const Scene empty;
  const PathTracer bare(m), tracer(m, &empty);
  PathSampler a(3, 4), b(3, 4);
  const Observer observer{500.0, glm::normalize(Vector(0.6, 0.1, 0.3))};
  const Vector view = glm::normalize(Vector(0.5, 0.5, -0.01));
  for (int i = 0; i < 2000; ++i) {
    const auto x =
        bare.skySample(observer, view, 3e4, 1, kAllOrders, physics_f64::Spectrum(1.0), a);
    const auto y =
        tracer.skySample(observer, view, 3e4, 1, kAllOrders, physics_f64::Spectrum(1.0), b);
    ASSERT_EQ(x, y) << i;
  }
}

TEST(ScenePaths, WithoutMeshesTheReferenceIsMet) {
  const Parameters p = preset("earth");
  const Medium m = makeMediumF64(p);
  const Scene empty;
  const PathTracer tracer(m, &empty);
  const ProbeQuery query = rayQuery(300, 93, 50, 60);
  const SceneLight light =
      traceSceneRay(tracer, empty, rayFrom(m.bottomRadius, query), paths(1 << 16));
  ReferenceAnswer expected;
  ReferenceOptions options = paths(1 << 16);
  options.seed = 1;
  ASSERT_EQ(evaluateReference(p, query, options, &expected, {}), Status::Ok);
  ASSERT_TRUE(light.end.onSurface);
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    const double error = std::hypot(light.air.error[c], expected.standardError.skyRadiance[c]);
    EXPECT_NEAR(light.air.value[c], expected.value.skyRadiance[c], 4.0 * error);
    EXPECT_LT(error, 0.01 * expected.value.skyRadiance[c]);
    const double t = expected.value.transmittance[c];
    const double groundError =
        std::hypot(light.surface.error[c], expected.standardError.groundRadiance[c] / t);
    EXPECT_NEAR(light.surface.value[c], expected.value.groundRadiance[c] / t, 4.0 * groundError);
    EXPECT_LT(groundError, 0.02 * expected.value.groundRadiance[c] / t);
  }
}

// A shell of triangles just above a black ground is a ground of the triangles' albedo. The planet
// is small so that a third of a million triangles wrap it: a metre of air lies below them.
TEST(ScenePaths, AShellOnTheGroundIsTheGround) {
  Parameters p = preset("earth");
  p.bottomRadius_m = 60e3;
  p.topRadius_m = 120e3;
  Parameters black = p;
  p.groundAlbedo = {{0.6, 0.6, 0.6}};
  black.groundAlbedo = {{0.0, 0.0, 0.0}};
  Scene shell;
  const Mesh mesh = icosphere(p.bottomRadius_m + 1.0, 7);
  shell.meshes.add(Vector(0.0), std::span<const double>(mesh.positions), mesh.indices);
  shell.meshes.build();
  shell.albedo.emplace_back(0.6);
  const Scene empty;
  const PathTracer onGround(makeMediumF64(p), &empty), onShell(makeMediumF64(black), &shell);
  for (const ProbeQuery& query : {rayQuery(300, 120, 50, 60), rayQuery(100, 60, 80, 60)}) {
    const SceneRay ray = rayFrom(p.bottomRadius_m, query);
    const SceneLight a = traceSceneRay(onGround, empty, ray, paths(1 << 15));
    const SceneLight b = traceSceneRay(onShell, shell, ray, paths(1 << 15));
    EXPECT_EQ(a.end.onSurface, b.end.onSurface);
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      // Half a per cent for the metre of air, which most of the difference to the eye lies in.
      const double air = a.air.value[c], surface = a.surface.value[c];
      EXPECT_NEAR(b.air.value[c], air,
                  4.0 * std::hypot(a.air.error[c], b.air.error[c]) + 0.005 * air);
      EXPECT_NEAR(b.multiple.value[c], a.multiple.value[c],
                  4.0 * std::hypot(a.multiple.error[c], b.multiple.error[c]) + 0.005 * air);
      EXPECT_NEAR(b.surface.value[c], surface,
                  4.0 * std::hypot(a.surface.error[c], b.surface.error[c]) + 0.005 * surface);
    }
  }
}

TEST(ScenePaths, ABlackBoxIsDark) {
  const Medium m = makeMediumF64(preset("earth"));
  const SceneRay ray = rayFrom(m.bottomRadius, rayQuery(500, 80, 40, 60));
  const Scene scene = sceneAbout(ray, {box({-30, -30, -30}, {30, 30, 30})}, 0.0);
  const PathTracer tracer(m, &scene);
  const SceneLight light = traceSceneRay(tracer, scene, ray, paths(4096));
  EXPECT_TRUE(light.end.onSurface);
  EXPECT_LT(light.end.length, 60.0);
  alpenglow::test::expectAll(light.air.value, 0.0, "air");
  alpenglow::test::expectAll(light.surface.value, 0.0, "walls");
  const auto shadow = shadowIntervals(scene.meshes, ray.position, ray.view, ray.sun, 30.0);
  alpenglow::test::expectAll(litScattering(m, ray, 30.0, shadow, 1e-6).value, 0.0, "single");
}

TEST(ScenePaths, TheSingleOrderIsTheExactOneBetweenShadows) {
  const Medium m = makeMediumF64(preset("earth"));
  const SceneRay ray = rayFrom(m.bottomRadius, rayQuery(800, 91, 80, 50));
  // Blocks hung between the ray and the sun, and a wall that it ends on.
  std::vector<Mesh> blocks = {box({12e3, -2e4, -900}, {13e3, 2e4, 900})};
  for (int i = 0; i < 6; ++i) {
    const double x = 1500.0 * i;
    blocks.push_back(box({x + 2e3, 500, 100}, {x + 2700, 5e3, 900.0 + 100 * i}));
  }
  const Scene scene = sceneAbout(ray, blocks, 0.3);
  const RayEnd end = endOf(m, scene, ray);
  const auto shadow = shadowIntervals(scene.meshes, ray.position, ray.view, ray.sun, end.length);
  ASSERT_GE(shadow.size(), 2u);
  const Estimate lit = litScattering(m, ray, end.length, shadow, 1e-7);
  const Estimate all = litScattering(m, ray, end.length, {}, 1e-7);
  EXPECT_LT(lit.value[1], 0.97 * all.value[1]);
  const PathTracer tracer(m, &scene);
  const SceneLight light = traceSceneRay(tracer, scene, ray, paths(1 << 16));
  expectWithin(light.single, lit.value, 0.02, "single");
}

TEST(ScenePaths, MeshesThatLetTheSunPassCastNoShadow) {
  const Medium m = makeMediumF64(preset("earth"));
  const SceneRay ray = rayFrom(m.bottomRadius, rayQuery(500, 90, 60, 60));
  // A roof over the ray: no sky above it, no sun, and with hidesSun off all of the sun.
  Scene roof = sceneAbout(
      ray, {box({-5e4, -5e4, 50}, {5e4, 5e4, 60}), box({2e3, -5e4, -50}, {2.1e3, 5e4, 50})}, 0.0);
  roof.hidesSun = false;
  const PathTracer tracer(m, &roof);
  const SceneLight light = traceSceneRay(tracer, roof, ray, paths(1 << 14));
  expectWithin(light.single, litScattering(m, ray, light.end.length, {}, 1e-7).value, 0.02, "air");
  roof.hidesSun = true;
  alpenglow::test::expectAll(traceSceneRay(tracer, roof, ray, paths(1 << 10)).single.value, 0.0,
                             "under the roof");
}

// Lit from all directions, everything that neither absorbs nor emits has radiance 1, white
// meshes as well: each sun's share of it is 1 over 4 pi.
TEST(ScenePaths, WhiteMeshesKeepTheEnergy) {
  Parameters p = preset("earth");
  p.absorption.present = false;
  p.mie.extinction_per_m = p.mie.scattering_per_m;
  p.groundAlbedo = {{1.0, 1.0, 1.0}};
  const Medium m = makeMediumF64(p);
  const SceneRay ray = rayFrom(m.bottomRadius, rayQuery(500, 92, 0, 0));
  const Scene scene =
      sceneAbout(ray,
                 {box({4e3, -2e3, -450}, {6e3, 3e3, 2e3}), box({-3e3, 500, -300}, {2e3, 900, 1500}),
                  box({1e3, -3e3, 900}, {2e3, 3e3, 1e3})},
                 1.0);
  const PathTracer tracer(m, &scene);
  SceneRay some = ray;
  some.view = LocalFrame(glm::normalize(ray.position), ray.sun).direction(-0.03, 0.2);
  const RayEnd end = endOf(m, scene, some);
  ASSERT_TRUE(end.onSurface);
  ASSERT_LT(end.length, 5e3);
  const Vector place = some.position + end.length * some.view;
  const double up = glm::dot(some.view, glm::normalize(some.position));
  const SpectrumIntegral depth = opticalDepth(m, {500.0, up, end.length}, {1e-10, 0.0});
  Spectrum expected, wall;
  physics_f64::Spectrum relative;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    wall[c] = 1.0 / (4.0 * std::numbers::pi);
    expected[c] = wall[c] * -std::expm1(-depth.value[c]);
    relative[static_cast<glm::length_t>(c)] = 1.0 / (3.0 * expected[c]);
  }
  std::vector<physics_f64::Spectrum> air, surface;
  for (uint64_t batch = 0; batch < 48; ++batch) {
    Random sunDirections(6, batch);
    physics_f64::Spectrum airSum(0.0), surfaceSum(0.0);
    constexpr uint64_t kPaths = 1024;
    for (uint64_t i = 0; i < kPaths; ++i) {
      // Each path for itself: a net over a few dimensions spreads its means more than that here.
      PathSampler sampler(5, batch * kPaths + i);
      const Vector sun =
          around(Vector(0, 0, 1), 2.0 * sunDirections.uniform() - 1.0, sunDirections.uniform());
      const auto light =
          tracer.airSample(some.position, some.view, sun, end.length, true, relative, sampler);
      airSum += light.single + light.multiple;
      surfaceSum += tracer.surfaceSample(place, end.normal, sun, end.albedo, sampler);
    }
    air.push_back(airSum / static_cast<double>(kPaths));
    surface.push_back(surfaceSum / static_cast<double>(kPaths));
  }
  expectWithin(estimateOf(air), expected, 0.03, "air");
  expectWithin(estimateOf(surface), wall, 0.03, "wall");
}

}  // namespace
}  // namespace alpenglow::reference
