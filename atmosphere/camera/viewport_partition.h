// The viewport of a frame, cut into parts by what their pixels may see, so that each is drawn by
// the cheapest pipeline: pixels of sky cost no ground, pixels of space no atmosphere.
#pragma once

#include "atmosphere/camera/picture.h"

#include <array>
#include <iterator>

#include "atmosphere/camera/camera_math.h"

namespace alpenglow::passes {

struct Visible {
  bool atmosphere = true;
  bool ground = true;  ///< Never without the atmosphere.
  bool disc = true;
  bool operator==(const Visible&) const = default;
};

/// All combinations that occur, and a number for each.
inline constexpr Visible kCombinations[] = {{false, false, false}, {true, false, false},
                                            {true, true, false},   {false, false, true},
                                            {true, false, true},   {true, true, true}};
inline constexpr uint32_t kVariants = std::size(kCombinations);
constexpr uint32_t variant(const Visible& v) {
  return (v.atmosphere ? v.ground ? 2u : 1u : 0u) + (v.disc ? 3u : 0u);
}

/// Whether a view with these disabled effects draws such pixels.
constexpr bool drawn(EffectFlags disabledEffects, const Visible& v) {
  return (v.atmosphere || hasEffect(disabledEffects, Effect::SpaceViews)) &&
         (!v.ground || hasEffect(disabledEffects, Effect::Ground)) &&
         (!v.disc || hasEffect(disabledEffects, Effect::SunDisc));
}

/// What an area of the viewport may show; `area` counts from the viewport's corner. Conservative,
/// from cones around its rays, the planet, the atmosphere and the sun.
Visible visible(const Parameters& parameters, const PictureDesc& desc, const FrameState& draw,
                const VkRect2D& area);

struct Part {
  VkRect2D area;  ///< Counted from the viewport's corner.
  Visible visible;
};

/// Parts that cover the viewport without overlap; one for an orthographic camera, which
/// may see anything but the sun's disc.
struct ViewportPartition {
  static constexpr uint32_t kSide = 8;  ///< Most columns and rows.
  std::array<Part, kSide * kSide> parts;
  uint32_t count = 0;
};
ViewportPartition cut(const Parameters& parameters, const PictureDesc& desc,
                      const FrameState& draw);

/// The camera's unit vector to the right.
std::array<double, 3> cameraRight(const EyeCamera& camera);

/// Width and height, and the lesser of them, in pixels.
struct ViewportSize {
  double width, height, least;
};
ViewportSize viewportSize(const FrameState& draw);
/// Size of a pixel at the centre of the view: radians; orthographic: metres.
double pixelAngle(const PictureDesc& desc, const FrameState& draw);

}  // namespace alpenglow::passes
