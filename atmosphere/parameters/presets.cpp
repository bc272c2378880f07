// The atmospheres that have a name. Each says where its numbers come from; what was derived from a
// source, not read in it, is derived in the comment.
#include <alpenglow/parameters.h>

#include <cstring>

#include "atmosphere/parameters/sentence.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

static_assert(kSpectrumSize == 3, "The presets give values at 680, 550 and 440 nm.");

constexpr Spectrum kRedGreenBlue_nm = {{680.0, 550.0, 440.0}};

constexpr Spectrum grey(double value) { return {{value, value, value}}; }

constexpr Spectrum scaled(const Spectrum& spectrum, double factor) {
  return {{spectrum.value[0] * factor, spectrum.value[1] * factor, spectrum.value[2] * factor}};
}

/// The medium of Bruneton & Neyret 2008, section 2.1: Rayleigh as in their section 2.1, grey
/// aerosols with a scale height of 1.2 km and a single-scattering albedo of 0.9, no absorption.
constexpr Parameters paperEarth(double mieScattering_per_m, double asymmetry) {
  Parameters p;
  p.bottomRadius_m = 6360e3;
  p.topRadius_m = 6420e3;
  p.wavelengths_nm = kRedGreenBlue_nm;
  p.rayleigh = {true, {{5.8e-6, 13.5e-6, 33.1e-6}}, 8000.0};
  p.mie = {true, grey(mieScattering_per_m), grey(mieScattering_per_m / 0.9), 1200.0, asymmetry};
  p.groundAlbedo = grey(0.1);
  p.solarIrradiance = grey(1.0);
  return p;
}

/// The ozone layer: cross sections of Serdyuchenko et al. 2014 at these wavelengths, a column of
/// 300 Dobson units and the tent profile, as Bruneton's implementation of 2017 has them.
constexpr AbsorptionParameters ozone() {
  return {true, {{0.650e-6, 1.881e-6, 0.085e-6}}, 25e3, 15e3};
}

constexpr Parameters earth() {
  Parameters p = paperEarth(2e-5, 0.76);
  p.mie.extinction_per_m = grey(2.22e-5);
  p.absorption = ozone();
  return p;
}

constexpr Parameters earthClear() {
  Parameters p = earth();
  p.mie = {};
  return p;
}

/// OPAC's "continental polluted" mixture at 550 nm and 80 % humidity: extinction 0.1746 /km,
/// scattering 0.1558 /km, mean cosine 0.698, optical depth 0.327. The scale height is the one that
/// gives this optical depth. Cornette-Shanks has the mean cosine 3 g (4 + g^2) / (5 (2 + g^2)),
/// so 0.698 needs g = 0.635. Only 550 nm is published there, so it is grey.
constexpr Parameters earthHazy() {
  Parameters p = earth();
  p.mie = {true, grey(1.558e-4), grey(1.746e-4), 1870.0, 0.635};
  return p;
}

/// Mars under ordinary dust.
///
/// Gas: beta_R = sigma p / (k T) with CO2's measured cross section of 12.4e-31 m^2 at 532.24 nm
/// (Sneep & Ubachs 2005), as 1/lambda^4, at 610 Pa and 210 K; scale height 11.1 km.
///
/// Dust: optical depth 0.5 in red (0.4 to 0.6 at the Pathfinder site, Smith & Lemmon 1999), mixed
/// with the gas at the measured scale height of 11.56 km (Lemmon et al. 2004). Extinction falls
/// towards the blue as Q_ext of Ockert-Bell et al. 1997 does, by 0.963 at 550 and 0.917 at 440 nm.
/// Single-scattering albedo: Wolff et al. 2009's particles of 1.5 um have 0.73 at 388, 0.967 at
/// 650 and 0.975 at 700 nm; between them log(1 - albedo) is taken as linear: 0.972, 0.926, 0.822.
/// The measured mean cosine is 0.685 at 650 nm (Chen-Chen et al. 2019), so g = 0.62, see earthHazy.
///
/// One g for all colours is what MieParameters holds. The true forward peak is narrower and
/// brighter in the blue, which makes the blue glow around a setting sun (Ehlers et al. 2014). That
/// part is missing here; the bluish low sun, from the smaller extinction in the blue, is there.
constexpr Parameters mars() {
  constexpr double kGasPerCubicMetre = 610.0 / (1.380649e-23 * 210.0);
  constexpr double kGas_per_m = 12.4e-31 * kGasPerCubicMetre;
  constexpr double kDust_per_m = 0.5 / 11560.0;
  constexpr auto fourthPower = [](double x) { return x * x * x * x; };

  Parameters p;
  p.bottomRadius_m = 3389.5e3;
  p.topRadius_m = 3489.5e3;
  p.wavelengths_nm = kRedGreenBlue_nm;
  p.rayleigh = {true,
                scaled({{fourthPower(532.24 / 680.0), fourthPower(532.24 / 550.0),
                         fourthPower(532.24 / 440.0)}},
                       kGas_per_m),
                11100.0};
  p.mie = {true, scaled({{1.0 * 0.972, 0.963 * 0.926, 0.917 * 0.822}}, kDust_per_m),
           scaled({{1.0, 0.963, 0.917}}, kDust_per_m), 11560.0, 0.62};
  // The planet's geometric albedos in R, V and B (Mallama 2007), rounded.
  p.groundAlbedo = {{0.25, 0.17, 0.09}};
  p.solarIrradiance = grey(1.0);
  return p;
}

constexpr Preset kPresets[] = {
    {"earth",
     "Bruneton & Neyret 2008, Precomputed Atmospheric Scattering, section 2.1 and figure 6, with "
     "the ozone layer of Bruneton 2017 (Precomputed Atmospheric Scattering: a New Implementation; "
     "cross sections of Serdyuchenko et al. 2014)",
     "Earth with ozone; the default", earth()},
    {"earth-fig6",
     "Bruneton & Neyret 2008, Precomputed Atmospheric Scattering, section 2.1 and figure 6",
     "Earth of the paper's figure 6: beta_M 2e-5 per m, g 0.76, no ozone", paperEarth(2e-5, 0.76)},
    {"earth-fig7",
     "Bruneton & Neyret 2008, Precomputed Atmospheric Scattering, section 2.1 and figure 7",
     "Earth of the paper's figure 7: beta_M 2.2e-5 per m, g 0.73, no ozone",
     paperEarth(2.2e-5, 0.73)},
    {"earth-clear",
     "As earth, without aerosols: Bruneton & Neyret 2008, section 2.1, and Bruneton 2017",
     "Earth with ozone and no aerosols", earthClear()},
    {"earth-hazy",
     "As earth, with the aerosols of Hess, Koepke & Schult 1998, Optical Properties of Aerosols "
     "and Clouds (OPAC), BAMS 79, table 4: continental polluted, 550 nm, 80 % humidity",
     "Earth with ozone under polluted continental haze, optical depth 0.33", earthHazy()},
    {"mars",
     "Dust: Smith & Lemmon 1999 (JGR 104, 8975), Lemmon et al. 2004 (Science 306, 1753), "
     "Ockert-Bell et al. 1997 (JGR 102, 9039), Wolff et al. 2009 (JGR 114, E00D04), Chen-Chen et "
     "al. 2019 (Icarus 330, 16); CO2: Sneep & Ubachs 2005 (JQSRT 92, 293); ground: Mallama 2007 "
     "(Icarus 192, 404)",
     "Mars under ordinary dust, optical depth 0.5", mars()},
};

constexpr uint32_t kPresetCount = static_cast<uint32_t>(sizeof(kPresets) / sizeof(kPresets[0]));

}  // namespace

const Preset* presets(uint32_t* count) {
  if (count != nullptr) *count = kPresetCount;
  return kPresets;
}

Status findPreset(const char* name, Parameters* out, const DiagnosticSink& sink) {
  if (out == nullptr) return parameters::reportNull(sink, "findPreset", "the parameters");
  for (const Preset& preset : kPresets) {
    if (name == nullptr || std::strcmp(preset.name, name) != 0) continue;
    *out = preset.parameters;
    return Status::Ok;
  }
  parameters::Sentence why;
  if (name == nullptr) {
    why << "findPreset got no name";
  } else {
    // A list of the names must follow in any case.
    char shown[64];
    (parameters::Sentence() << name).copyTo(shown, sizeof shown);
    why << "There is no preset named \"" << shown << "\"";
  }
  why << "; these exist: ";
  for (const Preset& preset : kPresets) why << (&preset == kPresets ? "" : ", ") << preset.name;
  return parameters::report(sink, Status::InvalidArgument, why << ".");
}

}  // namespace v1_0
}  // namespace alpenglow
