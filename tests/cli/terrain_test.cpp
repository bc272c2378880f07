// Scenes with a terrain, with and without light shafts, and with balloons.
#include <alpenglow/io/image_file.h>

#include <cmath>
#include <numeric>

#include "../io/schema.h"
#include "program.h"

namespace alpenglow::test {
namespace {

class Terrain : public Program {
 protected:
  void SetUp() override {
    // A ridge from north to south, east of the camera, that fades out at its ends.
    constexpr uint32_t kSide = 33;
    io::LinearImage heights{kSide, kSide, std::vector<float>(size_t{kSide} * kSide * 3)};
    for (uint32_t row = 0; row < kSide; ++row) {
      for (uint32_t column = 0; column < kSide; ++column) {
        const float x = (static_cast<float>(column) - 20.0f) / 4.0f;
        const float y = (static_cast<float>(row) - 16.0f) / 6.0f;
        heights.pixels[(size_t{row} * kSide + column) * 3] = 1500.0f * std::exp(-x * x - y * y);
      }
    }
    ASSERT_TRUE(io::writeExr(folder_ / "heights.exr", heights));
  }

  static constexpr const char* kCamera =
      R"("altitude_m": 700, "heading_deg": 90, "pitch_deg": 4, "fov_deg": 70)";

  std::string scene(const std::string& name, const std::string& more = "",
                    const std::string& camera = kCamera) {
    return folder_.write(name, R"({"atmosphere": "earth", "size": [48, 32],
        "sun": {"elevation_deg": 6, "azimuth_deg": 90, "disc_radius_deg": 0},
        "camera": {"latitude_deg": 10, "longitude_deg": 20, )" +
                                   camera + "}" + more + "}");
  }
  static std::string terrain(const std::string& more = "") {
    return R"(, "terrain": {"height_map": "heights.exr", "meters_per_pixel": 900, "fade_m": 2000,
               "albedo": [0.3, 0.3, 0.3])" +
           more + "}";
  }
  std::vector<std::string> renderOf(const std::string& sceneName, const std::string& output,
                                    const std::vector<std::string>& more = {}) {
    return joined(joined({"render", sceneName, "-o", folder_ / output}, smallMoments()), more);
  }

  /// Every value is finite and not negative.
  io::LinearImage picture(const std::string& name) {
    const io::Result<io::LinearImage> image = io::readExr(folder_ / name);
    EXPECT_TRUE(image) << image.error;
    if (!image) return {};
    for (const float value : image->pixels) {
      EXPECT_TRUE(std::isfinite(value) && value >= 0.0f) << value;
    }
    return *image;
  }
  static double sum(const io::LinearImage& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0);
  }
};

std::vector<float> column(const io::LinearImage& image, uint32_t x) {
  std::vector<float> values;
  for (uint32_t y = 0; y < image.height; ++y) {
    values.push_back(image.pixels[(size_t{y} * image.width + x) * 3 + 1]);
  }
  return values;
}

TEST_F(Terrain, HidesOnlyTheSkyBehindIt) {
  expectGood(renderOf(scene("plain.json"), "plain.exr"));
  expectGood(renderOf(scene("ridge.json", terrain()), "ridge.exr", {"--shafts", "off"}));
  const io::LinearImage plain = picture("plain.exr");
  const io::LinearImage ridge = picture("ridge.exr");
  EXPECT_NE(column(plain, 24), column(ridge, 24));
  for (size_t i = 0; i < size_t{48} * 3; ++i) {  // The top row is sky.
    EXPECT_NEAR(ridge.pixels[i], plain.pixels[i], 1e-3f * plain.pixels[i]);
  }
}

TEST_F(Terrain, LightShaftsTakeLightAway) {
  const std::string ridge = scene("ridge.json", terrain());
  expectGood(renderOf(ridge, "off.exr", {"--shafts", "off"}));
  const double off = sum(picture("off.exr"));
  for (const char* method : {"exact", "march", "paper"}) {
    const std::string output = std::string(method) + ".exr";
    expectGood(renderOf(ridge, output, {"--shafts", method}));
    const double on = sum(picture(output));
    EXPECT_LT(on, 0.98 * off) << method;
    EXPECT_GT(on, 0.5 * off) << method;
  }
  expectGood(renderOf(ridge, "auto.exr"));
  EXPECT_EQ(picture("auto.exr").pixels, picture("exact.exr").pixels);
  expectGood(renderOf(ridge, "few.exr", {"--shafts", "march", "--shaft-samples", "3"}));
  EXPECT_NE(picture("few.exr").pixels, picture("march.exr").pixels);
}

TEST_F(Terrain, DisabledShaftsCostNothing) {
  const std::string ridge = scene("ridge.json", terrain());
  const auto reportOf = [&](const std::string& sceneName, const char* shafts) {
    expectGood(renderOf(sceneName, "a.exr", {"--shafts", shafts, "--report", folder_ / "r.json"}));
    const nlohmann::json report = jsonOf("r.json");
    EXPECT_EQ(schemaError(ALPENGLOW_SCHEMA_FOLDER, "report.schema.json", report), "");
    return report;
  };
  const nlohmann::json exact = reportOf(ridge, "exact");
  const nlohmann::json off = reportOf(ridge, "off");
  const nlohmann::json plain = reportOf(scene("plain.json"), "exact");
  const auto has = [](const nlohmann::json& report, const char* pass) {
    for (const nlohmann::json& entry : report["passes"]) {
      if (entry["name"] == pass) return true;
    }
    return false;
  };
  for (const char* pass :
       {"terrain depth", "shadow map", "light shafts", "terrain", "aerial perspective", "sky"}) {
    EXPECT_TRUE(has(exact, pass)) << pass;
    const bool ofLightShafts =
        std::string(pass) == "shadow map" || std::string(pass) == "light shafts";
    EXPECT_EQ(has(off, pass), !ofLightShafts) << pass;
    EXPECT_EQ(has(plain, pass), std::string(pass) == "sky") << pass;
  }
  for (const char* count : {"pipelines", "bytes", "draws"}) {
    EXPECT_LT(off["totals"][count], exact["totals"][count]) << count;
    EXPECT_LT(plain["totals"][count], off["totals"][count]) << count;
  }
  // The most that are alive at once: those of the bake, which is over when the view is made.
  EXPECT_LE(off["totals"]["images"], exact["totals"]["images"]);
}

TEST_F(Terrain, IsDrawnByParallelRays) {
  const std::string camera = R"("altitude_m": 9000, "pitch_deg": -50, "heading_deg": 90,
      "projection": "orthographic", "height_m": 9000)";
  expectGood(renderOf(scene("a.json", terrain(), camera), "a.exr", {"--shafts", "off"}));
  expectGood(renderOf(scene("a.json", terrain(), camera), "b.exr", {"--shafts", "exact"}));
  expectGood(renderOf(scene("b.json", "", camera), "c.exr"));
  EXPECT_NE(picture("a.exr").pixels, picture("c.exr").pixels);
  EXPECT_LT(sum(picture("b.exr")), sum(picture("a.exr")));
}

TEST_F(Terrain, HasTablesOfTheStandardSolver) {
  const std::string ridge = scene("ridge.json", terrain());
  const auto standard = [&](const std::vector<std::string>& more) {
    return joined(joined({"render", ridge, "-o", folder_ / "a.exr"}, smallTables()), more);
  };
  const Outcome outcome = runProgram(standard({}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("no light shafts"), std::string::npos) << outcome.err;
  EXPECT_GT(sum(picture("a.exr")), 0.0);
  std::filesystem::remove(folder_ / "a.exr");
  expectRefused(standard({"--shafts", "exact"}), {"exact", "moments", "standard"});
}

TEST_F(Terrain, EveryBaselineDimsTheTerrain) {
  for (const std::string name : {"hoffman-preetham", "oneil", "schafhitzel", "hillaire"}) {
    const std::string ridge = scene("ridge.json", terrain() + ", \"model\": \"" + name + "\"");
    const Outcome outcome = runProgram({"render", ridge, "-o", folder_ / "a.exr"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("a simpler model"), std::string::npos) << outcome.err;
    EXPECT_GT(sum(picture("a.exr")), 0.0);
    std::filesystem::remove(folder_ / "a.exr");
  }
}

TEST_F(Terrain, BalloonsAreBlended) {
  const auto balloon = [](const char* opacity) {
    return R"(, "balloons": [{"latitude_deg": 10, "longitude_deg": 20.02, "altitude_m": 2000,
               "radius_m": 250, "color": [0.9, 0.1, 0.1], "opacity": )" +
           std::string(opacity) + "}]";
  };
  const std::string ground = terrain();
  expectGood(renderOf(scene("none.json", ground), "none.exr"));
  const io::LinearImage none = picture("none.exr");
  expectGood(renderOf(scene("clear.json", ground + balloon("0")), "clear.exr"));
  EXPECT_EQ(picture("clear.exr").pixels, none.pixels);
  expectGood(renderOf(scene("thin.json", ground + balloon("0.5")), "thin.exr"));
  expectGood(renderOf(scene("thick.json", ground + balloon("1")), "thick.exr"));
  const io::LinearImage thin = picture("thin.exr");
  const io::LinearImage thick = picture("thick.exr");
  EXPECT_NE(thick.pixels, none.pixels);
  for (size_t i = 0; i < none.pixels.size(); ++i) {
    const float between = 0.5f * (none.pixels[i] + thick.pixels[i]);
    ASSERT_NEAR(thin.pixels[i], between, 1e-4f * between);
  }
  expectGood(renderOf(scene("sky.json"), "sky.exr"));
  expectGood(renderOf(scene("air.json", balloon("1")), "air.exr"));
  EXPECT_NE(picture("air.exr").pixels, picture("sky.exr").pixels) << "Without a terrain.";
}

TEST_F(Terrain, UndrawableScenesAreReported) {
  const std::string ridge = scene("ridge.json", terrain());
  const auto refused = [&](const std::string& sceneName, const std::vector<std::string>& options,
                           const std::vector<std::string>& words) {
    expectRefused(
        joined(joined({"render", sceneName, "-o", folder_ / "a.exr"}, endlessTables()), options),
        words);
  };
  const std::string fisheye = R"("projection": "fisheye")";
  refused(scene("fisheye.json", terrain(), fisheye), {}, {"terrain", "fisheye"});
  refused(ridge, {"--shafts", "soft"}, {"'soft'", "'exact'"});
  refused(ridge, {"--shaft-samples", "8"}, {"--shaft-samples 8", "march", "auto"});
  refused(ridge, {"--shafts", "march", "--shaft-samples", "0"}, {"'0'", "4096"});
  const std::string wrong = R"(, "terrain": {"meters_per_pixel": 300, "height_map": )";
  refused(scene("absent.json", wrong + R"("none.png"})"), {}, {"none.png"});
  refused(scene("text.json", wrong + R"("ridge.json"})"), {}, {"ridge.json"});
  refused(scene("steep.json", terrain(R"(, "height_scale": 1e8)")), {}, {"terrain", "height"});
  refused(scene("balloon.json", R"(, "balloons": [{"latitude_deg": 1, "longitude_deg": 2}])"), {},
          {"balloons[0].altitude_m"});
}

}  // namespace
}  // namespace alpenglow::test
