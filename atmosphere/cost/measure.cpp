// Goes through the configurations, and compares pictures of the models.
#include <sys/utsname.h>

#include <alpenglow/version.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <numbers>
#include <thread>

#include "atmosphere/cost/bench.h"
#include "atmosphere/cost/configurations.h"
#include "atmosphere/cost/difference.h"
#include "atmosphere/cost/shared_exponent.h"

namespace alpenglow::cost {
namespace {

/// A bake that takes longer is not repeated.
constexpr double kLongBake_s = 10.0;
constexpr VkExtent2D kPicture = {320, 180};

struct Look {
  const char* scene;
  double altitude_m, sun, azimuth, pitch, fov;
};
constexpr Look kViews[kViewCount] = {
    {"ground 40", 2.0, 40.0, 60.0, 10.0, 60.0}, {"ground 3", 2.0, 3.0, 30.0, 10.0, 60.0},
    {"ground -4", 2.0, -4.0, 30.0, 10.0, 60.0}, {"ground -9", 2.0, -9.0, 30.0, 10.0, 60.0},
    {"10 km", 1e4, 20.0, 60.0, -10.0, 60.0},    {"space", 1e6, 20.0, 60.0, -35.0, 60.0}};
constexpr Look kScenes[] = {{"clear noon", 2.0, 60.0, 90.0, 15.0, 75.0},
                            {"sunset", 2.0, 1.0, 10.0, 8.0, 60.0},
                            {"twilight, away from the sun", 2.0, -4.0, 180.0, 10.0, 60.0},
                            {"from 1,000 km", 1e6, 20.0, 60.0, -35.0, 60.0}};

/// Rays of the truth that a picture shows whole.
struct Truth {
  truth::TruthSet set;
  std::vector<const truth::TruthQuery*> queries;
  std::vector<ProbeQuery> rays;
};

Truth wholeRays(const truth::TruthSet& set) {
  Truth truth{set, {}, {}};
  for (const truth::TruthQuery& q : truth.set.queries)
    if (q.query.kind == QueryKind::Ray && !q.query.bounded && q.band != truth::Band::Night)
      truth.queries.push_back(&q);
  // Neighbours share a sky-view LUT.
  std::ranges::stable_sort(truth.queries, [](const auto* a, const auto* b) {
    return std::pair(a->query.altitude_m, a->query.sunZenith) <
           std::pair(b->query.altitude_m, b->query.sunZenith);
  });
  for (const truth::TruthQuery* q : truth.queries) truth.rays.push_back(q->query);
  return truth;
}

std::array<BandError, kBandCount> errorsOf(const Truth& truth, const std::vector<Spectrum>& light) {
  std::vector<double> errors[kBandCount];
  for (size_t i = 0; i < light.size(); ++i) {
    ProbeAnswer answer;
    answer.skyRadiance = light[i];
    errors[static_cast<size_t>(truth.queries[i]->band)].push_back(
        truth::errorOf(*truth.queries[i], answer).total);
  }
  std::array<BandError, kBandCount> result;
  for (uint32_t band = 0; band < kBandCount; ++band)
    result[band] = {truth::percentile(errors[band], 95), truth::percentile(errors[band], 100),
                    static_cast<uint32_t>(errors[band].size())};
  return result;
}

class Sweep {
 public:
  Sweep(const Options& options, Truth all, Truth evening)
      : options_(options),
        all_(std::move(all)),
        evening_(std::move(evening)),
        bench_(options.device,
               // Timed frames and pictures both fit in.
               {std::max(options.width, kPicture.width), std::max(options.height, kPicture.height)},
               options.validation) {}

  /// A failure of one setting becomes its row's note; the others go on. `pictured`: its pictures
  /// are kept for compare.
  Row measure(const Configuration& configuration, bool pictured);
  /// Pictures of the models that were measured, against the finest of the moment solver.
  std::vector<Comparison> compare();
  Bench& bench() { return bench_; }

 private:
  TablesPointer bakeTimed(const Configuration& configuration, Row* row);
  TablesPointer rounded(Tables* tables, const Configuration& configuration);
  void timeFrames(View* view, const Configuration& configuration, Row* row);
  void fill(const Configuration& configuration, bool pictured, Row* row);
  std::vector<io::LinearImage> pictures(View* view);
  std::vector<io::LinearImage> finestPictures();

  const Options& options_;
  Truth all_, evening_;
  Bench bench_;
  struct Pictured {
    std::string model;
    std::vector<io::LinearImage> images;  ///< One for each of kScenes.
  };
  std::vector<Pictured> pictured_;
};

TablesPointer Sweep::bakeTimed(const Configuration& configuration, Row* row) {
  const Parameters& parameters = all_.set.parameters;
  double seconds = 0.0;
  // The first run compiles the shaders; the buffers of its frame are freed before the next.
  TablesPointer tables = bench_.bake(parameters, configuration.desc, &seconds);
  if (tables == nullptr) {
    row->note = bench_.refusal();
    return tables;
  }
  std::vector<double> times;
  const bool once = seconds > kLongBake_s;
  if (once) {
    times.push_back(seconds);
    row->note = "baked once, shaders compiled in it";
  }
  for (int i = 0; i < (once ? 0 : options_.quick ? 1 : 3); ++i) {
    tables.reset();
    bench_.resources();
    tables = bench_.bake(parameters, configuration.desc, &seconds);
    times.push_back(seconds);
  }
  row->bake_s = timingOf(times);
  return tables;
}

// With the table of sources rounded, which is the one that is stored in half floats.
TablesPointer Sweep::rounded(Tables* tables, const Configuration& configuration) {
  ImageInfo info;
  std::vector<float> rgba = bench_.readTable(tables, kTableSource, &info);
  for (size_t i = 0; i < rgba.size(); i += 4) {
    float rgb[3];
    unpackSharedExponent(packSharedExponent(&rgba[i]), rgb);
    std::copy_n(rgb, 3, &rgba[i]);
  }
  TableDesc desc = configuration.desc;
  desc.format = TableFormat::Float;  // so that nothing is rounded twice
  return bench_.withSource(all_.set.parameters, desc, tables, rgba);
}

void Sweep::timeFrames(View* view, const Configuration& configuration, Row* row) {
  const bool groundOnly = configuration.onlySun_deg != 0.0 ||
                          !hasEffect(configuration.viewDisabledEffects, Effect::SpaceViews);
  for (uint32_t i = 0; i < kViewCount; ++i) {
    const Look& look = kViews[i];
    if (look.altitude_m > 6e4 && groundOnly) continue;
    const double sun = configuration.onlySun_deg != 0.0 ? configuration.onlySun_deg : look.sun;
    const FrameDesc draw = drawOfView(all_.set.parameters, look.altitude_m, sun, look.azimuth,
                                      look.pitch, look.fov, {options_.width, options_.height});
    std::vector<double> times;
    bench_.frame(view, draw);
    double budget_s = options_.quick ? 0.6 : 2.0;
    for (int k = 0; k < (options_.quick ? 3 : 7) && (k < 2 || budget_s > 0.0); ++k) {
      times.push_back(1e3 * bench_.frame(view, draw));
      budget_s -= 1e-3 * times.back();
    }
    row->frame_ms[i] = timingOf(times);
  }
}

Row Sweep::measure(const Configuration& configuration, bool pictured) {
  Row empty;
  empty.sweep = configuration.sweep;
  empty.name = configuration.name;
  empty.family = configuration.family;
  empty.detail = configuration.detail;
  try {
    Row row = empty;
    fill(configuration, pictured, &row);
    return row;
  } catch (const Failure& failure) {
    empty.note = failure.what();
    return empty;
  }
}

void Sweep::fill(const Configuration& configuration, bool pictured, Row* filled) {
  Row& row = *filled;
  bench_.renew();
  const Truth& truth = configuration.onlySun_deg != 0.0 ? evening_ : all_;
  TablesPointer tables = bakeTimed(configuration, &row);
  if (tables == nullptr) return;
  if (const char* limit = modelLimit(configuration.desc.solver); *limit != '\0') {
    row.note += (row.note.empty() ? "" : "; ") + std::string(limit);
  }
  if (configuration.storage == Storage::SharedExponent) {
    tables = rounded(tables.get(), configuration);
    row.note = "its cost is that of 32-bit floats";
  }
  Drawn drawn{tables.get(), configuration.desc, configuration.fromLut, 0};
  {
    // Rays from everywhere, so with all that a view can draw; frames as configured.
    const ViewPointer view = bench_.view(drawn);
    row.errors = errorsOf(truth, bench_.radiance(view.get(), truth.set.parameters, truth.rays));
    // Limited tables are undefined for other sun elevations.
    for (uint32_t band = configuration.bands; band < kBandCount; ++band) row.errors[band] = {};
    if (pictured) pictured_.push_back({configuration.name, pictures(view.get())});
  }
  drawn.viewDisabledEffects = configuration.viewDisabledEffects;
  const ViewPointer view = bench_.view(drawn);
  timeFrames(view.get(), configuration, &row);
  // Whatever was needed once has been freed with its frame.
  row.bytes = bench_.resources().bytes;
  row.peakBytes = bench_.resources().peakBytes;
}

std::vector<io::LinearImage> Sweep::pictures(View* view) {
  std::vector<io::LinearImage> result;
  for (const Look& look : kScenes) {
    FrameDesc draw = drawOfView(all_.set.parameters, look.altitude_m, look.sun, look.azimuth,
                                look.pitch, look.fov, kPicture);
    draw.lights[0].discRadius = 0.2667 * std::numbers::pi / 180.0;
    bench_.frame(view, draw);
    result.push_back(bench_.read(kPicture));
  }
  return result;
}

std::vector<io::LinearImage> Sweep::finestPictures() {
  bench_.renew();
  TableDesc desc;
  desc.quality = options_.quick ? Quality::Medium : Quality::High;
  double seconds = 0.0;
  const TablesPointer tables = bench_.bake(all_.set.parameters, desc, &seconds);
  if (tables == nullptr) throw Failure(bench_.refusal());
  const Drawn drawn{tables.get(), desc, false, 0};
  const ViewPointer view = bench_.view(drawn);
  return pictures(view.get());
}

std::vector<Comparison> Sweep::compare() {
  std::vector<Comparison> result;
  if (pictured_.empty()) return result;
  std::vector<io::LinearImage> finest;
  try {
    finest = finestPictures();
  } catch (const Failure&) {
    return result;  // The figures remain; the page reports that there are no pictures.
  }
  for (const Pictured& pictured : pictured_) {
    for (size_t i = 0; i < finest.size(); ++i) {
      const io::LinearImage& image = pictured.images[i];
      result.push_back(
          {kScenes[i].scene, pictured.model,
           io::toneMapped(image, io::automaticExposure(finest[i]), io::ToneMap::Filmic),
           differenceOf(image, finest[i])});
    }
  }
  return result;
}

std::string today() {
  char text[32];
  const std::time_t now = std::time(nullptr);
  std::tm broken = {};
  gmtime_r(&now, &broken);
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &broken);
  return text;
}

std::string machine() {
  std::string model = "unknown processor", line;
  std::ifstream info("/proc/cpuinfo");
  while (std::getline(info, line)) {
    if (line.rfind("model name", 0) != 0) continue;
    model = line.substr(line.find(':') + 2);
    break;
  }
  utsname system = {};
  uname(&system);
  return std::to_string(std::thread::hardware_concurrency()) + " x " + model + ", " +
         system.sysname + " " + system.release;
}

/// What the pictures compare: the first of each family of the sweep of models.
bool isPictured(const std::vector<Configuration>& list, size_t i) {
  const auto first = std::ranges::find_if(list, [&](const Configuration& c) {
    return c.sweep == "model" && c.family == list[i].family;
  });
  return first == list.begin() + static_cast<ptrdiff_t>(i);
}

Report measureAll(const Options& options, Truth all, Truth evening) {
  const auto start = std::chrono::steady_clock::now();
  Report report;
  Sweep sweep(options, std::move(all), std::move(evening));
  std::vector<Configuration> list = configurations(options.quick);
  if (options.only)
    std::erase_if(list, [&](const auto& c) { return !options.only(c.sweep + "/" + c.name); });
  const double steps = static_cast<double>(list.size() + 2);
  for (size_t i = 0; i < list.size(); ++i) {
    if (options.progress)
      options.progress(static_cast<double>(i) / steps, list[i].sweep + ": " + list[i].name);
    report.rows.push_back(sweep.measure(list[i], isPictured(list, i)));
  }
  if (options.progress) options.progress((steps - 2.0) / steps, "pictures");
  report.comparisons = sweep.compare();
  if (options.progress) options.progress((steps - 1.0) / steps, "light shafts");
  if (options.more) {
    auto more = options.more();
    if (!more) throw Failure(more.error);
    report.rows.insert(report.rows.end(), more->begin(), more->end());
  }
  if (!list.empty() && std::ranges::none_of(report.rows, &Row::measured))
    throw Failure(report.rows.front().note);
  Bench& bench = sweep.bench();
  bench.checkValidation();
  report.device = bench.device().name();
  report.driver = bench.driver();
  report.vulkan = bench.vulkan();
  report.clock = bench.software() ? "user CPU of all threads" : "GPU timestamps";
  report.library = ALPENGLOW_VERSION_STRING;
  report.date = today();
  report.machine = machine();
  report.command = options.command;
  report.quick = options.quick;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace

io::Result<Report> measure(const Options& options) {
  const auto all = truth::loadTruth(options.truthFolder, "earth");
  if (!all) return io::Result<Report>::failure(all.error);
  const auto evening = truth::loadTruth(options.truthFolder, "evening");
  if (!evening) return io::Result<Report>::failure(evening.error);
  try {
    return measureAll(options, wholeRays(*all), wholeRays(*evening));
  } catch (const Failure& failure) {
    return io::Result<Report>::failure(failure.what());
  }
}

}  // namespace alpenglow::cost
