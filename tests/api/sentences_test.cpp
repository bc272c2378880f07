// Every failing call says one sentence: those that need no device.
#include <alpenglow/camera.h>
#include <alpenglow/mesh/adjacency.h>
#include <alpenglow/mesh/terrain.h>
#include <alpenglow/plan.h>
#include <alpenglow/reference/reference.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/engine/mock_vulkan.h"
#include "tests/parameters/heard.h"

namespace alpenglow {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Parameters earth() { return testing::allPresets()[0].parameters; }

struct Call {
  const char* name;
  const char* part;  ///< Of the sentence.
  Status (*make)(const DiagnosticSink& sink);
};

ContextDesc contextDesc(const DiagnosticSink& sink) {
  const engine::DeviceDesc device = testing::MockVulkan::current().deviceDesc();
  ContextDesc desc;
  desc.instance = device.instance;
  desc.physicalDevice = device.physicalDevice;
  desc.device = device.device;
  desc.getInstanceProcAddr = device.getInstanceProcAddr;
  desc.enabled.apiVersion = VK_API_VERSION_1_3;
  desc.enabled.deviceFeatures = kFeatureSynchronization2 | kFeatureDynamicRendering;
  desc.diagnostics = sink;
  return desc;
}

Status create(const ContextDesc& desc) {
  Context* context = nullptr;
  const Status status = createContext(desc, &context);
  EXPECT_EQ(context, nullptr);
  return status;
}

template <typename Spoil>
Status createSpoilt(const DiagnosticSink& sink, const Spoil& spoil) {
  ContextDesc desc = contextDesc(sink);
  spoil(&desc);
  return create(desc);
}

template <typename Spoil>
Status querySpoilt(const DiagnosticSink& sink, const Spoil& spoil) {
  ContextDesc desc = contextDesc(sink);
  spoil(&desc);
  Requirements found;
  return queryRequirements(desc, &found);
}

using Sink = const DiagnosticSink&;
const float kHeights[4] = {};

TerrainDesc terrain() {
  TerrainDesc desc;
  desc.field = {kHeights, 2, 2, {100.0, 100.0}};
  desc.radius_m = 6.36e6;
  return desc;
}

ProbeQuery badQuery() {
  ProbeQuery query;
  query.sunZenith = 4.0;
  return query;
}

constexpr double kIdentity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// cameraFromMatrices with one element of a good pair changed.
Status matricesSpoilt(Sink sink, bool world, int element, double value,
                      DepthConvention depth = DepthConvention::Reversed) {
  double fromView[16], clip[16] = {};
  std::copy_n(kIdentity, 16, fromView);
  clip[0] = 1.0, clip[5] = -2.0, clip[11] = -1.0, clip[14] = 0.5;  // Infinitely far, reversed.
  (world ? fromView : clip)[element] = value;
  Camera camera;
  camera.fov = 7.0;
  const Status status = cameraFromMatrices(fromView, clip, depth, false, &camera, sink);
  EXPECT_EQ(camera.fov, 7.0) << "A refused camera has changed.";
  return status;
}

const Call kCalls[] = {
    // camera.h
    {"cameraFromMatrices", "null argument",
     [](Sink sink) {
       return cameraFromMatrices(kIdentity, nullptr, DepthConvention::Standard, false, nullptr,
                                 sink);
     }},
    {"cameraFromMatrices", "worldFromView that is not finite",
     [](Sink sink) { return matricesSpoilt(sink, true, 5, kNaN); }},
    {"cameraFromMatrices", "clipFromView that is not finite",
     [](Sink sink) { return matricesSpoilt(sink, false, 14, kNaN); }},
    {"cameraFromMatrices", "scale or shear",
     [](Sink sink) { return matricesSpoilt(sink, true, 0, 1.1); }},
    {"cameraFromMatrices", "neither a perspective",
     [](Sink sink) { return matricesSpoilt(sink, false, 11, 1.0); }},
    {"cameraFromMatrices", "mirrors",
     [](Sink sink) { return matricesSpoilt(sink, false, 5, 2.0); }},
    {"cameraFromMatrices", "with a shear",
     [](Sink sink) { return matricesSpoilt(sink, false, 4, 0.5); }},
    {"cameraFromMatrices", "oblique",
     [](Sink sink) { return matricesSpoilt(sink, false, 2, 0.5); }},
    {"cameraFromMatrices", "off-centre",
     [](Sink sink) { return matricesSpoilt(sink, false, 8, 0.5); }},
    {"cameraFromMatrices", "DepthConvention",
     [](Sink sink) { return matricesSpoilt(sink, false, 14, 0.5, DepthConvention::Standard); }},
    // context.h
    {"queryRequirements", "requirements",
     [](Sink sink) { return queryRequirements(contextDesc(sink), nullptr); }},
    {"queryRequirements", "ContextDesc::capabilities is 512",
     [](Sink sink) { return querySpoilt(sink, [](ContextDesc* d) { d->capabilities = 512; }); }},
    {"queryRequirements", "instance",
     [](Sink sink) {
       return querySpoilt(sink, [](ContextDesc* d) { d->instance = VK_NULL_HANDLE; });
     }},
    {"queryRequirements", "physicalDevice",
     [](Sink sink) {
       return querySpoilt(sink, [](ContextDesc* d) { d->physicalDevice = VK_NULL_HANDLE; });
     }},
    {"queryRequirements", "getInstanceProcAddr",
     [](Sink sink) {
       return querySpoilt(sink, [](ContextDesc* d) { d->getInstanceProcAddr = nullptr; });
     }},
    {"queryRequirements", "geometryShader",
     [](Sink sink) {
       return querySpoilt(sink, [](ContextDesc* d) { d->capabilities = kCapabilityShadowVolumes; });
     }},
    {"createContext", "context",
     [](Sink sink) { return createContext(contextDesc(sink), nullptr); }},
    {"createContext", "ContextDesc::capabilities is 512",
     [](Sink sink) { return createSpoilt(sink, [](ContextDesc* d) { d->capabilities = 512; }); }},
    {"createContext", "ContextDesc::instance is null",
     [](Sink sink) {
       return createSpoilt(sink, [](ContextDesc* d) { d->instance = VK_NULL_HANDLE; });
     }},
    {"createContext", "ContextDesc::physicalDevice is null",
     [](Sink sink) {
       return createSpoilt(sink, [](ContextDesc* d) { d->physicalDevice = VK_NULL_HANDLE; });
     }},
    {"createContext", "ContextDesc::device is null",
     [](Sink sink) {
       return createSpoilt(sink, [](ContextDesc* d) { d->device = VK_NULL_HANDLE; });
     }},
    {"createContext", "ContextDesc::getInstanceProcAddr is null",
     [](Sink sink) {
       return createSpoilt(sink, [](ContextDesc* d) { d->getInstanceProcAddr = nullptr; });
     }},
    {"createContext", "synchronization2",
     [](Sink sink) {
       return createSpoilt(sink, [](ContextDesc* d) { d->enabled.deviceFeatures = 0; });
     }},
    {"createContext", "Vulkan 1.3",
     [](Sink sink) {
       return createSpoilt(sink, [](ContextDesc* d) { d->enabled.apiVersion = 0; });
     }},
    {"createContext", "allocate",
     [](Sink sink) {
       return createSpoilt(
           sink, [](ContextDesc* d) { d->memory.free = [](void*, const MemoryRange&) {}; });
     }},
    {"createContext", "queueFamilies",
     [](Sink sink) { return createSpoilt(sink, [](ContextDesc* d) { d->queueFamilyCount = 2; }); }},
    // parameters.h
    {"findPreset", "earth-clear",
     [](Sink sink) {
       Parameters p;
       return findPreset("venus", &p, sink);
     }},
    {"findPreset", "no name",
     [](Sink sink) {
       Parameters p;
       return findPreset(nullptr, &p, sink);
     }},
    {"findPreset", "parameters", [](Sink sink) { return findPreset("earth", nullptr, sink); }},
    {"validate", "bottom_radius_m", [](Sink sink) { return validate({}, sink); }},
    // plan.h
    {"makePlan", "the plan", [](Sink sink) { return makePlan(earth(), {}, nullptr, sink); }},
    {"makePlan", "bottom_radius_m",
     [](Sink sink) {
       Plan plan;
       return makePlan({}, {}, &plan, sink);
     }},
    {"makePlan", "errorTarget is 2",
     [](Sink sink) {
       Plan plan;
       PlanRequest request;
       request.errorTarget = 2.0;
       return makePlan(earth(), request, &plan, sink);
     }},
    {"makePlan", "altitudeTo_m is nan",
     [](Sink sink) {
       Plan plan;
       PlanRequest request;
       request.altitudeTo_m = kNaN;
       return makePlan(earth(), request, &plan, sink);
     }},
    {"makePlan", "visible is 32",
     [](Sink sink) {
       Plan plan;
       PlanRequest request;
       request.visible = 32;
       return makePlan(earth(), request, &plan, sink);
     }},
    {"makePlan", "orders is 10000000",
     [](Sink sink) {
       Plan plan;
       PlanRequest request;
       request.tables.orders = 10'000'000;
       return makePlan(earth(), request, &plan, sink);
     }},
    // mesh/adjacency.h
    {"buildAdjacency", "MeshView::indices",
     [](Sink sink) {
       MeshView mesh;
       mesh.indexCount = 3;
       return buildAdjacency(mesh, nullptr, nullptr, sink);
     }},
    // terrain.h
    {"terrainSize", "the size", [](Sink sink) { return terrainSize(terrain(), nullptr, sink); }},
    {"terrainSize", "height field",
     [](Sink sink) {
       TerrainSize size;
       return terrainSize({}, &size, sink);
     }},
    {"buildTerrain", "height field",
     [](Sink sink) { return buildTerrain({}, nullptr, nullptr, nullptr, sink); }},
    {"buildTerrain", "null",
     [](Sink sink) { return buildTerrain(terrain(), nullptr, nullptr, nullptr, sink); }},
    // reference.h
    {"referenceSingleScattering", "the answer",
     [](Sink sink) { return referenceSingleScattering(earth(), {}, nullptr, sink); }},
    {"referenceSingleScattering", "bottom_radius_m",
     [](Sink sink) {
       ReferenceAnswer answer;
       return referenceSingleScattering({}, {}, &answer, sink);
     }},
    {"referenceSingleScattering", "ProbeQuery::sunZenith is 4",
     [](Sink sink) {
       ReferenceAnswer answer;
       return referenceSingleScattering(earth(), badQuery(), &answer, sink);
     }},
    {"createReference", "the reference",
     [](Sink sink) { return createReference(earth(), nullptr, sink); }},
    {"createReference", "bottom_radius_m",
     [](Sink sink) {
       Reference* made = nullptr;
       return createReference({}, &made, sink);
     }},
    {"evaluateReference", "the reference",
     [](Sink sink) {
       ReferenceAnswer answer;
       return evaluateReference(static_cast<const Reference*>(nullptr), {}, {}, &answer, sink);
     }},
    {"evaluateReference", "the answer",
     [](Sink sink) { return evaluateReference(earth(), {}, {}, nullptr, sink); }},
    {"evaluateReference", "ProbeQuery::sunZenith is 4",
     [](Sink sink) {
       ReferenceAnswer answer;
       return evaluateReference(earth(), badQuery(), {}, &answer, sink);
     }},
    {"evaluateReference", "ReferenceOptions::targetError is nan",
     [](Sink sink) {
       ReferenceAnswer answer;
       ReferenceOptions options;
       options.targetError = kNaN;
       return evaluateReference(earth(), {}, options, &answer, sink);
     }},
};

TEST(Sentences, EveryFailingCallSaysOne) {
  const testing::MockVulkan mock;
  for (const Call& call : kCalls) {
    testing::Heard heard;
    const Status status = call.make(heard.sink());
    EXPECT_NE(status, Status::Ok) << call.name << ", " << call.part;
    EXPECT_EQ(heard.count, 1) << call.name << ", " << call.part;
    EXPECT_EQ(heard.severity, Severity::Error) << call.name;
    EXPECT_EQ(heard.status, status) << call.name;
    EXPECT_NE(heard.sentence.find(call.part), std::string::npos)
        << call.name << ": " << heard.sentence;
    ASSERT_FALSE(heard.sentence.empty()) << call.name;
    EXPECT_EQ(heard.sentence.back(), '.') << heard.sentence;
    EXPECT_EQ(call.make({}), status) << call.name << " where nobody listens";
  }
}

}  // namespace
}  // namespace alpenglow
