// Point queries of ready tables: on the device, evaluated by the functions that the sky is drawn
// with, or on the CPU, so that a host can tint its lights and fog without waiting for a frame.
#pragma once

#include <alpenglow/tables.h>

namespace alpenglow {
inline namespace v1_0 {

enum class QueryKind : uint32_t {
  Ray,         ///< Light along a ray of an observer.
  Irradiance,  ///< Light on a horizontal surface that faces upwards.
};

/// Angles in radians, about the observer's vertical. For an irradiance, the members of a ray must
/// be 0.
struct ProbeQuery {
  QueryKind kind = QueryKind::Ray;
  uint32_t light = 0;  ///< Index of TableDesc::lights. Must be 0 in this version.
  double altitude_m = 0.0;
  double sunZenith = 0.0;
  double zenith = 0.0;      ///< Of the ray. Irradiance: of the surface's normal; must be 0 in this
                            ///< version.
  double azimuth = 0.0;     ///< Between the ray and the sun.
  bool bounded = false;     ///< The segment ends at distance_m; else at the ground or the top.
  double distance_m = 0.0;  ///< Must be 0 unless bounded.
};

/// Per unit solar irradiance. Zero where the query's kind has no such field.
struct ProbeAnswer {
  bool hitsGround = false;
  Spectrum transmittance;
  Spectrum skyRadiance;     ///< Light scattered in the atmosphere along the segment.
  Spectrum groundRadiance;  ///< Light reflected by the uniform ground, times transmittance.
  Spectrum direct;          ///< Irradiance of the sun.
  Spectrum sky;             ///< Irradiance of the sky without the sun.
};

/// Bytes that recordProbe writes for each query, as std430 in the shader.
inline constexpr VkDeviceSize kProbeAnswerBytes = 64;

/// Records the evaluation of `count` queries, outside rendering scopes; the raw answers go to
/// `buffer` (usage STORAGE and host-visible or copied by the host), kProbeAnswerBytes each, from
/// offset 0, and are made visible to host reads and transfers. The geometry is computed in double
/// on the CPU during the call. NotReady until the tables are Recorded; InvalidArgument with a
/// sentence that names the query by its index and the field.
ALPENGLOW_API Status recordProbe(const Tables* tables, VkCommandBuffer commands,
                                 const ProbeQuery* queries, uint32_t count, VkBuffer buffer);

/// Turns what recordProbe wrote, read back after the GPU finished, into plain answers. With null
/// `deviceAnswers` they are computed on the calling thread, in float, from the host copies of
/// TableDesc::cpuQueries, with the functions that recordProbe runs: they differ from the
/// device's by rounding and by the precision of its mathematical functions and filter. On lavapipe
/// they agree within 1.4e-5 of the value (api_tests --gtest_filter=QueryTest.TheCpu*); a GPU whose
/// filter has 8-bit weights is coarser than the CPU. Then NotReady until the tables are Complete,
/// InvalidArgument for tables that keep no copies and Unsupported for other solvers than Moments;
/// with CpuQueries::Light, rays are answered with skyRadiance 0. On failure no answer is written.
/// Any number of threads may ask the same tables while no other call changes them.
ALPENGLOW_API Status answerQueries(const Tables* tables, const ProbeQuery* queries, uint32_t count,
                                   const void* deviceAnswers, ProbeAnswer* answers);

}  // namespace v1_0
}  // namespace alpenglow
