#include "atmosphere/cost/truth.h"

#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/probe_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace alpenglow::truth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr const char* kAtmosphereSuffix = ".atmosphere.json";

std::string fileOf(const std::string& folder, const std::string& name, const char* suffix) {
  return folder + "/" + name + suffix;
}

/// The set's irradiance query on the ground under a sun; null if it has none.
const TruthQuery* groundLight(const std::vector<TruthQuery>& queries, double sunElevation) {
  for (const TruthQuery& q : queries) {
    const bool onGround = q.query.kind == QueryKind::Irradiance && q.query.altitude_m == 0.0;
    if (onGround && std::abs(q.sunElevation - sunElevation) < 1e-5) return &q;
  }
  return nullptr;
}

double worst(const Spectrum& value, const Spectrum& reference, const Spectrum& irradiance) {
  double most = 0.0;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    const double error = relativeError(value[i], reference[i], irradiance[i]);
    if (std::isnan(error)) return error;  // The worst of all.
    most = std::max(most, error);
  }
  return most;
}

Spectrum sum(const Spectrum& a, const Spectrum& b) {
  Spectrum result;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) result[i] = a[i] + b[i];
  return result;
}

}  // namespace

const char* bandName(Band band) {
  switch (band) {
    case Band::Day:
      return "day";
    case Band::Low:
      return "low";
    case Band::Civil:
      return "civil";
    case Band::Nautical:
      return "nautical";
    case Band::Astronomical:
      return "astronomical";
    default:
      return "night";
  }
}

Band bandOf(double sunElevation) {
  // Elevations come from files in degrees: 10 degrees may arrive a bit below 10.
  const double degrees = sunElevation / kDegree + 1e-9;
  constexpr double kBounds[] = {10.0, 0.0, -6.0, -12.0, -18.0};
  int band = 0;
  for (double bound : kBounds) {
    if (degrees >= bound) break;
    ++band;
  }
  return static_cast<Band>(band);
}

std::vector<std::string> truthNames(const std::string& folder) {
  const std::vector<std::string> first = {"earth", "earth-fig6", "earth-clear", "earth-hazy",
                                          "mars"};
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string file = entry.path().filename().string();
    const size_t at = file.find(".answers.json");
    if (at != std::string::npos) names.push_back(file.substr(0, at));
  }
  const auto rank = [&first](const std::string& name) {
    return std::find(first.begin(), first.end(), name) - first.begin();
  };
  std::sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return rank(a) != rank(b) ? rank(a) < rank(b) : a < b;
  });
  return names;
}

io::Result<TruthSet> loadTruth(const std::string& folder, const std::string& name) {
  using Set = io::Result<TruthSet>;
  const auto parameters = io::readAtmosphere(fileOf(folder, name, kAtmosphereSuffix));
  if (!parameters) return Set::failure(parameters.error);
  const auto queries = io::readQueries(fileOf(folder, name, ".queries.json"));
  if (!queries) return Set::failure(queries.error);
  const auto answers = io::readAnswers(fileOf(folder, name, ".answers.json"), *queries);
  if (!answers) return Set::failure(answers.error);

  TruthSet set{name, *parameters, {}};
  for (size_t i = 0; i < queries->size(); ++i) {
    TruthQuery q;
    q.id = (*queries)[i].id;
    q.kind = q.id.substr(0, q.id.find('/'));
    q.query = (*queries)[i].query;
    q.sunElevation = bandSunElevation(*parameters, q.query);
    q.band = bandOf(q.sunElevation);
    q.truth = (*answers)[i];
    set.queries.push_back(q);
  }
  for (TruthQuery& q : set.queries) {
    const TruthQuery* light = groundLight(set.queries, q.sunElevation);
    if (light == nullptr) {
      return Set::failure("The truth set '" + name + "' has no ground irradiance for query '" +
                          q.id + "', whose sun stands at " +
                          std::to_string(q.sunElevation / kDegree) + " degrees.");
    }
    q.groundIrradiance = light->truth.value.sky;
  }
  return set;
}

double relativeError(double value, double reference, double groundIrradiance) {
  const double least = std::max(0.02 * groundIrradiance / std::numbers::pi, 1e-9);
  return std::abs(value - reference) / std::max(reference, least);
}

AnswerError errorOf(const TruthQuery& query, const ProbeAnswer& answer) {
  const ProbeAnswer& truth = query.truth.value;
  const Spectrum& e = query.groundIrradiance;
  AnswerError error;
  if (query.query.kind == QueryKind::Irradiance) {
    error.direct = worst(answer.direct, truth.direct, e);
    error.skyIrradiance = worst(answer.sky, truth.sky, e);
    return error;
  }
  error.sky = worst(answer.skyRadiance, truth.skyRadiance, e);
  error.ground = worst(answer.groundRadiance, truth.groundRadiance, e);
  error.total = worst(sum(answer.skyRadiance, answer.groundRadiance),
                      sum(truth.skyRadiance, truth.groundRadiance), e);
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    const double difference = std::abs(answer.transmittance[i] - truth.transmittance[i]);
    const double relative = difference / std::max(truth.transmittance[i], 0.001);
    if (!(relative <= error.transmittance)) error.transmittance = relative;
    if (std::isnan(relative)) break;
  }
  return error;
}

AnswerError truthError(const TruthQuery& query) {
  const ProbeAnswer& value = query.truth.value;
  const ProbeAnswer& error = query.truth.standardError;
  ProbeAnswer off;
  off.transmittance = sum(value.transmittance, error.transmittance);
  off.skyRadiance = sum(value.skyRadiance, error.skyRadiance);
  off.groundRadiance = sum(value.groundRadiance, error.groundRadiance);
  off.direct = sum(value.direct, error.direct);
  off.sky = sum(value.sky, error.sky);
  return errorOf(query, off);
}

double percentile(std::vector<double> values, double p) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double at = std::clamp(p / 100.0, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const size_t below = static_cast<size_t>(at);
  const size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace alpenglow::truth
