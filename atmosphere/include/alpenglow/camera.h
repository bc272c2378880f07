// The host's world on the planet, and cameras in it. Pure functions; thread-safe. Angles in
// radians.
#pragma once

#include <alpenglow/parameters.h>

namespace alpenglow {
inline namespace v1_0 {

/// Where the host's world lies on the planet, given in the planet frame: origin at the planet's
/// centre, z to the north pole, x to latitude 0, longitude 0; metres, in double. All zero: the
/// world is the planet frame. It may change each frame (floating origin).
struct World {
  double origin_m[3] = {};   ///< The world's origin.
  double axes[3][3] = {};    ///< World x, y and z, orthonormal, of either hand; 0: the planet's.
  double metersPerUnit = 0;  ///< Must be 0 or 1 in this version.
  double equatorialRadius_m = 0, polarRadius_m = 0;  ///< Ellipsoid of altitude 0. Must be 0.
};

/// Axes of a world at a point of the ground.
enum class WorldAxes : uint32_t {
  EarthCentered,  ///< Those of the planet frame.
  ZUp,            ///< x east, y north, z up.
  YUp,            ///< x east, y up, z south.
  ZUpLeftHanded,  ///< x north, y east, z up.
  YUpLeftHanded,  ///< x east, y up, z north.
};

enum class Projection : uint32_t {
  Perspective,
  Fisheye,       ///< Equidistant; the largest centred circle of the viewport, black outside.
  Orthographic,  ///< Parallel rays from the plane through the camera.
};

enum class DepthConvention : uint32_t {
  Standard,  ///< 0 near, 1 far.
  Reversed,  ///< 1 near, 0 far.
};

/// World units and axes. An absent camera has a zero `forward`.
struct Camera {
  double position[3] = {};
  double forward[3] = {}, up[3] = {};  ///< Unit vectors, orthogonal.
  double fov = 0;  ///< Vertical; 0: 60 degrees. Fisheye: of the full circle; 0: 180 degrees.
  /// Off-centre frusta: left, right, down, up. Must be 0 in this version.
  double tangents[4] = {};
  double height = 0;      ///< Orthographic: from the lower to the upper edge of the picture.
  double jitter[2] = {};  ///< In pixels. Must be 0 in this version.
  double nearPlane = 0, farPlane = 0;  ///< Along `forward`; farPlane 0: infinitely far
                                       ///< (perspective). Read only in views with a scene depth.
  VkRect2D viewport = {};              ///< Pixels of the attachment. Zero: all of
                                       ///< FrameDesc::sceneDepth; required without one.
};

/// Places the world's origin at a point of the planet, axes along the local east, north and up.
/// Altitude is above the sphere of Parameters::bottomRadius_m. `metersPerUnit` and radii are kept.
/// InvalidArgument, with a sentence, for a latitude beyond the poles (degrees in place of radians)
/// and for what is not finite; `world` then stays as it was.
ALPENGLOW_API Status placeWorld(const Parameters& planet, double latitude, double longitude,
                                double altitude_m, WorldAxes axes, World* world,
                                const DiagnosticSink& sink);

/// A camera above a point of the planet: heading clockwise from north, pitch above the horizon,
/// roll clockwise. Fills position, forward and up. Where placeWorld would refuse, or an angle is
/// not finite, the camera is absent, and beginFrame says so.
ALPENGLOW_API Camera cameraAt(const Parameters& planet, const World& world, double latitude,
                              double longitude, double altitude_m, double heading, double pitch,
                              double roll);

/// Unit vector in world axes towards something seen at these angles from a point of the planet:
/// elevation above the horizontal, azimuth clockwise from north. Zero, which is an absent light,
/// where cameraAt would give an absent camera.
ALPENGLOW_API void directionAt(const World& world, double latitude, double longitude,
                               double elevation, double azimuth, double direction[3]);

/// Fills all but the viewport of a perspective or orthographic camera from the host's matrices,
/// both column-major. View space looks along -z with y up. `clipYUp`: clip space has y up, since
/// the host draws with a flipped viewport; else y down, as Vulkan has it. InvalidArgument, with a
/// sentence, for what is no frustum that this version draws: off-centre, sheared, with an oblique
/// near plane, or with a depth range that is not the convention's.
ALPENGLOW_API Status cameraFromMatrices(const double worldFromView[16],
                                        const double clipFromView[16], DepthConvention depth,
                                        bool clipYUp, Camera* camera, const DiagnosticSink& sink);

/// The matrix (column-major) that a host may draw its scene with, and that its depth image must
/// agree with: from world units off Camera::position, world axes, to Vulkan's clip space. With z
/// the distance along Camera::forward, n = nearPlane and f = farPlane, depth is (Standard) f (z -
/// n) / (z (f - n)), or 1 - n / z without f; (Reversed) n (f - z) / (z (f - n)), or n / z;
/// orthographic (z - n) / (f - n), or (f - z) / (f - n). InvalidArgument for a fisheye and for a
/// viewport without area.
ALPENGLOW_API Status clipFromCamera(Projection projection, DepthConvention depth,
                                    const Camera& camera, float matrix[16]);
}  // namespace v1_0
}  // namespace alpenglow
