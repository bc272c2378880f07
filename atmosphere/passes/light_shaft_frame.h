// Where the shadow map lies, and the uniform block of a frame's shaders.
#pragma once

#include "atmosphere/camera/picture.h"

namespace alpenglow::passes {

/// A box along the sun's beam about the casters, in the planet's frame.
struct ShadowMapPlace {
  double center[3] = {};
  double u[3] = {}, v[3] = {}, sun[3] = {};          ///< Orthogonal unit vectors.
  double halfU = 1.0, halfV = 1.0, halfDepth = 1.0;  ///< Metres.
};
/// The smallest box; `texels` on a side, of which two at each edge are left free.
ShadowMapPlace placeShadowMap(const PlanetBox& bounds, const double sun[3], uint32_t texels);

/// Whether direct sunlight may reach a point of the box. Where it doesn't, the planet's own shadow
/// covers the casters, and they cast none.
bool sunReaches(const Parameters& parameters, const PlanetBox& bounds, const double sun[3]);

/// std140 of AlpenglowLightShaftFrame in shaders/glsl/alpenglow/light_shafts.glsl, which
/// explains each member.
struct LightShaftFrame {
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
  float aerialSkyView[4];
  float aerialSun[4];
  float aerialHeight[4];
};
static_assert(sizeof(LightShaftFrame) == 320, "As std140 lays it out");

/// The number of a method in shaders: alpenglow/light_shafts.glsl.
constexpr uint32_t methodIndex(LightShaftMethod method) {
  return static_cast<uint32_t>(method) - 1;
}

/// In their place for a frame whose casters no sunlight reaches.
inline constexpr float kNoShadow = -1.0f;

/// Cells on a side of a block: alpenglow/light_shafts.glsl.
inline constexpr uint32_t kLightShaftBlock = 16;
/// Texels from vertex to vertex of the light-volume mesh.
constexpr uint32_t meshStep(const LightShaftSettings& desc) {
  return (desc.shadowMapSize + desc.meshSize - 1) / desc.meshSize;
}
/// Blocks on a side of the light-volume mesh.
constexpr uint32_t blocksAcross(const LightShaftSettings& desc) {
  const uint32_t step = meshStep(desc);
  return ((desc.shadowMapSize - 2 + step) / step - 1) / kLightShaftBlock + 1;
}

/// Everything is computed in double and rounded once. `lit`: sunReaches the casters.
LightShaftFrame makeLightShaftFrame(const Parameters& parameters, const LightShaftSettings& desc,
                                    const ShadowMapPlace& map, const FrameState& draw, bool lit);

/// Three rows that take local positions of a caster (placeCaster) to metres from `eye`.
void rowsFromEye(const double eye[3], const double origin[3], const float rotation[9],
                 float rows[3][4]);
/// From metres off the map's centre to clip space of the shadow map; column-major.
void clipFromMap(const ShadowMapPlace& map, double matrix[16]);
/// Three rows to clip space of the shadow map: coordinates in [-1, 1], and depth.
void rowsOnMap(const ShadowMapPlace& map, const double origin[3], const float rotation[9],
               float rows[3][4]);

}  // namespace alpenglow::passes
