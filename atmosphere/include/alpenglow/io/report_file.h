// Reports of what a program did and what it cost (docs/schema/report.schema.json).
#pragma once

#include <alpenglow/context.h>
#include <alpenglow/io/result.h>

#include <optional>
#include <string>
#include <vector>

namespace alpenglow::io {

/// One pass: a bake's "dJ 3", "sky", "probe".
struct ReportPass {
  std::string name;
  uint64_t dispatches = 0;
  uint64_t draws = 0;
  uint64_t bytes = 0;                ///< Peak of the library's device memory during the pass.
  std::optional<double> cpuSeconds;  ///< User CPU over submit and wait; none: not measured.
  std::optional<double> gpuSeconds;
};

struct Report {
  std::string device;     ///< Empty (null in the file) when no device was used.
  ResourceReport totals;  ///< `images`, `buffers` and `bytes`: peaks.
  std::vector<ReportPass> passes;
};

std::string formatReport(const Report& report);

}  // namespace alpenglow::io
