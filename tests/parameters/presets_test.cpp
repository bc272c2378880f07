#include <alpenglow/parameters.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "tests/parameters/heard.h"

namespace alpenglow {
namespace {

Parameters preset(const char* name) {
  Parameters p;
  EXPECT_EQ(findPreset(name, &p, {}), Status::Ok) << name;
  return p;
}

void expectSpectrum(const Spectrum& actual, double red, double green, double blue) {
  EXPECT_DOUBLE_EQ(actual[0], red);
  EXPECT_DOUBLE_EQ(actual[1], green);
  EXPECT_DOUBLE_EQ(actual[2], blue);
}

TEST(Presets, AllAreValidAndSaySomething) {
  std::set<std::string> names;
  for (const Preset& listed : testing::allPresets()) {
    ASSERT_NE(listed.name, nullptr);
    EXPECT_TRUE(names.insert(listed.name).second) << listed.name << " is listed twice";
    EXPECT_GT(std::string(listed.description).size(), 10u);
    // A source has a year.
    EXPECT_NE(std::string(listed.source).find_first_of("12"), std::string::npos);
    Parameters p;
    ASSERT_EQ(findPreset(listed.name, &p, {}), Status::Ok);
    testing::Heard heard;
    EXPECT_EQ(validate(p, heard.sink()), Status::Ok) << listed.name << heard.sentence;
    EXPECT_EQ(heard.count, 0);
    EXPECT_EQ(listed.parameters.bottomRadius_m, p.bottomRadius_m);
  }
  for (const char* name : {"earth", "earth-fig6", "earth-fig7", "earth-hazy", "mars"}) {
    EXPECT_EQ(names.count(name), 1u) << name;
  }
}

TEST(Presets, UnknownNamesAreRefused) {
  Parameters p = preset("mars");
  EXPECT_EQ(findPreset("Earth", &p, {}), Status::InvalidArgument);
  EXPECT_EQ(findPreset("", &p, {}), Status::InvalidArgument);
  EXPECT_EQ(findPreset(nullptr, &p, {}), Status::InvalidArgument);
  EXPECT_EQ(findPreset("earth", nullptr, {}), Status::InvalidArgument);
  EXPECT_EQ(p.bottomRadius_m, preset("mars").bottomRadius_m) << "a failed call changed the object";
  EXPECT_EQ(presets(nullptr), testing::allPresets().data());
}

TEST(Presets, TheSentenceListsTheNames) {
  Parameters p;
  const std::string longName(1000, 'x');
  for (const char* name : {"Earth", "", longName.c_str(), static_cast<const char*>(nullptr)}) {
    testing::Heard heard;
    EXPECT_EQ(findPreset(name, &p, heard.sink()), Status::InvalidArgument);
    EXPECT_EQ(heard.count, 1);
    EXPECT_EQ(heard.severity, Severity::Error);
    EXPECT_EQ(heard.status, Status::InvalidArgument);
    for (const Preset& listed : testing::allPresets())
      EXPECT_NE(heard.sentence.find(listed.name), std::string::npos) << heard.sentence;
    EXPECT_EQ(heard.sentence.back(), '.') << heard.sentence;
  }
  testing::Heard heard;
  findPreset("Earth", &p, heard.sink());
  EXPECT_EQ(heard.sentence,
            "There is no preset named \"Earth\"; these exist: earth, earth-fig6, earth-fig7, "
            "earth-clear, earth-hazy, mars.");
}

TEST(Presets, FiguresOfThePaper) {
  const Parameters p = preset("earth-fig6");
  EXPECT_EQ(p.bottomRadius_m, 6360e3);
  EXPECT_EQ(p.topRadius_m, 6420e3);
  expectSpectrum(p.wavelengths_nm, 680, 550, 440);
  expectSpectrum(p.rayleigh.scattering_per_m, 5.8e-6, 13.5e-6, 33.1e-6);
  EXPECT_EQ(p.rayleigh.scaleHeight_m, 8000);
  expectSpectrum(p.mie.scattering_per_m, 2e-5, 2e-5, 2e-5);
  expectSpectrum(p.mie.extinction_per_m, 2e-5 / 0.9, 2e-5 / 0.9, 2e-5 / 0.9);
  EXPECT_EQ(p.mie.scaleHeight_m, 1200);
  EXPECT_EQ(p.mie.asymmetry, 0.76);
  EXPECT_FALSE(p.absorption.present);
  expectSpectrum(p.groundAlbedo, 0.1, 0.1, 0.1);
  expectSpectrum(p.solarIrradiance, 1, 1, 1);
  EXPECT_EQ(p.sunAngularRadius, 0.0);

  const Parameters q = preset("earth-fig7");
  expectSpectrum(q.mie.scattering_per_m, 2.2e-5, 2.2e-5, 2.2e-5);
  EXPECT_EQ(q.mie.asymmetry, 0.73);
  EXPECT_FALSE(q.absorption.present);
}

TEST(Presets, DefaultEarthHasOzone) {
  const Parameters p = preset("earth");
  EXPECT_STREQ(testing::allPresets()[0].name, "earth") << "the default comes first";
  ASSERT_TRUE(p.absorption.present);
  expectSpectrum(p.absorption.extinction_per_m, 0.65e-6, 1.881e-6, 0.085e-6);
  EXPECT_EQ(p.absorption.center_m, 25000);
  EXPECT_EQ(p.absorption.halfWidth_m, 15000);
  expectSpectrum(p.mie.extinction_per_m, 2.22e-5, 2.22e-5, 2.22e-5);
}

/// The optical depths and mean cosines that the sources measured must come out again.
double meanCosine(double g) { return 3 * g * (4 + g * g) / (5 * (2 + g * g)); }

TEST(Presets, MarsHasItsMeasuredDust) {
  const Parameters p = preset("mars");
  const double column =
      p.mie.scaleHeight_m * -std::expm1(-(p.topRadius_m - p.bottomRadius_m) / p.mie.scaleHeight_m);
  EXPECT_NEAR(p.mie.extinction_per_m[0] * column, 0.5, 0.001);
  EXPECT_NEAR(meanCosine(p.mie.asymmetry), 0.685, 0.005);
  // Rust: absorbs blue.
  EXPECT_NEAR(p.mie.scattering_per_m[0] / p.mie.extinction_per_m[0], 0.972, 1e-9);
  EXPECT_NEAR(p.mie.scattering_per_m[2] / p.mie.extinction_per_m[2], 0.822, 1e-9);
  // CO2: a vertical optical depth of some thousandths.
  EXPECT_NEAR(p.rayleigh.scattering_per_m[1], 2.29e-7, 0.01e-7);
}

TEST(Presets, HazeHasItsPublishedOpticalDepth) {
  const Parameters p = preset("earth-hazy");
  EXPECT_NEAR(p.mie.extinction_per_m[1] * p.mie.scaleHeight_m, 0.327, 0.001);
  EXPECT_NEAR(meanCosine(p.mie.asymmetry), 0.698, 0.001);
}

TEST(Status, NamesAreThoseOfTheHeader) {
  EXPECT_STREQ(statusName(Status::Ok), "Ok");
  EXPECT_STREQ(statusName(Status::NotReady), "NotReady");
  EXPECT_STREQ(statusName(Status::InvalidArgument), "InvalidArgument");
  EXPECT_STREQ(statusName(Status::Unsupported), "Unsupported");
  EXPECT_STREQ(statusName(Status::OutOfHostMemory), "OutOfHostMemory");
  EXPECT_STREQ(statusName(Status::OutOfDeviceMemory), "OutOfDeviceMemory");
  EXPECT_STREQ(statusName(Status::DeviceLost), "DeviceLost");
  EXPECT_STREQ(statusName(Status::VulkanError), "VulkanError");
  EXPECT_NE(statusName(static_cast<Status>(1234)), nullptr);
}

}  // namespace
}  // namespace alpenglow
