// Contexts: what they ask for and refuse, and several of them at once.
#include <cmath>
#include <limits>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST_F(StandardSkyTest, ContextArgumentsAreChecked) {
  ContextDesc desc = contextDesc();
  EXPECT_EQ(createContext(desc, nullptr), Status::InvalidArgument);
  Context* made = nullptr;
  desc.capabilities = 1u << 7;
  EXPECT_EQ(createContext(desc, &made), Status::InvalidArgument);
  EXPECT_TRUE(contains(lastDiagnostic(), "capabilities")) << lastDiagnostic();
  const auto lacking = [&](auto member) {
    ContextDesc spoilt = contextDesc();
    spoilt.*member = nullptr;
    made = reinterpret_cast<Context*>(uintptr_t{1});
    const Status status = createContext(spoilt, &made);
    EXPECT_EQ(made, nullptr);
    return status;
  };
  EXPECT_EQ(lacking(&ContextDesc::instance), Status::InvalidArgument);
  EXPECT_TRUE(contains(lastDiagnostic(), "ContextDesc::instance is null")) << lastDiagnostic();
  EXPECT_EQ(lacking(&ContextDesc::physicalDevice), Status::InvalidArgument);
  EXPECT_EQ(lacking(&ContextDesc::device), Status::InvalidArgument);
  EXPECT_EQ(lacking(&ContextDesc::getInstanceProcAddr), Status::InvalidArgument);
  desc = contextDesc();
  desc.enabled.deviceFeatures &= ~DeviceFeatureFlags{kFeatureSynchronization2};
  EXPECT_EQ(createContext(desc, &made), Status::Unsupported);
  EXPECT_TRUE(contains(lastDiagnostic(), "synchronization2")) << lastDiagnostic();
  desc = contextDesc();
  desc.enabled.apiVersion = VK_API_VERSION_1_2;
  EXPECT_EQ(createContext(desc, &made), Status::Unsupported);
  EXPECT_TRUE(contains(lastDiagnostic(), "1.3")) << lastDiagnostic();
  desc.diagnostics = {};  // Nobody listens: still refused, nothing else.
  EXPECT_EQ(createContext(desc, &made), Status::Unsupported);
  destroyContext(nullptr);
  resourceReport(nullptr, nullptr);
}

TEST_F(StandardSkyTest, RequirementsAreByCapability) {
  Requirements needed;
  const auto query = [&](CapabilityFlags wanted) {
    ContextDesc desc = contextDesc();
    desc.capabilities = wanted;
    return queryRequirements(desc, &needed);
  };
  EXPECT_EQ(query(kCapabilityBake), Status::Ok);
  EXPECT_TRUE(needed.deviceFeatures & kFeatureSynchronization2);
  EXPECT_EQ(needed.capabilities, kCapabilityBake);
  EXPECT_FALSE(needed.deviceFeatures & kFeatureDynamicRendering);
  EXPECT_EQ(query(kCapabilitySky), Status::Ok);
  EXPECT_TRUE(needed.deviceFeatures & kFeatureDynamicRendering);
  EXPECT_EQ(query(0), Status::Ok);
  EXPECT_EQ(needed.deviceFeatures, kFeatureDynamicRendering | kFeatureSynchronization2);
  EXPECT_EQ(needed.capabilities, kCapabilityBake | kCapabilitySky);
  EXPECT_EQ(needed.apiVersion, VK_API_VERSION_1_3);
  EXPECT_EQ(needed.features.geometryShader, VkBool32{VK_FALSE});
  EXPECT_EQ(query(1u << 9), Status::InvalidArgument);
}

TEST_F(StandardSkyTest, ABakeContextRefusesViews) {
  ContextDesc desc = contextDesc();
  desc.capabilities = kCapabilityBake;
  Context* made = nullptr;
  ASSERT_EQ(createContext(desc, &made), Status::Ok);
  Tables* empty = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &empty), Status::Ok);
  View* view = nullptr;
  ViewDesc viewDesc;
  viewDesc.sky = SkyMethod::Integrate;
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  EXPECT_EQ(createView(made, empty, viewDesc, &view), Status::Unsupported);
  EXPECT_TRUE(contains(lastDiagnostic(), "createView needs a context with kCapabilitySky"))
      << lastDiagnostic();
  destroyContext(made);
}

// A host that ships tables asks for the sky alone: it uploads, and nothing of the bake is made.
TEST_F(StandardSkyTest, ASkyContextTakesUploadsButDoesNotBake) {
  ContextDesc desc = contextDesc();
  desc.capabilities = kCapabilitySky;
  Context* made = nullptr;
  ASSERT_EQ(createContext(desc, &made), Status::Ok);
  Tables* empty = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &empty), Status::Ok)
      << lastDiagnostic();
  ResourceReport report;
  resourceReport(made, &report);
  EXPECT_EQ(report.pipelines, 0u);
  EXPECT_EQ(report.images, 4u);
  BakeProgress progress;
  run([&](VkCommandBuffer commands) {
    EXPECT_EQ(recordBake(empty, commands, 0, &progress), Status::Unsupported);
    return true;
  });
  EXPECT_TRUE(contains(lastDiagnostic(), "kCapabilityBake")) << lastDiagnostic();
  const ProbeQuery query;
  const headless::HostBuffer answers =
      device().createHostBuffer(kProbeAnswerBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, nullptr);
  run([&](VkCommandBuffer commands) {
    EXPECT_EQ(recordProbe(empty, commands, &query, 1, answers.buffer()), Status::Unsupported);
    return true;
  });
  destroyTables(empty);
  finishFrames(made);
  resourceReport(made, &report);
  EXPECT_EQ(report.bytes, 0u);
  destroyContext(made);
}

// Only views without a render pass need dynamicRendering.
TEST_F(StandardSkyTest, WithoutDynamicRenderingRenderPassesDraw) {
  ContextDesc desc = contextDesc();
  desc.enabled.deviceFeatures &= ~DeviceFeatureFlags{kFeatureDynamicRendering};
  Context* made = nullptr;
  ASSERT_EQ(createContext(desc, &made), Status::Ok) << lastDiagnostic();
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &baked), Status::Ok);
  bakeAll(device(), baked);
  View* view = nullptr;
  ViewDesc viewDesc;
  viewDesc.sky = SkyMethod::Integrate;
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  EXPECT_EQ(createView(made, baked, viewDesc, &view), Status::Unsupported);
  EXPECT_TRUE(contains(lastDiagnostic(), "dynamicRendering")) << lastDiagnostic();
  const FrameState draw =
      makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, 2.0, 0.0, 0.1, 0.0, 1.0),
               {std::sqrt(0.5), 0.0, std::sqrt(0.5)}, {24, 16});
  {
    TargetDesc targetDesc;
    targetDesc.extent = draw.viewport.extent;
    targetDesc.renderPass = true;
    Target target(device(), targetDesc);
    viewDesc.renderPass = target.renderPass();
    ASSERT_EQ(createView(made, baked, viewDesc, &view), Status::Ok) << lastDiagnostic();
    const Picture drawn = target.draw([&](VkCommandBuffer commands) {
      return testing::recordSky(view, commands, baked, draw) == Status::Ok;
    });
    EXPECT_EQ(drawn.data, picture(draw).data);
  }
  destroyView(view);
  destroyTables(baked);
  destroyContext(made);
}

TEST_F(StandardSkyTest, TableAndProbeArgumentsAreChecked) {
  Tables* made = nullptr;
  EXPECT_EQ(createTables(nullptr, preset("earth"), smallTables(), &made), Status::InvalidArgument);
  EXPECT_EQ(createTables(context(), preset("earth"), smallTables(), nullptr),
            Status::InvalidArgument);
  Parameters bad = preset("earth");
  bad.topRadius_m = bad.bottomRadius_m - 5.0;
  EXPECT_EQ(createTables(context(), bad, smallTables(), &made), Status::InvalidArgument);
  EXPECT_TRUE(contains(message(), "top_radius_m")) << message();
  bad = preset("earth");
  bad.mie.asymmetry = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(createTables(context(), bad, smallTables(), &made), Status::InvalidArgument);
  EXPECT_TRUE(contains(message(), "asymmetry")) << message();
  TableDesc odd = smallTables();
  odd.sizes.scatteringMu = 33;
  EXPECT_EQ(createTables(context(), preset("earth"), odd, &made), Status::InvalidArgument);
  EXPECT_TRUE(contains(message(), "33")) << message();
  EXPECT_EQ(made, nullptr);

  Tables* const baked = tables();
  const headless::HostBuffer answers =
      device().createHostBuffer(2 * kProbeAnswerBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, nullptr);
  ResourceReport before, after;
  resourceReport(context(), &before);
  run([&](VkCommandBuffer commands) {
    const auto refuses = [&](const ProbeQuery& query, const char* part) {
      const ProbeQuery queries[] = {ProbeQuery{}, query};
      EXPECT_EQ(recordProbe(baked, commands, queries, 2, answers.buffer()), Status::InvalidArgument)
          << part;
      EXPECT_TRUE(contains(message(), "ProbeQuery 1") && contains(message(), part)) << message();
    };
    ProbeQuery query;
    query.altitude_m = -3.0;
    refuses(query, "altitude_m = -3");
    query = {};
    query.zenith = 4.0;
    refuses(query, "zenith = 4");
    query = {};
    query.sunZenith = -0.5;
    refuses(query, "sunZenith = -0.5");
    query.kind = QueryKind::Irradiance;
    refuses(query, "sunZenith = -0.5");
    query = {};
    query.azimuth = std::numeric_limits<double>::infinity();
    refuses(query, "azimuth = inf");
    query = {};
    query.bounded = true;
    query.distance_m = std::numeric_limits<double>::quiet_NaN();
    refuses(query, "distance_m = ");
    query.distance_m = -1.0;
    refuses(query, "distance_m = -1");
    query.bounded = false;
    query.distance_m = 100.0;
    refuses(query, "distance_m = 100");
    query = {};
    query.light = 1;
    refuses(query, "light = 1");
    query = {};
    query.kind = static_cast<QueryKind>(2);
    refuses(query, "kind = 2");
    query = {};
    query.kind = QueryKind::Irradiance;
    query.zenith = 0.5;
    refuses(query, "zenith = 0.5");
    query.zenith = 0.0;
    query.azimuth = 0.25;
    refuses(query, "azimuth = 0.25");
    query.azimuth = 0.0;
    query.bounded = true;
    refuses(query, "bounded = 1");
    const ProbeQuery good;
    EXPECT_EQ(recordProbe(baked, commands, &good, 0, answers.buffer()), Status::InvalidArgument);
    EXPECT_EQ(recordProbe(baked, commands, nullptr, 1, answers.buffer()), Status::InvalidArgument);
    EXPECT_EQ(recordProbe(baked, commands, &good, 1, VK_NULL_HANDLE), Status::InvalidArgument);
    EXPECT_EQ(recordProbe(nullptr, commands, &good, 1, answers.buffer()), Status::InvalidArgument);
    return true;
  });
  resourceReport(context(), &after);
  EXPECT_EQ(after.dispatches, before.dispatches);
  EXPECT_EQ(after.bytes, before.bytes);
  EXPECT_EQ(answerQueries(baked, nullptr, 1, answers.data(), nullptr), Status::InvalidArgument);
  TablesInfo info;
  EXPECT_EQ(tablesInfo(nullptr, &info), Status::InvalidArgument);
  EXPECT_EQ(info.state, TablesState::Empty);
  message().clear();
  EXPECT_EQ(tablesInfo(baked, nullptr), Status::InvalidArgument);
  EXPECT_TRUE(contains(message(), "tablesInfo got a null argument")) << message();
}

// Two contexts on one device, several atmospheres on each, their slices interleaved in the same
// command buffers: every one answers as it does alone.
TEST_F(StandardSkyTest, ContextsAndAtmospheresDoNotMix) {
  const char* const names[] = {"earth", "mars", "earth-hazy"};
  ProbeQuery query;
  query.altitude_m = 1000.0;
  query.zenith = 1.3;
  query.sunZenith = 1.0;
  query.azimuth = 0.5;
  std::vector<double> alone;
  for (const char* name : names)
    alone.push_back(probeAll({query}, tables(name)).at(0).skyRadiance[2]);

  Context* contexts[2] = {};
  Tables* baked[6] = {};
  for (size_t i = 0; i < 6; ++i) {
    Context*& on = contexts[i % 2];
    if (on == nullptr) {
      ASSERT_EQ(createContext(contextDesc(), &on), Status::Ok);
    }
    ASSERT_EQ(createTables(on, preset(names[i % 3]), smallTables(), &baked[i]), Status::Ok);
  }
  bool done = false;
  while (!done) {
    run([&](VkCommandBuffer commands) {
      done = true;
      for (Tables* one : baked) {
        BakeProgress progress;
        EXPECT_EQ(recordBake(one, commands, 20000000, &progress), Status::Ok);
        done = done && progress.done;
      }
      return true;
    });
  }
  for (size_t i = 0; i < 6; ++i) {
    const auto answers = probe(device(), baked[i], {query});
    EXPECT_EQ(answers.at(0).skyRadiance[2], alone[i % 3]) << i;
    destroyTables(baked[i]);
  }
  for (Context* one : contexts) destroyContext(one);
  EXPECT_TRUE(diagnostics().empty()) << lastDiagnostic();
}

}  // namespace
}  // namespace alpenglow::testing
