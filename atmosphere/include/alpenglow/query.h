// Point queries on the CPU, from copies of the moment solver's tables: so that a host can tint its
// lights and fog without waiting for a frame.
#pragma once

#include <alpenglow/probe.h>

namespace alpenglow {
inline namespace v1 {

/// Those of tables that TableDesc::without leaves out stay null.
/// Host memory with what recordTableReadback has written, as it lies in the buffer; the host keeps
/// it unchanged during a call. Null: that copy has not arrived.
struct TableReadbacks {
  const void* opticalDepth = nullptr;  ///< TableId::OpticalDepth.
  const void* moments = nullptr;       ///< TableId::Moments.
  const void* source = nullptr;        ///< TableId::Source, by far the largest.
  /// False: rays are answered without skyRadiance (0), and `source` may be null. Transmittance,
  /// ground radiance and irradiances don't need it.
  bool skyRadiance = true;
};

/// Answers queries with the functions that recordProbe runs, in float on the calling thread: the
/// device's answers but for rounding and the precision of its mathematical functions and filter. On
/// lavapipe they agree within 1.4e-5 of the value (api_tests --gtest_filter=QueryTest.TheCpu*); a
/// GPU whose filter has 8-bit weights is coarser than the CPU. NotReady before the tables are, or
/// while a copy that is needed is null; Unsupported for tables of Solver::Standard. On failure no
/// answer is written. Nothing shared is written to: any number of threads may ask the same tables
/// while no other call changes them.
ALPENGLOW_API Status answerQueries(const Tables* tables, const TableReadbacks& copies,
                                   const ProbeQuery* queries, uint32_t count, ProbeAnswer* answers);

}  // namespace v1
}  // namespace alpenglow
