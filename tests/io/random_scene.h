// Scenes by chance that a scene file can hold.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <random>

namespace alpenglow::test {

/// Where a random scene's angles come from: degrees, as a file's do, or any double of radians.
enum class Angles { OfDegrees, OfRadians };

/// Every option is there in half of the scenes. Paths are absolute.
io::Scene randomScene(std::mt19937_64* random, Angles angles);

}  // namespace alpenglow::test
