#include <alpenglow/io/report_file.h>

#include <cmath>

#include "atmosphere/io/json.h"

namespace alpenglow::io {
namespace {

OrderedJson secondsOrNull(const std::optional<double>& seconds) {
  if (!seconds || !std::isfinite(*seconds)) return nullptr;
  return std::round(*seconds * 1e6) / 1e6;  // The clocks know no more.
}

}  // namespace

std::string formatReport(const Report& report) {
  OrderedJson root;
  root["device"] = nullptr;
  if (!report.device.empty()) root["device"] = report.device;
  const ResourceReport& totals = report.totals;
  root["totals"] = {{"pipelines", totals.pipelines},
                    {"images", totals.images},
                    {"buffers", totals.buffers},
                    {"bytes", totals.bytes},
                    {"dispatches", totals.dispatches},
                    {"draws", totals.draws},
                    {"shader_variants", totals.shaderVariants}};
  OrderedJson passes = OrderedJson::array();
  for (const ReportPass& pass : report.passes) {
    passes.push_back({{"name", pass.name},
                      {"dispatches", pass.dispatches},
                      {"draws", pass.draws},
                      {"bytes", pass.bytes},
                      {"cpu_seconds", secondsOrNull(pass.cpuSeconds)},
                      {"gpu_seconds", secondsOrNull(pass.gpuSeconds)}});
  }
  root["passes"] = std::move(passes);
  return formatJson(root);
}

}  // namespace alpenglow::io
