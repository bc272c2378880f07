// Atmosphere files (docs/schema/atmosphere.schema.json): the parameters of an atmosphere as JSON,
// lengths in metres, angles in degrees.
#pragma once

#include <alpenglow/io/result.h>
#include <alpenglow/parameters.h>

#include <string>

namespace alpenglow::io {

/// Parses and validates. `name` is how messages name the source.
Result<Parameters> parseAtmosphere(const std::string& text, const std::string& name);
Result<Parameters> readAtmosphere(const std::string& path);

/// The file's text. Reading it back gives the same parameters, bit for bit, except for a sun's
/// radius that equals no number of degrees (one in eleven): it comes back as a neighbouring double.
std::string formatAtmosphere(const Parameters& parameters);
Done writeAtmosphere(const std::string& path, const Parameters& parameters);

/// A preset if one has this name, else the atmosphere file of this name.
Result<Parameters> findAtmosphere(const std::string& nameOrPath);

/// Empty when both describe the same atmosphere, else the first field that differs with both
/// values, each followed by its `where`: "mie.asymmetry is 0.76 in the file and 0.8 in the scene".
std::string firstDifference(const Parameters& a, const Parameters& b,
                            const std::string& whereA = "", const std::string& whereB = "");

}  // namespace alpenglow::io
