#version 460
#extension GL_GOOGLE_include_directive : require
// One call into each file of the physics, so that a compiler can't drop what it has not checked.
#include "physics/physics.glsl"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0, std140) uniform Block { Medium medium; };
layout(set = 0, binding = 1, std430) buffer Result { vec4 result[]; };

void main() {
  Ray ray = makeRay(medium, 2.0, 0.1, 0.99, 0.5, 0.3);
  Spectrum depth = opticalDepthToTop(medium, ray.h, ray.mu, 500) +
                   opticalDepthOfSegment(medium, ray.h, ray.mu, ray.extent);
  float u = scatteringUmu(medium, ray.h, ray.mu, ray.hitsGround);
  result[0] = vec4(depth, u);
  MomentShape shape;
  shape.sunWidth = shape.sunRange = shape.heightScale = shape.depthSharpness = 1.0;
  RaySegment segment = makeSegment(medium, ray, 0.0, ray.extent);
  SkyViewParams view = SkyViewParams(1.5, 1.6, 1.0);
  result[2] = vec4(depthCoordinate(medium, shape, ray.h, ray.mu), segmentNode(segment, 0.5));
  result[3] = vec4(reflectedRadiance(medium.groundAlbedo, depth, depth),
                   gridCoordinate(skyViewGrid(view, 128.0, 160.0), view, angleFromNadir(ray.mu, 0.5), 0.5,
                                  ray.hitsGround).x);
  AerialSegment aerial = aerialSegment(medium, aerialView(medium, view, ray.h), ray);
  result[4] = vec4(aerialU(aerial, 100.0), aerialTexelDistance(aerial, 3), aerialMeanDepth(result[0], 1.0), 0.0);
  result[1] = vec4(depth, miePhase(medium.mieAsymmetry, ray.nu));
}
