// render --flythrough: frames, and that they are the pictures of their scenes.
#include <alpenglow/io/flythrough_file.h>
#include <alpenglow/io/image_file.h>

#include <filesystem>

#include "../io/schema.h"
#include "program.h"

namespace alpenglow::test {
namespace {

namespace fs = std::filesystem;

const char* const kStart =
    R"("atmosphere": "earth", "sun": {"elevation_deg": 20, "azimuth_deg": 80},
    "camera": {"latitude_deg": 40, "altitude_m": 900, "heading_deg": 90, "pitch_deg": 10},
    "size": [40, 24], "exposure": 5, "stars": true)";

class Flythroughs : public Program {
 protected:
  std::string flythrough(const std::string& keys, const std::string& scene = kStart) {
    return folder_.write("w.json", R"({"frames_per_second": 2, "scene": {)" + scene +
                                       R"(}, "keys": [)" + keys + "]}");
  }
  std::vector<std::string> renderOf(const std::string& flythroughFile,
                                    const std::vector<std::string>& more = {}) {
    return joined(
        joined({"render", "--flythrough", flythroughFile, "-o", folder_ / "out"}, smallMoments()),
        more);
  }
  std::vector<std::string> frames() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "out")) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

const char* const kThreeKeys = R"({"time_s": 0}, {"time_s": 0.5, "exposure": 9,
    "sun": {"elevation_deg": -3, "azimuth_deg": 300}, "camera": {"latitude_deg": 42}},
    {"time_s": 1, "atmosphere": {"mie": {"asymmetry": 0.5}}, "camera": {"altitude_m": 90000},
     "stars": {"sidereal_hours": 5}})";

// The scenes that the keys come to, as scene files.
const char* const kThreeScenes[] = {
    R"("atmosphere": "earth", "sun": {"elevation_deg": 20, "azimuth_deg": 80}, "exposure": 5,
       "camera": {"latitude_deg": 40, "altitude_m": 900, "heading_deg": 90, "pitch_deg": 10},
       "stars": true)",
    R"("atmosphere": "earth", "sun": {"elevation_deg": -3, "azimuth_deg": 300}, "exposure": 9,
       "camera": {"latitude_deg": 42, "altitude_m": 900, "heading_deg": 90, "pitch_deg": 10},
       "stars": true)",
    R"("atmosphere": "changed.json", "sun": {"elevation_deg": -3, "azimuth_deg": 300},
       "camera": {"latitude_deg": 42, "altitude_m": 90000, "heading_deg": 90, "pitch_deg": 10},
       "exposure": 9, "stars": {"sidereal_hours": 5})"};

TEST_F(Flythroughs, FramesAreThePicturesOfTheirScenes) {
  nlohmann::json air = nlohmann::json::parse(runProgram({"presets", "earth"}).out);
  air["mie"]["asymmetry"] = 0.5;
  folder_.write("changed.json", air.dump());
  const std::string more[] = {"", R"(, "terrain": {"height_map": "h.exr", "meters_per_pixel": 900,
       "latitude_deg": 40.05, "longitude_deg": 0.1, "albedo": [0.2, 0.2, 0.2]}, "balloons":
       [{"latitude_deg": 40.01, "longitude_deg": 0.02, "altitude_m": 1500, "radius_m": 200,
         "opacity": 0.5}])"};
  io::LinearImage heights{17, 17, std::vector<float>(17 * 17 * 3, 0.0f)};
  for (size_t i = 0; i < heights.pixels.size(); i += 21) heights.pixels[i] = 900.0f;
  ASSERT_TRUE(io::writeExr(folder_ / "h.exr", heights));
  for (const std::string& scenery : more) {
    const std::string format = scenery.empty() ? "png" : "exr";
    const std::string single = folder_ / ("single." + format);
    expectGood(renderOf(flythrough(kThreeKeys, kStart + scenery), {"--format-image", format}));
    for (int i = 0; i < 3; ++i) {
      // Planned for all that a flythrough may come to, as its frames are.
      const std::string text = "{" + (kThreeScenes[i] + scenery) + R"(, "size": [40, 24], "needs":
          {"altitude_m": [0, 1e9], "sun_elevation_deg": [-90, 90], "exposure": 1e12}})";
      expectGood(joined({"render", folder_.write("s.json", text), "-o", single}, smallMoments()));
      const std::string frame = folder_ / ("out/frame_0000" + std::to_string(i) + "." + format);
      if (format == "png") {
        EXPECT_EQ(contentsOf(frame), contentsOf(single)) << frame << scenery;
      } else {
        EXPECT_EQ(io::readExr(frame)->pixels, io::readExr(single)->pixels) << frame << scenery;
      }
    }
    EXPECT_EQ(frames().size(), 3u);
    fs::remove_all(folder_ / "out");
  }
}

TEST_F(Flythroughs, TablesAreRebakedOnlyWhenTheMediumChanges) {
  const std::string still =
      flythrough(R"({"time_s": 0}, {"time_s": 2, "sun": {"elevation_deg": 5}})");
  expectGood(renderOf(still, {"--report", folder_ / "still.json"}));
  EXPECT_EQ(frames().size(), 5u);
  const std::string changing = flythrough(R"({"time_s": 0}, {"time_s": 1},
      {"time_s": 2, "atmosphere": {"ground_albedo": [0.9, 0.9, 0.9]}})");
  expectGood(renderOf(changing, {"--report", folder_ / "changing.json"}));
  const auto countOf = [&](const char* count, const char* name, const char* pass) -> int64_t {
    const nlohmann::json report = jsonOf(name);
    EXPECT_EQ(schemaError(ALPENGLOW_SCHEMA_FOLDER, "report.schema.json", report), "");
    for (const nlohmann::json& entry : report["passes"]) {
      if (entry["name"] == pass) return entry[count];
    }
    return -1;
  };
  const auto dispatches = [&](const char* name, const char* pass) {
    return countOf("dispatches", name, pass);
  };
  EXPECT_EQ(dispatches("still.json", "T"), 1);
  EXPECT_EQ(dispatches("still.json", "sky"), 5);
  EXPECT_EQ(dispatches("changing.json", "T"), 3) << "frames 0 to 2, 3, and 4";
  EXPECT_EQ(dispatches("changing.json", "sky"), 3) << "frames 0 to 2 share a sky-view LUT";
  for (const char* report : {"still.json", "changing.json"}) {
    EXPECT_EQ(countOf("draws", report, "sky"), 5) << report;
  }
  // Of the same shape, they are drawn by the same pipelines.
  EXPECT_EQ(jsonOf("still.json")["totals"]["pipelines"],
            jsonOf("changing.json")["totals"]["pipelines"]);
}

TEST_F(Flythroughs, CutsMayChangeTheProjection) {
  expectGood(renderOf(flythrough(R"({"time_s": 0},
      {"time_s": 0.5, "move": "cut", "camera": {"projection": "fisheye", "fov_deg": 180, "pitch_deg": 90}},
      {"time_s": 1, "move": "cut", "camera": {"projection": "orthographic", "fov_deg": null,
       "height_m": 9000}},
      {"time_s": 1.5, "move": "cut", "camera": {"projection": null, "height_m": null}})"),
                      {"--format-image", "exr"}));
  EXPECT_EQ(frames().size(), 4u);
  EXPECT_EQ(io::readExr(folder_ / "out/frame_00001.exr")->pixels[0], 0.0f) << "a fisheye's corner";
}

TEST_F(Flythroughs, SomeFramesIntoAFolderThatIsThere) {
  fs::create_directory(folder_ / "out");
  folder_.write("out/note.txt", "kept");
  folder_.write("out/frame_00002.png", "old");
  const std::string file =
      flythrough(R"({"time_s": 0}, {"time_s": 3, "camera": {"pitch_deg": 30}})");
  expectGood(renderOf(file, {"--frames", "5,2-3,2", "--size", "16x12"}));
  const std::vector<std::string> expected = {"frame_00002.png", "frame_00003.png",
                                             "frame_00005.png", "note.txt"};
  EXPECT_EQ(frames(), expected);
  const std::string png = contentsOf(folder_ / "out/frame_00002.png");
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png[19], 16);
}

TEST_F(Flythroughs, SampleFlythroughsAreFoundByName) {
  expectGood(renderOf("hard_cases", {"--frames", "0", "--size", "16x9"}));
  EXPECT_EQ(frames().size(), 1u);
  expectRefused(renderOf("no_such_flythrough"), {"'no_such_flythrough'", "sample flythrough"});
}

TEST_F(Flythroughs, TablesOfTheFlythroughsMedium) {
  expectGood(joined({"bake", "earth", "-o", folder_ / "t.exr"}, smallMoments()));
  const auto withTables = [&](const std::string& keys) {
    return std::vector<std::string>{"render",        "--flythrough", flythrough(keys), "-o",
                                    folder_ / "out", "--tables",     folder_ / "t.exr"};
  };
  expectRefused(
      withTables(R"({"time_s": 0}, {"time_s": 1, "atmosphere": {"mie": {"asymmetry": 0.5}}})"),
      {"t.exr", "another atmosphere", "mie.asymmetry"});
  expectGood(withTables(R"({"time_s": 0}, {"time_s": 0.5, "camera": {"pitch_deg": 20}})"));
}

TEST_F(Flythroughs, Refusals) {
  const std::string good = flythrough(R"({"time_s": 0}, {"time_s": 1})");
  expectRefused(joined({"render", "--flythrough", good, "clear_noon", "-o", folder_ / "out"}, {}),
                {"clear_noon", "w.json", "one of them"});
  expectRefused({"render", "-o", folder_ / "a.png"}, {"SCENE", "--flythrough"});
  expectRefused({"render", "clear_noon", "-o", folder_ / "a.png", "--frames", "0"},
                {"--frames 0", "--flythrough"});
  expectRefused({"render", "clear_noon", "-o", folder_ / "a.png", "--format-image", "exr"},
                {"--format-image exr", "--flythrough"});
  expectRefused(renderOf(good, {"--format-image", "jpg"}), {"jpg", "'png' or 'exr'"});
  for (const char* list : {"", "x", "1-", "-1", "2-1", "0,,1", "1e3", "9999999999"}) {
    expectRefused(renderOf(good, {"--frames", list}), {"--frames"});
  }
  expectRefused(renderOf(good, {"--frames", "1,3"}), {"--frames 1,3", "frame 3", "last is 2"});
  expectRefused(renderOf(good, {"--report", folder_ / "no/such/r.json"}), {"r.json"});
  folder_.write("file", "x");
  expectRefused({"render", "--flythrough", good, "-o", folder_ / "file"}, {"file", "no folder"});
  expectRefused({"render", "--flythrough", good, "-o", folder_ / "no/such"}, {"no/such"});
  expectRefused({"render", "--flythrough", good, "-o", "/proc/flythrough"}, {"/proc/flythrough"});
  expectRefused(renderOf(flythrough(R"({"time_s": 0}, {"time_s": 1, "fog": 2})")),
                {"w.json", "key 1", "'fog'"});
  expectRefused(
      renderOf(flythrough(
          R"({"time_s": 0}, {"time_s": 1, "move": "cut", "camera":
      {"projection": "fisheye"}})",
          std::string(kStart) + R"(, "terrain": {"height_map": "h.exr", "meters_per_pixel": 9})")),
      {"terrain", "fisheye"});
}

// A frame whose place can't be written ends the flythrough; those before it stay.
TEST_F(Flythroughs, AFrameIsWrittenWholeOrNotAtAll) {
  fs::create_directories(folder_ / "out/frame_00001.png");
  const Outcome outcome = runProgram(renderOf(flythrough(R"({"time_s": 0}, {"time_s": 1})")));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("frame_00001.png"), std::string::npos) << outcome.err;
  const std::vector<std::string> expected = {"frame_00000.png", "frame_00001.png"};
  EXPECT_EQ(frames(), expected);
}

}  // namespace
}  // namespace alpenglow::test
