// User CPU of this process, which on software Vulkan is what its device takes.
#pragma once

#include <sys/resource.h>

namespace alpenglow::testing {

/// Of all threads, since the start.
inline double userSeconds() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_utime.tv_sec) + 1e-6 * double(usage.ru_utime.tv_usec);
}

}  // namespace alpenglow::testing
