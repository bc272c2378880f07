// Placing a caster: placeCaster() in alpenglow/view.h.

layout(location = 0) in vec3 localPosition;

layout(push_constant) uniform Place {
  vec4 rows[3];  // local position to metres from the camera, or to clip space of the shadow map
};

vec3 placed() {
  vec4 p = vec4(localPosition, 1.0);
  return vec3(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
}
