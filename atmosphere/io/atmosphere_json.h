// Atmospheres inside other files: scenes hold them inline, table files as an attribute.
#pragma once

#include "atmosphere/io/json.h"

namespace alpenglow::io {

/// Reads and validates; problems go to `errors`. `prefix` names the place, such as "atmosphere.".
Parameters atmosphereFromJson(JsonErrors* errors, const Json& value, const std::string& prefix);
OrderedJson atmosphereToJson(const Parameters& parameters);

}  // namespace alpenglow::io
