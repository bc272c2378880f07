// Checks of TableDesc, before anything is made.
#include <cstdarg>
#include <cstdio>
#include <numbers>

#include "atmosphere/bake/desc_members.h"
#include "atmosphere/bake/moment_shape.h"
#include "atmosphere/bake/table_set.h"
#include "atmosphere/model/solvers.h"

namespace alpenglow::bake {
namespace {

struct Size {
  const char* name;
  uint32_t value, least, most;
};

template <size_t N>
Status checkRanges(const Checks& checks, const char* what, const Size (&sizes)[N],
                   bool zeroIsDefault) {
  for (const Size& size : sizes) {
    if ((size.value >= size.least && size.value <= size.most) ||
        (size.value == 0 && zeroIsDefault)) {
      continue;
    }
    return checks.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The %s %s is %u, but must be from %u to %u%s.", what, size.name, size.value,
                       size.least, size.most, zeroIsDefault ? ", or 0 for the default" : "");
  }
  return Status::Ok;
}

template <typename Counts, size_t N>
bool anyGiven(const Counts& counts, uint32_t Counts::*const (&members)[N]) {
  for (const auto member : members)
    if (counts.*member != 0) return true;
  return false;
}

Status checkEnumerations(const Checks& checks, const TableDesc& desc) {
  if (desc.solver <= Solver::Hillaire && desc.format <= TableFormat::Float &&
      desc.mie <= MieStorage::Packed && desc.quality <= Quality::Ultra) {
    return Status::Ok;
  }
  return checks.fail(
      Status::InvalidArgument, VK_SUCCESS,
      "TableDesc has solver %u, format %u, mie %u and quality %u, but these enumerations end at "
      "%u, %u, %u and %u.",
      static_cast<uint32_t>(desc.solver), static_cast<uint32_t>(desc.format),
      static_cast<uint32_t>(desc.mie), static_cast<uint32_t>(desc.quality),
      static_cast<uint32_t>(Solver::Hillaire), static_cast<uint32_t>(TableFormat::Float),
      static_cast<uint32_t>(MieStorage::Packed), static_cast<uint32_t>(Quality::Ultra));
}

// What belongs to another solver must be left at its default: it would do nothing.
Status checkCombination(const Checks& checks, const TableDesc& desc) {
  const bool moments = desc.solver == Solver::Moments, model = isModel(desc.solver);
  const struct {
    bool given, allowed;
    const char* name;
  } choices[] = {{desc.quality != Quality::Default, moments, "a Quality"},
                 {anyGiven(desc.moments, kMomentMembers), moments, "MomentSettings"},
                 {!allSuns(desc), moments, "a range of suns"},
                 {desc.mie == MieStorage::Packed, !moments && !model, "MieStorage::Packed"},
                 {anyGiven(desc.sizes, kSizeMembers), !moments && !model, "TableSizes"},
                 {desc.orders != 0, !model, "orders"},
                 {desc.keepOrders, !model, "keepOrders"},
                 {desc.without != 0, moments, "TableDesc::without"},
                 {desc.samples != 0, defaultSamples(desc.solver) != 0, "samples"}};
  for (const auto& choice : choices) {
    if (!choice.given || choice.allowed) continue;
    return checks.fail(Status::InvalidArgument, VK_SUCCESS,
                       "TableDesc has Solver::%s and %s, but that belongs to another solver: "
                       "leave it at its default.",
                       solverEnumerator(desc.solver), choice.name);
  }
  if (desc.samples <= kMaxSamples) return Status::Ok;
  return checks.fail(Status::InvalidArgument, VK_SUCCESS,
                     "TableDesc::samples is %u, but must be from 1 to %u, or 0 for the default.",
                     desc.samples, kMaxSamples);
}

Status checkSuns(const Checks& checks, const TableDesc& desc) {
  const double from = desc.sunZenithFrom, to = desc.sunZenithTo;
  if (from >= 0.0 && to >= from && to <= std::numbers::pi) return Status::Ok;
  return checks.fail(Status::InvalidArgument, VK_SUCCESS,
                     "TableDesc has suns of zenith angles from %g to %g, but they must rise from 0 "
                     "to at most pi.",
                     from, to);
}

Status checkEffects(const Checks& checks, const TableDesc& desc) {
  if ((desc.without & ~kTableEffects) != 0) {
    return checks.fail(
        Status::InvalidArgument, VK_SUCCESS,
        "TableDesc::without is 0x%x, but may have bits of kTableEffects, 0x%x, alone.",
        desc.without, kTableEffects);
  }
  if (hasEffect(desc.without, Effect::MultipleScattering) || desc.orders <= 1) return Status::Ok;
  return checks.fail(Status::InvalidArgument, VK_SUCCESS,
                     "TableDesc has %u orders, but is without Effect::MultipleScattering, whose "
                     "tables hold order 1.",
                     desc.orders);
}

Status checkSettings(const Checks& checks, const MomentSettings& s, bool zeroIsDefault) {
  const Size sizes[] = {
      {"depthMu", s.depthMu, 2, 4096},        {"depthH", s.depthH, 2, 4096},
      {"nodesR", s.nodesR, 2, 256},           {"nodesMuS", s.nodesMuS, 2, 512},
      {"ringsSky", s.ringsSky, 2, 256},       {"ringsLimb", s.ringsLimb, 2, 256},
      {"ringsGround", s.ringsGround, 2, 256}, {"azimuths", s.azimuths, 2, 128},
      {"degree", s.degree, 2, kMaxDegree},    {"sourceGamma", s.sourceGamma, 2, 256},
      {"sourcePsi", s.sourcePsi, 2, 256},     {"solverPanels", s.solverPanels, 2, 256},
      {"viewPanels", s.viewPanels, 2, 256}};
  return checkRanges(checks, "moment setting", sizes, zeroIsDefault);
}

Status checkStandardSizes(const Checks& checks, const TableSizes& s) {
  const uint32_t most2D = checks.most2D;
  const uint32_t most3D = checks.most3D;
  const Size sizes[] = {{"transmittanceMu", s.transmittanceMu, 2, most2D},
                        {"transmittanceR", s.transmittanceR, 2, most2D},
                        {"irradianceMuS", s.irradianceMuS, 2, most2D},
                        {"irradianceR", s.irradianceR, 2, most2D},
                        {"scatteringR", s.scatteringR, 2, most3D},
                        {"scatteringMu", s.scatteringMu, 4, most3D},
                        {"scatteringMuS", s.scatteringMuS, 2, most3D},
                        {"scatteringNu", s.scatteringNu, 2, most3D}};
  const Status status = checkRanges(checks, "table size", sizes, false);
  if (status != Status::Ok) return status;
  if (s.scatteringMu % 2 != 0) {
    return checks.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The table size scatteringMu is %u, but must be even: half of its texels "
                       "look at the ground, half at the sky.",
                       s.scatteringMu);
  }
  if (uint64_t(s.scatteringMuS) * s.scatteringNu > most3D) {
    return checks.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The table sizes scatteringMuS %u times scatteringNu %u are %llu texels "
                       "side by side, but this device's 3D images end at %u.",
                       s.scatteringMuS, s.scatteringNu,
                       static_cast<unsigned long long>(uint64_t(s.scatteringMuS) * s.scatteringNu),
                       most3D);
  }
  const uint64_t side = uint64_t(s.scatteringMuS) * s.scatteringR;
  if (side > most2D) {
    return checks.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The table sizes scatteringMuS %u times scatteringR %u are %llu rows of a "
                       "bake, but this device's 2D images end at %u.",
                       s.scatteringMuS, s.scatteringR, static_cast<unsigned long long>(side),
                       most2D);
  }
  return Status::Ok;
}

}  // namespace

Status Checks::fail(Status status, VkResult result, const char* format, ...) const {
  char message[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  if (device_ != nullptr) return device_->fail(status, result, "%s", message);
  if (sink_.report != nullptr) sink_.report(sink_.user, {Severity::Error, status, result, message});
  return status;
}

Parameters simulated(const Parameters& parameters, EffectFlags without) {
  Parameters result = parameters;
  if (!hasEffect(without, Effect::Rayleigh)) result.rayleigh.present = false;
  if (!hasEffect(without, Effect::Mie)) result.mie.present = false;
  if (!hasEffect(without, Effect::Absorption)) result.absorption.present = false;
  return result;
}

TableDesc completed(const Parameters& parameters, const TableDesc& desc) {
  TableDesc full = desc;
  if (desc.solver == Solver::Moments) {
    full.moments = momentSettings(parameters, desc.quality, desc.moments);
    // Molecules ask for no more than the second moments.
    if (!hasEffect(desc.without, Effect::Mie) && desc.moments.degree == 0) full.moments.degree = 2;
    if (!hasEffect(desc.without, Effect::MultipleScattering)) full.orders = 1;
    if (desc.moments.nodesMuS == 0)
      full.moments.nodesMuS = nodesOfSunRange(parameters, desc, full.moments.nodesMuS);
    return full;
  }
  if (isModel(desc.solver)) {
    if (full.samples == 0) full.samples = defaultSamples(desc.solver);
    return full;
  }
  const TableSizes defaults = defaultTableSizes();
  for (const auto size : kSizeMembers)
    if (full.sizes.*size == 0) full.sizes.*size = defaults.*size;
  if (full.orders == 0) full.orders = 5;
  return full;
}

Status checkTableDesc(const Checks& checks, const TableDesc& desc) {
  Status status = checkEnumerations(checks, desc);
  if (status == Status::Ok) status = checkCombination(checks, desc);
  if (status == Status::Ok) status = checkSettings(checks, desc.moments, true);
  if (status == Status::Ok) status = checkSuns(checks, desc);
  if (status == Status::Ok) status = checkEffects(checks, desc);
  if (status != Status::Ok) return status;
  if (desc.orders > kMaxOrders) {
    return checks.fail(Status::InvalidArgument, VK_SUCCESS,
                       "TableDesc::orders is %u, but must be from 1 to %u, or 0 for the default.",
                       desc.orders, kMaxOrders);
  }
  return Status::Ok;
}

Status checkSizes(const Checks& checks, const TableDesc& desc) {
  if (desc.solver == Solver::Standard) return checkStandardSizes(checks, desc.sizes);
  const MomentSettings& s = desc.moments;
  if (isModel(desc.solver)) return Status::Ok;
  if (2 * s.azimuths > s.degree) return Status::Ok;
  return checks.fail(
      Status::InvalidArgument, VK_SUCCESS,
      "The moment setting azimuths is %u, but must be above half the degree, which is "
      "%u.",
      s.azimuths, s.degree);
}

}  // namespace alpenglow::bake
