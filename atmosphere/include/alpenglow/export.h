// ALPENGLOW_API stands before each function of the interface: a shared library exports these and
// nothing else. The package defines ALPENGLOW_SHARED for users of shared libraries.
#pragma once

#if !defined(ALPENGLOW_SHARED)
#define ALPENGLOW_API
#elif !defined(_WIN32)
#define ALPENGLOW_API __attribute__((visibility("default")))
#elif defined(ALPENGLOW_BUILDING)
#define ALPENGLOW_API __declspec(dllexport)
#else
#define ALPENGLOW_API __declspec(dllimport)
#endif
