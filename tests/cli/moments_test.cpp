// The moment solver, from outside.
#include <alpenglow/io/image_file.h>
#include <alpenglow/io/table_file.h>

#include <cmath>

#include "program.h"

namespace alpenglow::test {
namespace {

/// What createTables makes of them.
TableSizes sizesOf(const Parameters& parameters, Quality quality, const TableSizes& given = {}) {
  TableDesc desc;
  desc.quality = quality;
  desc.sizes = given;
  EXPECT_EQ(resolveTableDesc(parameters, &desc, {}), Status::Ok);
  return desc.sizes;
}

class Moments : public Program {
 protected:
  Moments()
      : queries_(folder_.write("q.json", R"({"queries": [
  {"id": "sky", "altitude_m": 2, "view_zenith_deg": 60, "sun_zenith_deg": 70, "azimuth_deg": 45, "distance_m": null},
  {"id": "down", "altitude_m": 9000, "view_zenith_deg": 150, "sun_zenith_deg": 30, "azimuth_deg": 0, "distance_m": null},
  {"id": "light", "kind": "irradiance", "altitude_m": 0, "sun_zenith_deg": 60}]})")) {}

  std::vector<std::string> probeOf(const std::vector<std::string>& more) {
    return joined({"probe", "earth", "--queries", queries_, "-o", folder_ / "a.json"}, more);
  }
  std::string scene(const std::string& more = "") {
    return folder_.write("scene.json",
                         R"({"atmosphere": "earth", "sun": {"elevation_deg": 3, "azimuth_deg": 90},
        "camera": {"altitude_m": 100, "heading_deg": 90, "pitch_deg": 20}, "size": [48, 32])" +
                             more + "}");
  }
  io::TableFile tables(const std::string& name) {
    io::Result<io::TableFile> file = io::readTableFile(folder_ / name, true);
    EXPECT_TRUE(file) << file.error;
    return file ? *file : io::TableFile{};
  }

  std::string queries_;
};

TEST_F(Moments, AreBakedByDefaultAtMediumQuality) {
  expectGood({"bake", "earth", "-o", folder_ / "t.exr"});
  const io::TableFile file = tables("t.exr");
  EXPECT_EQ(file.desc.solver, Solver::Moments);
  EXPECT_EQ(file.desc.quality, Quality::Medium);
  EXPECT_EQ(file.desc.orders, 0u);
  EXPECT_EQ(file.desc.format, TableFormat::Half);
  EXPECT_EQ(io::momentSettingsText(file.desc.sizes),
            io::momentSettingsText(sizesOf(file.parameters, Quality::Medium)));
  ASSERT_EQ(file.parts.size(), 3u);
}

TEST_F(Moments, AreBakedAsOptionsSay) {
  expectGood({"bake", "mars", "-o", folder_ / "t.exr", "--solver", "moments", "--quality", "draft",
              "--moments", "nodesR=6,degree=4", "--orders", "3", "--format", "float"});
  const io::TableFile file = tables("t.exr");
  TableSizes custom;
  custom.nodesR = 6;
  custom.degree = 4;
  EXPECT_EQ(file.desc.quality, Quality::Draft);
  EXPECT_EQ(file.desc.orders, 3u);
  EXPECT_EQ(file.desc.format, TableFormat::Float);
  EXPECT_EQ(io::momentSettingsText(file.desc.sizes),
            io::momentSettingsText(sizesOf(file.parameters, Quality::Draft, custom)));
}

TEST_F(Moments, ASceneChoosesThem) {
  expectGood(
      joined({"bake", scene(R"(, "solver": "moments", "quality": "low")"), "-o", folder_ / "t.exr"},
             {"--moments", "nodesR=6,degree=4"}));
  EXPECT_EQ(tables("t.exr").desc.quality, Quality::Low);
  expectGood(joined({"bake", folder_ / "scene.json", "-o", folder_ / "t.exr"}, smallMoments()));
  EXPECT_EQ(tables("t.exr").desc.quality, Quality::Draft);  // Options beat the scene.
}

// Its light passes the horizon, however deep its centre lies below it.
TEST_F(Moments, SoftSunsBelowTheHorizonAreThoseOfTheReference) {
  const std::string queries = folder_.write("soft.json", R"({"queries": [
  {"id": "a", "altitude_m": 2, "view_zenith_deg": 90.2, "sun_zenith_deg": 90.1, "azimuth_deg": 0, "distance_m": null},
  {"id": "b", "altitude_m": 2, "view_zenith_deg": 80, "sun_zenith_deg": 90.2, "azimuth_deg": 0, "distance_m": null},
  {"id": "c", "altitude_m": 3000, "view_zenith_deg": 91, "sun_zenith_deg": 91.9, "azimuth_deg": 30, "distance_m": null}]})");
  for (const double degrees : {0.2667, 4.3}) {
    nlohmann::json earth = nlohmann::json::parse(runProgram({"presets", "earth"}).out);
    earth["sun_angular_radius_deg"] = degrees;
    const std::string atmosphere = folder_.write("soft_earth.json", earth.dump());
    for (const char* method : {"tables", "reference"})
      expectGood({"probe", atmosphere, "--queries", queries, "-o", folder_ / method, "--method",
                  method, "--orders", "1"});
    const nlohmann::json tables = jsonOf("tables")["answers"];
    const nlohmann::json truth = jsonOf("reference")["answers"];
    ASSERT_EQ(tables.size(), truth.size());
    for (size_t i = 0; i < truth.size(); ++i) {
      for (size_t c = 0; c < 3; ++c) {
        const double expected = truth[i]["sky_radiance"][c], got = tables[i]["sky_radiance"][c];
        EXPECT_GT(expected, 0.0);
        EXPECT_LT(std::abs(got - expected), 0.015 * expected)
            << truth[i]["id"] << ", channel " << c << ": " << got << ", right " << expected;
      }
    }
  }
}

TEST_F(Moments, TheSameBakeGivesTheSameFile) {
  expectGood(joined({"bake", "earth", "-o", folder_ / "a.exr"}, smallMoments()));
  expectGood(joined({"bake", "earth", "-o", folder_ / "b.exr"}, smallMoments()));
  EXPECT_EQ(contentsOf(folder_ / "a.exr"), contentsOf(folder_ / "b.exr"));
}

TEST_F(Moments, KeepOrdersSavesEachOrder) {
  const std::vector<std::string> keep = {"--orders", "3", "--keep-orders"};
  expectGood(joined(joined({"bake", "earth", "-o", folder_ / "t.exr"}, smallMoments()), keep));
  const io::TableFile file = tables("t.exr");
  for (const char* name : {"optical_depth", "moments", "source", "moments_order_1",
                           "moments_order_2", "source_order_2", "source_order_3"}) {
    ASSERT_NE(file.find(name), nullptr) << name;
  }
  EXPECT_EQ(file.parts.size(), 7u);
  EXPECT_NE(file.find("moments_order_1")->texels, file.find("moments_order_2")->texels);
  EXPECT_NE(file.find("source_order_2")->texels, file.find("source_order_3")->texels);
}

TEST_F(Moments, ATableFileGivesTheSameAnswers) {
  for (const char* format : {"half", "float"}) {
    const std::vector<std::string> options = joined(smallMoments(), {"--format", format});
    expectGood(probeOf(options));
    const std::string direct = contentsOf(folder_ / "a.json");
    expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, options));
    expectGood(probeOf({"--tables", folder_ / "t.exr"}));
    EXPECT_EQ(contentsOf(folder_ / "a.json"), direct);
    expectGood(probeOf(joined(options, {"--tables", folder_ / "t.exr"})));
    EXPECT_EQ(contentsOf(folder_ / "a.json"), direct);
  }
  // As with the orders kept, which cost memory only.
  expectGood(probeOf(smallMoments()));
  const std::string plain = contentsOf(folder_ / "a.json");
  expectGood(probeOf(joined(smallMoments(), {"--keep-orders"})));
  EXPECT_EQ(contentsOf(folder_ / "a.json"), plain);
}

TEST_F(Moments, ATableFileGivesTheSamePicture) {
  expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, smallMoments()));
  expectGood(joined({"render", scene(), "-o", folder_ / "a.exr"}, smallMoments()));
  expectGood({"render", scene(), "-o", folder_ / "b.exr", "--tables", folder_ / "t.exr"});
  const io::Result<io::LinearImage> a = io::readExr(folder_ / "a.exr");
  const io::Result<io::LinearImage> b = io::readExr(folder_ / "b.exr");
  ASSERT_TRUE(a && b);
  // The first's tables are planned for its sun alone, within the plan's error of 1 %.
  ASSERT_EQ(a->pixels.size(), b->pixels.size());
  for (size_t i = 0; i < a->pixels.size(); ++i)
    ASSERT_NEAR(a->pixels[i], b->pixels[i], 0.01f * b->pixels[i] + 1e-6f) << i;
  float brightest = 0.0f;
  for (const float value : a->pixels) {
    ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << value;
    brightest = std::max(brightest, value);
  }
  EXPECT_GT(brightest, 0.01f);
}

TEST_F(Moments, TheReportNamesTheirPasses) {
  expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr", "--report", folder_ / "r.json"},
                    smallMoments()));
  const nlohmann::json report = jsonOf("r.json");
  std::string names;
  for (const nlohmann::json& pass : report["passes"]) {
    names += pass["name"].get<std::string>() + ";";
  }
  for (const char* pass : {"T;", "L 1;", "N 1;", "J 2;", "N sum;", "J sum;"}) {
    EXPECT_NE(names.find(pass), std::string::npos) << names;
  }
}

// Single scattering is integrated along the ray, so that of few nodes is good already.
TEST_F(Moments, SingleScatteringIsTheReferences) {
  expectGood(probeOf({"--method", "reference", "--orders", "1"}));
  const nlohmann::json exact = jsonOf("a.json")["answers"];
  expectGood(probeOf({"--orders", "1", "--quality", "draft"}));
  const nlohmann::json baked = jsonOf("a.json")["answers"];
  for (size_t i = 0; i < 3; ++i) {
    for (const char* field :
         {"transmittance", "sky_radiance", "ground_radiance", "direct", "sky"}) {
      if (!exact[i].contains(field)) continue;
      for (size_t c = 0; c < 3; ++c) {
        const double truth = exact[i][field][c];
        EXPECT_NEAR(baked[i][field][c].get<double>(), truth, 0.02 * truth + 1e-7)
            << exact[i]["id"] << " " << field;
      }
    }
  }
}

}  // namespace
}  // namespace alpenglow::test
