#version 460
// A host's own shader in place of the sky's: one colour, and what the sky's has not: a resource; more push
// constants (164 bytes), and two images at a binding.
#if defined(WITH_MORE)
struct Part { mat4 m; vec3 v; float f; };
layout(push_constant) uniform More { Part parts[2]; float more; };
layout(set = 1, binding = 1) uniform sampler2D images[2];
#elif defined(WITH_BUFFER)
layout(set = 0, binding = 7, std430) readonly buffer More { float more; };
#else
const float more = 0.0;
#endif
layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 color;
#ifndef WITH_MORE
void main() { color = vec4(3.0 + more, 2.0 + ndc.y, 1.0, 1.0); }
#else
void main() { color = vec4(parts[1].f + more) + textureLod(images[1], ndc, 0.0); }
#endif
