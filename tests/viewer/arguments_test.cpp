// What the viewer is given: options, config files, scripts.
#include "viewer.h"

namespace alpenglow::test {
namespace {

using ViewerArguments = Viewer;

TEST_F(ViewerArguments, HelpNamesEveryOption) {
  const Outcome outcome = run({"--help"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* word : {"SCENE", "--flythrough", "--size", "--config", "--device", "--script",
                           "--shaders", "--validation", "Escape"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  }
}

TEST_F(ViewerArguments, WrongOnesGetASentence) {
  expectRefused({"--sise", "3x3"}, {"--sise", "--help"});
  expectRefused({"--size", "640"}, {"640", "WxH"});
  expectRefused({"--size", "640x360x2"}, {"640x360x2", "WxH"});
  expectRefused({"no_such_scene"}, {"no_such_scene", "clear_noon, "});
  expectRefused({folder_.write("fisheye.json", R"({"atmosphere": "earth",
      "sun": {"elevation_deg": 20}, "camera": {"altitude_m": 2, "projection": "fisheye"},
      "balloons": [{"altitude_m": 900, "radius_m": 10, "latitude_deg": 0, "longitude_deg": 0}]})")},
                {"balloons", "fisheye"});
  expectRefused({scene_, "--flythrough", "dawn_to_night"},
                {"scene.json", "dawn_to_night", "one of them"});
  expectRefused({"--flythrough", "no_such_flythrough"}, {"no_such_flythrough"});
  expectRefused({scene_, "--device", "no_such_device"}, {"no_such_device", "llvmpipe"});
  expectRefused({scene_, "--shaders", folder_.path()}, {folder_.path(), "shaders/glsl"});
  expectRefused({folder_.write("bad.json", "{\"sun\": 3}")}, {"bad.json"});
}

TEST_F(ViewerArguments, WithoutADisplayThereIsASentence) {
  const Outcome outcome = runProgram({scene_}, {"DISPLAY=:99999"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("needs a display"), std::string::npos) << outcome.err;
}

TEST_F(ViewerArguments, WrongConfigFilesGetASentence) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& words) {
    expectRefused({scene_, "--config", folder_.write("wrong.json", text)}, words);
  };
  expectRefused({"--config", at("none.json")}, {"none.json"});
  refused("{", {"wrong.json", "JSON"});
  refused("[]", {"contents", "[]", "object"});
  refused(R"({"windows": {}})", {"'windows'", "frames_per_second, keys, window"});
  refused(R"({"window": {"size": [640]}})", {"window.size", "[640]"});
  refused(R"({"window": {"size": [640, 1e9]}})", {"window.size", "16384"});
  refused(R"({"window": {"vsync": 1}})", {"window.vsync", "1", "true or false"});
  refused(R"({"window": {"interface_scale": 9}})", {"interface_scale", "9", "0.25"});
  refused(R"({"keys": {"forward": "WW"}})", {"keys.forward", "WW", "LeftShift"});
  refused(R"({"keys": {"jump": "W"}})", {"'keys.jump'", "forward"});
  refused(R"({"keys": {"forward": "Up", "back": "Up"}})", {"\"Up\"", "keys.back", "keys.forward"});
  refused(R"({"bake_ms": "x"})", {"bake_ms", "\"x\""});
  refused(std::string(100000, '['), {"wrong.json", "deeper than 8 levels"});
}

TEST_F(ViewerArguments, SampleConfigHoldsTheDefaults) {
  play("press W\nreport @report.json", {"--config", ALPENGLOW_SAMPLES "/view/view.json"});
  EXPECT_TRUE(report()["panel"].get<bool>());
}

TEST_F(ViewerArguments, AKeyOfTheConfigFileDoesWhatItSays) {
  const std::string config =
      folder_.write("own.json", R"({ "keys": { "help": "H" } }  // H as in help)");
  play("press H\nreport @report.json", {"--config", config});
  EXPECT_TRUE(report()["help"].get<bool>());
}

TEST_F(ViewerArguments, WrongScriptsGetASentenceWithTheLine) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& words) {
    expectRefused({scene_, "--script", folder_.write("wrong.txt", text)}, words);
  };
  refused("frames 2\njump", {"Line 2", "jump", "settle"});
  refused("frames", {"Line 1", "0 words"});
  refused("frames many", {"many", "number"});
  refused("press Any", {"Any", "Period"});
  refused("set mie.colour 3", {"mie.colour"});
  refused("set mie.asymmetry 7", {"mie.asymmetry", "7"});
  refused("set sun.elevation_deg 91", {"sun.elevation_deg", "91", "90"});
  refused("choose solver magic", {"magic", "moments, standard"});
  refused("save picture.jpg", {"picture.jpg", ".png", ".exr"});
  refused("seek 3", {"flythrough"});
  refused("show air", {"air", "Atmosphere"});
  refused("frames 1e12", {"1e+12", "1e+09"});
  refused("set mie.scattering_per_m 1", {"mie.scattering_per_m.0"});
  refused("save /no/such/folder/picture.png", {"/no/such/folder"});
}

}  // namespace
}  // namespace alpenglow::test
