// Charts of a report: points or lines over logarithmic axes, drawn once for SVG and PNG.
#pragma once

#include <alpenglow/cost.h>

#include <string>
#include <vector>

namespace alpenglow::cost {

struct ChartPoint {
  double x = 0.0, y = 0.0;
  std::string label;
  std::string family;  ///< Decides the colour.
};

struct ChartLine {
  std::string name, family;
  std::vector<ChartPoint> points;
};

struct Chart {
  std::string file;  ///< Without an ending.
  std::string title, subtitle, xTitle, yTitle;
  std::vector<ChartPoint> points;
  std::vector<size_t> front;         ///< Of `points`: joined by a line.
  std::vector<ChartLine> lines;      ///< In place of points.
  std::vector<std::string> xLabels;  ///< Given: x is an index of these, from 0.
};

/// Those of a report that has rows for them.
std::vector<Chart> chartsOf(const Report& report);
/// The whole file; empty if cairo fails.
std::string drawChart(const Chart& chart, bool vector);
/// A family's colour, as "#rrggbb".
std::string colorOf(const std::string& family);

}  // namespace alpenglow::cost
