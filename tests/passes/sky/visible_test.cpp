// Which pipeline variant a camera gets: no pixel shows what the variant lacks.
#include <algorithm>
#include <cmath>
#include <random>

#include "atmosphere/passes/sky_pass.h"
#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

/// Does any pixel of an area see the atmosphere, the ground or the disc? By every `stride`th
/// pixel's direction, in double.
passes::Visible bruteForce(const Parameters& parameters, const PictureDesc& desc,
                           const FrameState& draw, const VkRect2D& area, uint32_t stride = 1) {
  passes::Visible seen = {false, false, false};
  const Vec position = vec(draw.camera.position_m), sun = vec(draw.sun.direction);
  const double r = length(position);
  const Vec down = {-position[0] / r, -position[1] / r, -position[2] / r};
  const double planet = std::asin(std::min(1.0, parameters.bottomRadius_m / r));
  const double air = r <= parameters.topRadius_m ? kPi : std::asin(parameters.topRadius_m / r);
  // Up to half a pixel of the disc's edge is drawn outside its radius, more if it is tiny.
  const passes::SkyConstants constants = passes::makeSkyConstants(parameters, desc, draw);
  const double reach =
      static_cast<double>(constants.sunDiscChord[3]) + 0.5 * passes::pixelAngle(desc, draw);
  for (uint32_t y = 0; y < area.extent.height; y += stride) {
    for (uint32_t x = 0; x < area.extent.width; x += stride) {
      const auto direction =
          pixelDirection(draw, desc.projection, static_cast<uint32_t>(area.offset.x) + x,
                         static_cast<uint32_t>(area.offset.y) + y);
      if (!direction) continue;
      const auto angle = [&](const Vec& to) {
        return std::atan2(length(cross(*direction, to)), dot(*direction, to));
      };
      seen.atmosphere = seen.atmosphere || angle(down) <= air;
      seen.ground = seen.ground || angle(down) < planet;
      const double chord = 2.0 * std::sin(0.5 * angle(sun));
      seen.disc = seen.disc || (draw.sun.discRadius > 0.0 && chord < reach);
    }
  }
  return seen;
}

bool covers(const passes::Visible& said, const passes::Visible& seen) {
  return (said.atmosphere || !seen.atmosphere) && (said.ground || !seen.ground) &&
         (said.disc || !seen.disc);
}

/// Cameras of all kinds, the same ones in each run.
class RandomDraws {
 public:
  explicit RandomDraws(const Parameters& parameters) : parameters_(parameters) {}

  double uniform() { return uniform_(random_); }

  FrameState draw(Projection projection, uint32_t most) {
    const double mostFov = projection == Projection::Perspective ? radians(175.0) : 2.0 * kPi;
    const double altitude = uniform() < 0.2 ? 0.0 : std::pow(10.0, 8.0 * uniform());
    const VkExtent2D extent = {1 + static_cast<uint32_t>((most - 1) * uniform()),
                               1 + static_cast<uint32_t>((most - 1) * uniform())};
    const double fov = std::min(mostFov * std::pow(uniform(), 2.0) + 1e-3, mostFov);
    const EyeCamera camera =
        cameraFromGeodetic(parameters_, kPi * (uniform() - 0.5), 6.0 * uniform(), altitude,
                           6.0 * uniform(), kPi * (uniform() - 0.5), 6.0 * uniform(), fov);
    FrameState draw = makeDraw(camera, direction(), extent);
    draw.sun.discRadius = uniform() < 0.1 ? 0.0 : std::pow(10.0, -5.0 * uniform());
    return draw;
  }

  /// A part of a viewport, often all of it.
  VkRect2D part(const VkExtent2D& whole) {
    if (uniform() < 0.3) return {{0, 0}, whole};
    const auto x = static_cast<uint32_t>(whole.width * uniform());
    const auto y = static_cast<uint32_t>(whole.height * uniform());
    return {{static_cast<int32_t>(x), static_cast<int32_t>(y)},
            {1 + static_cast<uint32_t>((whole.width - x - 1) * uniform()),
             1 + static_cast<uint32_t>((whole.height - y - 1) * uniform())}};
  }

 private:
  Vec direction() {
    const double z = 2.0 * uniform() - 1.0, phi = 2.0 * kPi * uniform();
    const double s = std::sqrt(1.0 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
  }

  Parameters parameters_;
  std::mt19937 random_{20081};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

Projection projectionOf(int i) {
  return i % 2 == 0 ? Projection::Perspective : Projection::Fisheye;
}

TEST(VisibleTest, IsConservativeAndUseful) {
  Parameters earth;
  ASSERT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  RandomDraws random(earth);
  int unseen[3] = {}, culled[3] = {};
  for (int i = 0; i < 6000; ++i) {
    PictureDesc desc;
    desc.projection = projectionOf(i);
    const FrameState draw = random.draw(desc.projection, 24);
    const VkRect2D area = random.part(draw.viewport.extent);
    const passes::Visible seen = bruteForce(earth, desc, draw, area);
    const passes::Visible said = passes::visible(earth, desc, draw, area);
    EXPECT_TRUE(covers(said, seen)) << "camera " << i;
    EXPECT_TRUE(said.atmosphere || !said.ground) << "camera " << i;
    const bool saw[] = {seen.atmosphere, seen.ground, seen.disc};
    const bool says[] = {said.atmosphere, said.ground, said.disc};
    for (int k = 0; k < 3; ++k) {
      unseen[k] += saw[k] ? 0 : 1;
      culled[k] += says[k] ? 0 : 1;
    }
  }
  // Cones are larger than rectangles: some of what is unseen is drawn all the same, but not much.
  for (int k = 0; k < 3; ++k) {
    EXPECT_GT(unseen[k], 500) << k;
    EXPECT_GT(culled[k], unseen[k] * 6 / 10) << k;
  }
}

// Each pixel is in one part, which knows what it sees.
TEST(VisibleTest, PartsAreTheViewport) {
  Parameters earth;
  ASSERT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  RandomDraws random(earth);
  uint32_t mostParts = 0;
  for (int i = 0; i < 300; ++i) {
    PictureDesc desc;
    desc.projection = projectionOf(i);
    const FrameState draw = random.draw(desc.projection, 400);
    const VkExtent2D whole = draw.viewport.extent;
    const passes::ViewportPartition parts = passes::cut(earth, desc, draw);
    mostParts = std::max(mostParts, parts.count);
    std::vector<int> times(size_t{whole.width} * whole.height);
    for (uint32_t k = 0; k < parts.count; ++k) {
      const passes::Part& part = parts.parts[k];
      EXPECT_TRUE(covers(part.visible, bruteForce(earth, desc, draw, part.area, 7)))
          << "camera " << i << ", part " << k;
      for (uint32_t y = 0; y < part.area.extent.height; ++y)
        for (uint32_t x = 0; x < part.area.extent.width; ++x)
          ++times.at((static_cast<uint32_t>(part.area.offset.y) + y) * whole.width +
                     static_cast<uint32_t>(part.area.offset.x) + x);
    }
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), std::ptrdiff_t(times.size()))
        << "camera " << i;
  }
  EXPECT_GT(mostParts, 8u);
}

// A camera that stands upright sees the sky's part above and the ground's below, no more.
TEST(VisibleTest, PartsAreFew) {
  Parameters earth;
  ASSERT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  const FrameState draw =
      makeDraw(cameraFromGeodetic(earth, 0.0, 0.0, 2.0, 0.0, radians(5.0), 0.0, radians(60.0)),
               unit({1.0, 1.0, 1.0}), {1024, 768});
  const passes::ViewportPartition parts = passes::cut(earth, PictureDesc{}, draw);
  ASSERT_EQ(parts.count, 2u);
  EXPECT_EQ(parts.parts[0].visible, (passes::Visible{true, false, false}));
  EXPECT_EQ(parts.parts[1].visible, (passes::Visible{true, true, false}));
  // The horizon is in row 451.
  EXPECT_EQ(parts.parts[0].area.extent.height, 384u);
}

class VariantTest : public EitherSkyTest {};
INSTANTIATE_TEST_SUITE_P(Solvers, VariantTest, kBothSolvers, solverName);

// The parts without air, ground or disc show what the full pipeline draws, bit by bit, as the
// camera turns until the ground, then the sun, comes into view.
TEST_P(VariantTest, VariantsDrawWhatTheFullOneDraws) {
  const Parameters earth = preset("earth");
  double sun[3];
  sunDirection(0.0, 0.0, radians(15.0), 0.0, sun);
  for (const Projection projection : {Projection::Perspective, Projection::Fisheye}) {
    ViewDesc desc = viewDesc();
    desc.projection = projection;
    PictureDesc pictureDesc;
    pictureDesc.projection = projection;
    vulkan().forcedConstants = {{2, VK_TRUE}, {3, VK_TRUE}, {5, VK_TRUE}};
    View* const full = makeView(desc);
    vulkan().forcedConstants.clear();
    TargetDesc target;
    target.extent = {96, 80};
    int variants[passes::kVariants] = {};
    for (const double altitude : {0.0, 1e4, 1e5, 1e7}) {
      for (double pitch = -90.0; pitch <= 90.0; pitch += 20.0) {
        FrameState draw = makeDraw(cameraFromGeodetic(earth, 0.0, 0.0, altitude, 0.3,
                                                      radians(pitch), radians(30.0), radians(60.0)),
                                   vec(sun), target.extent);
        draw.sun.discRadius = radians(1.0);
        const passes::ViewportPartition parts = passes::cut(earth, pictureDesc, draw);
        for (uint32_t i = 0; i < parts.count; ++i)
          ++variants[passes::variant(parts.parts[i].visible)];
        const Picture culled = picture(view(projection), tables(), draw, target);
        const Picture whole = picture(full, tables(), draw, target);
        EXPECT_EQ(culled.data, whole.data) << altitude << " m, pitch " << pitch;
      }
    }
    for (uint32_t i = 0; i < passes::kVariants; ++i)
      EXPECT_GT(variants[i], 1) << "variant " << i << " was not drawn";
  }
}

}  // namespace
}  // namespace alpenglow::testing
