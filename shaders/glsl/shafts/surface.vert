#version 460
#extension GL_GOOGLE_include_directive : require
// The surface between light and shadow: the map from the sun as a relief along the sun's beam. Where casters
// are lit it lies on them; between, it is the walls of their shadows. An instance is a block of cells that
// cull.comp has kept: for each row a strip of triangles, its first and last vertex twice.

#include "alpenglow/shafts.glsl"

layout(location = 0) out vec3 position;  // metres from the camera

void main() {
  int side = (alpenglowShadowCells() - 1) / kShaftBlock + 1;
  int block = int(alpenglowShaftBlocks.blocks[gl_InstanceIndex]);
  const int kRow = 2 * kShaftBlock + 4;
  int row = gl_VertexIndex / kRow;
  int k = clamp(gl_VertexIndex % kRow - 1, 0, kRow - 3);
  ivec2 vertex = ivec2(block % side, block / side) * kShaftBlock + ivec2(k >> 1, row + (k & 1));
  position = alpenglowShadowVertex(vertex);
  gl_Position = alpenglowShaft.clipFromCamera * vec4(position, 1.0);
}
