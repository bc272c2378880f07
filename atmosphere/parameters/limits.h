// The magnitudes that the validator accepts. They keep single precision on the GPU free of overflow
// and cancellation; every known planet and atmosphere is far within.
#pragma once

namespace alpenglow::parameters {

/// Squares of radii reach 1e18, products of two squares 1e36: just inside single precision.
inline constexpr double kMinRadius_m = 1e3;
inline constexpr double kMaxRadius_m = 1e9;
/// From the ground to the top. Single precision can't resolve altitudes in a thinner atmosphere.
inline constexpr double kMinThickness_m = 1.0;
/// Of scale heights, and of the absorption layer's altitude and half width.
inline constexpr double kMinLength_m = 1.0;
inline constexpr double kMaxLength_m = 1e8;
/// Of scattering and extinction: an optical depth of one in one metre.
inline constexpr double kMaxCoefficient_per_m = 1.0;
/// The forward peak of Cornette-Shanks holds (1 - |g|)^-2, which is 1e6 here.
inline constexpr double kMaxAsymmetry = 0.999;
inline constexpr double kMaxWavelength_nm = 1e6;
inline constexpr double kMaxIrradiance = 1e9;
/// The terminator treats the horizon as straight across the sun's disc.
inline constexpr double kMaxSunAngularRadius_deg = 10.0;

}  // namespace alpenglow::parameters
