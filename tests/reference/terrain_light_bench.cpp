// What mountain shadows do to light scattered more than once: the path tracer among the mountains
// against cheap rules that a renderer could follow. Prints tables; docs quote them.
//
// The terrain is a raw file of 344 rows of 403 little-endian int16 metres, cells of 74 x 92.6 m,
// named by ALPENGLOW_BENCH_TERRAIN (the array `elevation` of jacksboro_fault_dem.npz, which comes
// with matplotlib's sample data), heights taken threefold; without it hills made of noise.
// ALPENGLOW_BENCH_CSV names a file for all rays, ALPENGLOW_BENCH_PATHS sets paths a ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "atmosphere/reference/scene_light.h"
#include "atmosphere/reference/single_scattering.h"
#include "test_atmospheres.h"

namespace alpenglow::reference {
namespace {

using alpenglow::test::kDegree;
using alpenglow::test::preset;
using physics_f64::Spectrum;

constexpr uint32_t kColumns = 403, kRows = 344;
constexpr double kCellEast = 74.0, kCellNorth = 92.6;
constexpr uint32_t kRaysPerCase = 64;
constexpr double kSuns_deg[] = {5.0, 15.0, 30.0};

double sumOf(const Spectrum& s) { return s.x + s.y + s.z; }

/// Heights in metres from the lowest place, row by row from the north.
struct Terrain {
  std::vector<double> heights;
  double at(uint32_t column, uint32_t row) const {
    return heights[size_t{row} * kColumns + column];
  }
};

/// Folded noise of falling wavelengths: ridges 3 to 6 km apart, valleys between, up to 2.5 km high.
double noiseHeight(double east, double north) {
  const auto lattice = [](int64_t x, int64_t y) {
    return Random(static_cast<uint64_t>(x), static_cast<uint64_t>(y)).uniform();
  };
  double height = 0.0, size = 1100.0, wavelength = 6000.0;
  for (int octave = 0; octave < 5; ++octave, size *= 0.5, wavelength *= 0.47) {
    const double x = east / wavelength + 100.0 * octave, y = north / wavelength;
    const double fx = x - std::floor(x), fy = y - std::floor(y);
    const auto ix = static_cast<int64_t>(std::floor(x)), iy = static_cast<int64_t>(std::floor(y));
    const double sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
    const double value = glm::mix(glm::mix(lattice(ix, iy), lattice(ix + 1, iy), sx),
                                  glm::mix(lattice(ix, iy + 1), lattice(ix + 1, iy + 1), sx), sy);
    height += size * (1.0 - std::abs(2.0 * value - 1.0));
  }
  return height;
}

Terrain loadTerrain() {
  Terrain terrain;
  terrain.heights.resize(size_t{kColumns} * kRows);
  const char* path = std::getenv("ALPENGLOW_BENCH_TERRAIN");
  if (path != nullptr) {
    std::vector<int16_t> raw(terrain.heights.size());
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(raw.data()),
              static_cast<std::streamsize>(raw.size() * sizeof(int16_t)));
    EXPECT_TRUE(file) << path << " holds fewer than " << raw.size() << " heights.";
    for (size_t i = 0; i < raw.size(); ++i) terrain.heights[i] = 3.0 * raw[i];
  } else {
    for (uint32_t y = 0; y < kRows; ++y) {
      for (uint32_t x = 0; x < kColumns; ++x) {
        terrain.heights[size_t{y} * kColumns + x] = noiseHeight(x * kCellEast, y * kCellNorth);
      }
    }
  }
  const double lowest = *std::min_element(terrain.heights.begin(), terrain.heights.end());
  for (double& height : terrain.heights) height -= lowest;
  return terrain;
}

/// Over the sphere, the terrain's middle at the planet's pole: x east, y north there.
Vector placeOf(double bottomRadius, double column, double row, double height) {
  const double east = (column - 0.5 * (kColumns - 1)) * kCellEast;
  const double north = (0.5 * (kRows - 1) - row) * kCellNorth;
  return (bottomRadius + height) * glm::normalize(Vector(east, north, bottomRadius));
}

Scene sceneOf(const Terrain& terrain, double bottomRadius, double albedo) {
  const Vector origin(0.0, 0.0, bottomRadius);
  std::vector<double> positions;
  std::vector<uint32_t> indices;
  for (uint32_t y = 0; y < kRows; ++y) {
    for (uint32_t x = 0; x < kColumns; ++x) {
      const Vector p = placeOf(bottomRadius, x, y, terrain.at(x, y)) - origin;
      positions.insert(positions.end(), {p.x, p.y, p.z});
      if (x + 1 == kColumns || y + 1 == kRows) continue;
      const uint32_t a = y * kColumns + x, b = a + 1, c = a + kColumns, d = c + 1;
      indices.insert(indices.end(), {a, c, b, b, c, d});
    }
  }
  Scene scene;
  scene.meshes.add(origin, std::span<const double>(positions), indices);
  scene.meshes.build();
  scene.albedo.emplace_back(albedo);
  return scene;
}

/// A ray with what all rules need to know of it. Per unit solar irradiance.
struct Sample {
  SceneRay ray;
  RayEnd end;
  std::vector<RayInterval> shadow;
  Spectrum singleLit{0.0}, singleAll{0.0};
  Spectrum truth{0.0}, truthError{0.0};  ///< Light of orders 2 and more, among the mountains.
  Spectrum bare{0.0}, bareLit{0.0};      ///< Without them, and of that from the lit parts alone.
  Spectrum surface{0.0};                 ///< What the ray's end adds, dimmed.
  double skySeen = 0.0;  ///< Share of the upper hemisphere that is open, mean along the ray.
  Spectrum total() const { return singleLit + truth + surface; }
};

enum class Place { Valley, Summit };

double shadowLength(const std::vector<RayInterval>& shadow) {
  double sum = 0.0;
  for (const RayInterval& s : shadow) sum += s.to - s.from;
  return sum;
}

/// Rays from below the terrain's mean height through 5 to 25 km of air, a sixth of it dark at
/// least; or from 3 m above the highest place, any that go on for 2 km.
std::vector<Sample> drawRays(const Medium& medium, const Terrain& terrain, const Scene& scene,
                             Place place, double sun_deg) {
  Random random(17, place == Place::Valley ? 1 : 2);
  const size_t top = static_cast<size_t>(
      std::max_element(terrain.heights.begin(), terrain.heights.end()) - terrain.heights.begin());
  double mean = 0.0;
  for (double height : terrain.heights)
    mean += height / static_cast<double>(terrain.heights.size());
  std::vector<Sample> samples;
  for (int tries = 0; tries < 1000000 && samples.size() < kRaysPerCase; ++tries) {
    uint32_t column = static_cast<uint32_t>(top % kColumns);
    uint32_t row = static_cast<uint32_t>(top / kColumns);
    double above = 3.0;
    if (place == Place::Valley) {
      column = 10 + static_cast<uint32_t>(random.uniform() * (kColumns - 20));
      row = 10 + static_cast<uint32_t>(random.uniform() * (kRows - 20));
      above = 2.0 + 100.0 * random.uniform();
      if (terrain.at(column, row) > mean) continue;
    }
    Sample s;
    s.ray.position = placeOf(medium.bottomRadius, column, row, terrain.at(column, row) + above);
    const LocalFrame frame(glm::normalize(s.ray.position), Vector(1, 0, 0));
    const double turn = 2.0 * std::numbers::pi * random.uniform();
    s.ray.sun = frame.direction(std::sin(sun_deg * kDegree), turn);
    const double pitch =
        place == Place::Valley ? -3.0 + 6.0 * random.uniform() : -12.0 + 13.0 * random.uniform();
    s.ray.view =
        frame.direction(std::sin(pitch * kDegree), 2 * std::numbers::pi * random.uniform());
    s.end = endOf(medium, scene, s.ray);
    if (!s.end.onSurface || s.end.length < (place == Place::Valley ? 5e3 : 2e3)) continue;
    if (place == Place::Valley && s.end.length > 25e3) continue;
    s.shadow = shadowIntervals(scene.meshes, s.ray.position, s.ray.view, s.ray.sun, s.end.length);
    const double dark = shadowLength(s.shadow) / s.end.length;
    if (dark < (place == Place::Valley ? 1.0 / 6.0 : 0.0)) continue;
    samples.push_back(std::move(s));
  }
  return samples;
}

bool isDark(const std::vector<RayInterval>& shadow, double t) {
  for (const RayInterval& s : shadow) {
    if (t >= s.from && t <= s.to) return true;
  }
  return false;
}

Spectrum spectrumOf(const alpenglow::Spectrum& s) { return {s[0], s[1], s[2]}; }

void evaluate(const PathTracer& bare, const PathTracer& tracer, const Scene& scene, uint32_t paths,
              uint64_t stream, Sample& s) {
  const Medium& medium = bare.medium();
  const double length = s.end.length;
  s.singleLit = spectrumOf(litScattering(medium, s.ray, length, s.shadow, 1e-6).value);
  s.singleAll = spectrumOf(litScattering(medium, s.ray, length, {}, 1e-6).value);
  const Spectrum relative = 1.0 / (3.0 * s.singleAll);
  const Vector place = s.ray.position + length * s.ray.view;
  const double r = glm::length(s.ray.position), h = r - medium.bottomRadius;
  const SpectrumIntegral depth =
      opticalDepth(medium, {h, glm::dot(s.ray.position, s.ray.view) / r, length}, {1e-6, 1e-9});
  Random random(23, stream);
  Spectrum squares(0.0);
  const double share = 1.0 / paths;
  for (uint64_t i = 0; i < paths; ++i) {
    // Each path with numbers of its own: the spread of single paths is the standard error then.
    PathSampler sampler(29, stream * 0x100000 + i);
    const auto air =
        tracer.airSample(s.ray.position, s.ray.view, s.ray.sun, length, false, relative, sampler);
    s.truth += share * air.multiple;
    squares += share * air.multiple * air.multiple;
    const auto open =
        bare.airSample(s.ray.position, s.ray.view, s.ray.sun, length, false, relative, sampler);
    s.bare += share * open.multiple;
    if (!isDark(s.shadow, open.t)) s.bareLit += share * open.multiple;
    if (i % 4 == 0) {
      s.surface +=
          4.0 * share * tracer.surfaceSample(place, s.end.normal, s.ray.sun, s.end.albedo, sampler);
    }
    if (i % 16 == 0) {
      const Vector from = s.ray.position + open.t * s.ray.view;
      const Vector up = around(glm::normalize(from), random.uniform(), random.uniform());
      s.skySeen += scene.meshes.blocked(from, up, 0.0, kEndless) ? 0.0 : 16.0 * share;
    }
  }
  s.truthError = sqrt(max(squares - s.truth * s.truth, Spectrum(0.0)) * share);
  for (glm::length_t c = 0; c < 3; ++c) {
    s.surface[c] *= std::exp(-depth.value[static_cast<size_t>(c)]);
  }
}

void evaluateAll(const PathTracer& bare, const PathTracer& tracer, const Scene& scene,
                 std::vector<Sample>& samples, uint64_t stream) {
  const char* wanted = std::getenv("ALPENGLOW_BENCH_PATHS");
  const uint32_t paths = wanted != nullptr ? static_cast<uint32_t>(std::atoi(wanted)) : 8192;
  std::atomic<size_t> next = 0;
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(std::thread::hardware_concurrency(), 1u); ++i) {
    threads.emplace_back([&] {
      for (size_t k = next++; k < samples.size(); k = next++) {
        evaluate(bare, tracer, scene, paths, stream + k, samples[k]);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

void writeCsv(std::ofstream& file, Place place, double sun_deg,
              const std::vector<Sample>& samples) {
  for (const Sample& s : samples) {
    file << (place == Place::Valley ? "valley," : "summit,") << sun_deg << ',' << s.end.length
         << ',' << shadowLength(s.shadow) / s.end.length << ',' << s.skySeen << ','
         << glm::dot(s.ray.view, s.ray.sun);
    for (const Spectrum* v :
         {&s.singleLit, &s.singleAll, &s.truth, &s.truthError, &s.bare, &s.bareLit, &s.surface}) {
      file << ',' << v->x << ',' << v->y << ',' << v->z;
    }
    file << '\n';
  }
}

TEST(TerrainLight, MultipleScatteringInMountainShadows) {
  const Parameters p = preset("earth");
  const Medium medium = makeMediumF64(p);
  const Terrain terrain = loadTerrain();
  const Scene scene = sceneOf(terrain, medium.bottomRadius, p.groundAlbedo[0]);
  const PathTracer bare(medium), tracer(medium, &scene);
  const char* csv = std::getenv("ALPENGLOW_BENCH_CSV");
  std::ofstream file;
  if (csv != nullptr) file.open(csv);
  uint64_t stream = 0;
  for (Place place : {Place::Valley, Place::Summit}) {
    for (double sun_deg : kSuns_deg) {
      std::vector<Sample> samples = drawRays(medium, terrain, scene, place, sun_deg);
      evaluateAll(bare, tracer, scene, samples, stream);
      stream += 1000;
      writeCsv(file, place, sun_deg, samples);
      std::printf("%d %g: %zu rays, first %g\n", place == Place::Valley, sun_deg, samples.size(),
                  samples.empty() ? 0.0 : sumOf(samples[0].truth));
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace alpenglow::reference
