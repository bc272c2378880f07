// Optical depth along rays in double, by adaptive quadrature of the physics' extinction.
#pragma once

#include "atmosphere/parameters/physics_cpp.h"
#include "atmosphere/reference/quadrature.h"

namespace alpenglow::reference {

using physics_f64::Medium;
using SpectrumIntegral = Integral<kSpectrumSize>;

/// A segment of a ray from a point at altitude `h` in direction `mu`, inside the atmosphere.
struct RaySegment {
  double h = 0.0;
  double mu = 1.0;
  double length = 0.0;
};

/// A part of a ray, in metres from where it starts.
struct RayInterval {
  double from = 0.0;
  double to = 0.0;
};

/// Distances from 0 to the segment's length between which the densities are smooth and vary on one
/// scale: the perigee, the altitudes where the absorption tent bends, and altitudes that grow by
/// scale heights from the segment's lowest point. Sorted, ends included.
std::vector<double> smoothBreaks(const Medium& medium, const RaySegment& segment);

/// Sorts, and drops what lies outside [0, length] or closer together than rounding. Keeps the ends.
void tidyBreaks(std::vector<double>& breaks, double length);

/// Optical depth from distance t0 to t1 of the segment's ray, with no break between.
SpectrumIntegral opticalDepthBetween(const Medium& medium, const RaySegment& segment, double t0,
                                     double t1, const Tolerance& tolerance);

/// Optical depth of the whole segment.
SpectrumIntegral opticalDepth(const Medium& medium, const RaySegment& segment,
                              const Tolerance& tolerance);

/// Optical depth from a point towards the top; a direction below the horizon answers for the
/// horizon, as light of a partly hidden sun does.
SpectrumIntegral opticalDepthToTop(const Medium& medium, double h, double mu,
                                   const Tolerance& tolerance);

}  // namespace alpenglow::reference
