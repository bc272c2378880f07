// Bakes small tables once for a program and draws pictures with them, as floats.
#pragma once

#include <alpenglow/alpenglow.h>
#include <alpenglow/query.h>
#include <alpenglow/view.h>

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "tests/engine/device_fixture.h"
#include "tests/bake/tables_state.h"
#include "tests/sky/vulkan_wrap.h"

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

/// What a picture is drawn into.
struct TargetDesc {
  VkExtent2D extent = {48, 32};
  VkFormat color = VK_FORMAT_R32G32B32A32_SFLOAT;  ///< Or R16G16B16A16_SFLOAT.
  VkFormat depth = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  ///< Resolved by averaging.
  bool renderPass = false;                                ///< Else dynamic rendering.
  float clearDepth = 1.0f;
};

/// Every pixel holds this before something is drawn.
inline constexpr float kClear = -7.0f;

/// Images to draw into, and the way back to the CPU. Destroyed before its device.
class Target {
 public:
  Target(headless::Device& device, const TargetDesc& desc);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  VkRenderPass renderPass() const { return renderPass_; }
  /// Clears, lets `inside` record into the rendering scope, submits, waits and reads back.
  Picture draw(const std::function<bool(VkCommandBuffer)>& inside);
  /// Inside the scope: fills a rectangle of colour and depth, as a host's nearer object would.
  void fill(VkCommandBuffer commands, const VkRect2D& area, float color, float depth);

 private:
  struct RawImage {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
  };
  RawImage makeImage(VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage,
                     VkImageAspectFlags aspect);
  void makeRenderPass();
  void begin(VkCommandBuffer commands);
  void end(VkCommandBuffer commands);
  void barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
               const ImageState& before, const ImageState& after);
  bool multisampled() const { return desc_.samples != VK_SAMPLE_COUNT_1_BIT; }
  template <class Function>
  Function function(const char* name) {
    return reinterpret_cast<Function>(device_.function(name));
  }

  headless::Device& device_;
  TargetDesc desc_;
  RawImage color_, resolved_, depth_;
  VkRenderPass renderPass_ = VK_NULL_HANDLE;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
  headless::HostBuffer readback_;
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
SkyDraw makeDraw(const Camera& camera, const Vec& sun, VkExtent2D extent);

/// The direction that the centre of a pixel looks in, by docs/file-formats.md, in double; x and y
/// count from the viewport's corner. Nothing outside a fisheye's circle.
std::optional<Vec> pixelDirection(const SkyDraw& draw, Projection projection, double x, double y);

/// The probe query of a camera's ray.
ProbeQuery rayQuery(const Parameters& parameters, const Camera& camera, const Vec& direction,
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
  View* makeView(const ViewDesc& desc);
  /// Like view(), with a sky slice of the shape of tables(), but of the default level.
  View* slicedView(Projection projection);
  void recordSlice(View* sliced, const Tables* with, const SkyDraw& draw);
  /// With view(projection), into a 32-bit float target of the viewport's size.
  Picture picture(const SkyDraw& draw, Projection projection = Projection::Perspective,
                  Tables* with = nullptr);
  /// The same with another view; from the slice that was recorded last, if it serves.
  Picture picture(View* with, Tables* tables, const SkyDraw& draw);
  Picture picture(View* with, Tables* tables, const SkyDraw& draw, const TargetDesc& target);
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
