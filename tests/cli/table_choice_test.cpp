// Which solver is meant, options that belong to the other, and table files of another kind.
#include <alpenglow/io/table_file.h>

#include "program.h"

namespace alpenglow::test {
namespace {

class TableChoice : public Program {
 protected:
  TableChoice() : queries_(folder_.write("q.json", "{\"queries\": []}")) {}

  std::string scene(const std::string& more) {
    return folder_.write(
        "scene.json",
        R"({"atmosphere": "earth", "sun": {"elevation_deg": 1}, "camera": {}, "size": [8, 8])" +
            more + "}");
  }

  /// A table file for the Earth whose texels are zeros.
  std::string tables(TableDesc desc) {
    io::TableFile file;
    EXPECT_EQ(findPreset("earth", &file.parameters, {}), Status::Ok);
    file.desc = io::resolved(desc, file.parameters);
    file.parts = io::expectedParts(file.desc);
    for (io::TablePart& part : file.parts) {
      part.texels.resize(size_t{part.width} * part.height * part.depth *
                         (part.format == TableFormat::Half ? 8 : 16));
    }
    const io::Done done = io::writeTableFile(folder_ / "t.exr", file);
    EXPECT_TRUE(done) << done.error;
    return folder_ / "t.exr";
  }

  std::vector<std::string> probeOf(const std::string& atmosphere,
                                   const std::vector<std::string>& more) {
    return joined({"probe", atmosphere, "--queries", queries_, "-o", folder_ / "a.json"}, more);
  }

  std::string queries_;
};

TEST_F(TableChoice, OptionsOfTheOtherSolverAreRefused) {
  const std::pair<const char*, const char*> ofStandard[] = {{"--mie", "packed"},
                                                            {"--size-transmittance", "64x16"},
                                                            {"--size-irradiance", "16x4"},
                                                            {"--size-scattering", "4x8x8x2"}};
  const std::pair<const char*, const char*> ofMoments[] = {{"--quality", "high"},
                                                           {"--moments", "nodesR=8"}};
  const std::string output = folder_ / "t.exr";
  const std::string picture = folder_ / "a.png";
  for (const auto& [option, value] : ofStandard) {
    const std::vector<std::string> words = {std::string(option) + " " + value, "solver standard",
                                            "moments", "--solver standard"};
    expectRefused({"bake", "earth", "-o", output, option, value}, words);
    expectRefused(probeOf("earth", {option, value}), words);
    expectRefused({"render", scene(""), "-o", picture, option, value}, words);
    expectRefused({"bake", "earth", "-o", output, "--solver", "moments", option, value},
                  {option, "standard", "--solver moments was given"});
    expectRefused({"render", scene(R"(, "solver": "moments")"), "-o", picture, option, value},
                  {option, "standard", "scene's solver is moments"});
  }
  for (const auto& [option, value] : ofMoments) {
    expectRefused(
        {"bake", "earth", "-o", output, "--solver", "standard", option, value},
        {std::string(option) + " " + value, "solver moments", "--solver standard was given"});
    expectRefused({"render", scene(R"(, "solver": "standard")"), "-o", picture, option, value},
                  {option, "moments", "scene's solver is standard"});
    // The option beats the scene.
    expectRefused({"render", scene(R"(, "solver": "moments")"), "-o", picture, "--solver",
                   "standard", option, value},
                  {option, "moments", "--solver standard was given"});
  }
}

TEST_F(TableChoice, ASceneChoosesTheSolverUnlessAnOptionDoes) {
  const std::string output = folder_ / "t.exr";
  const auto bake = [&](const std::string& more, const std::vector<std::string>& options) {
    expectGood(
        joined({"bake", scene(more), "-o", output, "--orders", "1", "--size-scattering", "4x8x8x2"},
               options));
    const io::Result<io::TableFile> file = io::readTableFile(output);
    ASSERT_TRUE(file) << file.error;
    EXPECT_EQ(file->desc.solver, Solver::Standard);
  };
  bake(R"(, "solver": "standard")", {});
  // A level that the chosen solver doesn't have is the scene's wish for the other.
  bake(R"(, "solver": "moments", "quality": "high")", {"--solver", "standard"});
}

// The simpler models have no choices and no files, and their own answers.
TEST_F(TableChoice, ASceneOfASimplerModelTakesNoTableOptions) {
  const std::string model = scene(R"(, "model": "oneil", "model_samples": 5)");
  const std::pair<const char*, const char*> options[] = {
      {"--solver", "standard"}, {"--quality", "high"}, {"--orders", "2"},
      {"--format", "float"},    {"--mie", "packed"},   {"--tables", "t.exr"}};
  for (const auto& [option, value] : options)
    expectRefused(probeOf(model, {option, value}), {option, "model is oneil"});
  expectRefused({"bake", model, "-o", folder_ / "t.exr"}, {"model is oneil", "no file"});
  expectGood(probeOf(model, {}));
  expectGood({"render", model, "-o", folder_ / "a.exr"});
}

TEST_F(TableChoice, SettingsThatDoNotFitAreRefused) {
  expectRefused(
      {"bake", "earth", "-o", folder_ / "t.exr", "--moments", "sourceGamma=4096,sourcePsi=4096"},
      {"source", "texels"});
}

TEST_F(TableChoice, FilesOfTheOtherSolverAreRefused) {
  TableDesc standard;
  standard.solver = Solver::Standard;
  standard.sizes = {.transmittanceMu = 64,
                    .transmittanceR = 16,
                    .irradianceMuS = 16,
                    .irradianceR = 4,
                    .scatteringR = 4,
                    .scatteringMu = 8,
                    .scatteringMuS = 8,
                    .scatteringNu = 2};
  const std::string file = tables(standard);
  const std::vector<std::string> load = {"--tables", file};
  expectRefused(probeOf("earth", joined(load, {"--solver", "moments"})),
                {"--solver moments", "t.exr", "standard"});
  expectRefused(probeOf(scene(R"(, "solver": "moments")"), load),
                {"\"solver\": moments", "t.exr", "standard"});
  expectRefused(probeOf("earth", joined(load, {"--quality", "low"})),
                {"--quality low", "moments", "t.exr", "standard"});
  expectRefused(probeOf("earth", joined(load, {"--moments", "nodesR=8"})),
                {"--moments nodesR=8", "t.exr", "standard"});
  tables({});
  expectRefused(probeOf("earth", joined(load, {"--solver", "standard"})),
                {"--solver standard", "t.exr", "moments"});
  expectRefused(probeOf("earth", joined(load, {"--mie", "packed"})),
                {"--mie packed", "standard", "t.exr", "moments"});
  expectRefused(
      {"render", scene(R"(, "solver": "standard")"), "-o", folder_ / "a.png", "--tables", file},
      {"\"solver\": standard", "t.exr", "moments"});
}

TEST_F(TableChoice, FilesOfOtherSettingsAreRefused) {
  TableDesc desc;
  desc.quality = Quality::Low;
  desc.sizes.nodesR = 5;
  const std::vector<std::string> load = {"--tables", tables(desc)};
  expectRefused(probeOf("earth", joined(load, {"--quality", "high"})),
                {"--quality high", "t.exr", "holds low"});
  expectRefused(probeOf(scene(R"(, "quality": "medium")"), load),
                {"\"quality\": medium", "t.exr", "holds low"});
  expectRefused(probeOf("earth", joined(load, {"--moments", "nodesR=6"})),
                {"--moments nodesR=6", "t.exr", "nodesR=5"});
  expectRefused(probeOf("earth", joined(load, {"--orders", "3"})),
                {"--orders 3", "t.exr", "holds all"});
  expectRefused(probeOf("earth", joined(load, {"--format", "float"})),
                {"--format float", "t.exr", "half"});
  expectRefused(probeOf("mars", load), {"t.exr", "another atmosphere"});
}

TEST_F(TableChoice, AStandardFileNeedsNoOption) {
  const std::string file = folder_ / "t.exr";
  expectGood(joined({"bake", "earth", "-o", file}, smallTables()));
  expectGood(probeOf("earth", {"--tables", file, "--size-scattering", "4x8x8x2"}));
  expectGood(
      {"render", scene(R"(, "quality": "high")"), "-o", folder_ / "a.png", "--tables", file});
  expectGood({"render", scene(R"(, "solver": "moments")"), "-o", folder_ / "b.png", "--tables",
              file, "--solver", "standard"});
  EXPECT_EQ(contentsOf(folder_ / "a.png"), contentsOf(folder_ / "b.png"));
}

TEST_F(TableChoice, TheReferenceTakesNoTableOption) {
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--quality", "high"}, {"--moments", "nodesR=8"}}) {
    expectRefused(probeOf("earth", joined({"--method", "reference", "--orders", "1"}, option)),
                  {option[0], "no tables"});
  }
}

}  // namespace
}  // namespace alpenglow::test
