// What a frame's camera and sun become on the GPU, and the checks of what the host gave.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/sky/sky_pass.h"

namespace alpenglow::sky {
namespace {

constexpr double kPi = std::numbers::pi;

double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double angleBetween(const double a[3], const double b[3]) {
  const double cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                           a[0] * b[1] - a[1] * b[0]};
  return std::atan2(std::sqrt(dot(cross, cross)), dot(a, b));
}

void store(float out[4], const double xyz[3], double scale, double w) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(xyz[i] * scale);
  out[3] = static_cast<float>(w);
}

struct Viewport {
  double width, height, least;
};

Viewport viewportOf(const SkyDraw& draw) {
  const double width = draw.viewport.extent.width, height = draw.viewport.extent.height;
  return {width, height, std::min(width, height)};
}

bool unit(const double v[3]) { return std::abs(dot(v, v) - 1.0) < 1e-4; }  // false for NaN too

Status refuse(const engine::Device& device, const char* field, const double v[3],
              const char* expected) {
  return device.fail(Status::InvalidArgument, VK_SUCCESS, "%s is (%g, %g, %g), but must be %s.",
                     field, v[0], v[1], v[2], expected);
}

Status refuse(const engine::Device& device, const char* field, double value, const char* expected) {
  return device.fail(Status::InvalidArgument, VK_SUCCESS, "%s is %g, but must be %s.", field, value,
                     expected);
}

}  // namespace

Status checkDraw(const engine::Device& device, const ViewDesc& desc, const SkyDraw& draw) {
  const Camera& c = draw.camera;
  const double r2 = dot(c.position_m, c.position_m);
  if (!(r2 > 0.0 && r2 < 1e30)) {
    return refuse(device, "Camera::position_m", c.position_m,
                  "finite, away from the planet's centre and within 1e15 m of it");
  }
  if (!unit(c.forward)) return refuse(device, "Camera::forward", c.forward, "a unit vector");
  if (!unit(c.up)) return refuse(device, "Camera::up", c.up, "a unit vector");
  if (!(std::abs(dot(c.forward, c.up)) < 1e-4))
    return refuse(device, "Camera::up", c.up, "orthogonal to Camera::forward");
  const bool fisheye = desc.projection == Projection::Fisheye;
  if (!(c.fov > 0.0 && (fisheye ? c.fov <= 2.0 * kPi + 1e-9 : c.fov < kPi))) {
    return refuse(device, "Camera::fov", c.fov,
                  fisheye ? "above 0 and at most 2 pi radians" : "above 0 and below pi radians");
  }
  if (!unit(draw.sun.direction))
    return refuse(device, "Sun::direction", draw.sun.direction, "a unit vector");
  if (!(draw.sun.discRadius >= 0.0 && draw.sun.discRadius < 0.5 * kPi))
    return refuse(device, "Sun::discRadius", draw.sun.discRadius, "from 0 to below pi / 2 radians");
  for (uint32_t i = 0; i < kSpectrumSize; ++i)
    if (!(draw.sun.irradiance[i] >= 0.0 && draw.sun.irradiance[i] < 1e30))
      return refuse(device, "Sun::irradiance", draw.sun.irradiance[i], "from 0 to below 1e30");
  if (!(draw.radianceScale >= 0.0 && draw.radianceScale < 1e30))
    return refuse(device, "SkyDraw::radianceScale", draw.radianceScale, "from 0 to below 1e30");
  if (draw.viewport.extent.width == 0 || draw.viewport.extent.height == 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "SkyDraw::viewport is %u x %u pixels, but must be at least 1 x 1.",
                       draw.viewport.extent.width, draw.viewport.extent.height);
  }
  return Status::Ok;
}

Visible visible(const Parameters& parameters, const ViewDesc& desc, const SkyDraw& draw) {
  const Camera& c = draw.camera;
  const Viewport v = viewportOf(draw);
  const double tangent = std::tan(0.5 * c.fov);
  const double halfDiagonal = desc.projection == Projection::Fisheye
                                  ? 0.5 * c.fov
                                  : std::atan(tangent * std::hypot(v.width / v.height, 1.0));
  const double margin = 0.005;  // radians: rounding on the GPU, and the pixel's own width
  const double r = std::sqrt(dot(c.position_m, c.position_m));
  const double down[3] = {-c.position_m[0] / r, -c.position_m[1] / r, -c.position_m[2] / r};
  const double planet = std::asin(std::min(1.0, parameters.bottomRadius_m / r));
  Visible result;
  result.ground = angleBetween(c.forward, down) < planet + halfDiagonal + margin;
  result.disc = draw.sun.discRadius > 0.0 && angleBetween(c.forward, draw.sun.direction) <
                                                 draw.sun.discRadius + halfDiagonal + margin;
  return result;
}

SkyConstants makeConstants(const Parameters& parameters, const ViewDesc& desc,
                           const SkyDraw& draw) {
  const Camera& c = draw.camera;
  const Viewport v = viewportOf(draw);
  const bool fisheye = desc.projection == Projection::Fisheye;
  const double r = std::sqrt(dot(c.position_m, c.position_m));
  // The one subtraction that loses digits, taken in double: see shaders/glsl/physics/geometry.glsl.
  const double altitude = std::max(r - parameters.bottomRadius_m, 0.0);
  const double right[3] = {c.forward[1] * c.up[2] - c.forward[2] * c.up[1],
                           c.forward[2] * c.up[0] - c.forward[0] * c.up[2],
                           c.forward[0] * c.up[1] - c.forward[1] * c.up[0]};
  const double tangent = fisheye ? 1.0 : std::tan(0.5 * c.fov);
  const double pixel = fisheye ? c.fov / v.least : 2.0 * tangent / v.height;
  const double texel =
      kPi * parameters.bottomRadius_m / std::max(1.0, double(desc.groundAlbedo.height));
  const double sine = std::sin(0.5 * draw.sun.discRadius);
  const double solidAngle = 4.0 * kPi * sine * sine;
  const double scale = draw.radianceScale == 0.0 ? 1.0 : draw.radianceScale;

  SkyConstants k = {};
  store(k.upAltitude, c.position_m, 1.0 / r, altitude);
  store(k.forwardPixel, c.forward, 1.0, pixel);
  store(k.rightHalfAngle, right, fisheye ? 1.0 : tangent * v.width / v.height, 0.5 * c.fov);
  store(k.downMapTexel, c.up, -tangent, texel);
  store(k.sunDiscChord, draw.sun.direction, 1.0, 2.0 * sine);
  store(k.irradianceDisc, draw.sun.irradiance.value, scale,
        solidAngle > 0.0 ? 1.0 / solidAngle : 0.0);
  k.circleScale[0] = static_cast<float>(v.width / v.least);
  k.circleScale[1] = static_cast<float>(v.height / v.least);
  return k;
}

}  // namespace alpenglow::sky
