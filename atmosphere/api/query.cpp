// Point queries on the CPU.
#include <alpenglow/query.h>

#include <algorithm>
#include <cmath>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/api/cpu_field.h"
#include "atmosphere/model/solvers.h"

namespace alpenglow {
inline namespace v1 {
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

cpu::TableCopy copyOf(const Tables& tables, TableId id, const void* data) {
  if (data == nullptr) return {};
  TableInfo info;
  tables.info(id, &info);
  return {data, info.width, info.height, info.depth, info.format == VK_FORMAT_R16G16B16A16_SFLOAT};
}

Status checkCall(const Tables& tables, const TableReadbacks& copies, const ProbeQuery* queries,
                 uint32_t count) {
  const engine::Device& device = tables.resources().device();
  if (tables.desc().solver != Solver::Moments) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "answerQueries got tables of Solver::%s, but needs those of "
                       "Solver::Moments; recordProbe answers for any.",
                       solverEnumerator(tables.desc().solver));
  }
  bool rays = false;
  for (uint32_t i = 0; i < count; ++i) {
    const Status checked = sky::checkQuery(device, i, queries[i]);
    if (checked != Status::Ok) return checked;
    rays = rays || !queries[i].irradiance;
  }
  if (!tables.ready()) {
    return device.fail(Status::NotReady, VK_SUCCESS,
                       "answerQueries got tables that are not baked, but needs copies of tables "
                       "whose bake is done.");
  }
  const EffectFlags without = tables.desc().without;
  const bool multiple = hasEffect(without, Effect::MultipleScattering);
  const bool sources = rays && copies.skyRadiance && hasEffect(without, Effect::Mie);
  const char* missing = copies.opticalDepth == nullptr                    ? "OpticalDepth"
                        : multiple && copies.moments == nullptr           ? "Moments"
                        : multiple && sources && copies.source == nullptr ? "Source"
                                                                          : nullptr;
  if (missing == nullptr) return Status::Ok;
  return device.fail(Status::NotReady, VK_SUCCESS,
                     "answerQueries got no copy of TableId::%s, but needs one that "
                     "recordTableReadback has made.",
                     missing);
}

}  // namespace

Status answerQueries(const Tables* tables, const TableReadbacks& copies, const ProbeQuery* queries,
                     uint32_t count, ProbeAnswer* answers) {
  if (tables == nullptr || queries == nullptr || answers == nullptr)
    return nullArgument(tables, "answerQueries");
  const Status status = checkCall(*tables, copies, queries, count);
  if (status != Status::Ok) return status;
  const Parameters& parameters = tables->parameters();
  const physics_f64::Medium medium = makeMediumF64(parameters);
  cpu::Field field(makeMediumF32(parameters), bake::makeMomentShapeF32(parameters, tables->desc()),
                   tables->desc().without,
                   copyOf(*tables, TableId::OpticalDepth, copies.opticalDepth),
                   copyOf(*tables, TableId::Moments, copies.moments),
                   copyOf(*tables, TableId::Source, copies.source));
  for (uint32_t i = 0; i < count; ++i) {
    answers[i] = queries[i].irradiance ? irradianceAnswer(field, medium.thickness, queries[i])
                                       : rayAnswer(field, medium, copies.skyRadiance, queries[i]);
  }
  return Status::Ok;
}

}  // namespace v1
}  // namespace alpenglow
