#include "atmosphere/reference/path_tracer.h"

#include "atmosphere/reference/distance_sampling.h"

namespace alpenglow::reference {
namespace {

using physics_f64::Medium;
using physics_f64::Spectrum;

constexpr double kPi = std::numbers::pi;
/// A path always continues while it may contribute at least this share; below, by Russian roulette.
constexpr double kSurvival = 0.3;
constexpr double kLeastSurvival = 0.1;

double sumOf(const Spectrum& s) { return s.x + s.y + s.z; }

/// The guide's grid of directions at a point, as a lobe.
class GuideLobe {
 public:
  GuideLobe(const DirectionGrid& grid, const Vector& normal, const Vector& sun)
      : grid_(grid), frame_(normal, sun) {}
  Vector sample(double choice, double u, double v) const {
    const DirectionGrid::Angles angles = grid_.sample(choice, u, v);
    return frame_.direction(angles.mu, angles.phi);
  }
  double density(const Vector& direction) const {
    const double mu = std::clamp(glm::dot(frame_.z, direction), -1.0, 1.0);
    return grid_.density(mu, frame_.cosAzimuth(direction));
  }

 private:
  DirectionGrid grid_;
  LocalFrame frame_;
};

/// The lobes that a new direction is drawn from: light as the guide has it, the sun's aureole, and
/// the phase functions (in the atmosphere) or the cosine (on a surface).
class Lobes {
 public:
  Lobes(const GuideLobe& guided, const Vector& sun, double g, double aureoleShare,
        double guidedShare)
      : guided_(guided), sun_(sun), g_(g), aureoleShare_(aureoleShare), guidedShare_(guidedShare) {}

  /// `own`: what samples and evaluates the rest, given a choice in [0, 1).
  template <class Sample>
  Vector sample(double choice, double u, double v, const Sample& own) const {
    if (choice < aureoleShare_) return around(sun_, sampleGreenstein(g_, u), v);
    choice -= aureoleShare_;
    if (choice < guidedShare_) return guided_.sample(choice / guidedShare_, u, v);
    return own((choice - guidedShare_) / ownShare(), u, v);
  }
  double density(const Vector& direction, double ownDensity) const {
    double sum = ownShare() * ownDensity;
    if (guidedShare_ > 0.0) sum += guidedShare_ * guided_.density(direction);
    if (aureoleShare_ > 0.0) sum += aureoleShare_ * greenstein(g_, glm::dot(sun_, direction));
    return sum;
  }

 private:
  double ownShare() const { return 1.0 - aureoleShare_ - guidedShare_; }

  const GuideLobe& guided_;
  Vector sun_;
  double g_, aureoleShare_, guidedShare_;
};

/// How much of the light at a point scatters straight from the sun, of all that scatters.
double directPart(const GuideLight& light) {
  const double direct = sumOf(light.sunlight);
  return direct > 0.0 ? direct / (direct + 4.0 * kPi * sumOf(light.mean)) : 0.0;
}

}  // namespace

/// A path under way: at `position` (planet-centred), about to go on in `direction`.
struct PathTracer::Path {
  Vector position, direction, sun;
  double h = 0.0;
  Spectrum throughput{1.0};
  Spectrum relative{1.0};  ///< What a unit of each channel counts for.
  Spectrum light{0.0};
  uint32_t events = 0;
  uint32_t most = kAllOrders;
  double gap = 0.0;  ///< From where on the ray may meet a mesh.
};

/// A direction and the density with which it was drawn, per steradian.
struct PathTracer::Drawn {
  Vector direction;
  double density;
};

/// Where a ray's light comes from: t metres along it, transmittance over probability included in
/// the path's throughput already.
struct PathTracer::Hit {
  Vector position, vertical;
  double h, nu, muS;
  Vector normal;           ///< Of a surface, on the path's side.
  const Spectrum* albedo;  ///< Of a surface; null in the atmosphere.
};

PathTracer::PathTracer(const Medium& medium, const Scene* scene)
    : medium_(medium), scene_(scene), columns_(medium_), guide_(medium_, columns_) {}

Spectrum PathTracer::sunlight(double h, double muS) const {
  const double visible = physics_f64::sunVisibility(medium_, h, muS);
  if (!(visible > 0.0)) return Spectrum(0.0);
  return visible * exp(-columns_.depth(columns_.toTop(h, muS)));
}

/// Whether a mesh stands between a point and the sun. The planet does so in sunlight().
bool PathTracer::isHidden(const Vector& position, const Vector& sun, double gap) const {
  return scene_ != nullptr && scene_->hidesSun &&
         scene_->meshes.blocked(position, sun, gap, kEndless);
}

/// One event of a path. False when the path has ended.
bool PathTracer::step(Path& path, double length, bool direct, bool sunAtEnd,
                      PathSampler& sampler) const {
  const double r = glm::length(path.position);
  const double mu = std::clamp(glm::dot(path.position, path.direction) / r, -1.0, 1.0);
  const double muS = std::clamp(glm::dot(path.position, path.sun) / r, -1.0, 1.0);
  const double nu = std::clamp(glm::dot(path.direction, path.sun), -1.0, 1.0);
  const bool whole = length < 0.0;
  const bool ground = whole && physics_f64::rayHitsGround(medium_, path.h, mu);
  if (whole) {
    length = ground ? physics_f64::distanceToGround(medium_, path.h, mu)
                    : physics_f64::distanceToTop(medium_, path.h, mu);
  }
  std::optional<MeshHit> mesh;
  if (whole && scene_ != nullptr) {
    mesh = scene_->meshes.closest(path.position, path.direction, path.gap, length);
  }
  EndSurface surface;
  if (mesh) {
    length = mesh->t;
    if (glm::dot(mesh->normal, path.direction) > 0.0) mesh->normal = -mesh->normal;
    surface = {&scene_->albedo[mesh->mesh], true,
               std::min(physics_f64::altitudeAt(medium_, path.h, mu, length), medium_.thickness),
               glm::dot(mesh->normal, path.sun)};
  } else if (ground) {
    surface.albedo = &medium_.groundAlbedo;
  }
  const Spectrum counts = path.throughput * path.relative;
  const DistanceSampling distances(medium_, guide_, {path.h, mu, length}, muS, nu, counts, direct,
                                   surface);
  if (!distances.possible()) return false;

  const double surfaceChance = distances.surfaceProbability();
  const Column start = columns_.upwards(path.h, std::abs(mu));
  Hit hit;
  hit.nu = nu;
  const bool hitsSurface = surfaceChance > 0.0 && sampler.random() < surfaceChance;
  hit.albedo = hitsSurface ? surface.albedo : nullptr;
  DistanceSample sample{length, surfaceChance};
  if (!hitsSurface) sample = distances.sample(sampler.leading(), 1.0 - surfaceChance);
  hit.position = path.position + sample.t * path.direction;
  hit.h = hitsSurface && !mesh
              ? 0.0
              : std::min(physics_f64::altitudeAt(medium_, path.h, mu, sample.t), medium_.thickness);
  hit.vertical = hit.position / glm::length(hit.position);
  hit.muS = std::clamp(glm::dot(hit.vertical, path.sun), -1.0, 1.0);
  if (hitsSurface && mesh) {
    hit.normal = mesh->normal;
  } else if (hitsSurface) {
    hit.normal = hit.vertical;
    hit.position = hit.vertical * medium_.bottomRadius;
  }
  const double muEnd = physics_f64::muAt(medium_, path.h, mu, sample.t, hit.h);
  const Column column = columns_.between(path.h, mu, start, hit.h, muEnd);
  path.throughput *= exp(-columns_.depth(column)) / sample.density;
  path.position = hit.position;
  path.h = hit.h;
  ++path.events;
  return hitsSurface ? atSurface(path, hit, sampler) : atAir(path, hit, sunAtEnd, sampler);
}

/// The direction that light scattered here came from.
PathTracer::Drawn PathTracer::drawInAtmosphere(const Path& path, const Hit& hit,
                                               const GuideLight& light, double rayleighShare,
                                               PathSampler& sampler) const {
  const double g = medium_.mieAsymmetry;
  const GuideLobe guided(guide_.directionsAt(hit.h, hit.muS), hit.vertical, path.sun);
  // Peaked phase functions are sampled most: a path through haze scatters many times, and their
  // samples weigh the more the less often they are chosen.
  const double dust = 1.0 - rayleighShare;
  const double aureole = 0.15 * dust * directPart(light);
  const Lobes lobes(guided, path.sun, g, aureole, 0.45 * rayleighShare + 0.12 * dust);
  const double choice = sampler.leading(), u = sampler.leading(), v = sampler.leading();
  const Vector direction = lobes.sample(choice, u, v, [&](double own, double x, double y) {
    return around(path.direction, own < rayleighShare ? sampleRayleigh(x) : sampleGreenstein(g, x),
                  y);
  });
  const double nu = std::clamp(glm::dot(path.direction, direction), -1.0, 1.0);
  const double phases =
      rayleighShare * physics_f64::rayleighPhase(nu) + (1.0 - rayleighShare) * greenstein(g, nu);
  return {direction, lobes.density(direction, phases)};
}

/// The direction that light on a surface came from; it may be one from below.
PathTracer::Drawn PathTracer::drawAbove(const Vector& normal, const Vector& vertical,
                                        const Vector& sun, double h, double muS,
                                        PathSampler& sampler) const {
  const GuideLobe guided(guide_.directionsAt(h, muS), vertical, sun);
  const bool haze = sumOf(medium_.mieScattering) > 0.0 && sumOf(guide_.at(h, muS).sunlight) > 0.0;
  const Lobes lobes(guided, sun, medium_.mieAsymmetry, haze ? 0.2 : 0.0, 0.4);
  const double choice = sampler.leading(), u = sampler.leading(), v = sampler.leading();
  const Vector direction = lobes.sample(
      choice, u, v, [&](double, double x, double y) { return around(normal, std::sqrt(x), y); });
  const double cosine = std::max(glm::dot(normal, direction), 0.0);
  return {direction, lobes.density(direction, cosine / kPi)};
}

/// Adds the sunlight scattered here and draws the direction of the next ray.
bool PathTracer::atAir(Path& path, const Hit& hit, bool sunAtEnd, PathSampler& sampler) const {
  const Spectrum rayleigh =
      medium_.rayleighScattering * physics_f64::rayleighDensity(medium_, hit.h);
  const Spectrum mie = medium_.mieScattering * physics_f64::mieDensity(medium_, hit.h);
  path.gap = 0.0;
  if (sunAtEnd && !isHidden(hit.position, path.sun, 0.0)) {
    path.light += path.throughput *
                  (rayleigh * physics_f64::rayleighPhase(hit.nu) +
                   mie * physics_f64::miePhase(medium_.mieAsymmetry, hit.nu)) *
                  sunlight(hit.h, hit.muS);
  }
  if (path.events >= path.most) return false;

  const GuideLight light = guide_.at(hit.h, hit.muS);
  const Spectrum counts = path.throughput * path.relative;
  const double promise = sumOf(counts * (rayleigh + mie) * light.mean);
  const double survival = std::clamp(promise / kSurvival, kLeastSurvival, 1.0);
  if (survival < 1.0) {
    if (sampler.random() >= survival) return false;
    path.throughput /= survival;
  }
  const double air = sumOf(counts * rayleigh), dust = sumOf(counts * mie);
  if (!(air + dust > 0.0)) return false;
  const Drawn direction = drawInAtmosphere(path, hit, light, air / (air + dust), sampler);
  const double nu = std::clamp(glm::dot(path.direction, direction.direction), -1.0, 1.0);
  path.throughput *= (rayleigh * physics_f64::rayleighPhase(nu) +
                      mie * physics_f64::miePhase(medium_.mieAsymmetry, nu)) /
                     direction.density;
  path.direction = direction.direction;
  return true;
}

/// Lambert's law for the sun, and the direction of a ray above the ground or a mesh.
bool PathTracer::atSurface(Path& path, const Hit& hit, PathSampler& sampler) const {
  path.gap = kSurfaceGap;
  const double cosSun = std::clamp(glm::dot(hit.normal, path.sun), -1.0, 1.0);
  if (cosSun > 0.0 && !isHidden(hit.position, path.sun, kSurfaceGap)) {
    path.light += path.throughput * *hit.albedo * (cosSun / kPi) * sunlight(hit.h, hit.muS);
  }
  if (path.events >= path.most) return false;
  const GuideLight light = guide_.at(hit.h, hit.muS);
  const double promise = sumOf(path.throughput * path.relative * *hit.albedo * light.mean);
  const double survival = std::clamp(promise / kSurvival, kLeastSurvival, 1.0);
  if (survival < 1.0) {
    if (sampler.random() >= survival) return false;
    path.throughput /= survival;
  }
  const Drawn drawn = drawAbove(hit.normal, hit.vertical, path.sun, hit.h, hit.muS, sampler);
  path.direction = drawn.direction;
  const double cosine = glm::dot(drawn.direction, hit.normal);
  if (!(cosine > 0.0)) return false;
  path.throughput *= *hit.albedo * (cosine / kPi / drawn.density);
  return true;
}

void PathTracer::follow(Path& path, PathSampler& sampler) const {
  while (step(path, -1.0, true, true, sampler)) {
  }
}

Spectrum PathTracer::skySample(const Observer& observer, const Vector& view, double length,
                               uint32_t least, uint32_t most, const Spectrum& relative,
                               PathSampler& sampler) const {
  sampler.nextPath();
  if (most < least || !(length > 0.0)) return Spectrum(0.0);
  Path path;
  path.h = observer.h;
  path.position = Vector(0.0, 0.0, medium_.bottomRadius + observer.h);
  path.direction = view;
  path.sun = observer.sun;
  path.relative = relative;
  path.most = most;
  const bool first = least <= 1;
  if (step(path, length, first, first, sampler)) follow(path, sampler);
  return path.light;
}

Spectrum PathTracer::irradianceSample(const Observer& observer, uint32_t most,
                                      PathSampler& sampler) const {
  sampler.nextPath();
  if (most == 0 || observer.h > medium_.thickness) return Spectrum(0.0);
  const Vector normal(0.0, 0.0, 1.0);
  const Drawn drawn = drawAbove(normal, normal, observer.sun, observer.h, observer.sun.z, sampler);
  if (!(drawn.direction.z > 0.0)) return Spectrum(0.0);
  Path path;
  path.direction = drawn.direction;
  path.h = observer.h;
  path.position = normal * (medium_.bottomRadius + observer.h);
  path.sun = observer.sun;
  path.throughput = Spectrum(drawn.direction.z / drawn.density);
  path.relative = 1.0 / (3.0 * glm::max(roughIrradiance(observer), Spectrum(1e-30)));
  path.most = most;
  follow(path, sampler);
  return path.light;
}

PathTracer::AerialLight PathTracer::airSample(const Vector& position, const Vector& view,
                                              const Vector& sun, double length, bool withSingle,
                                              const Spectrum& relative,
                                              PathSampler& sampler) const {
  sampler.nextPath();
  AerialLight result;
  if (!(length > 0.0)) return result;
  Path path;
  path.h = std::clamp(glm::length(position) - medium_.bottomRadius, 0.0, medium_.thickness);
  path.position = position;
  path.direction = view;
  path.sun = sun;
  path.relative = relative;
  const bool goesOn = step(path, length, withSingle, withSingle, sampler);
  result.t = glm::dot(path.position - position, view);
  result.single = path.light;
  path.light = Spectrum(0.0);
  if (goesOn) follow(path, sampler);
  result.multiple = path.light;
  return result;
}

Spectrum PathTracer::surfaceSample(const Vector& position, const Vector& normal, const Vector& sun,
                                   const Spectrum& albedo, PathSampler& sampler) const {
  sampler.nextPath();
  Path path;
  Hit hit;
  hit.position = position;
  hit.vertical = position / glm::length(position);
  hit.h = std::clamp(glm::length(position) - medium_.bottomRadius, 0.0, medium_.thickness);
  hit.nu = 0.0;
  hit.muS = std::clamp(glm::dot(hit.vertical, sun), -1.0, 1.0);
  hit.normal = normal;
  hit.albedo = &albedo;
  path.position = position;
  path.h = hit.h;
  path.sun = sun;
  const Spectrum rough = albedo * guide_.at(hit.h, hit.muS).mean;
  path.relative = 1.0 / (3.0 * glm::max(rough, Spectrum(1e-30)));
  path.events = 1;
  if (atSurface(path, hit, sampler)) follow(path, sampler);
  return path.light;
}

Spectrum PathTracer::roughSky(const Observer& observer, const Vector& view, double length) const {
  const double nu = glm::dot(view, observer.sun);
  return DistanceSampling::lightAlong(medium_, guide_, {observer.h, view.z, length}, observer.sun.z,
                                      nu);
}

Spectrum PathTracer::roughIrradiance(const Observer& observer) const {
  const GuideLight light = guide_.at(observer.h, observer.sun.z);
  return kPi * light.mean;
}

}  // namespace alpenglow::reference
