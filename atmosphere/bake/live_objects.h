// What the host has made on a context and not destroyed, whatever room it is of.
#pragma once

#include <atomic>
#include <cstdint>

namespace alpenglow::bake {

/// Owned by the context. Thread-safe.
struct LiveObjects {
  std::atomic<uint32_t> tables{0}, views{0};
  std::atomic<uint64_t> tablesMade{0};  ///< Numbers them: an address may come again, an id never.
};

}  // namespace alpenglow::bake
