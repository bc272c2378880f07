#include <alpenglow/parameters.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tests/parameters/heard.h"

namespace alpenglow {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Parameters earth() {
  Parameters p;
  EXPECT_EQ(findPreset("earth", &p, {}), Status::Ok);
  return p;
}

struct Outcome {
  Status status;
  std::string message;
};

Outcome check(const Parameters& p) {
  testing::Heard heard;
  const Status status = validate(p, heard.sink());
  EXPECT_EQ(heard.count, status == Status::Ok ? 0 : 1);
  return {status, heard.sentence};
}

/// `p` is refused by one sentence that starts with the field and names the value.
void expectRefused(const Parameters& p, const std::string& field, const std::string& value) {
  const Outcome outcome = check(p);
  EXPECT_EQ(outcome.status, Status::InvalidArgument) << field << " " << value;
  EXPECT_EQ(outcome.message.rfind(field + " is " + value + ",", 0), 0u) << outcome.message;
  EXPECT_NE(outcome.message.find("must be"), std::string::npos) << outcome.message;
  EXPECT_EQ(outcome.message.back(), '.') << outcome.message;
}

struct FieldCase {
  const char* name;
  double* (*field)(Parameters&);
  std::vector<double> wrong;
};

std::string written(double value) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

const std::vector<FieldCase>& fieldCases() {
  static const std::vector<FieldCase> cases = {
      {"bottom_radius_m", [](Parameters& p) { return &p.bottomRadius_m; }, {-1, 0, 1, 2e9}},
      {"top_radius_m", [](Parameters& p) { return &p.topRadius_m; }, {-1, 0, 6360e3, 6359e3, 2e9}},
      {"wavelengths_nm[0]", [](Parameters& p) { return &p.wavelengths_nm[0]; }, {-680, 0, 1e9}},
      {"wavelengths_nm[2]", [](Parameters& p) { return &p.wavelengths_nm[2]; }, {-440, 0}},
      {"rayleigh.scattering_per_m[0]",
       [](Parameters& p) { return &p.rayleigh.scattering_per_m[0]; },
       {-1e-9, 2}},
      {"rayleigh.scattering_per_m[2]",
       [](Parameters& p) { return &p.rayleigh.scattering_per_m[2]; },
       {-1e-9, 2}},
      {"rayleigh.scale_height_m",
       [](Parameters& p) { return &p.rayleigh.scaleHeight_m; },
       {-8000, 0, 1e12}},
      {"mie.scattering_per_m[1]",
       [](Parameters& p) { return &p.mie.scattering_per_m[1]; },
       {-1e-9, 2}},
      {"mie.extinction_per_m[1]",
       [](Parameters& p) { return &p.mie.extinction_per_m[1]; },
       {-1e-5, 0, 1.99e-5, 2}},
      {"mie.scale_height_m", [](Parameters& p) { return &p.mie.scaleHeight_m; }, {-1200, 0, 1e12}},
      {"mie.asymmetry",
       [](Parameters& p) { return &p.mie.asymmetry; },
       {-1, 1, 1.5, -2, 0.9999999, -0.9999999}},
      {"absorption.extinction_per_m[0]",
       [](Parameters& p) { return &p.absorption.extinction_per_m[0]; },
       {-1e-9, 2}},
      {"absorption.center_m", [](Parameters& p) { return &p.absorption.center_m; }, {-1, 1e12}},
      {"absorption.half_width_m",
       [](Parameters& p) { return &p.absorption.halfWidth_m; },
       {-15000, 0, 1e12}},
      {"ground_albedo[0]", [](Parameters& p) { return &p.groundAlbedo[0]; }, {-0.1, 1.1}},
      {"ground_albedo[2]", [](Parameters& p) { return &p.groundAlbedo[2]; }, {-0.1, 1.1}},
      {"solar_irradiance[1]", [](Parameters& p) { return &p.solarIrradiance[1]; }, {-1, 1e12}},
  };
  return cases;
}

TEST(Validate, EveryWrongValueIsRefusedByName) {
  for (const FieldCase& field : fieldCases()) {
    std::vector<double> wrong = field.wrong;
    wrong.insert(wrong.end(), {kNaN, kInfinity, -kInfinity});
    for (double value : wrong) {
      Parameters p = earth();
      *field.field(p) = value;
      expectRefused(p, field.name, std::isnan(value) ? "nan" : written(value));
    }
  }
}

TEST(Validate, SunRadiusIsNamedInDegrees) {
  Parameters p = earth();
  for (double degrees : {-0.1, 11.0}) {
    p.sunAngularRadius = degrees * std::numbers::pi / 180;
    expectRefused(p, "sun_angular_radius_deg", written(degrees));
  }
  p.sunAngularRadius = kNaN;
  expectRefused(p, "sun_angular_radius_deg", "nan");
  for (double degrees : {0.0, 0.2667, 10.0}) {
    p.sunAngularRadius = degrees * std::numbers::pi / 180;
    EXPECT_EQ(check(p).status, Status::Ok) << degrees;
  }
}

TEST(Validate, ExtinctionBelowScatteringNamesBoth) {
  Parameters p = earth();
  p.mie.extinction_per_m[1] = 1e-5;
  EXPECT_EQ(check(p).message,
            "mie.extinction_per_m[1] is 1e-05, but it must be at least mie.scattering_per_m[1], "
            "which is 2e-05, and at most 1 per metre.");
  p.mie.extinction_per_m[1] = p.mie.scattering_per_m[1];
  EXPECT_EQ(check(p).status, Status::Ok);
}

TEST(Validate, TopBelowBottomNamesBoth) {
  Parameters p = earth();
  p.topRadius_m = 6.3e6;
  const std::string message = check(p).message;
  EXPECT_NE(message.find("top_radius_m is 6300000"), std::string::npos) << message;
  EXPECT_NE(message.find("bottom_radius_m, which is 6360000"), std::string::npos) << message;
}

TEST(Validate, AbsentConstituentsAreNotLookedAt) {
  Parameters p = earth();
  p.rayleigh.present = p.mie.present = p.absorption.present = false;
  p.rayleigh.scaleHeight_m = kNaN;
  p.mie.asymmetry = 5;
  p.absorption.halfWidth_m = -1;
  EXPECT_EQ(check(p).status, Status::Ok) << check(p).message;
}

TEST(Validate, SmallAndHugePlanetsAreAccepted) {
  for (double radius : {10e3, 60e3, 3389.5e3, 6360e3, 100e6}) {
    for (double scaleHeight : {100.0, 1200.0, 8000.0, 50e3}) {
      for (double g : {-0.99, 0.0, 0.99}) {
        Parameters p = earth();
        p.bottomRadius_m = radius;
        p.topRadius_m = radius + 8 * scaleHeight;
        p.rayleigh.scaleHeight_m = p.mie.scaleHeight_m = scaleHeight;
        p.mie.asymmetry = g;
        EXPECT_EQ(check(p).status, Status::Ok) << radius << " " << scaleHeight << " " << g;
      }
    }
  }
}

TEST(Validate, NobodyNeedsToListen) {
  Parameters p = earth();
  p.bottomRadius_m = kNaN;
  EXPECT_EQ(validate(p, {}), Status::InvalidArgument);
}

}  // namespace
}  // namespace alpenglow
