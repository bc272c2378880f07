// Every table of the moment solver against its own text in double, fed with the device's tables of
// the order before: what remains is the device's float arithmetic.
#include <cmath>
#include <cstdio>

#include "atmosphere/tables/moment_shape.h"
#include "tests/tables/cpu_moments.h"

namespace alpenglow::testing {
namespace {

namespace cpu = moments_f64;

constexpr TableSizes kSettings = {64, 32, 6, 16, 6, 3, 4, 8, 8, 12, 6, 3, 3};
constexpr uint32_t kLayers = 5;
const char* const kLayerNames[kLayers] = {"ln N", "xx", "zz", "xz", "ln E"};

struct Errors {
  std::vector<double> values;

  void add(double error) { values.push_back(error); }
  void expectBelow(const std::string& what, double p95, double most) const {
    const double high = percentile(values, 0.95), worst = percentile(values, 1.0);
    std::printf("%-20s p50 %.2e  p95 %.2e  max %.2e of %zu values\n", what.c_str(),
                percentile(values, 0.5), high, worst, values.size());
    EXPECT_LT(high, p95) << what;
    EXPECT_LT(worst, most) << what;
  }
};

class MomentSolverTest : public BakeTest {
 protected:
  TableDesc desc(uint32_t orders) const {
    TableDesc result;
    result.orders = orders;
    result.sizes = kSettings;
    result.format = TableFormat::Float;
    result.keepOrders = true;
    return result;
  }

  /// Tables of order `n` that is solved (1 ...), read between its passes.
  void bakeOrder(Tables* tables, size_t n, CpuTable* field, CpuTable* source) {
    bake(tables, 0, "N " + std::to_string(n));
    *field = read(tables, kTableOrderMoments);
    bake(tables, 0, "J " + std::to_string(n + 1));
    *source = read(tables, kTableOrderSource);
  }

  /// What a stored logarithm stands for: at the floor there is no light.
  static cpu::Spectrum light(const float* stored) {
    cpu::Spectrum value = exp(spectrum(stored));
    for (int c = 0; c < 3; ++c) value[c] = value[c] > 1.01 * cpu::kMinRadiance ? value[c] : 0.0;
    return value;
  }

  /// Near the floor, the orders' tables have lost what a moment or a source was a ratio of.
  static bool isLit(float storedMean) { return storedMean > std::log(1e6 * cpu::kMinRadiance); }

  /// The same of all the nodes that a texel's cubics go through; `step`: texels from node to node.
  static bool isLitAround(const CpuTable& field, uint32_t x, uint32_t y, uint32_t step, int c) {
    const uint32_t columns = (field.info.extent.width - 1) / step;
    const uint32_t rows = (field.info.extent.height / kLayers - 1) / step;
    for (uint32_t j = std::max(y / step, 1u) - 1; j <= std::min(y / step + 2, rows); ++j)
      for (uint32_t i = std::max(x / step, 1u) - 1; i <= std::min(x / step + 2, columns); ++i)
        if (!isLit(field.texel(step * i, step * j)[c])) return false;
    return true;
  }

  template <typename Number>
  static cpu::Spectrum spectrum(const Number* v) {
    return {v[0], v[1], v[2]};
  }

  /// `expected` are the five layers of each node (`step` 1), or of the texels between them too.
  template <class Function>
  static void compareFields(const std::string& name, const CpuTable& actual, uint32_t step,
                            Function&& expected, double p95, double most) {
    Errors errors[kLayers];
    const uint32_t rows = actual.info.extent.height / kLayers;
    for (uint32_t y = 0; y < rows; ++y)
      for (uint32_t x = 0; x < actual.info.extent.width; ++x)
        for (uint32_t layer = 0; layer < kLayers; ++layer) {
          const cpu::Spectrum wanted = expected(x, y, static_cast<int>(layer));
          const float* got = actual.texel(x, y + layer * rows);
          // Of a logarithm the absolute error is the value's relative one; the moments are ratios.
          for (int c = 0; c < 3; ++c)
            if (layer == 0 || layer == 4 || isLitAround(actual, x, y, step, c))
              errors[layer].add(std::abs(got[c] - wanted[c]));
        }
    for (uint32_t layer = 0; layer < kLayers; ++layer)
      errors[layer].expectBelow(name + " " + kLayerNames[layer], p95, most);
  }

  /// Relative to the source, or to a hundredth of the mean that it is stored over. `step`: texels
  /// of the field from node to node.
  template <class Function>
  static void compareSources(const std::string& name, const CpuTable& field, uint32_t step,
                             const CpuTable& actual, Function&& expected, double p95, double most) {
    Errors errors;
    for (uint32_t y = 0; y < actual.info.extent.depth; ++y)
      for (uint32_t x = 0; x < actual.info.extent.height; ++x)
        for (uint32_t i = 0; i < actual.info.extent.width; ++i) {
          const cpu::Spectrum wanted = expected(i, x, y);
          for (int c = 0; c < 3; ++c)
            if (isLit(field.texel(step * x, step * y)[c]))
              errors.add(std::abs(actual.texel(i, x, y)[c] - wanted[c]) /
                         std::max(wanted[c], 1e-2));
        }
    errors.expectBelow(name, p95, most);
  }

  static int nodeOf(uint32_t x, uint32_t y) { return static_cast<int>(x + kSettings.nodesMuS * y); }
};

TEST_F(MomentSolverTest, OpticalDepthsMatchTheSourceInDouble) {
  const cpu::Medium medium = makeMediumF64(preset("earth"));
  const cpu::MomentShape shape = tables::makeMomentShapeF64(preset("earth"), desc(1));
  cpu::Solver solver(medium, shape);
  const CpuTable table = read(bakeTables(preset("earth"), desc(1)), kTableOpticalDepth);
  Errors errors;
  for (uint32_t y = 0; y < table.info.extent.height; ++y)
    for (uint32_t x = 0; x < table.info.extent.width; ++x) {
      const cpu::Spectrum wanted =
          solver.depthOfTexel(medium, shape, static_cast<int>(x), static_cast<int>(y));
      for (int c = 0; c < 3; ++c) errors.add(std::abs(table.texel(x, y)[c] - wanted[c]));
    }
  errors.expectBelow("ln(1 + 1e5 mean tau)", 5e-6, 1e-5);
}

TEST_F(MomentSolverTest, OrdersMatchTheSourceInDouble) {
  const Parameters earth = preset("earth");
  const TableDesc description = desc(4);
  const cpu::Medium medium = makeMediumF64(earth);
  const cpu::MomentShape shape = tables::makeMomentShapeF64(earth, description);
  Tables* tables = makeTables(earth, description);
  cpu::Solver solver(medium, shape);
  const CpuTable opticalDepth = read(bakeTables(earth, desc(1)), kTableOpticalDepth);
  CpuTable field, source;
  for (size_t order = 1; order <= 3; ++order) {
    bakeOrder(tables, order, &field, &source);
    if (order == 1) solver.depth_ = DoubleTable(opticalDepth);
    ASSERT_FALSE(HasFailure());
    solver.solve(order == 1);
    const std::string name = "order " + std::to_string(order);
    compareFields(
        name, field, 1,
        [&](uint32_t x, uint32_t y, int layer) {
          return solver.encodeLayer(solver.field(nodeOf(x, y), order == 1), layer);
        },
        1e-4, 1e-3);
    compareSources(
        name + " source", field, 1, source,
        [&](uint32_t i, uint32_t x, uint32_t y) {
          return solver.source(static_cast<int>(i), nodeOf(x, y), exp(spectrum(field.texel(x, y))));
        },
        1e-4, 1e-3);
    solver.setNodes(DoubleTable(field));
    solver.source_ = DoubleTable(source);
  }
}

// The series of the orders goes on as the last two fall off; with N orders it doesn't.
TEST_F(MomentSolverTest, TheSumIncludesTheTail) {
  for (uint32_t orders : {0u, 3u}) {
    const TableDesc description = desc(orders);
    const cpu::MomentShape shape = tables::makeMomentShapeF64(preset("earth"), description);
    cpu::Solver solver(makeMediumF64(preset("earth")), shape);
    Tables* tables = makeTables(preset("earth"), description);
    const size_t last = tables::solvedOrders(preset("earth"), description) - 1;
    std::vector<CpuTable> fields(last), sources(last);
    for (size_t i = 0; i < last; ++i) bakeOrder(tables, i + 1, &fields[i], &sources[i]);
    bake(tables);
    ASSERT_FALSE(HasFailure());
    const auto share = [&](size_t i, uint32_t x, uint32_t y, bool irradiance) {
      const uint32_t row = y + (irradiance ? 4 * kSettings.nodesR : 0);
      const auto value = [&](size_t k) { return light(fields[k].texel(x, row)); };
      return i + 1 < last ? cpu::Spectrum(1.0)
                          : 1.0 + solver.tailFactor(shape, value(last - 1), value(last - 2));
    };
    const auto sumOfNode = [&](uint32_t x, uint32_t y) {
      cpu::Solver::NodeField sum = {};
      for (size_t i = 0; i < last; ++i) {
        const auto layer = [&](uint32_t k) {
          return spectrum(fields[i].texel(x, y + k * kSettings.nodesR));
        };
        const cpu::Spectrum mean = light(fields[i].texel(x, y)) * share(i, x, y, false);
        sum.mean += mean;
        sum.xx += mean * layer(1);
        sum.zz += mean * layer(2);
        sum.xz += mean * layer(3);
        sum.irradiance +=
            light(fields[i].texel(x, y + 4 * kSettings.nodesR)) * share(i, x, y, true);
      }
      return sum;
    };
    const std::string name = "sum of " + std::to_string(orders);
    DoubleTable nodes(kSettings.nodesMuS, kSettings.nodesR * kLayers, 1);
    for (uint32_t y = 0; y < kSettings.nodesR; ++y)
      for (uint32_t x = 0; x < kSettings.nodesMuS; ++x)
        for (uint32_t layer = 0; layer < kLayers; ++layer) {
          const cpu::Spectrum v = solver.encodeLayer(sumOfNode(x, y), static_cast<int>(layer));
          std::copy_n(&v[0], 3, nodes.at(x, y + layer * kSettings.nodesR, 0));
        }
    solver.setNodes(nodes);
    const CpuTable field = read(tables, kTableMoments);
    compareFields(
        name, field, 3,
        [&](uint32_t x, uint32_t y, int layer) {
          const uint32_t row = y + static_cast<uint32_t>(layer) * fieldTexels(kSettings.nodesR);
          return spectrum(solver.field_.at(x, row, 0));
        },
        1e-5, 1e-4);
    compareSources(
        name + " source", field, 3, read(tables, kTableSource),
        [&](uint32_t x, uint32_t muS, uint32_t r) {
          cpu::Spectrum sum(0.0);
          for (size_t i = 0; i < last; ++i)
            sum += spectrum(sources[i].texel(x, muS, r)) * light(fields[i].texel(muS, r)) *
                   share(i, muS, r, false);
          return sum / sumOfNode(muS, r).mean;
        },
        1e-5, 1e-4);
  }
}

// The top of 60 km of air on Earth is lit until the sun is 7.84 degrees below its own horizon, and
// the ground sees air as far as 7.84 degrees round the planet: below -15.7 degrees no sunlight
// arrives there in one scattering, and no second order could come of a rounding error.
TEST_F(MomentSolverTest, OrderOneIsExactlyZeroOnTheGroundInDeepTwilight) {
  const Parameters earth = preset("earth");
  ASSERT_EQ(earth.topRadius_m - earth.bottomRadius_m, 60e3);
  TableDesc description = desc(2);
  description.sizes.nodesMuS = 64;
  Tables* tables = makeTables(earth, description);
  bake(tables, 0, "N 1");
  const CpuTable field = read(tables, kTableOrderMoments);
  const cpu::MomentShape shape = tables::makeMomentShapeF64(earth, description);
  // Both are texts of one constant; the device's logarithm may be a rounding off.
  const double floor = std::log(physics_f64::kMinRadiance);
  uint32_t dark = 0, lit = 0;
  for (uint32_t x = 0; x < field.info.extent.width; ++x) {
    const double muS = physics_f64::nodeMuS(shape, physics_f64::texelToU(x, shape.nodesMuS));
    const double elevation = 90.0 - std::acos(muS) * 180.0 / 3.14159265358979323846;
    for (uint32_t layer : {0u, 4u})
      for (int c = 0; c < 3; ++c) {
        const double value = field.texel(x, layer * kSettings.nodesR)[c];
        if (elevation < -15.7) {
          EXPECT_NEAR(value, floor, 1e-5) << elevation << " " << kLayerNames[layer];
          ++dark;
        } else if (elevation > -14.0) {
          EXPECT_GT(value, floor + 20.0) << elevation << " " << kLayerNames[layer];
          ++lit;
        }
      }
  }
  EXPECT_GT(dark, 30u);
  EXPECT_GT(lit, 30u);
}

}  // namespace
}  // namespace alpenglow::testing
