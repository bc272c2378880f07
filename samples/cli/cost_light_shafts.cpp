#include "cost_light_shafts.h"

#include <algorithm>
#include <cmath>

#include "common/sample_files.h"
#include "common/scene_plan.h"
#include "failure.h"
#include "picture.h"

namespace alpenglow::cli {
namespace {

constexpr const char* kScene = "sunrise_shafts";
constexpr uint32_t kReferenceSamples = 1024;

struct Method {
  io::SceneLightShafts method;
  uint32_t stepCount;
};

std::string nameOf(const Method& method) {
  constexpr const char* kNames[] = {"auto", "paper", "exact", "march", "off"};
  const std::string name = kNames[static_cast<size_t>(method.method)];
  return method.stepCount == 0 ? name : name + " " + std::to_string(method.stepCount);
}

struct Measured {
  io::LinearImage picture;
  std::vector<double> times_ms;  ///< Of frames, the terrain's own shading aside.
  io::Report report;
};

/// As the rest of the report: user CPU on software devices, else by timestamps.
bool isSoftware(Session& session) {
  VkPhysicalDeviceProperties properties = {};
  session.instanceFunction<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(
      session.device().physicalDevice(), &properties);
  return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

double frameSeconds(const io::Report& report, bool software) {
  double sum = 0.0;
  for (const io::ReportPass& pass : report.passes) {
    for (const char* name :
         {"sky-view LUT", "shadow map", "light shafts", "aerial perspective", "sky"})
      if (pass.name == name && (software || !pass.gpuSeconds)) {
        sum += pass.cpuSeconds.value_or(0.0);
      } else if (pass.name == name) {
        sum += *pass.gpuSeconds;
      }
  }
  return sum;
}

Measured draw(io::Scene scene, const Method& method, const std::string& device, uint32_t frames) {
  scene.shafts = method.method;
  scene.lightShaftStepCount = std::max(method.stepCount, 1u);
  RenderArguments arguments;
  LightShaftChoice choice = chooseLightShafts(arguments, scene, Solver::Moments);
  const Plan plan = samples::planScene(scene, {});
  const SceneryFiles files = readScenery(scene);
  Session session(device,
                  plan.capabilities | choice.requirements() | kCapabilityBake | kCapabilitySky |
                      kCapabilityAerialPerspective,
                  choice.wishes());
  const PictureTarget target = createPictureTarget(&session, scene.width, scene.height);
  LightShaftDesc shafts = describeLightShafts(choice, session);
  TableRequest request;
  request.desc = plan.tables;
  const ReadyTables ready = obtainTables(&session, scene.atmosphere, std::move(request));
  Scenery scenery(&session, scene, files, ready, shafts, plan);
  Measured measured;
  // The first compiles the shaders.
  Painter painter(&session, nullptr, ready, plan, &scenery);
  measured.picture = painter.draw(scene, ready.tables.get(), target);
  const bool software = isSoftware(session);
  for (uint32_t i = 0; i < frames; ++i) {
    const double before = frameSeconds(session.report(), software);
    painter.draw(scene, ready.tables.get(), target);
    measured.times_ms.push_back(1e3 * (frameSeconds(session.report(), software) - before));
  }
  measured.report = session.report();
  return measured;
}

cost::BandError errorOf(const io::LinearImage& image, const io::LinearImage& reference) {
  std::vector<float> sorted = reference.pixels;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const double floor = 0.02 * static_cast<double>(sorted[sorted.size() / 2]);
  std::vector<double> errors;
  for (size_t i = 0; i + 2 < image.pixels.size(); i += 3) {
    double worst = 0.0;
    for (size_t c = i; c < i + 3; ++c) {
      const double wanted = static_cast<double>(reference.pixels[c]);
      const double off = std::abs(static_cast<double>(image.pixels[c]) - wanted);
      worst = std::max(worst, off / std::max(wanted, floor));
    }
    errors.push_back(worst);
  }
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() * 95 / 100], errors.back(), static_cast<uint32_t>(errors.size())};
}

cost::Row rowNamed(const std::string& name, const io::Scene& scene) {
  cost::Row row;
  row.sweep = "shafts";
  row.name = name;
  row.family = "moments";
  row.detail = std::string("scene ") + kScene + " of " + std::to_string(scene.width) + " x " +
               std::to_string(scene.height) +
               ", sky-view LUT, light shafts, aerial perspective and sky";
  return row;
}

cost::Row rowOf(const Method& method, const io::Scene& scene, const Measured& measured,
                const io::LinearImage& reference) {
  constexpr uint32_t kLow = 1;  // the sun of the scene is up, and low
  cost::Row row = rowNamed(nameOf(method), scene);
  row.note =
      "errors are a picture's, against " + std::to_string(kReferenceSamples) + " samples a ray";
  row.frame_ms[0] = cost::timingOf(measured.times_ms);
  row.bytes = measured.report.totals.bytes;
  row.peakBytes = row.bytes;
  row.errors[kLow] = errorOf(measured.picture, reference);
  return row;
}

}  // namespace

io::Result<std::vector<cost::Row>> measureLightShafts(const std::string& device, bool quick) {
  using Rows = io::Result<std::vector<cost::Row>>;
  try {
    io::Scene scene = take(io::readScene(samples::findSample("scenes", kScene)));
    scene.width = quick ? 320 : 640;
    scene.height = quick ? 180 : 360;
    scene.albedoMap.clear();
    std::vector<Method> methods = {{io::SceneLightShafts::Off, 0},
                                   {io::SceneLightShafts::LightVolume, 0},
                                   {io::SceneLightShafts::ShadowVolume, 0},
                                   {io::SceneLightShafts::RayMarch, 32}};
    for (const uint32_t stepCount : {8u, 16u, 64u, 128u})
      if (!quick) methods.push_back({io::SceneLightShafts::RayMarch, stepCount});
    const io::LinearImage reference =
        draw(scene, {io::SceneLightShafts::RayMarch, kReferenceSamples}, device, 0).picture;
    std::vector<cost::Row> rows;
    for (const Method& method : methods) {
      try {
        const Measured measured = draw(scene, method, device, quick ? 2 : 3);
        rows.push_back(rowOf(method, scene, measured, reference));
      } catch (const Failure& failure) {  // such as a device without what the method needs
        rows.push_back(rowNamed(nameOf(method), scene));
        rows.back().note = failure.what();
      }
    }
    return rows;
  } catch (const Failure& failure) {
    return Rows::failure(failure.what());
  } catch (const samples::Error& error) {
    return Rows::failure(error.what());
  }
}

}  // namespace alpenglow::cli
