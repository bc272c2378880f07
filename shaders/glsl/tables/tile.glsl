// The tile that an invocation of a bake shader works in. A tile is a range of rows: row = y for a 2D
// table, y + height * z for a 3D one; an invocation makes one texel.

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const bool kFirstOrder = false;

layout(push_constant) uniform Tile {
  uint firstRow;
  uint endRow;
  uint width;
  uint height;
};

// Texel of this invocation, or z = -1 outside the tile.
ivec3 tileTexel() {
  uint row = firstRow + gl_GlobalInvocationID.y;
  bool outside = row >= endRow || gl_GlobalInvocationID.x >= width;
  return outside ? ivec3(-1) : ivec3(gl_GlobalInvocationID.x, row % height, row / height);
}
