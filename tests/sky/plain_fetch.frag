#version 460
// The least that a pixel of a sky slice can cost: what it costs the driver to fill a pixel with one fetch
// of each of the slice's images, at a coordinate that is there already.
layout(set = 1, binding = 1) uniform sampler2D sliceTable;
layout(set = 1, binding = 2) uniform sampler2D sliceMieTable;
layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 radiance;

void main() {
  vec2 at = 0.5 + 0.5 * ndc;
  radiance = textureLod(sliceTable, at, 0.0) + textureLod(sliceMieTable, at, 0.0);
}
