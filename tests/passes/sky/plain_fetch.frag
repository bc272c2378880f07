#version 460
// The least that a pixel of a sky-view LUT can cost: what it costs the driver to fill a pixel with one fetch
// of each of the LUT's images, at a coordinate that is there already.
layout(set = 1, binding = 1) uniform sampler2D skyViewLut;
layout(set = 1, binding = 2) uniform sampler2D skyViewLutMie;
layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 radiance;

void main() {
  vec2 at = 0.5 + 0.5 * ndc;
  radiance = textureLod(skyViewLut, at, 0.0) + textureLod(skyViewLutMie, at, 0.0);
}
