#include "tests/tables/bake_fixture.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace alpenglow::testing {

void BakeTest::SetUp() {
  DeviceTest::SetUp();
  if (HasFatalFailure()) return;
  ASSERT_EQ(createContext(contextDesc(), &context_), Status::Ok) << lastDiagnostic();
}

void BakeTest::TearDown() {
  for (Tables* tables : tables_) destroyTables(tables);
  destroyContext(context_);
  DeviceTest::TearDown();
}

Parameters BakeTest::preset(const char* name) {
  Parameters parameters;
  EXPECT_EQ(findPreset(name, &parameters, {}), Status::Ok) << name;
  return parameters;
}

Tables* BakeTest::makeTables(const Parameters& parameters, const TableDesc& desc) {
  Tables* tables = nullptr;
  EXPECT_EQ(createTables(context_, parameters, desc, &tables), Status::Ok) << lastDiagnostic();
  if (tables != nullptr) tables_.push_back(tables);
  return tables;
}

void BakeTest::bake(Tables* tables, uint64_t budget, const std::string& until) {
  BakeProgress progress;
  // An earlier failure of the test must not leave tables half baked: they look like other faults.
  bool recorded = true;
  while (recorded && !progress.done && !(progress.passFinished && until == progress.pass)) {
    run([&](VkCommandBuffer commands) {
      recorded = recordBake(tables, commands, budget, &progress) == Status::Ok;
      return recorded;
    });
  }
}

Tables* BakeTest::bakeTables(const Parameters& parameters, const TableDesc& desc, uint64_t budget) {
  Tables* tables = makeTables(parameters, desc);
  if (tables != nullptr) bake(tables, budget);
  return tables;
}

CpuTable BakeTest::read(Tables* tables, TableId id) {
  CpuTable table;
  table.info = imageOf(tables, id);
  EXPECT_NE(table.info.name, nullptr) << id;
  std::string error;
  headless::HostBuffer buffer =
      device().createHostBuffer(table.info.bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
  EXPECT_NE(buffer.data(), nullptr) << error;
  run([&](VkCommandBuffer commands) {
    return recordTableReadback(tables, commands, id, buffer.buffer(), 0) == Status::Ok;
  });
  table.bytes.resize(table.info.bytes);
  std::memcpy(table.bytes.data(), buffer.data(), table.bytes.size());
  const size_t count =
      size_t(4) * table.info.extent.width * table.info.extent.height * table.info.extent.depth;
  table.values.resize(count);
  if (table.info.format == VK_FORMAT_R32G32B32A32_SFLOAT) {
    std::memcpy(table.values.data(), table.bytes.data(), table.bytes.size());
  } else {
    const auto* half = reinterpret_cast<const uint16_t*>(table.bytes.data());
    for (size_t i = 0; i < count; ++i) table.values[i] = glm::unpackHalf1x16(half[i]);
  }
  return table;
}

Status BakeTest::readbackStatus(Tables* tables, TableId id) {
  std::string error;
  const headless::HostBuffer buffer =
      device().createHostBuffer(16 << 20, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
  EXPECT_NE(buffer.data(), nullptr) << error;
  Status result = Status::Ok;
  run([&](VkCommandBuffer commands) {
    result = recordTableReadback(tables, commands, id, buffer.buffer(), 0);
    return true;
  });
  return result;
}

void BakeTest::upload(Tables* tables, TableId id, const CpuTable& table) {
  std::string error;
  headless::HostBuffer buffer =
      device().createHostBuffer(table.bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, &error);
  ASSERT_NE(buffer.data(), nullptr) << error;
  std::copy(table.bytes.begin(), table.bytes.end(), static_cast<uint8_t*>(buffer.data()));
  run([&](VkCommandBuffer commands) {
    return recordTableUpload(tables, commands, id, buffer.buffer(), 0) == Status::Ok;
  });
}

void BakeTest::expectSameBytes(const TableCopies& a, const TableCopies& b,
                               const std::string& what) {
  for (const auto& [id, table] : a)
    EXPECT_EQ(table.bytes, b.at(id).bytes) << table.info.name << " " << what;
}

std::vector<ProbeAnswer> BakeTest::probe(Tables* tables, const std::vector<ProbeQuery>& queries) {
  std::vector<ProbeAnswer> answers(queries.size());
  std::string error;
  const auto count = static_cast<uint32_t>(queries.size());
  headless::HostBuffer buffer = device().createHostBuffer(
      count * kProbeAnswerBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &error);
  EXPECT_NE(buffer.data(), nullptr) << error;
  run([&](VkCommandBuffer commands) {
    return recordProbe(tables, commands, queries.data(), count, buffer.buffer()) == Status::Ok;
  });
  EXPECT_EQ(answerQueries(tables, queries.data(), count, buffer.data(), answers.data()),
            Status::Ok);
  return answers;
}

double percentile(std::vector<double> errors, double share) {
  if (errors.empty()) return 0.0;
  std::sort(errors.begin(), errors.end());
  return errors[static_cast<size_t>(share * static_cast<double>(errors.size() - 1))];
}

}  // namespace alpenglow::testing
