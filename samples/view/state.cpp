#include "state.h"

#include <alpenglow/camera.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alpenglow::view {
namespace {

using std::numbers::pi;

constexpr double kMostPitch = 0.4999 * pi;
constexpr double kMostAltitude_m = 1e9;

double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double wrapped(double angle) { return angle - 2.0 * pi * std::floor(angle / (2.0 * pi)); }

struct Local {
  double east[3], north[3], up[3];
};

Local localAt(double latitude, double longitude) {
  const double cl = std::cos(latitude), sl = std::sin(latitude);
  const double co = std::cos(longitude), so = std::sin(longitude);
  return {{-so, co, 0.0}, {-sl * co, -sl * so, cl}, {cl * co, cl * so, sl}};
}

// Elevation and azimuth of a direction of the planet's frame.
void anglesOf(const double direction[3], const Local& local, double* elevation, double* azimuth) {
  *elevation = std::asin(std::clamp(dot(direction, local.up), -1.0, 1.0));
  *azimuth = wrapped(std::atan2(dot(direction, local.east), dot(direction, local.north)));
}

}  // namespace

double cameraSpeed(const io::Scene& scene) {
  return std::max(scene.camera.altitude_m, 0.0) * 0.8 + 20.0;
}

void moveCamera(io::Scene* scene, const double metres[3]) {
  io::SceneCamera& c = scene->camera;
  const double radius_m = scene->atmosphere.bottomRadius_m;
  const Camera camera = cameraAt(scene->atmosphere, {}, c.latitude, c.longitude, c.altitude_m,
                                 c.heading, c.pitch, 0.0);
  double sun[3];
  directionAt({}, c.latitude, c.longitude, scene->sun.elevation, scene->sun.azimuth, sun);
  const double* f = camera.forward;
  const double* u = camera.up;
  const double right[3] = {f[1] * u[2] - f[2] * u[1], f[2] * u[0] - f[0] * u[2],
                           f[0] * u[1] - f[1] * u[0]};
  double p[3];
  for (int i = 0; i < 3; ++i) {
    p[i] = camera.position[i] + metres[0] * f[i] + metres[1] * right[i] + metres[2] * u[i];
  }
  const double r = std::sqrt(dot(p, p));
  if (!(r > 0.0)) return;
  c.altitude_m = std::clamp(r - radius_m, 2.0, kMostAltitude_m);
  c.latitude = std::asin(std::clamp(p[2] / r, -1.0, 1.0));
  c.longitude = std::atan2(p[1], p[0]);
  const Local local = localAt(c.latitude, c.longitude);
  anglesOf(f, local, &c.pitch, &c.heading);
  c.pitch = std::clamp(c.pitch, -kMostPitch, kMostPitch);
  anglesOf(sun, local, &scene->sun.elevation, &scene->sun.azimuth);
}

// The hour angle counts from the meridian, westwards.
void setTimeOfDay(io::Scene* scene, double hours, double declination) {
  const double hour = (hours - 12.0) * (pi / 12.0);
  const Local local = localAt(scene->camera.latitude, 0.0);
  const double direction[3] = {std::cos(declination) * std::cos(hour),
                               -std::cos(declination) * std::sin(hour), std::sin(declination)};
  // The sky of the night turns with the sun's hour angle, in the same time.
  const double before = timeOfDay(*scene);
  if (scene->stars) scene->stars->siderealHours += hours - before;
  anglesOf(direction, local, &scene->sun.elevation, &scene->sun.azimuth);
}

double timeOfDay(const io::Scene& scene) {
  double d[3];
  directionAt({}, scene.camera.latitude, 0.0, scene.sun.elevation, scene.sun.azimuth, d);
  return wrapped(std::atan2(-d[1], d[0]) + pi) * (12.0 / pi);
}

double declination(const io::Scene& scene) {
  double d[3];
  directionAt({}, scene.camera.latitude, 0.0, scene.sun.elevation, scene.sun.azimuth, d);
  return std::asin(std::clamp(d[2], -1.0, 1.0));
}

}  // namespace alpenglow::view
