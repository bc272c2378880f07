#version 460
#extension GL_GOOGLE_include_directive : require
// From linear radiance to the window's 8-bit sRGB: exposure, colour balance, tone map, and the dither that
// io::toneMapped has, so that a screenshot shows what the window shows.
#include "alpenglow/tone_map.glsl"

layout(set = 0, binding = 0) uniform sampler2D picture;
layout(push_constant) uniform Tone {
  vec4 factor;  // exposure times balance; w: which tone map, as io::ToneMap
  vec4 texture_;  // from pixels to texture coordinates; the greatest that are of the picture
};
layout(location = 0) out vec4 color;

float ditherAt(uvec2 at, uint channel) {
  uint h = at.x * 0x9E3779B1u ^ at.y * 0x85EBCA77u ^ channel * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  h ^= h >> 15;
  return float(h >> 8) * exp2(-24.0);
}

float encoded(float value, float dither) {
  if (value >= 1.0) return 1.0;
  if (!(value > 0.0)) return 0.0;
  return floor(255.0 * alpenglowSrgbEncode(value) + dither) / 255.0;
}

void main() {
  vec3 x = textureLod(picture, min(gl_FragCoord.xy * texture_.xy, texture_.zw), 0.0).rgb;
  x = min(x * factor.rgb, vec3(1e30));  // infinity over infinity would be no number
  uvec2 at = uvec2(gl_FragCoord.xy);
  for (uint i = 0u; i < 3u; ++i) {
    float mapped = factor.w == 0.0   ? alpenglowToneFilmic(x[i])
                   : factor.w == 1.0 ? alpenglowToneReinhard(x[i])
                                     : alpenglowToneLinear(x[i]);
    color[i] = encoded(mapped, ditherAt(at, i));
  }
  color.a = 1.0;
}
