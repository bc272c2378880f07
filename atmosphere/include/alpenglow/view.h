// One picture: createView says what it looks like, beginFrame states a frame, the record functions
// record it. From the ground to outer space.
#pragma once

#include <alpenglow/camera.h>
#include <alpenglow/tables.h>

namespace alpenglow {
inline namespace v1_0 {

/// Opaque. Host access must be externally synchronised, except that recordAerialPerspective and
/// recordSky of one frame may be called in parallel, with different command buffers, once the other
/// record functions of that frame have returned. Command buffers execute in the order in which the
/// record functions are declared below. Different views may be used in parallel.
struct View;

inline constexpr uint32_t kMaxCameras = 4;

enum class LightShaftMethod : uint32_t {
  Off,
  /// Light-volume mesh over the shadow map: each crossing between light and shadow adds or
  /// subtracts tabulated single scattering (after Billeter, Sintorn & Assarsson 2010, "Real-Time
  /// Volumetric Shadows using Polygonal Light Volumes", HPG). The recommended method.
  LightVolume,
  /// Shadow volumes of silhouette edges, from a geometry shader: Bruneton & Neyret 2008, section 5;
  /// ZP+ of Hornus et al. 2005. Nested shadows count twice. Needs kCapabilityShadowVolumes.
  ShadowVolume,
  /// Steps along each ray, each tested against the shadow map.
  RayMarch,
};

struct LightShaftDesc {
  LightShaftMethod method = LightShaftMethod::Off;
  uint32_t lightMask = 0;      ///< Bits of the lights that cast; 0 or 1: light 0. No others yet.
  uint32_t shadowMapSize = 0;  ///< Texels on a side; 0: 2048.
  uint32_t meshSize = 0;       ///< LightVolume: vertices on a side, at most shadowMapSize; 0: 1024.
  uint32_t stepCount = 0;      ///< RayMarch: steps of a ray, at most 4096; 0: 32.
  uint32_t listLength = 0;     ///< Must be 0 in this version.
  /// Share of multiple scattering that a ray loses when it loses all of its single scattering, at
  /// most 1; 0: 0.7, the nearest to path-traced mountains; below 0: none. ShadowVolume ignores it.
  double multipleLoss = 0.0;
  bool hostPipelines = false;  ///< Must be false in this version.
  bool closed = false;  ///< Casters are closed surfaces, counter-clockwise seen from outside: the
                        ///< shadow map leaves out the faces towards the sun.
  bool adjacency = false;  ///< Casters are triangles with adjacency (alpenglow/mesh/adjacency.h),
                           ///< else plain triangles. ShadowVolume needs it.
  uint32_t vertexStride = 0;  ///< Bytes from one vertex of a caster to the next; 0: 12.
  uint32_t vertexOffset = 0;  ///< Of its position, three floats.
};

enum class SkyMethod : uint32_t {
  Lut,        ///< From the sky-view LUT, which recordLuts updates. Orthographic cameras and solvers
              ///< without a LUT integrate, as do all but Moments above the top of the atmosphere.
  Integrate,  ///< Integrates or looks up along each pixel's ray; no LUT.
};

enum class AerialPerspective : uint32_t {
  Off,
  On,         ///< From the aerial-perspective LUT where Solver::Moments has one, else as Integrate.
  LutOnly,    ///< Unsupported in this version.
  Integrate,  ///< Integrates along each pixel's ray; no LUT.
};

enum class ColorSpace : uint32_t { Rec709, Rec2020, Xyz };  ///< Must be Rec709 in this version.

/// What the picture looks like. Everything named here stays the host's.
struct ViewDesc {
  VkFormat colorFormat = VK_FORMAT_UNDEFINED;       ///< Of the scope's colour attachment.
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;       ///< Of its depth attachment; with one, only far
                                                    ///< pixels are drawn by recordSky.
  VkFormat sceneDepthFormat = VK_FORMAT_UNDEFINED;  ///< Of FrameDesc::sceneDepth; 0: depthFormat.
  DepthConvention depth = DepthConvention::Standard;
  uint32_t samples = 0;  ///< MSAA of the scope: 1, 2, 4 ...; 0: 1. Aerial perspective needs 1.
  VkRenderPass renderPass = VK_NULL_HANDLE;  ///< Null: dynamic rendering.
  uint32_t subpass = 0;
  uint32_t viewMask = 0;  ///< Must be 0 in this version.
  Projection projection = Projection::Perspective;
  ColorSpace color = ColorSpace::Rec709;
  SkyMethod sky = SkyMethod::Lut;
  AerialPerspective aerialPerspective = AerialPerspective::Off;  ///< Not for fisheyes.
  /// Light shafts need aerial perspective and Solver::Moments.
  LightShaftDesc lightShafts;
  uint32_t skyLightDegree = 0;  ///< Must be 0 in this version, as the next three.
  uint32_t environmentSize = 0;
  uint32_t environmentLevels = 0;
  uint32_t environmentFlags = 0;
  /// Equirectangular albedo of the ground: u = 0 at longitude -180 degrees, v = 0 at the north
  /// pole; with a sampler (repeat in u, clamp in v, linear, with mip levels) and its extent; layout
  /// 0: SHADER_READ_ONLY_OPTIMAL. An sRGB image has an sRGB format. Null: the uniform albedo.
  HostImage groundAlbedo;
  /// Bits of kViewEffects, besides those that the tables lack: nothing of them is compiled, and a
  /// frame that would show them is refused by beginFrame.
  EffectFlags disabledEffects = 0;
  /// Must be 0 in this version: LUTs are reused only where they are exact.
  double lutTolerance = 0.0;
  uint32_t lutFrames = 0;  ///< Must be 0 or 1 in this version.
  /// Stages that read our LUTs and shadow map; 0: compute and fragment. Always includes what the
  /// view itself needs.
  VkPipelineStageFlags2 readerStages = 0;
};

/// Derives solver, effects and the LUTs' shapes from `tables`, which need not be baked, and makes
/// images and pipelines: the slow part. Any thread. The view survives resizes, and draws with other
/// tables of the same solver, MieStorage and effects, of any quality and size (Solver::Standard
/// with a sky-view LUT: of the same scatteringMu and scatteringNu).
ALPENGLOW_API Status createView(Context* context, const Tables* tables, const ViewDesc& desc,
                                View** out);

/// Deferred: freed once the frame being recorded has completed (advanceFrame). Null is ignored.
ALPENGLOW_API void destroyView(View* view);

/// For later versions: a host's shadow map, or the transmittance of clouds.
struct LightMap;

/// One light of a frame; of TableDesc::lights at the same index.
struct Light {
  /// Unit, world axes, towards the light. Zero: absent. Light 0 is required.
  double direction[3] = {};
  double discRadius = 0.0;  ///< Angular, radians; 0 draws no disc.
  double dimming = 0.0;     ///< Share of its light that is taken away, 0 to 1: an eclipse, a fade.
  double litFrom[3] = {};   ///< Must be 0 in this version, as the next two.
  const LightMap* shadowMap = nullptr;
  const LightMap* clouds = nullptr;
};

/// A pass in which the host draws its casters: pipeline, viewport and scissor are set.
struct CasterPass {
  uint32_t light = 0;
  LightShaftMethod method = LightShaftMethod::Off;  ///< ShadowVolume: draw with adjacency.
  VkExtent2D extent = {};
  double origin[3] = {};          ///< World units: subtract it in double.
  float clipFromOrigin[16] = {};  ///< Column-major; from world units off `origin`.
  const void* internal = nullptr;
};

/// For each of its casters calls placeCaster, then binds its vertices (binding 0, with stride and
/// offset of LightShaftDesc) and indices and draws. Binds no pipeline and no descriptor set.
using DrawCastersFn = void (*)(void* user, VkCommandBuffer commands, const CasterPass& pass);

struct Casters {
  Box bounds;                    ///< World. All casters lie in it, and the shadow map covers it.
  DrawCastersFn draw = nullptr;  ///< Called by recordShadowMap (ShadowVolume: by
                                 ///< recordLightShafts), on its thread. Null: nothing casts.
  void* user = nullptr;
  uint64_t version = 0;  ///< A new value whenever a caster has moved or changed: the shadow map is
                         ///< kept while it, the bounds and the light stay. 0: drawn each frame.
};

/// Everything about one frame. Read during beginFrame only, but for casters.draw and casters.user.
struct FrameDesc {
  const Tables* tables = nullptr;  ///< Ready; null: those of createView.
  World world;
  Camera cameras[kMaxCameras];  ///< Camera 0; the others must be absent in this version.
  Light lights[kMaxLights];     ///< Light 0; likewise.
  /// Factor on all radiance, so that night survives half floats; 0: 1.
  double radianceScale = 0.0;
  /// The host's opaque scene, for aerial perspective and light shafts: a view of the depth aspect,
  /// one sample a pixel, usage SAMPLED and DEPTH_STENCIL_ATTACHMENT; layout 0:
  /// DEPTH_STENCIL_READ_ONLY_OPTIMAL. Its writes are visible to fragment shader reads and early
  /// fragment tests when recordLightShafts or, without shafts, the rendering scope begins.
  HostImage sceneDepth;
  Casters casters;
  const float* horizon = nullptr;  ///< Must be null in this version.
  uint32_t horizonCount = 0;
};

/// Index of FrameWork::images. kViewSceneDepth is the host's own, in the state that it must have
/// from recordLightShafts to recordSky.
enum ViewImage : uint32_t {
  kViewSkyLut,     ///< Sky-view LUT: light that needs no phase function of aerosols.
  kViewSkyLutMie,  ///< Single scattering of aerosols, without their phase function.
  kViewAerialPerspectiveLut0,
  kViewAerialPerspectiveLut1,
  kViewAerialPerspectiveLut2,
  kViewShadowMap,
  kViewLightShafts,  ///< What shadows take from each pixel's ray; LightVolume and ShadowVolume.
  kViewSceneDepth,
  kViewImageCount
};

enum RecordFlag : uint32_t {
  kRecordLuts = 1u << 0,
  kRecordShadowMap = 1u << 1,
  kRecordLightShafts = 1u << 2,
  kRecordAerialPerspective = 1u << 3,
  kRecordSky = 1u << 4,
};
using RecordFlags = uint32_t;

/// What may be in view.
enum VisibilityFlag : uint32_t {
  kVisibleSky = 1u << 0,
  kVisibleGround = 1u << 1,  ///< The planet's own surface.
  kVisibleScene = 1u << 2,   ///< The host's opaque scene, in a depth image.
  kVisibleSpace = 1u << 3,   ///< Pixels whose rays meet no atmosphere.
  kVisibleSun = 1u << 4,     ///< The sun's disc.
};
using VisibilityFlags = uint32_t;

/// Descriptor sets of a view, in the order in which its own pipelines bind them; null: the
/// view has no such set.
enum ViewSet : uint32_t {
  kViewSetTables,             ///< alpenglow/atmosphere.glsl.
  kViewSetSky,                ///< Albedo map 0, sky-view LUT 1 and 2, scene depth 3.
  kViewSetAerialPerspective,  ///< Aerial-perspective LUT 0, 1, 2; for the library's own shaders.
  kViewSetLightShafts,        ///< alpenglow/light_shafts.glsl.
  kViewSetCount
};

/// What beginFrame fills in; all zero when it fails.
struct FrameWork {
  RecordFlags record = 0;       ///< The record functions that will record something this frame.
  VisibilityFlags visible = 0;  ///< Conservative; kVisibleScene with a scene depth.
  double altitude_m = 0.0;      ///< Of camera 0.
  /// On a surface that faces the light, at camera 0, in the shade of the planet alone:
  /// luminance-weighted `color` without radianceScale. 0 below the horizon.
  double illuminance[kMaxLights] = {};
  double color[kMaxLights][3] = {};  ///< The same as linear Rec.709, times radianceScale.
  VkDescriptorSet sets[kViewSetCount] = {};
  ImageInfo images[kViewImageCount];  ///< By ViewImage.
};

/// CPU only: fixes this frame for the view. Recreates what depends on the extent of the scene's
/// depth when that extent has changed. On failure the record functions of this frame record nothing
/// and return NotReady, so that one check suffices; NotReady also while the tables are not baked.
/// `work` may be null. A view may begin again within a frame: what was recorded before stays valid.
ALPENGLOW_API Status beginFrame(View* view, const FrameDesc& desc, FrameWork* work);

// The record functions return Ok without recording anything where the frame doesn't need it. They
// clobber pipelines, sets 0 to 3, push constants, viewport and scissor.

/// Outside rendering scopes: sky-view LUT and aerial-perspective LUT. One dispatch each.
ALPENGLOW_API Status recordLuts(View* view, VkCommandBuffer commands);
/// Outside rendering scopes: the shadow map.
ALPENGLOW_API Status recordShadowMap(View* view, VkCommandBuffer commands);
/// Outside rendering scopes, after the host has drawn its scene's depth: what the shadows take from
/// each pixel's ray.
ALPENGLOW_API Status recordLightShafts(View* view, VkCommandBuffer commands);
/// Inside the host's rendering scope: over every pixel of the viewport that the host's scene
/// covers, colour times transmittance plus inscattering. The host has drawn its opaque scene in
/// linear radiance times radianceScale; the scope's depth attachment, if any, is read-only.
ALPENGLOW_API Status recordAerialPerspective(View* view, VkCommandBuffer commands);
/// Inside the host's rendering scope: sky, sun disc and ground in the pixels that the scene leaves
/// free; before or after aerial perspective. At most 64 draws.
ALPENGLOW_API Status recordSky(View* view, VkCommandBuffer commands);

/// In DrawCastersFn: what is drawn next lies at origin + rotation p for local positions p, in world
/// units and axes. `rotation`: three rows, of determinant above 0 (a scale is welcome); null: none.
ALPENGLOW_API void placeCaster(const CasterPass& pass, VkCommandBuffer commands,
                               const double origin[3], const float rotation[9]);

/// What the host's own pipelines need.
struct ViewInfo {
  VkDescriptorSetLayout setLayouts[kViewSetCount] = {};  ///< Null: the view has no such set.
};
ALPENGLOW_API Status viewInfo(const View* view, ViewInfo* out);

}  // namespace v1_0
}  // namespace alpenglow
