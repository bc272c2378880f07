// Pass "I n": cubics between nodes reproduce what is smooth, and never overshoot where light ends
// between two nodes.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <alpenglow/table_limits.h>
#include "atmosphere/tables/moment_shape.h"

namespace alpenglow::testing {
namespace {

#define IN(type) const type&
#define ALPENGLOW_FN inline
#define REAL(literal) static_cast<float>(literal)

using namespace physics_f32;             // NOLINT: as the source has it
using Spectrum = physics_f32::Spectrum;  // not the public one

/// One layer of nodes.
class Nodes {
 public:
  static constexpr int kMuS = 8, kR = 5;

  template <class Function>
  explicit Nodes(Function&& function, int muS = kMuS, int r = kR) {
    shape_.nodesMuS = static_cast<float>(muS);
    shape_.nodesR = static_cast<float>(r);
    shape_.fieldMuS = static_cast<float>(fieldTexels(static_cast<uint32_t>(muS)));
    shape_.fieldR = static_cast<float>(fieldTexels(static_cast<uint32_t>(r)));
    for (int y = 0; y < r; ++y)
      for (int x = 0; x < muS; ++x)
        values_.push_back(Spectrum(function(static_cast<float>(x), static_cast<float>(y))));
  }

  float texel(int x, int y) { return interpolatedNode(shape_, x, y, 0)[0]; }
  float node(int x, int y) const { return values_[static_cast<size_t>(x + kMuS * y)][0]; }

 private:
  Spectrum fetchNode(int x, int y) const {
    return values_[static_cast<size_t>(x + static_cast<int>(shape_.nodesMuS) * y)];
  }

#include "shaders/glsl/physics/node_interpolation.glsl"

  MomentShape shape_ = {};
  std::vector<Spectrum> values_;
};

#undef IN
#undef ALPENGLOW_FN
#undef REAL

constexpr int kStep = 3;

TEST(NodeInterpolation, KeepsTheNodes) {
  Nodes nodes([](float x, float y) { return std::sin(3.0f * x) - y * y; });
  for (int y = 0; y < Nodes::kR; ++y)
    for (int x = 0; x < Nodes::kMuS; ++x)
      EXPECT_NEAR(nodes.texel(kStep * x, kStep * y), nodes.node(x, y), 1e-5f) << x << " " << y;
}

TEST(NodeInterpolation, ParabolasAreExactToTheEnds) {
  const auto parabola = [](float x, float y) {
    return 0.3f * (x + 4.0f) * (x + 4.0f) - 2.0f * y + 0.1f * (y + 3.0f) * (y + 3.0f);
  };
  Nodes nodes(parabola);
  for (int y = 0; y <= kStep * (Nodes::kR - 1); ++y)
    for (int x = 0; x <= kStep * (Nodes::kMuS - 1); ++x) {
      const float exact = parabola(static_cast<float>(x) / kStep, static_cast<float>(y) / kStep);
      EXPECT_NEAR(nodes.texel(x, y), exact, 1e-4f) << x << " " << y;
    }
}

TEST(NodeInterpolation, TwoNodesAreJoinedByALine) {
  Nodes nodes([](float x, float y) { return 2.0f * x - 5.0f * y; }, 2, 2);
  for (int y = 0; y <= kStep; ++y)
    for (int x = 0; x <= kStep; ++x)
      EXPECT_NEAR(nodes.texel(x, y),
                  (2.0f * static_cast<float>(x) - 5.0f * static_cast<float>(y)) / kStep, 1e-5f)
          << x << " " << y;
}

// Logarithms of light that falls off, ever faster, to darkness within one cell.
TEST(NodeInterpolation, DarkNodesDoNotAffectNeighbours) {
  Nodes nodes([](float x, float y) { return x + 0.5f * y < 4.4f ? -1.0f - x * x - y : -69.0f; });
  for (int y = 0; y <= kStep * (Nodes::kR - 1); ++y) {
    for (int x = 1; x <= kStep * (Nodes::kMuS - 1); ++x)
      EXPECT_LE(nodes.texel(x, y), nodes.texel(x - 1, y) + 1e-5f) << x << " " << y;
    EXPECT_GE(nodes.texel(kStep * (Nodes::kMuS - 1), y), -69.001f);
  }
  for (int y = 0; y < Nodes::kR; ++y)
    for (int x = 0; x <= kStep * (Nodes::kMuS - 1); ++x) {
      const int lower = std::min(x / kStep, Nodes::kMuS - 2);
      EXPECT_LE(nodes.texel(x, kStep * y), nodes.node(lower, y) + 1e-5f) << x << " " << y;
      EXPECT_GE(nodes.texel(x, kStep * y), nodes.node(lower + 1, y) - 1e-5f) << x << " " << y;
    }
}

}  // namespace
}  // namespace alpenglow::testing
