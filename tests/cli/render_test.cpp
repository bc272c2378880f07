#include <alpenglow/io/image_file.h>

#include <cmath>

#include "../io/schema.h"
#include "program.h"

namespace alpenglow::test {
namespace {

class Render : public Program {
 protected:
  std::string scene(const std::string& more = "") {
    return folder_.write("scene.json",
                         R"({"atmosphere": "earth", "sun": {"elevation_deg": 30, "azimuth_deg": 90},
        "camera": {"altitude_m": 100, "heading_deg": 90, "pitch_deg": 20}, "size": [48, 32])" +
                             more + "}");
  }
  std::vector<std::string> renderOf(const std::string& sceneName, const std::string& output,
                                    const std::vector<std::string>& more = {}) {
    return joined(joined({"render", sceneName, "-o", folder_ / output}, smallTables()), more);
  }
  io::LinearImage picture(const std::string& name) {
    io::Result<io::LinearImage> image = io::readExr(folder_ / name);
    EXPECT_TRUE(image) << image.error;
    return image ? *image : io::LinearImage{};
  }
};

TEST_F(Render, ExrHoldsLinearRadiance) {
  expectGood(renderOf(scene(), "a.exr"));
  const io::LinearImage image = picture("a.exr");
  EXPECT_EQ(image.width, 48u);
  EXPECT_EQ(image.height, 32u);
  float brightest = 0.0f;
  for (const float value : image.pixels) {
    ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << value;
    brightest = std::max(brightest, value);
  }
  EXPECT_GT(brightest, 0.01f);
}

TEST_F(Render, RadianceFollowsSolarIrradianceButNotExposure) {
  expectGood(renderOf(scene(R"(, "exposure": 1)"), "a.exr"));
  expectGood(renderOf(scene(R"(, "exposure": 50, "tone_map": "linear")"), "b.exr"));
  EXPECT_EQ(picture("a.exr").pixels, picture("b.exr").pixels);
  nlohmann::json bright = nlohmann::json::parse(runProgram({"presets", "earth"}).out);
  for (nlohmann::json& value : bright["solar_irradiance"]) value = value.get<double>() * 4.0;
  nlohmann::json changed = nlohmann::json::parse(contentsOf(scene()));
  changed["atmosphere"] = bright;
  expectGood(renderOf(folder_.write("bright.json", changed.dump()), "c.exr"));
  const io::LinearImage a = picture("a.exr");
  const io::LinearImage c = picture("c.exr");
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    ASSERT_NEAR(c.pixels[i], 4.0f * a.pixels[i], 1e-5f * c.pixels[i]);
  }
}

TEST_F(Render, PngIsEightBitRgb) {
  expectGood(renderOf(scene(), "a.png", {"--report", folder_ / "r.json", "--size", "40x20"}));
  const std::string bytes = contentsOf(folder_ / "a.png");
  ASSERT_GT(bytes.size(), 33u);
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(bytes[19], 40);
  EXPECT_EQ(bytes[23], 20);
  EXPECT_EQ(bytes[24], 8);
  EXPECT_EQ(bytes[25], 2);
  const nlohmann::json report = jsonOf("r.json");
  EXPECT_EQ(schemaError(ALPENGLOW_SCHEMA_FOLDER, "report.schema.json", report), "");
  EXPECT_EQ(report["totals"]["draws"], 1);
}

TEST_F(Render, ExposureAndToneMapChangeThePng) {
  expectGood(renderOf(scene(R"(, "exposure": 5)"), "a.png"));
  expectGood(renderOf(scene(R"(, "exposure": 5)"), "b.png"));
  expectGood(renderOf(scene(R"(, "exposure": 9)"), "c.png"));
  expectGood(renderOf(scene(R"(, "exposure": 5, "tone_map": "linear")"), "d.png"));
  const std::string a = contentsOf(folder_ / "a.png");
  EXPECT_EQ(a, contentsOf(folder_ / "b.png"));
  EXPECT_NE(a, contentsOf(folder_ / "c.png"));
  EXPECT_NE(a, contentsOf(folder_ / "d.png"));
}

TEST_F(Render, ATableFileGivesTheSamePicture) {
  for (const char* mie : {"full", "packed"}) {
    const std::vector<std::string> options = joined(smallTables(), {"--mie", mie});
    expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, options));
    expectGood(joined({"render", scene(), "-o", folder_ / "a.exr"}, options));
    expectGood({"render", scene(), "-o", folder_ / "b.exr", "--tables", folder_ / "t.exr"});
    EXPECT_EQ(picture("a.exr").pixels, picture("b.exr").pixels);
  }
}

TEST_F(Render, TablesOfAnotherAtmosphereOrOrderAreRefused) {
  expectGood(joined({"bake", "mars", "-o", folder_ / "t.exr"}, smallTables()));
  expectRefused({"render", scene(), "-o", folder_ / "a.png", "--tables", folder_ / "t.exr"},
                {"t.exr", "another atmosphere"});
  expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, smallTables()));
  scene(R"(, "orders": 3)");
  expectRefused(
      {"render", folder_ / "scene.json", "-o", folder_ / "a.png", "--tables", folder_ / "t.exr"},
      {"\"orders\": 3", "2"});
}

TEST_F(Render, FisheyesAreBlackOutside) {
  const std::string fisheye =
      folder_.write("fisheye.json", R"({"atmosphere": "earth", "sun": {"elevation_deg": 30},
      "camera": {"pitch_deg": 90, "projection": "fisheye", "fov_deg": 180}, "size": [48, 32]})");
  expectGood(renderOf(fisheye, "a.exr"));
  const io::LinearImage image = picture("a.exr");
  EXPECT_EQ(image.pixels[0], 0.0f);
  EXPECT_GT(image.pixels[(16 * 48 + 24) * 3 + 2], 0.0f);
}

TEST_F(Render, TheAlbedoMapIsSeenFromSpace) {
  const std::string start = R"({"atmosphere": "earth", "sun": {"elevation_deg": 80},
      "camera": {"altitude_m": 2e7, "pitch_deg": -90, "fov_deg": 20}, "size": [24, 24])";
  const std::string ground =
      R"(, "ground": {"albedo_map": ")" + std::string(ALPENGLOW_SAMPLES) + R"(/data/earth.jpg"}})";
  expectGood(renderOf(folder_.write("plain.json", start + "}"), "a.exr"));
  expectGood(renderOf(folder_.write("earth.json", start + ground), "b.exr"));
  EXPECT_NE(picture("a.exr").pixels, picture("b.exr").pixels);
}

TEST_F(Render, SampleScenesAreFoundByName) {
  expectGood(renderOf("clear_noon", "a.png", {"--size", "16x12"}));
  std::filesystem::create_directory(folder_ / "scenes");
  folder_.write("scenes/mine.json", contentsOf(scene()));
  const Outcome mine =
      runProgram(renderOf("mine", "b.png"), {"ALPENGLOW_DATA_DIR=" + folder_.path()});
  EXPECT_EQ(mine.status, 0) << mine.err;
  expectRefused(renderOf("no_such_scene", "c.png"), {"'no_such_scene'"});
}

TEST_F(Render, BadScenesAreNamed) {
  expectRefused(renderOf(scene(R"(, "weather": 1)"), "a.png"), {"scene.json", "'weather'"});
  expectRefused(renderOf(scene(R"(, "solver": "exact")"), "a.png"), {"'solver'", "exact"});
  expectRefused(renderOf(scene(R"(, "quality": "best")"), "a.png"), {"'quality'", "best"});
  expectRefused(renderOf(scene(R"(, "ground": {"albedo_map": "none.jpg"})"), "a.png"),
                {"none.jpg"});
  expectRefused(renderOf(scene(R"(, "ground": {"albedo_map": "scene.json"})"), "a.png"),
                {"scene.json", "JPEG"});
  expectRefused(renderOf(folder_ / "absent.json", "a.png"), {"absent.json"});
  expectRefused(renderOf(folder_.write("bad.json", "[}"), "a.png"), {"bad.json", "JSON"});
}

TEST_F(Render, UnwritableOutputs) {
  expectRefused(renderOf(scene(), "a.jpg"), {"a.jpg", ".exr or .png"});
  expectRefused(renderOf(scene(), "no/such/a.png"), {"a.png"});
  std::filesystem::create_directory(folder_ / "folder.png");
  expectRefused(renderOf(scene(), "folder.png"), {"folder.png", "folder"});
  std::filesystem::create_symlink("/dev/full", folder_ / "full.png");
  for (const std::string& output : {folder_ / "full.png", std::string("/proc/a.png")}) {
    expectRefused(joined({"render", scene(), "-o", output}, endlessTables()), {output});
  }
}

TEST_F(Render, APictureThatDoesNotFitIsRefusedBeforeTheBake) {
  const std::vector<std::string> huge = joined(
      {"render", scene(), "-o", folder_ / "a.png", "--size", "16384x16384"}, endlessTables());
  expectRefused(huge, {"16384x16384", "4294967296 bytes"});
}

// Orders that are kept cost memory and change nothing.
TEST_F(Render, KeepsOrdersWhileBaking) {
  expectGood(renderOf(scene(), "a.exr", {"--report", folder_ / "a.json"}));
  expectGood(renderOf(scene(), "b.exr", {"--keep-orders", "--report", folder_ / "b.json"}));
  EXPECT_EQ(picture("a.exr").pixels, picture("b.exr").pixels);
  EXPECT_GT(jsonOf("b.json")["totals"]["bytes"], jsonOf("a.json")["totals"]["bytes"]);
  expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, smallTables()));
  expectGood(
      {"render", scene(), "-o", folder_ / "b.exr", "--keep-orders", "--tables", folder_ / "t.exr"});
  EXPECT_EQ(picture("a.exr").pixels, picture("b.exr").pixels);
}

}  // namespace
}  // namespace alpenglow::test
