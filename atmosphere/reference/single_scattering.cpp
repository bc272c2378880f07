#include "atmosphere/reference/single_scattering.h"

#include <limits>
#include <new>
#include <numbers>

#include "atmosphere/parameters/query.h"
#include "atmosphere/parameters/sentence.h"
#include "atmosphere/reference/shadow.h"

namespace alpenglow {
namespace reference {
namespace {

/// A value with its error, for each wavelength.
struct Estimate {
  Spectrum value;
  Spectrum error;
};

/// exp(-tau); an error of tau is a relative error of T.
Estimate transmittanceOf(const SpectrumIntegral& depth) {
  Estimate result;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    result.value[i] = std::exp(-depth.value[i]);
    result.error[i] = result.value[i] * depth.error[i];
  }
  return result;
}

/// Optical depths inside another quadrature, or of a transmittance: an absolute error counts, once
/// it is small against the light that is left.
Tolerance depthTolerance(double tolerance) {
  const double t = std::max(0.02 * tolerance, 1e-13);
  return {t, t};
}

/// T max(mu_s, 0) on a horizontal surface at h, the sun's hidden part left out.
Estimate directIrradiance(const Medium& medium, double h, double muS, const Tolerance& tolerance) {
  Estimate result;
  if (!(muS > 0.0)) {
    return result;
  }
  const bool inside = h <= medium.thickness;
  if (inside) {
    result = transmittanceOf(opticalDepthToTop(medium, h, muS, tolerance));
  }
  const double lit = inside ? muS * physics_f64::sunVisibility(medium, h, muS) : muS;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    result.value[i] = inside ? result.value[i] * lit : lit;
    result.error[i] *= lit;
  }
  return result;
}

/// The resolved segment with the vectors that shadow.h needs.
SunlitRay makeSunlitRay(const Medium& medium, const ProbeQuery& query,
                        const ResolvedQuery& resolved) {
  using glm::dvec3;
  const dvec3 vertical(0.0, 0.0, 1.0);
  const double viewSine = std::sin(query.zenith);
  const double sunSine = std::sin(query.sunZenith);
  const dvec3 view(viewSine, 0.0, std::cos(query.zenith));
  const dvec3 sun(sunSine * std::cos(query.azimuth), sunSine * std::sin(query.azimuth),
                  std::cos(query.sunZenith));
  const dvec3 normal = glm::cross(sun, view);
  const double r = physics_f64::radiusAt(medium, query.altitude_m);

  SunlitRay sunlit;
  sunlit.segment = {resolved.ray.h, resolved.ray.mu, resolved.length};
  sunlit.muS = resolved.ray.muS;
  sunlit.nu = resolved.ray.nu;
  sunlit.sineSquared = glm::dot(normal, normal);
  sunlit.across =
      r * glm::dot(normal, glm::cross(sun, vertical)) + resolved.ray.start * sunlit.sineSquared;
  return sunlit;
}

/// Shadows counted from where a segment begins.
std::vector<RayInterval> shadowsFrom(double start, std::span<const RayInterval> shadow) {
  std::vector<RayInterval> result;
  for (const RayInterval& s : shadow) {
    if (s.to > start) result.push_back({std::max(s.from - start, 0.0), s.to - start});
  }
  return result;
}

/// The light scattered along a segment: equation 11 of the paper for J of the direct sun. With
/// shadows it is equation 13, and as many lit parts as they leave.
class SingleScattering {
 public:
  SingleScattering(const Medium& medium, const SunlitRay& ray, double tolerance,
                   const std::vector<RayInterval>& shadow)
      : medium_(medium),
        ray_(ray),
        tolerance_(tolerance),
        depthTolerance_(depthTolerance(tolerance)),
        breaks_(smoothBreaks(medium, ray.segment)) {
    addSunlightBreaks(medium, ray, breaks_);
    addFreePaths();
    for (const RayInterval& s : shadow) {
      breaks_.push_back(s.from);
      breaks_.push_back(s.to);
    }
    tidyBreaks(breaks_, ray.segment.length);
    depths_.resize(breaks_.size());
    lit_.resize(breaks_.size() - 1);
    hidden_.resize(breaks_.size() - 1);
    for (size_t i = 0; i + 1 < breaks_.size(); ++i) {
      const double middle = 0.5 * (breaks_[i] + breaks_[i + 1]);
      hidden_[i] = isInside(shadow, middle);
      lit_[i] = visibilityAt(middle) > 0.0;
      depths_[i + 1] = depths_[i];
      add(depths_[i + 1],
          opticalDepthBetween(medium, ray.segment, breaks_[i], breaks_[i + 1], depthTolerance_));
    }
  }

  /// Optical depth of the whole segment.
  const SpectrumIntegral& depth() const { return depths_.back(); }

  Estimate radiance() const {
    double depthError = 0.0;
    const auto integrand = [&](double t) { return lightAt(t, depthError); };
    const Integral<kTerms> sum = integrate<kTerms>(integrand, breaks_, {tolerance_, 0.0});

    const double rayleigh = physics_f64::rayleighPhase(ray_.nu);
    const double mie = physics_f64::miePhase(medium_.mieAsymmetry, ray_.nu);
    Estimate result;
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      result.value[i] = rayleigh * sum.value[i] + mie * sum.value[kSpectrumSize + i];
      result.error[i] = rayleigh * sum.error[i] + mie * sum.error[kSpectrumSize + i] +
                        depthError * result.value[i];
    }
    return result;
  }

 private:
  /// S_R and S_M apart, as the phase functions leave the integral (nu is constant along a ray).
  static constexpr size_t kTerms = 2 * kSpectrumSize;

  static void add(SpectrumIntegral& sum, const SpectrumIntegral& part) {
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      sum.value[i] += part.value[i];
      sum.error[i] += part.error[i];
    }
  }

  static bool isInside(const std::vector<RayInterval>& shadow, double t) {
    const auto after = std::upper_bound(shadow.begin(), shadow.end(), t,
                                        [](double x, const RayInterval& s) { return x < s.to; });
    return after != shadow.end() && t >= after->from;
  }

  /// In a thick medium the light comes from a few mean free paths, far less than a scale height.
  void addFreePaths() {
    const physics_f64::Spectrum density = physics_f64::extinction(medium_, ray_.segment.h);
    double most = 0.0;
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      most = std::max(most, density[static_cast<glm::length_t>(i)]);
    }
    for (double paths : {1.0, 4.0, 16.0, 64.0}) {
      if (most * ray_.segment.length > paths) {
        breaks_.push_back(paths / most);
      }
    }
  }

  double muSAt(double t, double h) const {
    return physics_f64::muSAt(medium_, ray_.segment.h, ray_.muS, ray_.nu, t, h);
  }

  double visibilityAt(double t) const {
    const double h = physics_f64::altitudeAt(medium_, ray_.segment.h, ray_.segment.mu, t);
    return physics_f64::sunVisibility(medium_, h, muSAt(t, h));
  }

  /// T(x, y) T_sun(y) times the scattering coefficients at y, t metres along the ray.
  std::array<double, kTerms> lightAt(double t, double& depthError) const {
    const auto after = std::upper_bound(breaks_.begin(), breaks_.end() - 1, t);
    const size_t segment =
        static_cast<size_t>(std::max<std::ptrdiff_t>(after - breaks_.begin(), 1)) - 1;
    // A parallel beam steps at a segment's end, and its step is decided for the segment as a whole.
    const bool sharp = !(medium_.sunSinRadius > 0.0);
    const double visibility = sharp ? (lit_[segment] ? 1.0 : 0.0) : visibilityAt(t);
    if (hidden_[segment] || !(visibility > 0.0)) {
      return {};
    }
    const double h = physics_f64::altitudeAt(medium_, ray_.segment.h, ray_.segment.mu, t);
    SpectrumIntegral depth = depths_[segment];
    add(depth, opticalDepthBetween(medium_, ray_.segment, breaks_[segment], t, depthTolerance_));
    add(depth, opticalDepthToTop(medium_, h, muSAt(t, h), depthTolerance_));

    const double rayleigh = physics_f64::rayleighDensity(medium_, h);
    const double mie = physics_f64::mieDensity(medium_, h);
    std::array<double, kTerms> result;
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      const auto c = static_cast<glm::length_t>(i);
      const double light = visibility * std::exp(-depth.value[i]);
      result[i] = light * rayleigh * medium_.rayleighScattering[c];
      result[kSpectrumSize + i] = light * mie * medium_.mieScattering[c];
      depthError = std::max(depthError, std::min(depth.error[i], 1.0));
    }
    return result;
  }

  const Medium& medium_;
  SunlitRay ray_;
  double tolerance_;
  Tolerance depthTolerance_;
  std::vector<double> breaks_;
  std::vector<SpectrumIntegral> depths_;  ///< From the start to each end of a segment.
  std::vector<bool> lit_;                 ///< Of each segment, for a sun without a disc.
  std::vector<bool> hidden_;              ///< Whether a segment lies in a shadow.
};

/// R[L0] at the end of a ray on the ground (equation 10): Lambert's law for the direct sun.
Estimate groundRadiance(const Medium& medium, const SunlitRay& ray, const Estimate& transmittance,
                        const Tolerance& tolerance) {
  const double muS =
      physics_f64::muSAt(medium, ray.segment.h, ray.muS, ray.nu, ray.segment.length, 0.0);
  const Estimate direct = directIrradiance(medium, 0.0, muS, tolerance);
  Estimate result;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    const double albedo = medium.groundAlbedo[static_cast<glm::length_t>(i)];
    const double factor = albedo / std::numbers::pi;
    result.value[i] = transmittance.value[i] * factor * direct.value[i];
    result.error[i] = factor * (transmittance.error[i] * direct.value[i] +
                                transmittance.value[i] * direct.error[i]);
  }
  return result;
}

}  // namespace

Status checkQuery(const ProbeQuery& query, const DiagnosticSink& sink) {
  // Queries in degrees come as rounded radians, so the nadir may exceed pi by a bit.
  constexpr double kMost = std::numbers::pi * (1 + 1e-15),
                   kAny = std::numeric_limits<double>::max();
  const bool ray = query.kind != QueryKind::Irradiance;
  const struct {
    const char* name;
    double value, least, most;
  } fields[] = {{"altitude_m", query.altitude_m, 0.0, kAny},
                {"sunZenith", query.sunZenith, 0.0, kMost},
                {"zenith", ray ? query.zenith : 0.0, 0.0, kMost},
                {"azimuth", ray ? query.azimuth : 0.0, -kAny, kAny},
                {"distance_m", ray ? query.distance_m : 0.0, 0.0, kAny}};
  for (const auto& field : fields) {
    if (field.value >= field.least && field.value <= field.most) continue;
    parameters::Sentence why;
    why << "ProbeQuery::" << field.name << " is " << field.value << ", but it must be ";
    if (field.most == kAny) {
      why << (field.least == 0.0 ? "at least 0 and finite." : "finite.");
    } else {
      why << "from 0 to pi.";
    }
    return parameters::report(sink, Status::InvalidArgument, why);
  }
  return Status::Ok;
}

Status outOfMemory(const DiagnosticSink& sink, const char* function) {
  return parameters::report(sink, Status::OutOfHostMemory,
                            parameters::Sentence() << function << " found too little host memory.");
}

ReferenceAnswer singleScattering(const Medium& medium, const ProbeQuery& query, double tolerance,
                                 std::span<const RayInterval> shadow) {
  ReferenceAnswer answer;
  if (query.kind == QueryKind::Irradiance) {
    const Estimate direct = directIrradiance(medium, query.altitude_m, std::cos(query.sunZenith),
                                             depthTolerance(tolerance));
    answer.value.direct = direct.value;
    answer.standardError.direct = direct.error;
    return answer;
  }
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    answer.value.transmittance[i] = 1.0;
  }
  const ResolvedQuery resolved = resolveQuery(medium, query);
  if (resolved.empty) {
    return answer;
  }
  const SunlitRay segment = makeSunlitRay(medium, query, resolved);
  const std::vector<RayInterval> dark = shadowsFrom(resolved.ray.start, shadow);
  Estimate transmittance{answer.value.transmittance, {}};
  if (segment.segment.length > 0.0) {
    const SingleScattering scattering(medium, segment, tolerance, dark);
    transmittance = transmittanceOf(scattering.depth());
    const Estimate sky = scattering.radiance();
    answer.value.skyRadiance = sky.value;
    answer.standardError.skyRadiance = sky.error;
  }
  answer.value.transmittance = transmittance.value;
  answer.standardError.transmittance = transmittance.error;
  answer.value.hitsGround = resolved.endsOnGround;
  const double end = segment.segment.length * (1.0 - 1e-9);
  const bool groundIsDark = !dark.empty() && dark.back().to >= end;
  if (answer.value.hitsGround && !groundIsDark) {
    const Estimate ground =
        groundRadiance(medium, segment, transmittance, depthTolerance(tolerance));
    answer.value.groundRadiance = ground.value;
    answer.standardError.groundRadiance = ground.error;
  }
  return answer;
}

}  // namespace reference

inline namespace v1_0 {

Status referenceSingleScattering(const Parameters& parameters, const ProbeQuery& query,
                                 ReferenceAnswer* out, const DiagnosticSink& sink) {
  constexpr const char* kName = "referenceSingleScattering";
  if (out == nullptr) return parameters::reportNull(sink, kName, "the answer");
  Status status = reference::checkQuery(query, sink);
  if (status == Status::Ok) status = validate(parameters, sink);
  if (status != Status::Ok) return status;
  try {
    *out = reference::singleScattering(makeMediumF64(parameters), query,
                                       reference::kRelativeTolerance);
  } catch (const std::bad_alloc&) {
    return reference::outOfMemory(sink, kName);
  }
  return Status::Ok;
}

}  // namespace v1_0
}  // namespace alpenglow
