// Neighbours of triangles by sorting: vertices by place, then half edges by the edge they run
// along.
#include <alpenglow/mesh/adjacency.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <vector>

#include "atmosphere/parameters/sentence.h"

#include "engine/exceptions.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

using parameters::Sentence;

constexpr uint32_t kNone = UINT32_MAX;
constexpr uint32_t kPackedStride = 3 * sizeof(float);

struct Place {
  float x, y, z;
  bool operator==(const Place& other) const { return x == other.x && y == other.y && z == other.z; }
  bool operator<(const Place& other) const {
    if (x != other.x) return x < other.x;
    return y != other.y ? y < other.y : z < other.z;
  }
};

Place placeOf(const MeshView& mesh, uint32_t vertex) {
  const size_t stride = mesh.positionStride == 0 ? kPackedStride : mesh.positionStride;
  Place place;
  std::memcpy(&place, reinterpret_cast<const char*>(mesh.positions) + vertex * stride,
              sizeof(place));
  return place;
}

/// One side of a triangle. Sorted, the sides along one edge stand together, first those that run
/// from its lower to its higher vertex, each way in the order of the triangles.
struct HalfEdge {
  uint64_t edge;    ///< The lower vertex in the high half, the higher one in the low half.
  uint32_t corner;  ///< 3 * triangle + side; the side runs from that corner to the next.
  uint32_t back;    ///< 1: runs from the higher vertex to the lower.

  bool operator<(const HalfEdge& other) const {
    if (edge != other.edge) return edge < other.edge;
    return back != other.back ? back < other.back : corner < other.corner;
  }
};

/// The corner of the same triangle that is not on the side.
uint32_t oppositeCorner(uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

bool checkCounts(const MeshView& mesh, const uint32_t* adjacency, Sentence* why) {
  const bool stride = mesh.positionStride == 0 || mesh.positionStride >= kPackedStride;
  const char* null = mesh.positions == nullptr && mesh.vertexCount > 0 ? "MeshView::positions"
                     : mesh.indices == nullptr && mesh.indexCount > 0  ? "MeshView::indices"
                     : adjacency == nullptr && mesh.indexCount > 0     ? "adjacency"
                                                                       : nullptr;
  if (null != nullptr) {
    *why << null << " is null, but the host's own array is expected.";
  } else if (!stride) {
    *why << "MeshView::positionStride is " << mesh.positionStride
         << ", but it must be 0 or at least " << kPackedStride << " bytes.";
  } else if (mesh.indexCount % 3 != 0) {
    *why << "MeshView::indexCount is " << mesh.indexCount << ", but it must be a multiple of 3.";
  } else if (mesh.indexCount > kMaxMeshIndices) {
    *why << "MeshView::indexCount is " << mesh.indexCount << ", but it must be at most "
         << kMaxMeshIndices << ".";
  } else {
    return true;
  }
  return false;
}

bool checkValues(const MeshView& mesh, Sentence* why) {
  for (uint32_t i = 0; i < mesh.indexCount; ++i) {
    if (mesh.indices[i] >= mesh.vertexCount) {
      *why << "MeshView::indices[" << i << "] is " << mesh.indices[i]
           << ", but it must be below vertexCount, which is " << mesh.vertexCount << ".";
      return false;
    }
  }
  for (uint32_t i = 0; i < mesh.vertexCount; ++i) {
    const Place place = placeOf(mesh, i);
    const float values[] = {place.x, place.y, place.z};
    for (uint32_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(values[axis])) {
        const char* names[] = {"x", "y", "z"};
        *why << "The " << names[axis] << " of vertex " << i << " is " << double{values[axis]}
             << ", but it must be finite.";
        return false;
      }
    }
  }
  return true;
}

/// For each vertex the first one at its place.
std::vector<uint32_t> weld(const MeshView& mesh, AdjacencyReport* report) {
  struct Entry {
    Place place;
    uint32_t vertex;
    bool operator<(const Entry& other) const {
      return place == other.place ? vertex < other.vertex : place < other.place;
    }
  };
  std::vector<Entry> entries(mesh.vertexCount);
  for (uint32_t i = 0; i < mesh.vertexCount; ++i) entries[i] = {placeOf(mesh, i), i};
  std::sort(entries.begin(), entries.end());
  std::vector<uint32_t> first(mesh.vertexCount);
  for (size_t i = 0; i < entries.size(); ++i) {
    const bool same = i > 0 && entries[i].place == entries[i - 1].place;
    first[entries[i].vertex] = same ? first[entries[i - 1].vertex] : entries[i].vertex;
    report->duplicateVertices += same ? 1 : 0;
  }
  return first;
}

std::vector<HalfEdge> halfEdges(const MeshView& mesh, const std::vector<uint32_t>& first,
                                AdjacencyReport* report) {
  std::vector<HalfEdge> edges;
  edges.reserve(mesh.indexCount);
  for (uint32_t at = 0; at < mesh.indexCount; at += 3) {
    const uint32_t v[3] = {first[mesh.indices[at]], first[mesh.indices[at + 1]],
                           first[mesh.indices[at + 2]]};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      ++report->degenerateTriangles;
      continue;
    }
    for (uint32_t side = 0; side < 3; ++side) {
      const uint32_t from = v[side];
      const uint32_t to = v[(side + 1) % 3];
      const uint64_t edge = uint64_t{std::min(from, to)} << 32 | std::max(from, to);
      edges.push_back({edge, at + side, from > to ? 1u : 0u});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// The corner of the half edge across each half edge, which runs the other way; kNone at borders.
std::vector<uint32_t> pairUp(const std::vector<HalfEdge>& edges, uint32_t indexCount,
                             AdjacencyReport* report) {
  std::vector<uint32_t> across(indexCount, kNone);
  for (size_t begin = 0; begin < edges.size();) {
    size_t middle = begin;  // The first that runs back.
    while (middle < edges.size() && edges[middle].edge == edges[begin].edge &&
           edges[middle].back == 0) {
      ++middle;
    }
    size_t end = middle;
    while (end < edges.size() && edges[end].edge == edges[begin].edge) ++end;
    const size_t pairs = std::min(middle - begin, end - middle);
    for (size_t i = 0; i < pairs; ++i) {
      across[edges[begin + i].corner] = edges[middle + i].corner;
      across[edges[middle + i].corner] = edges[begin + i].corner;
    }
    const size_t count = end - begin;
    report->borderEdges += static_cast<uint32_t>(count - 2 * pairs);
    report->nonManifoldEdges += count > 2 ? 1 : 0;
    report->inconsistentEdges += count == 2 && pairs == 0 ? 1 : 0;
    begin = end;
  }
  return across;
}

void writeAdjacency(const MeshView& mesh, const std::vector<uint32_t>& first,
                    const std::vector<uint32_t>& across, uint32_t* adjacency) {
  for (uint32_t at = 0; at < mesh.indexCount; at += 3) {
    const uint32_t* v = mesh.indices + at;
    uint32_t* out = adjacency + size_t{at} * 2;
    if (first[v[0]] == first[v[1]] || first[v[1]] == first[v[2]] || first[v[2]] == first[v[0]]) {
      std::fill_n(out, 6, v[0]);
      continue;
    }
    for (uint32_t side = 0; side < 3; ++side) {
      const uint32_t corner = at + side;
      const uint32_t source = across[corner] == kNone ? corner : across[corner];
      out[2 * side] = v[side];
      out[2 * side + 1] = mesh.indices[oppositeCorner(source)];
    }
  }
}

}  // namespace

Status buildAdjacency(const MeshView& mesh, uint32_t* adjacency, AdjacencyReport* report,
                      const DiagnosticSink& sink) {
  Sentence why;
  if (!checkCounts(mesh, adjacency, &why) || !checkValues(mesh, &why)) {
    return parameters::report(sink, Status::InvalidArgument, why);
  }
  ALPENGLOW_TRY {
    AdjacencyReport found;
    const std::vector<uint32_t> first = weld(mesh, &found);
    const std::vector<HalfEdge> edges = halfEdges(mesh, first, &found);
    const std::vector<uint32_t> across = pairUp(edges, mesh.indexCount, &found);
    writeAdjacency(mesh, first, across, adjacency);
    if (report != nullptr) *report = found;
  }
  ALPENGLOW_CATCH_BAD_ALLOC {  // No exception may reach the host.
    why << "There is no host memory for the neighbours of " << mesh.indexCount / 3 << " triangles.";
    return parameters::report(sink, Status::OutOfHostMemory, why);
  }
  return Status::Ok;
}

}  // namespace v1_0
}  // namespace alpenglow
