// Which variant of the pipeline a camera gets: what is left out is in no pixel.
#include <algorithm>
#include <cmath>
#include <random>

#include "atmosphere/sky/sky_pass.h"
#include "tests/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

/// Does any pixel see the ground or the disc? By the pixels' directions, in double.
sky::Visible bruteForce(const Parameters& parameters, const ViewDesc& desc, const SkyDraw& draw) {
  sky::Visible seen = {false, false};
  const Vec position = vec(draw.camera.position_m), sun = vec(draw.sun.direction);
  const double r = length(position);
  const Vec down = {-position[0] / r, -position[1] / r, -position[2] / r};
  const double planet = std::asin(std::min(1.0, parameters.bottomRadius_m / r));
  // Up to half a pixel of the disc's edge is drawn outside its radius, more if it is tiny.
  const double tangent = std::tan(0.5 * draw.camera.fov);
  const VkExtent2D extent = draw.viewport.extent;
  const double pixel = desc.projection == Projection::Fisheye
                           ? draw.camera.fov / std::min(extent.width, extent.height)
                           : 2.0 * tangent / extent.height;
  const sky::SkyConstants constants = sky::makeConstants(parameters, desc, draw);
  const double reach = static_cast<double>(constants.sunDiscChord[3]) + 0.5 * pixel;
  for (uint32_t y = 0; y < extent.height; ++y) {
    for (uint32_t x = 0; x < extent.width; ++x) {
      const auto direction = pixelDirection(draw, desc.projection, x, y);
      if (!direction) continue;
      const auto angle = [&](const Vec& to) {
        return std::atan2(length(cross(*direction, to)), dot(*direction, to));
      };
      seen.ground = seen.ground || angle(down) < planet;
      const double chord = 2.0 * std::sin(0.5 * angle(sun));
      seen.disc = seen.disc || (draw.sun.discRadius > 0.0 && chord < reach);
    }
  }
  return seen;
}

class VariantTest : public EitherSkyTest {};
INSTANTIATE_TEST_SUITE_P(Solvers, VariantTest, kBothSolvers, solverName);

TEST(VisibleTest, IsConservativeAndUseful) {
  Parameters earth;
  ASSERT_EQ(findPreset("earth", &earth), Status::Ok);
  std::mt19937 random(20081);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto direction = [&] {
    const double z = 2.0 * uniform(random) - 1.0, phi = 2.0 * kPi * uniform(random);
    const double s = std::sqrt(1.0 - z * z);
    return Vec{s * std::cos(phi), s * std::sin(phi), z};
  };
  int groundMissed = 0, discMissed = 0, groundCulled = 0, groundUnseen = 0, discCulled = 0,
      discUnseen = 0;
  for (int i = 0; i < 4000; ++i) {
    ViewDesc desc;
    desc.projection = i % 2 == 0 ? Projection::Perspective : Projection::Fisheye;
    const double most = i % 2 == 0 ? radians(175.0) : 2.0 * kPi;
    const double altitude = uniform(random) < 0.2 ? 0.0 : std::pow(10.0, 8.0 * uniform(random));
    const VkExtent2D extent = {1 + static_cast<uint32_t>(23.0 * uniform(random)),
                               1 + static_cast<uint32_t>(23.0 * uniform(random))};
    const double fov = most * std::pow(uniform(random), 2.0) + 1e-3;
    SkyDraw draw =
        makeDraw(cameraFromGeodetic(earth, kPi * (uniform(random) - 0.5), 6.0 * uniform(random),
                                    altitude, 6.0 * uniform(random), kPi * (uniform(random) - 0.5),
                                    6.0 * uniform(random), std::min(fov, most)),
                 direction(), extent);
    draw.sun.discRadius = uniform(random) < 0.1 ? 0.0 : std::pow(10.0, -5.0 * uniform(random));
    const sky::Visible seen = bruteForce(earth, desc, draw);
    const sky::Visible said = sky::visible(earth, desc, draw);
    groundMissed += seen.ground && !said.ground ? 1 : 0;
    discMissed += seen.disc && !said.disc ? 1 : 0;
    groundUnseen += seen.ground ? 0 : 1;
    discUnseen += seen.disc ? 0 : 1;
    groundCulled += said.ground ? 0 : 1;
    discCulled += said.disc ? 0 : 1;
    if ((seen.ground && !said.ground) || (seen.disc && !said.disc)) {
      ADD_FAILURE() << "camera " << i << ", altitude " << altitude << ", fov " << fov << ", "
                    << extent.width << " x " << extent.height;
    }
  }
  EXPECT_EQ(groundMissed, 0);
  EXPECT_EQ(discMissed, 0);
  // Cones are larger than rectangles: some of what is unseen is drawn all the same, but not much.
  EXPECT_GT(groundUnseen, 500);
  EXPECT_GT(groundCulled, groundUnseen * 6 / 10);
  EXPECT_GT(discUnseen, 500);
  EXPECT_GT(discCulled, discUnseen * 6 / 10);
}

// The variants without ground or disc draw what the full one draws, bit by bit, as the camera turns
// until the ground, then the sun, comes into view.
TEST_P(VariantTest, VariantsDrawWhatTheFullOneDraws) {
  const Parameters earth = preset("earth");
  double sun[3];
  sunDirection(0.0, 0.0, radians(15.0), 0.0, sun);
  for (const Projection projection : {Projection::Perspective, Projection::Fisheye}) {
    ViewDesc desc = viewDesc();
    desc.projection = projection;
    vulkan().forcedConstants = {{2, VK_TRUE}, {3, VK_TRUE}};
    View* const full = makeView(desc);
    vulkan().forcedConstants.clear();
    TargetDesc target;
    target.extent = {32, 24};
    int variants[4] = {};
    for (const double altitude : {0.0, 2.0, 1e4, 59999.0, 1e5, 1e7}) {
      for (double pitch = -90.0; pitch <= 90.0; pitch += 10.0) {
        SkyDraw draw = makeDraw(cameraFromGeodetic(earth, 0.0, 0.0, altitude, 0.3, radians(pitch),
                                                   radians(30.0), radians(60.0)),
                                vec(sun), target.extent);
        draw.sun.discRadius = radians(1.0);
        const sky::Visible seen = sky::visible(earth, desc, draw);
        ++variants[(seen.ground ? 1 : 0) + (seen.disc ? 2 : 0)];
        const Picture culled = picture(view(projection), tables(), draw, target);
        const Picture whole = picture(full, tables(), draw, target);
        EXPECT_EQ(culled.data, whole.data) << altitude << " m, pitch " << pitch;
      }
    }
    for (int i = 0; i < 4; ++i) EXPECT_GT(variants[i], 1) << "variant " << i << " was not drawn";
  }
}

}  // namespace
}  // namespace alpenglow::testing
