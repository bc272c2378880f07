// What the public handle alpenglow::Context points to.
#pragma once

#include <alpenglow/context.h>

#include "atmosphere/passes/probe_pass.h"
#include "atmosphere/tables/resources.h"

namespace alpenglow {
inline namespace v1_0 {

struct Context {
  engine::Device* device = nullptr;
  CapabilityFlags capabilities = 0;
  tables::Resources* bake = nullptr;   ///< Layouts that every capability needs.
  passes::ProbePass* probe = nullptr;  ///< Only with kCapabilityBake.
};

/// Ok, or Unsupported with a sentence when the context was made without the capability.
Status requireCapability(const Context& context, CapabilityFlags capability, const char* call);

/// InvalidArgument, with a sentence where there is a context, or tables of one, to say it.
Status nullArgument(const Context* context, const char* call);
Status nullArgument(const Tables* tables, const char* call);

}  // namespace v1_0
}  // namespace alpenglow
