#include "atmosphere/api/cpu_field.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace alpenglow::cpu {
namespace {

struct Axis {
  uint32_t texel[2];
  Real weight[2];
};

Axis axis(Real coordinate, uint32_t size) {
  const Real last = static_cast<Real>(size - 1);
  const Real x = std::clamp(coordinate * static_cast<Real>(size) - 0.5f, 0.0f, last);
  const auto lower = static_cast<uint32_t>(x);
  const Real share = x - static_cast<Real>(lower);
  return {{lower, std::min(lower + 1, size - 1)}, {1.0f - share, share}};
}

}  // namespace

Spectrum TableCopy::texel(uint32_t x, uint32_t y, uint32_t z) const {
  const size_t index = (size_t{z} * height + y) * width + x;
  const auto* bytes = static_cast<const uint8_t*>(data) + index * (half ? 8 : 16);
  Spectrum result;
  if (half) {
    uint16_t values[3];
    std::memcpy(values, bytes, sizeof values);
    for (int c = 0; c < 3; ++c) result[c] = glm::unpackHalf1x16(values[c]);
  } else {
    float values[3];
    std::memcpy(values, bytes, sizeof values);
    for (int c = 0; c < 3; ++c) result[c] = values[c];
  }
  return result;
}

Spectrum TableCopy::sample(Real u, Real v, Real w) const {
  if (data == nullptr) return Spectrum(0.0f);
  const Axis x = axis(u, width), y = axis(v, height), z = axis(w, depth);
  Spectrum sum(0.0f);
  for (int k = 0; k < (depth > 1 ? 2 : 1); ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        sum +=
            texel(x.texel[i], y.texel[j], z.texel[k]) * (x.weight[i] * y.weight[j] * z.weight[k]);
  return sum;
}

}  // namespace alpenglow::cpu
