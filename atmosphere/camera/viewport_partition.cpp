#include "atmosphere/camera/viewport_partition.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alpenglow::passes {
namespace {

constexpr double kPi = std::numbers::pi;
/// Pixels on a side below which cutting gains nothing.
constexpr uint32_t kLeastTile = 32;

double angleBetween(const double a[3], const double b[3]) {
  const double cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                           a[0] * b[1] - a[1] * b[0]};
  return std::atan2(std::sqrt(dot(cross, cross)), dot(a, b));
}

/// Directions within an angle of an axis, which need not be a unit vector.
struct Cone {
  double axis[3];
  double half;
};

/// Direction through a point of the viewport; x and y in pixels from its centre, right and up.
void direction(const PictureDesc& desc, const FrameState& draw, double x, double y, double out[3]) {
  const EyeCamera& c = draw.camera;
  const std::array<double, 3> right = cameraRight(c);
  const double pixel = pixelAngle(desc, draw);
  double ahead = 1.0, scale = pixel;
  if (desc.projection == Projection::Fisheye) {
    const double radius = std::hypot(x, y), theta = radius * pixel;
    ahead = std::cos(theta);
    scale = radius > 0.0 ? std::sin(theta) / radius : pixel;
  }
  for (size_t i = 0; i < 3; ++i)
    out[i] = ahead * c.forward[i] + scale * (x * right[i] + y * c.up[i]);
}

/// A cone around all directions of an area.
Cone coneOf(const PictureDesc& desc, const FrameState& draw, const VkRect2D& area) {
  const ViewportSize size = viewportSize(draw);
  const double x0 = area.offset.x - 0.5 * size.width, x1 = x0 + area.extent.width;
  const double y1 = 0.5 * size.height - area.offset.y, y0 = y1 - area.extent.height;
  Cone cone;
  direction(desc, draw, 0.5 * (x0 + x1), 0.5 * (y0 + y1), cone.axis);
  if (desc.projection == Projection::Fisheye) {
    // Angles between directions are at most distances in the picture.
    cone.half = 0.5 * std::hypot(x1 - x0, y1 - y0) * pixelAngle(desc, draw);
    if (cone.half > 0.5 * draw.camera.fov) {
      std::copy_n(draw.camera.forward, 3, cone.axis);
      cone.half = 0.5 * draw.camera.fov;
    }
    return cone;
  }
  // What a cone of less than a right angle cuts out of a plane is convex: the corners are farthest.
  cone.half = 0.0;
  for (const double x : {x0, x1}) {
    for (const double y : {y0, y1}) {
      double corner[3];
      direction(desc, draw, x, y, corner);
      cone.half = std::max(cone.half, angleBetween(cone.axis, corner));
    }
  }
  if (cone.half > 1.57) cone.half = kPi;
  return cone;
}

VkRect2D tileOf(const VkExtent2D& whole, uint32_t columns, uint32_t rows, uint32_t i, uint32_t j) {
  const auto edge = [](uint32_t k, uint32_t n, uint32_t size) {
    return static_cast<uint32_t>(uint64_t{k} * size / n);
  };
  const uint32_t x = edge(i, columns, whole.width), y = edge(j, rows, whole.height);
  return {{static_cast<int32_t>(x), static_cast<int32_t>(y)},
          {edge(i + 1, columns, whole.width) - x, edge(j + 1, rows, whole.height) - y}};
}

/// Appends a part to the row that starts at `row`: merged with the last part if it shows the same.
void addTile(ViewportPartition* to, uint32_t row, const Part& tile) {
  if (to->count > row && to->parts[to->count - 1].visible == tile.visible) {
    to->parts[to->count - 1].area.extent.width += tile.area.extent.width;
  } else {
    to->parts[to->count++] = tile;
  }
}

/// Joins the parts from `row` on with those from `above` on if they are divided at the same
/// columns.
bool joinRow(ViewportPartition* parts, uint32_t above, uint32_t row) {
  Part* const upper = &parts->parts[above];
  Part* const lower = &parts->parts[row];
  const auto same = [](const Part& a, const Part& b) {
    return a.area.offset.x == b.area.offset.x && a.area.extent.width == b.area.extent.width &&
           a.visible == b.visible;
  };
  if (!std::equal(upper, lower, lower, lower + (parts->count - row), same)) return false;
  for (Part* p = upper; p != lower; ++p) p->area.extent.height += lower->area.extent.height;
  parts->count = row;
  return true;
}

}  // namespace

std::array<double, 3> cameraRight(const EyeCamera& camera) {
  const double *f = camera.forward, *u = camera.up;
  return {f[1] * u[2] - f[2] * u[1], f[2] * u[0] - f[0] * u[2], f[0] * u[1] - f[1] * u[0]};
}

ViewportSize viewportSize(const FrameState& draw) {
  const double width = draw.viewport.extent.width, height = draw.viewport.extent.height;
  return {width, height, std::min(width, height)};
}

double pixelAngle(const PictureDesc& desc, const FrameState& draw) {
  const ViewportSize size = viewportSize(draw);
  if (desc.projection == Projection::Fisheye) return draw.camera.fov / size.least;
  if (desc.projection == Projection::Orthographic) return draw.camera.height_m / size.height;
  return 2.0 * std::tan(0.5 * draw.camera.fov) / size.height;
}

Visible visible(const Parameters& parameters, const PictureDesc& desc, const FrameState& draw,
                const VkRect2D& area) {
  // Radians: rounding on the GPU, and the disc's soft edge (drawnDisc), which a chord makes longer.
  const double margin = 0.005;
  const double edge = 2.0 * pixelAngle(desc, draw);
  const Cone cone = coneOf(desc, draw, area);
  const double* position = draw.camera.position_m;
  const double r = cameraRadius(draw.camera);
  const double down[3] = {-position[0], -position[1], -position[2]};
  const double toNadir = angleBetween(cone.axis, down) - cone.half - margin;
  const double toSun = angleBetween(cone.axis, draw.sun.direction) - cone.half - margin;
  Visible result;
  result.atmosphere =
      r <= parameters.topRadius_m || toNadir < std::asin(parameters.topRadius_m / r);
  result.ground = toNadir < std::asin(std::min(1.0, parameters.bottomRadius_m / r));
  result.disc = draw.sun.discRadius > 0.0 && toSun < draw.sun.discRadius + edge;
  return result;
}

ViewportPartition cut(const Parameters& parameters, const PictureDesc& desc,
                      const FrameState& draw) {
  const VkExtent2D& whole = draw.viewport.extent;
  if (desc.projection == Projection::Orthographic) {
    ViewportPartition one;
    one.parts[0] = {{{0, 0}, whole}, {true, true, false}};
    one.count = 1;
    return one;
  }
  const uint32_t columns = std::clamp(whole.width / kLeastTile, 1u, ViewportPartition::kSide);
  const uint32_t rows = std::clamp(whole.height / kLeastTile, 1u, ViewportPartition::kSide);
  ViewportPartition result;
  uint32_t above = 0;  // first part of the row above
  for (uint32_t j = 0; j < rows; ++j) {
    const uint32_t row = result.count;
    for (uint32_t i = 0; i < columns; ++i) {
      const VkRect2D tile = tileOf(whole, columns, rows, i, j);
      addTile(&result, row, {tile, visible(parameters, desc, draw, tile)});
    }
    if (row == 0 || !joinRow(&result, above, row)) above = row;
  }
  return result;
}

}  // namespace alpenglow::passes
