#include <alpenglow/io/probe_file.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::expectSentence;

constexpr double kRadians = 3.14159265358979323846 / 180.0;

std::string rayText(const std::string& id, const std::string& fields) {
  return "{ \"id\": " + id + ", " + fields + " }";
}
const char* const kGoodRay =
    "\"altitude_m\": 2, \"view_zenith_deg\": 88, \"sun_zenith_deg\": 92, \"azimuth_deg\": 45, "
    "\"distance_m\": null";

std::string fileText(const std::string& queries) { return "{ \"queries\": [" + queries + "] }"; }

std::string errorOf(const std::string& queries) {
  const Result<std::vector<NamedQuery>> result = parseQueries(fileText(queries), "q.json");
  EXPECT_FALSE(result) << queries;
  expectSentence(result.error);
  return result.error;
}

std::string rayWith(const std::string& field, const std::string& value) {
  std::string fields = kGoodRay;
  const size_t at = fields.find(':', fields.find("\"" + field + "\"")) + 2;
  size_t end = fields.find(',', at);
  if (end == std::string::npos) end = fields.size();
  return rayText("\"bad one\"", fields.replace(at, end - at, value));
}

TEST(ProbeFile, ReadsBothKinds) {
  const auto queries =
      parseQueries(fileText(rayText("\"a\"", kGoodRay) +
                            ", { \"id\": \"b\", \"kind\": \"irradiance\", \"altitude_m\": 0, "
                            "\"sun_zenith_deg\": 60 }, " +
                            rayText("\"c\"",
                                    "\"altitude_m\": 1e7, \"view_zenith_deg\": 180, "
                                    "\"sun_zenith_deg\": 0, \"azimuth_deg\": -7290, "
                                    "\"distance_m\": 12.5")),
                   "q.json");
  ASSERT_TRUE(queries) << queries.error;
  ASSERT_EQ(queries->size(), 3u);
  const ProbeQuery& a = (*queries)[0].query;
  EXPECT_EQ((*queries)[0].id, "a");
  EXPECT_EQ(a.kind, QueryKind::Ray);
  EXPECT_EQ(a.altitude_m, 2.0);
  EXPECT_DOUBLE_EQ(a.zenith, 88.0 * kRadians);
  EXPECT_DOUBLE_EQ(a.sunZenith, 92.0 * kRadians);
  EXPECT_DOUBLE_EQ(a.azimuth, 45.0 * kRadians);
  EXPECT_FALSE(a.bounded);
  EXPECT_EQ(a.distance_m, 0.0);
  EXPECT_EQ((*queries)[1].query.kind, QueryKind::Irradiance);
  EXPECT_DOUBLE_EQ((*queries)[1].query.sunZenith, 60.0 * kRadians);
  EXPECT_DOUBLE_EQ((*queries)[2].query.azimuth, -90.0 * kRadians);  // 20 turns less
  EXPECT_TRUE((*queries)[2].query.bounded);
  EXPECT_EQ((*queries)[2].query.distance_m, 12.5);
}

TEST(ProbeFile, AnEmptyListIsFine) { EXPECT_TRUE(parseQueries(fileText(""), "q.json")->empty()); }

TEST(ProbeFile, ABadQueryIsNamedWithItsField) {
  const std::pair<const char*, const char*> bad[] = {
      {"altitude_m", "-1"},         {"altitude_m", "NaN"},    {"altitude_m", "1e999"},
      {"altitude_m", "null"},       {"altitude_m", "\"2\""},  {"view_zenith_deg", "-0.1"},
      {"view_zenith_deg", "180.1"}, {"sun_zenith_deg", "-1"}, {"sun_zenith_deg", "181"},
      {"azimuth_deg", "Infinity"},  {"azimuth_deg", "[1]"},   {"distance_m", "-1"},
      {"distance_m", "-Infinity"},  {"distance_m", "\"far\""}};
  for (const auto& [field, value] : bad) {
    const std::string error = errorOf(rayText("\"good\"", kGoodRay) + "," + rayWith(field, value));
    EXPECT_NE(error.find("'bad one'"), std::string::npos) << error;
    EXPECT_NE(error.find(field), std::string::npos) << error;
    EXPECT_NE(error.find("q.json"), std::string::npos) << error;
  }
}

TEST(ProbeFile, UnknownAndMissingFieldsAndKinds) {
  EXPECT_NE(errorOf(rayText("\"a\"", std::string(kGoodRay) + ", \"sun\": 1")).find("'sun'"),
            std::string::npos);
  EXPECT_NE(errorOf(rayText("\"a\"", "\"altitude_m\": 2")).find("'view_zenith_deg'"),
            std::string::npos);
  const std::string kind =
      errorOf("{\"id\": \"k\", \"kind\": \"flux\", \"altitude_m\": 0, \"sun_zenith_deg\": 1}");
  EXPECT_NE(kind.find("'kind' of query 'k'"), std::string::npos) << kind;
  EXPECT_NE(kind.find("\"flux\""), std::string::npos) << kind;
  EXPECT_NE(errorOf("{\"id\": \"k\", \"kind\": \"irradiance\", \"altitude_m\": 0, "
                    "\"sun_zenith_deg\": 1, \"azimuth_deg\": 0}")
                .find("'azimuth_deg'"),
            std::string::npos);
}

TEST(ProbeFile, IdsAreStringsAndDiffer) {
  EXPECT_NE(errorOf(std::string("{") + kGoodRay + "}").find("'id' of query number 1 is missing"),
            std::string::npos);
  EXPECT_NE(errorOf(rayText("\"a\"", kGoodRay) + "," + rayText("7", kGoodRay))
                .find("'id' of query number 2 is 7"),
            std::string::npos);
  for (const std::string id : {"NaN", "Infinity", "1e999"}) {
    const std::string said = errorOf(rayText(id, kGoodRay));
    EXPECT_NE(said.find("'id' of query number 1 is " + id), std::string::npos) << said;
  }
  EXPECT_NE(errorOf(rayText("\"a\"", kGoodRay) + "," + rayText("\"a\"", kGoodRay)).find("'a'"),
            std::string::npos);
  errorOf("3");
  expectSentence(parseQueries("{}", "q").error);
  expectSentence(parseQueries("{\"queries\": 3}", "q").error);
  expectSentence(parseQueries("{\"queries\": [], \"more\": 1}", "q").error);
}

ProbeAnswer someAnswer() {
  ProbeAnswer answer;
  answer.hitsGround = true;
  answer.transmittance = {{0.123456789012345, 0.5, 1.0 / 3.0}};
  answer.skyRadiance = {{1e-17, 2.5e-9, 3.0}};
  answer.groundRadiance = {{0.1, 0.2, 0.3}};
  answer.direct = {{0.4, 0.5, 0.6}};
  answer.sky = {{0.7, 0.8, 0.9}};
  return answer;
}

std::vector<NamedQuery> bothQueries() {
  NamedQuery ray{"ray \"1\"", {}};
  NamedQuery surface{"surface", {}};
  surface.query.kind = QueryKind::Irradiance;
  return {ray, surface};
}

TEST(Answers, KeepAllDigitsAndTheOrder) {
  const auto text = formatAnswers(bothQueries(), std::vector<ProbeAnswer>(2, someAnswer()));
  ASSERT_TRUE(text) << text.error;
  const nlohmann::json root = nlohmann::json::parse(*text);
  ASSERT_EQ(root.size(), 1u);
  const nlohmann::json& ray = root["answers"][0];
  EXPECT_EQ(ray.size(), 5u);
  EXPECT_EQ(ray["id"], "ray \"1\"");
  EXPECT_EQ(ray["hits_ground"], true);
  for (uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ray["transmittance"][i], someAnswer().transmittance[i]);
    EXPECT_EQ(ray["sky_radiance"][i], someAnswer().skyRadiance[i]);
    EXPECT_EQ(ray["ground_radiance"][i], someAnswer().groundRadiance[i]);
  }
  const nlohmann::json& surface = root["answers"][1];
  EXPECT_EQ(surface.size(), 3u);
  EXPECT_EQ(surface["direct"][2], 0.6);
  EXPECT_EQ(surface["sky"][0], 0.7);
}

TEST(Answers, TheReferenceAddsItsStandardError) {
  ReferenceAnswer answer;
  answer.value = someAnswer();
  answer.standardError.skyRadiance = {{1e-10, 2e-10, 3e-10}};
  answer.standardError.direct = {{1e-12, 0.0, 0.0}};
  const auto text = formatAnswers(bothQueries(), std::vector<ReferenceAnswer>(2, answer));
  ASSERT_TRUE(text) << text.error;
  const nlohmann::json root = nlohmann::json::parse(*text);
  const nlohmann::json& error = root["answers"][0]["standard_error"];
  EXPECT_EQ(error.size(), 3u);
  EXPECT_EQ(error["sky_radiance"][1], 2e-10);
  EXPECT_EQ(root["answers"][1]["standard_error"].size(), 2u);
  EXPECT_EQ(root["answers"][1]["standard_error"]["direct"][0], 1e-12);
}

TEST(Answers, NothingThatIsNotFiniteIsWritten) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    std::vector<ProbeAnswer> answers(2, someAnswer());
    answers[0].skyRadiance[1] = bad;
    const auto text = formatAnswers(bothQueries(), answers);
    EXPECT_FALSE(text);
    expectSentence(text.error);
    EXPECT_NE(text.error.find("sky_radiance"), std::string::npos);
    EXPECT_NE(text.error.find("ray"), std::string::npos);
  }
}

void expectSame(const ProbeAnswer& a, const ProbeAnswer& b, bool irradiance) {
  EXPECT_EQ(a.hitsGround, irradiance ? false : b.hitsGround);
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    EXPECT_EQ(a.transmittance[c], irradiance ? 0.0 : b.transmittance[c]);
    EXPECT_EQ(a.skyRadiance[c], irradiance ? 0.0 : b.skyRadiance[c]);
    EXPECT_EQ(a.groundRadiance[c], irradiance ? 0.0 : b.groundRadiance[c]);
    EXPECT_EQ(a.direct[c], irradiance ? b.direct[c] : 0.0);
    EXPECT_EQ(a.sky[c], irradiance ? b.sky[c] : 0.0);
  }
}

TEST(Answers, AreReadBack) {
  ReferenceAnswer answer;
  answer.value = someAnswer();
  answer.standardError = someAnswer();
  answer.standardError.hitsGround = false;
  const auto text = formatAnswers(bothQueries(), std::vector<ReferenceAnswer>(2, answer));
  ASSERT_TRUE(text) << text.error;
  const auto read = parseAnswers(*text, "a.json", bothQueries());
  ASSERT_TRUE(read) << read.error;
  ASSERT_EQ(read->size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    expectSame((*read)[i].value, answer.value, i == 1);
    expectSame((*read)[i].standardError, answer.standardError, i == 1);
  }
  const auto plain = formatAnswers(bothQueries(), std::vector<ProbeAnswer>(2, someAnswer()));
  const auto readPlain = parseAnswers(*plain, "a.json", bothQueries());
  ASSERT_TRUE(readPlain) << readPlain.error;
  EXPECT_EQ((*readPlain)[0].standardError.skyRadiance[0], 0.0);
}

TEST(Answers, OfOtherQueriesAreRefused) {
  const auto text = formatAnswers(bothQueries(), std::vector<ProbeAnswer>(2, someAnswer()));
  ASSERT_TRUE(text) << text.error;
  const auto refused = [](const std::string& changed, const std::vector<NamedQuery>& queries,
                          const std::string& word) {
    const auto read = parseAnswers(changed, "a.json", queries);
    EXPECT_FALSE(read) << changed;
    expectSentence(read.error);
    EXPECT_NE(read.error.find(word), std::string::npos) << read.error;
  };
  std::vector<NamedQuery> queries = bothQueries();
  queries.pop_back();
  refused(*text, queries, "answers");
  queries = bothQueries();
  std::swap(queries[0], queries[1]);
  refused(*text, queries, queries[0].id);
  nlohmann::json root = nlohmann::json::parse(*text);
  root["answers"][0].erase("sky_radiance");
  refused(root.dump(), bothQueries(), "sky_radiance");
  root = nlohmann::json::parse(*text);
  root["answers"][0]["hits_ground"] = 1;
  refused(root.dump(), bothQueries(), "hits_ground");
  root = nlohmann::json::parse(*text);
  root["answers"][1]["extra"] = 1;
  refused(root.dump(), bothQueries(), "extra");
}

}  // namespace
}  // namespace alpenglow::io
