// Which triangles face the sun. Both triangles at an edge are tested from either side, and the results must agree
// to the last bit, or a wall would be missing or drawn twice: so each is computed from the same corner,
// whichever order its corners come in.

bool before(vec3 a, vec3 b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

float facing(vec3 a, vec3 b, vec3 c) {
  bool second = before(b, a) && !before(c, b);
  bool third = before(c, a) && before(c, b);
  vec3 p = third ? c : second ? b : a;
  vec3 q = third ? a : second ? c : b;
  vec3 r = third ? b : second ? a : c;
  precise vec3 normal = cross(q - p, r - p);
  precise float f = dot(normal, alpenglowLightShaft.sunRange.xyz);
  return f;
}
