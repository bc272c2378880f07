#include <alpenglow/io/file.h>
#include <alpenglow/io/probe_file.h>

#include <cmath>
#include <limits>
#include <set>

#include "atmosphere/io/json.h"

namespace alpenglow::io {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMaxAltitude_m = 1e12;  // As recordProbe has it.

// Reduced first, so that a large angle keeps its precision.
double azimuthRadians(double degrees) { return radians(std::remainder(degrees, 360.0)); }

ProbeQuery irradianceQuery(JsonErrors* errors, const Json& value, const std::string& suffix) {
  ObjectReader reader(errors, value, "", suffix, {"id", "kind", "altitude_m", "sun_zenith_deg"});
  reader.choice("kind", {"irradiance"});
  ProbeQuery query;
  query.kind = QueryKind::Irradiance;
  query.altitude_m = reader.number("altitude_m", 0.0, kMaxAltitude_m);
  query.sunZenith = radians(reader.number("sun_zenith_deg", 0.0, 180.0));
  return query;
}

ProbeQuery rayQuery(JsonErrors* errors, const Json& value, const std::string& suffix) {
  ObjectReader reader(errors, value, "", suffix,
                      {"id", "kind", "altitude_m", "view_zenith_deg", "sun_zenith_deg",
                       "azimuth_deg", "distance_m"});
  ProbeQuery query;
  query.altitude_m = reader.number("altitude_m", 0.0, kMaxAltitude_m);
  query.zenith = radians(reader.number("view_zenith_deg", 0.0, 180.0));
  query.sunZenith = radians(reader.number("sun_zenith_deg", 0.0, 180.0));
  query.azimuth = azimuthRadians(reader.number("azimuth_deg"));
  query.bounded = reader.given("distance_m");
  if (query.bounded) query.distance_m = reader.number("distance_m", 0.0, kInfinity);
  return query;
}

NamedQuery queryFromJson(JsonErrors* errors, const Json& value, size_t index,
                         std::set<std::string>* ids) {
  NamedQuery named;
  const std::string place = " of query number " + std::to_string(index + 1);
  if (!value.is_object() || !value.contains("id") || !isText(value["id"])) {
    ObjectReader reader(errors, value, "", place,
                        {"id", "kind", "altitude_m", "view_zenith_deg", "sun_zenith_deg",
                         "azimuth_deg", "distance_m"});
    if (errors->ok()) reader.string("id");
    return named;
  }
  named.id = value["id"].get<std::string>();
  const std::string suffix = " of query '" + named.id + "'";
  if (!ids->insert(named.id).second) {
    errors->add("field 'id'" + suffix + " stands for a second query; each needs its own.");
  }
  const bool irradiance = value.contains("kind");
  named.query =
      irradiance ? irradianceQuery(errors, value, suffix) : rayQuery(errors, value, suffix);
  return named;
}

OrderedJson spectrumJson(JsonErrors* errors, const Spectrum& spectrum, const std::string& field) {
  OrderedJson array = OrderedJson::array();
  for (const double value : spectrum.value) {
    if (!std::isfinite(value)) {
      errors->add("field '" + field + "' of an answer would be " + showNumber(value) +
                  "; only finite numbers are written.");
    }
    array.push_back(value);
  }
  return array;
}

// The fields of one answer after `id` and `hits_ground`; the standard error has the same.
void addValues(JsonErrors* errors, const ProbeQuery& query, const ProbeAnswer& answer,
               OrderedJson* out) {
  OrderedJson& json = *out;
  if (query.kind == QueryKind::Irradiance) {
    json["direct"] = spectrumJson(errors, answer.direct, "direct");
    json["sky"] = spectrumJson(errors, answer.sky, "sky");
    return;
  }
  json["transmittance"] = spectrumJson(errors, answer.transmittance, "transmittance");
  json["sky_radiance"] = spectrumJson(errors, answer.skyRadiance, "sky_radiance");
  json["ground_radiance"] = spectrumJson(errors, answer.groundRadiance, "ground_radiance");
}

const ProbeAnswer& valueOf(const ProbeAnswer& answer) { return answer; }
const ProbeAnswer& valueOf(const ReferenceAnswer& answer) { return answer.value; }
const ProbeAnswer* errorOf(const ProbeAnswer&) { return nullptr; }
const ProbeAnswer* errorOf(const ReferenceAnswer& answer) { return &answer.standardError; }

void readRadiances(ObjectReader* reader, ProbeAnswer* out) {
  out->transmittance = reader->spectrum("transmittance");
  out->skyRadiance = reader->spectrum("sky_radiance");
  out->groundRadiance = reader->spectrum("ground_radiance");
}

void readIrradiances(ObjectReader* reader, ProbeAnswer* out) {
  out->direct = reader->spectrum("direct");
  out->sky = reader->spectrum("sky");
}

ReferenceAnswer irradianceAnswer(JsonErrors* errors, const Json& value, const std::string& suffix) {
  ReferenceAnswer answer;
  ObjectReader reader(errors, value, "", suffix, {"id", "direct", "sky", "standard_error"});
  readIrradiances(&reader, &answer.value);
  if (errors->ok() && reader.given("standard_error")) {
    ObjectReader error(errors, value["standard_error"], "standard_error.", suffix,
                       {"direct", "sky"});
    readIrradiances(&error, &answer.standardError);
  }
  return answer;
}

ReferenceAnswer rayAnswer(JsonErrors* errors, const Json& value, const std::string& suffix) {
  ReferenceAnswer answer;
  ObjectReader reader(
      errors, value, "", suffix,
      {"id", "hits_ground", "transmittance", "sky_radiance", "ground_radiance", "standard_error"});
  const Json& hit = reader.required("hits_ground");
  if (errors->ok() && !hit.is_boolean()) reader.wrong("hits_ground", "true or false");
  if (!errors->ok()) return answer;
  answer.value.hitsGround = hit.get<bool>();
  readRadiances(&reader, &answer.value);
  if (errors->ok() && reader.given("standard_error")) {
    ObjectReader error(errors, value["standard_error"], "standard_error.", suffix,
                       {"transmittance", "sky_radiance", "ground_radiance"});
    readRadiances(&error, &answer.standardError);
  }
  return answer;
}

ReferenceAnswer answerFromJson(JsonErrors* errors, const Json& value, const NamedQuery& named) {
  const std::string suffix = " of the answer to query '" + named.id + "'";
  if (!value.is_object() || !value.contains("id") || value["id"] != named.id) {
    errors->add("the answer to query '" + named.id + "' is not where it was expected.");
    return {};
  }
  return named.query.kind == QueryKind::Irradiance ? irradianceAnswer(errors, value, suffix)
                                                   : rayAnswer(errors, value, suffix);
}

template <typename Answer>
Result<std::string> format(const std::vector<NamedQuery>& queries,
                           const std::vector<Answer>& answers) {
  using Text = Result<std::string>;
  if (queries.size() != answers.size()) {
    return Text::failure("There are " + std::to_string(answers.size()) + " answers for " +
                         std::to_string(queries.size()) + " queries.");
  }
  OrderedJson list = OrderedJson::array();
  for (size_t i = 0; i < queries.size(); ++i) {
    JsonErrors errors{"the answer to query '" + queries[i].id + "'", {}};
    OrderedJson entry;
    entry["id"] = queries[i].id;
    const ProbeQuery& query = queries[i].query;
    if (query.kind == QueryKind::Ray) entry["hits_ground"] = valueOf(answers[i]).hitsGround;
    addValues(&errors, query, valueOf(answers[i]), &entry);
    if (const ProbeAnswer* error = errorOf(answers[i])) {
      addValues(&errors, query, *error, &entry["standard_error"]);
    }
    if (!errors.ok()) return Text::failure(errors.first);
    list.push_back(std::move(entry));
  }
  OrderedJson root;
  root["answers"] = std::move(list);
  return formatJson(root);
}

}  // namespace

Result<std::vector<NamedQuery>> parseQueries(const std::string& text, const std::string& name) {
  using Queries = Result<std::vector<NamedQuery>>;
  const Result<Json> value = parseJson(text, name);
  if (!value) return Queries::failure(value.error);
  JsonErrors errors{name, {}};
  ObjectReader reader(&errors, *value, "", "", {"queries"});
  std::vector<NamedQuery> queries;
  if (errors.ok()) {
    const Json& list = reader.required("queries");
    if (errors.ok() && !list.is_array()) reader.wrong("queries", "an array");
    std::set<std::string> ids;
    for (size_t i = 0; errors.ok() && i < list.size(); ++i) {
      queries.push_back(queryFromJson(&errors, list[i], i, &ids));
    }
  }
  if (!errors.ok()) return Queries::failure(errors.first);
  return queries;
}

Result<std::vector<NamedQuery>> readQueries(const std::string& path) {
  const Result<std::string> text = readFile(path, kMaxJsonBytes);
  if (!text) return Result<std::vector<NamedQuery>>::failure(text.error);
  return parseQueries(*text, path);
}

Result<std::string> formatAnswers(const std::vector<NamedQuery>& queries,
                                  const std::vector<ProbeAnswer>& answers) {
  return format(queries, answers);
}

Result<std::string> formatAnswers(const std::vector<NamedQuery>& queries,
                                  const std::vector<ReferenceAnswer>& answers) {
  return format(queries, answers);
}

Result<std::vector<ReferenceAnswer>> parseAnswers(const std::string& text, const std::string& name,
                                                  const std::vector<NamedQuery>& queries) {
  using Answers = Result<std::vector<ReferenceAnswer>>;
  const Result<Json> value = parseJson(text, name);
  if (!value) return Answers::failure(value.error);
  JsonErrors errors{name, {}};
  ObjectReader reader(&errors, *value, "", "", {"answers"});
  std::vector<ReferenceAnswer> answers;
  if (errors.ok()) {
    const Json& list = reader.required("answers");
    if (errors.ok() && (!list.is_array() || list.size() != queries.size())) {
      reader.wrong("answers",
                   "an array of " + std::to_string(queries.size()) + ", one answer for each query");
    }
    for (size_t i = 0; errors.ok() && i < list.size(); ++i) {
      answers.push_back(answerFromJson(&errors, list[i], queries[i]));
    }
  }
  if (!errors.ok()) return Answers::failure(errors.first);
  return answers;
}

Result<std::vector<ReferenceAnswer>> readAnswers(const std::string& path,
                                                 const std::vector<NamedQuery>& queries) {
  const Result<std::string> text = readFile(path, kMaxJsonBytes);
  if (!text) return Result<std::vector<ReferenceAnswer>>::failure(text.error);
  return parseAnswers(*text, path, queries);
}

}  // namespace alpenglow::io
