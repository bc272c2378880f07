// What exact shadow intervals in double say about the pixels of a picture. A shadow map knows
// where a shadow ends to a texel, so each answer is a band: of shadows that are shrunk and grown by
// a texel and a half.
#pragma once

#include <optional>

#include "tests/passes/light_shafts/light_shaft_fixture.h"

namespace alpenglow::testing {

/// A scene of casters, in local coordinates (up, east, north), and its camera.
struct ShadowScene {
  const char* name = "";
  std::vector<reference::test::Mesh> casters;
  Vec camera = {50, 0, 0};
  double heading = 90.0, pitch = 10.0, fov = 60.0;
  double sunElevation = 40.0, sunAzimuth = 180.0;
};

/// The scenes that every method is tested with: shadow_scenes.cpp.
std::vector<ShadowScene> shadowScenes();
/// Closed, bumpy, overlapping; the same for the same seed.
ShadowScene randomScene(uint32_t seed);
/// Hills 30 km wide, closed below, seen from close above them.
ShadowScene hillScene(double sunAzimuth);

/// A ray's shadows in three versions: those common to all neighbours, its own, and those of any
/// neighbour.
struct ShadowBand {
  reference::SceneRay ray;
  double length = 0.0;  ///< Metres to what ends the ray.
  bool onMesh = false;  ///< Else ground or space.
  bool atEdge = false;  ///< Next to an edge of what the camera sees.
  std::vector<reference::RayInterval> least, middle, most;
};
double lengthOf(const std::vector<reference::RayInterval>& intervals);

class ShadowCheckTest : public LightShaftTest {
 protected:
  static constexpr VkExtent2D kExtent = {48, 32};

  FrameState stage(const ShadowScene& scene);
  bool startsInShadow(const FrameState& draw);
  /// Metres of a texel of the shadow map, the greater side.
  double texel(const LightShaftSetup& setup, const FrameState& draw) const;
  /// Shadows displaced by up to `slack` metres about a pixel's ray.
  ShadowBand band(const LightShaftSetup& setup, const FrameState& draw, uint32_t x, uint32_t y,
                  double slack);
  /// Whether the surface at the end of a ray is in another's shadow: nothing where it faces away
  /// from the sun, or within `slack` metres of the shadow's edge.
  std::optional<bool> surfaceInShadow(const ShadowBand& band, double slack);
  /// Light that shadows remove from each pixel, channel 1.
  std::vector<double> losses(LightShaftSetup setup, const FrameState& draw, LightShaftPicture* with,
                             LightShaftPicture* unshadowed);
};

}  // namespace alpenglow::testing
