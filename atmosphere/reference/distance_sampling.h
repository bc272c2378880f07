// Samples where along a ray the next event lies, guided by a rough solution of the light there.
#pragma once

#include "atmosphere/reference/light_guide.h"
#include "atmosphere/reference/ray_nodes.h"

namespace alpenglow::reference {

struct DistanceSample {
  double t = 0.0;
  double density = 1.0;  ///< Per metre in the atmosphere, a probability on a surface.
};

/// What a ray ends on.
struct EndSurface {
  const physics_f64::Spectrum* albedo = nullptr;  ///< Null for none.
  /// Of a mesh, altitude and the cosine between its normal and the sun; the ground's are the ray's.
  bool isMesh = false;
  double h = 0.0;
  double cosSun = 0.0;
};

/// The density is linear between a ray's nodes. One part of it ignores the guide, and a small
/// part also the densities, so that every point of the ray may be drawn.
class DistanceSampling {
 public:
  /// `counts`: what light of each channel, before this ray, counts for. `direct`: sunlight that
  /// scatters at the event counts too. `surface`: what the ray ends on.
  DistanceSampling(const Medium& medium, const LightGuide& guide, const RaySegment& segment,
                   double muS, double nu, const physics_f64::Spectrum& counts, bool direct,
                   const EndSurface& surface);

  /// False where nothing can come from along the ray.
  bool possible() const { return possible_; }
  double surfaceProbability() const { return surfaceProbability_; }
  /// `share`: the probability of an event in the atmosphere, which multiplies the density.
  DistanceSample sample(double u, double share) const;

  /// A rough value of the light of all orders after the first, scattered along a segment.
  static physics_f64::Spectrum lightAlong(const Medium& medium, const LightGuide& guide,
                                          const RaySegment& segment, double muS, double nu);

 private:
  static constexpr size_t kMost = 3 * RayNodes::kFine + 2;

  RayNodes nodes_;
  std::array<double, kMost> weights_{};
  std::array<double, kMost> sums_{};  ///< Integral of the weights up to each node.
  double surfaceProbability_ = 0.0;
  bool possible_ = false;
};

}  // namespace alpenglow::reference
