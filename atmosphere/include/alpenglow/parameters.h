// What an atmosphere is made of: the parameters of the medium and the planet, with units, presets
// and a validator. Plain doubles; nothing here needs Vulkan.
#pragma once

#include <alpenglow/types.h>

namespace alpenglow {
inline namespace v1_0 {

/// Wavelengths baked together: one group fits the colour channels of a texture. The number is
/// defined here and, for the shaders, in the type Spectrum of physics/types.glsl.
inline constexpr uint32_t kSpectrumSize = 3;

/// One value for each wavelength of a group, in the order of Parameters::wavelengths_nm.
struct Spectrum {
  double value[kSpectrumSize] = {};
  double& operator[](uint32_t i) { return value[i]; }
  const double& operator[](uint32_t i) const { return value[i]; }
};

/// Air molecules. Density exp(-h / scaleHeight) up to the top; phase 3/(16 pi) (1 + nu^2).
struct RayleighParameters {
  bool present = false;       ///< false: no such molecules, the other fields are ignored.
  Spectrum scattering_per_m;  ///< beta_R at h = 0; extinction equals scattering.
  double scaleHeight_m = 0.0;
};

/// Aerosols. Density exp(-h / scaleHeight); Cornette-Shanks phase function with asymmetry g.
struct MieParameters {
  bool present = false;
  Spectrum scattering_per_m;  ///< beta_M at h = 0.
  Spectrum extinction_per_m;  ///< At least the scattering, in each wavelength.
  double scaleHeight_m = 0.0;
  double asymmetry = 0.0;  ///< g in (-1, 1).
};

/// A layer that only absorbs (ozone): density max(0, 1 - |h - center| / halfWidth).
struct AbsorptionParameters {
  bool present = false;
  Spectrum extinction_per_m;  ///< At the center of the tent.
  double center_m = 0.0;
  double halfWidth_m = 0.0;
};

/// A planet with its atmosphere. Lengths in metres, coefficients per metre, angles in radians.
struct Parameters {
  double bottomRadius_m = 0.0;  ///< Rg, the ground sphere.
  double topRadius_m = 0.0;     ///< Rt, above which there is nothing.
  Spectrum wavelengths_nm;      ///< Labels of the channels.
  RayleighParameters rayleigh;
  MieParameters mie;
  AbsorptionParameters absorption;
  Spectrum groundAlbedo;          ///< Uniform Lambertian ground, each in [0, 1].
  Spectrum solarIrradiance;       ///< At the top of the atmosphere, on a surface facing the sun.
  double sunAngularRadius = 0.0;  ///< Softens the terminator only; 0: a parallel beam.
};

/// A preset: static strings and values.
struct Preset {
  const char* name = nullptr;
  const char* source = nullptr;
  const char* description = nullptr;  ///< One line for lists.
  Parameters parameters;
};

/// All presets, static. `count` may be null.
ALPENGLOW_API const Preset* presets(uint32_t* count);

/// Fills `out` with the preset called `name`. InvalidArgument, with a sentence that lists the
/// names, when there is none.
ALPENGLOW_API Status findPreset(const char* name, Parameters* out, const DiagnosticSink& sink);

/// Checks every field. InvalidArgument with one sentence that names the field as atmosphere files
/// spell it, the value given and what is allowed. Thread-safe.
ALPENGLOW_API Status validate(const Parameters& parameters, const DiagnosticSink& sink);

}  // namespace v1_0
}  // namespace alpenglow
