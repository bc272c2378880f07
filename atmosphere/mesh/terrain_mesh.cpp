// A height field on the sphere, with its skirt and its bottom.
#include <alpenglow/mesh/terrain.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "atmosphere/parameters/limits.h"
#include "atmosphere/parameters/sentence.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

using parameters::Sentence;

constexpr double kDefaultDepth_m = 50.0;
constexpr double kMaxAngle = std::numbers::pi / 4.0;  // From the centre to a corner.
// A float's last digit, relative; positions are distinguished with 8 of them between neighbours.
constexpr double kResolution = 8.0 * FLT_EPSILON / 2.0;

using Vector = glm::dvec3;

double halfDiagonal(const HeightField& field) {
  return 0.5 * std::hypot((field.width - 1) * field.spacing_m[0],
                          (field.height - 1) * field.spacing_m[1]);
}

double skirtDepth(const TerrainDesc& desc) {
  const double wanted = desc.skirtDepth_m == 0.0 ? kDefaultDepth_m : desc.skirtDepth_m;
  const double cell = std::hypot(desc.field.spacing_m[0], desc.field.spacing_m[1]);
  const double sine = std::sin(0.25 * cell / desc.radius_m);
  const double dip = 2.0 * desc.radius_m * sine * sine;  // Of a chord across a cell.
  return std::max({wanted, 2.0 * dip, 1e-5 * halfDiagonal(desc.field)});
}

/// The field's points in the planet's frame, relative to the origin at its centre on the sphere.
class Surface {
 public:
  explicit Surface(const TerrainDesc& desc) : desc_(desc) {
    const double sinLat = std::sin(desc.latitude), cosLat = std::cos(desc.latitude);
    const double sinLon = std::sin(desc.longitude), cosLon = std::cos(desc.longitude);
    const Vector north = {-sinLat * cosLon, -sinLat * sinLon, cosLat};
    const Vector east = {-sinLon, cosLon, 0.0};
    const double sinHead = std::sin(desc.heading), cosHead = std::cos(desc.heading);
    up_ = {cosLat * cosLon, cosLat * sinLon, sinLat};
    along_ = cosHead * east - sinHead * north;
    ahead_ = cosHead * north + sinHead * east;
    scale_ = desc.heightScale == 0.0 ? 1.0 : desc.heightScale;
    halfWidth_ = 0.5 * (desc.field.width - 1) * desc.field.spacing_m[0];
    halfHeight_ = 0.5 * (desc.field.height - 1) * desc.field.spacing_m[1];
  }

  Vector up() const { return up_; }        ///< At the centre.
  Vector along() const { return along_; }  ///< From west to east along a row.
  Vector ahead() const { return ahead_; }  ///< From south to north along a column.

  double altitude(uint32_t column, uint32_t row) const {
    const double height = desc_.field.heights[size_t{row} * desc_.field.width + column];
    const double raised = std::max(0.0, (height - desc_.base_m) * scale_);
    return raised * fade(halfWidth_ - std::abs(alongOf(column))) *
           fade(halfHeight_ - std::abs(aheadOf(row)));
  }
  Vector point(uint32_t column, uint32_t row) const {
    return at(column, row, altitude(column, row));
  }
  Vector at(uint32_t column, uint32_t row, double altitude_m) const {
    const double x = alongOf(column), y = aheadOf(row);
    const double distance = std::sqrt(x * x + y * y);
    const double halfAngle = 0.5 * distance / desc_.radius_m;
    const double sine = std::sin(halfAngle);
    const double radius = desc_.radius_m + altitude_m;
    // The radius times the sine and, below, the cosine of the whole angle, without cancellation.
    const double outwards = distance > 0.0 ? 2.0 * radius * sine * std::cos(halfAngle) / distance
                                           : radius / desc_.radius_m;
    return outwards * (x * along_ + y * ahead_) + (altitude_m - 2.0 * radius * sine * sine) * up_;
  }
  Vector normal(uint32_t column, uint32_t row) const {
    const uint32_t east = std::min(column + 1, desc_.field.width - 1);
    const uint32_t south = std::min(row + 1, desc_.field.height - 1);
    const Vector across = point(east, row) - point(column == 0 ? 0 : column - 1, row);
    const Vector northwards = point(column, row == 0 ? 0 : row - 1) - point(column, south);
    return glm::normalize(glm::cross(across, northwards));
  }

 private:
  // Exact at the far edge, where the fade must be 0.
  double alongOf(uint32_t column) const {
    return (column - 0.5 * (desc_.field.width - 1)) * desc_.field.spacing_m[0];
  }
  double aheadOf(uint32_t row) const {
    return (0.5 * (desc_.field.height - 1) - row) * desc_.field.spacing_m[1];
  }
  double fade(double distance) const {
    if (!(desc_.fade_m > 0.0)) return 1.0;
    const double t = std::clamp(distance / desc_.fade_m, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
  }

  const TerrainDesc& desc_;
  Vector up_, along_, ahead_;
  double scale_, halfWidth_, halfHeight_;
};

/// The field's border, counter-clockwise seen from above, from the north-west corner southwards.
struct Border {
  uint32_t width, height;

  explicit Border(const HeightField& field) : width(field.width), height(field.height) {}
  uint32_t count() const { return 2 * (width - 1) + 2 * (height - 1); }
  void at(uint32_t i, uint32_t* column, uint32_t* row) const {
    const uint32_t right = width - 1, down = height - 1;
    if (i < down) {
      *column = 0, *row = i;
    } else if (i < down + right) {
      *column = i - down, *row = down;
    } else if (i < 2 * down + right) {
      *column = right, *row = 2 * down + right - i;
    } else {
      *column = 2 * (down + right) - i, *row = 0;
    }
  }
};

uint64_t indexCountOf(const HeightField& field) {
  const uint64_t right = field.width - 1, down = field.height - 1;
  return 6 * right * down + 9 * (2 * right + 2 * down);
}

bool inRange(const char* name, double value, double low, double high, Sentence* why) {
  if (value >= low && value <= high) return true;
  *why << "TerrainDesc::" << name << " is " << value << ", but it must be a number from " << low
       << " to " << high << ".";
  return false;
}

bool checkField(const HeightField& field, Sentence* why) {
  if (field.width < 2 || field.height < 2) {
    *why << "The height field has " << field.width << "x" << field.height
         << " points, but it must have at least 2x2.";
    return false;
  }
  // The product of larger counts could leave 64 bits.
  const bool large = field.width > kMaxMeshIndices / 6 || field.height > kMaxMeshIndices / 6;
  if (large || indexCountOf(field) > kMaxMeshIndices) {
    *why << "The height field has " << field.width << "x" << field.height
         << " points, but its mesh must have at most " << kMaxMeshIndices << " indices.";
    return false;
  }
  for (uint32_t i = 0; i < 2; ++i) {
    if (!(field.spacing_m[i] > 0.0 && field.spacing_m[i] <= parameters::kMaxRadius_m)) {
      *why << "HeightField::spacing_m[" << i << "] is " << field.spacing_m[i]
           << ", but it must be above 0 and at most " << parameters::kMaxRadius_m << " metres.";
      return false;
    }
  }
  return true;
}

bool checkPlace(const TerrainDesc& desc, Sentence* why) {
  constexpr double kHuge = DBL_MAX;
  constexpr double kHalfPi = std::numbers::pi / 2.0;
  const double longest = parameters::kMaxRadius_m;
  if (!inRange("radius_m", desc.radius_m, parameters::kMinRadius_m, parameters::kMaxRadius_m,
               why) ||
      !inRange("latitude", desc.latitude, -kHalfPi, kHalfPi, why) ||
      !inRange("longitude", desc.longitude, -kHuge, kHuge, why) ||
      !inRange("heading", desc.heading, -kHuge, kHuge, why) ||
      !inRange("base_m", desc.base_m, -longest, longest, why) ||
      !inRange("heightScale", desc.heightScale, 0.0, longest, why) ||
      !inRange("fade_m", desc.fade_m, 0.0, longest, why) ||
      !inRange("skirtDepth_m", desc.skirtDepth_m, 0.0, 0.5 * desc.radius_m, why)) {
    return false;
  }
  const double diagonal = halfDiagonal(desc.field);
  if (diagonal > kMaxAngle * desc.radius_m) {
    *why << "The height field reaches " << diagonal << " metres from its centre, but it must be at "
         << "most " << kMaxAngle * desc.radius_m << " metres, an eighth of the way round.";
    return false;
  }
  return true;
}

bool checkArrays(const TerrainDesc& desc, const TerrainVertex* vertices, const uint32_t* indices,
                 Sentence* why) {
  const char* null = desc.field.heights == nullptr ? "HeightField::heights"
                     : vertices == nullptr         ? "vertices"
                     : indices == nullptr          ? "indices"
                                                   : nullptr;
  if (null == nullptr) return true;
  *why << null << " is null, but the host's own array is expected.";
  return false;
}

/// Checks the heights and whether neighbours stay apart as floats.
bool checkHeights(const TerrainDesc& desc, double* maxAltitude_m, Sentence* why) {
  const HeightField& field = desc.field;
  const Surface surface(desc);
  *maxAltitude_m = 0.0;
  for (uint32_t row = 0; row < field.height; ++row) {
    for (uint32_t column = 0; column < field.width; ++column) {
      const double height = field.heights[size_t{row} * field.width + column];
      const double altitude = surface.altitude(column, row);
      if (!std::isfinite(height) || !(altitude <= desc.radius_m)) {
        *why << "The height at column " << column << ", row " << row << " is " << height
             << ", but it must be finite, and its altitude at most the planet's radius, "
             << desc.radius_m << " metres.";
        return false;
      }
      *maxAltitude_m = std::max(*maxAltitude_m, altitude);
    }
  }
  const double reach = halfDiagonal(field) + std::max(*maxAltitude_m, skirtDepth(desc));
  for (uint32_t i = 0; i < 2; ++i) {
    if (!(field.spacing_m[i] >= kResolution * reach)) {
      *why << "HeightField::spacing_m[" << i << "] is " << field.spacing_m[i]
           << ", but it must be at least " << kResolution * reach
           << " metres, what single precision resolves at " << reach
           << " metres from the field's centre.";
      return false;
    }
  }
  return true;
}

bool checkDesc(const TerrainDesc& desc, Sentence* why) {
  return checkField(desc.field, why) && checkPlace(desc, why);
}

TerrainVertex vertexOf(const HeightField& field, uint32_t column, uint32_t row, Vector position,
                       Vector normal) {
  const auto rounded = [](double value) { return static_cast<float>(value); };
  return {{rounded(position.x), rounded(position.y), rounded(position.z)},
          {rounded(normal.x), rounded(normal.y), rounded(normal.z)},
          {rounded((column + 0.5) / field.width), rounded((row + 0.5) / field.height)}};
}

/// Least and most of what is added, along three axes.
class Extent {
 public:
  Extent(Vector x, Vector y, Vector z) : axes_{x, y, z} {}
  void add(const TerrainVertex& vertex) {
    const Vector position = {vertex.position[0], vertex.position[1], vertex.position[2]};
    for (int i = 0; i < 3; ++i) {
      const double value = glm::dot(position, axes_[i]);
      least_[i] = std::min(least_[i], value);
      most_[i] = std::max(most_[i], value);
    }
  }
  Box box(Vector origin) const {
    Box box;
    Vector center = origin;
    for (int i = 0; i < 3; ++i) {
      center = center + 0.5 * (least_[i] + most_[i]) * axes_[i];
      box.halfExtents[i] = 0.5 * (most_[i] - least_[i]);
      for (int k = 0; k < 3; ++k) box.axes[i][k] = axes_[i][k];
    }
    for (int k = 0; k < 3; ++k) box.center[k] = center[k];
    return box;
  }

 private:
  Vector axes_[3];
  double least_[3] = {DBL_MAX, DBL_MAX, DBL_MAX};
  double most_[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
};

void writeTop(const Surface& surface, const HeightField& field, TerrainVertex* vertices,
              uint32_t* indices, Extent* extent) {
  for (uint32_t row = 0; row < field.height; ++row) {
    for (uint32_t column = 0; column < field.width; ++column) {
      *vertices =
          vertexOf(field, column, row, surface.point(column, row), surface.normal(column, row));
      extent->add(*vertices++);
      if (row + 1 == field.height || column + 1 == field.width) continue;
      const uint32_t nw = row * field.width + column, ne = nw + 1;
      const uint32_t sw = nw + field.width, se = sw + 1;
      for (const uint32_t index : {nw, sw, se, nw, se, ne}) *indices++ = index;
    }
  }
}

/// Which way the skirt faces at a point of the border: diagonally at corners.
Vector sideways(const Surface& surface, const HeightField& field, uint32_t column, uint32_t row) {
  const double x = column == 0 ? -1.0 : column + 1 == field.width ? 1.0 : 0.0;
  const double y = row == 0 ? 1.0 : row + 1 == field.height ? -1.0 : 0.0;
  return glm::normalize(x * surface.along() + y * surface.ahead());
}

void writeSkirt(const Surface& surface, const TerrainDesc& desc, TerrainVertex* vertices,
                uint32_t* indices) {
  const HeightField& field = desc.field;
  const Border border(field);
  const double depth = skirtDepth(desc);
  const uint32_t first = field.width * field.height;
  const uint32_t center = first + 2 * border.count();
  for (uint32_t i = 0; i < border.count(); ++i) {
    uint32_t column = 0, row = 0;
    border.at(i, &column, &row);
    const Vector normal = sideways(surface, field, column, row);
    *vertices++ = vertexOf(field, column, row, surface.point(column, row), normal);
    *vertices++ = vertexOf(field, column, row, surface.at(column, row, -depth), normal);
    const uint32_t top = first + 2 * i, bottom = top + 1;
    const uint32_t nextTop = i + 1 == border.count() ? first : top + 2, nextBottom = nextTop + 1;
    for (const uint32_t index :
         {top, bottom, nextBottom, top, nextBottom, nextTop, center, nextBottom, bottom}) {
      *indices++ = index;
    }
  }
  // All chords of the sphere that the skirt ends on lie inside it, and so below the ground.
  TerrainVertex middle = vertexOf(field, 0, 0, -depth * surface.up(), -1.0 * surface.up());
  middle.uv[0] = middle.uv[1] = 0.5f;
  *vertices = middle;
}

}  // namespace

Status terrainSize(const TerrainDesc& desc, TerrainSize* out, const DiagnosticSink& sink) {
  if (out == nullptr) return parameters::reportNull(sink, "terrainSize", "the size");
  Sentence why;
  if (!checkDesc(desc, &why)) {
    return parameters::report(sink, Status::InvalidArgument, why);
  }
  const HeightField& field = desc.field;
  out->vertexCount = field.width * field.height + 2 * Border(field).count() + 1;
  out->indexCount = static_cast<uint32_t>(indexCountOf(field));
  return Status::Ok;
}

Status buildTerrain(const TerrainDesc& desc, TerrainVertex* vertices, uint32_t* indices,
                    TerrainPlace* place, const DiagnosticSink& sink) {
  Sentence why;
  double maxAltitude_m = 0.0;
  if (!checkDesc(desc, &why) || !checkArrays(desc, vertices, indices, &why) ||
      !checkHeights(desc, &maxAltitude_m, &why)) {
    return parameters::report(sink, Status::InvalidArgument, why);
  }
  const HeightField& field = desc.field;
  const Surface surface(desc);
  Extent extent(surface.along(), surface.ahead(), surface.up());
  const size_t points = size_t{field.width} * field.height;
  writeTop(surface, field, vertices, indices, &extent);
  writeSkirt(surface, desc, vertices + points,
             indices + size_t{6} * (field.width - 1) * (field.height - 1));
  const Vector origin = desc.radius_m * surface.up();
  if (place == nullptr) return Status::Ok;
  for (int k = 0; k < 3; ++k) place->origin_m[k] = origin[k];
  place->box = extent.box(origin);
  place->maxAltitude_m = maxAltitude_m;
  return Status::Ok;
}

}  // namespace v1_0
}  // namespace alpenglow
