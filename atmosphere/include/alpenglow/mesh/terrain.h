// Terrain: a height field bent over the planet's ground sphere, as a closed triangle mesh. From
// plain arrays into plain arrays that the host allocates; nothing here needs Vulkan.
#pragma once

#include <alpenglow/mesh/adjacency.h>

namespace alpenglow {
inline namespace v1_0 {

/// Heights at the points of a grid, row by row: row 0 is the north edge, column 0 the west edge.
struct HeightField {
  const float* heights = nullptr;  ///< width * height values, metres; read during the call.
  uint32_t width = 0;              ///< Columns, at least 2.
  uint32_t height = 0;             ///< Rows, at least 2.
  double spacing_m[2] = {};        ///< Between neighbours: along a row, and from row to row.
};

/// Where the height field lies, and how it is raised. Angles in radians.
///
/// A point's altitude above the ground sphere is max(0, (height - base_m) * heightScale) times the
/// fade: a surface below the sphere, which the sky pass draws at altitude 0, could not be seen.
/// Flat cells are chords and dip below the sphere by spacing^2 / (8 radius), 0.2 mm for 100 m on
/// the Earth, so draw the terrain over the sphere's pixels and don't let their depths compete.
struct TerrainDesc {
  HeightField field;
  double radius_m = 0.0;     ///< The ground sphere's, Parameters::bottomRadius_m.
  double latitude = 0.0;     ///< Of the field's centre, in [-pi/2, pi/2].
  double longitude = 0.0;    ///< Of the field's centre.
  double heading = 0.0;      ///< Turns the field clockwise about its centre; 0: row 0 faces north.
  double base_m = 0.0;       ///< Subtracted from the heights first.
  double heightScale = 0.0;  ///< Factor on heights above the base; 0 means 1.
  /// Width of a zone along the border where altitudes fall smoothly to 0, so that the field doesn't
  /// stand there as a plateau with cliffs; 0: none. Wider than half the field lowers it all.
  double fade_m = 0.0;
  /// How far below altitude 0 the skirt ends; 0 means 50. Where cells are large it goes deeper:
  /// twice as far as their chords dip, and 1e-5 of the field's half diagonal.
  double skirtDepth_m = 0.0;
};

struct TerrainVertex {
  /// Metres from TerrainPlace::origin_m, axes parallel to the planet's frame.
  float position[3] = {};
  float normal[3] = {};  ///< Unit, outwards.
  /// From 0 to 1 over an image of the field: column c, row r is ((c + 1/2) / width,
  /// (r + 1/2) / height), the middle of its texel in an image of the field's size.
  float uv[2] = {};
};

/// What to allocate.
struct TerrainSize {
  uint32_t vertexCount = 0;
  uint32_t indexCount = 0;
};

/// Where the mesh lies in the planet's frame.
struct TerrainPlace {
  double origin_m[3] = {};     ///< On the ground sphere, at the field's centre.
  Box box;                     ///< Of the field's points, tight, axes along row, column and up.
  double maxAltitude_m = 0.0;  ///< Of the highest point.
};

/// Checks everything but the heights, and says how large the mesh will be.
ALPENGLOW_API Status terrainSize(const TerrainDesc& desc, TerrainSize* out,
                                 const DiagnosticSink& sink);

/// Writes the mesh, and where it lies to `place` (may be null). terrainSize() says how many
/// vertices and indices (plain triangles, counter-clockwise seen from outside). The first width *
/// height vertices are the field's points in its order. A skirt goes down from the border to below
/// the ground sphere, with vertices of its own since its normals look sideways, and a fan closes it
/// below: every edge has two triangles, as shadow volumes need, and buildAdjacency() finds no
/// border.
///
/// A point at (east, north) of the centre, after turning, lies in that direction as far along the
/// sphere as it lies from the centre in the plane (azimuthal equidistant), and its altitude above
/// the sphere, along its own vertical. Computed in double, rounded once. Normals are those of
/// central differences on the bent surface, one-sided at the border.
///
/// InvalidArgument with a sentence to `sink`, nothing written, for null arrays, heights or values
/// that are not finite, fewer than 2x2 points, more than kMaxMeshIndices indices, a spacing that is
/// not above 0 or too small for single precision at this distance from the origin, a field whose
/// half diagonal is beyond 1/4 pi radius_m or that rises higher than radius_m, negative scales and
/// widths, a skirt deeper than half of radius_m. Allocates nothing. Thread-safe.
ALPENGLOW_API Status buildTerrain(const TerrainDesc& desc, TerrainVertex* vertices,
                                  uint32_t* indices, TerrainPlace* place,
                                  const DiagnosticSink& sink);

}  // namespace v1_0
}  // namespace alpenglow
