#version 460
// The greatest depth in each block of the map from the sun, and with ALPENGLOW_AROUND in the blocks about it
// too: what the sun meets there lies no deeper.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D depths;
layout(set = 0, binding = 1, r32f) uniform writeonly image2D blocks;

const int kBlock = 8;  // texels on a side; also in atmosphere/shafts/sun_map.h

void main() {
  ivec2 block = ivec2(gl_GlobalInvocationID.xy);
#ifdef ALPENGLOW_AROUND
  const int kFirst = -1, kEnd = 2;
  ivec2 corner = block;
#else
  const int kFirst = 0, kEnd = kBlock;
  ivec2 corner = block * kBlock;
#endif
  ivec2 last = textureSize(depths, 0) - 1;
  float greatest = 0.0;
  for (int y = kFirst; y < kEnd; ++y)
    for (int x = kFirst; x < kEnd; ++x)
      greatest = max(greatest, texelFetch(depths, clamp(corner + ivec2(x, y), ivec2(0), last), 0).r);
  if (all(lessThan(block, imageSize(blocks)))) imageStore(blocks, block, vec4(greatest));
}
