#include "atmosphere/passes/light_shaft_frame.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/camera/projection.h"
#include "atmosphere/camera/viewport_partition.h"
#include "atmosphere/passes/aerial_perspective_lut.h"

namespace alpenglow::passes {
namespace {

using passes::dot;

void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

void store(float out[4], const double xyz[3], double scale, double w) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(xyz[i] * scale);
  out[3] = static_cast<float>(w);
}

/// Half of a box's width along an axis.
double halfWidth(const PlanetBox& box, const double axis[3]) {
  double sum = 0.0;
  for (const auto& half : box.halfAxes_m) sum += std::abs(dot(half, axis));
  return sum;
}

/// A row that gives dot(axis, origin + rotation p - from) * scale + shift of a local p.
void row(const double axis[3], const double from[3], const double origin[3],
         const float rotation[9], double scale, double shift, float out[4]) {
  const double offset[3] = {origin[0] - from[0], origin[1] - from[1], origin[2] - from[2]};
  for (size_t j = 0; j < 3; ++j) {
    double sum = axis[j];
    if (rotation != nullptr) {
      sum = 0.0;
      for (size_t i = 0; i < 3; ++i) sum += axis[i] * double(rotation[3 * i + j]);
    }
    out[j] = static_cast<float>(sum * scale);
  }
  out[3] = static_cast<float>(dot(axis, offset) * scale + shift);
}

}  // namespace

ShadowMapPlace placeShadowMap(const PlanetBox& bounds, const double sun[3], uint32_t texels) {
  ShadowMapPlace map;
  std::copy_n(bounds.center_m, 3, map.center);
  std::copy_n(sun, 3, map.sun);
  // Rows along the horizon: seen from a low sun the box is wide and low.
  const double radius = std::sqrt(dot(bounds.center_m, bounds.center_m));
  double up[3] = {bounds.center_m[0] / radius, bounds.center_m[1] / radius,
                  bounds.center_m[2] / radius};
  if (std::abs(dot(up, sun)) > 0.999) {
    // Overhead: rows along the box's first axis that lies across the beam.
    double widest = -1.0;
    for (const auto& half : bounds.halfAxes_m) {
      const double length = std::sqrt(dot(half, half)), along = std::abs(dot(half, sun));
      const double across = length > 0.0 ? length - along : 0.0;
      if (across <= widest) continue;
      widest = across;
      for (int i = 0; i < 3; ++i) up[i] = length > 0.0 ? half[i] / length : up[i];
    }
    if (std::abs(dot(up, sun)) > 0.999) {
      up[0] = std::abs(sun[0]) < 0.7 ? 1.0 : 0.0;
      up[1] = 1.0 - up[0];
      up[2] = 0.0;
    }
  }
  cross(up, sun, map.u);
  const double length = std::sqrt(dot(map.u, map.u));
  for (double& x : map.u) x /= length;
  cross(map.sun, map.u, map.v);
  const double margin = double(texels) / (double(texels) - 4.0);
  map.halfU = std::max(halfWidth(bounds, map.u), 1e-3) * margin;
  map.halfV = std::max(halfWidth(bounds, map.v), 1e-3) * margin;
  map.halfDepth = std::max(halfWidth(bounds, map.sun), 1e-3) * 1.001;
  return map;
}

void rowsFromEye(const double eye[3], const double origin[3], const float rotation[9],
                 float rows[3][4]) {
  for (size_t i = 0; i < 3; ++i) {
    double axis[3] = {};
    axis[i] = 1.0;
    row(axis, eye, origin, rotation, 1.0, 0.0, rows[i]);
  }
}

void rowsOnMap(const ShadowMapPlace& map, const double origin[3], const float rotation[9],
               float rows[3][4]) {
  row(map.u, map.center, origin, rotation, 1.0 / map.halfU, 0.0, rows[0]);
  row(map.v, map.center, origin, rotation, 1.0 / map.halfV, 0.0, rows[1]);
  row(map.sun, map.center, origin, rotation, -0.5 / map.halfDepth, 0.5, rows[2]);
}

void clipFromMap(const ShadowMapPlace& map, double matrix[16]) {
  std::fill_n(matrix, 16, 0.0);
  for (int i = 0; i < 3; ++i) {
    matrix[4 * i] = map.u[i] / map.halfU;
    matrix[4 * i + 1] = map.v[i] / map.halfV;
    matrix[4 * i + 2] = -0.5 * map.sun[i] / map.halfDepth;
  }
  matrix[14] = 0.5;
  matrix[15] = 1.0;
}

// A point sees the sun before the terminator's plane, or beside the planet's shadow, a cylinder
// (with a soft sun a cone) about the axis. Both are the most at a corner: the distance from the
// axis is convex.
bool sunReaches(const Parameters& parameters, const PlanetBox& bounds, const double sun[3]) {
  const double narrowing = std::tan(parameters.sunAngularRadius);
  for (int corner = 0; corner < 8; ++corner) {
    double p[3], across[3];
    for (int i = 0; i < 3; ++i) {
      p[i] = bounds.center_m[i];
      for (int axis = 0; axis < 3; ++axis)
        p[i] += ((corner >> axis & 1) != 0 ? 1.0 : -1.0) * bounds.halfAxes_m[axis][i];
    }
    const double along = dot(p, sun);
    cross(p, sun, across);
    const double shadow = parameters.bottomRadius_m + along * narrowing;
    if (along >= 0.0 || std::sqrt(dot(across, across)) > shadow) return true;
  }
  return false;
}

LightShaftFrame makeLightShaftFrame(const Parameters& parameters, const LightShaftSettings& desc,
                                    const ShadowMapPlace& map, const FrameState& draw, bool lit) {
  const EyeCamera& camera = draw.camera;
  const double r = passes::cameraRadius(camera);
  const double rg = parameters.bottomRadius_m, rt = parameters.topRadius_m;
  const passes::PictureEdges edges = passes::pictureEdges(desc.projection, draw);
  LightShaftFrame frame = {};
  double matrix[16];
  passes::clipFromCamera(desc.projection, desc.depth, draw, matrix);
  std::transform(matrix, matrix + 16, frame.clipFromCamera,
                 [](double x) { return static_cast<float>(x); });
  store(frame.upAltitude, camera.position_m, 1.0 / r, passes::cameraAltitude(parameters, camera));
  store(frame.forwardNear, camera.forward, 1.0, draw.depth.near_m);
  store(frame.rightOffsetX, edges.right, 1.0, draw.viewport.offset.x);
  store(frame.downOffsetY, edges.down, 1.0, draw.viewport.offset.y);
  store(frame.sunRange, draw.sun.direction, 1.0, 2.0 * map.halfDepth);

  const double half = 0.5 * desc.shadowMapSize;
  const double fromCenter[3] = {camera.position_m[0] - map.center[0],
                                camera.position_m[1] - map.center[1],
                                camera.position_m[2] - map.center[2]};
  const auto onMap = [&](float out[4], const double axis[3], double scale, double shift) {
    store(out, axis, scale, dot(axis, fromCenter) * scale + shift);
  };
  onMap(frame.mapU, map.u, half / map.halfU, half);
  onMap(frame.mapV, map.v, half / map.halfV, half);
  onMap(frame.mapDepth, map.sun, -0.5 / map.halfDepth, 0.5);

  // From one side of the atmosphere to the other, past the ground.
  const double longest = 2.0 * std::sqrt((rt - rg) * (rt + rg)) + 4.0 * map.halfDepth;
  const double size[3] = {double(desc.shadowMapSize), longest, r};
  store(frame.map, size, 1.0, meshStep(desc));
  double corner[3];
  for (int i = 0; i < 3; ++i) {
    corner[i] =
        map.sun[i] * map.halfDepth - map.u[i] * map.halfU - map.v[i] * map.halfV - fromCenter[i];
  }
  store(frame.cornerStep, corner, 1.0, map.halfU / half);
  store(frame.rowStep, map.u, 1.0, map.halfV / half);
  store(frame.columnStep, map.v, 1.0, 0.0);
  frame.pixels[0] = 2.0f / static_cast<float>(draw.viewport.extent.width);
  frame.pixels[1] = 2.0f / static_cast<float>(draw.viewport.extent.height);
  frame.pixels[2] = lit ? static_cast<float>(methodIndex(desc.method)) : kNoShadow;
  frame.pixels[3] = desc.projection == Projection::Orthographic ? 1.0f : 0.0f;

  const passes::AerialPerspectiveLookup lookup = passes::aerialPerspectiveLookup(parameters, draw);
  const double skyView[3] = {lookup.view.skyView.horizon, lookup.view.skyView.span,
                             lookup.view.skyView.bend};
  store(frame.aerialSkyView, skyView, 1.0, lookup.view.extinction_);
  store(frame.aerialSun, lookup.sunAzimuth, 1.0, lookup.view.startHeight);
  frame.aerialHeight[0] = static_cast<float>(lookup.view.height);
  // A quarter of a cell's width along the beam hides the light-volume mesh under lit slopes.
  frame.aerialHeight[1] =
      static_cast<float>(0.25 * std::max(map.halfU, map.halfV) / half * meshStep(desc));
  return frame;
}

}  // namespace alpenglow::passes
