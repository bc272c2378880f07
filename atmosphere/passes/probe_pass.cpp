#include "atmosphere/passes/probe_pass.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <new>

#include "atmosphere/parameters/query.h"
#include "atmosphere/passes/shader_choice.h"
#include "atmosphere/tables/effect_constants.h"
#include "engine/exceptions.h"

namespace alpenglow::passes {
namespace {

constexpr uint32_t kIrradiance = 1, kHitsGround = 2, kEndsOnGround = 4, kEmpty = 8;
constexpr uint32_t kGroupSize = 64;

constexpr VkDescriptorSetLayoutBinding kBindings[2] = {
    {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
    {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};

Status checkQuery(const engine::Device& device, uint32_t index, const ProbeQuery& query) {
  if (query.kind > QueryKind::Irradiance) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ProbeQuery %u has kind = %u, but the enumeration ends at %u.", index,
                       static_cast<uint32_t>(query.kind),
                       static_cast<uint32_t>(QueryKind::Irradiance));
  }
  if (query.light != 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ProbeQuery %u has light = %u, but it must be 0 in this version.", index,
                       query.light);
  }
  constexpr double kPi = 3.14159265358979323846;
  const bool ray = query.kind == QueryKind::Ray;
  // The members of a ray must be 0 for an irradiance: they have no effect.
  const struct {
    const char* name;
    double value, least, most;
  } fields[] = {{"altitude_m", query.altitude_m, 0.0, 1e12},
                {"zenith", query.zenith, 0.0, ray ? kPi : 0.0},
                {"sunZenith", query.sunZenith, 0.0, kPi},
                {"azimuth", query.azimuth, ray ? -1e9 : 0.0, ray ? 1e9 : 0.0},
                {"bounded", query.bounded ? 1.0 : 0.0, 0.0, ray ? 1.0 : 0.0},
                {"distance_m", query.distance_m, 0.0, query.bounded ? DBL_MAX : 0.0}};
  for (const auto& field : fields) {
    if (field.value >= field.least && field.value <= field.most) continue;
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ProbeQuery %u has %s = %g, but %s must be from %g to %g.", index,
                       field.name, field.value,
                       ray ? query.bounded ? "that of a bounded ray" : "that of an unbounded ray"
                           : "that of an irradiance",
                       field.least, field.most);
  }
  return Status::Ok;
}

}  // namespace

Status checkQueries(const engine::Device& device, const ProbeQuery* queries, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    const Status status = checkQuery(device, i, queries[i]);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

PreparedQuery prepareQuery(const physics_f64::Medium& medium, const ProbeQuery& query) {
  const auto f = [](double value) { return static_cast<float>(value); };
  PreparedQuery prepared = {};
  if (query.kind == QueryKind::Irradiance) {
    prepared.h = f(query.altitude_m);
    prepared.muS = f(std::cos(query.sunZenith));
    prepared.flags = kIrradiance | (query.altitude_m > medium.thickness ? kEmpty : 0u);
    return prepared;
  }
  const ResolvedQuery q = resolveQuery(medium, query);
  prepared.h = f(q.ray.h);
  prepared.mu = f(q.ray.mu);
  prepared.muS = f(q.ray.muS);
  prepared.nu = f(q.ray.nu);
  prepared.d = f(q.empty ? 0.0 : q.length);
  prepared.extent = f(q.ray.extent);
  prepared.muSGround = f(physics_f64::muSAt(medium, q.ray.h, q.ray.muS, q.ray.nu, q.length, 0.0));
  prepared.flags = (q.ray.hitsGround ? kHitsGround : 0u) | (q.endsOnGround ? kEndsOnGround : 0u) |
                   (q.empty ? kEmpty : 0u);
  return prepared;
}

Status ProbePass::create(tables::Resources& resources, ProbePass** out) {
  *out = nullptr;
  auto* pass = new (std::nothrow) ProbePass(resources);
  if (pass == nullptr) {
    return resources.device().fail(Status::OutOfHostMemory, VK_SUCCESS,
                                   "The probe pass found no host memory.");
  }
  const Status status = pass->makeLayouts();
  if (status != Status::Ok) {
    destroy(pass);
    return status;
  }
  *out = pass;
  return Status::Ok;
}

void ProbePass::destroy(ProbePass* pass) {
  if (pass == nullptr) return;
  const engine::Device& device = pass->device_;
  const engine::Dispatch& vk = device.vk();
  for (const auto& [key, pipeline] : pass->pipelines_)
    vk.DestroyPipeline(device.handle(), pipeline, device.allocator());
  vk.DestroyPipelineLayout(device.handle(), pass->layout_, device.allocator());
  vk.DestroyDescriptorSetLayout(device.handle(), pass->setLayout_, device.allocator());
  delete pass;
}

Status ProbePass::makeLayouts() {
  const Status status =
      engine::createSetLayout(device_, kBindings, 2, "Alpenglow probe", &setLayout_);
  if (status != Status::Ok) return status;
  const VkDescriptorSetLayout sets[] = {resources_.tableLayout(), setLayout_};
  const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(uint32_t)};
  return engine::createPipelineLayout(device_, sets, 2, &range, 1, "Alpenglow probe", &layout_);
}

Status ProbePass::pipeline(const TableDesc& tables, VkPipeline* out) {
  ALPENGLOW_TRY {
    const std::scoped_lock lock(mutex_);
    VkPipeline& slot = pipelines_[{tables.solver, tables.mie, tables.disabledEffects}];
    Status status = Status::Ok;
    if (slot == VK_NULL_HANDLE) {
      engine::SpecConstant constants[1 + tables::kEffectConstants] = {
          engine::specBool(0, tables.mie == MieStorage::Packed)};
      std::ranges::copy(tables::effectConstants(tables.disabledEffects), constants + 1);
      engine::ComputePipelineDesc desc;
      desc.shader = probeShader(tables.solver, tables.disabledEffects);
      desc.layout = layout_;
      desc.constants = constants;
      desc.constantCount = 1 + tables::kEffectConstants;
      status = engine::createComputePipeline(device_, desc, &slot);
    }
    *out = slot;
    return status;
  }
  ALPENGLOW_CATCH_BAD_ALLOC {  // No exception may reach the host.
    return device_.fail(Status::OutOfHostMemory, VK_SUCCESS, "A probe found no host memory.");
  }
}

Status ProbePass::prepareCall(const Tables& tables, const ProbeQuery* queries, uint32_t count,
                              VkBuffer answers, Call* call) {
  Status status =
      engine::createBuffer(device_, count * sizeof(PreparedQuery),
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "Alpenglow queries", &call->queries);
  if (status != Status::Ok) return status;
  engine::Buffer* buffers[] = {&call->queries};
  status = engine::allocateAndBind(
      device_, "Alpenglow queries",
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, nullptr, 0,
      buffers, 1, &call->block);
  if (status != Status::Ok) return status;
  const physics_f64::Medium medium = makeMediumF64(tables.parameters());
  auto* prepared = static_cast<PreparedQuery*>(call->queries.mapped);
  for (uint32_t i = 0; i < count; ++i) prepared[i] = prepareQuery(medium, queries[i]);

  const engine::PoolPart part = {kBindings, 2, 1};
  status = engine::createPool(device_, &part, 1, "Alpenglow probe", &call->pool);
  if (status != Status::Ok) return status;
  status = engine::allocateSets(device_, call->pool, &setLayout_, 1, "Alpenglow probe", &call->set);
  if (status != Status::Ok) return status;
  engine::DescriptorWriter writer(call->set);
  writer.storageBuffer(0, call->queries.handle).storageBuffer(1, answers);
  return writer.flush(device_);
}

Status ProbePass::record(const Tables& tables, VkCommandBuffer commands, const ProbeQuery* queries,
                         uint32_t count, VkBuffer answers) {
  const uint64_t most = device_.limits().maxStorageBufferRange / kProbeAnswerBytes;
  if (queries == nullptr || count == 0 || count > most || answers == VK_NULL_HANDLE) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordProbe got %u queries, but needs from 1 to %llu of them and a "
                        "buffer for the answers.",
                        count, static_cast<unsigned long long>(most));
  }
  constexpr VkPipelineStageFlags2 kProbing =
      VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  if ((tables.desc().readerStages & kProbing) == 0) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordProbe reads tables in the compute stage, but the readerStages of "
                        "these, 0x%llx, are without it.",
                        static_cast<unsigned long long>(tables.desc().readerStages));
  }
  Status status = checkQueries(device_, queries, count);
  if (status != Status::Ok) return status;
  status = tables.assertReadable();
  if (status != Status::Ok) return status;
  VkPipeline chosen = VK_NULL_HANDLE;
  status = pipeline(tables.desc(), &chosen);
  if (status != Status::Ok) return status;

  Call call;
  status = prepareCall(tables, queries, count, answers, &call);
  if (status == Status::Ok) {
    const engine::Dispatch& vk = device_.vk();
    const VkDescriptorSet sets[] = {tables.descriptorSet(), call.set};
    vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, chosen);
    vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 2, sets, 0,
                             nullptr);
    vk.CmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof count, &count);
    vk.CmdDispatch(commands, (count + kGroupSize - 1) / kGroupSize, 1, 1);
    ++device_.counters().dispatches;
    engine::Barriers barriers;
    barriers.memory(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                    VK_PIPELINE_STAGE_2_HOST_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    VK_ACCESS_2_HOST_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT);
    status = barriers.record(device_, commands);
  }
  const uint64_t frame = device_.submitting();
  device_.deletions().defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_POOL, engine::handleNumber(call.pool));
  engine::deferBuffer(device_, frame, &call.queries);
  engine::deferBlock(device_, frame, &call.block);
  device_.deletions().collect(device_.completed());
  return status;
}

}  // namespace alpenglow::passes
