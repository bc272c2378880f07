// A picture and a frame as the passes use them: resolved, in the planet frame, in metres. View
// makes them from ViewDesc and FrameDesc.
#pragma once

#include <alpenglow/view.h>

namespace alpenglow {

/// In the planet frame: origin at the centre, z to the north pole, x to latitude 0, longitude 0.
struct EyeCamera {
  double position_m[3] = {};
  double forward[3] = {};
  double up[3] = {};
  double fov = 0.0;
  double height_m = 0.0;  ///< Orthographic.
};

struct SunState {
  double direction[3] = {};
  Spectrum irradiance;  ///< At the top of the atmosphere.
  double discRadius = 0.0;
};

/// Distances along EyeCamera::forward; far_m 0: infinitely far.
struct DepthRange {
  double near_m = 0.0;
  double far_m = 0.0;
};

struct FrameState {
  EyeCamera camera;
  SunState sun;
  double radianceScale = 0.0;  ///< 0 means 1.
  VkRect2D viewport = {};
  DepthRange depth;
};

/// ViewDesc with its zeros replaced, and with properties of the tables.
struct PictureDesc {
  VkFormat colorFormat = VK_FORMAT_UNDEFINED;
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;
  VkFormat sceneDepthFormat = VK_FORMAT_UNDEFINED;
  DepthConvention depth = DepthConvention::Standard;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkRenderPass renderPass = VK_NULL_HANDLE;
  uint32_t subpass = 0;
  Projection projection = Projection::Perspective;
  Solver solver = Solver::Moments;
  MieStorage mie = MieStorage::Full;
  HostImage groundAlbedo;
  EffectFlags disabledEffects = 0;
  bool skyLut = false;     ///< There is a sky-view LUT ...
  bool onlyLut = false;    ///< ... for every frame, so that nothing else need be compiled.
  bool aerial = false;     ///< Aerial perspective ...
  bool aerialLut = false;  ///< ... from its LUT.
};

/// LightShaftDesc with its zeros replaced, and with properties of the picture.
struct LightShaftSettings : LightShaftDesc {
  VkFormat sceneDepthFormat = VK_FORMAT_UNDEFINED;
  DepthConvention depth = DepthConvention::Standard;
  Projection projection = Projection::Perspective;
  EffectFlags disabledEffects = 0;
};

/// A box in the planet frame.
struct PlanetBox {
  double center_m[3] = {};
  double halfAxes_m[3][3] = {};  ///< Three orthogonal vectors from the centre to the faces.
};

/// Casters of a frame.
struct CasterSet {
  PlanetBox bounds;
  World world;  ///< In which the host places the casters.
  DrawCastersFn draw = nullptr;
  void* user = nullptr;
  uint64_t version = 0;
  bool lit = true;  ///< Sunlight reaches them: passes::sunReaches.
  bool* outsideReported =
      nullptr;  ///< The view's flag: a caster far outside `bounds` was reported.
};

/// A camera above a point of the planet. Angles in radians; altitudes below 0 count as 0.
EyeCamera cameraFromGeodetic(const Parameters& parameters, double latitude, double longitude,
                             double altitude_m, double heading, double pitch, double roll,
                             double fov);
/// Unit vector towards a sun at these angles about the local vertical.
void sunDirection(double latitude, double longitude, double elevation, double azimuth,
                  double direction[3]);

}  // namespace alpenglow
