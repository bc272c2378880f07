// Tables and probes of the public API: argument checks, then the rooms below.
#include <alpenglow/probe.h>
#include <alpenglow/tables.h>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/api/solver_plan.h"
#include "atmosphere/model/query.h"
#include "atmosphere/model/solvers.h"

namespace alpenglow {
inline namespace v1 {
Status nullArgument(const Tables* tables, const char* call) {
  if (tables == nullptr) return Status::InvalidArgument;
  return tables->resources().device().fail(Status::InvalidArgument, VK_SUCCESS,
                                           "%s got a null argument, but needs all of them.", call);
}

TableSizes defaultTableSizes() { return {256, 64, 64, 16, 32, 128, 32, 8}; }

Status createTables(Context* context, const Parameters& parameters, const TableDesc& desc,
                    Tables** out) {
  if (context == nullptr || out == nullptr) return Status::InvalidArgument;
  *out = nullptr;
  Status status = validate(parameters, context->device->sink());
  if (status != Status::Ok) return status;
  status = bake::checkTableDesc(*context->device, desc);
  if (status != Status::Ok) return status;
  const Parameters simulated = bake::simulated(parameters, desc.without);
  const TableDesc full = bake::completed(simulated, desc);
  status = bake::checkSizes(*context->device, full);
  if (status != Status::Ok) return status;
  const bool bakes = (context->capabilities & kCapabilityBake) != 0;
  if (!bakes && isModel(full.solver)) {
    return context->device->fail(Status::Unsupported, VK_SUCCESS,
                                 "Tables of Solver::%s can only be baked, but the context was made "
                                 "without kCapabilityBake.",
                                 solverEnumerator(full.solver));
  }
  return Tables::create(*context->bake, simulated, full, solverPlan, bakes, out);
}

void destroyTables(Tables* tables) {
  if (tables != nullptr) Tables::destroy(tables, tables->resources().device().submitting());
}

Status recordBake(Tables* tables, VkCommandBuffer commands, uint64_t budget,
                  BakeProgress* progress) {
  if (tables == nullptr || commands == VK_NULL_HANDLE) return nullArgument(tables, "recordBake");
  return tables->recordBake(commands, budget, progress);
}

Status tableInfo(const Tables* tables, TableId id, TableInfo* out) {
  if (tables == nullptr || out == nullptr) return nullArgument(tables, "tableInfo");
  return tables->info(id, out);
}

Status recordTableReadback(Tables* tables, VkCommandBuffer commands, TableId id, VkBuffer buffer,
                           VkDeviceSize offset) {
  if (tables == nullptr || commands == VK_NULL_HANDLE)
    return nullArgument(tables, "recordTableReadback");
  return tables->recordReadback(commands, id, buffer, offset);
}

Status recordTableUpload(Tables* tables, VkCommandBuffer commands,
                         TableId id, VkBuffer buffer, VkDeviceSize offset) {
  if (tables == nullptr || commands == VK_NULL_HANDLE)
    return nullArgument(tables, "recordTableUpload");
  return tables->recordUpload(commands, id, buffer, offset);
}

bool tablesReady(const Tables* tables) { return tables != nullptr && tables->ready(); }

VkDescriptorSetLayout tableSetLayout(const Context* context) {
  return context != nullptr ? context->bake->tableLayout() : VK_NULL_HANDLE;
}

VkDescriptorSet tableSet(const Tables* tables) {
  return tables != nullptr ? tables->descriptorSet() : VK_NULL_HANDLE;
}

Status recordProbe(Context* context, const Tables* tables, VkCommandBuffer commands, const ProbeQuery* queries, uint32_t count,
                   VkBuffer buffer) {
  if (context == nullptr || tables == nullptr || commands == VK_NULL_HANDLE)
    return nullArgument(tables, "recordProbe");
  Status status = requireCapability(*context, kCapabilityBake, "recordProbe");
  if (status != Status::Ok) return status;
  return context->probe->record(*tables, commands, queries, count, buffer);
}

Status readProbe(const Tables* tables, const ProbeQuery* queries, uint32_t count, const void* raw,
                 ProbeAnswer* answers) {
  if (tables == nullptr || queries == nullptr || raw == nullptr || answers == nullptr)
    return nullArgument(tables, "readProbe");
  const physics_f64::Medium medium = makeMediumF64(tables->parameters());
  const auto* values = static_cast<const float*>(raw);
  constexpr size_t kFloats = kProbeAnswerBytes / sizeof(float);
  for (uint32_t i = 0; i < count; ++i, values += kFloats) {
    ProbeAnswer answer;
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const double first = values[c], sky = values[4 + c], ground = values[8 + c];
      (queries[i].irradiance ? answer.direct : answer.transmittance)[c] = first;
      (queries[i].irradiance ? answer.sky : answer.skyRadiance)[c] = sky;
      answer.groundRadiance[c] = ground;
    }
    if (!queries[i].irradiance) answer.hitsGround = resolveQuery(medium, queries[i]).endsOnGround;
    answers[i] = answer;
  }
  return Status::Ok;
}

}  // namespace v1
}  // namespace alpenglow
