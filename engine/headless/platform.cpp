#include "engine/headless/platform.h"

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <dlfcn.h>
#include <sys/resource.h>
#endif

// GCC has macros for it, clang has features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ALPENGLOW_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ALPENGLOW_SANITIZED
#endif
#endif
#if defined(ALPENGLOW_SANITIZED) && defined(__linux__)
#define ALPENGLOW_KEEP_DRIVERS
#include <link.h>

#include <cstring>
#endif

namespace alpenglow::headless {

#ifdef _WIN32

void* openLibrary(const char* name, std::string* reason) {
  const HMODULE library = LoadLibraryA(name);
  if (library == nullptr) *reason = "error " + std::to_string(GetLastError()) + " of Windows";
  return library;
}

void* findFunction(void* library, const char* name) {
  return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}

void closeLibrary(void* library) { FreeLibrary(static_cast<HMODULE>(library)); }

double userSeconds() {
  FILETIME created = {}, ended = {}, kernel = {}, user = {};
  GetProcessTimes(GetCurrentProcess(), &created, &ended, &kernel, &user);
  return 1e-7 * (4294967296.0 * user.dwHighDateTime + user.dwLowDateTime);
}

#else

void* openLibrary(const char* name, std::string* reason) {
  void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* words = dlerror();
    *reason = words != nullptr ? words : "no reason given";
  }
  return library;
}

void* findFunction(void* library, const char* name) { return dlsym(library, name); }

void closeLibrary(void* library) { dlclose(library); }

double userSeconds() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

#endif

#ifdef ALPENGLOW_KEEP_DRIVERS
namespace {

int addName(dl_phdr_info* info, size_t, void* names) {
  if (std::strstr(info->dlpi_name, "ulkan") != nullptr ||
      std::strstr(info->dlpi_name, "libVkLayer") != nullptr) {
    *static_cast<std::string*>(names) += std::string(info->dlpi_name) + '\n';
  }
  return 0;
}

}  // namespace

void keepDrivers() {
  std::string names;  // One a line: opening them while iterating the list would deadlock.
  dl_iterate_phdr(addName, &names);
  for (size_t start = 0, end = 0; (end = names.find('\n', start)) != std::string::npos;
       start = end + 1) {
    (void)dlopen(names.substr(start, end - start).c_str(), RTLD_NOW | RTLD_NODELETE);
  }
}
#else
void keepDrivers() {}
#endif

}  // namespace alpenglow::headless
