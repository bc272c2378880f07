// Reads one storage image and writes another: the reader for synchronisation tests.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba16f) uniform readonly image2D source;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D target;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(target);
  if (texel.x >= size.x || texel.y >= size.y) return;
  imageStore(target, texel, 2.0 * imageLoad(source, texel));
}
