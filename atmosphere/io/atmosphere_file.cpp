#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/file.h>

#include "atmosphere/io/atmosphere_json.h"

namespace alpenglow::io {
namespace {

OrderedJson spectrumToJson(const Spectrum& spectrum) {
  OrderedJson array = OrderedJson::array();
  for (const double value : spectrum.value) array.push_back(value);
  return array;
}

RayleighParameters rayleighFromJson(JsonErrors* errors, const Json& value,
                                    const std::string& prefix) {
  ObjectReader reader(errors, value, prefix, "", {"scattering_per_m", "scale_height_m"});
  RayleighParameters rayleigh;
  rayleigh.present = true;
  rayleigh.scattering_per_m = reader.spectrum("scattering_per_m");
  rayleigh.scaleHeight_m = reader.number("scale_height_m");
  return rayleigh;
}

MieParameters mieFromJson(JsonErrors* errors, const Json& value, const std::string& prefix) {
  ObjectReader reader(errors, value, prefix, "",
                      {"scattering_per_m", "extinction_per_m", "scale_height_m", "asymmetry"});
  MieParameters mie;
  mie.present = true;
  mie.scattering_per_m = reader.spectrum("scattering_per_m");
  mie.extinction_per_m = reader.spectrum("extinction_per_m");
  mie.scaleHeight_m = reader.number("scale_height_m");
  mie.asymmetry = reader.number("asymmetry");
  return mie;
}

AbsorptionParameters absorptionFromJson(JsonErrors* errors, const Json& value,
                                        const std::string& prefix) {
  ObjectReader reader(errors, value, prefix, "", {"extinction_per_m", "center_m", "half_width_m"});
  AbsorptionParameters absorption;
  absorption.present = true;
  absorption.extinction_per_m = reader.spectrum("extinction_per_m");
  absorption.center_m = reader.number("center_m");
  absorption.halfWidth_m = reader.number("half_width_m");
  return absorption;
}

}  // namespace

Parameters atmosphereFromJson(JsonErrors* errors, const Json& value, const std::string& prefix) {
  ObjectReader reader(
      errors, value, prefix, "",
      {"bottom_radius_m", "top_radius_m", "wavelengths_nm", "rayleigh", "mie", "absorption",
       "ground_albedo", "solar_irradiance", "sun_angular_radius_deg"});
  Parameters parameters;
  parameters.bottomRadius_m = reader.number("bottom_radius_m");
  parameters.topRadius_m = reader.number("top_radius_m");
  parameters.wavelengths_nm = reader.spectrum("wavelengths_nm");
  const Json& rayleigh = reader.required("rayleigh");
  if (!rayleigh.is_null()) {
    parameters.rayleigh = rayleighFromJson(errors, rayleigh, prefix + "rayleigh.");
  }
  const Json& mie = reader.required("mie");
  if (!mie.is_null()) parameters.mie = mieFromJson(errors, mie, prefix + "mie.");
  const Json& absorption = reader.required("absorption");
  if (!absorption.is_null()) {
    parameters.absorption = absorptionFromJson(errors, absorption, prefix + "absorption.");
  }
  parameters.groundAlbedo = reader.spectrum("ground_albedo");
  parameters.solarIrradiance = reader.spectrum("solar_irradiance");
  parameters.sunAngularRadius = radians(reader.number("sun_angular_radius_deg"));
  std::string message;
  const DiagnosticSink sink = {[](void* user, const Diagnostic& diagnostic) {
                                 *static_cast<std::string*>(user) = diagnostic.message;
                               },
                               &message};
  if (errors->ok() && validate(parameters, sink) != Status::Ok) {
    errors->first =
        "In '" + errors->file + (errors->where.empty() ? "': " : "', ") + errors->where + message;
  }
  return parameters;
}

OrderedJson atmosphereToJson(const Parameters& parameters) {
  OrderedJson value;
  value["bottom_radius_m"] = parameters.bottomRadius_m;
  value["top_radius_m"] = parameters.topRadius_m;
  value["wavelengths_nm"] = spectrumToJson(parameters.wavelengths_nm);
  value["rayleigh"] = nullptr;
  if (parameters.rayleigh.present) {
    value["rayleigh"] = {{"scattering_per_m", spectrumToJson(parameters.rayleigh.scattering_per_m)},
                         {"scale_height_m", parameters.rayleigh.scaleHeight_m}};
  }
  value["mie"] = nullptr;
  if (parameters.mie.present) {
    value["mie"] = {{"scattering_per_m", spectrumToJson(parameters.mie.scattering_per_m)},
                    {"extinction_per_m", spectrumToJson(parameters.mie.extinction_per_m)},
                    {"scale_height_m", parameters.mie.scaleHeight_m},
                    {"asymmetry", parameters.mie.asymmetry}};
  }
  value["absorption"] = nullptr;
  if (parameters.absorption.present) {
    value["absorption"] = {
        {"extinction_per_m", spectrumToJson(parameters.absorption.extinction_per_m)},
        {"center_m", parameters.absorption.center_m},
        {"half_width_m", parameters.absorption.halfWidth_m}};
  }
  value["ground_albedo"] = spectrumToJson(parameters.groundAlbedo);
  value["solar_irradiance"] = spectrumToJson(parameters.solarIrradiance);
  value["sun_angular_radius_deg"] = shortestDegrees(parameters.sunAngularRadius);
  return value;
}

Result<Parameters> parseAtmosphere(const std::string& text, const std::string& name) {
  const Result<Json> value = parseJson(text, name);
  if (!value) return Result<Parameters>::failure(value.error);
  JsonErrors errors{name, {}};
  const Parameters parameters = atmosphereFromJson(&errors, *value, "");
  if (!errors.ok()) return Result<Parameters>::failure(errors.first);
  return parameters;
}

Result<Parameters> readAtmosphere(const std::string& path) {
  const Result<std::string> text = readFile(path, kMaxJsonBytes);
  if (!text) return Result<Parameters>::failure(text.error);
  return parseAtmosphere(*text, path);
}

std::string formatAtmosphere(const Parameters& parameters) {
  return formatJson(atmosphereToJson(parameters));
}

Done writeAtmosphere(const std::string& path, const Parameters& parameters) {
  const std::string text = formatAtmosphere(parameters);
  return writeFile(path, text.data(), text.size());
}

Result<Parameters> findAtmosphere(const std::string& nameOrPath) {
  Parameters parameters;
  if (findPreset(nameOrPath.c_str(), &parameters, {}) == Status::Ok) return parameters;
  return readAtmosphere(nameOrPath);
}

std::string firstDifference(const Parameters& a, const Parameters& b, const std::string& whereA,
                            const std::string& whereB) {
  const OrderedJson left = atmosphereToJson(a).flatten();
  const OrderedJson right = atmosphereToJson(b).flatten();
  for (const OrderedJson* keys : {&left, &right}) {
    for (const auto& item : keys->items()) {
      const std::string& key = item.key();
      const OrderedJson* x = left.contains(key) ? &left.at(key) : nullptr;
      const OrderedJson* y = right.contains(key) ? &right.at(key) : nullptr;
      if (x != nullptr && y != nullptr && *x == *y) continue;
      std::string field = key.substr(1);
      for (char& c : field) c = c == '/' ? '.' : c;
      const auto show = [](const OrderedJson* v) { return v == nullptr ? "absent" : v->dump(); };
      return field + " is " + show(x) + whereA + " and " + show(y) + whereB;
    }
  }
  return {};
}

}  // namespace alpenglow::io
