// Tables of the public API: argument checks, then the rooms below.
#include <alpenglow/tables.h>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/api/solver_plan.h"
#include "atmosphere/model/solvers.h"

namespace alpenglow {
inline namespace v1 {
// What a call defers to its frame would be freed while it is recorded, if that had completed.
Status checkFrame(const Tables& tables, const FrameInfo& frame, const char* call) {
  if (frame.submitting > frame.completed) return Status::Ok;
  return tables.resources().device().fail(Status::InvalidArgument, VK_SUCCESS,
                                          "%s got the frame {submitting %llu, completed %llu}, but "
                                          "the frame being recorded must be above "
                                          "the last completed one; count from 1.",
                                          call, static_cast<unsigned long long>(frame.submitting),
                                          static_cast<unsigned long long>(frame.completed));
}

Status nullArgument(const Context* context, const char* call) {
  if (context == nullptr) return Status::InvalidArgument;
  return context->device->fail(Status::InvalidArgument, VK_SUCCESS,
                               "%s got a null argument, but needs all of them.", call);
}

Status nullArgument(const Tables* tables, const char* call) {
  return nullArgument(tables != nullptr ? tables->resources().context : nullptr, call);
}

DiagnosticSink sinkOf(const Context& context) {
  return {[](void* user, const Diagnostic& diagnostic) {
            static_cast<const engine::Device*>(user)->fail(diagnostic.status, diagnostic.result,
                                                           "%s", diagnostic.message);
          },
          context.device};
}

Status createTables(Context* context, const Parameters& parameters, const TableDesc& desc,
                    Tables** out) {
  if (context == nullptr || out == nullptr) return nullArgument(context, "createTables");
  *out = nullptr;
  TableDesc full = desc;
  Status status = resolveTableDesc(parameters, &full, sinkOf(*context));
  if (status == Status::Ok) status = bake::checkDeviceLimits(*context->device, full);
  if (status != Status::Ok) return status;
  const bool bakes = (context->capabilities & kCapabilityBake) != 0;
  if (!bakes && isModel(full.solver)) {
    return context->device->fail(Status::Unsupported, VK_SUCCESS,
                                 "Tables of Solver::%s can only be baked, but the context was made "
                                 "without kCapabilityBake.",
                                 solverEnumerator(full.solver));
  }
  return Tables::create(*context->bake, bake::simulated(parameters, desc.disabledEffects), full, solverPlan, bakes, out);
}

void destroyTables(Tables* tables, const FrameInfo& frame) { Tables::destroy(tables, frame); }

Status recordBake(Tables* tables, VkCommandBuffer commands, const FrameInfo& frame, uint64_t budget,
                  BakeProgress* progress) {
  if (tables == nullptr || commands == VK_NULL_HANDLE) return nullArgument(tables, "recordBake");
  const Status status = checkFrame(*tables, frame, "recordBake");
  if (status != Status::Ok) return status;
  return tables->recordBake(commands, frame, budget, progress);
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

Status recordTableUpload(Tables* tables, VkCommandBuffer commands, const FrameInfo& frame,
                         TableId id, VkBuffer buffer, VkDeviceSize offset) {
  if (tables == nullptr || commands == VK_NULL_HANDLE)
    return nullArgument(tables, "recordTableUpload");
  const Status status = checkFrame(*tables, frame, "recordTableUpload");
  if (status != Status::Ok) return status;
  return tables->recordUpload(commands, frame, id, buffer, offset);
}

}  // namespace v1
}  // namespace alpenglow
