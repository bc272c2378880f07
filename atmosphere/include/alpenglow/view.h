// Drawing: a view records sky, sun disc, ground sphere and the air in front of it into a rendering
// scope that the host has begun, from the ground to outer space.
#pragma once

#include <alpenglow/tables.h>

namespace alpenglow {
inline namespace v1 {

struct View;    ///< Opaque.
struct Shafts;  ///< Opaque: alpenglow/shafts.h.

enum class Projection : uint32_t {
  Perspective,  ///< fov is vertical, in (0, pi).
  Fisheye,      ///< Equidistant; fov is the full circle's, in (0, 2 pi]; the largest centred circle
                ///< of the viewport, black outside.
  Orthographic,  ///< Parallel rays from the plane through the camera; Camera::height_m.
};

enum class DepthConvention : uint32_t {
  Standard,  ///< 0 near, 1 far.
  Reversed,  ///< 1 near, 0 far.
};

/// What the depth of the host's picture means, with its DepthConvention: distances along
/// Camera::forward.
struct DepthRange {
  double near_m = 0.0;  ///< Above 0 (perspective); any (orthographic).
  double far_m = 0.0;   ///< Above near_m; 0: infinitely far (perspective).
};

/// The depth image of the host's opaque scene, which recordAir and recordShafts read: one sample a
/// pixel, usage SAMPLED and DEPTH_STENCIL_ATTACHMENT, in the layout below while they execute, with
/// its writes made available to fragment shader reads and early fragment tests.
struct SceneDepth {
  VkImageView view = VK_NULL_HANDLE;  ///< Of the depth aspect.
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent2D extent = {};
  VkImageLayout layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
};

/// An equirectangular map of the ground's albedo: u = 0 at longitude -180 degrees, v = 0 at the
/// north pole. Give an sRGB format if the image is sRGB. All zero: the uniform albedo.
struct GroundAlbedoMap {
  VkImageView view = VK_NULL_HANDLE;
  VkSampler sampler = VK_NULL_HANDLE;  ///< Repeat in u, clamp in v, linear, with mip levels.
  VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  uint32_t width = 0, height = 0;  ///< Of level 0, in texels.
};

/// What the host's rendering scope looks like. Everything stays the host's.
struct ViewDesc {
  VkFormat colorFormat = VK_FORMAT_UNDEFINED;
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;  ///< With depth, only far pixels are drawn.
  DepthConvention depth = DepthConvention::Standard;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkRenderPass renderPass = VK_NULL_HANDLE;  ///< Null: dynamic rendering.
  uint32_t subpass = 0;
  uint32_t viewMask = 0;  ///< Must be 0: multiview is refused by this version.
  Projection projection = Projection::Perspective;
  Solver solver = Solver::Moments;    ///< As the tables that will be drawn with.
  MieStorage mie = MieStorage::Full;  ///< The same; of Solver::Standard.
  GroundAlbedoMap groundAlbedo;
  /// Bits of kTableEffects, those of the tables that will be drawn with; and of kViewEffects: no
  /// pipeline is made for what the view is without, and a draw that would see it is refused.
  EffectFlags without = 0;
  /// Every recordSky and recordAir follows a recordSkySlice for it: no pipeline is made for others,
  /// which are refused. Needs skySlice.
  bool alwaysSliced = false;
  /// Tables whose shape a sky slice takes; null: the view has none. With a slice, recordSkySlice
  /// once a frame makes a pixel of recordSky much cheaper; of Solver::Standard, for cameras inside
  /// the atmosphere only.
  const Tables* skySlice = nullptr;
  /// For recordAir; a null view: the view has no aerial perspective. Needs one sample, a colour
  /// format that blends, and no fisheye. Make another view when the depth image is made anew.
  SceneDepth sceneDepth;
  /// Light shafts that the view draws; it outlives the view. Null: none. Needs sceneDepth, the same
  /// as the shafts', and Solver::Moments.
  const Shafts* shafts = nullptr;
};

/// Checks the description and makes the pipelines.
ALPENGLOW_API Status createView(Context* context, const ViewDesc& desc, View** out);
/// Frees the view once `frame.completed` of a later call reaches `frame.submitting`.
ALPENGLOW_API void destroyView(View* view, const FrameInfo& frame);

/// Where the camera is and looks, in the planet's frame: origin at the centre, z to the north pole,
/// x to latitude 0, longitude 0; metres. Altitude is |position| - Rg, taken in double; below the
/// ground it is clamped to 0.
struct Camera {
  double position_m[3] = {};
  double forward[3] = {};  ///< Unit vectors, orthogonal.
  double up[3] = {};
  double fov = 0.0;       ///< Radians, see Projection; not orthographic.
  double height_m = 0.0;  ///< Orthographic: from the lower to the upper edge of the picture.
};

/// The sun of this frame: never state of the tables.
struct Sun {
  double direction[3] = {};  ///< Unit vector towards the sun, in the planet's frame.
  Spectrum irradiance;       ///< At the top of the atmosphere.
  double discRadius = 0.0;   ///< Angular, radians; 0 draws no disc.
};

struct SkyDraw {
  Camera camera;
  Sun sun;
  double radianceScale = 0.0;  ///< Factor on the stored radiance, so that night survives half
                               ///< floats; 0 means 1.
  VkRect2D viewport = {};      ///< In pixels of the colour attachment.
  DepthRange depth;            ///< For recordAir and recordShafts.
};

/// Records, outside any rendering scope, the slice that this draw's camera and sun look into: one
/// dispatch, of the light along all rays (moments) or of the scattering table (standard); and, with
/// ViewDesc::sceneDepth and moments, its air volume: the same up to every distance. A
/// recordSky of the same tables, camera position and sun direction that follows in recording order
/// reads it; any other reads the tables. InvalidArgument without ViewDesc::skySlice, and for tables
/// of another shape. Nothing is recorded for orthographic cameras, whose rays have an observer
/// each, and, with Solver::Standard, for a camera outside the atmosphere; the picture is that of
/// the tables then. With Moments it is interpolated between the rays of the slice, 64 x 160 inside
/// the atmosphere and 128 x 160 outside (fewer where ViewDesc::skySlice is of a level below
/// medium), and off by what docs/stability.md says. Clobbers: compute pipeline, sets 0 and 1, push
/// constants.
ALPENGLOW_API Status recordSkySlice(View* view, VkCommandBuffer commands, const FrameInfo& frame,
                                    const Tables* tables, const SkyDraw& draw);

/// Draws the viewport inside the host's rendering scope, with dynamic viewport and scissor: a few
/// draws, at most 64, of rectangles that together are the viewport, each with the pipeline for what
/// its pixels may see of air, ground and sun. The tables must be ready. Clobbers: graphics
/// pipeline, sets 0 and 1 (0 to 3 with ViewDesc::sceneDepth), push constants, viewport, scissor.
ALPENGLOW_API Status recordSky(View* view, VkCommandBuffer commands, const FrameInfo& frame,
                               const Tables* tables, const SkyDraw& draw);

/// Aerial perspective: draws, inside the host's rendering scope, over every pixel of the viewport
/// that the host's scene covers: colour times transmittance plus light scattered on the way, less
/// what shadows keep from it (ViewDesc::shafts). The host has drawn its opaque scene into the
/// colour attachment in linear radiance times SkyDraw::radianceScale; the scope's depth attachment,
/// if any, is read-only (ViewDesc::sceneDepth is read meanwhile). With a sky slice recorded for
/// this draw it reads that frame's air volume, else it integrates each pixel's ray through the
/// tables. Sky pixels are left to recordSky, in either order. Needs ViewDesc::sceneDepth,
/// kCapabilityAir and SkyDraw::depth. Not for fisheyes. Clobbers what recordSky does, and sets 0
/// to 2.
ALPENGLOW_API Status recordAir(View* view, VkCommandBuffer commands, const FrameInfo& frame,
                               const Tables* tables, const SkyDraw& draw);

/// The matrix (column-major) that a host may draw its scene with, and that its depth image must
/// agree with: from metres off the camera, in the planet's axes, to Vulkan's clip space. With z the
/// distance along Camera::forward, n = near_m and f = far_m, depth is (Standard) f (z - n) /
/// (z (f - n)), or 1 - n / z without f; (Reversed) n (f - z) / (z (f - n)), or n / z; orthographic
/// (z - n) / (f - n), or (f - z) / (f - n). Not for fisheyes.
ALPENGLOW_API void clipFromCamera(Projection projection, DepthConvention convention,
                                  const SkyDraw& draw, float matrix[16]);

/// A camera above a point of the planet, as scene files give it. Angles in radians: heading
/// clockwise from north, pitch above the horizon (pi/2: the zenith), roll clockwise.
ALPENGLOW_API Camera cameraFromGeodetic(const Parameters& parameters, double latitude,
                                        double longitude, double altitude_m, double heading,
                                        double pitch, double roll, double fov);
/// Unit vector towards a sun seen at these angles about the camera's local vertical: elevation
/// above the horizontal, azimuth clockwise from north.
ALPENGLOW_API void sunDirection(double latitude, double longitude, double elevation, double azimuth,
                                double direction[3]);

}  // namespace v1
}  // namespace alpenglow
