// What the window shows: the pictures of `alpenglow render`, at every size, through bakes.
#include <alpenglow/io/image_file.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "viewer.h"

namespace alpenglow::test {
namespace {

using nlohmann::json;

class ViewerPicture : public Viewer {
 protected:
  io::LinearImage rendered(const std::string& scene, const std::string& size) {
    const std::string command = std::string(ALPENGLOW_RENDERER) + " render '" + scene +
                                "' --size " + size + " -o '" + at("rendered.exr") + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return read("rendered.exr");
  }
  io::LinearImage read(const std::string& name) {
    const io::Result<io::LinearImage> image = io::readExr(at(name));
    EXPECT_TRUE(image) << image.error;
    return image ? *image : io::LinearImage{};
  }
  // The share of values that differ by more than this part of the greater.
  static double differing(const io::LinearImage& a, const io::LinearImage& b, double part) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    if (a.pixels.size() != b.pixels.size() || a.pixels.empty()) return 1.0;
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
      const double x = static_cast<double>(a.pixels[i]), y = static_cast<double>(b.pixels[i]);
      EXPECT_TRUE(std::isfinite(x));
      if (std::abs(x - y) > part * std::max(std::abs(x), std::abs(y)) + 1e-7) ++count;
    }
    return static_cast<double>(count) / static_cast<double>(a.pixels.size());
  }
};

TEST_F(ViewerPicture, AScreenshotIsTheRenderOfItsScene) {
  play("settle\nsave @seen.exr\nsave @seen.png\n");
  // The renderer's plan bakes for this sun alone.
  EXPECT_EQ(differing(read("seen.exr"), rendered(scene_, "160x96"), 0.01), 0.0);
  const io::LinearImage other =
      rendered(folder_.write("other.json", R"({ "atmosphere": "earth", "quality": "draft",
        "sun": { "elevation_deg": 25 }, "camera": { "altitude_m": 500, "pitch_deg": 5 } })"),
               "160x96");
  EXPECT_GT(differing(read("seen.exr"), other, 0.01), 0.5);
}

TEST_F(ViewerPicture, TerrainWithLightShaftsIsTheRenderToo) {
  const std::string scene = ALPENGLOW_SAMPLES "/scenes/mountain_shadows.json";
  json text = json::parse(contentsOf(scene));
  text["quality"] = "draft";
  text["terrain"]["height_map"] = ALPENGLOW_SAMPLES "/data/jacksboro.png";
  scene_ = folder_.write("terrain.json", text.dump());
  play("settle\nsave @seen.exr\nreport @report.json\n", {"--validation"});
  EXPECT_EQ(report()["refusal"], "");
  // A pixel at a silhouette may fall on either side of it.
  EXPECT_LT(differing(read("seen.exr"), rendered(scene_, "160x96"), 0.02), 0.01);
}

TEST_F(ViewerPicture, StarsAtNightAreThoseOfTheRender) {
  json text = json::parse(contentsOf(scene_));
  text["sun"]["elevation_deg"] = -40;
  text["camera"]["pitch_deg"] = 40;
  const std::string dark = folder_.write("dark.json", text.dump());
  text["stars"] = {{"sidereal_hours", 6.0}};
  scene_ = folder_.write("stars.json", text.dump());
  play("settle\nsave @seen.exr\nchoose stars off\nsettle\nsave @dark.exr\n");
  EXPECT_LT(differing(read("seen.exr"), rendered(scene_, "160x96"), 0.01), 1e-3);
  EXPECT_LT(differing(read("dark.exr"), rendered(dark, "160x96"), 0.01), 1e-3);
  const io::LinearImage stars = read("seen.exr"), sky = read("dark.exr");
  EXPECT_GT(*std::max_element(stars.pixels.begin(), stars.pixels.end()),
            10.0f * *std::max_element(sky.pixels.begin(), sky.pixels.end()));
}

TEST_F(ViewerPicture, ResolutionDropsOnlyWhileMoving) {
  const std::string config =
      folder_.write("hasty.json", R"({ "frames_per_second": 1000, "window": { "vsync": false } })");
  play("settle\nfly 0.2 0 0.1 40\nreport @moving.json\nsettle\nreport @resting.json\n",
       {"--config", config, "--size", "640x360"});
  EXPECT_LT(report("moving.json")["drawn"][0], 500);
  EXPECT_EQ(report("resting.json")["drawn"], json::parse("[640, 360]"));
}

TEST_F(ViewerPicture, FollowsTheWindowsSize) {
  play(
      "settle\nresize 300 200\nsettle\nreport @a.json\nsave @a.exr\nresize 90 400\nframes 2\n"
      "resize 250 120\nsettle\nreport @b.json\nsave @b.exr\n");
  EXPECT_EQ(report("a.json")["window"], json::parse("[300, 200]"));
  EXPECT_EQ(report("a.json")["drawn"], json::parse("[300, 200]"));
  EXPECT_EQ(report("b.json")["drawn"], json::parse("[250, 120]"));
  EXPECT_EQ(read("a.exr").width, 300u);
  EXPECT_EQ(differing(read("b.exr"), rendered(scene_, "250x120"), 0.01), 0.0);
}

TEST_F(ViewerPicture, QuittingDuringABakeIsClean) {
  play("frames 3\nchoose quality high\nframes 3\n");
  play(
      "settle\nchoose solver standard\nframes 4\nchoose solver moments\nframes 4\nresize 200 90\n");
}

TEST_F(ViewerPicture, ChangesOfTheMediumCreateNoPipeline) {
  play(
      "settle\nreport @a.json\nset mie.asymmetry 0.6\nframes 3\nset rayleigh.scale_height_m 9000\n"
      "settle\nset mie.extinction_per_m.0 1e-4\nsettle\nreport @b.json\n");
  EXPECT_EQ(report("a.json")["pipelines"], report("b.json")["pipelines"]);
  EXPECT_NE(report("a.json")["exposure"], report("b.json")["exposure"]);
}

TEST_F(ViewerPicture, TwoThousandFramesOfChangesTakeNoMoreMemory) {
  play(
      "settle\nrandom 700 1\npress R\nsettle\nreport @warm.json\n"
      "random 1300 2\npress R\nsettle\nreport @end.json\n");
  const json warm = report("warm.json")["memory"], end = report("end.json")["memory"];
  EXPECT_EQ(warm["device_bytes"], end["device_bytes"]);
  EXPECT_EQ(warm["images"], end["images"]);
  EXPECT_EQ(warm["buffers"], end["buffers"]);
  // The driver's heap breathes.
  EXPECT_LT(end["resident_bytes"].get<double>(), 1.1 * warm["resident_bytes"].get<double>());
  EXPECT_GE(report("end.json")["times"]["frames"].get<int>(), 1300);
}

}  // namespace
}  // namespace alpenglow::test
