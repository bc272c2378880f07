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

/// Folded noise of falling wavelengths: ridges some kilometres apart with steep sides.
double noiseHeight(double east, double north) {
  const auto lattice = [](int64_t x, int64_t y) {
    return Random(static_cast<uint64_t>(x), static_cast<uint64_t>(y)).uniform();
  };
  double height = 0.0, size = 2000.0, wavelength = 7000.0;
  for (int octave = 0; octave < 5; ++octave, size *= 0.5, wavelength *= 0.47) {
    const double x = east / wavelength + 100.0 * octave, y = north / wavelength;
    const double fx = x - std::floor(x), fy = y - std::floor(y);
    const auto ix = static_cast<int64_t>(std::floor(x)), iy = static_cast<int64_t>(std::floor(y));
    const double sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
    const double value = glm::mix(glm::mix(lattice(ix, iy), lattice(ix + 1, iy), sx),
                                  glm::mix(lattice(ix, iy + 1), lattice(ix + 1, iy + 1), sx), sy);
    const double ridge = 1.0 - std::abs(2.0 * value - 1.0);
    height += size * ridge * ridge;
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
  Spectrum unshadowed{0.0};              ///< The same if mountains hid all but the sun.
  Spectrum bare{0.0}, bareLit{0.0};      ///< Without them, and of that from the lit parts alone.
  Spectrum isotropic{0.0};               ///< As bare, with phase functions of 1 / (4 pi), roughly.
  Spectrum surface{0.0};                 ///< What the ray's end adds, dimmed.
  Spectrum dust{0.0};    ///< Of what scatters along the ray, the share that aerosols have.
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

/// What lights a ray: the mountains, mountains without shadows, and none.
struct Worlds {
  Scene scene, unshadowed;
  PathTracer tracer, unshadowedTracer, bare;
  Worlds(const Medium& medium, const Terrain& terrain, double albedo)
      : scene(sceneOf(terrain, medium.bottomRadius, albedo)),
        unshadowed{scene.meshes, scene.albedo, false},
        tracer(medium, &scene),
        unshadowedTracer(medium, &unshadowed),
        bare(medium) {}
};

/// What needs no paths; returns the transmittance to the ray's end.
Spectrum integrateAlong(const PathTracer& bare, Sample& s) {
  const Medium& medium = bare.medium();
  const double length = s.end.length;
  s.singleLit = spectrumOf(litScattering(medium, s.ray, length, s.shadow, 1e-6).value);
  s.singleAll = spectrumOf(litScattering(medium, s.ray, length, {}, 1e-6).value);
  const double r = glm::length(s.ray.position), h = r - medium.bottomRadius;
  const LocalFrame frame(s.ray.position / r, s.ray.sun);
  const auto local = [&](const Vector& v) {
    return Vector(glm::dot(v, frame.x), glm::dot(v, frame.y), glm::dot(v, frame.z));
  };
  const Vector view = local(s.ray.view);
  s.isotropic = bare.roughSky({h, local(s.ray.sun)}, view, length);
  const double hEnd = physics_f64::altitudeAt(medium, h, view.z, length);
  const double muEnd = physics_f64::muAt(medium, h, view.z, length, hEnd);
  const Columns& columns = bare.columns();
  const Column air = columns.between(h, view.z, columns.upwards(h, std::abs(view.z)), hEnd, muEnd);
  s.dust = medium.mieScattering * air.mie;
  s.dust /= s.dust + medium.rayleighScattering * air.rayleigh;
  return exp(-columns.depth(air));
}

void evaluate(const Worlds& worlds, uint32_t paths, uint64_t stream, Sample& s) {
  const Spectrum transmittance = integrateAlong(worlds.bare, s);
  const Spectrum relative = 1.0 / (3.0 * s.singleAll);
  const Vector &position = s.ray.position, &view = s.ray.view, &sun = s.ray.sun;
  const double length = s.end.length;
  Random random(23, stream);
  Spectrum squares(0.0);
  const double share = 1.0 / paths;
  for (uint64_t i = 0; i < paths; ++i) {
    // Each path with numbers of its own: the spread of single paths is the standard error then.
    PathSampler sampler(29, stream * 0x100000 + i);
    const auto sample = [&](const PathTracer& tracer) {
      return tracer.airSample(position, view, sun, length, false, relative, sampler);
    };
    const Spectrum light = sample(worlds.tracer).multiple;
    s.truth += share * light;
    squares += share * light * light;
    s.unshadowed += share * sample(worlds.unshadowedTracer).multiple;
    const PathTracer::AerialLight open = sample(worlds.bare);
    s.bare += share * open.multiple;
    if (!isDark(s.shadow, open.t)) s.bareLit += share * open.multiple;
    if (i % 4 == 0) {
      s.surface += 4.0 * share *
                   worlds.tracer.surfaceSample(position + length * view, s.end.normal, sun,
                                               s.end.albedo, sampler);
    }
    if (i % 16 == 0) {
      const Vector from = position + open.t * view;
      const Vector up = around(glm::normalize(from), random.uniform(), random.uniform());
      s.skySeen += worlds.scene.meshes.blocked(from, up, 0.0, kEndless) ? 0.0 : 16.0 * share;
    }
  }
  s.truthError = sqrt(max(squares - s.truth * s.truth, Spectrum(0.0)) * share);
  s.surface *= transmittance;
}

void evaluateAll(const Worlds& worlds, std::vector<Sample>& samples, uint64_t stream) {
  const char* wanted = std::getenv("ALPENGLOW_BENCH_PATHS");
  const uint32_t paths = wanted != nullptr ? static_cast<uint32_t>(std::atoi(wanted)) : 8192;
  std::atomic<size_t> next = 0;
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(std::thread::hardware_concurrency(), 1u); ++i) {
    threads.emplace_back([&] {
      for (size_t k = next++; k < samples.size(); k = next++) {
        evaluate(worlds, paths, stream + k, samples[k]);
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
    for (const Spectrum* v : {&s.singleLit, &s.singleAll, &s.truth, &s.truthError, &s.bare,
                              &s.bareLit, &s.surface, &s.unshadowed, &s.isotropic, &s.dust}) {
      file << ',' << v->x << ',' << v->y << ',' << v->z;
    }
    file << '\n';
  }
}

/// Median, 95th percentile and maximum.
struct Spread {
  double median = 0.0, most = 0.0, maximum = 0.0;
};
Spread spreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const auto i = static_cast<size_t>(share * static_cast<double>(values.size()));
    return values[std::min(i, values.size() - 1)];
  };
  return {at(0.5), at(0.95), values.back()};
}

/// What a renderer might take for the multiple scattering of a ray.
struct Rule {
  const char* name;
  Spectrum (*multiple)(const Sample&);
};
Spectrum darkShare(const Sample& s) { return 1.0 - s.singleLit / s.singleAll; }
/// M (1 - k D).
template <int Percent>
Spectrum dimmed(const Sample& s) {
  return s.bare * (1.0 - 0.01 * Percent * darkShare(s));
}
/// What shadows alone leave of multiple scattering, as fitted: aerosols scatter forwards, so theirs
/// is almost single scattering once more; molecules scatter light from everywhere.
Spectrum shadowed(const Sample& s) { return 1.0 - 0.7 * s.dust * darkShare(s); }

/// Places in the list below.
enum : size_t { kAlone = 0, kDimmed70 = 4, kOpen = 10, kOpenByDust = 12 };
constexpr Rule kRules[] = {
    {"(a) M", [](const Sample& s) { return s.bare; }},
    {"(b) M of the lit parts", [](const Sample& s) { return s.bareLit; }},
    {"(c) M (1 - 0.35 D)", dimmed<35>},
    {"(c) M (1 - 0.5 D)", dimmed<50>},
    {"(c) M (1 - 0.7 D)", dimmed<70>},
    {"(c) M (1 - 0.8 D)", dimmed<80>},
    {"(d) M (1 - 0.7 A D)", [](const Sample& s) { return s.bare * shadowed(s); }},
    {"(e) V^2 M (1 - 0.7 A D)",
     [](const Sample& s) { return s.skySeen * s.skySeen * s.bare * shadowed(s); }},
    {"(f) I (1 - 0.5 D)", [](const Sample& s) { return s.isotropic * (1.0 - 0.5 * darkShare(s)); }},
    {"(g) V I (1 - 0.4 D)",
     [](const Sample& s) { return s.skySeen * s.isotropic * (1.0 - 0.4 * darkShare(s)); }},
    {"(h) N", [](const Sample& s) { return s.unshadowed; }},
    {"(i) N (1 - 0.35 D)",
     [](const Sample& s) { return s.unshadowed * (1.0 - 0.35 * darkShare(s)); }},
    {"(j) N (1 - 0.7 A D)", [](const Sample& s) { return s.unshadowed * shadowed(s); }},
};
constexpr const char* kLegend =
    "Error of a rule in per cent of the ray's radiance, worst channel: median / 95th percentile /\n"
    "maximum (mean with its sign, all channels). M: multiple scattering over the bare planet; N:\n"
    "among mountains that hide all but the sun itself; I: M for phase functions of 1 / (4 pi); D:\n"
    "share of single scattering lost in shadow; A: aerosols' share of scattering; V: open share "
    "of\n"
    "the sky. No renderer has N: (h) to (j) show what shadows alone do.\n";

double worst(const Spectrum& x) { return std::max({x.x, x.y, x.z}); }

/// Prints a rule's line; returns the median error.
double report(const Rule& rule, const std::vector<Sample>& samples) {
  std::vector<double> errors;
  double bias = 0.0;
  for (const Sample& s : samples) {
    const Spectrum off = 100.0 * (rule.multiple(s) - s.truth) / s.total();
    errors.push_back(worst(abs(off)));
    bias += sumOf(off) / 3.0 / static_cast<double>(samples.size());
  }
  const Spread spread = spreadOf(errors);
  std::printf("| %-24s | %5.1f / %5.1f / %5.1f (%+.1f) |\n", rule.name, spread.median, spread.most,
              spread.maximum, bias);
  return spread.median;
}

/// The k with which base (1 - k D) has the least mean square error, of all channels and of each.
void fitDimming(const char* name, Spectrum Sample::*base, const std::vector<Sample>& samples) {
  Spectrum fit(0.0), weight(0.0);
  for (const Sample& s : samples) {
    const Spectrum change = s.*base * darkShare(s) / s.total();
    fit += change * (s.*base - s.truth) / s.total();
    weight += change * change;
  }
  const Spectrum k = fit / weight;
  std::printf("best k of %s (1 - k D): %.2f; red %.2f, green %.2f, blue %.2f\n", name,
              sumOf(fit) / sumOf(weight), k.x, k.y, k.z);
}

/// What the rays are like. Fails where the truth is too noisy to say anything.
void describe(const std::vector<Sample>& samples) {
  const auto median = [&](const auto& value) {
    std::vector<double> values;
    for (const Sample& s : samples) values.push_back(value(s));
    return spreadOf(values).median;
  };
  const double error =
      median([](const Sample& s) { return 100.0 * worst(s.truthError / s.total()); });
  std::printf(
      "%zu rays; medians: %.1f km long, %.2f of it dark, %.2f of the sky open, standard "
      "error %.2f %%",
      samples.size(), median([](const Sample& s) { return 1e-3 * s.end.length; }),
      median([](const Sample& s) { return shadowLength(s.shadow) / s.end.length; }),
      median([](const Sample& s) { return s.skySeen; }), error);
  const char* names[] = {"red", "green", "blue"};
  for (glm::length_t c = 0; c < 3; ++c) {
    std::printf("; %s N / M %.2f, truth / N %.2f, A %.2f", names[c],
                median([c](const Sample& s) { return s.unshadowed[c] / s.bare[c]; }),
                median([c](const Sample& s) { return s.truth[c] / s.unshadowed[c]; }),
                median([c](const Sample& s) { return s.dust[c]; }));
  }
  std::printf("\n");
  fitDimming("M", &Sample::bare, samples);
  fitDimming("N", &Sample::unshadowed, samples);
  EXPECT_LT(error, 2.0);
}

TEST(TerrainLight, MultipleScatteringInMountainShadows) {
  const Parameters p = preset("earth");
  const Medium medium = makeMediumF64(p);
  const Terrain terrain = loadTerrain();
  const Worlds worlds(medium, terrain, p.groundAlbedo[0]);
  const char* csv = std::getenv("ALPENGLOW_BENCH_CSV");
  std::ofstream file;
  if (csv != nullptr) file.open(csv);
  std::fputs(kLegend, stdout);
  uint64_t stream = 0;
  for (Place place : {Place::Valley, Place::Summit}) {
    for (double sun_deg : kSuns_deg) {
      std::vector<Sample> samples = drawRays(medium, terrain, worlds.scene, place, sun_deg);
      ASSERT_GE(samples.size(), 60u);
      evaluateAll(worlds, samples, stream);
      stream += 1000;
      if (csv != nullptr) writeCsv(file, place, sun_deg, samples);
      std::printf("\n%s, sun %g degrees: ", place == Place::Valley ? "Valleys" : "Summit", sun_deg);
      describe(samples);
      std::vector<double> medians;
      for (const Rule& rule : kRules) medians.push_back(report(rule, samples));
      std::fflush(stdout);
      if (place != Place::Valley) continue;
      // Shadows dim multiple scattering; they neither leave it alone nor take it away.
      EXPECT_LT(medians[kDimmed70], medians[kAlone]);
      EXPECT_LT(medians[kOpenByDust], medians[kOpen]);
      EXPECT_LT(medians[kOpenByDust], sun_deg < 10.0 ? 25.0 : 5.0);
    }
  }
}

}  // namespace
}  // namespace alpenglow::reference
