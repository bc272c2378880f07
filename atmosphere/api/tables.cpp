// Tables of the public API: argument checks, then atmosphere/tables.
#include <alpenglow/tables.h>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/api/solver_plan.h"
#include "atmosphere/parameters/solvers.h"

namespace alpenglow {
inline namespace v1_0 {

Status nullArgument(const Context* context, const char* call) {
  if (context == nullptr) return Status::InvalidArgument;
  return context->device->fail(Status::InvalidArgument, VK_SUCCESS,
                               "%s got a null argument, but needs all of them.", call);
}

Status nullArgument(const Tables* tables, const char* call) {
  return nullArgument(tables != nullptr ? tables->resources().context : nullptr, call);
}

Status createTables(Context* context, const Parameters& parameters, const TableDesc& desc,
                    Tables** out) {
  if (context == nullptr || out == nullptr) return nullArgument(context, "createTables");
  *out = nullptr;
  TableDesc full = desc;
  Status status = resolveTableDesc(parameters, &full, context->device->sink());
  if (status == Status::Ok) status = tables::checkDeviceLimits(*context->device, full);
  if (status != Status::Ok) return status;
  const bool bakes = (context->capabilities & kCapabilityBake) != 0;
  if (!bakes && isModel(full.solver)) {
    return context->device->fail(Status::Unsupported, VK_SUCCESS,
                                 "Tables of Solver::%s can only be baked, but the context was made "
                                 "without kCapabilityBake.",
                                 solverEnumerator(full.solver));
  }
  return Tables::create(*context->bake, tables::simulated(parameters, desc.disabledEffects), full,
                        solverPlan, bakes, out);
}

void destroyTables(Tables* tables) {
  if (tables != nullptr) Tables::destroy(tables, tables->resources().device().submitting());
}

Status recordBake(Tables* tables, VkCommandBuffer commands, uint64_t budget,
                  BakeProgress* progress) {
  if (tables == nullptr || commands == VK_NULL_HANDLE) return nullArgument(tables, "recordBake");
  return tables->recordBake(commands, budget, progress);
}

Status tablesInfo(const Tables* tables, TablesInfo* out) {
  if (tables == nullptr || out == nullptr) return nullArgument(tables, "tablesInfo");
  tables->info(out);
  return Status::Ok;
}

Status recordTableReadback(Tables* tables, VkCommandBuffer commands, TableId id, VkBuffer buffer,
                           VkDeviceSize offset) {
  if (tables == nullptr || commands == VK_NULL_HANDLE)
    return nullArgument(tables, "recordTableReadback");
  return tables->recordReadback(commands, id, buffer, offset);
}

Status recordTableUpload(Tables* tables, VkCommandBuffer commands, TableId id, VkBuffer buffer,
                         VkDeviceSize offset) {
  if (tables == nullptr || commands == VK_NULL_HANDLE)
    return nullArgument(tables, "recordTableUpload");
  return tables->recordUpload(commands, id, buffer, offset);
}

}  // namespace v1_0
}  // namespace alpenglow
