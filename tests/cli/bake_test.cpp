#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/table_file.h>
#include <unistd.h>

#include "../io/schema.h"
#include "program.h"

namespace alpenglow::test {
namespace {

std::vector<std::string> bakeOf(const std::string& atmosphere, const std::string& output,
                                const std::vector<std::string>& more = {}) {
  return joined(joined({"bake", atmosphere, "-o", output}, smallTables()), more);
}

TEST_F(Program, BakesWhatItsOptionsSay) {
  expectGood(bakeOf("mars", folder_ / "t.exr", {"--format", "float", "--mie", "packed"}));
  const io::Result<io::TableFile> file = io::readTableFile(folder_ / "t.exr", true);
  ASSERT_TRUE(file) << file.error;
  EXPECT_EQ(file->desc.orders, 2u);
  EXPECT_EQ(file->desc.format, TableFormat::Float);
  EXPECT_EQ(file->desc.mie, MieStorage::Packed);
  EXPECT_EQ(io::scatteringSizeText(file->desc.sizes), "4x8x8x2");
  EXPECT_EQ(io::irradianceSizeText(file->desc.sizes), "16x4");
  EXPECT_EQ(io::transmittanceSizeText(file->desc.sizes), "64x16");
  EXPECT_EQ(file->parts.size(), 3u);
  EXPECT_EQ(folder_.names().size(), 1u);
}

// Proves that the net of runProgram holds: asked for advice, the layer has something to say.
TEST_F(Program, ValidationMessagesFailTheProgram) {
  const Outcome outcome = runProgram(bakeOf("earth", folder_ / "t.exr"), validated(true));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Validation"), std::string::npos) << outcome.out;
}

TEST_F(Program, TheSameBakeGivesTheSameFile) {
  expectGood(bakeOf("earth", folder_ / "a.exr"));
  expectGood(bakeOf("earth", folder_ / "b.exr"));
  EXPECT_EQ(contentsOf(folder_ / "a.exr"), contentsOf(folder_ / "b.exr"));
}

TEST_F(Program, APresetPrintedToAFileBakesTheSame) {
  const Outcome printed = runProgram({"presets", "earth-hazy"});
  ASSERT_EQ(printed.status, 0);
  const std::string file = folder_.write("mine.json", printed.out);
  expectGood(bakeOf("earth-hazy", folder_ / "a.exr"));
  expectGood(bakeOf(file, folder_ / "b.exr"));
  EXPECT_EQ(contentsOf(folder_ / "a.exr"), contentsOf(folder_ / "b.exr"));
}

TEST_F(Program, ASceneFileIsAnAtmosphereToo) {
  const std::string scene = folder_.write(
      "scene.json",
      R"({"atmosphere": "mars", "sun": {"elevation_deg": 1}, "camera": {}, "orders": 3})");
  expectGood({"bake", scene, "-o", folder_ / "t.exr", "--solver", "standard", "--size-scattering",
              "4x8x8x2"});
  const io::Result<io::TableFile> file = io::readTableFile(folder_ / "t.exr");
  ASSERT_TRUE(file) << file.error;
  Parameters mars;
  ASSERT_EQ(findPreset("mars", &mars, {}), Status::Ok);
  EXPECT_EQ(io::firstDifference(file->parameters, mars), "");
  EXPECT_EQ(file->desc.orders, 3u);
  expectGood(bakeOf(scene, folder_ / "t.exr"));  // Options beat the scene.
  EXPECT_EQ(io::readTableFile(folder_ / "t.exr")->desc.orders, 2u);
}

TEST_F(Program, NamesTakePrecedenceOverFiles) {
  const Outcome mars = runProgram({"presets", "mars"});
  const std::string program = ALPENGLOW_PROGRAM;
  folder_.write("earth", mars.out);
  const auto bake = [&](const std::string& name) {
    const std::string command = "cd " + folder_.path() + " && " + program + " bake " + name +
                                " -o t.exr --solver standard --orders 1 --size-scattering 4x8x8x2";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return io::readTableFile(folder_ / "t.exr")->parameters.bottomRadius_m;
  };
  EXPECT_GT(bake("earth"), 6e6);
  EXPECT_LT(bake("./earth"), 4e6);
}

// Every order's tables add up: with one order there is just the first.
TEST_F(Program, KeepOrdersSavesEachOrder) {
  expectGood(bakeOf("earth", folder_ / "t.exr", {"--keep-orders", "--format", "float"}));
  const io::Result<io::TableFile> file = io::readTableFile(folder_ / "t.exr", true);
  ASSERT_TRUE(file) << file.error;
  for (const char* name :
       {"optical_depth", "irradiance", "scattering", "single_mie", "scattering_order_1",
        "single_mie_order_1", "irradiance_order_1", "scattering_order_2", "irradiance_order_2"}) {
    ASSERT_NE(file->find(name), nullptr) << name;
  }
  EXPECT_EQ(file->parts.size(), 9u);
  // E is the sky's irradiance only, so with two orders it is that of order 2.
  EXPECT_EQ(file->find("irradiance")->texels, file->find("irradiance_order_2")->texels);
  EXPECT_NE(file->find("scattering_order_1")->texels, file->find("scattering_order_2")->texels);
}

TEST_F(Program, TheReportAddsUp) {
  expectGood(bakeOf("earth", folder_ / "t.exr", {"--report", folder_ / "r.json"}));
  const nlohmann::json report = jsonOf("r.json");
  EXPECT_EQ(schemaError(ALPENGLOW_SCHEMA_FOLDER, "report.schema.json", report), "");
  EXPECT_TRUE(report["device"].is_string());
  uint64_t dispatches = 0;
  uint64_t bytes = 0;
  std::string names;
  for (const nlohmann::json& pass : report["passes"]) {
    dispatches += pass["dispatches"].get<uint64_t>();
    bytes = std::max(bytes, pass["bytes"].get<uint64_t>());
    names += pass["name"].get<std::string>() + ";";
    EXPECT_TRUE(pass["cpu_seconds"].is_number());
  }
  EXPECT_EQ(dispatches, report["totals"]["dispatches"].get<uint64_t>());
  EXPECT_GT(dispatches, 0u);
  EXPECT_EQ(report["totals"]["draws"], 0);
  EXPECT_LE(bytes, report["totals"]["bytes"].get<uint64_t>());
  for (const char* pass : {"T;", "dE 1;", "dS 1;", "dJ 2;", "dE 2;", "dS 2;"}) {
    EXPECT_NE(names.find(pass), std::string::npos) << names;
  }
}

TEST_F(Program, BadAtmospheresAreNamed) {
  const std::string output = folder_ / "t.exr";
  expectRefused(bakeOf("pluto", output), {"'pluto'"});
  expectRefused(bakeOf(folder_ / "absent.json", output), {"absent.json"});
  expectRefused(bakeOf(folder_.path(), output), {"folder"});
  expectRefused(bakeOf(folder_.write("a.json", "{"), output), {"a.json", "JSON"});
  expectRefused(bakeOf(folder_.write("a.json", "{\"top\": 1}"), output), {"a.json", "'top'"});
  std::string text = runProgram({"presets", "earth"}).out;
  const size_t at = text.find("\"asymmetry\": 0.");
  ASSERT_NE(at, std::string::npos);
  expectRefused(bakeOf(folder_.write("a.json", text.replace(at + 13, 1, "7")), output),
                {"asymmetry", "7."});
}

TEST_F(Program, UnwritableOutputs) {
  for (const std::string& output :
       {folder_ / "no/such/t.exr", folder_.path(), std::string("/dev/full"),
        std::string("/proc/t.exr"), std::string("")}) {
    expectRefused(bakeOf("earth", output), {output});
    expectRefused(bakeOf("earth", folder_ / "t.exr", {"--report", folder_ / "no/such/r.json"}),
                  {"r.json"});
  }
  expectRefused(bakeOf("earth", folder_ / "t.exr", {"--report", folder_ / "t.exr"}), {"both"});
}

TEST_F(Program, BadOutputsAreRefusedBeforeTheBake) {
  const auto refused = [&](const std::string& output, const std::vector<std::string>& words,
                           const std::vector<std::string>& more = {}) {
    expectRefused(joined(joined({"bake", "earth", "-o", output}, endlessTables()), more), words);
  };
  for (const char* other : {"t.png", "t", "t.EXR"}) refused(folder_ / other, {other, ".exr"});
  for (const char* device : {"null", "full", "stdout"}) {
    refused(std::string("/dev/") + device, {device});
    const std::string link = folder_ / (std::string(device) + ".exr");
    std::filesystem::create_symlink(std::string("/dev/") + device, link);
    refused(link, {link, "a file is needed"});
  }
  std::filesystem::create_directory(folder_ / "folder.exr");
  refused(folder_ / "folder.exr", {"folder.exr", "folder"});
  refused("/proc/t.exr", {"/proc/t.exr"});
  refused(folder_ / "no/such/t.exr", {"t.exr"});
  for (const std::string& report : {std::string("/dev/full"), std::string("/proc/r.json"),
                                    folder_.path(), folder_ / "no/such/r.json"}) {
    refused(folder_ / "t.exr", {report}, {"--report", report});
  }
}

TEST_F(Program, AnOldFileIsReplacedWholeOrKept) {
  folder_.write("t.exr", "old");
  expectRefused(bakeOf("pluto", folder_ / "t.exr"), {"'pluto'"});
  EXPECT_EQ(contentsOf(folder_ / "t.exr"), "old");
  expectGood(bakeOf("earth", folder_ / "t.exr"));
  EXPECT_TRUE(io::readTableFile(folder_ / "t.exr"));
  EXPECT_EQ(folder_.names().size(), 1u);
}

}  // namespace
}  // namespace alpenglow::test
