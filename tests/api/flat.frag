#version 460
// A host's own shader in place of the sky's: one colour, and with WITH_BUFFER a resource that the sky has not.
#ifdef WITH_BUFFER
layout(set = 0, binding = 7, std430) readonly buffer More { float more; };
#else
const float more = 0.0;
#endif
layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 color;
void main() { color = vec4(3.0 + more, 2.0 + ndc.y, 1.0, 1.0); }
