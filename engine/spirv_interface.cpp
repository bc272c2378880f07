#include "engine/spirv_interface.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

namespace alpenglow::engine {
namespace {

// Numbers of the SPIR-V specification, version 1.6.
enum Op : uint32_t {
  kEntryPoint = 15,
  kExecutionMode = 16,
  kTypeInt = 21,
  kTypeFloat = 22,
  kTypeVector = 23,
  kTypeMatrix = 24,
  kTypeImage = 25,
  kTypeSampler = 26,
  kTypeSampledImage = 27,
  kTypeArray = 28,
  kTypeRuntimeArray = 29,
  kTypeStruct = 30,
  kTypePointer = 32,
  kConstant = 43,
  kSpecConstant = 50,
  kVariable = 59,
  kDecorate = 71,
  kMemberDecorate = 72,
};
constexpr uint32_t kMagic = 0x07230203, kLocalSize = 17;
constexpr uint32_t kBufferBlock = 3, kBinding = 33, kDescriptorSet = 34, kOffset = 35;
constexpr uint32_t kArrayStride = 6, kMatrixStride = 7;
constexpr uint32_t kUniformConstant = 0, kUniform = 2, kPushConstant = 9, kStorageBuffer = 12;
constexpr size_t kHeaderWords = 5;
constexpr uint32_t kMostIds = 1u << 20;  // Our largest shader has some thousands.

/// Stored properties of an id.
struct Id {
  uint32_t op = 0;
  uint32_t type = 0;     ///< Pointee, element, image; of a variable its pointer.
  uint32_t storage = 0;  ///< Of a variable.
  uint32_t shape = 0;    ///< Of an image: dimensions, arrayed, sampled.
  bool bufferBlock = false, hasSet = false, hasBinding = false;
  uint32_t set = 0, binding = 0;
  uint64_t size = 0;   ///< Of a type in a block, bytes.
  uint32_t count = 0;  ///< Of an array its length; of a constant its value.
  uint32_t stride = 0;
};

/// Where a structure's member lies.
struct Member {
  uint32_t offset = 0, matrixStride = 0;
};

/// One instruction: its words without the first.
struct Instruction {
  uint32_t op = 0;
  const uint32_t* words = nullptr;
  uint32_t count = 0;
};

class Module {
 public:
  explicit Module(uint32_t bound) : ids_(bound) {}

  /// False: an id is beyond the bound or a word is missing.
  bool add(const Instruction& i, SpirvInterface* out) {
    switch (i.op) {
      case kEntryPoint:
        return addEntryPoint(i, out);
      case kExecutionMode:
        if (i.count >= 5 && i.words[1] == kLocalSize && i.words[0] == main_) {
          std::copy_n(i.words + 2, 3, out->localSize);
        }
        return i.count >= 2;
      case kTypeImage:
        if (i.count < 7 || !define(i, 0)) return false;
        ids_[i.words[0]].shape = i.words[2] | i.words[4] << 8 | i.words[5] << 9 | i.words[6] << 10;
        return true;
      case kTypeSampledImage:
      case kTypeRuntimeArray:
        return i.count >= 2 && define(i, i.words[1]);
      case kTypeSampler:
        return i.count >= 1 && define(i, 0);
      case kTypeInt:
      case kTypeFloat:
        if (i.count < 2 || !define(i, 0)) return false;
        ids_[i.words[0]].size = i.words[1] / 8;
        return true;
      case kTypeVector:
      case kTypeMatrix:
        if (i.count < 3 || !define(i, i.words[1])) return false;
        ids_[i.words[0]].count = i.words[2];
        ids_[i.words[0]].size = ids_[i.words[1]].size * i.words[2];
        return true;
      case kTypeArray:
        return addArray(i);
      case kTypeStruct:
        return addStruct(i);
      case kConstant:
      case kSpecConstant:
        if (i.count < 3 || i.words[1] >= ids_.size()) return false;
        ids_[i.words[1]].count = i.words[2];
        return true;
      case kTypePointer:
        return i.count >= 3 && define(i, i.words[2]);
      case kVariable:
        if (i.count < 3 || i.words[1] >= ids_.size() || i.words[0] >= ids_.size()) return false;
        ids_[i.words[1]].op = kVariable;
        ids_[i.words[1]].type = i.words[0];
        ids_[i.words[1]].storage = i.words[2];
        return true;
      case kDecorate:
        return decorate(i);
      case kMemberDecorate:
        if (i.count < 3 || i.words[0] >= ids_.size()) return false;
        if (i.count < 4) return true;
        if (i.words[2] == kOffset) members_[{i.words[0], i.words[1]}].offset = i.words[3];
        if (i.words[2] == kMatrixStride) {
          members_[{i.words[0], i.words[1]}].matrixStride = i.words[3];
        }
        return true;
      default:
        return true;
    }
  }

  void collect(SpirvInterface* out) const {
    for (const Id& variable : ids_) {
      if (variable.op != kVariable) continue;
      uint32_t count = 1;
      const Id* type = pointee(variable, &count);
      if (variable.storage == kPushConstant) {
        out->pushConstants = true;
        out->pushConstantEnd = std::max(out->pushConstantEnd, type->size);
      }
      if (!variable.hasSet && !variable.hasBinding) continue;
      const uint32_t storage =
          variable.storage == kUniform && type->bufferBlock ? kStorageBuffer : variable.storage;
      uint32_t kind = storage << 24 | type->op << 16;
      if (type->op == kTypeSampledImage) kind |= ids_[type->type].shape;
      if (type->op == kTypeImage) kind |= type->shape;
      out->resources.push_back({variable.set, variable.binding, kind, count});
    }
  }

 private:
  bool define(const Instruction& i, uint32_t type) {
    if (i.words[0] >= ids_.size() || type >= ids_.size()) return false;
    ids_[i.words[0]].op = i.op;
    ids_[i.words[0]].type = type;
    return true;
  }

  // Types come after what they are made of, and after their decorations.
  bool addArray(const Instruction& i) {
    if (i.count < 3 || i.words[2] >= ids_.size() || !define(i, i.words[1])) return false;
    Id& id = ids_[i.words[0]];
    id.count = ids_[i.words[2]].count;
    id.size = id.count * std::max<uint64_t>(id.stride, ids_[i.words[1]].size);
    return true;
  }

  bool addStruct(const Instruction& i) {
    if (i.count < 1 || !define(i, 0)) return false;
    uint64_t end = 0;
    for (uint32_t k = 1; k < i.count; ++k) {
      if (i.words[k] >= ids_.size()) return false;
      const Id& type = ids_[i.words[k]];
      const auto found = members_.find({i.words[0], k - 1});
      const Member member = found == members_.end() ? Member{} : found->second;
      const uint64_t size = type.op == kTypeMatrix && member.matrixStride != 0
                                ? uint64_t{member.matrixStride} * type.count
                                : type.size;
      end = std::max(end, member.offset + size);
    }
    ids_[i.words[0]].size = end;
    return true;
  }

  bool decorate(const Instruction& i) {
    if (i.count < 2 || i.words[0] >= ids_.size()) return false;
    Id& id = ids_[i.words[0]];
    if (i.words[1] == kBufferBlock) id.bufferBlock = true;
    if (i.words[1] == kArrayStride && i.count >= 3) id.stride = i.words[2];
    if (i.words[1] != kBinding && i.words[1] != kDescriptorSet) return true;
    if (i.count < 3) return false;
    const bool binding = i.words[1] == kBinding;
    (binding ? id.binding : id.set) = i.words[2];
    (binding ? id.hasBinding : id.hasSet) = true;
    return true;
  }

  bool addEntryPoint(const Instruction& i, SpirvInterface* out) {
    if (i.count < 3) return false;
    const uint32_t main[] = {0x6E69616Du, 0};  // "main", as words.
    if (i.count < 4 || std::memcmp(i.words + 2, main, sizeof main) != 0) return true;
    out->hasMain = true;
    out->model = i.words[0];
    main_ = i.words[1];
    return true;
  }

  // The type of a variable, without pointers and arrays, and their count. A longer chain is no
  // valid type.
  const Id* pointee(const Id& variable, uint32_t* count) const {
    const Id* type = &ids_[variable.type];
    for (int i = 0; i < 8; ++i) {
      if (type->op != kTypePointer && type->op != kTypeArray && type->op != kTypeRuntimeArray)
        break;
      if (type->op != kTypePointer) *count *= type->count;  // 0 of a runtime array.
      type = &ids_[type->type];
    }
    return type;
  }

  std::vector<Id> ids_;
  std::map<std::pair<uint32_t, uint32_t>, Member> members_;
  uint32_t main_ = 0;  ///< The id of its function.
};

}  // namespace

const char* readInterface(const uint32_t* code, size_t bytes, SpirvInterface* out) {
  *out = {};
  const size_t words = bytes / 4;
  if (code == nullptr || bytes % 4 != 0 || words < kHeaderWords || code[0] != kMagic) {
    return "no whole words that start with 0x07230203";
  }
  if (code[3] > kMostIds) return "more ids than any shader has";
  Module module(code[3]);
  for (size_t at = kHeaderWords; at < words;) {
    const uint32_t length = code[at] >> 16;
    if (length == 0 || length > words - at) return "an instruction that is cut off";
    if (!module.add({code[at] & 0xFFFFu, code + at + 1, length - 1}, out)) {
      return "an instruction with an id beyond the bound or too few words";
    }
    at += length;
  }
  if (!out->hasMain) return "no entry point \"main\"";
  module.collect(out);
  return nullptr;
}

const char* kindName(uint32_t kind) {
  switch (kind >> 24) {
    case kUniform:
      return "a uniform buffer";
    case kStorageBuffer:
      return "a storage buffer";
    case kUniformConstant:
      break;
    default:
      return "another thing";
  }
  const uint32_t op = kind >> 16 & 0xFFu;
  if (op == kTypeSampledImage) return "a sampled image";
  if (op == kTypeImage) return "a storage image";
  return op == kTypeSampler ? "a sampler" : "another thing";
}

}  // namespace alpenglow::engine
