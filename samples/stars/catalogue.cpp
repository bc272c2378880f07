// samples/data/stars.bin, which the build embeds, and where its stars stand.
#include <alpenglow/shaders/sample_star_catalogue.h>

#include <bit>
#include <cmath>

#include "stars.h"

namespace alpenglow::samples {
namespace {

constexpr double kSunMagnitude = -26.74;
constexpr double kRadians = 3.14159265358979323846 / 180.0;
constexpr size_t kFields = 3;

double field(size_t star, size_t index) {
  return static_cast<double>(
      std::bit_cast<float>(shaders::kSampleStarCatalogue[star * kFields + index]));
}

}  // namespace

std::vector<Star> starCatalogue() {
  std::vector<Star> stars(std::size(shaders::kSampleStarCatalogue) / kFields);
  for (size_t i = 0; i < stars.size(); ++i) {
    stars[i] = {field(i, 0), field(i, 1) * kRadians, field(i, 2) * kRadians};
  }
  return stars;
}

double shareOfSun(const Star& star) {
  return std::pow(10.0, -0.4 * (star.magnitude - kSunMagnitude));
}

void starDirection(const Star& star, double siderealHours, double direction[3]) {
  const double longitude = star.rightAscension - siderealHours * 15.0 * kRadians;
  direction[0] = std::cos(star.declination) * std::cos(longitude);
  direction[1] = std::cos(star.declination) * std::sin(longitude);
  direction[2] = std::sin(star.declination);
}

}  // namespace alpenglow::samples
