// A gradient over a sampled table.
#version 460
layout(constant_id = 0) const float kScale = 1.0;
layout(set = 0, binding = 0) uniform sampler2D table;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() { color = vec4(kScale * uv, texture(table, uv).z, 1.0); }
