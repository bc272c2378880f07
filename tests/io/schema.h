// The part of JSON Schema (2020-12) that docs/schema uses, for tests: type, const, enum, required,
// properties, additionalProperties, items, minItems, maxItems, the bounds of numbers, anyOf, oneOf,
// and $ref to "#/$defs/..." or to another file of the folder. Any other keyword fails the test.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace alpenglow::test {

/// Empty when `value` obeys the schema `name` (such as "scene.schema.json") of `folder`, else where
/// and why not.
std::string schemaError(const std::string& folder, const std::string& name,
                        const nlohmann::json& value);

}  // namespace alpenglow::test
