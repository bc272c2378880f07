// Every structure is taken apart by a structured binding, so that a new field doesn't compile until
// it is compared, too.
#include "scene_compare.h"

#include <bit>
#include <cmath>
#include <cstdio>

namespace alpenglow::test {
namespace {

using namespace io;

class Comparison {
 public:
  explicit Comparison(uint64_t angleSteps) : angleSteps_(angleSteps) {}
  const std::string& first() const { return first_; }

  void number(const std::string& name, double a, double b) { within(name, a, b, 0); }
  void angle(const std::string& name, double a, double b) { within(name, a, b, angleSteps_); }
  void text(const std::string& name, const std::string& a, const std::string& b) {
    if (a != b) differ(name, a, b);
  }
  template <typename T>  // Of whole numbers, enumerations and booleans.
  void whole(const std::string& name, T a, T b) {
    if (a != b) differ(name, shown(a), shown(b));
  }
  template <typename T, typename Same>
  void optional(const std::string& name, const std::optional<T>& a, const std::optional<T>& b,
                Same same) {
    whole(name + " given", a.has_value(), b.has_value());
    if (a && b) same(name, *a, *b);
  }
  void spectrum(const std::string& name, const Spectrum& a, const Spectrum& b) {
    for (uint32_t i = 0; i < kSpectrumSize; ++i) number(name, a[i], b[i]);
  }

 private:
  template <typename T>
  static std::string shown(T value) {
    return std::to_string(static_cast<uint64_t>(value));
  }
  void within(const std::string& name, double a, double b, uint64_t steps) {
    double reached = a;
    for (uint64_t i = 0; i < steps && reached != b; ++i) reached = std::nextafter(reached, b);
    if (std::bit_cast<uint64_t>(reached) == std::bit_cast<uint64_t>(b)) return;
    char texts[2][40];
    std::snprintf(texts[0], sizeof texts[0], "%.17g", a);
    std::snprintf(texts[1], sizeof texts[1], "%.17g", b);
    differ(name, texts[0], texts[1]);
  }
  void differ(const std::string& name, const std::string& a, const std::string& b) {
    if (first_.empty()) first_ = name + " is " + a + " and " + b;
  }

  uint64_t angleSteps_;
  std::string first_;
};

void compareMedium(Comparison* c, const Parameters& a, const Parameters& b) {
  const auto& [bottom, top, waves, rayleigh, mie, absorption, albedo, sun, radius] = a;
  c->number("bottomRadius", bottom, b.bottomRadius_m);
  c->number("topRadius", top, b.topRadius_m);
  c->spectrum("wavelengths", waves, b.wavelengths_nm);
  const auto& [rayleighPresent, rayleighScattering, rayleighHeight] = rayleigh;
  c->whole("rayleigh", rayleighPresent, b.rayleigh.present);
  c->spectrum("rayleigh.scattering", rayleighScattering, b.rayleigh.scattering_per_m);
  c->number("rayleigh.scaleHeight", rayleighHeight, b.rayleigh.scaleHeight_m);
  const auto& [miePresent, mieScattering, mieExtinction, mieHeight, asymmetry] = mie;
  c->whole("mie", miePresent, b.mie.present);
  c->spectrum("mie.scattering", mieScattering, b.mie.scattering_per_m);
  c->spectrum("mie.extinction", mieExtinction, b.mie.extinction_per_m);
  c->number("mie.scaleHeight", mieHeight, b.mie.scaleHeight_m);
  c->number("mie.asymmetry", asymmetry, b.mie.asymmetry);
  const auto& [absorptionPresent, absorptionExtinction, center, halfWidth] = absorption;
  c->whole("absorption", absorptionPresent, b.absorption.present);
  c->spectrum("absorption.extinction", absorptionExtinction, b.absorption.extinction_per_m);
  c->number("absorption.center", center, b.absorption.center_m);
  c->number("absorption.halfWidth", halfWidth, b.absorption.halfWidth_m);
  c->spectrum("groundAlbedo", albedo, b.groundAlbedo);
  c->spectrum("solarIrradiance", sun, b.solarIrradiance);
  c->angle("sunAngularRadius", radius, b.sunAngularRadius);
}

void compareView(Comparison* c, const SceneSun& sunA, const SceneSun& sunB, const SceneCamera& a,
                 const SceneCamera& b) {
  const auto& [elevation, azimuth, discRadius] = sunA;
  c->angle("sun.elevation", elevation, sunB.elevation);
  c->angle("sun.azimuth", azimuth, sunB.azimuth);
  c->angle("sun.discRadius", discRadius, sunB.discRadius);
  const auto& [latitude, longitude, altitude, heading, pitch, roll, projection, fov, height] = a;
  c->angle("camera.latitude", latitude, b.latitude);
  c->angle("camera.longitude", longitude, b.longitude);
  c->number("camera.altitude", altitude, b.altitude_m);
  c->angle("camera.heading", heading, b.heading);
  c->angle("camera.pitch", pitch, b.pitch);
  c->angle("camera.roll", roll, b.roll);
  c->whole("camera.projection", projection, b.projection);
  c->angle("camera.fov", fov, b.fov);
  c->optional("camera.orthographicHeight", height, b.orthographicHeight_m,
              [c](auto name, double x, double y) { c->number(name, x, y); });
}

void compareTerrain(Comparison* c, const SceneTerrain& a, const SceneTerrain& b) {
  const auto& [map, perPixel, perUnit, scale, base, fade, latitude, longitude, heading, albedo,
               albedoMap] = a;
  c->text("terrain.heightMap", map, b.heightMap);
  c->number("terrain.metersPerPixel[0]", perPixel[0], b.metersPerPixel[0]);
  c->number("terrain.metersPerPixel[1]", perPixel[1], b.metersPerPixel[1]);
  c->number("terrain.metersPerUnit", perUnit, b.metersPerUnit);
  c->number("terrain.heightScale", scale, b.heightScale);
  c->number("terrain.base", base, b.base_m);
  c->number("terrain.fade", fade, b.fade_m);
  c->angle("terrain.latitude", latitude, b.latitude);
  c->angle("terrain.longitude", longitude, b.longitude);
  c->angle("terrain.heading", heading, b.heading);
  c->spectrum("terrain.albedo", albedo, b.albedo);
  c->text("terrain.albedoMap", albedoMap, b.albedoMap);
}

void compareBalloon(Comparison* c, const SceneBalloon& a, const SceneBalloon& b) {
  const auto& [latitude, longitude, altitude, radius, color, opacity] = a;
  c->angle("balloon.latitude", latitude, b.latitude);
  c->angle("balloon.longitude", longitude, b.longitude);
  c->number("balloon.altitude", altitude, b.altitude_m);
  c->number("balloon.radius", radius, b.radius_m);
  c->spectrum("balloon.color", color, b.color);
  c->number("balloon.opacity", opacity, b.opacity);
}

void compareRequirements(Comparison* c, const SceneRequirements& a, const SceneRequirements& b) {
  const auto& [altitude, elevation, exposure, error, bytes, seconds] = a;
  const auto numbers = [c](auto name, double x, double y) { c->number(name, x, y); };
  const auto angles = [c](auto name, double x, double y) { c->angle(name, x, y); };
  for (size_t i = 0; i < 2; ++i) {
    c->optional("needs.altitude", altitude[i], b.altitude_m[i], numbers);
    c->optional("needs.sunElevation", elevation[i], b.sunElevation[i], angles);
  }
  c->optional("needs.exposure", exposure, b.exposure, numbers);
  c->number("needs.error", error, b.error);
  c->whole("needs.budgetBytes", bytes, b.budgetBytes);
  c->number("needs.budgetSeconds", seconds, b.budgetSeconds);
}

}  // namespace

std::string sceneDifference(const Scene& a, const Scene& b, uint64_t angleSteps) {
  Comparison comparison(angleSteps);
  Comparison* c = &comparison;
  const auto& [air, sun, camera, albedoMap, terrain, balloons, stars, shafts, lightShaftStepCount,
               width, height, exposure, toneMap, model, modelStepCount, solver, orders, quality,
               effects, requirements] = a;
  const auto wholes = [c](auto name, auto x, auto y) { c->whole(name, x, y); };
  compareMedium(c, air, b.atmosphere);
  compareView(c, sun, b.sun, camera, b.camera);
  c->text("albedoMap", albedoMap, b.albedoMap);
  c->optional("terrain", terrain, b.terrain,
              [c](auto, const auto& x, const auto& y) { compareTerrain(c, x, y); });
  c->whole("balloons", balloons.size(), b.balloons.size());
  for (size_t i = 0; i < balloons.size() && i < b.balloons.size(); ++i) {
    compareBalloon(c, balloons[i], b.balloons[i]);
  }
  c->optional("stars", stars, b.stars, [c](auto name, const auto& x, const auto& y) {
    const auto& [hours] = x;
    c->number(name, hours, y.siderealHours);
  });
  c->whole("shafts", shafts, b.shafts);
  c->whole("lightShaftStepCount", lightShaftStepCount, b.lightShaftStepCount);
  c->whole("width", width, b.width);
  c->whole("height", height, b.height);
  c->optional("exposure", exposure, b.exposure,
              [c](auto name, double x, double y) { c->number(name, x, y); });
  c->whole("toneMap", toneMap, b.toneMap);
  c->whole("model", model, b.model);
  c->optional("modelStepCount", modelStepCount, b.modelStepCount, wholes);
  c->optional("solver", solver, b.solver, wholes);
  c->optional("orders", orders, b.orders, wholes);
  c->optional("quality", quality, b.quality, wholes);
  for (size_t i = 0; i < kEffectCount; ++i) c->whole("effects", effects[i], b.effects[i]);
  c->optional("needs", requirements, b.requirements,
              [c](auto, const auto& x, const auto& y) { compareRequirements(c, x, y); });
  return c->first();
}

}  // namespace alpenglow::test
