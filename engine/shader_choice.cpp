// Which code a pipeline is made of: the library's, or the host's in place of it.
#include <new>

#include "engine/exceptions.h"
#include "engine/pipeline.h"
#include "engine/spirv_interface.h"

namespace alpenglow::engine {
namespace {

Status refuse(const Device& device, const Shader& shader, const char* what) {
  return device.fail(
      Status::InvalidArgument, VK_SUCCESS,
      "The host's code for shader \"%s\" (%s::shaders) has %s, but a module that fits where the "
      "library's own does is expected.",
      shader.name, device.descName(), what);
}

const SpirvResource* find(const SpirvInterface& interface, const SpirvResource& wanted) {
  for (const SpirvResource& resource : interface.resources) {
    if (resource.set == wanted.set && resource.binding == wanted.binding &&
        resource.kind == wanted.kind && resource.count == wanted.count) {
      return &resource;
    }
  }
  return nullptr;
}

Status compare(const Device& device, const Shader& shader, const SpirvInterface& own,
               const SpirvInterface& given) {
  if (given.model != own.model) return refuse(device, shader, "an entry point of another stage");
  for (int i = 0; i < 3; ++i) {
    if (given.localSize[i] != own.localSize[i]) {
      return refuse(device, shader, "another size of its groups");
    }
  }
  if (given.pushConstants && (!own.pushConstants || given.pushConstantEnd > own.pushConstantEnd)) {
    return refuse(device, shader, "more push constants");
  }
  for (const SpirvResource& resource : given.resources) {
    if (find(own, resource) != nullptr) continue;
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The host's code for shader \"%s\" (%s::shaders) declares %s at set %u, "
                       "binding %u, where the library's own has no such thing.",
                       shader.name, device.descName(), kindName(resource.kind), resource.set,
                       resource.binding);
  }
  return Status::Ok;
}

}  // namespace

Status chooseShader(const Device& device, const Shader& own, Shader* out) {
  ALPENGLOW_TRY {
    *out = own;
    const ShaderReplacement& hook = device.shaderReplacement();
    if (hook.replace == nullptr || own.code == nullptr) return Status::Ok;
    Shader given = own;
    if (!hook.replace(hook.user, own.name, &given.code, &given.bytes)) return Status::Ok;
    SpirvInterface wanted, found;
    if (const char* why = readInterface(given.code, given.bytes, &found)) {
      return refuse(device, own, why);
    }
    if (readInterface(own.code, own.bytes, &wanted) == nullptr) {
      const Status status = compare(device, own, wanted, found);
      if (status != Status::Ok) return status;
    }
    *out = given;
    return Status::Ok;
  }
  ALPENGLOW_CATCH_BAD_ALLOC {  // No exception may reach the host.
    return device.fail(Status::OutOfHostMemory, VK_SUCCESS,
                       "There is no host memory to look at the code for shader \"%s\".", own.name);
  }
}

}  // namespace alpenglow::engine
