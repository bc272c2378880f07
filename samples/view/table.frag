#version 460
// A layer of a table as a picture: its texels, unfiltered, brightened and bent to show small values too.
#ifdef TABLE_3D
layout(set = 0, binding = TABLE_BINDING) uniform sampler3D table;
#else
layout(set = 0, binding = TABLE_BINDING) uniform sampler2D table;
#endif
layout(push_constant) uniform Shown {
  vec4 area;  // left, top, width, height, pixels of the window
  vec4 look;  // layer, of all 1; factor; 1: logarithm over 6 decades
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
  vec3 linear = clamp(value * look.y, 0.0, 1.0);
  vec3 logarithm = clamp(1.0 + log2(max(value * look.y, 1e-30)) / 19.93, 0.0, 1.0);
  color = vec4(look.z > 0.0 ? logarithm : pow(linear, vec3(1.0 / 2.2)), 1.0);
}
