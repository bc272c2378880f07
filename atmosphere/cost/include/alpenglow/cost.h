// What accuracy costs in time, measured on the device at hand: Alpenglow::cost. Bakes and draws
// with many settings of the tables and with simpler models, and compares each with path-traced
// truth.
#pragma once

#include <alpenglow/io/result.h>
#include <alpenglow/io/tone_map.h>
#include <alpenglow/tables.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace alpenglow::cost {

/// Median of several runs, and the least and the greatest. Seconds, or what the name says.
struct Timing {
  double median = 0.0, least = 0.0, most = 0.0;
  uint32_t runs = 0;  ///< 0: not measured.
};

/// Bands of the sun's elevation, as docs/reference-solution.md has them.
inline constexpr uint32_t kBandCount = 5;
inline constexpr const char* kBandNames[kBandCount] = {"day", "low", "civil", "nautical",
                                                       "astronomical"};

/// Relative errors of total radiance, as fractions.
struct BandError {
  double p95 = 0.0, most = 0.0;
  uint32_t rays = 0;  ///< 0: none was compared.
};

/// Views that frames are timed with.
inline constexpr uint32_t kViewCount = 6;
inline constexpr const char* kViewNames[kViewCount] = {"ground 40", "ground 3", "ground -4",
                                                       "ground -9", "10 km",    "space"};
inline constexpr uint32_t kGroundViews = 4;  ///< The first of these.

/// One setting, measured.
struct Row {
  std::string sweep;   ///< "model", "quality", "orders" ...
  std::string name;    ///< Unique in its sweep.
  std::string family;  ///< "moments", "standard", or a model: decides the colour.
  std::string detail;  ///< The settings, for people.
  std::string note;    ///< Why something was not measured, or how it was; may be empty.
  Timing bake_s;       ///< User CPU on software devices, else by timestamps.
  std::array<Timing, kViewCount> frame_ms;
  uint64_t bytes = 0;      ///< That stay: tables, LUTs.
  uint64_t peakBytes = 0;  ///< While baking.
  std::array<BandError, kBandCount> errors;

  bool measured() const { return bytes != 0 || frame_ms[0].runs != 0; }
  /// Mean over the ground views, ms; 0 without.
  double groundFrame_ms() const;
};

/// A scene drawn by a model, and its difference from the finest at the same exposure.
struct Comparison {
  std::string scene, model;
  io::ByteImage picture, difference;
};

struct Report {
  std::vector<Row> rows;
  std::vector<Comparison> comparisons;
  std::string device, driver, vulkan, library, date, command, machine;
  std::string clock;  ///< "user CPU" or "GPU timestamps".
  bool quick = false;
  double seconds = 0.0;  ///< Wall-clock time of the whole measurement.
};

/// Measurements by a program's own code, such as light shafts over its terrain.
using MoreRowsFn = std::function<io::Result<std::vector<Row>>()>;

struct Options {
  bool quick = false;       ///< Fewer settings, fewer runs.
  std::string device;       ///< As headless::DeviceOptions::select.
  std::string truthFolder;  ///< Holds earth.atmosphere.json, .queries.json and .answers.json.
  std::string command;      ///< For the page.
  std::function<void(double share, const std::string& what)> progress;  ///< May be null.
  MoreRowsFn more;                                                      ///< May be null.
  /// For tests: only rows whose "sweep/name" this accepts. Null: all.
  std::function<bool(const std::string&)> only;
  bool validation = false;  ///< With validation layers, whose first message is a failure.
  uint32_t width = 640, height = 360;  ///< Of timed frames.
};

/// Measures everything; takes minutes. On failure a sentence.
io::Result<Report> measure(const Options& options);

/// Makes the folder for writeReport, or says why it can't be made.
io::Done prepareFolder(const std::string& folder);

/// Writes cost.csv, charts (SVG and PNG), pictures and index.html into a folder, which is made.
/// Each file is written whole or not at all.
io::Done writeReport(const Report& report, const std::string& folder);

/// Rows of which no other is at least as good in both values, and better in one; indices in rising
/// order of x. Values that are not above 0 don't take part.
std::vector<size_t> paretoFront(const std::vector<double>& x, const std::vector<double>& y);

/// Median, least and greatest.
Timing timingOf(std::vector<double> values);

}  // namespace alpenglow::cost
