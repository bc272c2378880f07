#include <cmath>
#include <filesystem>

#include "../io/schema.h"
#include "program.h"

namespace alpenglow::test {
namespace {

const char* const kQueries = R"({"queries": [
  {"id": "horizon", "altitude_m": 2, "view_zenith_deg": 88, "sun_zenith_deg": 70, "azimuth_deg": 45, "distance_m": null},
  {"id": "surface", "kind": "irradiance", "altitude_m": 0, "sun_zenith_deg": 60},
  {"id": "down", "altitude_m": 10000, "view_zenith_deg": 180, "sun_zenith_deg": 30, "azimuth_deg": 0, "distance_m": null},
  {"id": "nothing", "altitude_m": 100, "view_zenith_deg": 45, "sun_zenith_deg": 30, "azimuth_deg": 0, "distance_m": 0},
  {"id": "missed", "altitude_m": 1e6, "view_zenith_deg": 10, "sun_zenith_deg": 30, "azimuth_deg": 0, "distance_m": null}]})";

class Probe : public Program {
 protected:
  Probe() : queries_(folder_.write("q.json", kQueries)) {}

  std::vector<std::string> probeOf(const std::vector<std::string>& more) {
    return joined({"probe", "earth", "--queries", queries_, "-o", folder_ / "a.json"}, more);
  }
  nlohmann::json answers() { return jsonOf("a.json")["answers"]; }

  std::string queries_;
};

void expectZeros(const nlohmann::json& values) {
  EXPECT_EQ(values, nlohmann::json({0.0, 0.0, 0.0}));
}

void expectContract(const nlohmann::json& list) {
  ASSERT_EQ(list.size(), 5u);
  const char* const ids[] = {"horizon", "surface", "down", "nothing", "missed"};
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(list[i]["id"], ids[i]);
  EXPECT_EQ(list[0]["hits_ground"], false);
  EXPECT_EQ(list[2]["hits_ground"], true);
  EXPECT_GT(list[0]["sky_radiance"][2], 0.0);
  expectZeros(list[0]["ground_radiance"]);
  EXPECT_GT(list[2]["ground_radiance"][0], 0.0);
  EXPECT_GT(list[1]["direct"][0], 0.3);
  EXPECT_LT(list[1]["direct"][0], 0.5);  // T cos 60 degrees.
  for (size_t i : {size_t{3}, size_t{4}}) {
    EXPECT_EQ(list[i]["hits_ground"], false);
    EXPECT_EQ(list[i]["transmittance"], nlohmann::json({1.0, 1.0, 1.0}));
    expectZeros(list[i]["sky_radiance"]);
    expectZeros(list[i]["ground_radiance"]);
  }
}

// A distance that no float holds is cut at the top like any other.
TEST_F(Probe, CutsAnyDistance) {
  nlohmann::json queries = nlohmann::json::parse(kQueries);
  queries["queries"][0]["distance_m"] = 1e300;
  folder_.write("q.json", queries.dump());
  expectGood(probeOf(smallTables()));
  const nlohmann::json cut = answers()[0];
  folder_.write("q.json", kQueries);
  expectGood(probeOf(smallTables()));
  EXPECT_EQ(cut, answers()[0]);
}

TEST_F(Probe, SaysOneLineWhateverAnIdHolds) {
  folder_.write("q.json", R"({"queries": [{"id": "a\nb\u001b[31m"}]})");
  expectRefused(probeOf({}), {"a?b?[31m", "altitude_m"});
}

// The rule for packed Mie takes its colour from Rayleigh scattering, if there is any.
TEST_F(Probe, PackedMieNeedsNoRayleighScattering) {
  nlohmann::json atmosphere = nlohmann::json::parse(runProgram({"presets", "mars"}).out);
  atmosphere["rayleigh"] = nullptr;
  const std::string file = folder_.write("dust.json", atmosphere.dump());
  nlohmann::json skies[2];
  for (const bool packed : {false, true}) {
    std::vector<std::string> arguments = joined(probeOf(smallTables()), {"--format", "float"});
    arguments[1] = file;
    expectGood(joined(arguments, {"--mie", packed ? "packed" : "full"}));
    skies[packed ? 1 : 0] = answers()[0]["sky_radiance"];
  }
  for (size_t i = 0; i < 3; ++i) {
    const double full = skies[0][i];
    EXPECT_GT(full, 0.0);
    EXPECT_NEAR(skies[1][i].get<double>(), full, 0.3 * full) << i;
  }
}

TEST_F(Probe, AnswersOnTheDevice) {
  expectGood(probeOf(smallTables()));
  EXPECT_EQ(schemaError(ALPENGLOW_SCHEMA_FOLDER, "answers.schema.json", jsonOf("a.json")), "");
  expectContract(answers());
  EXPECT_GT(answers()[1]["sky"][2], 0.0);
}

TEST_F(Probe, TheReferenceAnswersOrderOne) {
  expectGood(probeOf({"--method", "reference", "--orders", "1", "--report", folder_ / "r.json"}));
  EXPECT_EQ(schemaError(ALPENGLOW_SCHEMA_FOLDER, "answers.schema.json", jsonOf("a.json")), "");
  EXPECT_EQ(schemaError(ALPENGLOW_SCHEMA_FOLDER, "report.schema.json", jsonOf("r.json")), "");
  EXPECT_TRUE(jsonOf("r.json")["device"].is_null());
  expectContract(answers());
  expectZeros(answers()[1]["sky"]);
  for (const nlohmann::json& answer : answers()) EXPECT_TRUE(answer.contains("standard_error"));
}

// The tables' own accuracy is tested elsewhere: 50 trapezoids of a ray and few texels are off by
// tens of per cent. That queries, units and channels are passed on rightly shows all the same.
TEST_F(Probe, BothMethodsAgree) {
  expectGood(probeOf({"--method", "reference", "--orders", "1"}));
  const nlohmann::json exact = answers();
  expectGood(probeOf({"--solver", "standard", "--orders", "1", "--size-scattering", "32x64x32x8",
                      "--format", "float"}));
  const nlohmann::json baked = answers();
  for (size_t i = 0; i < 5; ++i) {
    for (const char* field : {"transmittance", "sky_radiance", "ground_radiance", "direct"}) {
      if (!exact[i].contains(field)) continue;
      for (size_t c = 0; c < 3; ++c) {
        const double truth = exact[i][field][c];
        EXPECT_NEAR(baked[i][field][c].get<double>(), truth, 0.25 * truth + 1e-5)
            << exact[i]["id"] << " " << field;
      }
    }
  }
}

TEST_F(Probe, ATableFileGivesTheSameAnswers) {
  expectGood(probeOf(smallTables()));
  const std::string direct = contentsOf(folder_ / "a.json");
  expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, smallTables()));
  expectGood(probeOf({"--tables", folder_ / "t.exr"}));
  EXPECT_EQ(contentsOf(folder_ / "a.json"), direct);
}

TEST_F(Probe, TablesOfAnotherKindAreRefused) {
  expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, smallTables()));
  const std::string tables = folder_ / "t.exr";
  expectGood(probeOf({"--tables", tables, "--orders", "2", "--format", "half"}));
  std::filesystem::remove(folder_ / "a.json");
  expectRefused(probeOf({"--tables", tables, "--orders", "3"}), {"--orders 3", "t.exr", "2"});
  expectRefused(probeOf({"--tables", tables, "--format", "float"}), {"--format float", "half"});
  expectRefused(probeOf({"--tables", tables, "--mie", "packed"}), {"--mie packed", "full"});
  expectRefused(probeOf({"--tables", tables, "--size-scattering", "4x8x8x4"}), {"4x8x8x2"});
  expectRefused(
      {"probe", "mars", "--queries", queries_, "-o", folder_ / "a.json", "--tables", tables},
      {"t.exr", "another atmosphere", "bottom_radius_m"});
  std::string bytes = contentsOf(tables);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] + 1);
  folder_.write("bad.exr", bytes);
  expectRefused(probeOf({"--tables", folder_ / "bad.exr"}), {"bad.exr", "altered"});
  expectRefused(probeOf({"--tables", folder_ / "absent.exr"}), {"absent.exr"});
}

TEST_F(Probe, TheReferenceAnswersAllOrders) {
  const std::vector<std::string> all = {"--method", "reference", "--samples", "4096"};
  expectGood(joined(probeOf(all), {"--report", folder_ / "r.json"}));
  EXPECT_EQ(schemaError(ALPENGLOW_SCHEMA_FOLDER, "answers.schema.json", jsonOf("a.json")), "");
  EXPECT_EQ(schemaError(ALPENGLOW_SCHEMA_FOLDER, "report.schema.json", jsonOf("r.json")), "");
  expectContract(answers());
  const std::string text = contentsOf(folder_ / "a.json");
  const nlohmann::json whole = answers();
  EXPECT_GT(whole[1]["sky"][2], 0.02);
  EXPECT_GT(whole[1]["standard_error"]["sky"][2], 0.0);
  expectGood(probeOf(all));
  EXPECT_EQ(contentsOf(folder_ / "a.json"), text) << "the same question, the same answer";

  expectGood(joined(probeOf(all), {"--orders", "2"}));
  const nlohmann::json two = answers();
  expectGood(probeOf({"--method", "reference", "--orders", "1"}));
  const nlohmann::json one = answers();
  for (size_t c = 0; c < 3; ++c) {
    const auto sky = [&](const nlohmann::json& list) {
      return list[0]["sky_radiance"][c].get<double>();
    };
    EXPECT_GT(sky(two), 1.05 * sky(one));
    EXPECT_GT(sky(whole), 1.005 * sky(two));
    EXPECT_EQ(one[0]["transmittance"][c], whole[0]["transmittance"][c]);
  }
}

TEST_F(Probe, MoreSamplesMeanSmallerErrors) {
  double errors[2];
  for (const bool many : {false, true}) {
    expectGood(probeOf({"--method", "reference", "--samples", many ? "65536" : "4096"}));
    errors[many ? 1 : 0] = answers()[0]["standard_error"]["sky_radiance"][2];
  }
  EXPECT_LT(errors[1], 0.6 * errors[0]);
  EXPECT_GT(errors[1], 0.0);
}

// A scene's orders count, as they do with tables.
TEST_F(Probe, TheReferenceTakesTheScenesOrders) {
  const std::string scene = folder_.write("s.json", R"({"atmosphere": "earth", "orders": 1,
      "sun": {"elevation_deg": 5, "azimuth_deg": 90, "disc_radius_deg": 0.2667},
      "camera": {"latitude_deg": 0, "longitude_deg": 0, "altitude_m": 2, "heading_deg": 90,
                 "pitch_deg": 10, "roll_deg": 0, "projection": "perspective", "fov_deg": 60}})");
  std::vector<std::string> arguments = probeOf({"--method", "reference"});
  arguments[1] = scene;
  expectGood(arguments);
  expectZeros(answers()[1]["sky"]);
}

TEST_F(Probe, TheReferenceRefusesWhatItHasNot) {
  expectRefused(probeOf({"--method", "reference", "--orders", "0"}), {"--orders", "'0'"});
  for (const char* samples : {"0", "-1", "1e3", "many", "9999999999"}) {
    expectRefused(probeOf({"--method", "reference", "--samples", samples}),
                  {"--samples", samples, "from 1 to 999999999"});
  }
  expectRefused(probeOf({"--samples", "4096"}), {"--samples", "--method tables"});
  expectRefused(probeOf({"--method", "reference", "--orders", "1", "--tables", "t.exr"}),
                {"--tables"});
  expectRefused(probeOf({"--method", "reference", "--orders", "1", "--format", "half"}),
                {"--format"});
  expectRefused(probeOf({"--method", "reference", "--orders", "1", "--keep-orders"}),
                {"--keep-orders"});
}

TEST_F(Probe, BadQueriesFailTheFile) {
  const auto refused = [&](const std::string& query, const std::vector<std::string>& words) {
    const std::string file = folder_.write("bad.json", "{\"queries\": [" + query + "]}");
    expectRefused({"probe", "earth", "--queries", file, "-o", folder_ / "a.json"}, words);
  };
  refused(R"({"id": "x", "altitude_m": -1, "view_zenith_deg": 8, "sun_zenith_deg": 9,
              "azimuth_deg": 4, "distance_m": null})",
          {"'x'", "altitude_m", "-1"});
  refused(R"({"id": "x", "altitude_m": NaN, "view_zenith_deg": 8, "sun_zenith_deg": 9,
              "azimuth_deg": 4, "distance_m": null})",
          {"'x'", "altitude_m", "NaN"});
  refused(R"({"id": "x", "kind": "flux", "altitude_m": 1, "sun_zenith_deg": 9})",
          {"'x'", "kind", "flux"});
  refused(R"({"kind": "irradiance", "altitude_m": 1, "sun_zenith_deg": 9})", {"id", "missing"});
  expectRefused({"probe", "earth", "--queries", folder_ / "none.json", "-o", folder_ / "a.json"},
                {"none.json"});
}

TEST_F(Probe, KeepsOrdersWhileBaking) {
  expectGood(probeOf(joined(smallTables(), {"--report", folder_ / "a-report.json"})));
  const std::string plain = contentsOf(folder_ / "a.json");
  expectGood(
      probeOf(joined(smallTables(), {"--keep-orders", "--report", folder_ / "b-report.json"})));
  EXPECT_EQ(contentsOf(folder_ / "a.json"), plain);
  EXPECT_GT(jsonOf("b-report.json")["totals"]["bytes"], jsonOf("a-report.json")["totals"]["bytes"]);
  expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, smallTables()));
  expectGood(probeOf({"--keep-orders", "--tables", folder_ / "t.exr"}));
  EXPECT_EQ(contentsOf(folder_ / "a.json"), plain);
}

TEST_F(Probe, BadOutputsAreRefusedBeforeTheBake) {
  for (const std::string& output : {std::string("/dev/full"), std::string("/proc/a.json"),
                                    folder_.path(), folder_ / "no/such/a.json"}) {
    expectRefused(joined({"probe", "earth", "--queries", queries_, "-o", output}, endlessTables()),
                  {output});
    expectRefused(probeOf(joined(endlessTables(), {"--report", output})), {output});
  }
}

// Neither replaced nor written over: lines before and after stay.
// By any name that leads there.
TEST_F(Probe, InputsAreNotOverwritten) {
  const std::string link = folder_ / "link.json", hard = folder_ / "hard.json";
  std::filesystem::create_symlink(queries_, link);
  std::filesystem::create_hard_link(queries_, hard);
  const std::string scene = folder_.write(
      "scene.json", R"({"atmosphere": "earth", "camera": {}, "sun": {"elevation_deg": 9}})");
  for (const std::string& output : {queries_, link, hard}) {
    expectRefused(joined({"probe", scene, "--queries", queries_, "-o", output}, endlessTables()),
                  {"-o", output, "overwritten"});
    expectRefused(joined(probeOf(endlessTables()), {"--report", output}),
                  {"--report", output, "overwritten"});
  }
  expectRefused(joined({"probe", scene, "--queries", queries_, "-o", scene}, endlessTables()),
                {"-o", scene, "overwritten"});
  expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, smallMoments()));
  expectRefused({"render", scene, "--tables", folder_ / "t.exr", "-o", folder_ / "t.exr"},
                {"-o", "t.exr", "overwritten"});
  EXPECT_EQ(contentsOf(queries_), kQueries);
}

TEST_F(Probe, TheStandardOutputGoesOnWhereItIs) {
  const std::string probe = std::string(ALPENGLOW_PROGRAM) + " probe earth --queries " + queries_ +
                            " --method reference --orders 1 -o ";
  const std::string log = folder_ / "log";
  const std::string lines = "(echo before; " + probe + "/dev/stdout; echo after) > " + log;
  ASSERT_EQ(std::system(lines.c_str()), 0);
  ASSERT_EQ(std::system((probe + (folder_ / "a.json")).c_str()), 0);
  EXPECT_EQ(contentsOf(log), "before\n" + contentsOf(folder_ / "a.json") + "after\n");
  const std::string piped = probe + "/dev/stdout | cat > " + log;
  ASSERT_EQ(std::system(piped.c_str()), 0);
  EXPECT_EQ(contentsOf(log), contentsOf(folder_ / "a.json"));
}

TEST_F(Probe, AnAnswerFileMayBeADevice) {
  expectGood({"probe", "earth", "--queries", queries_, "-o", "/dev/null", "--method", "reference",
              "--orders", "1"});
  expectRefused({"probe", "earth", "--queries", queries_, "-o", "/dev/full", "--method",
                 "reference", "--orders", "1"},
                {"/dev/full"});
}

}  // namespace
}  // namespace alpenglow::test
