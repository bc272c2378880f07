#include "random_scene.h"

#include <algorithm>
#include <cmath>

#include "tests/parameters/heard.h"

namespace alpenglow::test {
namespace {

using namespace io;

class Maker {
 public:
  Maker(std::mt19937_64* random, Angles angles) : random_(random), angles_(angles) {}

  bool chance() { return whole(2) == 1; }
  uint32_t whole(uint32_t count) { return static_cast<uint32_t>((*random_)() % count); }
  double number(double least, double most) {
    return std::uniform_real_distribution<>(least, most)(*random_);
  }
  /// Over orders of magnitude, now and then a round number.
  double positive(double least, double most) {
    const double value = std::exp(number(std::log(least), std::log(most)));
    return std::clamp(chance() ? std::ceil(value) : value, least, most);
  }
  double angle(double leastDegrees, double mostDegrees) {
    constexpr double kStep = 3.14159265358979323846 / 180.0;
    double degrees = number(leastDegrees, mostDegrees);
    if (angles_ == Angles::OfRadians) {
      return number(leastDegrees * kStep, mostDegrees * kStep);
    }
    if (chance()) degrees = std::clamp(std::round(degrees * 100) / 100, leastDegrees, mostDegrees);
    return degrees * kStep;
  }
  Spectrum color() { return {{number(0, 1), number(0, 1), chance() ? 1.0 : 0.0}}; }

 private:
  std::mt19937_64* random_;
  Angles angles_;
};

Parameters air(Maker* make) {
  const std::span<const Preset> all = testing::allPresets();
  Parameters air = all[make->whole(static_cast<uint32_t>(all.size()))].parameters;
  if (make->chance()) return air;
  air.groundAlbedo = make->color();
  air.sunAngularRadius = make->angle(0.01, 1.0);
  for (double& value : air.rayleigh.scattering_per_m.value) value *= make->number(0.5, 2.0);
  if (make->chance()) air.rayleigh = {};
  if (make->chance()) air.mie = {};
  if (make->chance()) air.absorption = {};
  return air;
}

SceneCamera camera(Maker* make) {
  SceneCamera camera;
  camera.latitude = make->angle(-90, 90);
  camera.longitude = make->angle(-360, 360);
  camera.altitude_m = make->positive(1e-3, 1e12) * (make->chance() ? 1 : -1);
  camera.heading = make->angle(-720, 720);
  camera.pitch = make->angle(-90, 90);
  camera.roll = make->angle(-180, 180);
  switch (make->whole(3)) {
    case 0:
      camera.fov = make->angle(0.1, 179.9);
      break;
    case 1:
      camera.projection = Projection::Fisheye;
      camera.fov = make->angle(0.1, 360);
      break;
    default:
      camera.orthographicHeight_m = make->positive(1e-3, 1e12);
  }
  return camera;
}

SceneTerrain terrain(Maker* make, const Scene& scene) {
  SceneTerrain terrain;
  terrain.heightMap = "/maps/heights \"1\" \\ \xc3\xa9.png";
  for (double& metres : terrain.metersPerPixel) metres = make->positive(1e-3, 1e9);
  if (make->chance()) terrain.metersPerUnit = make->positive(1e-3, 1e9);
  if (make->chance()) terrain.heightScale = make->positive(1e-3, 1e9);
  if (make->chance()) terrain.base_m = make->number(-1e9, 1e9);
  if (make->chance()) terrain.fade_m = make->positive(1e-3, 1e9);
  const bool own = make->chance();
  terrain.latitude = own ? make->angle(-90, 90) : scene.camera.latitude;
  terrain.longitude = own ? make->angle(-360, 360) : scene.camera.longitude;
  if (make->chance()) terrain.heading = make->angle(-360, 360);
  terrain.albedo = scene.atmosphere.groundAlbedo;
  if (make->chance()) {
    terrain.albedoMap = "/maps/colours.jpg";
  } else if (make->chance()) {
    terrain.albedo = make->color();
  }
  return terrain;
}

SceneBalloon balloon(Maker* make) {
  SceneBalloon balloon;
  balloon.latitude = make->angle(-90, 90);
  balloon.longitude = make->angle(-360, 360);
  balloon.altitude_m = make->number(0, 1e9);
  if (make->chance()) balloon.radius_m = make->positive(1e-3, 1e9);
  if (make->chance()) balloon.color = make->color();
  if (make->chance()) balloon.opacity = make->number(0, 1);
  return balloon;
}

SceneRequirements requirements(Maker* make, const Scene& scene) {
  SceneRequirements requirements;
  if (make->chance()) {
    const double own = std::max(scene.camera.altitude_m, 0.0);
    requirements.altitude_m[0] = make->chance() ? own : own * make->number(0, 1);
    requirements.altitude_m[1] = make->chance() ? own : make->number(own, 1e12);
  }
  if (make->chance()) {
    const double own = scene.sun.elevation;
    requirements.sunElevation[0] = make->chance() ? own : std::min(own, make->angle(-90, 90));
    requirements.sunElevation[1] = make->chance() ? own : std::max(own, make->angle(-90, 90));
  }
  if (make->chance()) requirements.exposure = make->positive(1e-12, 1e12);
  if (make->chance()) requirements.error = make->number(1e-4, 1);
  if (make->chance()) requirements.budgetBytes = 1 + (uint64_t{make->whole(1u << 31)} << 18);
  if (make->chance()) requirements.budgetSeconds = make->positive(1e-6, 1e9);
  return requirements;
}

void chooseTables(Maker* make, Scene* scene) {
  scene->model = static_cast<SceneModel>(make->whole(6));
  const bool sampled = scene->model == SceneModel::ONeil || scene->model == SceneModel::Hillaire;
  if (sampled && make->chance()) scene->modelStepCount = 1 + make->whole(1024);
  if (solverOf(scene->model)) return;
  if (make->chance()) scene->solver = make->chance() ? Solver::Moments : Solver::Standard;
  if (make->chance()) scene->orders = 1 + make->whole(1000);
  if (scene->model == SceneModel::Single) scene->orders = 1;
  if (make->chance()) {
    scene->quality = static_cast<Quality>(static_cast<uint32_t>(Quality::Draft) + make->whole(5));
  }
}

}  // namespace

Scene randomScene(std::mt19937_64* random, Angles angles) {
  Maker maker(random, angles);
  Maker* make = &maker;
  Scene scene;
  scene.atmosphere = air(make);
  scene.sun = {make->angle(-90, 90), make->angle(-360, 360), 0.0};
  if (make->chance()) scene.sun.discRadius = make->angle(0, 45);
  scene.camera = camera(make);
  if (make->chance()) scene.albedoMap = "/maps/earth.jpg";
  if (make->chance()) scene.terrain = terrain(make, scene);
  for (uint32_t i = make->chance() ? make->whole(4) : 0; i > 0; --i) {
    scene.balloons.push_back(balloon(make));
  }
  if (make->chance()) scene.stars = SceneStars{make->chance() ? make->number(-1e6, 1e6) : 0.0};
  if (make->chance()) scene.shafts = static_cast<SceneLightShafts>(make->whole(5));
  if (make->chance()) scene.lightShaftStepCount = 1 + make->whole(kMaxLightShaftSteps);
  if (make->chance()) scene.width = 1 + make->whole(kMaxPictureSide);
  if (make->chance()) scene.height = 1 + make->whole(kMaxPictureSide);
  if (make->chance()) scene.exposure = make->positive(1e-12, 1e12);
  scene.toneMap = static_cast<ToneMap>(make->whole(3));
  chooseTables(make, &scene);
  if (make->chance()) {
    for (Force& force : scene.effects) force = static_cast<Force>(make->whole(3));
  }
  const Force shafts = scene.effects[static_cast<uint32_t>(Effect::LightShafts)];
  if (shafts == Force::Off) scene.shafts = SceneLightShafts::Off;
  if (make->chance()) scene.requirements = requirements(make, scene);
  return scene;
}

}  // namespace alpenglow::test
