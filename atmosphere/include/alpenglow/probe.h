// Point queries of the tables, evaluated on the device by the functions that the sky is drawn with.
#pragma once

#include <alpenglow/tables.h>

namespace alpenglow {
inline namespace v1 {

/// A ray of an observer, or the light on a horizontal surface. Angles in radians.
struct ProbeQuery {
  bool irradiance = false;  ///< Ask for light on an upward-facing horizontal surface.
  double altitude_m = 0.0;
  double viewZenith = 0.0;
  double sunZenith = 0.0;
  double azimuth = 0.0;      ///< Between view and sun, about the observer's vertical.
  double distance_m = -1.0;  ///< Negative: to the ground or the top.
};

/// Per unit solar irradiance. Zero where the query's kind has no such field.
struct ProbeAnswer {
  bool hitsGround = false;
  Spectrum transmittance;
  Spectrum skyRadiance;     ///< Light scattered in the air along the segment.
  Spectrum groundRadiance;  ///< Light reflected by the uniform ground, dimmed on the way.
  Spectrum direct;          ///< Irradiance of the sun.
  Spectrum sky;             ///< Irradiance of the sky without the sun.
};

/// What recordProbe writes for one query, as std430 in the shader.
inline constexpr VkDeviceSize kProbeAnswerBytes = 64;

/// Records the evaluation of `count` queries; the raw answers go to `buffer` (usage STORAGE and
/// host-visible or copied by the host), kProbeAnswerBytes each, from offset 0, and are made visible
/// to host reads. Geometry is taken in double on the CPU, now. `tables` must be ready.
ALPENGLOW_API Status recordProbe(Context* context, const Tables* tables, VkCommandBuffer commands,
                                 const FrameInfo& frame, const ProbeQuery* queries, uint32_t count,
                                 VkBuffer buffer);

/// Turns the raw answers of recordProbe, read back after the GPU finished, into plain ones.
ALPENGLOW_API Status readProbe(const Tables* tables, const ProbeQuery* queries, uint32_t count,
                               const void* raw, ProbeAnswer* answers);

}  // namespace v1
}  // namespace alpenglow
