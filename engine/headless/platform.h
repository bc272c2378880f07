// Differences between systems: libraries opened at run time, and CPU time.
#pragma once

#include <string>

namespace alpenglow::headless {

#ifdef _WIN32
inline constexpr char kLoader[] = "vulkan-1.dll";
inline constexpr char kLoaderComesWith[] = "a Vulkan driver";
#else
inline constexpr char kLoader[] = "libvulkan.so.1";
inline constexpr char kLoaderComesWith[] = "the package libvulkan1";
#endif

/// Null on failure, with the system's words in `reason`.
void* openLibrary(const char* name, std::string* reason);
/// Null where the library has no such function.
void* findFunction(void* library, const char* name);
void closeLibrary(void* library);

/// Keeps the libraries of drivers and layers that are loaded now until the process ends, in a build
/// with a sanitizer; does nothing in others. When a module is unloaded, a sanitizer loses the
/// pointers and names by which it distinguishes the module's memory and threads from ours.
void keepDrivers();

/// User CPU time of the whole process, so that of a software driver's threads too.
double userSeconds();

}  // namespace alpenglow::headless
