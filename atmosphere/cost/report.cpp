// cost.csv, and the folder that everything goes into.
#include <alpenglow/io/file.h>
#include <alpenglow/io/image_file.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "atmosphere/cost/charts.h"
#include "atmosphere/cost/page.h"

namespace alpenglow::cost {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string timing(const Timing& t) {
  if (t.runs == 0) return ",,,";
  return number(t.median) + "," + number(t.least) + "," + number(t.most) + "," +
         std::to_string(t.runs);
}

std::string underscored(std::string text) {
  for (char& c : text) c = c == ' ' || c == '-' ? '_' : c;
  return text;
}

std::string header() {
  std::string line = "sweep,name,family,detail,note,bytes,peak_bytes";
  const auto add = [&](const std::string& stem) {
    for (const char* what : {"median", "least", "most", "runs"}) line += "," + stem + "_" + what;
  };
  add("bake_s");
  for (const char* view : kViewNames) add("frame_ms_" + underscored(view));
  for (const char* band : kBandNames)
    for (const char* what : {"p95", "most", "rays"})
      line += std::string(",error_") + band + "_" + what;
  return line;
}

std::string lineOf(const Row& row) {
  std::string line = quoted(row.sweep) + "," + quoted(row.name) + "," + quoted(row.family) + "," +
                     quoted(row.detail) + "," + quoted(row.note) + "," + std::to_string(row.bytes) +
                     "," + std::to_string(row.peakBytes) + "," + timing(row.bake_s);
  for (const Timing& frame : row.frame_ms) line += "," + timing(frame);
  for (const BandError& error : row.errors) {
    line += error.rays == 0 ? std::string(",,,")
                            : "," + number(error.p95) + "," + number(error.most) + "," +
                                  std::to_string(error.rays);
  }
  return line;
}

io::Done writeText(const fs::path& path, const std::string& text) {
  return io::writeFile(path.string(), text.data(), text.size());
}

io::Done makeFolder(const fs::path& path) {
  std::error_code made, ignored;
  fs::create_directories(path, made);
  if (fs::is_directory(path, ignored)) return {};
  return {"The folder '" + path.string() + "' can't be made: " +
          (fs::exists(path, ignored) ? "a file is in its place." : made.message() + ".")};
}

}  // namespace

io::Done prepareFolder(const std::string& folder) {
  // Its own sentence first: of a file in its place, which has no folder in it either.
  if (io::Done done = makeFolder(folder); !done) return done;
  return makeFolder(fs::path(folder) / "pictures");
}

io::Done writeReport(const Report& report, const std::string& folder) {
  const fs::path to(folder);
  if (io::Done done = prepareFolder(folder); !done) return done;
  std::string csv = header() + "\n";
  for (const Row& row : report.rows) csv += lineOf(row) + "\n";
  if (io::Done done = writeText(to / "cost.csv", csv); !done) return done;
  for (const Chart& chart : chartsOf(report)) {
    for (const bool vector : {true, false}) {
      const std::string drawn = drawChart(chart, vector);
      if (drawn.empty()) return {"The chart '" + chart.file + "' could not be drawn by cairo."};
      const std::string name = chart.file + (vector ? ".svg" : ".png");
      if (io::Done done = writeText(to / name, drawn); !done) return done;
    }
  }
  for (const Comparison& c : report.comparisons) {
    const std::string stem = pictureStem(c);
    if (io::Done done = io::writePng((to / (stem + ".png")).string(), c.picture); !done)
      return done;
    if (io::Done done = io::writePng((to / (stem + "_difference.png")).string(), c.difference);
        !done)
      return done;
  }
  return writeText(to / "index.html", pageOf(report));
}

std::string pictureStem(const Comparison& comparison) {
  std::string stem = comparison.scene + "_" + comparison.model;
  for (char& c : stem)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return "pictures/" + stem;
}

}  // namespace alpenglow::cost
