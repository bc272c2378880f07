#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "N sum": the field of all orders at each node: those that were solved, and the geometric series that
// follows the last of them. ALPENGLOW_NO_ORDER: none was solved, and there is no light anywhere between.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D moments;

#ifdef ALPENGLOW_NO_ORDER

NodeField sumOfNode(ivec2 node) {
  const Spectrum none = SPECTRUM(0.0);
  return NodeField(none, none, none, none, none);
}

#else

layout(set = 0, binding = 4) uniform sampler2D sumTable;
layout(set = 0, binding = 5) uniform sampler2D lastTable;    // the last two orders, plain
layout(set = 0, binding = 6) uniform sampler2D beforeTable;

// A layer of the sum with its tail; `ratio` is the layer by whose decrease the series goes on.
Spectrum sumOfLayer(ivec2 node, int layer, int ratio) {
  Spectrum tail = tailFactor(shape, fetchLayer(lastTable, node, ratio),
                             fetchLayer(beforeTable, node, ratio));
  return fetchLayer(sumTable, node, layer) + fetchLayer(lastTable, node, layer) * tail;
}

NodeField sumOfNode(ivec2 node) {
  Spectrum irradiance = SPECTRUM(0.0);
  if (ALPENGLOW_GROUND_REFLECTION || ALPENGLOW_GROUND_IRRADIANCE)
    irradiance = sumOfLayer(node, 4, 4);
  return NodeField(sumOfLayer(node, 0, 0), sumOfLayer(node, 1, 0), sumOfLayer(node, 2, 0),
                   sumOfLayer(node, 3, 0), irradiance);
}

#endif

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  NodeField node = sumOfNode(texel.xy);
  for (int layer = 0; layer < int(shape.layers); ++layer) {
    imageStore(moments, texel.xy + ivec2(0, layer * int(height)),
               vec4(encodeLayer(node, layer), 0.0));
  }
}
