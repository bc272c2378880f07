// The night sky of a host's scene: the stars of the Hipparcos catalogue that an eye can see, each a
// point of its brightness times transmittance, hidden by the ground. They are drawn after the sky
// and before what is blended over it.
#pragma once

#include <alpenglow/view.h>

#include <span>
#include <vector>

#include "common/gpu.h"

namespace alpenglow::samples {

/// At the epoch of the catalogue, J1991.25; radians.
struct Star {
  double magnitude = 0.0;  ///< Johnson's V.
  double rightAscension = 0.0;
  double declination = 0.0;
};

/// All of them, the brightest first.
std::vector<Star> starCatalogue();

/// Irradiance over the sun's, which is a star of magnitude -26.74. They all have its colour here:
/// the catalogue knows no other.
double shareOfSun(const Star& star);

/// Unit vector towards a star in the planet's frame, at this sidereal time of longitude 0.
void starDirection(const Star& star, double siderealHours, double direction[3]);

struct StarsDesc {
  const Tables* tables = nullptr;  ///< On the context of those that it will draw with.
  VkFormat colorFormat = VK_FORMAT_UNDEFINED;
  /// With depth (reversed, 0 infinitely far), only pixels without anything in them get light.
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;
  Projection projection = Projection::Perspective;  ///< As the view's.
  Solver solver = Solver::Moments;                  ///< As the tables that will be drawn with.
};

class Stars {
 public:
  /// `gpu` outlives it. Throws an Error.
  Stars(const Gpu* gpu, const StarsDesc& desc);

  /// Adds their light to linear radiance, inside a rendering scope, behind everything. Parallel
  /// rays of an orthographic camera see none. Clobbers what recordSky does.
  void record(VkCommandBuffer commands, const Parameters& parameters, const Tables* tables,
              const FrameDesc& draw, double siderealHours) const;

 private:
  const Gpu* gpu_;
  Projection projection_;
  uint32_t count_ = 0;
  headless::HostBuffer vertices_;
  Owned<VkPipelineLayout> layout_;
  Owned<VkPipeline> pipeline_;
};

}  // namespace alpenglow::samples
