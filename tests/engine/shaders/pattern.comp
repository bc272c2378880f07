// Writes a pattern that depends on the texel, a specialization constant and a push constant.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const float kScale = 1.0;
layout(constant_id = 1) const bool kFlip = false;
layout(set = 0, binding = 0, rgba16f) uniform writeonly image2D target;
layout(push_constant) uniform Push { float offset; } push;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(target);
  if (texel.x >= size.x || texel.y >= size.y) return;
  float x = float(kFlip ? size.x - 1 - texel.x : texel.x);
  imageStore(target, texel, vec4(x * kScale, float(texel.y), push.offset, 1.0));
}
