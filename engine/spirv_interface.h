// The interface of a shader module, read from SPIR-V, so that a host's own code can be compared
// with ours before a driver gets it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace alpenglow::engine {

/// A resource that a module declares. `kind` is equal for equal descriptor types and dimensions.
struct SpirvResource {
  uint32_t set = 0, binding = 0;
  uint32_t kind = 0;
  uint32_t count = 1;  ///< Of an array its length; 0 where it has none.
};

struct SpirvInterface {
  bool hasMain = false;
  uint32_t model = 0;          ///< Execution model of the entry point "main".
  uint32_t localSize[3] = {};  ///< Of compute; 0 where constants decide.
  bool pushConstants = false;
  uint64_t pushConstantEnd = 0;  ///< Bytes from the block's first to its last, and the offset.
  std::vector<SpirvResource> resources;
};

/// Never reads outside of the words. Null, or why they are no module: the end of a sentence, such
/// as "an instruction that is cut off". Throws std::bad_alloc.
const char* readInterface(const uint32_t* code, size_t bytes, SpirvInterface* out);

/// "a storage buffer" for a kind.
const char* kindName(uint32_t kind);

}  // namespace alpenglow::engine
