#include <alpenglow/io/atmosphere_file.h>

#include <cmath>
#include <cstring>

#include "temporary_folder.h"

#include "tests/parameters/heard.h"

namespace alpenglow::io {
namespace {

using test::expectSentence;

std::string earth() {
  return R"({ "bottom_radius_m": 6360000, "top_radius_m": 6420000,
  "wavelengths_nm": [680, 550, 440],
  "rayleigh": { "scattering_per_m": [5.8e-6, 13.5e-6, 33.1e-6], "scale_height_m": 8000 },
  "mie": { "scattering_per_m": [2e-5, 2e-5, 2e-5], "extinction_per_m": [2.22e-5, 2.22e-5, 2.22e-5],
           "scale_height_m": 1200, "asymmetry": 0.76 },
  "absorption": { "extinction_per_m": [0.65e-6, 1.881e-6, 0.085e-6], "center_m": 25000, "half_width_m": 15000 },
  "ground_albedo": [0.1, 0.1, 0.1],
  "solar_irradiance": [1, 1, 1], "sun_angular_radius_deg": 0 }
)";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string errorOf(const std::string& text) {
  const Result<Parameters> result = parseAtmosphere(text, "a.json");
  EXPECT_FALSE(result) << text;
  expectSentence(result.error);
  return result.error;
}

void expectMentions(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

TEST(AtmosphereFile, ReadsTheDocumentedExample) {
  const Result<Parameters> result = parseAtmosphere(earth(), "a.json");
  ASSERT_TRUE(result) << result.error;
  EXPECT_EQ(result->bottomRadius_m, 6360000.0);
  EXPECT_EQ(result->topRadius_m, 6420000.0);
  EXPECT_EQ(result->wavelengths_nm[2], 440.0);
  EXPECT_TRUE(result->rayleigh.present);
  EXPECT_EQ(result->rayleigh.scattering_per_m[1], 13.5e-6);
  EXPECT_EQ(result->mie.extinction_per_m[0], 2.22e-5);
  EXPECT_EQ(result->mie.asymmetry, 0.76);
  EXPECT_EQ(result->absorption.halfWidth_m, 15000.0);
  EXPECT_EQ(result->groundAlbedo[0], 0.1);
  EXPECT_EQ(result->sunAngularRadius, 0.0);
}

TEST(AtmosphereFile, NullLeavesAConstituentOut) {
  std::string text = earth();
  for (const char* field : {"\"rayleigh\": {", "\"mie\": {", "\"absorption\": {"}) {
    const size_t start = text.find(field) + std::strlen(field) - 1;
    text.replace(start, text.find('}', start) + 1 - start, "null");
  }
  const Result<Parameters> result = parseAtmosphere(text, "a.json");
  ASSERT_TRUE(result) << result.error;
  EXPECT_FALSE(result->rayleigh.present);
  EXPECT_FALSE(result->mie.present);
  EXPECT_FALSE(result->absorption.present);
  const Result<Parameters> again = parseAtmosphere(formatAtmosphere(*result), "b.json");
  ASSERT_TRUE(again) << again.error;
  EXPECT_EQ(firstDifference(*result, *again), "");
}

TEST(AtmosphereFile, EveryPresetComesBackBitForBit) {
  ASSERT_GE(testing::allPresets().size(), 5u);
  for (const Preset& listed : testing::allPresets()) {
    Parameters preset;
    ASSERT_EQ(findPreset(listed.name, &preset, {}), Status::Ok);
    const Result<Parameters> again = parseAtmosphere(formatAtmosphere(preset), "p.json");
    ASSERT_TRUE(again) << again.error;
    EXPECT_EQ(preset.sunAngularRadius, again->sunAngularRadius) << listed.name;
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      EXPECT_EQ(preset.rayleigh.scattering_per_m[c], again->rayleigh.scattering_per_m[c]);
      EXPECT_EQ(preset.mie.extinction_per_m[c], again->mie.extinction_per_m[c]);
      EXPECT_EQ(preset.solarIrradiance[c], again->solarIrradiance[c]);
    }
    EXPECT_EQ(preset.mie.asymmetry, again->mie.asymmetry);
    EXPECT_EQ(firstDifference(preset, *again), "");
  }
}

TEST(AtmosphereFile, OddAnglesComeBackBitForBit) {
  Parameters parameters = *parseAtmosphere(earth(), "a.json");
  for (double degrees = 0.0001; degrees < 5.0; degrees *= 1.37) {
    parameters.sunAngularRadius = std::atan(degrees / 57.0);
    const Result<Parameters> again = parseAtmosphere(formatAtmosphere(parameters), "b.json");
    ASSERT_TRUE(again) << again.error;
    // Degrees are coarser than radians, so not every angle has a twin; a step of the last bit is
    // all.
    EXPECT_NEAR(again->sunAngularRadius, parameters.sunAngularRadius,
                2.3e-16 * parameters.sunAngularRadius);
  }
}

TEST(AtmosphereFile, NamesEveryMissingField) {
  for (const char* field :
       {"bottom_radius_m", "top_radius_m", "wavelengths_nm", "rayleigh", "mie", "absorption",
        "ground_albedo", "solar_irradiance", "sun_angular_radius_deg", "asymmetry", "center_m"}) {
    // A field under another name is missing and unknown at once; both sentences name a field.
    const std::string quoted = "\"" + std::string(field) + "\"";
    const std::string error = errorOf(replaced(earth(), quoted, "\"other\""));
    EXPECT_NE(error.find("'other'") == std::string::npos ? error.find(field) : error.find("other"),
              std::string::npos);
  }
  expectMentions(errorOf("{}"), {"a.json", "bottom_radius_m", "missing"});
  expectMentions(errorOf(replaced(earth(), ", \"asymmetry\": 0.76", "")),
                 {"'mie.asymmetry'", "missing"});
}

TEST(AtmosphereFile, RefusesUnknownAndDoubledFields) {
  expectMentions(errorOf(replaced(earth(), "\"mie\":", "\"haze\": 1, \"mie\":")),
                 {"'haze'", "unknown"});
  expectMentions(errorOf(replaced(earth(), "\"asymmetry\":", "\"g\": 1, \"asymmetry\":")),
                 {"'mie.g'", "unknown"});
  expectMentions(errorOf(replaced(earth(), "\"asymmetry\":", "\"asymmetry\": 0.5, \"asymmetry\":")),
                 {"'asymmetry'", "twice"});
  expectMentions(errorOf(replaced(earth(), "{ \"bottom", "{ \"mie\": null, \"bottom")),
                 {"'mie'", "twice"});
}

TEST(AtmosphereFile, RefusesWrongTypes) {
  expectMentions(errorOf(replaced(earth(), "6360000", "\"6360000\"")), {"'bottom_radius_m'"});
  expectMentions(errorOf(replaced(earth(), "6360000", "null")), {"'bottom_radius_m'", "null"});
  expectMentions(errorOf(replaced(earth(), "6360000", "true")), {"'bottom_radius_m'", "true"});
  expectMentions(errorOf(replaced(earth(), "[680, 550, 440]", "[680, 550]")),
                 {"'wavelengths_nm'", "[680,550]"});
  expectMentions(errorOf(replaced(earth(), "[680, 550, 440]", "[680, 550, \"x\"]")),
                 {"'wavelengths_nm'"});
  expectMentions(errorOf("[]"), {"top level", "object"});
  expectMentions(errorOf("3"), {"top level", "3"});
}

TEST(AtmosphereFile, NamesTheFieldOfANumberThatIsNotFinite) {
  expectMentions(errorOf(replaced(earth(), "0.76", "NaN")), {"'mie.asymmetry'", "NaN"});
  expectMentions(errorOf(replaced(earth(), "0.76", "-Infinity")), {"'mie.asymmetry'", "-Infinity"});
  expectMentions(errorOf(replaced(earth(), "6420000", "1e999")), {"'top_radius_m'", "1e999"});
  expectMentions(errorOf(replaced(earth(), "[0.1, 0.1", "[0.1, NaN")), {"'ground_albedo'", "NaN"});
}

TEST(AtmosphereFile, ValidatesThroughTheModel) {
  expectMentions(errorOf(replaced(earth(), "0.76", "1.2")), {"a.json", "asymmetry", "1.2"});
  expectMentions(errorOf(replaced(earth(), "6420000", "6360000")), {"top_radius_m"});
  expectMentions(errorOf(replaced(earth(), "8000", "0")), {"scale_height_m"});
  expectMentions(
      errorOf(replaced(earth(), "\"sun_angular_radius_deg\": 0", "\"sun_angular_radius_deg\": -1")),
      {"sun_angular_radius_deg"});
}

TEST(AtmosphereFile, BadJsonSaysWhere) {
  expectMentions(errorOf("{ \"bottom_radius_m\": 1,\n  oops }"), {"a.json", "line 2"});
  expectMentions(errorOf(""), {"a.json", "JSON"});
  expectMentions(errorOf(earth() + "x"), {"a.json", "JSON"});
  expectMentions(errorOf("{\"a\": \"\xFF\"}"), {"a.json", "JSON"});
  expectMentions(errorOf(std::string(100000, '[')), {"a.json"});
  expectMentions(errorOf(std::string(100, '[') + std::string(100, ']')), {"nests deeper"});
  const std::string whole = earth();
  for (size_t length = 0; length + 2 < whole.size(); ++length) errorOf(whole.substr(0, length));
}

TEST(AtmosphereFile, PresetNamesTakePrecedenceOverFiles) {
  test::TemporaryFolder folder;
  const std::string path = folder.write("mine.json", earth());
  ASSERT_TRUE(findAtmosphere(path));
  EXPECT_EQ(findAtmosphere(path)->absorption.center_m, 25000.0);
  ASSERT_TRUE(findAtmosphere("earth-fig6"));
  EXPECT_EQ(findAtmosphere("earth-fig6")->mie.asymmetry, 0.76);
  expectSentence(findAtmosphere("no-such-place").error);
  expectMentions(readAtmosphere(folder / "absent.json").error, {"absent.json", "No such file"});
  expectMentions(readAtmosphere(folder.path()).error, {"folder"});
}

TEST(AtmosphereFile, NamesTheFirstDifference) {
  const Parameters a = *parseAtmosphere(earth(), "a.json");
  Parameters b = a;
  EXPECT_EQ(firstDifference(a, b), "");
  b.mie.asymmetry = 0.8;
  EXPECT_EQ(firstDifference(a, b), "mie.asymmetry is 0.76 and 0.8");
  EXPECT_EQ(firstDifference(a, b, " here", " there"), "mie.asymmetry is 0.76 here and 0.8 there");
  b = a;
  b.absorption.present = false;
  EXPECT_NE(firstDifference(a, b).find("absorption"), std::string::npos);
  EXPECT_NE(firstDifference(b, a).find("absorption"), std::string::npos);
}

}  // namespace
}  // namespace alpenglow::io
