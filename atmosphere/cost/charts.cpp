#include "atmosphere/cost/charts.h"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

namespace alpenglow::cost {
namespace {

constexpr double kWidth = 920.0, kHeight = 560.0;
constexpr double kLeft = 74.0, kRight = 24.0, kTop = 66.0, kBottom = 58.0;

struct Rgb {
  double r, g, b;
};

Rgb rgbOf(const std::string& hex) {
  const auto byte = [&](size_t at) { return std::stoi(hex.substr(at, 2), nullptr, 16) / 255.0; };
  return {byte(1), byte(3), byte(5)};
}

std::string tickText(double value) {
  char text[24];
  std::snprintf(text, sizeof text, value >= 1e4 ? "%.0e" : "%g", value);
  return text;
}

/// A logarithmic axis over values above 0, or one of named places.
struct Axis {
  double low = 1.0, high = 10.0;
  bool logarithmic = true;
  double share(double value) const {
    return logarithmic ? std::log(value / low) / std::log(high / low)
                       : (value - low) / (high - low);
  }
  std::vector<double> ticks() const {
    std::vector<double> result;
    const bool few = std::log10(high / low) > 2.2;
    for (int e = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, e) <= high; ++e) {
      for (const double m : {1.0, 2.0, 5.0}) {
        const double value = m * std::pow(10.0, e);
        if (value >= low * 0.999 && value <= high * 1.001 && (m == 1.0 || !few))
          result.push_back(value);
      }
    }
    return result;
  }
};

Axis axisOf(const std::vector<double>& values) {
  Axis axis;
  double least = 1e300, most = 0.0;
  for (const double v : values) {
    if (!(v > 0.0)) continue;
    least = std::min(least, v);
    most = std::max(most, v);
  }
  if (most == 0.0) return axis;
  axis.low = least / 1.35;
  axis.high = std::max(most * 1.35, axis.low * 3.0);
  return axis;
}

struct Box {
  double x0, y0, x1, y1;
  double overlap(const Box& o) const {
    const double w = std::min(x1, o.x1) - std::max(x0, o.x0);
    const double h = std::min(y1, o.y1) - std::max(y0, o.y0);
    return w > 0.0 && h > 0.0 ? w * h : 0.0;
  }
};

class Canvas {
 public:
  Canvas(cairo_t* cairo, const Chart& chart) : c_(cairo), chart_(chart) {
    std::vector<double> xs, ys;
    for (const ChartPoint& p : chart.points) {
      xs.push_back(p.x);
      ys.push_back(p.y);
    }
    for (const ChartLine& line : chart.lines) {
      for (const ChartPoint& p : line.points) {
        xs.push_back(p.x);
        ys.push_back(p.y);
      }
    }
    y_ = axisOf(ys);
    if (chart.xLabels.empty()) {
      x_ = axisOf(xs);
    } else {
      x_ = {-0.3, static_cast<double>(chart.xLabels.size()) - 0.4, false};
    }
  }

  void draw() {
    color({1.0, 1.0, 1.0});
    cairo_paint(c_);
    titles();
    axes();
    if (chart_.lines.empty()) {
      front();
      for (const ChartPoint& p : chart_.points) dot(p, 5.0);
      labels();
    } else {
      for (const ChartLine& line : chart_.lines) curve(line);
      legend();
    }
  }

 private:
  double px(double x) const { return kLeft + x_.share(x) * (kWidth - kLeft - kRight); }
  double py(double y) const { return kHeight - kBottom - y_.share(y) * (kHeight - kTop - kBottom); }
  void color(const Rgb& rgb, double alpha = 1.0) {
    cairo_set_source_rgba(c_, rgb.r, rgb.g, rgb.b, alpha);
  }
  void font(double size, bool bold = false) {
    cairo_select_font_face(c_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c_, size);
  }
  double width(const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(c_, text.c_str(), &extents);
    return extents.x_advance;
  }
  /// align: 0 left, 0.5 centred, 1 right.
  void text(double x, double y, const std::string& what, double align = 0.0) {
    cairo_move_to(c_, x - align * width(what), y);
    cairo_show_text(c_, what.c_str());
  }
  void line(double x0, double y0, double x1, double y1) {
    cairo_move_to(c_, x0, y0);
    cairo_line_to(c_, x1, y1);
    cairo_stroke(c_);
  }

  void titles() {
    color({0.1, 0.1, 0.12});
    font(18.0, true);
    text(kLeft, 28.0, chart_.title);
    font(13.0);
    color({0.35, 0.35, 0.4});
    text(kLeft, 49.0, chart_.subtitle);
    text(kLeft + 0.5 * (kWidth - kLeft - kRight), kHeight - 16.0, chart_.xTitle, 0.5);
    cairo_save(c_);
    cairo_translate(c_, 20.0, kTop + 0.5 * (kHeight - kTop - kBottom));
    cairo_rotate(c_, -0.5 * M_PI);
    text(0.0, 0.0, chart_.yTitle, 0.5);
    cairo_restore(c_);
  }

  void axes() {
    cairo_set_line_width(c_, 1.0);
    font(12.0);
    for (const double tick : y_.ticks()) {
      color({0.88, 0.88, 0.9});
      line(kLeft, py(tick), kWidth - kRight, py(tick));
      color({0.35, 0.35, 0.4});
      text(kLeft - 8.0, py(tick) + 4.0, tickText(tick), 1.0);
    }
    if (chart_.xLabels.empty()) {
      for (const double tick : x_.ticks()) {
        color({0.88, 0.88, 0.9});
        line(px(tick), kTop, px(tick), kHeight - kBottom);
        color({0.35, 0.35, 0.4});
        text(px(tick), kHeight - kBottom + 18.0, tickText(tick), 0.5);
      }
    }
    color({0.35, 0.35, 0.4});
    for (size_t i = 0; i < chart_.xLabels.size(); ++i)
      text(px(static_cast<double>(i)), kHeight - kBottom + 18.0, chart_.xLabels[i], 0.5);
    color({0.55, 0.55, 0.6});
    line(kLeft, kHeight - kBottom, kWidth - kRight, kHeight - kBottom);
  }

  void front() {
    color({0.1, 0.1, 0.12}, 0.45);
    cairo_set_line_width(c_, 1.5);
    const double dashes[] = {5.0, 4.0};
    cairo_set_dash(c_, dashes, 2, 0.0);
    for (size_t i = 0; i < chart_.front.size(); ++i) {
      const ChartPoint& p = chart_.points[chart_.front[i]];
      if (i == 0) {
        cairo_move_to(c_, px(p.x), py(p.y));
      } else {  // Between two points nothing is measured: a step, as no setting lies below it.
        const ChartPoint& before = chart_.points[chart_.front[i - 1]];
        cairo_line_to(c_, px(p.x), py(before.y));
        cairo_line_to(c_, px(p.x), py(p.y));
      }
    }
    cairo_stroke(c_);
    cairo_set_dash(c_, nullptr, 0, 0.0);
  }

  void dot(const ChartPoint& p, double radius) {
    if (!(p.x > 0.0 || !x_.logarithmic) || !(p.y > 0.0)) return;
    color(rgbOf(colorOf(p.family)));
    cairo_arc(c_, px(p.x), py(p.y), radius, 0.0, 2.0 * M_PI);
    cairo_fill(c_);
  }

  // Each label beside its point, where it covers least of what is drawn already.
  void labels() {
    font(12.0);
    std::vector<Box> taken;
    for (const ChartPoint& p : chart_.points)
      taken.push_back({px(p.x) - 6.0, py(p.y) - 6.0, px(p.x) + 6.0, py(p.y) + 6.0});
    for (const ChartPoint& p : chart_.points) {
      if (p.label.empty() || !(p.x > 0.0) || !(p.y > 0.0)) continue;
      const double w = width(p.label), x = px(p.x), y = py(p.y);
      Box best = {};
      double least = 1e300;
      for (const double rise : {4.0, -8.0, 18.0, -20.0, 32.0}) {
        for (const double left : {x + 9.0, x - 9.0 - w, x - 0.5 * w}) {
          const Box box = {left, y + rise - 11.0, left + w, y + rise + 3.0};
          double cost = box.x1 > kWidth - 4.0 || box.x0 < kLeft ? 1e4 : 0.0;
          if (box.y0 < kTop || box.y1 > kHeight - kBottom) cost += 1e4;
          cost += 0.5 * std::abs(rise - 4.0) + (left > x ? 0.0 : 2.0);
          for (const Box& other : taken) cost += 10.0 * box.overlap(other);
          if (cost < least) {
            least = cost;
            best = box;
          }
        }
      }
      taken.push_back(best);
      color({1.0, 1.0, 1.0});
      cairo_rectangle(c_, best.x0 - 1.0, best.y0 + 1.0, best.x1 - best.x0 + 2.0, best.y1 - best.y0);
      cairo_fill(c_);
      color(rgbOf(colorOf(p.family)));
      text(best.x0, best.y1 - 3.0, p.label);
    }
  }

  void curve(const ChartLine& curve) {
    color(rgbOf(colorOf(curve.family)));
    cairo_set_line_width(c_, 2.0);
    bool begun = false;
    for (const ChartPoint& p : curve.points) {
      if (!(p.y > 0.0)) continue;
      if (begun) cairo_line_to(c_, px(p.x), py(p.y));
      if (!begun) cairo_move_to(c_, px(p.x), py(p.y));
      begun = true;
    }
    cairo_stroke(c_);
    for (const ChartPoint& p : curve.points) dot(p, 3.5);
  }

  /// At the top, left or right: where it hides fewer points.
  void legend() {
    font(12.0);
    double y = kTop + 12.0;
    double widest = 0.0;
    for (const ChartLine& line : chart_.lines) widest = std::max(widest, width(line.name));
    const double high = 18.0 * static_cast<double>(chart_.lines.size()) + 8.0;
    const auto hidden = [&](double left) {
      size_t count = 0;
      for (const ChartLine& line : chart_.lines)
        for (const ChartPoint& p : line.points)
          if (p.y > 0.0 && px(p.x) > left - 20.0 && px(p.x) < left + widest + 64.0 &&
              py(p.y) < y + high)
            ++count;
      return count;
    };
    const double left = kLeft + 6.0, right = kWidth - kRight - widest - 50.0;
    const double x = (hidden(right) < hidden(left) ? right : left) + 8.0;
    color({1.0, 1.0, 1.0}, 0.85);
    cairo_rectangle(c_, x - 8.0, y - 14.0, widest + 44.0, high);
    cairo_fill(c_);
    for (const ChartLine& entry : chart_.lines) {
      color(rgbOf(colorOf(entry.family)));
      cairo_set_line_width(c_, 2.5);
      line(x, y - 4.0, x + 22.0, y - 4.0);
      text(x + 28.0, y, entry.name);
      y += 18.0;
    }
  }

  cairo_t* c_;
  const Chart& chart_;
  Axis x_, y_;
};

cairo_status_t append(void* to, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

ChartPoint pointOf(const Row& row, uint32_t band, bool bake) {
  const double x = bake ? row.bake_s.median : row.groundFrame_ms();
  return {x, 100.0 * row.errors[band].p95, row.name, row.family};
}

bool inScatter(const Row& row) {
  return row.measured() && (row.sweep == "model" || row.sweep == "quality");
}

Chart scatter(const Report& report, uint32_t band, bool bake) {
  Chart chart;
  const std::string name = kBandNames[band];
  chart.file = (bake ? "error_bake_" : "error_frame_") + name;
  chart.title = std::string("Error against ") + (bake ? "bake time" : "frame time") + ", " + name;
  chart.subtitle = "Towards the lower left is better; no setting lies below the dashed front.";
  chart.xTitle = bake ? "bake, seconds (" + report.clock + ")"
                      : "frame of 640 x 360 from the ground, ms (" + report.clock + ")";
  chart.yTitle = "error of total radiance, 95th percentile, %";
  std::vector<double> xs, ys;
  for (const Row& row : report.rows) {
    if (!inScatter(row)) continue;
    // The same tables under two names.
    if (row.sweep == "quality" &&
        (row.name == "medium" || (bake && row.name.find(',') != std::string::npos)))
      continue;
    const ChartPoint point = pointOf(row, band, bake);
    if (!(point.x > 0.0) || !(point.y > 0.0)) continue;
    chart.points.push_back(point);
    xs.push_back(point.x);
    ys.push_back(point.y);
  }
  chart.front = paretoFront(xs, ys);
  return chart;
}

Chart byBand(const Report& report) {
  Chart chart;
  chart.file = "error_by_sun";
  chart.title = "Error by the sun's elevation";
  chart.subtitle = "95th percentile of rays from the ground to space, each model at its default.";
  chart.xTitle = "band of the sun's elevation";
  chart.yTitle = "error of total radiance, %";
  chart.xLabels = {"day >= 10", "low 0..10", "civil -6..0", "nautical -12..-6",
                   "astronomical -18..-12"};
  std::map<std::string, bool> seen;
  for (const Row& row : report.rows) {
    if (row.sweep != "model" || !row.measured() || seen[row.family]) continue;
    seen[row.family] = true;
    ChartLine line{row.name, row.family, {}};
    for (uint32_t band = 0; band < kBandCount; ++band)
      line.points.push_back(
          {static_cast<double>(band), 100.0 * row.errors[band].p95, "", row.family});
    chart.lines.push_back(line);
  }
  return chart;
}

Chart byOrder(const Report& report) {
  Chart chart;
  chart.file = "error_by_order";
  chart.title = "Error by scattering order";
  chart.subtitle = "Paths of at most N events; the last point has all orders.";
  chart.xTitle = "orders";
  chart.yTitle = "error of total radiance, 95th percentile, %";
  std::vector<std::string> names;
  for (const char* family : {"moments", "standard"}) {
    for (const uint32_t band : {0u, 2u}) {
      ChartLine line{std::string(family) + ", " + kBandNames[band],
                     band == 0 ? family : std::string(family) + " twilight",
                     {}};
      for (const Row& row : report.rows) {
        if (row.sweep != "orders" || row.family != family || !row.measured()) continue;
        const std::string order = row.name.substr(row.name.rfind(' ') + 1);
        if (std::ranges::find(names, order) == names.end()) names.push_back(order);
        const auto x = std::ranges::find(names, order) - names.begin();
        line.points.push_back(
            {static_cast<double>(x), 100.0 * row.errors[band].p95, "", line.family});
      }
      if (!line.points.empty()) chart.lines.push_back(line);
    }
  }
  chart.xLabels = names;
  return chart;
}

}  // namespace

std::string colorOf(const std::string& family) {
  static const std::map<std::string, std::string> kColors = {
      {"moments", "#0b6e99"},           {"moments twilight", "#6db7d6"}, {"standard", "#d95f02"},
      {"standard twilight", "#f0a868"}, {"hillaire", "#7b3294"},         {"oneil", "#1b7a3d"},
      {"schafhitzel", "#8c6d1f"},       {"hoffman-preetham", "#777777"}, {"single", "#c2185b"}};
  const auto found = kColors.find(family);
  return found == kColors.end() ? "#333333" : found->second;
}

std::vector<Chart> chartsOf(const Report& report) {
  std::vector<Chart> charts = {scatter(report, 0, false),
                               scatter(report, 2, false),
                               scatter(report, 0, true),
                               scatter(report, 2, true),
                               byBand(report),
                               byOrder(report)};
  std::erase_if(charts, [](const Chart& c) { return c.points.empty() && c.lines.empty(); });
  return charts;
}

std::string drawChart(const Chart& chart, bool vector) {
  std::string file;
  constexpr double kScale = 2.0;  // of the PNG
  cairo_surface_t* surface =
      vector ? cairo_svg_surface_create_for_stream(append, &file, kWidth, kHeight)
             : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(kScale * kWidth),
                                          static_cast<int>(kScale * kHeight));
  cairo_t* cairo = cairo_create(surface);
  if (!vector) cairo_scale(cairo, kScale, kScale);
  Canvas(cairo, chart).draw();
  bool good = cairo_status(cairo) == CAIRO_STATUS_SUCCESS;
  cairo_destroy(cairo);
  if (!vector)
    good =
        good && cairo_surface_write_to_png_stream(surface, append, &file) == CAIRO_STATUS_SUCCESS;
  cairo_surface_finish(surface);
  good = good && cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS;
  cairo_surface_destroy(surface);
  return good ? file : std::string();
}

}  // namespace alpenglow::cost
