#include "parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace alpenglow::view {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

using Find = std::function<double*(io::Scene&)>;

/// Collects parameters of one group after the other.
class List {
 public:
  std::vector<Parameter> all;

  void group(const char* name, bool ofMedium) {
    group_ = name;
    ofMedium_ = ofMedium;
  }
  void add(const char* field, const char* unit, double least, double most, Find find,
           double factor = 1.0, bool logarithmic = false) {
    const std::string prefix = group_[0] == '\0' ? "" : std::string(group_) + ".";
    all.push_back({group_, prefix + field, unit, least, most, logarithmic, ofMedium_,
                   std::move(find), factor});
  }
  void logarithmic(const char* field, const char* unit, double least, double most, Find find) {
    add(field, unit, least, most, std::move(find), 1.0, true);
  }
  void spectrum(const char* field, const char* unit, double most, bool isLogarithmic,
                const std::function<Spectrum*(io::Scene&)>& find) {
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      const auto channel = [find, i](io::Scene& scene) {
        Spectrum* found = find(scene);
        return found != nullptr ? &found->value[i] : nullptr;
      };
      add((field + ("." + std::to_string(i))).c_str(), unit, 0.0, most, channel, 1.0,
          isLogarithmic);
    }
  }

 private:
  const char* group_ = "";
  bool ofMedium_ = false;
};

template <typename Part, typename Field>
Find inPart(Part Parameters::*part, Field Part::*field) {
  return [part, field](io::Scene& scene) -> double* {
    Part& found = scene.atmosphere.*part;
    return found.present ? &(found.*field) : nullptr;
  };
}
template <typename Part>
std::function<Spectrum*(io::Scene&)> spectrumIn(Part Parameters::*part, Spectrum Part::*field) {
  return [part, field](io::Scene& scene) -> Spectrum* {
    Part& found = scene.atmosphere.*part;
    return found.present ? &(found.*field) : nullptr;
  };
}

void addMedium(List* list) {
  list->group("", true);
  list->logarithmic("bottom_radius_m", "m", 1e4, 1e8,
                    [](io::Scene& s) { return &s.atmosphere.bottomRadius_m; });
  list->logarithmic("top_radius_m", "m", 1e4, 1e8,
                    [](io::Scene& s) { return &s.atmosphere.topRadius_m; });
  list->group("rayleigh", true);
  using R = RayleighParameters;
  list->spectrum("scattering_per_m", "1/m", 1e-3, true,
                 spectrumIn(&Parameters::rayleigh, &R::scattering_per_m));
  list->logarithmic("scale_height_m", "m", 100.0, 1e5,
                    inPart(&Parameters::rayleigh, &R::scaleHeight_m));
  list->group("mie", true);
  using M = MieParameters;
  list->spectrum("scattering_per_m", "1/m", 1e-2, true,
                 spectrumIn(&Parameters::mie, &M::scattering_per_m));
  list->spectrum("extinction_per_m", "1/m", 1e-2, true,
                 spectrumIn(&Parameters::mie, &M::extinction_per_m));
  list->logarithmic("scale_height_m", "m", 50.0, 1e5, inPart(&Parameters::mie, &M::scaleHeight_m));
  list->add("asymmetry", "", -0.999, 0.999, inPart(&Parameters::mie, &M::asymmetry));
  list->group("absorption", true);
  using A = AbsorptionParameters;
  list->spectrum("extinction_per_m", "1/m", 1e-4, true,
                 spectrumIn(&Parameters::absorption, &A::extinction_per_m));
  list->add("center_m", "m", 0.0, 1e5, inPart(&Parameters::absorption, &A::center_m));
  list->logarithmic("half_width_m", "m", 100.0, 1e5,
                    inPart(&Parameters::absorption, &A::halfWidth_m));
  list->group("", true);
  list->spectrum("ground_albedo", "", 1.0, false,
                 [](io::Scene& s) { return &s.atmosphere.groundAlbedo; });
  list->spectrum("solar_irradiance", "W/m2/nm, or any", 10.0, false,
                 [](io::Scene& s) { return &s.atmosphere.solarIrradiance; });
  list->add(
      "sun_angular_radius_deg", "deg", 0.0, 10.0,
      [](io::Scene& s) { return &s.atmosphere.sunAngularRadius; }, kDegrees);
}

void addScene(List* list) {
  list->group("sun", false);
  list->add(
      "elevation_deg", "deg", -90.0, 90.0, [](io::Scene& s) { return &s.sun.elevation; }, kDegrees);
  list->add(
      "azimuth_deg", "deg", 0.0, 360.0, [](io::Scene& s) { return &s.sun.azimuth; }, kDegrees);
  list->add(
      "disc_radius_deg", "deg", 0.0, 10.0, [](io::Scene& s) { return &s.sun.discRadius; },
      kDegrees);
  list->group("camera", false);
  const auto camera = [list](const char* field, double least, double most,
                             double io::SceneCamera::*member) {
    list->add(
        field, "deg", least, most, [member](io::Scene& s) { return &(s.camera.*member); },
        kDegrees);
  };
  list->logarithmic("altitude_m", "m", 1.0, 1e8, [](io::Scene& s) { return &s.camera.altitude_m; });
  camera("latitude_deg", -90.0, 90.0, &io::SceneCamera::latitude);
  camera("longitude_deg", -180.0, 180.0, &io::SceneCamera::longitude);
  camera("heading_deg", 0.0, 360.0, &io::SceneCamera::heading);
  camera("pitch_deg", -90.0, 90.0, &io::SceneCamera::pitch);
  camera("roll_deg", -180.0, 180.0, &io::SceneCamera::roll);
  list->add(
      "fov_deg", "deg", 1.0, 170.0,
      [](io::Scene& s) { return s.camera.orthographicHeight_m ? nullptr : &s.camera.fov; },
      kDegrees);
  list->group("stars", false);
  list->add("sidereal_hours", "h", 0.0, 24.0,
            [](io::Scene& s) { return s.stars ? &s.stars->siderealHours : nullptr; });
}

double depthOf(double coefficient_per_m, double scaleHeight_m) {
  return coefficient_per_m * scaleHeight_m;
}

}  // namespace

void Parameter::set(io::Scene* scene, double value) const {
  double* number = find(*scene);
  if (number == nullptr) return;
  *number = value / factor;
  // Scattering of aerosols is at most their extinction.
  MieParameters& mie = scene->atmosphere.mie;
  const bool extinction = name.starts_with("mie.extinction");
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    double& scattered = mie.scattering_per_m[i];
    double& lost = mie.extinction_per_m[i];
    if (scattered > lost) (extinction ? scattered : lost) = extinction ? lost : scattered;
  }
}

std::span<const Parameter> parameters() {
  static const List kList = [] {
    List list;
    addMedium(&list);
    addScene(&list);
    return list;
  }();
  return kList.all;
}

const Parameter* findParameter(const std::string& name) {
  const std::span<const Parameter> all = parameters();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string whyInvalid(const io::Scene& scene) {
  std::string why;
  const DiagnosticSink sink = {[](void* user, const Diagnostic& diagnostic) {
                                 *static_cast<std::string*>(user) = diagnostic.message;
                               },
                               &why};
  if (validate(scene.atmosphere, sink) != Status::Ok) return why;
  for (const Parameter& parameter : parameters()) {
    if (parameter.ofMedium) continue;
    io::Scene copy = scene;
    const double* found = parameter.find(copy);
    if (found == nullptr) continue;
    const double value = *found * parameter.factor;
    const bool free = parameter.name == "stars.sidereal_hours" ||
                      parameter.name == "camera.altitude_m" || parameter.most == 360.0;
    if (std::isfinite(value) && (free || (value >= parameter.least && value <= parameter.most))) {
      continue;
    }
    char text[160];
    std::snprintf(text, sizeof text, "%s is %g, but a number from %g to %g is expected.",
                  parameter.name.c_str(), value, parameter.least, parameter.most);
    return text;
  }
  return "";
}

double turbidity(const Parameters& p) {
  if (!p.rayleigh.present || !p.mie.present) return 1.0;
  const double air = depthOf(p.rayleigh.scattering_per_m[1], p.rayleigh.scaleHeight_m);
  return 1.0 + depthOf(p.mie.extinction_per_m[1], p.mie.scaleHeight_m) / air;
}

void setTurbidity(Parameters* p, double wanted) {
  const double now = turbidity(*p);
  if (!(now > 1.0) || !std::isfinite(now)) return;
  scaleMie(p, std::max(wanted - 1.0, 1e-3) / (now - 1.0));
}

void scaleRayleigh(Parameters* p, double factor) {
  for (double& value : p->rayleigh.scattering_per_m.value) value *= factor;
}

void scaleMie(Parameters* p, double factor) {
  for (double& value : p->mie.scattering_per_m.value) value *= factor;
  for (double& value : p->mie.extinction_per_m.value) value *= factor;
}

}  // namespace alpenglow::view
