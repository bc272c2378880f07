// What the shaders of the standard solver share: bindings and table reads. ALPENGLOW_STORAGE is the format
// qualifier of the tables (rgba16f or rgba32f).
#include "tile.glsl"

layout(constant_id = 1) const bool kMiePacked = false;
#define ALPENGLOW_FIRST_ORDER kFirstOrder
#define ALPENGLOW_MIE_PACKED kMiePacked

#define ALPENGLOW_TABLE_READS
#include "physics/physics.glsl"

layout(set = 0, binding = 1) uniform sampler2D transmittanceTable;
layout(set = 0, binding = 2) uniform sampler2D deltaIrradianceTable;
layout(set = 0, binding = 3) uniform sampler3D deltaScatteringTable;
layout(set = 0, binding = 4) uniform sampler3D deltaMieTable;
layout(set = 0, binding = 5) uniform sampler3D deltaSourceTable;
layout(set = 0, binding = 6) uniform sampler2D incidentTable;
layout(set = 0, binding = 7) uniform sampler2D incidentMieTable;

Spectrum readTransmittance(vec2 uv) { return textureLod(transmittanceTable, uv, 0.0).rgb; }
Spectrum readDeltaIrradiance(vec2 uv) { return textureLod(deltaIrradianceTable, uv, 0.0).rgb; }
Spectrum readDeltaRadiance(vec3 uvw) { return textureLod(deltaScatteringTable, uvw, 0.0).rgb; }
Spectrum readDeltaMie(vec3 uvw) { return textureLod(deltaMieTable, uvw, 0.0).rgb; }
Spectrum readDeltaSource(vec3 uvw) { return textureLod(deltaSourceTable, uvw, 0.0).rgb; }
Spectrum readIncident(vec2 uv) { return textureLod(incidentTable, uv, 0.0).rgb; }
Spectrum readIncidentMie(vec2 uv) { return textureLod(incidentMieTable, uv, 0.0).rgb; }

#include "physics/lookup.glsl"

layout(set = 0, binding = 0, std140) uniform Atmosphere {
  Medium medium;
  TableShape shape;
};

#include "physics/standard.glsl"

// The ray that a texel of S stands for. The horizon is decided by the half of the table, never again.
struct ScatteringTexel {
  float h;
  float mu;
  float muS;
  float nu;
  bool hitsGround;
  float reach;  // below 1: no ray maps to this texel, see shorterRay
};

ScatteringTexel scatteringTexel(ivec3 texel) {
  ScatteringTexel s;
  int sizeMuS = int(shape.scatteringMuS);
  s.h = scatteringH(medium, texelToU(float(texel.z), shape.scatteringR));
  s.hitsGround = texel.y < int(shape.scatteringMu) / 2;
  float uMu = texelToScatteringUmu(float(texel.y), s.hitsGround, shape.scatteringMu);
  s.mu = scatteringMu(medium, s.h, uMu, s.hitsGround);
  s.reach = scatteringReach(medium, s.h, uMu, s.hitsGround);
  s.muS = scatteringMuS(texelToU(float(texel.x % sizeMuS), shape.scatteringMuS));
  float uNu = texelToU(float(texel.x / sizeMuS), shape.scatteringNu);
  s.nu = clampNu(s.mu, s.muS, 2.0 * uNu - 1.0);
  return s;
}

// h and mu_s of a texel of E.
vec2 irradianceTexel(ivec3 texel) {
  return irradianceHMuS(medium, vec2(texelToU(float(texel.x), shape.irradianceMuS),
                                     texelToU(float(texel.y), shape.irradianceR)));
}
