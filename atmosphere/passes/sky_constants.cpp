// Push constants of a frame's camera and sun, and checks of the host's values.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/camera/projection.h"
#include "atmosphere/passes/sky_pass.h"

namespace alpenglow::passes {
namespace {

constexpr double kPi = std::numbers::pi;

void store(float out[4], const double xyz[3], double scale, double w) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(xyz[i] * scale);
  out[3] = static_cast<float>(w);
}

// The disc is drawn with a linear edge one pixel wide about `chord`: coverage is 1/2 there. Chosen
// so that the drawn power is that of a sharp disc, which is pi (chord^2 + pixel^2 / 12) while the
// edge is a ring; a disc smaller than that becomes a cone of one pixel's radius, dimmed.
struct DrawnDisc {
  double chord, radiance;  ///< 2 sin(radius / 2); per unit irradiance.
};

DrawnDisc drawnDisc(double radius, double pixel) {
  if (radius <= 0.0) return {0.0, 0.0};
  const double chord = 2.0 * std::sin(0.5 * radius);
  const double solidAngle = kPi * chord * chord;
  const double inPixels = chord / pixel;
  if (inPixels * inPixels >= 1.0 / 3.0)
    return {pixel * std::sqrt(inPixels * inPixels - 1.0 / 12.0), 1.0 / solidAngle};
  return {0.5 * pixel, 3.0 / (kPi * pixel * pixel)};  // inPixels^2 / solidAngle: no 0/0.
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

Status checkViewport(const engine::Device& device, const VkRect2D& area) {
  const uint32_t* most = device.limits().maxViewportDimensions;
  if (area.extent.width == 0 || area.extent.height == 0 || area.extent.width > most[0] ||
      area.extent.height > most[1]) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Camera::viewport is %u x %u pixels, but must be from 1 x 1 to %u x %u.",
                       area.extent.width, area.extent.height, most[0], most[1]);
  }
  if (area.offset.x < 0 || area.offset.y < 0 ||
      int64_t{area.offset.x} + area.extent.width > INT32_MAX ||
      int64_t{area.offset.y} + area.extent.height > INT32_MAX) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Camera::viewport begins at pixel (%d, %d), but must begin inside the "
                       "colour attachment.",
                       area.offset.x, area.offset.y);
  }
  return Status::Ok;
}

}  // namespace

Status checkDirection(const engine::Device& device, const char* name, const double direction[3]) {
  return unit(direction) ? Status::Ok : refuse(device, name, direction, "a unit vector");
}

bool drawable(Projection projection, const FrameState& draw) {
  const EyeCamera& c = draw.camera;
  const double r2 = dot(c.position_m, c.position_m);
  const bool fisheye = projection == Projection::Fisheye;
  const bool lens = projection == Projection::Orthographic
                        ? c.height_m > 0.0 && c.height_m < 1e9
                        : c.fov > 0.0 && (fisheye ? c.fov <= 2.0 * kPi + 1e-9 : c.fov < kPi);
  return r2 > 0.0 && r2 < 1e30 && unit(c.forward) && unit(c.up) &&
         std::abs(dot(c.forward, c.up)) < 1e-4 && lens && unit(draw.sun.direction) &&
         draw.viewport.extent.width > 0 && draw.viewport.extent.height > 0;
}

Status checkDraw(const engine::Device& device, Projection projection, const FrameState& draw) {
  const EyeCamera& c = draw.camera;
  const double r2 = dot(c.position_m, c.position_m);
  if (!(r2 > 0.0 && r2 < 1e30)) {
    return refuse(device, "Camera::position", c.position_m,
                  "finite, away from the planet's centre and within 1e15 m of it");
  }
  constexpr double kAbsent[3] = {};
  if (std::equal(kAbsent, kAbsent + 3, c.forward)) {
    return device.fail(
        Status::InvalidArgument, VK_SUCCESS,
        "FrameDesc::cameras[0] is absent, since Camera::forward is (0, 0, 0), but is "
        "required. cameraAt returns this for angles beyond their range: they are in "
        "radians.");
  }
  if (std::equal(kAbsent, kAbsent + 3, draw.sun.direction)) {
    return device.fail(
        Status::InvalidArgument, VK_SUCCESS,
        "FrameDesc::lights[0] is absent, since Light::direction is (0, 0, 0), but is "
        "required. directionAt returns this for angles beyond their range: they are "
        "in radians.");
  }
  Status status = checkDirection(device, "Camera::forward", c.forward);
  if (status == Status::Ok) status = checkDirection(device, "Camera::up", c.up);
  if (status != Status::Ok) return status;
  if (!(std::abs(dot(c.forward, c.up)) < 1e-4))
    return refuse(device, "Camera::up", c.up, "orthogonal to Camera::forward");
  const bool fisheye = projection == Projection::Fisheye;
  const bool parallel = projection == Projection::Orthographic;
  if (parallel && !(c.height_m > 0.0 && c.height_m < 1e9))
    return refuse(device, "Camera::height", c.height_m, "above 0 and below 1e9 metres");
  if (!parallel && !(c.fov > 0.0 && (fisheye ? c.fov <= 2.0 * kPi + 1e-9 : c.fov < kPi))) {
    return refuse(device, "Camera::fov", c.fov,
                  fisheye ? "above 0 and at most 2 pi radians" : "above 0 and below pi radians");
  }
  status = checkDirection(device, "Light::direction", draw.sun.direction);
  if (status != Status::Ok) return status;
  if (!(draw.sun.discRadius >= 0.0 && draw.sun.discRadius < 0.5 * kPi))
    return refuse(device, "Light::discRadius", draw.sun.discRadius,
                  "from 0 to below pi / 2 radians");
  for (uint32_t i = 0; i < kSpectrumSize; ++i)
    if (!(draw.sun.irradiance[i] >= 0.0 && draw.sun.irradiance[i] < 1e30))
      return refuse(device, "LightDesc::irradiance", draw.sun.irradiance[i],
                    "from 0 to below 1e30");
  if (!(draw.radianceScale >= 0.0 && draw.radianceScale < 1e30))
    return refuse(device, "FrameDesc::radianceScale", draw.radianceScale, "from 0 to below 1e30");
  return checkViewport(device, draw.viewport);
}

SkyConstants makeSkyConstants(const Parameters& parameters, const PictureDesc& desc,
                              const FrameState& draw) {
  const EyeCamera& c = draw.camera;
  const ViewportSize v = viewportSize(draw);
  const PictureEdges edges = pictureEdges(desc.projection, draw);
  const double pixel = pixelAngle(desc, draw);
  const double texel =
      kPi * parameters.bottomRadius_m / std::max(1.0, double(desc.groundAlbedo.extent.height));
  const bool parallel = desc.projection == Projection::Orthographic;
  const DrawnDisc disc = drawnDisc(parallel ? 0.0 : draw.sun.discRadius, pixel);
  const double scale = draw.radianceScale == 0.0 ? 1.0 : draw.radianceScale;

  SkyConstants k = {};
  store(k.upAltitude, c.position_m, 1.0 / cameraRadius(c), cameraAltitude(parameters, c));
  store(k.forwardPixel, c.forward, 1.0, pixel);
  store(k.rightHalfAngle, edges.right, 1.0, 0.5 * c.fov);
  store(k.downMapTexel, edges.down, 1.0, texel);
  store(k.sunDiscChord, draw.sun.direction, 1.0, disc.chord);
  store(k.irradianceDisc, draw.sun.irradiance.value, scale, disc.radiance);
  const physics_f64::SkyViewParams skyView =
      skyViewParams(parameters, cameraAltitude(parameters, c));
  k.circleSkyView[0] = static_cast<float>(v.width / v.least);
  k.circleSkyView[1] = static_cast<float>(v.height / v.least);
  k.circleSkyView[2] = static_cast<float>(skyView.horizon);
  k.circleSkyView[3] = static_cast<float>(skyView.span);
  double azimuth[3];
  sunAzimuth(draw, azimuth);
  store(k.sunAzimuth, azimuth, 1.0, skyView.bend);
  return k;
}

Status checkDepthRange(const engine::Device& device, Projection projection,
                       const DepthRange& range) {
  const bool parallel = projection == Projection::Orthographic;
  const double n = range.near_m, f = range.far_m;
  const bool good = parallel ? std::abs(n) < 1e12 && f > n && f < 1e12
                             : n > 0.0 && n < 1e12 && (f == 0.0 || (f > n && f < 1e15));
  if (good) return Status::Ok;
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "Camera::nearPlane is %g and farPlane %g, but the depth must run from %s.", n,
                     f,
                     parallel ? "one distance below 1e12 m to a greater one"
                              : "a distance above 0 to a greater one, or to 0 for infinitely far");
}

AerialPerspectiveConstants makeAerialPerspectiveConstants(const Parameters& parameters,
                                                          const PictureDesc& desc,
                                                          const FrameState& draw) {
  const EyeCamera& c = draw.camera;
  const PictureEdges edges = pictureEdges(desc.projection, draw);
  const DepthScale depth = depthScale(desc.projection, desc.depth, draw.depth);
  const AerialPerspectiveLookup lookup = aerialPerspectiveLookup(parameters, draw);
  const physics_f64::SkyViewParams& skyView = lookup.view.skyView;
  const double views[3] = {skyView.horizon, skyView.span, skyView.bend};
  AerialPerspectiveConstants k = {};
  store(k.upAltitude, lookup.up, 1.0, cameraAltitude(parameters, c));
  store(k.forwardA, c.forward, 1.0, depth.a);
  store(k.rightB, edges.right, 1.0, depth.b);
  store(k.downExtinction, edges.down, 1.0, lookup.view.extinction_);
  store(k.sunHeight, draw.sun.direction, 1.0, lookup.view.height);
  store(k.irradiance, draw.sun.irradiance.value,
        draw.radianceScale == 0.0 ? 1.0 : draw.radianceScale, 0.0);
  store(k.skyView, views, 1.0, lookup.view.startHeight);
  store(k.sunAzimuth, lookup.sunAzimuth, 1.0, 0.0);
  return k;
}

}  // namespace alpenglow::passes
