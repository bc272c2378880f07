#include "scene_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "failure.h"
#include "terrain/landscape.h"

namespace alpenglow::samples {
namespace {

// The picture's half diagonal, where each ray of an orthographic camera has an observer of its own.
double spread(const io::Scene& scene) {
  const double height = scene.camera.orthographicHeight_m.value_or(0.0);
  return 0.5 * height * std::hypot(1.0, double(scene.width) / double(scene.height));
}

void describeCamera(const io::Scene& scene, Needs* needs) {
  const double own = std::max(scene.camera.altitude_m, 0.0), around = spread(scene);
  needs->altitudeFrom_m = std::max(own - around, 0.0);
  // 0 would be no limit.
  needs->altitudeTo_m = std::max(own + around, 1.0);
  if (!scene.needs || !scene.needs->altitude_m[0]) return;
  needs->altitudeFrom_m = *scene.needs->altitude_m[0];
  needs->altitudeTo_m = std::max(*scene.needs->altitude_m[1] + around, 1.0);
}

void describeSun(const io::Scene& scene, Needs* needs) {
  const double around = spread(scene) / scene.atmosphere.bottomRadius_m;
  double from = scene.sun.elevation, to = from;
  if (scene.needs && scene.needs->sunElevation[0]) {
    from = *scene.needs->sunElevation[0];
    to = *scene.needs->sunElevation[1];
  }
  constexpr double kRightAngle = 1.5707963267948966;
  needs->sunElevationFrom = std::clamp(from - around, -kRightAngle, kRightAngle);
  needs->sunElevationTo = std::clamp(to + around, -kRightAngle, kRightAngle);
  needs->sunFixed = needs->sunElevationFrom == needs->sunElevationTo;
}

// Terrain and balloons are drawn by shaders that read every table.
void keepTables(const io::Scene& scene, Needs* needs) {
  if (!scene.terrain && scene.balloons.empty()) return;
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const auto effect = static_cast<Effect>(i);
    if ((kTableEffects & effectBit(effect)) == 0) continue;
    if (needs->effects[i] == Force::Off) {
      throw Failure(
          std::string("The scene turns ") + effectName(effect) +
          " off, but its terrain or balloons are drawn with all tables: only scenes without them "
          "can be without it.");
    }
    needs->effects[i] = Force::On;
  }
}

}  // namespace

void checkScenery(const io::Scene& scene) {
  if (scene.stars && io::solverOf(scene.model)) {
    throw Failure("The scene has stars and the model " + io::modelName(scene.model) +
                  ", but stars are dimmed by tables of the model bruneton.");
  }
  if (scene.camera.projection != Projection::Fisheye) return;
  if (!scene.terrain && scene.balloons.empty()) return;
  throw Failure(std::string("The scene has ") + (scene.terrain ? "a terrain" : "balloons") +
                " and a fisheye camera, but triangles are drawn only in perspective and "
                "orthographic pictures.");
}

SkyDraw describeDraw(const io::Scene& scene) {
  const io::SceneCamera& c = scene.camera;
  SkyDraw draw;
  draw.camera = cameraFromGeodetic(scene.atmosphere, c.latitude, c.longitude, c.altitude_m,
                                   c.heading, c.pitch, c.roll, c.fov);
  draw.camera.height_m = c.orthographicHeight_m.value_or(0.0);
  sunDirection(c.latitude, c.longitude, scene.sun.elevation, scene.sun.azimuth, draw.sun.direction);
  draw.sun.irradiance = scene.atmosphere.solarIrradiance;
  draw.sun.discRadius = scene.sun.discRadius;
  draw.viewport = {{0, 0}, {scene.width, scene.height}};
  return draw;
}

Needs needsOf(const io::Scene& scene) {
  Needs needs;
  needs.projection = projectionOf(scene.camera);
  describeCamera(scene, &needs);
  describeSun(scene, &needs);
  needs.seen = kSeenSky | kSeenGround | kSeenSpace | kSeenSun;
  if (!scene.needs) needs.seen = seenBy(scene.atmosphere, needs.projection, describeDraw(scene));
  if (scene.terrain) needs.seen |= kSeenTerrain;
  needs.sunDiscRadius = scene.sun.discRadius;
  needs.exposureTo = scene.exposure.value_or(0.0);
  needs.occluders = scene.terrain.has_value() && scene.shafts != io::SceneShafts::Off;
  std::copy_n(scene.effects, kEffectCount, needs.effects);
  if (scene.needs) {
    needs.exposureTo = scene.needs->exposure.value_or(0.0);
    needs.error = scene.needs->error;
    needs.budgetBytes = scene.needs->budgetBytes;
    needs.budgetSeconds = scene.needs->budgetSeconds;
  }
  keepTables(scene, &needs);
  return needs;
}

Needs needsOfFlight(const io::Scene& scene) {
  Needs needs;
  needs.projection = projectionOf(scene.camera);
  needs.seen = kSeenSky | kSeenGround | kSeenSpace | kSeenSun;
  if (scene.terrain) needs.seen |= kSeenTerrain;
  needs.sunDiscRadius = std::max(scene.sun.discRadius, 1e-3);
  needs.occluders = scene.terrain.has_value() && scene.shafts != io::SceneShafts::Off;
  std::copy_n(scene.effects, kEffectCount, needs.effects);
  keepTables(scene, &needs);
  return needs;
}

Plan planScene(const io::Scene& scene, const TableDesc& base) {
  return planNeeds(scene, needsOf(scene), base);
}

Plan planNeeds(const io::Scene& scene, const Needs& needs, const TableDesc& base) {
  Plan plan;
  char message[512] = "There is not enough memory for a plan.";
  const Status status = makePlan(scene.atmosphere, needs, base, &plan, message, sizeof message);
  if (status != Status::Ok) throw Failure(message);
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    // keepTables turned it on, not the scene.
    if (needs.effects[i] != Force::On || scene.effects[i] != Force::Auto) continue;
    std::snprintf(plan.effects[i].reason, sizeof plan.effects[i].reason,
                  "The shaders of the scene's terrain or balloons read its tables.");
  }
  return plan;
}

TableDesc tablesOf(const io::Scene& scene) {
  TableDesc desc;
  desc.solver = scene.solver.value_or(Solver::Moments);
  desc.orders = scene.orders.value_or(scene.model == io::SceneModel::Single ? 1 : 0);
  if (const std::optional<Solver> model = io::solverOf(scene.model)) {
    desc.solver = *model;
    desc.sizes.stepCount = scene.modelSamples.value_or(0);
  }
  if (desc.solver == Solver::Moments) desc.quality = scene.quality.value_or(Quality::Default);
  return desc;
}

}  // namespace alpenglow::samples
