#include "scene_plan.h"

#include <alpenglow/io/height_field.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "failure.h"

namespace alpenglow::samples {
namespace {

// The picture's half diagonal, where each ray of an orthographic camera has an observer of its own.
double spread(const io::Scene& scene) {
  const double height = scene.camera.orthographicHeight_m.value_or(0.0);
  return 0.5 * height * std::hypot(1.0, double(scene.width) / double(scene.height));
}

void describeCamera(const io::Scene& scene, PlanRequest* request) {
  const double own = std::max(scene.camera.altitude_m, 0.0), around = spread(scene);
  request->altitudeFrom_m = std::max(own - around, 0.0);
  // 0 would be no limit.
  request->altitudeTo_m = std::max(own + around, 1.0);
  if (!scene.requirements || !scene.requirements->altitude_m[0]) return;
  request->altitudeFrom_m = *scene.requirements->altitude_m[0];
  request->altitudeTo_m = std::max(*scene.requirements->altitude_m[1] + around, 1.0);
}

void describeSun(const io::Scene& scene, PlanRequest* request) {
  const double around = spread(scene) / scene.atmosphere.bottomRadius_m;
  double from = scene.sun.elevation, to = from;
  if (scene.requirements && scene.requirements->sunElevation[0]) {
    from = *scene.requirements->sunElevation[0];
    to = *scene.requirements->sunElevation[1];
  }
  constexpr double kRightAngle = 1.5707963267948966;
  request->sunElevationFrom = std::clamp(from - around, -kRightAngle, kRightAngle);
  request->sunElevationTo = std::clamp(to + around, -kRightAngle, kRightAngle);
  request->sunFixed = request->sunElevationFrom == request->sunElevationTo;
}

// Of a terrain; 0, which is any, where its file can't be read: whoever draws it reports that.
double greatestAltitude(const io::SceneTerrain& terrain) {
  const io::Result<io::HeightMap> map =
      io::readHeightMap(terrain.heightMap, {terrain.metersPerUnit, 0.0});
  if (!map || map->heights_m.empty()) return 0.0;
  const double most = *std::max_element(map->heights_m.begin(), map->heights_m.end());
  return std::max((most - terrain.base_m) * terrain.heightScale, 1.0);
}

// Terrain and balloons are drawn by shaders that read every table.
void keepTables(const io::Scene& scene, PlanRequest* request) {
  if (!scene.terrain && scene.balloons.empty()) return;
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const auto effect = static_cast<Effect>(i);
    if ((kTableEffects & effectBit(effect)) == 0) continue;
    if (request->effects[i] == Force::Off) {
      throw Failure(
          std::string("The scene turns ") + effectName(effect) +
          " off, but its terrain or balloons are drawn with all tables: only scenes without them "
          "can be without it.");
    }
    request->effects[i] = Force::On;
  }
}

}  // namespace

Projection projectionOf(const io::SceneCamera& camera) {
  return camera.orthographicHeight_m ? Projection::Orthographic : camera.projection;
}

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

FrameDesc describeDraw(const io::Scene& scene) {
  const io::SceneCamera& c = scene.camera;
  FrameDesc frame;  // Its world is the planet frame.
  Camera& camera = frame.cameras[0];
  camera = cameraAt(scene.atmosphere, frame.world, c.latitude, c.longitude, c.altitude_m, c.heading,
                    c.pitch, c.roll);
  camera.fov = c.fov;
  camera.height = c.orthographicHeight_m.value_or(0.0);
  camera.viewport = {{0, 0}, {scene.width, scene.height}};
  directionAt(frame.world, c.latitude, c.longitude, scene.sun.elevation, scene.sun.azimuth,
              frame.lights[0].direction);
  frame.lights[0].discRadius = scene.sun.discRadius;
  return frame;
}

PlanRequest requestOf(const io::Scene& scene) {
  PlanRequest request;
  request.view.projection = projectionOf(scene.camera);
  describeCamera(scene, &request);
  describeSun(scene, &request);
  request.visible = kVisibleSky | kVisibleGround | kVisibleSpace | kVisibleSun;
  if (!scene.requirements)
    request.visible = visibleFrom(scene.atmosphere, request.view.projection, describeDraw(scene));
  if (scene.terrain) request.visible |= kVisibleScene;
  request.sunDiscRadius = scene.sun.discRadius;
  request.exposure = scene.exposure.value_or(0.0);
  request.casters = scene.terrain.has_value() && scene.shafts != io::SceneLightShafts::Off;
  if (request.casters && request.sunElevationTo < 0.0)
    request.casterAltitude_m = greatestAltitude(*scene.terrain);
  std::copy_n(scene.effects, kEffectCount, request.effects);
  if (scene.requirements) {
    request.exposure = scene.requirements->exposure.value_or(0.0);
    request.errorTarget = scene.requirements->error;
    request.budgetBytes = scene.requirements->budgetBytes;
    request.budgetSeconds = scene.requirements->budgetSeconds;
  }
  keepTables(scene, &request);
  return request;
}

PlanRequest requestOfFlight(const io::Scene& scene) {
  PlanRequest request;
  request.view.projection = projectionOf(scene.camera);
  request.visible = kVisibleSky | kVisibleGround | kVisibleSpace | kVisibleSun;
  if (scene.terrain) request.visible |= kVisibleScene;
  request.sunDiscRadius = std::max(scene.sun.discRadius, 1e-3);
  request.casters = scene.terrain.has_value() && scene.shafts != io::SceneLightShafts::Off;
  std::copy_n(scene.effects, kEffectCount, request.effects);
  keepTables(scene, &request);
  return request;
}

Plan planScene(const io::Scene& scene, const TableDesc& tables) {
  PlanRequest request = requestOf(scene);
  request.tables = tables;
  return planRequest(scene, request);
}

Plan planRequest(const io::Scene& scene, const PlanRequest& request) {
  Plan plan;
  std::string message;
  const DiagnosticSink sink = {[](void* user, const Diagnostic& diagnostic) {
                                 *static_cast<std::string*>(user) = diagnostic.message;
                               },
                               &message};
  if (makePlan(scene.atmosphere, request, &plan, sink) != Status::Ok) throw Failure(message);
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    // keepTables turned it on, not the scene.
    if (request.effects[i] != Force::On || scene.effects[i] != Force::Auto) continue;
    std::snprintf(plan.choices[i].reason, sizeof plan.choices[i].reason,
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
    desc.sizes.stepCount = scene.modelStepCount.value_or(0);
  }
  if (desc.solver == Solver::Moments) desc.quality = scene.quality.value_or(Quality::Default);
  return desc;
}

}  // namespace alpenglow::samples
