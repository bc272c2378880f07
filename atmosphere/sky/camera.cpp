// Cameras and suns from angles, in the planet's frame.
#include "atmosphere/sky/picture.h"

#include <algorithm>
#include <cmath>

namespace alpenglow {
inline namespace v1 {
namespace {

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
  // Below the ground there is no place, and below the centre "up" would turn round.
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

}  // namespace v1
}  // namespace alpenglow
