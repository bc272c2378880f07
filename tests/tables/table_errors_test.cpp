// Wrong calls get a status and a sentence with the value, and leave the tables as they were.
#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {
namespace {

class TableErrorsTest : public BakeTest {
 protected:
  void expectRefused(const TableDesc& desc, const std::string& part) {
    Tables* tables = nullptr;
    EXPECT_EQ(createTables(context(), preset("earth"), desc, &tables), Status::InvalidArgument);
    EXPECT_EQ(tables, nullptr);
    EXPECT_NE(lastDiagnostic().find(part), std::string::npos) << lastDiagnostic();
  }
};

TEST_F(TableErrorsTest, WrongSizesAreRefusedByName) {
  TableDesc desc = standardDesc();
  desc.sizes.scatteringMu = 33;
  expectRefused(desc, "scatteringMu is 33");
  desc.sizes = {};
  desc.sizes.transmittanceR = 1;
  expectRefused(desc, "transmittanceR is 1");
  desc.sizes = {};
  desc.sizes.scatteringMuS = 4000;
  desc.sizes.scatteringNu = 4000;
  expectRefused(desc, "16000000 texels");
  desc.sizes = {};
  desc.sizes.irradianceMuS = 1'000'000;
  expectRefused(desc, "irradianceMuS is 1000000");
  desc = standardDesc();
  desc.orders = 1001;
  expectRefused(desc, "orders is 1001");
  desc = standardDesc();
  desc.format = static_cast<TableFormat>(9);
  expectRefused(desc, "format 9");
}

TEST_F(TableErrorsTest, SettingsOfTheOtherSolverAreRefused) {
  TableDesc desc;
  desc.solver = Solver::Moments;
  desc.mie = MieStorage::Packed;
  expectRefused(desc, "Solver::Moments and MieStorage::Packed");
  desc = {};
  desc.sizes.scatteringNu = 8;
  expectRefused(desc, "Solver::Moments and TableSizes::scatteringNu");
  desc = standardDesc();
  desc.quality = Quality::High;
  expectRefused(desc, "Solver::Standard and a Quality");
  desc = standardDesc();
  desc.sizes.viewPanels = 4;
  expectRefused(desc, "Solver::Standard and TableSizes::viewPanels");
  desc = {};
  desc.solver = static_cast<Solver>(6);
  expectRefused(desc, "solver 6");
  desc = {};
  desc.quality = static_cast<Quality>(6);
  expectRefused(desc, "quality 6");
}

TEST_F(TableErrorsTest, WrongMomentSettingsAreRefusedByName) {
  TableDesc desc;
  desc.sizes.degree = 48;
  expectRefused(desc, "degree is 48, but must be from 2 to 47");
  desc.sizes = {};
  desc.sizes.depthMu = 5000;
  expectRefused(desc, "depthMu is 5000");
  desc.sizes = {};
  desc.sizes.viewPanels = 1;
  expectRefused(desc, "viewPanels is 1");
  desc.sizes = {};
  desc.sizes.azimuths = 8;
  desc.sizes.degree = 16;
  expectRefused(desc, "azimuths is 8, but must be above half the degree, which is 16");
}

TEST_F(TableErrorsTest, WrongParametersAreRefusedInTheValidatorsWords) {
  Parameters earth = preset("earth");
  earth.mie.asymmetry = 1.5;
  Tables* tables = nullptr;
  EXPECT_EQ(createTables(context(), earth, {}, &tables), Status::InvalidArgument);
  EXPECT_NE(lastDiagnostic().find("mie.asymmetry"), std::string::npos) << lastDiagnostic();
}

TEST_F(TableErrorsTest, TablesThatAreNotReadyAreNotReadOrProbed) {
  TableDesc desc = standardDesc(kSmallSizes);
  Tables* tables = makeTables(preset("earth"), desc);
  std::string error;
  const headless::HostBuffer buffer = device().createHostBuffer(
      1 << 20, VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &error);
  run([&](VkCommandBuffer commands) {
    EXPECT_EQ(recordTableReadback(tables, commands, kTableScattering, buffer.buffer(), 0),
              Status::NotReady);
    EXPECT_EQ(recordTableReadback(tables, commands, kTableOrderScattering, buffer.buffer(), 0),
              Status::Unsupported);
    EXPECT_NE(lastDiagnostic().find("keepOrders"), std::string::npos) << lastDiagnostic();
    const ProbeQuery query;
    const size_t sentences = diagnostics().size();
    EXPECT_EQ(recordProbe(tables, commands, &query, 1, buffer.buffer()), Status::NotReady);
    EXPECT_EQ(diagnostics().size(), sentences) << lastDiagnostic();  // It is no error.
    EXPECT_EQ(recordTableReadback(tables, commands, kTableScattering, VK_NULL_HANDLE, 0),
              Status::InvalidArgument);
    return true;
  });
}

TEST_F(TableErrorsTest, OrderTablesAreReadOnlyBetweenOrders) {
  TableDesc desc = standardDesc(kSmallSizes);
  desc.orders = 2;
  desc.keepOrders = true;
  Tables* tables = makeTables(preset("earth"), desc);
  const auto status = [&](TableId id) { return readbackStatus(tables, id); };
  EXPECT_EQ(status(kTableOrderScattering), Status::NotReady);
  bake(tables, 0, "dE 1");
  EXPECT_EQ(status(kTableOrderScattering), Status::NotReady);
  bake(tables, 0, "dS 1");
  EXPECT_EQ(status(kTableOrderScattering), Status::Ok);
  EXPECT_EQ(status(kTableOrderSingleMie), Status::Ok);
  bake(tables);
  EXPECT_EQ(status(kTableOrderScattering), Status::Ok);
  EXPECT_EQ(status(kTableOrderSingleMie), Status::NotReady);
  EXPECT_EQ(status(kTableScattering), Status::Ok);
}

TEST_F(TableErrorsTest, FrameNumbersThatCannotBeAreRefused) {
  const uint64_t next = device().skipFrame();
  ASSERT_EQ(advanceFrame(context(), next, next - 1), Status::Ok);
  const auto refuses = [&](uint64_t submitting, uint64_t completed, const char* part) {
    EXPECT_EQ(advanceFrame(context(), submitting, completed), Status::InvalidArgument);
    EXPECT_NE(lastDiagnostic().find(part), std::string::npos) << lastDiagnostic();
  };
  refuses(0, 0, "counts from 1");
  refuses(next, next + 1, "before it is recorded");
  refuses(next - 1, next - 1, "neither number falls");
  refuses(next, next - 2, "neither number falls");
  EXPECT_EQ(advanceFrame(nullptr, 1, 0), Status::InvalidArgument);
  EXPECT_EQ(abandonFrame(nullptr, 1), Status::InvalidArgument);
  EXPECT_EQ(abandonFrame(context(), next - 1), Status::InvalidArgument);
  EXPECT_NE(lastDiagnostic().find("abandonFrame got frame"), std::string::npos);
  EXPECT_EQ(abandonFrame(context(), next + 1), Status::InvalidArgument);
}

TEST_F(TableErrorsTest, WrongQueriesAreRefusedByIndexAndField) {
  TableDesc desc = standardDesc(kSmallSizes);
  desc.orders = 1;
  Tables* tables = bakeTables(preset("earth"), desc);
  std::string error;
  const headless::HostBuffer buffer =
      device().createHostBuffer(1024, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &error);
  ProbeQuery queries[2];
  queries[1].zenith = 4.0;
  run([&](VkCommandBuffer commands) {
    EXPECT_EQ(recordProbe(tables, commands, queries, 2, buffer.buffer()), Status::InvalidArgument);
    EXPECT_NE(lastDiagnostic().find("ProbeQuery 1 has zenith = 4"), std::string::npos)
        << lastDiagnostic();
    EXPECT_EQ(recordProbe(tables, commands, queries, 0, buffer.buffer()), Status::InvalidArgument);
    return true;
  });
}

}  // namespace
}  // namespace alpenglow::testing
