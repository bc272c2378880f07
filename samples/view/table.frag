#version 460
// A layer of a table as a picture: its texels, unfiltered.
#ifdef TABLE_3D
layout(set = 0, binding = TABLE_BINDING) uniform sampler3D table;
#else
layout(set = 0, binding = TABLE_BINDING) uniform sampler2D table;
#endif
layout(push_constant) uniform Shown {
  vec4 area;  // left, top, width, height, pixels of the window
  vec4 look;  // layer, of all 1; values of black and of white; 1: their logarithms
};
layout(location = 0) out vec4 color;

void main() {
  vec2 uv = (gl_FragCoord.xy - area.xy) / area.zw;
#ifdef TABLE_3D
  ivec3 size = textureSize(table, 0);
  vec3 value = texelFetch(table, ivec3(clamp(ivec2(uv * size.xy), ivec2(0), size.xy - 1), int(look.x * size.z)), 0).rgb;
#else
  ivec2 size = textureSize(table, 0);
  vec3 value = texelFetch(table, clamp(ivec2(uv * size), ivec2(0), size - 1), 0).rgb;
#endif
  bool logarithm = look.w > 0.0;
  vec3 at = logarithm ? log2(max(value, 1e-30)) : value;
  vec2 range = logarithm ? log2(max(look.yz, 1e-30)) : look.yz;
  vec3 share = clamp((at - range.x) / max(range.y - range.x, 1e-30), 0.0, 1.0);
  color = vec4(logarithm ? share : pow(share, vec3(1.0 / 2.2)), 1.0);
}
