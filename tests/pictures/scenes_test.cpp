// A picture of every sample scene, by the built program (runProgram has it validated): first what
// the picture must show, then a comparison with the kept picture of an earlier version.
// ALPENGLOW_UPDATE_GOLDEN=1 in the environment replaces the kept pictures: look at them then.
#include <alpenglow/io/image_file.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace alpenglow::test {
namespace {

using io::LinearImage;

void runGood(const std::vector<std::string>& arguments) {
  const Outcome outcome = runProgram(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

using Arguments = std::vector<std::string>;

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Of the standard solver, which stays as it was published: a quarter of the paper's sizes, so that
/// a bake takes some ten CPU seconds.
const Arguments kStandard = {"--orders", "3", "--size-scattering", "16x64x32x8"};
/// Of the default one.
const Arguments kDraft = {"--quality", "draft"};

/// Tables that all scenes of an atmosphere share.
class Tables {
 public:
  const std::string& of(const std::string& atmosphere, bool standard) {
    std::string& path = paths_[{atmosphere, standard}];
    if (path.empty()) {
      path = folder_ / (atmosphere + (standard ? "-standard.exr" : ".exr"));
      runGood(Arguments{"bake", atmosphere, "-o", path} +
              (standard ? Arguments{"--solver", "standard"} + kStandard : kDraft));
    }
    return path;
  }

 private:
  TemporaryFolder folder_;
  std::map<std::pair<std::string, bool>, std::string> paths_;
};

Tables& sharedTables() {
  static Tables tables;
  return tables;
}

struct Colour {
  double r = 0, g = 0, b = 0;
};

/// Mean over a part of the picture; edges as shares of its size, y downwards.
Colour mean(const LinearImage& image, double x0, double y0, double x1, double y1) {
  Colour sum;
  double count = 0;
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x) {
      const double u = (x + 0.5) / image.width, v = (y + 0.5) / image.height;
      if (u < x0 || u > x1 || v < y0 || v > y1) continue;
      const float* p = &image.pixels[3 * (size_t(y) * image.width + x)];
      sum.r += p[0];
      sum.g += p[1];
      sum.b += p[2];
      count += 1;
    }
  return {sum.r / count, sum.g / count, sum.b / count};
}

double brightness(const Colour& c) { return (c.r + c.g + c.b) / 3.0; }

double wholeBrightness(const LinearImage& image) { return brightness(mean(image, 0, 0, 1, 1)); }

class SceneTest : public testing::Test {
 protected:
  LinearImage render(const std::string& name, bool standard) {
    const std::filesystem::path file =
        std::filesystem::path(ALPENGLOW_SAMPLES) / "scenes" / (name + ".json");
    std::ifstream stream(file);
    const nlohmann::json scene = nlohmann::json::parse(stream, nullptr, false);
    const bool fisheye = scene["camera"].value("projection", "perspective") == "fisheye";
    const std::string out = folder_ / (name + ".exr");
    runGood(Arguments{"render", name, "--tables", sharedTables().of(scene["atmosphere"], standard),
                      "--size", fisheye ? "72x72" : "96x72", "-o", out} +
            (standard ? kStandard : kDraft) +
            // Light shafts are the default solver's.
            (standard && scene.contains("terrain") ? Arguments{"--shafts", "off"} : Arguments{}));
    const io::Result<LinearImage> image = io::readExr(out);
    EXPECT_TRUE(image.value.has_value()) << image.error;
    return image.value.value_or(LinearImage{});
  }

  void expectAsKept(const LinearImage& image, const std::string& name) {
    const std::string kept = std::string(ALPENGLOW_GOLDEN) + "/" + name + ".exr";
    if (std::getenv("ALPENGLOW_UPDATE_GOLDEN") != nullptr) {
      EXPECT_EQ(io::writeExr(kept, image).error, "");
      return;
    }
    const io::Result<LinearImage> golden = io::readExr(kept);
    ASSERT_TRUE(golden.value.has_value()) << golden.error;
    ASSERT_EQ(golden.value->pixels.size(), image.pixels.size());
    // The driver's bits differ between processors by parts in a thousand; a pixel on the horizon or
    // the disc's edge may fall to the other side.
    const double floor = 1e-3 * wholeBrightness(*golden.value);
    size_t off = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      const double expected = golden.value->pixels[i];
      off += std::abs(image.pixels[i] - expected) > 2e-3 * std::max(expected, floor) ? 1 : 0;
    }
    EXPECT_LE(off, image.pixels.size() / 200) << "values differ from " << kept;
  }

  TemporaryFolder folder_;
};

class Scene : public SceneTest, public testing::WithParamInterface<std::string> {};
using Fisheyes = SceneTest;

/// What must be seen, where a scene is about something that can be checked by colours.
using Check = std::function<void(const LinearImage&)>;
const std::map<std::string, Check>& checks() {
  static const std::map<std::string, Check> kChecks = {
      {"clear_noon",
       [](const LinearImage& i) {
         const Colour above = mean(i, 0, 0, 1, 0.1), horizon = mean(i, 0, 0.65, 1, 0.75);
         EXPECT_GT(above.b, 2.0 * above.r) << "the zenith is blue";
         EXPECT_GT(brightness(horizon), 1.5 * brightness(above)) << "the horizon is bright";
         EXPECT_LT(horizon.b / horizon.r, 0.7 * above.b / above.r) << "and whiter";
       }},
      {"sunset",
       [](const LinearImage& i) {
         const Colour low = mean(i, 0.4, 0.6, 0.7, 0.68);
         EXPECT_GT(low.r, 2.0 * low.g) << "the sky at the sun is red";
         EXPECT_GT(low.g, 2.0 * low.b);
         EXPECT_GT(brightness(low), 5.0 * brightness(mean(i, 0, 0, 1, 0.1)));
       }},
      {"earth_shadow",
       [](const LinearImage& i) {
         const Colour belt = mean(i, 0, 0.4, 1, 0.5), shadow = mean(i, 0, 0.66, 1, 0.74);
         EXPECT_GT(belt.r / belt.b, 1.3 * shadow.r / shadow.b) << "a pink belt over a blue shadow";
         EXPECT_GT(brightness(belt), brightness(shadow));
       }},
      {"sunset_from_space",
       [](const LinearImage& i) {
         double reddest = 0, bluest = 0;
         for (uint32_t y = 0; y < i.height; ++y) {
           const float* p = &i.pixels[3 * (size_t(y) * i.width + i.width / 4)];
           if (p[0] + p[1] + p[2] < 0.01) continue;
           reddest = std::max(reddest, double(p[0]) / (p[2] + 1e-9));
           bluest = std::max(bluest, double(p[2]) / (p[0] + 1e-9));
         }
         EXPECT_GT(reddest, 3.0) << "red next to the ground";
         EXPECT_GT(bluest, 1.5) << "blue above it";
       }},
      {"planet_10000km",
       [](const LinearImage& i) {
         for (double x : {0.0, 0.9})
           EXPECT_EQ(brightness(mean(i, x, 0, x + 0.1, 1)), 0.0) << "space is black";
         EXPECT_GT(brightness(mean(i, 0.45, 0.4, 0.6, 0.6)), 0.01);
       }},
      {"fisheye_00",
       [](const LinearImage& i) {
         EXPECT_EQ(brightness(mean(i, 0, 0, 0.1, 0.1)), 0.0) << "black outside the circle";
         const double left = brightness(mean(i, 0.2, 0.45, 0.3, 0.55));
         for (const Colour& c : {mean(i, 0.7, 0.45, 0.8, 0.55), mean(i, 0.45, 0.2, 0.55, 0.3),
                                 mean(i, 0.45, 0.7, 0.55, 0.8)})
           EXPECT_NEAR(brightness(c), left, 2e-3 * left)
               << "the same all round a sun at the zenith";
       }},
  };
  return kChecks;
}

void expectToShow(const LinearImage& image, const std::string& name) {
  ASSERT_FALSE(image.pixels.empty());
  for (float v : image.pixels) ASSERT_TRUE(std::isfinite(v) && v >= 0.0f) << v;
  EXPECT_GT(wholeBrightness(image), 0.0);
  const auto check = checks().find(name);
  if (check != checks().end()) check->second(image);
}

TEST_F(SceneTest, TheDefaultSolverShowsWhatItShould) {
  for (const auto& entry : checks()) {
    SCOPED_TRACE(entry.first);
    expectToShow(render(entry.first, false), entry.first);
  }
}

TEST_P(Scene, OfTheStandardSolverStaysAsItWas) {
  const LinearImage image = render(GetParam(), true);
  expectToShow(image, GetParam());
  expectAsKept(image, GetParam());
}

TEST_F(Fisheyes, DarkenAsTheSunSinks) {
  double before = 1e9;
  for (const char* name : {"fisheye_30", "fisheye_50", "fisheye_70", "fisheye_80", "fisheye_90"}) {
    // Without the disc: a part far from the sun, which is in the south: a camera that heads north
    // and looks up has it above.
    const double now = brightness(mean(render(name, false), 0.4, 0.6, 0.6, 0.9));
    EXPECT_LT(now, before) << name;
    before = now;
  }
}

std::vector<std::string> sampleScenes() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(ALPENGLOW_SAMPLES) + "/scenes"))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Samples, Scene, testing::ValuesIn(sampleScenes()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace alpenglow::test
