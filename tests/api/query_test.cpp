// The CPU's answers are the device's, to float accuracy.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <thread>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

/// Relative to the device's answer, or to a floor far below a starlit night.
struct Errors {
  std::vector<double> values;
  uint32_t lit = 0;  ///< Values above the floor.

  void add(const Spectrum& device, const Spectrum& cpu, double floor) {
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      values.push_back(std::abs(cpu[c] - device[c]) / std::max(device[c], floor));
      lit += device[c] > floor ? 1 : 0;
    }
  }
};

/// Measured: p95 below 3.7e-6, at most 1.4e-5; both in the sun's direct light, whose optical depth
/// is tabulated as a logarithm.
void expectSmall(const char* atmosphere, const char* what, Errors& errors) {
  std::sort(errors.values.begin(), errors.values.end());
  const double p95 = errors.values[errors.values.size() * 95 / 100];
  std::printf("%-10s %-15s p95 %.2e  max %.2e of %zu values\n", atmosphere, what, p95,
              errors.values.back(), errors.values.size());
  EXPECT_LT(p95, 1e-5) << atmosphere << " " << what;
  EXPECT_LT(errors.values.back(), 5e-5) << atmosphere << " " << what;
}

class QueryTest : public StandardSkyTest {
 protected:
  Tables* make(const char* name, const TableDesc& desc) {
    Tables* tables = nullptr;
    EXPECT_EQ(createTables(context(), preset(name), desc, &tables), Status::Ok) << message();
    made_.push_back(tables);
    return tables;
  }
  void TearDown() override {
    for (Tables* tables : made_) destroyTables(tables);
    StandardSkyTest::TearDown();
  }

  /// Baked, and the host copies have arrived.
  Tables* bake(const char* name, const TableDesc& desc) {
    Tables* tables = make(name, desc);
    bakeAll(device(), tables);
    finishFrames();
    return tables;
  }
  void finishFrames() {
    const uint64_t next = device().skipFrame();
    EXPECT_EQ(advanceFrame(context(), next, next - 1), Status::Ok) << message();
  }
  uint64_t buffers() {
    finishFrames();  // Those of tables that are gone go now.
    ResourceReport report;
    resourceReport(context(), &report);
    return report.buffers;
  }

 private:
  std::vector<Tables*> made_;
};

TableDesc smallMoments(TableFormat format, CpuQueries cpuQueries = CpuQueries::All) {
  TableDesc desc;
  desc.cpuQueries = cpuQueries;
  desc.format = format;
  desc.quality = Quality::Draft;
  return desc;
}

/// From the ground to space, by day and twilight; whole rays, segments, and irradiances.
std::vector<ProbeQuery> randomQueries(uint32_t count) {
  std::mt19937 random(20261122);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  std::vector<ProbeQuery> queries(count);
  for (uint32_t i = 0; i < count; ++i) {
    ProbeQuery& q = queries[i];
    q.kind = i % 6 == 0 ? QueryKind::Irradiance : QueryKind::Ray;
    q.altitude_m = i % 7 == 0   ? 0.0
                   : i % 7 == 1 ? std::exp(uniform(std::log(7e4), std::log(4e7)))
                                : std::exp(uniform(std::log(2.0), std::log(6e4)));
    const double dip = std::acos(6360e3 / (6360e3 + q.altitude_m));
    q.zenith = q.altitude_m > 6e4 ? kPi - (kPi / 2.0 - dip) * uniform(0.0, 1.02)
               : i % 5 == 0       ? kPi / 2.0 + dip + uniform(-0.02, 0.02)
                                  : uniform(0.0, kPi);
    q.sunZenith = radians(uniform(0.0, 105.0));
    q.azimuth = uniform(-kPi, kPi);
    q.bounded = i % 4 == 2;
    if (q.bounded) q.distance_m = std::exp(uniform(std::log(10.0), std::log(3e5)));
    if (q.kind == QueryKind::Irradiance) {
      q.bounded = false;
      q.zenith = q.azimuth = q.distance_m = 0.0;
    }
  }
  return queries;
}

TEST_F(QueryTest, TheCpuAnswersWhatTheDeviceAnswers) {
  const std::vector<ProbeQuery> queries = randomQueries(600);
  for (const char* name : {"earth", "earth-hazy", "mars"}) {
    for (TableFormat format : {TableFormat::Half, TableFormat::Float}) {
      Tables* tables = bake(name, smallMoments(format));
      const std::vector<ProbeAnswer> device = probeAll(queries, tables);
      std::vector<ProbeAnswer> cpu(queries.size());
      ASSERT_EQ(answerQueries(tables, queries.data(), 600, nullptr, cpu.data()), Status::Ok)
          << message();
      Errors transmittance, sky, ground, direct, irradiance;
      for (size_t i = 0; i < queries.size(); ++i) {
        ASSERT_EQ(cpu[i].hitsGround, device[i].hitsGround) << i;
        if (queries[i].kind == QueryKind::Irradiance) {
          direct.add(device[i].direct, cpu[i].direct, 1e-6);
          irradiance.add(device[i].sky, cpu[i].sky, 1e-12);
        } else {
          transmittance.add(device[i].transmittance, cpu[i].transmittance, 1e-6);
          sky.add(device[i].skyRadiance, cpu[i].skyRadiance, 1e-12);
          ground.add(device[i].groundRadiance, cpu[i].groundRadiance, 1e-9);
        }
      }
      // Where the device's answer is not below the floor, that is nearly everywhere.
      EXPECT_GT(sky.lit, 500u);
      EXPECT_GT(ground.lit, 100u);
      EXPECT_GT(irradiance.lit, 100u);
      expectSmall(name, "transmittance", transmittance);
      expectSmall(name, "sky radiance", sky);
      expectSmall(name, "ground radiance", ground);
      expectSmall(name, "direct", direct);
      expectSmall(name, "sky irradiance", irradiance);
    }
  }
}

TEST_F(QueryTest, NotReadyUntilTheTablesAndTheirCopiesAre) {
  const std::vector<ProbeQuery> queries = randomQueries(12);
  std::vector<ProbeAnswer> answers(queries.size());
  Tables* tables = make("earth", smallMoments(TableFormat::Half));
  const auto ask = [&] {
    message().clear();
    answers[0].sky[0] = 7.0;
    return answerQueries(tables, queries.data(), 12, nullptr, answers.data());
  };
  EXPECT_EQ(ask(), Status::NotReady);
  EXPECT_EQ(message(), "");
  EXPECT_EQ(infoOf(tables).state, TablesState::Empty);
  bakeAll(device(), tables);
  EXPECT_EQ(infoOf(tables).state, TablesState::Recorded);
  EXPECT_EQ(ask(), Status::NotReady);
  EXPECT_EQ(message(), "");
  EXPECT_EQ(answers[0].sky[0], 7.0) << "A failed call has written answers.";
  finishFrames();
  EXPECT_EQ(infoOf(tables).state, TablesState::Complete);
  EXPECT_EQ(ask(), Status::Ok) << message();
  EXPECT_NE(answers[0].sky[0], 7.0);
}

TEST_F(QueryTest, LightIsAllButTheSkyRadianceOfRays) {
  const std::vector<ProbeQuery> queries = randomQueries(60);
  std::vector<ProbeAnswer> whole(queries.size()), light(queries.size());
  const uint64_t before = buffers();
  Tables* tables = bake("earth", smallMoments(TableFormat::Half));
  const uint64_t ofAll = buffers() - before;
  Tables* lit = bake("earth", smallMoments(TableFormat::Half, CpuQueries::Light));
  EXPECT_EQ(buffers() - before - ofAll, ofAll - 1) << "No copy of the source.";
  ASSERT_EQ(answerQueries(tables, queries.data(), 60, nullptr, whole.data()), Status::Ok);
  ASSERT_EQ(answerQueries(lit, queries.data(), 60, nullptr, light.data()), Status::Ok);
  for (size_t i = 0; i < queries.size(); ++i) {
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      EXPECT_EQ(light[i].transmittance[c], whole[i].transmittance[c]) << i;
      EXPECT_EQ(light[i].groundRadiance[c], whole[i].groundRadiance[c]) << i;
      EXPECT_EQ(light[i].direct[c], whole[i].direct[c]) << i;
      EXPECT_EQ(light[i].sky[c], whole[i].sky[c]) << i;
      EXPECT_EQ(light[i].skyRadiance[c], 0.0) << i;
    }
  }
}

TEST_F(QueryTest, TablesWithoutCpuQueriesKeepNoCopies) {
  const uint64_t before = buffers();
  Tables* tables = bake("earth", smallMoments(TableFormat::Half, CpuQueries::None));
  EXPECT_EQ(buffers() - before, 1u) << "The uniform parameters, and nothing else.";
  const ProbeQuery query;
  ProbeAnswer answer;
  EXPECT_EQ(answerQueries(tables, &query, 1, nullptr, &answer), Status::InvalidArgument);
  EXPECT_TRUE(hasAll(message(), "cpuQueries|CpuQueries::None")) << message();
  make("earth", smallMoments(TableFormat::Half));
  EXPECT_EQ(buffers() - before, 1u + 4u);
}

// Tables that are uploaded bring their copies, too.
TEST_F(QueryTest, UploadedTablesAnswerAsTheBakedOnesDo) {
  const std::vector<ProbeQuery> queries = randomQueries(60);
  std::vector<ProbeAnswer> wanted(queries.size()), got(queries.size());
  Tables* baked = bake("earth", smallMoments(TableFormat::Half));
  Tables* uploaded = make("earth", smallMoments(TableFormat::Half));
  for (const TableId id : {kTableOpticalDepth, kTableMoments, kTableSource}) {
    EXPECT_EQ(answerQueries(uploaded, queries.data(), 60, nullptr, got.data()), Status::NotReady);
    const headless::HostBuffer buffer = device().createHostBuffer(
        imageOf(baked, id).bytes,
        VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, nullptr);
    run([&](VkCommandBuffer commands) {
      return recordTableReadback(baked, commands, id, buffer.buffer(), 0) == Status::Ok;
    });
    run([&](VkCommandBuffer commands) {
      return recordTableUpload(uploaded, commands, id, buffer.buffer(), 0) == Status::Ok;
    });
  }
  finishFrames();
  ASSERT_EQ(answerQueries(baked, queries.data(), 60, nullptr, wanted.data()), Status::Ok);
  ASSERT_EQ(answerQueries(uploaded, queries.data(), 60, nullptr, got.data()), Status::Ok);
  for (size_t i = 0; i < queries.size(); ++i)
    for (uint32_t c = 0; c < kSpectrumSize; ++c)
      EXPECT_EQ(got[i].skyRadiance[c], wanted[i].skyRadiance[c]) << i;
}

TEST_F(QueryTest, WrongArgumentsAreRefused) {
  std::vector<ProbeQuery> queries = randomQueries(3);
  std::vector<ProbeAnswer> answers(3);
  EXPECT_EQ(answerQueries(tables(), queries.data(), 3, nullptr, answers.data()),
            Status::Unsupported);
  EXPECT_NE(message().find("Solver::Standard"), std::string::npos) << message();
  EXPECT_EQ(answerQueries(nullptr, queries.data(), 3, nullptr, answers.data()),
            Status::InvalidArgument);
  Tables* moments = make("earth", smallMoments(TableFormat::Half));
  EXPECT_EQ(answerQueries(moments, nullptr, 3, nullptr, answers.data()), Status::InvalidArgument);
  EXPECT_NE(message().find("null"), std::string::npos) << message();
  queries[2].altitude_m = -1.0;
  EXPECT_EQ(answerQueries(moments, queries.data(), 3, nullptr, answers.data()),
            Status::InvalidArgument);
  EXPECT_NE(message().find("ProbeQuery 2 has altitude_m"), std::string::npos) << message();
}

TEST_F(QueryTest, ThreadsAskTheSameTables) {
  const std::vector<ProbeQuery> queries = randomQueries(200);
  Tables* tables = bake("earth", smallMoments(TableFormat::Half));
  std::vector<ProbeAnswer> answers[4];
  std::vector<std::thread> threads;
  for (auto& own : answers) {
    own.resize(queries.size());
    threads.emplace_back([&] {
      EXPECT_EQ(answerQueries(tables, queries.data(), 200, nullptr, own.data()), Status::Ok);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& own : answers)
    for (size_t i = 0; i < queries.size(); ++i)
      for (uint32_t c = 0; c < kSpectrumSize; ++c)
        EXPECT_EQ(own[i].skyRadiance[c], answers[0][i].skyRadiance[c]);
}

}  // namespace
}  // namespace alpenglow::testing
