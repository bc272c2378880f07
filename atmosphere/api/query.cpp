// Point queries: recorded for the device, read back from it, or answered on the CPU.
#include <alpenglow/query.h>

#include <algorithm>
#include <cmath>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/api/cpu_field.h"
#include "atmosphere/parameters/solvers.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

Spectrum toPublic(const cpu::Spectrum& values) {
  Spectrum result;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) result[i] = values[static_cast<glm::length_t>(i)];
  return result;
}

physics_f32::Ray toFloat(const physics_f64::Ray& ray) {
  const auto f = [](double value) { return static_cast<float>(value); };
  return {f(ray.start), f(ray.h),      f(ray.mu),      f(ray.muS),
          f(ray.nu),    f(ray.extent), ray.hitsGround, ray.inAtmosphere};
}

ProbeAnswer irradianceAnswer(cpu::Field& field, double thickness, const ProbeQuery& query) {
  ProbeAnswer answer;
  const auto muS = static_cast<float>(std::cos(query.sunZenith));
  if (query.altitude_m > thickness) {
    answer.direct = toPublic(cpu::Spectrum(std::max(muS, 0.0f)));
    return answer;
  }
  const auto h = static_cast<float>(query.altitude_m);
  answer.direct = toPublic(field.direct(h, muS));
  answer.sky = toPublic(field.sky(h, muS));
  return answer;
}

ProbeAnswer rayAnswer(cpu::Field& field, const physics_f64::Medium& medium, bool skyRadiance,
                      const ProbeQuery& query) {
  const ResolvedQuery resolved = resolveQuery(medium, query);
  const physics_f64::Ray& exact = resolved.ray;
  const physics_f32::Ray ray = toFloat(exact);
  const auto length = static_cast<float>(resolved.empty ? 0.0 : resolved.length);
  const cpu::Spectrum transmittance = field.transmittance(ray, length);
  ProbeAnswer answer;
  answer.hitsGround = resolved.endsOnGround;
  answer.transmittance = toPublic(transmittance);
  if (skyRadiance && length > 0.0f) answer.skyRadiance = toPublic(field.skyRadiance(ray, length));
  if (resolved.endsOnGround) {
    const double muS =
        physics_f64::muSAt(medium, exact.h, exact.muS, exact.nu, resolved.length, 0.0);
    answer.groundRadiance = toPublic(transmittance * field.groundRadiance(static_cast<float>(muS)));
  }
  return answer;
}

cpu::TableCopy copyOf(const Tables& tables, TableId id) {
  const Tables::HostCopy copy = tables.hostCopy(id);
  return {copy.data, copy.extent.width, copy.extent.height, copy.extent.depth,
          copy.format == VK_FORMAT_R16G16B16A16_SFLOAT};
}

Status checkCopies(const Tables& tables) {
  const engine::Device& device = tables.resources().device();
  if (tables.desc().solver != Solver::Moments) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "answerQueries got tables of Solver::%s and no answers of the device, but "
                       "the CPU answers for Solver::Moments alone; recordProbe answers for any.",
                       solverEnumerator(tables.desc().solver));
  }
  if (tables.desc().cpuQueries == CpuQueries::None) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "answerQueries got no answers of the device, but these tables keep no host "
                       "copies: their TableDesc::cpuQueries was CpuQueries::None.");
  }
  return tables.state() == TablesState::Complete ? Status::Ok : Status::NotReady;
}

Status answerOnCpu(const Tables& tables, const ProbeQuery* queries, uint32_t count,
                   ProbeAnswer* answers) {
  const Status status = checkCopies(tables);
  if (status != Status::Ok) return status;
  const Parameters& parameters = tables.parameters();
  const TableDesc& desc = tables.desc();
  const physics_f64::Medium medium = makeMediumF64(parameters);
  cpu::Field field(makeMediumF32(parameters), tables::makeMomentShapeF32(parameters, desc),
                   desc.disabledEffects, copyOf(tables, kTableOpticalDepth),
                   copyOf(tables, kTableMoments), copyOf(tables, kTableSource));
  const bool skyRadiance = desc.cpuQueries == CpuQueries::All;
  for (uint32_t i = 0; i < count; ++i) {
    answers[i] = queries[i].kind == QueryKind::Irradiance
                     ? irradianceAnswer(field, medium.thickness, queries[i])
                     : rayAnswer(field, medium, skyRadiance, queries[i]);
  }
  return Status::Ok;
}

// Decodes what the shader has written for one query.
ProbeAnswer deviceAnswer(const physics_f64::Medium& medium, const ProbeQuery& query,
                         const float* values) {
  const bool ray = query.kind == QueryKind::Ray;
  ProbeAnswer answer;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    (ray ? answer.transmittance : answer.direct)[c] = values[c];
    (ray ? answer.skyRadiance : answer.sky)[c] = values[4 + c];
    answer.groundRadiance[c] = values[8 + c];
  }
  if (ray) answer.hitsGround = resolveQuery(medium, query).endsOnGround;
  return answer;
}

}  // namespace

Status recordProbe(const Tables* tables, VkCommandBuffer commands, const ProbeQuery* queries,
                   uint32_t count, VkBuffer buffer) {
  if (tables == nullptr || commands == VK_NULL_HANDLE) return nullArgument(tables, "recordProbe");
  const Context& context = *tables->resources().context;
  const Status status = requireCapability(context, kCapabilityBake, "recordProbe");
  if (status != Status::Ok) return status;
  return context.probe->record(*tables, commands, queries, count, buffer);
}

Status answerQueries(const Tables* tables, const ProbeQuery* queries, uint32_t count,
                     const void* deviceAnswers, ProbeAnswer* answers) {
  if (tables == nullptr || queries == nullptr || answers == nullptr)
    return nullArgument(tables, "answerQueries");
  const Status status = passes::checkQueries(tables->resources().device(), queries, count);
  if (status != Status::Ok) return status;
  if (deviceAnswers == nullptr) return answerOnCpu(*tables, queries, count, answers);
  const physics_f64::Medium medium = makeMediumF64(tables->parameters());
  const auto* values = static_cast<const float*>(deviceAnswers);
  constexpr size_t kFloats = kProbeAnswerBytes / sizeof(float);
  for (uint32_t i = 0; i < count; ++i)
    answers[i] = deviceAnswer(medium, queries[i], values + i * kFloats);
  return Status::Ok;
}

}  // namespace v1_0
}  // namespace alpenglow
