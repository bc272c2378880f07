// Commands, options and the messages for wrong ones.
#include <alpenglow/version.h>

#include <fstream>

#include "program.h"

namespace alpenglow::test {
namespace {

TEST_F(Program, HelpIsEverywhere) {
  for (const char* command : {"", "presets", "bake", "render", "probe"}) {
    std::vector<std::string> arguments = {"--help"};
    if (*command != '\0') arguments.insert(arguments.begin(), command);
    const Outcome outcome = runProgram(arguments);
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("Usage: alpenglow"), std::string::npos);
    EXPECT_NE(outcome.out.find(command), std::string::npos);
  }
}

TEST_F(Program, HelpNamesWhatExistsAndNothingElse) {
  const std::string all = runProgram({"--help"}).out;
  for (const char* command : {"presets", "bake", "render", "probe", "explain"}) {
    EXPECT_NE(all.find(command), std::string::npos) << command;
  }
  for (const char* command : {"bake", "render", "probe"}) {
    const std::string help = runProgram({command, "--help"}).out;
    for (const char* option : {"--output", "--solver", "--orders", "--quality", "--moments",
                               "--size-transmittance", "--size-irradiance", "--size-scattering",
                               "--format", "--mie", "--keep-orders", "--device", "--report"}) {
      EXPECT_NE(help.find(option), std::string::npos) << command << " " << option;
    }
    const bool flythroughs = help.find("--flythrough") != std::string::npos;
    EXPECT_EQ(flythroughs, std::string(command) == "render") << command;
  }
}

TEST_F(Program, Version) {
  const Outcome outcome = runProgram({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "alpenglow " ALPENGLOW_VERSION_STRING "\n");
}

TEST_F(Program, UnknownCommandsAndOptions) {
  expectRefused({}, {"command", "presets, bake, render, probe"});
  expectRefused({"--quiet"}, {"--quiet"});
  expectRefused({"presets", "--json"}, {"--json"});
  expectRefused({"presets", "earth", "mars"}, {"mars"});
  expectRefused({"bake", "earth", "-o", folder_ / "t.exr", "--flythrough", "w"}, {"--flythrough"});
  expectRefused({"bake", "-o", folder_ / "t.exr"}, {"ATMOSPHERE", "required"});
  expectRefused({"bake", "earth"}, {"--output", "required"});
  expectRefused({"bake", "earth", "-o"}, {"--output"});
  expectRefused({"probe", "earth", "-o", folder_ / "a.json"}, {"--queries", "required"});
}

#ifdef ALPENGLOW_WITH_COST
TEST_F(Program, CostWritesToAFolder) {
  EXPECT_NE(runProgram({"--help"}).out.find("cost"), std::string::npos);
  expectRefused({"cost"}, {"--output", "required"});
  std::ofstream(folder_ / "file") << "x";
  expectRefused({"cost", "-o", folder_ / "file"}, {folder_ / "file", "a file is in its place"});
}
#endif

TEST_F(Program, WrongValues) {
  const std::pair<const char*, const char*> bad[] = {{"--solver", "exact"},
                                                     {"--quality", "default"},
                                                     {"--quality", "High"},
                                                     {"--moments", ""},
                                                     {"--moments", "nodesR"},
                                                     {"--moments", "nodes=3"},
                                                     {"--moments", "degree=99"},
                                                     {"--orders", "0"},
                                                     {"--orders", "1001"},
                                                     {"--orders", "-1"},
                                                     {"--orders", "two"},
                                                     {"--orders", "2.5"},
                                                     {"--size-transmittance", "256"},
                                                     {"--size-transmittance", "1x64"},
                                                     {"--size-irradiance", "64x16x2"},
                                                     {"--size-irradiance", "0x16"},
                                                     {"--size-scattering", "32x128"},
                                                     {"--size-scattering", "4096x4096x4096x4096"},
                                                     {"--size-scattering", "8x7x8x4"},
                                                     {"--format", "double"},
                                                     {"--format", "HALF"},
                                                     {"--mie", "none"}};
  for (const auto& [option, value] : bad) {
    expectRefused({"bake", "earth", "-o", folder_ / "t.exr", option, value}, {option});
  }
  expectRefused({"probe", "earth", "--queries", "q", "-o", "a", "--method", "exact"},
                {"--method", "'exact'", "'tables' or 'reference'"});
  for (const char* size : {"10", "0x10", "10x", "10x10x10", "99999x10", "ax b"}) {
    expectRefused({"render", "clear_noon", "-o", folder_ / "a.png", "--size", size}, {"--size"});
  }
  expectRefused({"bake", "earth", "-o", folder_ / "t.exr", "--format", "half", "--format", "half"},
                {"--format"});
}

TEST_F(Program, PresetsAreListedNameFirst) {
  const Outcome outcome = runProgram({"presets"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* name : {"earth", "earth-fig6", "earth-fig7", "earth-hazy", "mars"}) {
    const std::string start = std::string(name) + " ";
    EXPECT_TRUE(outcome.out.rfind(start, 0) == 0 ||
                outcome.out.find("\n" + start) != std::string::npos)
        << name;
  }
  expectRefused({"presets", "pluto"}, {"'pluto'"});
}

TEST_F(Program, AFullStandardOutputIsNoticed) {
  const std::string command =
      std::string(ALPENGLOW_PROGRAM) + " presets > /dev/full 2> " + (folder_ / "err");
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_EQ(contentsOf(folder_ / "err"), "Cannot write to the standard output.\n");
}

TEST_F(Program, WithoutVulkanThereIsASentence) {
  const std::vector<std::string> none = {"VK_DRIVER_FILES=/nonexistent",
                                         "VK_ICD_FILENAMES=/nonexistent"};
  const std::string queries = folder_.write("q.json", "{\"queries\": []}");
  expectRefused({"bake", "earth", "-o", folder_ / "t.exr"}, {"Vulkan"}, none);
  expectRefused({"render", "clear_noon", "-o", folder_ / "a.png"}, {"Vulkan"}, none);
  expectRefused({"probe", "earth", "--queries", queries, "-o", folder_ / "a.json"}, {"Vulkan"},
                none);
  // The reference needs no device, and neither do presets.
  const Outcome reference =
      runProgram({"probe", "earth", "--queries", queries, "-o", folder_ / "a.json", "--method",
                  "reference", "--orders", "1"},
                 none);
  EXPECT_EQ(reference.status, 0) << reference.err;
  EXPECT_EQ(runProgram({"presets"}, none).status, 0);
}

TEST_F(Program, AnUnknownDeviceIsNamed) {
  for (const char* device : {"99", "no such device"}) {
    expectRefused({"bake", "earth", "-o", folder_ / "t.exr", "--device", device}, {device});
  }
}

}  // namespace
}  // namespace alpenglow::test
