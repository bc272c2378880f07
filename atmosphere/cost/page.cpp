#include "atmosphere/cost/page.h"

#include <algorithm>
#include <cstdio>

#include "atmosphere/cost/charts.h"

namespace alpenglow::cost {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string format(const char* how, double value) {
  char text[48];
  std::snprintf(text, sizeof text, how, value);
  return text;
}

std::string percent(double share) {
  return format(share < 0.0995 ? "%.2f" : "%.1f", 100.0 * share);
}

constexpr const char* kStyle = R"(<style>
:root { color-scheme: light dark; --ink: #1c1d22; --soft: #5c5f6a; --paper: #fff; --line: #dcdde3; --tint: #f4f5f8; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8e9ee; --soft: #a2a5b2; --paper: #17181c; --line: #33353d; --tint: #202228; } }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper); max-width: 1080px; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: .2rem; } h2 { margin-top: 2.2rem; font-size: 1.25rem; }
p.meta { color: var(--soft); font-size: .85rem; margin-top: 0; }
.result { background: var(--tint); border-left: 4px solid #0b6e99; padding: .6rem 1rem; }
.result li { margin: .2rem 0; }
img { max-width: 100%; height: auto; display: block; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(420px, 1fr)); gap: 1rem; }
.charts img { background: #fff; border: 1px solid var(--line); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .82rem; } th, td { padding: .25rem .55rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; }
th { color: var(--soft); font-weight: 600; } td:first-child, th:first-child { text-align: left; }
td small { color: var(--soft); white-space: normal; }
tr.sweep td { font-weight: 600; text-align: left; padding-top: 1rem; }
.pictures td { text-align: center; white-space: normal; border: 0; padding: .2rem; font-size: .8rem; } .pictures img { width: 150px; }
</style>
)";

std::string timeCell(const Timing& t, const char* how) {
  if (t.runs == 0) return "<td></td>";
  const std::string spread =
      t.runs < 2 ? "once" : format(how, t.least) + " to " + format(how, t.most);
  return "<td title=\"" + std::to_string(t.runs) + " runs\">" + format(how, t.median) + " <small>" +
         spread + "</small></td>";
}

/// Of the ground views: their mean, and the widest spread of one of them.
std::string frameCell(const Row& row) {
  if (row.groundFrame_ms() <= 0.0) return timeCell(row.frame_ms[0], "%.1f");
  double spread = 0.0;
  for (uint32_t i = 0; i < kGroundViews; ++i) {
    const Timing& t = row.frame_ms[i];
    spread = std::max(spread, (t.most - t.least) / std::max(t.median, 1e-9));
  }
  return "<td>" + format("%.1f", row.groundFrame_ms()) + " <small>&plusmn;" +
         format("%.0f", 50.0 * spread) + " %</small></td>";
}

std::string errorCell(const BandError& error) {
  if (error.rays == 0) return "<td></td>";
  return "<td title=\"" + std::to_string(error.rays) + " rays\">" + percent(error.p95) +
         " <small>" + percent(error.most) + "</small></td>";
}

std::string rowOf(const Row& row) {
  std::string html = "<tr><td>" + escaped(row.name) + " <small>" + escaped(row.detail);
  if (!row.note.empty()) html += " (" + escaped(row.note) + ")";
  html += "</small></td>";
  html += timeCell(row.bake_s, "%.2f") + frameCell(row);
  html += timeCell(row.frame_ms[kGroundViews + 1], "%.1f");
  html += row.bytes == 0 ? "<td></td>"
                         : "<td>" + format("%.2f", 1e-6 * double(row.bytes)) + " <small>" +
                               format("%.0f", 1e-6 * double(row.peakBytes)) + "</small></td>";
  for (const BandError& error : row.errors) html += errorCell(error);
  return html + "</tr>\n";
}

std::string tableOf(const Report& report) {
  std::string html =
      "<div class=\"scroll\"><table><tr><th>setting</th><th>bake s</th><th>frame ms, "
      "ground</th><th>frame ms, space</th><th>MB <small>peak</small></th>";
  for (const char* band : kBandNames) html += "<th>" + std::string(band) + " %</th>";
  html += "</tr>\n";
  std::string sweep;
  for (const Row& row : report.rows) {
    if (row.sweep != sweep)
      html += "<tr class=\"sweep\"><td colspan=\"10\">" + escaped(row.sweep) + "</td></tr>\n";
    sweep = row.sweep;
    html += rowOf(row);
  }
  return html + "</table></div>\n";
}

std::string picturesOf(const Report& report) {
  std::vector<std::string> scenes, models;
  const auto add = [](std::vector<std::string>* to, const std::string& name) {
    if (std::ranges::find(*to, name) == to->end()) to->push_back(name);
  };
  for (const Comparison& c : report.comparisons) {
    add(&scenes, c.scene);
    add(&models, c.model);
  }
  if (models.empty()) return "<p>None could be drawn.</p>\n";
  std::string html = "<div class=\"scroll\"><table class=\"pictures\">\n<tr><td></td>";
  for (const std::string& model : models) html += "<td>" + escaped(model) + "</td>";
  html += "</tr>\n";
  for (const std::string& scene : scenes) {
    for (const bool difference : {false, true}) {
      html += "<tr><td>" + (difference ? "difference" : escaped(scene)) + "</td>";
      for (const std::string& model : models) {
        html += "<td>";
        for (const Comparison& c : report.comparisons) {
          if (c.scene != scene || c.model != model) continue;
          const std::string file = pictureStem(c) + (difference ? "_difference.png" : ".png");
          html += "<a href=\"" + file + "\"><img src=\"" + file + "\" alt=\"" + escaped(scene) +
                  " by " + escaped(model) + "\"></a>";
        }
        html += "</td>";
      }
      html += "</tr>\n";
    }
  }
  return html + "</table></div>\n";
}

bool isRival(const Row& row) {
  return row.sweep == "model" && row.measured() && row.groundFrame_ms() > 0.0 &&
         (row.family == "hillaire" || row.family == "oneil" || row.family == "standard");
}

std::string resultOf(const Report& report) {
  const std::vector<Exception> exceptions = exceptionsOf(report);
  const auto rivals = std::ranges::count_if(report.rows, isRival);
  std::string html = "<div class=\"result\"><p>";
  for (const Row& row : report.rows) {
    if (row.sweep != "model" || row.family != "moments" || !row.measured()) continue;
    html += "The default, <b>moments</b> at level medium, is within " + percent(row.errors[0].p95) +
            " % of path-traced light by day and " + percent(row.errors[2].p95) +
            " % in civil twilight (95th percentile), bakes in " +
            format("%.2f", row.bake_s.median) + " s and draws a frame from the ground in " +
            format("%.1f", row.groundFrame_ms()) + " ms (" + escaped(report.clock) + ").";
    break;
  }
  html += "</p><p>Against " + std::to_string(rivals) +
          " settings of hillaire, oneil and standard, in four bands of the sun's elevation each, "
          "the question is whether a setting of moments draws a frame in no more time with no "
          "greater error. Settings called planned leave out what a camera in the atmosphere below "
          "the top "
          "of the atmosphere never shows. ";
  if (rivals == 0) return html + "None was measured.</p></div>\n";
  if (exceptions.empty()) return html + "It does in every case.</p></div>\n";
  html += "It does but for these:</p><ul>\n";
  for (const Exception& e : exceptions) {
    html += "<li>" + escaped(e.name) + ", " + e.band + ": " + percent(e.error) + " % in " +
            format("%.1f", e.frame_ms) + " ms; ";
    html += e.best > 0.0 ? "moments in as much time " + percent(e.best) + " %"
                         : "no setting of moments is as fast";
    html += "</li>\n";
  }
  return html + "</ul></div>\n";
}

}  // namespace

std::vector<Exception> exceptionsOf(const Report& report) {
  std::vector<Exception> result;
  for (const Row& rival : report.rows) {
    if (!isRival(rival)) continue;
    for (uint32_t band = 0; band < 4; ++band) {
      double best = 0.0;
      for (const Row& row : report.rows) {
        const double frame = row.groundFrame_ms();
        const bool asFast = row.family == "moments" && row.measured() && frame > 0.0 &&
                            row.sweep != "domain" && row.sweep != "orders" &&
                            row.sweep != "storage" &&  // rounded tables are no setting of ours
                            frame <= rival.groundFrame_ms();
        if (asFast && row.errors[band].rays > 0 && (best == 0.0 || row.errors[band].p95 < best))
          best = row.errors[band].p95;
      }
      const double error = rival.errors[band].p95;
      if (best > 0.0 && best <= error) continue;
      result.push_back({rival.name, kBandNames[band], error, rival.groundFrame_ms(), best});
    }
  }
  return result;
}

std::string pageOf(const Report& report) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>Alpenglow: what accuracy costs</title>\n";
  html += kStyle;
  html += "</head><body>\n<h1>What accuracy costs</h1>\n<p class=\"meta\">";
  html += escaped(report.device) + ", " + escaped(report.driver) + ", Vulkan " + report.vulkan +
          "; " + escaped(report.machine) + "; Alpenglow " + report.library + "; " + report.date +
          "; <code>" + escaped(report.command) + "</code>" + (report.quick ? ", quick" : "") +
          ", " + format("%.1f", report.seconds / 60.0) + " minutes. Times are " +
          escaped(report.clock) + ".</p>\n";
  html += resultOf(report);
  html += "<h2>Charts</h2>\n<div class=\"charts\">\n";
  for (const Chart& chart : chartsOf(report)) {
    html += "<a href=\"" + chart.file + ".svg\"><img src=\"" + chart.file + ".svg\" alt=\"" +
            escaped(chart.title) + "\"></a>\n";
  }
  html +=
      "</div>\n<h2>Side by side</h2>\n<p>One exposure a scene. Differences of luminance from "
      "the finest: red where brighter, blue where darker, full at a factor of two.</p>\n";
  html += picturesOf(report);
  html +=
      "<h2>Everything</h2>\n<p>Errors are of total radiance against path tracing, 95th percentile "
      "and, small, the greatest; by the sun's elevation: day from 10&deg;, low from 0&deg;, civil "
      "from &minus;6&deg;, nautical from &minus;12&deg;, astronomical from &minus;18&deg;. Each "
      "ray "
      "is drawn as a pixel, from a sky-view LUT where the setting has one. Frames are of 640 x 360 "
      "pixels; from the ground the mean of four sun elevations. Medians, and small the spread. "
      "<a href=\"cost.csv\">cost.csv</a> has all figures.</p>\n";
  return html + tableOf(report) + "</body></html>\n";
}

}  // namespace alpenglow::cost
