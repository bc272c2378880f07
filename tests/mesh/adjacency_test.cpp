#include <alpenglow/mesh/adjacency.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <map>
#include <new>
#include <random>

#include "tests/mesh/meshes.h"
#include "tests/passes/light_shafts/refusal.h"

namespace {
// How many calls of operator new from now on succeed; below 0: all.
std::atomic<int> newCallsLeft{-1};
}  // namespace

void* operator new(std::size_t size) {
  const bool refused = newCallsLeft.load() == 0;
  if (newCallsLeft.load() > 0) --newCallsLeft;
  void* const memory = refused ? nullptr : std::malloc(size != 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace alpenglow::testing {
namespace {

constexpr uint32_t kUntouched = 0xABCDABCDu;

struct Neighbours {
  std::vector<uint32_t> indices;  ///< Six a triangle.
  AdjacencyReport report;
};

Neighbours neighboursOf(const MeshView& view) {
  Neighbours result;
  result.indices.assign(size_t{view.indexCount} * 2, kUntouched);
  Refusal refusal;
  EXPECT_EQ(buildAdjacency(view, result.indices.data(), &result.report, {&Refusal::take, &refusal}),
            Status::Ok)
      << refusal.sentence;
  return result;
}

Neighbours neighboursOf(const Mesh& mesh) { return neighboursOf(mesh.view()); }

bool isBorder(const Neighbours& neighbours, size_t triangle, size_t side) {
  const uint32_t* six = neighbours.indices.data() + 6 * triangle;
  return six[2 * side + 1] == six[(2 * side + 4) % 6];
}

// Triangles keep their corners, and each aij is the third corner of the one other triangle that
// runs from j to i, places compared; a border where there is none. For manifold meshes.
void expectCorrect(const Mesh& mesh, const Neighbours& neighbours) {
  std::map<std::pair<Point, Point>, Point> third;
  const auto at = [&](size_t corner) { return mesh.points[mesh.indices[corner]]; };
  const auto next = [](size_t corner) { return corner / 3 * 3 + (corner + 1) % 3; };
  for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
    third[{at(corner), at(next(corner))}] = at(next(next(corner)));
  }
  for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
    ASSERT_EQ(neighbours.indices[2 * corner], mesh.indices[corner]);
    const auto found = third.find({at(next(corner)), at(corner)});
    const Point expected = found == third.end() ? at(next(next(corner))) : found->second;
    ASSERT_EQ(mesh.points[neighbours.indices[2 * corner + 1]], expected) << corner;
  }
}

void expectClosed(const Mesh& mesh) {
  const Neighbours neighbours = neighboursOf(mesh);
  expectCorrect(mesh, neighbours);
  EXPECT_EQ(neighbours.report.borderEdges, 0u);
  EXPECT_EQ(neighbours.report.nonManifoldEdges, 0u);
  EXPECT_EQ(neighbours.report.inconsistentEdges, 0u);
  EXPECT_EQ(neighbours.report.degenerateTriangles, 0u);
}

// A sphere-like closed surface: an icosahedron whose triangles are split in four `levels` times,
// with radii moved at random, and vertices and triangles in random order.
Mesh boulder(uint32_t levels, uint32_t seed) {
  const float g = 1.618034f;
  Mesh mesh = {{{-1, g, 0},
                {1, g, 0},
                {-1, -g, 0},
                {1, -g, 0},
                {0, -1, g},
                {0, 1, g},
                {0, -1, -g},
                {0, 1, -g},
                {g, 0, -1},
                {g, 0, 1},
                {-g, 0, -1},
                {-g, 0, 1}},
               {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1}};
  for (uint32_t level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), 0);
      if (isNew) {
        entry->second = static_cast<uint32_t>(mesh.points.size());
        Point p = {};
        for (size_t i = 0; i < 3; ++i) p[i] = 0.5f * (mesh.points[a][i] + mesh.points[b][i]);
        mesh.points.push_back(p);
      }
      return entry->second;
    };
    std::vector<uint32_t> finer;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      const uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const uint32_t index : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca})
        finer.push_back(index);
    }
    mesh.indices = finer;
  }
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> radius(0.8f, 1.2f);
  for (Point& p : mesh.points) {
    const float factor = radius(random) / std::hypot(p[0], p[1], p[2]);
    for (float& value : p) value *= factor;
  }
  std::vector<uint32_t> order(mesh.points.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = static_cast<uint32_t>(i);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<Point> points(order.size());
  for (size_t i = 0; i < order.size(); ++i) points[order[i]] = mesh.points[i];
  mesh.points = points;
  for (uint32_t& index : mesh.indices) index = order[index];
  std::vector<std::array<uint32_t, 3>> triangles(mesh.indices.size() / 3);
  std::memcpy(triangles.data(), mesh.indices.data(), mesh.indices.size() * sizeof(uint32_t));
  std::shuffle(triangles.begin(), triangles.end(), random);
  std::memcpy(mesh.indices.data(), triangles.data(), mesh.indices.size() * sizeof(uint32_t));
  return mesh;
}

TEST(Adjacency, OfATetrahedronIsKnown) {
  const Neighbours neighbours = neighboursOf(tetrahedron());
  const std::vector<uint32_t> expected = {0, 3, 2, 3, 1, 3, 0, 2, 1, 2, 3, 2,
                                          1, 0, 2, 0, 3, 0, 0, 1, 3, 1, 2, 1};
  EXPECT_EQ(neighbours.indices, expected);
  EXPECT_EQ(neighbours.report.borderEdges, 0u);
  EXPECT_EQ(neighbours.report.duplicateVertices, 0u);
}

TEST(Adjacency, OfACubeIsClosed) { expectClosed(cube()); }

TEST(Adjacency, OfRandomClosedMeshesIsRightBothWays) {
  for (uint32_t seed = 0; seed < 12; ++seed) {
    expectClosed(boulder(seed % 4, seed));
    expectClosed(exploded(boulder(seed % 4, seed)));
  }
}

TEST(Adjacency, AnOpenSheetHasBordersThatNameTheTrianglesOwnCorner) {
  const Mesh sheet = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3}};
  const Neighbours neighbours = neighboursOf(sheet);
  const std::vector<uint32_t> expected = {0, 2, 1, 0, 2, 3, 0, 1, 2, 0, 3, 2};
  EXPECT_EQ(neighbours.indices, expected);
  EXPECT_EQ(neighbours.report.borderEdges, 4u);
  EXPECT_TRUE(isBorder(neighbours, 0, 0));
  EXPECT_FALSE(isBorder(neighbours, 0, 2));
  expectCorrect(sheet, neighbours);
}

TEST(Adjacency, VerticesAtOnePlaceCountAsOne) {
  const Mesh mesh = exploded(cube());
  const Neighbours neighbours = neighboursOf(mesh);
  EXPECT_EQ(neighbours.report.duplicateVertices, 36u - 8u);
  EXPECT_EQ(neighbours.report.borderEdges, 0u);
  // Neighbours are named by their own vertices: those of the triangle that holds the corner.
  const std::vector<uint32_t>& six = neighbours.indices;
  EXPECT_EQ(six[5], 5u);  // The side's other triangle is vertices 3 to 5.
}

TEST(Adjacency, MinusZeroIsZero) {
  Mesh mesh = exploded(tetrahedron());
  for (size_t i = 0; i < mesh.points.size(); i += 2) {
    for (float& value : mesh.points[i]) value = value == 0.0f ? -0.0f : value;
  }
  EXPECT_EQ(neighboursOf(mesh).report.borderEdges, 0u);
  EXPECT_EQ(neighboursOf(mesh).report.duplicateVertices, 8u);
}

TEST(Adjacency, ReadsPositionsInsideLargerVertices) {
  struct Vertex {
    char other[5];
    char position[12];
    char more[6];
  };
  const Mesh mesh = cube();
  std::vector<Vertex> vertices(mesh.points.size());
  for (size_t i = 0; i < vertices.size(); ++i) {
    std::memset(&vertices[i], 0xFF, sizeof(Vertex));  // NaN, where a float is read from it.
    std::memcpy(vertices[i].position, mesh.points[i].data(), sizeof(Point));
  }
  MeshView view = mesh.view();
  const void* first = vertices[0].position;
  view.positions = static_cast<const float*>(first);
  view.positionStride = sizeof(Vertex);
  EXPECT_EQ(neighboursOf(view).indices, neighboursOf(mesh).indices);
}

// Three sheets that meet in the edge from 0 to 1: a wall of two, and a fin.
TEST(Adjacency, WhereThreeTrianglesMeetTwoOppositeOnesArePaired) {
  Mesh fin = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
              {0, 1, 2, 1, 0, 3, 0, 1, 4}};
  Neighbours neighbours = neighboursOf(fin);
  EXPECT_EQ(neighbours.report.nonManifoldEdges, 1u);
  EXPECT_EQ(neighbours.report.borderEdges, 7u);
  EXPECT_EQ(neighbours.indices[1], 3u);
  EXPECT_EQ(neighbours.indices[7], 2u);
  EXPECT_TRUE(isBorder(neighbours, 2, 0));
  fin.indices.insert(fin.indices.end(), {1, 0, 2});  // A fourth, with which the third pairs.
  neighbours = neighboursOf(fin);
  EXPECT_EQ(neighbours.report.nonManifoldEdges, 1u);
  EXPECT_EQ(neighbours.indices[1], 3u);
  EXPECT_EQ(neighbours.indices[13], 2u);
  EXPECT_EQ(neighbours.indices[19], 4u);
}

TEST(Adjacency, TrianglesThatRunTheSameWayAreNoNeighbours) {
  const Mesh mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {0, 1, 2, 0, 1, 3}};
  const Neighbours neighbours = neighboursOf(mesh);
  EXPECT_EQ(neighbours.report.inconsistentEdges, 1u);
  EXPECT_EQ(neighbours.report.nonManifoldEdges, 0u);
  EXPECT_EQ(neighbours.report.borderEdges, 6u);
}

// A band of quads joined with half a turn can't be wound consistently: one joint stays open.
TEST(Adjacency, AMoebiusBandIsOpenAtItsJoint) {
  constexpr uint32_t kQuads = 12;
  Mesh band;
  for (uint32_t i = 0; i < kQuads; ++i) {
    const float turn = 6.2831853f * static_cast<float>(i) / kQuads;
    for (const float side : {-0.3f, 0.3f}) {
      const float radius = 1.0f + side * std::cos(0.5f * turn);
      band.points.push_back(
          {radius * std::cos(turn), radius * std::sin(turn), side * std::sin(0.5f * turn)});
    }
  }
  for (uint32_t i = 0; i < kQuads; ++i) {
    const bool last = i + 1 == kQuads;
    const uint32_t a = 2 * i, b = 2 * i + 1, c = last ? 1 : a + 2, d = last ? 0 : b + 2;
    band.indices.insert(band.indices.end(), {a, b, d, a, d, c});
  }
  const Neighbours neighbours = neighboursOf(band);
  EXPECT_EQ(neighbours.report.inconsistentEdges, 1u);
  EXPECT_EQ(neighbours.report.borderEdges, 2 * kQuads + 2);
}

TEST(Adjacency, DegenerateTrianglesDrawNothing) {
  Mesh mesh = cube();
  const Neighbours plain = neighboursOf(mesh);
  mesh.points.push_back(mesh.points[3]);
  const std::vector<uint32_t> slivers = {0, 1, 1, 3, 8, 0, 2, 2, 2};
  mesh.indices.insert(mesh.indices.begin(), slivers.begin(), slivers.end());
  const Neighbours neighbours = neighboursOf(mesh);
  EXPECT_EQ(neighbours.report.degenerateTriangles, 3u);
  EXPECT_EQ(neighbours.report.borderEdges, 0u);
  for (size_t i = 0; i < 18; ++i) EXPECT_EQ(neighbours.indices[i], slivers[i / 6 * 3]);
  EXPECT_TRUE(
      std::equal(plain.indices.begin(), plain.indices.end(), neighbours.indices.begin() + 18));
}

// A T-joint that is closed by a triangle without area, as tools write them.
TEST(Adjacency, TrianglesOnALineAreKept) {
  const Mesh mesh = {{{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0, 0}, {1, -2, 0}},
                     {0, 1, 2, 0, 3, 1, 3, 0, 4, 1, 3, 4}};
  const Neighbours neighbours = neighboursOf(mesh);
  EXPECT_EQ(neighbours.report.degenerateTriangles, 0u);
  EXPECT_EQ(neighbours.report.borderEdges, 4u);
  expectCorrect(mesh, neighbours);
}

TEST(Adjacency, ATriangleAndItsBackReadAsBorders) {
  const Mesh mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 1}};
  const Neighbours neighbours = neighboursOf(mesh);
  EXPECT_EQ(neighbours.report.borderEdges, 0u);
  for (size_t side = 0; side < 3; ++side) EXPECT_TRUE(isBorder(neighbours, 0, side));
}

TEST(Adjacency, OfNothingIsNothing) {
  const Neighbours neighbours = neighboursOf(MeshView{});
  EXPECT_EQ(neighbours.report.borderEdges, 0u);
}

void expectRefused(const MeshView& view, Status expected,
                   std::initializer_list<const char*> words) {
  std::vector<uint32_t> six(64, kUntouched);
  AdjacencyReport report;
  report.borderEdges = 77;
  Refusal refusal;
  const Status status = buildAdjacency(view, six.data(), &report, {&Refusal::take, &refusal});
  refusal.expect(status, expected, words);
  EXPECT_EQ(report.borderEdges, 77u);
  EXPECT_EQ(std::count(six.begin(), six.end(), kUntouched), 64);
  EXPECT_EQ(buildAdjacency(view, six.data(), nullptr, {}), expected);
}

TEST(Adjacency, RefusesBadInputWithItsValue) {
  Mesh mesh = tetrahedron();
  MeshView view = mesh.view();
  view.indexCount = 11;
  expectRefused(view, Status::InvalidArgument, {"indexCount", "11", "multiple of 3"});
  view.indexCount = 0x80000001u;  // A multiple of 3.
  expectRefused(view, Status::InvalidArgument, {"indexCount", "2147483649", "2147483646"});
  view = mesh.view();
  view.positionStride = 8;
  expectRefused(view, Status::InvalidArgument, {"positionStride", "8", "12"});
  view = mesh.view();
  view.positions = nullptr;
  expectRefused(view, Status::InvalidArgument, {"positions", "null"});
  view = mesh.view();
  view.indices = nullptr;
  expectRefused(view, Status::InvalidArgument, {"indices", "null"});
  mesh.indices[7] = 4;
  expectRefused(mesh.view(), Status::InvalidArgument, {"indices[7]", "is 4", "vertexCount"});
  mesh = tetrahedron();
  mesh.points[2][1] = std::numeric_limits<float>::quiet_NaN();
  expectRefused(mesh.view(), Status::InvalidArgument, {"y of vertex 2", "nan", "finite"});
  mesh.points[2][1] = -std::numeric_limits<float>::infinity();
  expectRefused(mesh.view(), Status::InvalidArgument, {"y of vertex 2", "-inf"});
  Refusal refusal;
  refusal.expect(buildAdjacency(tetrahedron().view(), nullptr, nullptr, {&Refusal::take, &refusal}),
                 Status::InvalidArgument, {"adjacency is null"});
}

TEST(Adjacency, WithoutMemoryNothingIsWritten) {
  const Mesh mesh = tetrahedron();
  std::vector<uint32_t> six(24, kUntouched);
  Status status = Status::OutOfHostMemory;
  int allowed = 0;
  for (; status != Status::Ok && allowed < 100; ++allowed) {
    newCallsLeft = allowed;
    status = buildAdjacency(mesh.view(), six.data(), nullptr, {});
    newCallsLeft = -1;
    if (status != Status::Ok) {
      EXPECT_EQ(status, Status::OutOfHostMemory);
      EXPECT_EQ(std::count(six.begin(), six.end(), kUntouched), 24);
    }
  }
  EXPECT_EQ(status, Status::Ok);
  EXPECT_GT(allowed, 3);
}

TEST(Adjacency, Of327680TrianglesTakesWellUnderASecond) {
  const Mesh mesh = boulder(7, 1);
  ASSERT_EQ(mesh.indices.size(), 3u * 327680u);
  std::vector<uint32_t> six(mesh.indices.size() * 2);
  const std::clock_t start = std::clock();  // CPU time, which a busy machine doesn't stretch.
  ASSERT_EQ(buildAdjacency(mesh.view(), six.data(), nullptr, {}), Status::Ok);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%.3f CPU seconds\n", seconds);
  EXPECT_LT(seconds, 1.0);
}

}  // namespace
}  // namespace alpenglow::testing
