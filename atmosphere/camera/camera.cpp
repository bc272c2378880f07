// Cameras and sun directions from angles, and from and to matrices.
#include <alpenglow/camera.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "atmosphere/camera/projection.h"
#include "atmosphere/camera/world.h"
#include "atmosphere/parameters/sentence.h"

namespace alpenglow {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Frame {
  double up[3], north[3], east[3];
};

Frame localFrame(double latitude, double longitude) {
  const double sinLat = std::sin(latitude), cosLat = std::cos(latitude);
  const double sinLon = std::sin(longitude), cosLon = std::cos(longitude);
  return {{cosLat * cosLon, cosLat * sinLon, sinLat},
          {-sinLat * cosLon, -sinLat * sinLon, cosLat},
          {-sinLon, cosLon, 0.0}};
}

}  // namespace

EyeCamera cameraFromGeodetic(const Parameters& parameters, double latitude, double longitude,
                             double altitude_m, double heading, double pitch, double roll,
                             double fov) {
  const Frame f = localFrame(latitude, longitude);
  EyeCamera camera;
  camera.fov = fov;
  // Altitudes below the ground count as 0: beyond the planet's centre "up" would be reversed.
  const double r = parameters.bottomRadius_m + std::max(altitude_m, 0.0);
  for (int i = 0; i < 3; ++i) {
    const double ahead = std::cos(heading) * f.north[i] + std::sin(heading) * f.east[i];
    const double right = -std::sin(heading) * f.north[i] + std::cos(heading) * f.east[i];
    const double forward = std::cos(pitch) * ahead + std::sin(pitch) * f.up[i];
    const double above = std::cos(pitch) * f.up[i] - std::sin(pitch) * ahead;
    camera.position_m[i] = r * f.up[i];
    camera.forward[i] = forward;
    camera.up[i] = std::cos(roll) * above + std::sin(roll) * right;
  }
  return camera;
}

void sunDirection(double latitude, double longitude, double elevation, double azimuth,
                  double direction[3]) {
  const Frame f = localFrame(latitude, longitude);
  for (int i = 0; i < 3; ++i) {
    const double ahead = std::cos(azimuth) * f.north[i] + std::sin(azimuth) * f.east[i];
    direction[i] = std::cos(elevation) * ahead + std::sin(elevation) * f.up[i];
  }
}

namespace {

/// Of latitudes and elevations: within rounding of a right angle either way.
bool isLatitude(double value) { return std::abs(value) <= 0.5 * kPi + 1e-9; }

bool areFinite(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

Status checkPlace(double latitude, double longitude, double altitude_m,
                  const DiagnosticSink& sink) {
  using parameters::report;
  using parameters::Sentence;
  if (!isLatitude(latitude)) {
    return report(
        sink, Status::InvalidArgument,
        Sentence() << "placeWorld got a latitude of " << latitude
                   << ", but angles are in radians and a latitude is from -pi/2 to pi/2.");
  }
  if (!areFinite({longitude, altitude_m})) {
    return report(sink, Status::InvalidArgument,
                  Sentence() << "placeWorld got a longitude of " << longitude
                             << " and an altitude of " << altitude_m
                             << " m, but both must be finite.");
  }
  return Status::Ok;
}

}  // namespace

inline namespace v1_0 {

Status placeWorld(const Parameters& planet, double latitude, double longitude, double altitude_m,
                  WorldAxes axes, World* world, const DiagnosticSink& sink) {
  if (world == nullptr) return parameters::reportNull(sink, "placeWorld", "world");
  const Status status = checkPlace(latitude, longitude, altitude_m, sink);
  if (status != Status::Ok) return status;
  const Frame f = localFrame(latitude, longitude);
  const double r = planet.bottomRadius_m + altitude_m;
  for (int i = 0; i < 3; ++i) world->origin_m[i] = r * f.up[i];
  for (int i = 0; i < 3; ++i) {
    const double e = f.east[i], n = f.north[i], u = f.up[i];
    double x = i == 0, y = i == 1, z = i == 2;
    switch (axes) {
      case WorldAxes::EarthCentered:
        break;
      case WorldAxes::ZUp:
        x = e, y = n, z = u;
        break;
      case WorldAxes::YUp:
        x = e, y = u, z = -n;
        break;
      case WorldAxes::ZUpLeftHanded:
        x = n, y = e, z = u;
        break;
      case WorldAxes::YUpLeftHanded:
        x = e, y = u, z = n;
        break;
    }
    world->axes[0][i] = x;
    world->axes[1][i] = y;
    world->axes[2][i] = z;
  }
  return Status::Ok;
}

Camera cameraAt(const Parameters& planet, const World& world, double latitude, double longitude,
                double altitude_m, double heading, double pitch, double roll) {
  Camera camera;
  if (!isLatitude(latitude) || !areFinite({longitude, altitude_m, heading, pitch, roll}))
    return camera;
  const EyeCamera eye =
      cameraFromGeodetic(planet, latitude, longitude, altitude_m, heading, pitch, roll, 0.0);
  const passes::Placement placement(world);
  placement.toWorld(eye.position_m, camera.position);
  placement.directionToWorld(eye.forward, camera.forward);
  placement.directionToWorld(eye.up, camera.up);
  return camera;
}

void directionAt(const World& world, double latitude, double longitude, double elevation,
                 double azimuth, double direction[3]) {
  std::fill_n(direction, 3, 0.0);
  if (!isLatitude(latitude) || !isLatitude(elevation) || !areFinite({longitude, azimuth})) return;
  double planet[3];
  sunDirection(latitude, longitude, elevation, azimuth, planet);
  passes::Placement(world).directionToWorld(planet, direction);
}

Status clipFromCamera(Projection projection, DepthConvention depth, const Camera& camera,
                      float matrix[16]) {
  const VkExtent2D& size = camera.viewport.extent;
  if (matrix == nullptr || projection == Projection::Fisheye || size.width == 0 || size.height == 0)
    return Status::InvalidArgument;
  FrameState state;
  std::copy_n(camera.forward, 3, state.camera.forward);
  std::copy_n(camera.up, 3, state.camera.up);
  state.camera.fov = camera.fov != 0.0 ? camera.fov : kPi / 3.0;
  state.camera.height_m = camera.height;
  state.viewport = camera.viewport;
  state.depth = {camera.nearPlane, camera.farPlane};
  double m[16];
  passes::clipFromCamera(projection, depth, state, m);
  for (int i = 0; i < 16; ++i) matrix[i] = static_cast<float>(m[i]);
  return Status::Ok;
}

}  // namespace v1_0
}  // namespace alpenglow
