// Light shafts: shadows of a host's casters in the air. Single scattering loses its light there.
#pragma once

#include <alpenglow/mesh.h>
#include <alpenglow/view.h>

namespace alpenglow {
inline namespace v1 {

enum class ShaftMethod : uint32_t {
  Exact,  ///< The surface between light and shadow, a relief over the map from the sun: where a ray
          ///< passes it, the light of all that lies before is added or taken away. Any number of
          ///< lit stretches, without samples along the ray; exact but for the map's texels. Single
          ///< scattering loses its light, multiple is dimmed. Any casters. docs/shafts.md.
  Paper,  ///< Shadow volumes and one length a pixel, as Bruneton & Neyret 2008, section 5: closed
          ///< casters with adjacency, kCapabilityShadowVolumes; all orders of scattering lose their
          ///< light.
  March,  ///< Samples of the map from the sun along each ray; else as Exact.
};

struct ShaftsDesc {
  ShaftMethod method = ShaftMethod::Exact;
  SceneDepth sceneDepth;  ///< Of the host's opaque scene; attached read-only by recordShafts.
  DepthConvention depth = DepthConvention::Standard;
  Projection projection = Projection::Perspective;  ///< Not a fisheye.
  uint32_t sunMapSize = 0;  ///< Texels on a side of the map from the sun; 0: 2048.
  /// Vertices along a side of the relief over it (Exact), at most sunMapSize; 0: 1024. What is
  /// between them serves surfaces (alpenglowSunlit).
  uint32_t reliefSize = 0;
  uint32_t samples = 0;  ///< Of March, for each ray; 0: 32.
  /// Share of multiple scattering that a ray loses when it loses all of its single scattering, in
  /// (0, 1]; 0: 0.7, the nearest to path-traced mountains (docs/shafts.md); below 0: none. Not
  /// Paper.
  double multipleLoss = 0.0;
  EffectFlags without = 0;    ///< As ViewDesc::without of the view that draws them.
  uint32_t vertexStride = 0;  ///< Bytes from one vertex of a caster to the next; 0: 12.
  uint32_t vertexOffset = 0;  ///< Of its position, three floats.
  bool closed = false;  ///< Casters are closed surfaces, counter-clockwise seen from outside: the
                        ///< map from the sun then leaves out what faces away from it.
  bool adjacency = false;  ///< Casters are triangles with adjacency (alpenglow/mesh.h), else plain
                           ///< triangles. Paper needs it.
};

/// A pass in which the host draws its casters. Pipeline, viewport and scissor are set.
struct CasterPass;

/// Places what the next draws of this pass draw: local position p lies at origin_m + rotation p,
/// in the planet's frame. `rotation`: three rows, of determinant above 0 (a scale is welcome);
/// null: none.
ALPENGLOW_API void placeCaster(const CasterPass* pass, const double origin_m[3],
                               const float rotation[9]);

/// For each of its casters calls placeCaster, then binds its vertices (binding 0, with stride and
/// offset of ShaftsDesc) and indices and draws. Called inside recordSunMap and, with Paper,
/// recordShafts; binds no pipeline and no descriptor set.
using DrawCastersFn = void (*)(void* user, VkCommandBuffer commands, const CasterPass* pass);

struct Casters {
  Box bounds;  ///< All casters lie in it; the map from the sun covers it.
  DrawCastersFn draw = nullptr;
  void* user = nullptr;
};

/// Checks the description and makes targets and pipelines; nothing of a method that isn't chosen.
ALPENGLOW_API Status createShafts(Context* context, const ShaftsDesc& desc, Shafts** out);
/// Frees them once `frame.completed` of a later call reaches `frame.submitting`; after their views.
ALPENGLOW_API void destroyShafts(Shafts* shafts, const FrameInfo& frame);

/// Records, outside any rendering scope, the map from the sun: one draw of the casters. Needed when
/// the sun or a caster has moved; else the last one serves. Exact and March. Clobbers: pipelines,
/// sets 0 to 2, push constants, viewport, scissor.
ALPENGLOW_API Status recordSunMap(Shafts* shafts, VkCommandBuffer commands, const FrameInfo& frame,
                                  const double sunDirection[3], const Casters& casters);

/// Records, outside any rendering scope, the shadows of this draw's camera, after the host's scene
/// has been drawn into the depth image: the view's recordSky and recordAir of the same draw then
/// read them. Exact and March: after recordSunMap for the same sun, to the last bit. Exact looks
/// light up if the view has recorded a sky slice for this draw, else it integrates. Clobbers as
/// recordSunMap.
ALPENGLOW_API Status recordShafts(Shafts* shafts, View* view, VkCommandBuffer commands,
                                  const FrameInfo& frame, const Tables* tables, const SkyDraw& draw,
                                  const Casters& casters);

/// Binding table of shaftSet, for the host's own fragment shaders that include
/// alpenglow/shafts.glsl: alpenglowSunlit() tells whether the surface in a pixel sees the sun.
/// Filled by recordShafts.
ALPENGLOW_API VkDescriptorSetLayout shaftSetLayout(const Shafts* shafts);
ALPENGLOW_API VkDescriptorSet shaftSet(const Shafts* shafts);

}  // namespace v1
}  // namespace alpenglow
