#include <alpenglow/parameters.h>

#include <cmath>
#include <numbers>

#include "atmosphere/parameters/limits.h"
#include "atmosphere/parameters/sentence.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

using namespace parameters;

/// The field as atmosphere files spell it: "mie.extinction_per_m[1]", or no index.
struct Field {
  const char* name;
  int index = -1;
};

Sentence& operator<<(Sentence& sentence, const Field& field) {
  sentence << field.name;
  if (field.index >= 0) {
    const char brackets[] = {'[', static_cast<char>('0' + field.index), ']', '\0'};
    sentence << brackets;
  }
  return sentence;
}
static_assert(kSpectrumSize <= 10, "An index is written as one digit.");

/// Remembers the first field that is wrong and lets all later checks pass.
class Checker {
 public:
  bool failed() const { return failed_; }
  const Sentence& sentence() const { return sentence_; }

  /// `value` must lie in [low, high]; NaN does not.
  void inRange(const Field& field, double value, double low, double high, const char* unit = "") {
    if (!failed_ && !(value >= low && value <= high)) {
      start(field, value) << "a number from " << low << " to " << high << unit << ".";
    }
  }
  void positive(const Field& field, double value, double high, const char* unit) {
    if (!failed_ && !(value > 0.0 && value <= high)) {
      start(field, value) << "a number above 0 and at most " << high << unit << ".";
    }
  }
  /// `value` must be at least the `other` field's value, and at most `high`.
  void atLeast(const Field& field, double value, const Field& otherField, double other, double high,
               const char* unit) {
    if (!failed_ && !(value >= other && value <= high)) {
      start(field, value) << "at least " << otherField << ", which is " << other << ", and at most "
                          << high << unit << ".";
    }
  }
  void spectrumInRange(const char* name, const Spectrum& spectrum, double low, double high,
                       const char* unit = "") {
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      inRange({name, static_cast<int>(i)}, spectrum[i], low, high, unit);
    }
  }
  /// The sentence up to "must be "; the caller ends it.
  Sentence& start(const Field& field, double value) {
    failed_ = true;
    return sentence_ << field << " is " << value << ", but it must be ";
  }

 private:
  Sentence sentence_;
  bool failed_ = false;
};

void checkPlanet(Checker& check, const Parameters& p) {
  check.inRange({"bottom_radius_m"}, p.bottomRadius_m, kMinRadius_m, kMaxRadius_m, " metres");
  if (!check.failed() &&
      !(p.topRadius_m >= p.bottomRadius_m + kMinThickness_m && p.topRadius_m <= kMaxRadius_m)) {
    check.start({"top_radius_m"}, p.topRadius_m)
        << "above bottom_radius_m, which is " << p.bottomRadius_m << ", by at least "
        << kMinThickness_m << " metre, and at most " << kMaxRadius_m << " metres.";
  }
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    check.positive({"wavelengths_nm", static_cast<int>(i)}, p.wavelengths_nm[i], kMaxWavelength_nm,
                   " nanometres");
  }
}

void checkRayleigh(Checker& check, const RayleighParameters& rayleigh) {
  check.spectrumInRange("rayleigh.scattering_per_m", rayleigh.scattering_per_m, 0.0,
                        kMaxCoefficient_per_m, " per metre");
  check.inRange({"rayleigh.scale_height_m"}, rayleigh.scaleHeight_m, kMinLength_m, kMaxLength_m,
                " metres");
}

void checkMie(Checker& check, const MieParameters& mie) {
  check.spectrumInRange("mie.scattering_per_m", mie.scattering_per_m, 0.0, kMaxCoefficient_per_m,
                        " per metre");
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    const int index = static_cast<int>(i);
    check.atLeast({"mie.extinction_per_m", index}, mie.extinction_per_m[i],
                  {"mie.scattering_per_m", index}, mie.scattering_per_m[i], kMaxCoefficient_per_m,
                  " per metre");
  }
  check.inRange({"mie.scale_height_m"}, mie.scaleHeight_m, kMinLength_m, kMaxLength_m, " metres");
  if (!check.failed() && !(std::abs(mie.asymmetry) <= kMaxAsymmetry)) {
    check.start({"mie.asymmetry"}, mie.asymmetry)
        << "strictly between -1 and 1, and single precision resolves the peak only from "
        << -kMaxAsymmetry << " to " << kMaxAsymmetry << ".";
  }
}

void checkAbsorption(Checker& check, const AbsorptionParameters& absorption) {
  check.spectrumInRange("absorption.extinction_per_m", absorption.extinction_per_m, 0.0,
                        kMaxCoefficient_per_m, " per metre");
  check.inRange({"absorption.center_m"}, absorption.center_m, 0.0, kMaxLength_m, " metres");
  check.inRange({"absorption.half_width_m"}, absorption.halfWidth_m, kMinLength_m, kMaxLength_m,
                " metres");
}

}  // namespace

Status validate(const Parameters& parameters, const DiagnosticSink& sink) {
  Checker check;
  checkPlanet(check, parameters);
  if (parameters.rayleigh.present) {
    checkRayleigh(check, parameters.rayleigh);
  }
  if (parameters.mie.present) {
    checkMie(check, parameters.mie);
  }
  if (parameters.absorption.present) {
    checkAbsorption(check, parameters.absorption);
  }
  check.spectrumInRange("ground_albedo", parameters.groundAlbedo, 0.0, 1.0);
  check.spectrumInRange("solar_irradiance", parameters.solarIrradiance, 0.0, kMaxIrradiance);
  constexpr double kDegree = std::numbers::pi / 180.0;
  // Rounded on the way from the file's degrees to radians and back: 10 must not become 10.000...2.
  const double degrees = std::round(parameters.sunAngularRadius / kDegree * 1e12) / 1e12;
  check.inRange({"sun_angular_radius_deg"}, degrees, 0.0, kMaxSunAngularRadius_deg, " degrees");
  if (!check.failed()) return Status::Ok;
  return report(sink, Status::InvalidArgument, check.sentence());
}

}  // namespace v1_0
}  // namespace alpenglow
