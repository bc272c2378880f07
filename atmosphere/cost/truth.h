// Kept truth: atmospheres, queries and answers of the path tracer in a folder, and the error of an
// answer against them, as docs/reference-solution.md defines it.
#pragma once

#include <alpenglow/io/result.h>
#include <alpenglow/parameters.h>
#include <alpenglow/query.h>
#include <alpenglow/reference/reference.h>

#include <string>
#include <vector>

namespace alpenglow::truth {

/// Bands of the sun's elevation, each from its lower bound (included) to the next one's.
enum class Band { Day, Low, Civil, Nautical, Astronomical, Night };
inline constexpr Band kBands[] = {Band::Day, Band::Low, Band::Civil, Band::Nautical,
                                  Band::Astronomical};
/// "day", "low", ... ; Night is what lies below -18 degrees.
const char* bandName(Band band);
Band bandOf(double sunElevation);  ///< Radians.

/// One query with its truth.
struct TruthQuery {
  std::string id;    ///< Unique in its set: "kind/sun/...".
  std::string kind;  ///< The id up to its first '/': sky, horizon, aureole, antisolar, down, limb,
                     ///< space, segment or irradiance.
  ProbeQuery query;
  double sunElevation = 0.0;  ///< The one that sets the band, radians: bandSunElevation().
  Band band = Band::Day;
  Spectrum groundIrradiance;  ///< E: diffuse, on the ground, under the sun that sets the band.
  ReferenceAnswer truth;
};

/// One atmosphere's truth.
struct TruthSet {
  std::string name;
  Parameters parameters;
  std::vector<TruthQuery> queries;  ///< As the file has them; rays and irradiances mixed.
};

/// Names of the sets kept in a folder: the presets first, then the hard ones.
std::vector<std::string> truthNames(const std::string& folder);
io::Result<TruthSet> loadTruth(const std::string& folder, const std::string& name);

/// Errors of an answer in the project's measure, as fractions (0.01 is 1 %); the worst channel.
/// Fields that the query's kind lacks are 0.
struct AnswerError {
  double total = 0.0;          ///< Sky and ground radiance together: what a pixel shows.
  double sky = 0.0;            ///< sky_radiance alone.
  double ground = 0.0;         ///< ground_radiance alone.
  double transmittance = 0.0;  ///< |T - ref| / max(ref, 0.001).
  double direct = 0.0;         ///< Irradiance queries: direct, and sky in skyIrradiance.
  double skyIrradiance = 0.0;
};
AnswerError errorOf(const TruthQuery& query, const ProbeAnswer& answer);

/// The standard error of the truth itself in the same measure: what errorOf can't see below.
AnswerError truthError(const TruthQuery& query);

/// |value - reference| / max(reference, 0.02 E / pi, 1e-9) of one channel.
double relativeError(double value, double reference, double groundIrradiance);

/// The p-th percentile (0 to 100) of values, by linear interpolation; 0 of none.
double percentile(std::vector<double> values, double p);

}  // namespace alpenglow::truth
