// Triangle meshes from plain arrays: the neighbours that shadow volumes need. Nothing here needs
// Vulkan; all memory is the host's.
#pragma once

#include <alpenglow/types.h>

namespace alpenglow {
inline namespace v1_0 {

/// Triangles over the host's own vertices, which are read where they lie.
struct MeshView {
  const float* positions = nullptr;   ///< x of the first vertex; y and z follow it.
  uint32_t positionStride = 0;        ///< Bytes from a vertex to the next; 0: 12, packed.
  uint32_t vertexCount = 0;           ///< Vertices that no triangle uses must be finite, too.
  const uint32_t* indices = nullptr;  ///< Three a triangle.
  uint32_t indexCount = 0;            ///< A multiple of 3, at most kMaxMeshIndices.
};

/// Most indices of a mesh: with adjacency there are twice as many, and a draw counts in 32 bits.
inline constexpr uint32_t kMaxMeshIndices = 0x7FFFFFFEu;

/// What was found on the way. A mesh is closed when `borderEdges` is 0.
struct AdjacencyReport {
  uint32_t borderEdges = 0;          ///< Edges of triangles, written without a neighbour.
  uint32_t nonManifoldEdges = 0;     ///< Edges that more than two triangles share.
  uint32_t inconsistentEdges = 0;    ///< Edges of two triangles that run along it the same way.
  uint32_t degenerateTriangles = 0;  ///< Triangles with two corners at one place.
  uint32_t duplicateVertices = 0;    ///< Vertices at the place of an earlier one.
};

/// Writes six indices a triangle, 2 * indexCount in all, in the order of
/// VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST_WITH_ADJACENCY: v0, a01, v1, a12, v2, a20, where aij is the
/// third corner of the neighbour across the edge from vi to vj. Triangles keep their order, v0 to
/// v2 their indices.
///
/// - Vertices at the same place (-0 is 0) count as one, so that seams of normals or texture
///   coordinates have neighbours. Places are compared exactly.
/// - Neighbours run along their edge in opposite directions, as two triangles of one winding do.
///   Two that run the same way are none.
/// - A border: aij is the triangle's own opposite corner (a01 = v2), of equal index. The one
///   neighbour that looks like this is the triangle's own back, with the same three corners; it
///   faces away when the triangle doesn't, so that the edge is a silhouette either way.
/// - Where more than two triangles share an edge, the first that runs one way is paired with the
///   first that runs the other way, in the order of the triangles, and so on; the rest are borders.
///   Volumes that sum over silhouettes come out the same for any pairing.
/// - A triangle with two corners at one place is no neighbour of any, and is written as six times
///   v0, which draws nothing. One whose corners lie on a line, at three places, is kept: it may
///   close a gap.
///
/// `adjacency` must not overlap the input; `report` may be null. InvalidArgument for a null array,
/// a stride below 12, a count that is no multiple of 3 or too large, an index beyond the vertices
/// and a position that is not finite, OutOfHostMemory where some 70 bytes a triangle can't be had;
/// a sentence goes to `sink`, and nothing is written then. Takes O(n log n). Thread-safe.
ALPENGLOW_API Status buildAdjacency(const MeshView& mesh, uint32_t* adjacency,
                                    AdjacencyReport* report, const DiagnosticSink& sink);

}  // namespace v1_0
}  // namespace alpenglow
