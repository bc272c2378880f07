// What --script's step "report" writes: for tests and for figures in docs.
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app.h"
#include "common/failure.h"
#include "parameters.h"

namespace alpenglow::view {
namespace {

using Json = nlohmann::ordered_json;

double residentBytes() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

Json timesOf(std::vector<float> times_ms) {
  if (times_ms.empty()) return nullptr;
  std::sort(times_ms.begin(), times_ms.end());
  const auto at = [&](double share) {
    return times_ms[static_cast<size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  return {{"frames", times_ms.size()},
          {"median_ms", at(0.5)},
          {"p95_ms", at(0.95)},
          {"most_ms", times_ms.back()}};
}

}  // namespace

void App::report(const std::string& path) {
  ResourceReport resources;
  resourceReport(host_.context, &resources);
  Json json;
  json["device"] = host_.device->name();
  json["times"] = timesOf(std::exchange(frameTimes_ms_, {}));
  Json& passes = json["passes_ms"];
  for (const auto& [name, history] : timer_.passes()) passes[name] = history.last;
  json["window"] = {state_.scene.width, state_.scene.height};
  json["drawn"] = {drawn_.width, drawn_.height};
  json["memory"] = {{"resident_bytes", residentBytes()},
                    {"device_bytes", resources.bytes},
                    {"images", resources.images},
                    {"buffers", resources.buffers}};
  json["pipelines"] = resources.pipelines;
  json["exposure"] = state_.scene.exposure.value_or(exposure_);
  Json& numbers = json["parameters"];
  io::Scene scene = state_.scene;
  for (const Parameter& parameter : parameters()) {
    if (parameter.find(scene) != nullptr) numbers[parameter.name] = parameter.get(scene);
  }
  numbers["turbidity"] = turbidity(scene.atmosphere);
  json["panel"] = state_.panel;
  json["help"] = state_.help;
  json["message"] = state_.message;
  json["caption"] = caption_;
  json["refusal"] = stage_.refusal();
  if (host_.shaders) json["compiler"] = host_.shaders->error();
  json["scene"] = Json::parse(io::formatScene(state_.scene));
  samples::writeText(path, json.dump(2) + "\n");
}

}  // namespace alpenglow::view
