// Bakes small tables once for a program and draws pictures with them, as floats.
#pragma once

#include <alpenglow/alpenglow.h>
#include <alpenglow/headless_target.h>
#include <alpenglow/query.h>
#include <alpenglow/view.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "tests/engine/device_fixture.h"
#include "tests/passes/sky/vulkan_wrap.h"
#include "tests/support/frames.h"
#include "tests/tables/tables_state.h"

namespace alpenglow::testing {

inline constexpr double kPi = 3.14159265358979323846;
constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }

using Vec = std::array<double, 3>;
double dot(const Vec& a, const Vec& b);
Vec cross(const Vec& a, const Vec& b);
double length(const Vec& a);
Vec unit(const Vec& a);
Vec vec(const double v[3]);

/// Linear RGBA, row 0 at the top.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<float> data;
  const float* at(uint32_t x, uint32_t y) const { return &data[4 * (size_t{y} * width + x)]; }
};

/// What a picture is drawn into: small, unless a test says more.
struct TargetDesc : headless::TargetDesc {
  TargetDesc() { extent = {48, 32}; }
  float clearDepth = 1.0f;
};

/// Every pixel holds this before something is drawn.
inline constexpr float kClear = -7.0f;

/// headless::Target, whose failures fail the test. Destroyed before its device.
class Target {
 public:
  Target(headless::Device& device, const TargetDesc& desc);

  VkRenderPass renderPass() const { return target_->renderPass(); }
  /// Clears, lets `inside` record into the rendering scope, submits, waits and reads back.
  Picture draw(const std::function<bool(VkCommandBuffer)>& inside);
  /// Inside the scope: fills a rectangle of colour and depth, as a host's nearer object would.
  void fill(VkCommandBuffer commands, const VkRect2D& area, float color, float depth);

 private:
  headless::Device& device_;
  TargetDesc desc_;
  std::unique_ptr<headless::Target> target_;
};

/// Of the standard solver: sizes and orders whose bake takes about a CPU second.
TableDesc smallTables(MieStorage mie = MieStorage::Full);
Parameters preset(const char* name);
/// Bakes all of it, one pass a submit.
void bakeAll(headless::Device& device, Tables* tables);
/// The answers of recordProbe. Empty after a failure.
std::vector<ProbeAnswer> probe(headless::Device& device, const Tables* tables,
                               const std::vector<ProbeQuery>& queries);

/// A draw of the whole extent: irradiance 1, no disc.
FrameState makeDraw(const EyeCamera& camera, const Vec& sun, VkExtent2D extent);

/// The direction that the centre of a pixel looks in, by docs/file-formats.md, in double; x and y
/// count from the viewport's corner. Nothing outside a fisheye's circle.
std::optional<Vec> pixelDirection(const FrameState& draw, Projection projection, double x,
                                  double y);

/// The probe query of a camera's ray.
ProbeQuery rayQuery(const Parameters& parameters, const EyeCamera& camera, const Vec& direction,
                    const Vec& sun);

/// Angle of the planet's horizon below the horizontal, radians.
double horizonDip(const Parameters& parameters, double altitude);

/// One context for all tests of a suite, with what was baked and made on it. With the default
/// solver: its drafts, which take less than a CPU second each.
class SkyTest : public DeviceTest {
 protected:
  explicit SkyTest(Solver solver = Solver::Moments) : solver_(solver) {}
  Solver solver() const { return solver_; }
  void SetUp() override;
  static void TearDownTestSuite();

  Context* context();
  VulkanWrap& vulkan();  ///< What `context` calls.
  /// Of the suite's solver, baked at the first use.
  Tables* tables(const char* presetName = "earth", MieStorage mie = MieStorage::Full);
  /// Of other parameters, under a name of their own.
  Tables* tables(const char* name, const Parameters& parameters, MieStorage mie = MieStorage::Full);
  /// Made at the first use, of 32-bit floats unless `desc` says otherwise; destroyed at the end.
  View* view(Projection projection = Projection::Perspective);
  /// Of 32-bit floats, for the suite's solver.
  ViewDesc viewDesc() const;
  /// For tables(), unless others are given; of 32-bit floats unless `desc` says otherwise.
  View* makeView(const ViewDesc& desc, Tables* with = nullptr);
  /// Like view(), with a sky-view LUT of the shape that tables() have, but of the default level.
  View* lutView(Projection projection);
  void recordViewLuts(View* fromLut, const Tables* with, const FrameState& draw);
  /// recordSky is refused with a sentence, since the LUT holds something else.
  void expectNeedsSlice(View* fromLut, const Tables* with, const FrameState& draw);
  /// With view(projection), into a 32-bit float target of the viewport's size.
  Picture picture(const FrameState& draw, Projection projection = Projection::Perspective,
                  Tables* with = nullptr);
  /// The same with another view; one with a LUT needs recordViewLuts before.
  Picture picture(View* with, Tables* tables, const FrameState& draw);
  Picture picture(View* with, Tables* tables, const FrameState& draw, const TargetDesc& target);
  std::vector<ProbeAnswer> probeAll(const std::vector<ProbeQuery>& queries, Tables* with = nullptr);
  /// What `context` said last; emptied by SetUp.
  static std::string& message();

 private:
  Solver solver_;
};

/// The same with smallTables().
class StandardSkyTest : public SkyTest {
 protected:
  StandardSkyTest() : SkyTest(Solver::Standard) {}
};

/// With each of the two: derive one for a file, and instantiate it with kBothSolvers.
class EitherSkyTest : public SkyTest, public ::testing::WithParamInterface<Solver> {
 protected:
  EitherSkyTest() : SkyTest(GetParam()) {}
};
inline const auto kBothSolvers = ::testing::Values(Solver::Moments, Solver::Standard);
inline std::string solverName(const ::testing::TestParamInfo<Solver>& info) {
  return info.param == Solver::Moments ? "Moments" : "Standard";
}

/// Whether a text is one sentence with all of these parts, which are separated by '|'.
bool hasAll(const std::string& text, const std::string& parts);

/// Every value of `picture` that is not finite, or negative: a sentence with the first, or "".
std::string badValue(const Picture& picture);

}  // namespace alpenglow::testing
