// Where the map from the sun lies, and what a frame's shaders know of it and of the camera.
#pragma once

#include "atmosphere/sky/picture.h"

namespace alpenglow::shafts {

/// A box along the sun's beam about the casters, in the planet's frame.
struct SunMapPlace {
  double center[3] = {};
  double u[3] = {}, v[3] = {}, sun[3] = {};          ///< Orthogonal unit vectors.
  double halfU = 1.0, halfV = 1.0, halfDepth = 1.0;  ///< Metres.
};
/// The least box; `texels` on a side, of which two at each edge are left free.
SunMapPlace placeSunMap(const PlanetBox& bounds, const double sun[3], uint32_t texels);

/// std140 of AlpenglowShaftFrame in shaders/glsl/alpenglow/shafts.glsl, which says what each is.
struct ShaftFrame {
  float clipFromCamera[16];
  float upAltitude[4];
  float forwardNear[4];
  float rightOffsetX[4];
  float downOffsetY[4];
  float sunRange[4];
  float mapU[4];
  float mapV[4];
  float mapDepth[4];
  float map[4];
  float cornerStep[4];
  float rowStep[4];
  float columnStep[4];
  float pixels[4];
  float airSlice[4];
  float airSun[4];
  float airHeight[4];
};
static_assert(sizeof(ShaftFrame) == 320, "As std140 lays it out");

/// As the shaders count methods: alpenglow/shafts.glsl.
constexpr uint32_t methodIndex(LightShaftMethod method) {
  return static_cast<uint32_t>(method) - 1;
}

/// Cells on a side of a block: alpenglow/shafts.glsl.
inline constexpr uint32_t kShaftBlock = 16;
/// Texels from vertex to vertex of the relief.
constexpr uint32_t reliefStep(const ShaftSettings& desc) {
  return (desc.shadowMapSize + desc.meshSize - 1) / desc.meshSize;
}
/// Blocks on a side of it.
constexpr uint32_t blocksAcross(const ShaftSettings& desc) {
  const uint32_t step = reliefStep(desc);
  return ((desc.shadowMapSize - 2 + step) / step - 1) / kShaftBlock + 1;
}

/// Everything is computed in double and rounded once.
ShaftFrame makeShaftFrame(const Parameters& parameters, const ShaftSettings& desc,
                          const SunMapPlace& map, const FrameState& draw);

/// Three rows that take local positions of a caster (placeCaster) to metres from `eye`.
void rowsFromEye(const double eye[3], const double origin[3], const float rotation[9],
                 float rows[3][4]);
/// Onto the map, from metres off its centre: column-major, to clip space.
void clipFromMap(const SunMapPlace& map, double matrix[16]);
/// Or onto the map: coordinates in [-1, 1], and depth.
void rowsOnMap(const SunMapPlace& map, const double origin[3], const float rotation[9],
               float rows[3][4]);

}  // namespace alpenglow::shafts
