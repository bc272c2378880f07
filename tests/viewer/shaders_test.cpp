// `--shaders DIR`: files that are edited while the viewer draws.
#include <alpenglow/io/image_file.h>

#include <cstdlib>
#include <filesystem>

#include "viewer.h"

namespace alpenglow::test {
namespace {

class ViewerShaders : public Viewer {
 protected:
  ViewerShaders() {
    std::filesystem::copy(ALPENGLOW_SHADERS, at("glsl"), std::filesystem::copy_options::recursive);
  }
  // Edits `file` of the folder, by sed, as soon as the viewer has saved `picture`.
  void editAfter(const std::string& picture, const std::string& edit, const std::string& file) {
    const std::string script = "( until [ -e '" + at(picture) +
                               "' ]; do sleep 0.1; done; sed -i '" + edit + "' '" +
                               at("glsl/" + file) + "' ) > /dev/null 2>&1 &";
    ASSERT_EQ(std::system(script.c_str()), 0);
  }
  // Of all values of a picture.
  double mean(const std::string& name) {
    const io::Result<io::LinearImage> image = io::readExr(at(name));
    EXPECT_TRUE(image) << image.error;
    double sum = 0.0;
    if (image) {
      for (const float value : image->pixels) sum += static_cast<double>(value);
    }
    return sum;
  }
};

TEST_F(ViewerShaders, EditsApplyAndCompileErrorsAreReported) {
  const std::string last = "s/^  radiance = vec4(light, 1.0);/  radiance = vec4(";
  editAfter("before.exr", last + "2.0 * light, 1.0);/", "passes/sky.frag");
  editAfter("twice.exr", "s/vec4(2.0 \\* light/vec4(3.0 * lihgt/", "passes/sky.frag");
  editAfter("kept.exr", "s/3.0 \\* lihgt/4.0 * light/", "passes/sky.frag");
  play(
      "settle\nsave @before.exr\nseconds 6\nsettle\nreport @twice.json\nsave @twice.exr\n"
      "seconds 6\nsettle\nreport @kept.json\nsave @kept.exr\n"
      "seconds 6\nsettle\nreport @mended.json\nsave @mended.exr\n",
      {"--shaders", at("glsl")});
  EXPECT_EQ(report("twice.json")["compiler"], "");
  const std::string said = report("kept.json")["compiler"];
  EXPECT_NE(said.find("sky.frag"), std::string::npos) << said;
  EXPECT_NE(said.find("lihgt"), std::string::npos) << said;
  EXPECT_EQ(report("mended.json")["compiler"], "");
  const double before = mean("before.exr");
  EXPECT_GT(before, 0.0);
  EXPECT_NEAR(mean("twice.exr"), 2.0 * before, 1e-3 * before);
  EXPECT_NEAR(mean("kept.exr"), 2.0 * before, 1e-3 * before);
  EXPECT_NEAR(mean("mended.exr"), 4.0 * before, 1e-3 * before);
}

TEST_F(ViewerShaders, EditingABakeShaderRebakes) {
  // The light of one scattering, by molecules, that is scattered again. No disc in the picture.
  editAfter("before.exr",
            "s/^  imageStore(radiance, texel.xy, vec4(rayleigh, 0.0));/"
            "  imageStore(radiance, texel.xy, vec4(0.0));/",
            "tables/moment_single.comp");
  play(
      "set sun.azimuth_deg 280\nsettle\nsave @before.exr\nseconds 6\nsettle\nreport "
      "@report.json\nsave @after.exr\n",
      {"--shaders", at("glsl")});
  EXPECT_EQ(report()["compiler"], "");
  EXPECT_LT(mean("after.exr"), 0.9 * mean("before.exr"));
}

TEST_F(ViewerShaders, MismatchedCodeIsReportedAndNotUsed) {
  editAfter("before.exr",
            "s/^layout(location = 0) out vec4 radiance;/&\\nlayout(set = 0, binding = 30) uniform "
            "sampler2D mine;/; s/^  radiance = vec4(light, 1.0);/  radiance = vec4(light + "
            "texture(mine, ndc).rgb, 1.0);/",
            "passes/sky.frag");
  play("settle\nsave @before.exr\nseconds 6\nsettle\nreport @report.json\nsave @after.exr\n",
       {"--shaders", at("glsl")});
  const std::string said = report()["message"];
  EXPECT_NE(said.find("set 0, binding 30"), std::string::npos) << said;
  EXPECT_EQ(mean("after.exr"), mean("before.exr"));
}

TEST_F(ViewerShaders, AFolderWithoutThemIsRefused) {
  expectRefused({scene_, "--shaders", folder_.path()}, {"--shaders", folder_.path()});
  expectRefused({scene_, "--shaders", at("nowhere")}, {"--shaders", "nowhere"});
}

}  // namespace
}  // namespace alpenglow::test
