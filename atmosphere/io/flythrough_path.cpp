#include "atmosphere/io/flythrough_path.h"

#include <alpenglow/io/atmosphere_file.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "atmosphere/io/json.h"

namespace alpenglow::io {
namespace {

// Times of frames are rounded.
constexpr double kSameTime_s = 1e-9;

using Four = std::array<double, 4>;
using Scenes = std::array<const Scene*, 4>;

// Slope at a key that joins two segments of these lengths and mean slopes.
double slopeBetween(double hBefore, double before, double hAfter, double after) {
  if (before * after <= 0.0) return 0.0;
  const double w1 = 2.0 * hAfter + hBefore, w2 = hAfter + 2.0 * hBefore;
  return (w1 + w2) / (w1 / before + w2 / after);
}

// The slope of a linear neighbour, limited to what a monotone cubic allows.
double slopeOfLinear(double neighbour, double own) {
  if (neighbour * own <= 0.0) return 0.0;
  return std::copysign(std::min(std::abs(neighbour), 3.0 * std::abs(own)), own);
}

// Angles: each the shorter way from the one before; the second is unchanged.
Four unwrapped(Four angles) {
  const auto way = [](double from, double to) { return std::remainder(to - from, 2.0 * kPi); };
  const Four a = angles;
  angles[0] = a[1] - way(a[0], a[1]);
  angles[2] = a[1] + way(a[1], a[2]);
  angles[3] = angles[2] + way(a[2], a[3]);
  return angles;
}

struct Direction {
  double x, y, z;
};

Direction placeOf(const SceneCamera& c) {
  return {std::cos(c.latitude) * std::cos(c.longitude),
          std::cos(c.latitude) * std::sin(c.longitude), std::sin(c.latitude)};
}

double arcBetween(const SceneCamera& a, const SceneCamera& b) {
  if (a.latitude == b.latitude && a.longitude == b.longitude) return 0.0;
  const Direction p = placeOf(a), q = placeOf(b);
  return 2.0 * std::asin(std::min(1.0, 0.5 * std::hypot(p.x - q.x, p.y - q.y, p.z - q.z)));
}

// Moves along `arc` of the angle `whole` on the great circle from a to b.
void goAlong(const SceneCamera& a, const SceneCamera& b, double arc, double whole,
             SceneCamera* out) {
  if (whole < 1e-12) return;
  const Direction p = placeOf(a), q = placeOf(b);
  const double s = std::sin(whole);
  const double wp = std::sin(whole - arc) / s, wq = std::sin(arc) / s;
  const Direction at = {wp * p.x + wq * q.x, wp * p.y + wq * q.y, wp * p.z + wq * q.z};
  out->latitude = std::atan2(at.z, std::hypot(at.x, at.y));
  out->longitude = std::atan2(at.y, at.x);
}

void eachNumber(Parameters* p, const std::function<void(double*)>& visit) {
  for (double* number : {&p->bottomRadius_m, &p->topRadius_m, &p->rayleigh.scaleHeight_m,
                         &p->mie.scaleHeight_m, &p->mie.asymmetry, &p->absorption.center_m,
                         &p->absorption.halfWidth_m, &p->sunAngularRadius}) {
    visit(number);
  }
  for (Spectrum* spectrum :
       {&p->wavelengths_nm, &p->rayleigh.scattering_per_m, &p->mie.scattering_per_m,
        &p->mie.extinction_per_m, &p->absorption.extinction_per_m, &p->groundAlbedo,
        &p->solarIrradiance}) {
    for (double& number : spectrum->value) visit(&number);
  }
}

// A mixture of two valid atmospheres is valid: every bound is a straight line.
Parameters mixed(const Parameters& a, const Parameters& b, double share) {
  std::vector<double> to;
  Parameters end = b;
  eachNumber(&end, [&](double* number) { to.push_back(*number); });
  Parameters out = a;
  size_t i = 0;
  eachNumber(&out, [&](double* number) {
    if (*number != to[i]) *number += share * (to[i] - *number);
    ++i;
  });
  return out;
}

bool same(const Parameters& a, const Parameters& b) { return firstDifference(a, b).empty(); }

struct Between {
  const FlythroughSegment& segment;
  const Scenes& scenes;
  double time;

  template <typename Get>
  Four each(const Get& get) const {
    return {get(*scenes[0]), get(*scenes[1]), get(*scenes[2]), get(*scenes[3])};
  }
  template <typename Get>
  double number(const Get& get) const {
    return valueAt(segment, time, each(get));
  }
  template <typename Get>
  double angle(const Get& get) const {
    return valueAt(segment, time, unwrapped(each(get)));
  }
  /// Of numbers above 0.
  template <typename Get>
  double ratio(const Get& get) const {
    return std::exp(number([&](const Scene& s) { return std::log(get(s)); }));
  }

  void moveCamera(SceneCamera* c) const;
  void moveMedium(Parameters* out) const;
};

void Between::moveCamera(SceneCamera* c) const {
  const SceneCamera &a = scenes[1]->camera, &b = scenes[2]->camera;
  const double whole = arcBetween(a, b);
  const Four way = {-arcBetween(scenes[0]->camera, a), 0.0, whole,
                    whole + arcBetween(b, scenes[3]->camera)};
  goAlong(a, b, valueAt(segment, time, way), whole, c);
  c->altitude_m = std::expm1(
      number([](const Scene& s) { return std::log1p(std::max(s.camera.altitude_m, 0.0)); }));
  c->heading = angle([](const Scene& s) { return s.camera.heading; });
  c->pitch = number([](const Scene& s) { return s.camera.pitch; });
  c->roll = angle([](const Scene& s) { return s.camera.roll; });
  if (c->orthographicHeight_m) {
    c->orthographicHeight_m =
        ratio([](const Scene& s) { return s.camera.orthographicHeight_m.value_or(1.0); });
  } else {
    c->fov = ratio([](const Scene& s) { return std::max(s.camera.fov, 1e-9); });
  }
}

void Between::moveMedium(Parameters* out) const {
  const auto step = [&](size_t i) {
    return same(scenes[i]->atmosphere, scenes[i + 1]->atmosphere) ? 0.0 : 1.0;
  };
  if (step(1) == 0.0) return;
  *out = mixed(scenes[1]->atmosphere, scenes[2]->atmosphere,
               valueAt(segment, time, {-step(0), 0.0, 1.0, 1.0 + step(2)}));
}

void moveAll(const Between& between, Scene* scene) {
  between.moveCamera(&scene->camera);
  between.moveMedium(&scene->atmosphere);
  scene->sun.elevation = between.number([](const Scene& s) { return s.sun.elevation; });
  scene->sun.azimuth = between.angle([](const Scene& s) { return s.sun.azimuth; });
  scene->sun.discRadius = between.number([](const Scene& s) { return s.sun.discRadius; });
  if (scene->exposure) {
    scene->exposure = between.ratio([](const Scene& s) { return s.exposure.value_or(1.0); });
  }
  if (scene->stars) {
    scene->stars->siderealHours =
        between.number([](const Scene& s) { return s.stars ? s.stars->siderealHours : 0.0; });
  }
}

// The segment after a key that is not the last.
FlythroughSegment segmentAfter(const Flythrough& flythrough, size_t i, Scenes* scenes) {
  const size_t last = flythrough.keys.size() - 1;
  const size_t at[4] = {i > 0 ? i - 1 : i, i, i + 1, std::min(i + 2, last)};
  const FlythroughMove before = flythrough.keys[i].move, after = flythrough.keys[at[3]].move;
  FlythroughSegment segment;
  for (size_t k = 0; k < 4; ++k) {
    segment.time[k] = flythrough.keys[at[k]].time_s;
    (*scenes)[k] = &flythrough.keys[at[k]].scene;
  }
  segment.linear = flythrough.keys[i + 1].move == FlythroughMove::Linear;
  segment.joins[0] = i > 0 && before != FlythroughMove::Cut;
  segment.joins[1] = i + 2 <= last && after != FlythroughMove::Cut;
  segment.joinsLinear[0] = before == FlythroughMove::Linear;
  segment.joinsLinear[1] = after == FlythroughMove::Linear;
  return segment;
}

}  // namespace

std::string whatHasNoBetween(const Scene& a, const Scene& b) {
  const auto auto_ = [](const Scene& s) { return s.exposure ? "a number" : "\"auto\""; };
  if (a.exposure.has_value() != b.exposure.has_value()) {
    return std::string("field 'exposure' changes from ") + auto_(a) + " to " + auto_(b);
  }
  if (a.stars.has_value() != b.stars.has_value()) {
    return std::string("field 'stars' ") + (b.stars ? "comes" : "goes");
  }
  if (a.camera.projection != b.camera.projection ||
      a.camera.orthographicHeight_m.has_value() != b.camera.orthographicHeight_m.has_value()) {
    return "field 'camera.projection' changes";
  }
  const Parameters &p = a.atmosphere, &q = b.atmosphere;
  for (const auto& [name, from, to] :
       {std::tuple("rayleigh", p.rayleigh.present, q.rayleigh.present),
        std::tuple("mie", p.mie.present, q.mie.present),
        std::tuple("absorption", p.absorption.present, q.absorption.present)}) {
    if (from == to) continue;
    return std::string("field 'atmosphere.") + name + "' " + (to ? "comes" : "goes");
  }
  if (arcBetween(a.camera, b.camera) > kPi - 1e-6) {
    return "the camera goes to the other side of the planet, where all ways are as short";
  }
  return {};
}

double valueAt(const FlythroughSegment& segment, double time, const std::array<double, 4>& v) {
  const std::array<double, 4>& t = segment.time;
  const double h = t[2] - t[1], mean = (v[2] - v[1]) / h, u = (time - t[1]) / h;
  if (mean == 0.0) return v[1];
  if (segment.linear) return v[1] + u * (v[2] - v[1]);
  double slopes[2] = {};
  for (size_t end = 0; end < 2; ++end) {
    if (!segment.joins[end]) continue;
    const size_t i = 2 * end;
    const double length = t[i + 1] - t[i], other = (v[i + 1] - v[i]) / length;
    slopes[end] = segment.joinsLinear[end] ? slopeOfLinear(other, mean)
                                           : slopeBetween(length, other, h, mean);
  }
  const double u2 = u * u, u3 = u2 * u;
  return v[1] + (v[2] - v[1]) * (3.0 * u2 - 2.0 * u3) +
         h * (slopes[0] * (u3 - 2.0 * u2 + u) + slopes[1] * (u3 - u2));
}

uint32_t frameCount(const Flythrough& flythrough) {
  // The last key may be a rounding error after its frame.
  return static_cast<uint32_t>(flythrough.keys.back().time_s * flythrough.framesPerSecond + 1e-6) +
         1;
}

double timeOfFrame(const Flythrough& flythrough, uint32_t frame) {
  return frame / flythrough.framesPerSecond;
}

const FlythroughKey& keyAt(const Flythrough& flythrough, double time_s) {
  const auto after =
      std::upper_bound(flythrough.keys.begin(), flythrough.keys.end(), time_s + kSameTime_s,
                       [](double time, const FlythroughKey& key) { return time < key.time_s; });
  return after == flythrough.keys.begin() ? *after : *(after - 1);
}

Scene sceneAt(const Flythrough& flythrough, double time_s) {
  const FlythroughKey& key = keyAt(flythrough, time_s);
  const auto i = static_cast<size_t>(&key - flythrough.keys.data());
  // What doesn't move was laid out for the first key.
  Scene scene = flythrough.keys.front().scene;
  scene.atmosphere = key.scene.atmosphere;
  scene.sun = key.scene.sun;
  scene.camera = key.scene.camera;
  scene.exposure = key.scene.exposure;
  scene.stars = key.scene.stars;
  const bool rests =
      i + 1 == flythrough.keys.size() || flythrough.keys[i + 1].move == FlythroughMove::Cut;
  if (rests || time_s <= key.time_s + kSameTime_s) return scene;
  Scenes scenes = {};
  const FlythroughSegment segment = segmentAfter(flythrough, i, &scenes);
  moveAll({segment, scenes, time_s}, &scene);
  return scene;
}

}  // namespace alpenglow::io
