// Casters with known shadows, and where the sun and the camera make them hard.
#include <cmath>
#include <random>

#include "tests/passes/light_shafts/shadow_check.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;
using reference::test::box;
using reference::test::Mesh;

Mesh moved(Mesh mesh, const Vector& by) {
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] += by[static_cast<int>(i % 3)];
  return mesh;
}

std::vector<Mesh> comb() {
  std::vector<Mesh> slats;
  for (int i = 0; i < 6; ++i)
    slats.push_back(box(Vector(700, 2600, -600 + 200 * i), Vector(1200, 2700, -520 + 200 * i)));
  return slats;
}

}  // namespace

std::vector<ShadowScene> shadowScenes() {
  const Mesh block = box(Vector(1000, 3000, -200), Vector(1400, 3400, 200));
  const Mesh roof = box(Vector(700, -300, -400), Vector(800, 900, 400));
  const Mesh high = box(Vector(5100, 2500, -300), Vector(5500, 2900, 300));
  std::vector<ShadowScene> s;
  s.push_back({"box", {block}, {50, 0, 0}, 90, 15, 60, 40, 200});
  s.push_back({"sphere",
               {moved(reference::test::icosphere(300, 3), Vector(1200, 3000, 0))},
               {50, 0, 0},
               90,
               15,
               60,
               35,
               220});
  s.push_back({"comb of slats", comb(), {50, 0, 0}, 90, 12, 60, 25, 150});
  s.push_back({"nested boxes",
               {block, box(Vector(1100, 3100, -100), Vector(1300, 3300, 100))},
               {50, 0, 0},
               90,
               15,
               60,
               40,
               200});
  s.push_back({"overlapping shadows",
               {block, box(Vector(500, 2800, 300), Vector(900, 3300, 800))},
               {50, 0, 0},
               90,
               12,
               60,
               40,
               180});
  s.push_back({"camera in shadow", {roof}, {50, 0, 0}, 90, 8, 60, 80, 180});
  s.push_back({"towards the sun", {block}, {50, 0, 0}, 90, 20, 60, 30, 88});
  s.push_back({"in shadow, towards the sun", {block}, {50, 0, 0}, 90, 20, 60, 20, 90});
  s.push_back({"in shadow, sun behind", {block}, {50, 4000, 0}, 90, 8, 60, 50, 270});
  s.push_back({"in shadow, sun along the near plane", {block}, {50, 3200, -800}, 90, 0, 60, 60, 0});
  s.push_back({"away from the sun", {block}, {1800, 4000, 0}, 90, -15, 60, 15, 270});
  s.push_back({"sun straight up", {block}, {50, 0, 0}, 90, 12, 60, 90, 0});
  s.push_back({"sun along the near plane", {block}, {50, 0, 0}, 90, 0, 60, 30, 0});
  s.push_back({"sun behind the camera", {block}, {50, 0, 0}, 90, 12, 60, 20, 270});
  s.push_back({"sun at 0 degrees", {high}, {5000, 0, 0}, 90, 3, 60, 0, 160});
  s.push_back({"sun at -1 degrees", {high}, {5000, 0, 0}, 90, 3, 60, -1, 160});
  return s;
}

ShadowScene randomScene(uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  ShadowScene scene = {"random meshes",        {}, {50, 0, 0}, 90, 15, 70, 45 + 30 * any(random),
                       180 + 170 * any(random)};
  for (int i = 0; i < 4; ++i) {
    Mesh mesh = reference::test::icosphere(250 + 100 * any(random), 1);
    for (size_t v = 0; v < mesh.positions.size(); v += 3) {
      const double bump = 1.0 + 0.4 * any(random);
      for (size_t k = 0; k < 3; ++k) mesh.positions[v + k] *= bump;
    }
    scene.casters.push_back(
        moved(mesh, Vector(1200 + 300 * any(random), 3000 + 500 * any(random), 500 * any(random))));
  }
  return scene;
}

ShadowScene hillScene(double sunAzimuth) {
  constexpr uint32_t kSide = 64;
  constexpr double kWidth = 30000.0;
  const auto heightAt = [](double east, double north) {
    const double ridges = std::abs(std::sin(east / 1700.0 + 0.7 * std::sin(north / 2300.0)));
    return 350.0 + 500.0 * ridges * (1.0 + 0.4 * std::sin(north / 900.0));
  };
  Mesh mesh;
  for (const bool top : {true, false}) {
    for (uint32_t j = 0; j < kSide; ++j) {
      for (uint32_t i = 0; i < kSide; ++i) {
        const double east = kWidth * (i / (kSide - 1.0) - 0.5);
        const double north = kWidth * (j / (kSide - 1.0) - 0.5);
        addCorner(mesh, Vector(top ? heightAt(east, north) : -100.0, east, north));
      }
    }
  }
  const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
  };
  constexpr uint32_t kBottom = kSide * kSide, kLast = kSide - 1;
  for (uint32_t j = 0; j < kLast; ++j) {
    for (uint32_t i = 0; i < kLast; ++i) {
      const uint32_t a = j * kSide + i, b = a + 1, c = a + kSide + 1, d = a + kSide;
      quad(a, b, c, d);
      quad(kBottom + a, kBottom + d, kBottom + c, kBottom + b);
    }
    const uint32_t s = j, n = kLast * kSide + j, w = j * kSide, e = j * kSide + kLast;
    quad(s, kBottom + s, kBottom + s + 1, s + 1);
    quad(n + 1, kBottom + n + 1, kBottom + n, n);
    quad(w + kSide, kBottom + w + kSide, kBottom + w, w);
    quad(e, kBottom + e, kBottom + e + kSide, e + kSide);
  }
  // Above a ridge, so that the sun reaches the camera.
  return {"hills", {mesh}, {heightAt(2600, 0) + 250.0, 2600, 0}, 80, -4, 60, 8, sunAzimuth};
}

}  // namespace alpenglow::testing
