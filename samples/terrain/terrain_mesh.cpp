#include "terrain_mesh.h"

#include <alpenglow/io/height_field.h>
#include <alpenglow/mesh/terrain.h>

#include <cmath>

#include "common/gpu.h"

namespace alpenglow::samples {
namespace {

void keepSentence(void* user, const Diagnostic& diagnostic) {
  *static_cast<std::string*>(user) = diagnostic.message;
}

TerrainDesc describe(const Parameters& parameters, const io::SceneTerrain& terrain,
                     const io::HeightMap& map) {
  TerrainDesc desc;
  desc.field = {map.heights_m.data(),
                map.width,
                map.height,
                {terrain.metersPerPixel[0], terrain.metersPerPixel[1]}};
  desc.radius_m = parameters.bottomRadius_m;
  desc.latitude = terrain.latitude;
  desc.longitude = terrain.longitude;
  desc.heading = terrain.heading;
  desc.base_m = terrain.base_m;
  desc.heightScale = terrain.heightScale;
  desc.fade_m = terrain.fade_m;
  return desc;
}

}  // namespace

TerrainMesh loadTerrain(const Parameters& parameters, const io::SceneTerrain& terrain) {
  const io::Result<io::HeightMap> map =
      io::readHeightMap(terrain.heightMap, {terrain.metersPerUnit, 0.0});
  if (!map) throw Error(map.error);
  const TerrainDesc desc = describe(parameters, terrain, *map);
  std::string sentence;
  const DiagnosticSink sink = {keepSentence, &sentence};
  const auto check = [&](Status status) {
    if (status != Status::Ok) throw Error("The terrain can't be built: " + sentence);
  };
  TerrainSize size;
  check(terrainSize(desc, &size, sink));
  TerrainMesh mesh;
  mesh.vertices.resize(size.vertexCount);
  mesh.indices.resize(size.indexCount);
  check(buildTerrain(desc, mesh.vertices.data(), mesh.indices.data(), &mesh.place, sink));
  return mesh;
}

std::vector<uint32_t> withAdjacency(const TerrainMesh& mesh) {
  MeshView view;
  view.positions = mesh.vertices[0].position;
  view.positionStride = sizeof(TerrainVertex);
  view.vertexCount = static_cast<uint32_t>(mesh.vertices.size());
  view.indices = mesh.indices.data();
  view.indexCount = static_cast<uint32_t>(mesh.indices.size());
  std::vector<uint32_t> adjacency(2 * mesh.indices.size());
  std::string sentence;
  if (buildAdjacency(view, adjacency.data(), nullptr, {keepSentence, &sentence}) != Status::Ok)
    throw Error("The terrain's neighbours can't be found: " + sentence);
  return adjacency;
}

Reach reachOf(const Box& box, const double point[3], const double direction[3]) {
  double middle = 0.0;
  double half = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double* axis = box.axes[i];
    middle += (box.center[i] - point[i]) * direction[i];
    half += box.halfExtents[i] *
            std::abs(axis[0] * direction[0] + axis[1] * direction[1] + axis[2] * direction[2]);
  }
  return {middle - half, middle + half};
}

}  // namespace alpenglow::samples
