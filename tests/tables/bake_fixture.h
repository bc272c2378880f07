// Bakes tables on the validated device and brings them to the CPU.
#pragma once

#include <alpenglow/query.h>
#include <alpenglow/tables.h>

#include <map>
#include <vector>

#include <alpenglow/table_limits.h>
#include "tests/engine/device_fixture.h"
#include "tests/tables/tables_state.h"

namespace alpenglow::testing {

/// A table on the CPU: four values a texel, x fastest, as ImageInfo says.
struct CpuTable {
  ImageInfo info;
  std::vector<uint8_t> bytes;  ///< As read back.
  std::vector<float> values;

  const float* texel(uint32_t x, uint32_t y, uint32_t z = 0) const {
    return &values[4 * ((size_t(z) * info.extent.height + y) * info.extent.width + x)];
  }
};

using TableCopies = std::map<TableId, CpuTable>;

/// Sizes whose bake takes about a CPU second.
inline constexpr TableSizes kSmallSizes = {.transmittanceMu = 64,
                                           .transmittanceR = 16,
                                           .irradianceMuS = 16,
                                           .irradianceR = 4,
                                           .scatteringR = 8,
                                           .scatteringMu = 32,
                                           .scatteringMuS = 16,
                                           .scatteringNu = 4};

/// The least that the moment solver works with.
inline constexpr TableSizes kTinySettings = {32, 16, 4, 12, 4, 2, 3, 6, 6, 10, 5, 2, 2};

/// Of the standard solver, by default at the paper's sizes.
inline TableDesc standardDesc(const TableSizes& sizes = {}) {
  TableDesc desc;
  desc.solver = Solver::Standard;
  desc.sizes = sizes;
  return desc;
}

class BakeTest : public DeviceTest {
 protected:
  void SetUp() override;
  void TearDown() override;

  Context* context() { return context_; }
  Parameters preset(const char* name);
  /// Unbaked; destroyed by TearDown.
  Tables* makeTables(const Parameters& parameters, const TableDesc& desc);
  /// Records slices of `budget` units, one submit each, until the bake is done or `until` (a pass's
  /// name) has finished.
  void bake(Tables* tables, uint64_t budget = 0, const std::string& until = "");
  Tables* bakeTables(const Parameters& parameters, const TableDesc& desc, uint64_t budget = 0);
  CpuTable read(Tables* tables, TableId id);
  /// What a readback answers, into a buffer of 16 MiB.
  Status readbackStatus(Tables* tables, TableId id);
  void upload(Tables* tables, TableId id, const CpuTable& table);
  void expectSameBytes(const TableCopies& a, const TableCopies& b, const std::string& what);
  std::vector<ProbeAnswer> probe(Tables* tables, const std::vector<ProbeQuery>& queries);

 private:
  Context* context_ = nullptr;
  std::vector<Tables*> tables_;
};

/// Sorted errors' percentile, `share` in [0, 1].
double percentile(std::vector<double> errors, double share);

}  // namespace alpenglow::testing
