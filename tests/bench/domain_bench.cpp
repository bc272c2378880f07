// What tables for a shorter range of sun elevations cost, and how far they are from the truth of a
// scene at ground level under a sun that stands 3 degrees high. User CPU of lavapipe, all threads,
// the least of three bakes after one that compiled the shaders.
#include <cstdio>
#include <numbers>

#include "tests/bench/cpu_time.h"
#include "tests/tables/truth_errors.h"

namespace alpenglow::testing {
namespace {

struct Row {
  double cpu_s = 0.0, bytes = 0.0, p95 = 0.0, most = 0.0;
};

class DomainBench : public TruthTest {
 protected:
  Row row(const char* name, const truth::TruthSet& set, const TableDesc& desc) {
    Row row;
    row.cpu_s = 1e9;
    Tables* tables = bakeTables(set.parameters, desc);
    for (int i = 0; i < 3; ++i) {
      const uint64_t before = bytesNow();
      const double start = userSeconds();
      tables = bakeTables(set.parameters, desc);
      row.cpu_s = std::min(row.cpu_s, userSeconds() - start);
      row.bytes = double(bytesNow() - before);
    }
    const ImageInfo source = imageOf(tables, kTableSource);
    const TruthErrors errors = errorsOf(set, tables);
    row.p95 = errors.p95(truth::Band::Low);
    row.most = errors.most(truth::Band::Low);
    std::printf("| %s | %u | %.2f | %.2f | %.2f / %.2f | %.2f |\n", name, source.extent.height,
                row.cpu_s, 1e-6 * row.bytes, 100 * row.p95, 100 * row.most,
                100 * errors.irradiance);
    std::fflush(stdout);
    return row;
  }

 private:
  uint64_t bytesNow() {
    finishFrames(context());
    ResourceReport report;
    resourceReport(context(), &report);
    return report.bytes;
  }
};

TEST_F(DomainBench, AFixedEveningSunCostsAQuarter) {
  const auto set = truth::loadTruth("evening");
  ASSERT_TRUE(set) << set.error;
  std::printf("| tables | sun nodes | bake cpu-s | MB | rays %% | irradiance %% |\n");
  const Row all = row("every sun", *set, {});
  TableDesc desc;
  desc.sunZenithFrom = desc.sunZenithTo = 87.0 * std::numbers::pi / 180.0;
  row("the sun at 3 degrees", *set, desc);
  desc.sizes.depthMu = 128;
  desc.sizes.depthH = 64;
  const Row one = row("the same, optical depths of 128 x 64", *set, desc);
  desc.sizes = {};
  desc.quality = Quality::High;
  const Row fine = row("the same, level high", *set, desc);
  EXPECT_LE(one.cpu_s, all.cpu_s / 4.0);
  EXPECT_LE(one.bytes, all.bytes / 4.0);
  EXPECT_LE(one.p95, all.p95);
  EXPECT_LE(one.most, all.most);
  EXPECT_LE(fine.p95, 0.75 * all.p95);
}

}  // namespace
}  // namespace alpenglow::testing
