// The version of these headers. Source-compatible within a major version.
#pragma once

#define ALPENGLOW_VERSION_MAJOR 1
#define ALPENGLOW_VERSION_MINOR 0
#define ALPENGLOW_VERSION_PATCH 0
#define ALPENGLOW_VERSION_STRING "1.0.0"
