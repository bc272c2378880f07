#version 460
#extension GL_GOOGLE_include_directive : require
// The light-volume mesh, after Billeter, Sintorn & Assarsson 2010, "Real-Time Volumetric Shadows using
// Polygonal Light Volumes" (HPG). The shadow map spans it along the sun's beam: where casters are lit it lies on
// them; between them it forms the walls of their shadows. An instance is a block of cells that
// light_volume_cull.comp has kept: for each row a strip of triangles, its first and last vertex twice.

#include "alpenglow/light_shafts.glsl"

layout(location = 0) out vec3 position;  // metres from the camera

void main() {
  int side = (alpenglowMeshCells() - 1) / kLightShaftBlock + 1;
  int block = int(alpenglowLightShaftBlocks.blocks[gl_InstanceIndex]);
  const int kRow = 2 * kLightShaftBlock + 4;
  int row = gl_VertexIndex / kRow;
  int k = clamp(gl_VertexIndex % kRow - 1, 0, kRow - 3);
  ivec2 vertex = ivec2(block % side, block / side) * kLightShaftBlock + ivec2(k >> 1, row + (k & 1));
  position = alpenglowMeshVertex(vertex);
  gl_Position = alpenglowLightShaft.clipFromCamera * vec4(position, 1.0);
}
