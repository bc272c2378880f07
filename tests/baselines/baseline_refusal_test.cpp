// What a simpler model has no use for is refused; what it leaves out is reported.
#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

class BaselineRefusalTest : public SkyTest {
 protected:
  void expectRefused(const TableDesc& desc, const char* parts) {
    Tables* tables = nullptr;
    EXPECT_EQ(createTables(context(), preset("earth"), desc, &tables), Status::InvalidArgument);
    EXPECT_EQ(tables, nullptr);
    EXPECT_TRUE(hasAll(message(), parts)) << message();
  }
};

TEST_F(BaselineRefusalTest, ChoicesOfOtherSolvers) {
  TableDesc desc;
  desc.solver = Solver::ONeil;
  desc.orders = 2;
  expectRefused(desc, "Solver::ONeil|orders");
  desc.orders = 0;
  desc.quality = Quality::High;
  expectRefused(desc, "Solver::ONeil|Quality");
  desc.quality = Quality::Default;
  desc.mie = MieStorage::Packed;
  expectRefused(desc, "Solver::ONeil|MieStorage::Packed");
  desc.mie = MieStorage::Full;
  desc.keepOrders = true;
  expectRefused(desc, "Solver::ONeil|keepOrders");
  desc.keepOrders = false;
  desc.sizes.stepCount = 5000;
  expectRefused(desc, "stepCount is 5000|1024");
  desc.solver = Solver::Schafhitzel;
  desc.sizes.stepCount = 4;
  expectRefused(desc, "Solver::Schafhitzel|stepCount");
  desc.solver = Solver::Moments;
  expectRefused(desc, "Solver::Moments|stepCount");
}

TEST_F(BaselineRefusalTest, TablesHaveNoId) {
  TableDesc desc;
  desc.solver = Solver::Hillaire;
  Tables* tables = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), desc, &tables), Status::Ok) << message();
  for (uint32_t id = 0; id < kTableIdCount; ++id) {
    EXPECT_EQ(imageOf(tables, static_cast<TableId>(id)).name, nullptr);
    EXPECT_EQ(recordTableReadback(tables, reinterpret_cast<VkCommandBuffer>(1),
                                  static_cast<TableId>(id), VK_NULL_HANDLE, 0),
              Status::Unsupported);
    EXPECT_TRUE(hasAll(message(), "have no table")) << message();
  }
  destroyTables(tables);
}

TEST_F(BaselineRefusalTest, ViewsOfAnotherSolver) {
  TableDesc other;
  other.solver = Solver::Hillaire;
  Tables* shape = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), other, &shape), Status::Ok) << message();
  View* const view = makeView({}, shape);
  destroyTables(shape);
  const FrameState draw =
      makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, 2.0, 0.0, 0.1, 0.0, 1.0),
               {1.0, 0.0, 0.0}, {8, 8});
  const Status status =
      testing::recordSky(view, reinterpret_cast<VkCommandBuffer>(1), tables(), draw);
  EXPECT_EQ(status, Status::InvalidArgument);
  EXPECT_TRUE(hasAll(message(), "FrameDesc::tables|solver")) << message();
}

TEST(ModelLimit, IsASentenceWhereThereIsOne) {
  EXPECT_STREQ(modelLimit(Solver::Moments), "");
  EXPECT_STREQ(modelLimit(Solver::Standard), "");
  EXPECT_TRUE(hasAll(modelLimit(Solver::HoffmanPreetham), "undefined|below the horizon|space"));
  EXPECT_TRUE(hasAll(modelLimit(Solver::Schafhitzel), "azimuth|shadow"));
  EXPECT_TRUE(hasAll(modelLimit(Solver::ONeil), "one event"));
  EXPECT_TRUE(hasAll(modelLimit(Solver::Hillaire), "isotropic"));
}

}  // namespace
}  // namespace alpenglow::testing
