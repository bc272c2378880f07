// Checks of TableDesc, before anything is made, and the values that its zeros stand for.
#include <algorithm>
#include <charconv>
#include <numbers>
#include <string_view>

#include "atmosphere/parameters/limits.h"
#include "atmosphere/parameters/sentence.h"
#include "atmosphere/parameters/solvers.h"
#include "atmosphere/tables/moment_shape.h"
#include "atmosphere/tables/size_fields.h"
#include "atmosphere/tables/table_set.h"

namespace alpenglow::tables {
namespace {

using parameters::Sentence;

Status refuse(const DiagnosticSink& sink, Status status, const Sentence& sentence) {
  return parameters::report(sink, status, sentence);
}
Status invalid(const DiagnosticSink& sink, const Sentence& sentence) {
  return refuse(sink, Status::InvalidArgument, sentence);
}
Status unsupported(const DiagnosticSink& sink, const Sentence& sentence) {
  return refuse(sink, Status::Unsupported, sentence);
}

/// "0x1a".
struct Hexadecimal {
  explicit Hexadecimal(uint64_t value) {
    *std::to_chars(text + 2, text + sizeof text - 1, value, 16).ptr = '\0';
  }
  char text[20] = "0x";
};

Status checkEnumerations(const DiagnosticSink& sink, const TableDesc& desc) {
  const struct {
    const char* name;
    uint32_t value, last;
  } fields[] = {
      {"solver", static_cast<uint32_t>(desc.solver), static_cast<uint32_t>(Solver::Hillaire)},
      {"format", static_cast<uint32_t>(desc.format), static_cast<uint32_t>(TableFormat::Float)},
      {"mie", static_cast<uint32_t>(desc.mie), static_cast<uint32_t>(MieStorage::Packed)},
      {"quality", static_cast<uint32_t>(desc.quality), static_cast<uint32_t>(Quality::Ultra)},
      {"cpuQueries", static_cast<uint32_t>(desc.cpuQueries),
       static_cast<uint32_t>(CpuQueries::All)}};
  for (const auto& field : fields) {
    if (field.value <= field.last) continue;
    return invalid(sink, Sentence() << "TableDesc has " << field.name << " " << field.value
                                    << ", but this enumeration ends at " << field.last << ".");
  }
  return Status::Ok;
}

/// The first member that is given, "" for none.
template <size_t N>
const char* firstGiven(const TableSizes& sizes, const SizeField (&fields)[N]) {
  for (const SizeField& field : fields)
    if (sizes.*field.member != 0) return field.name;
  return "";
}

Status refuseOther(const DiagnosticSink& sink, Solver solver, const char* group,
                   const char* member) {
  return invalid(sink, Sentence() << "TableDesc has Solver::" << solverEnumerator(solver) << " and "
                                  << group << member
                                  << ", but that belongs to another solver: leave it at its "
                                     "default.");
}

// Members of another solver must have their defaults: they would have no effect.
Status checkCombination(const DiagnosticSink& sink, const TableDesc& desc) {
  const bool moments = desc.solver == Solver::Moments, model = isModel(desc.solver);
  const struct {
    bool given, allowed;
    const char* name;
  } choices[] = {{desc.quality != Quality::Default, moments, "a Quality"},
                 {!allSuns(desc), moments, "a range of sun zenith angles"},
                 {desc.mie == MieStorage::Packed, !moments && !model, "MieStorage::Packed"},
                 {desc.orders != 0, !model, "orders"},
                 {desc.keepOrders, !model, "keepOrders"},
                 {desc.disabledEffects != 0, moments, "TableDesc::disabledEffects"}};
  for (const auto& choice : choices)
    if (choice.given && !choice.allowed) return refuseOther(sink, desc.solver, "", choice.name);
  const struct {
    bool allowed;
    const char* given;
  } sizes[] = {{moments, firstGiven(desc.sizes, kMomentFields)},
               {!moments && !model, firstGiven(desc.sizes, kStandardFields)},
               {defaultStepCount(desc.solver) != 0, firstGiven(desc.sizes, kModelFields)}};
  for (const auto& choice : sizes)
    if (!choice.allowed && *choice.given != '\0')
      return refuseOther(sink, desc.solver, "TableSizes::", choice.given);
  if (moments || desc.cpuQueries == CpuQueries::None) return Status::Ok;
  return unsupported(sink, Sentence()
                               << "TableDesc::cpuQueries asks for host copies, but those are "
                                  "of Solver::Moments alone, not of Solver::"
                               << solverEnumerator(desc.solver) << ".");
}

template <size_t N>
Status checkRanges(const DiagnosticSink& sink, const TableSizes& sizes,
                   const SizeField (&fields)[N]) {
  for (const SizeField& field : fields) {
    const uint32_t value = sizes.*field.member;
    if (value == 0 || (value >= field.least && value <= field.most)) continue;
    return invalid(sink, Sentence() << "TableSizes::" << field.name << " is " << value
                                    << ", but must be from " << field.least << " to " << field.most
                                    << ", or 0 for the default.");
  }
  return Status::Ok;
}

Status checkRanges(const DiagnosticSink& sink, const TableSizes& sizes) {
  Status status = checkRanges(sink, sizes, kMomentFields);
  if (status == Status::Ok) status = checkRanges(sink, sizes, kStandardFields);
  if (status == Status::Ok) status = checkRanges(sink, sizes, kModelFields);
  if (status != Status::Ok || sizes.scatteringMu % 2 == 0) return status;
  return invalid(sink, Sentence() << "TableSizes::scatteringMu is " << sizes.scatteringMu
                                  << ", but must be even: half of its texels look at the ground, "
                                     "half at the sky.");
}

Status checkSuns(const DiagnosticSink& sink, const TableDesc& desc) {
  const double from = desc.sunZenithFrom, to = desc.sunZenithTo;
  if (from >= 0.0 && to >= from && to <= std::numbers::pi) return Status::Ok;
  return invalid(sink, Sentence() << "TableDesc::sunZenithFrom is " << from << " and sunZenithTo "
                                  << to << ", but they must rise from 0 to at most pi.");
}

Status checkEffects(const DiagnosticSink& sink, const TableDesc& desc) {
  if ((desc.disabledEffects & ~kTableEffects) != 0) {
    return invalid(sink, Sentence() << "TableDesc::disabledEffects is "
                                    << Hexadecimal(desc.disabledEffects).text
                                    << ", but may have bits of kTableEffects, "
                                    << Hexadecimal(kTableEffects).text << ", alone.");
  }
  if (hasEffect(desc.disabledEffects, Effect::MultipleScattering) || desc.orders <= 1)
    return Status::Ok;
  return invalid(sink, Sentence() << "TableDesc has " << desc.orders
                                  << " orders, but disables Effect::MultipleScattering, whose "
                                     "tables hold order 1.");
}

Status checkOrders(const DiagnosticSink& sink, const TableDesc& desc) {
  if (desc.orders <= kMaxOrders) return Status::Ok;
  return invalid(sink, Sentence() << "TableDesc::orders is " << desc.orders
                                  << ", but must be from 1 to " << kMaxOrders
                                  << ", or 0 for the default.");
}

Status checkWavelengths(const DiagnosticSink& sink, const TableDesc& desc) {
  if (desc.wavelengthCount != 0 && desc.wavelengthCount != 3) {
    return unsupported(sink, Sentence() << "TableDesc::wavelengthCount is " << desc.wavelengthCount
                                        << ", but this version has 3 wavelengths: give 3, or 0.");
  }
  for (const double& wavelength : desc.wavelengths_nm) {
    if (wavelength == 0.0) continue;
    const auto index = static_cast<uint32_t>(&wavelength - desc.wavelengths_nm);
    return unsupported(sink, Sentence() << "TableDesc::wavelengths_nm[" << index << "] is "
                                        << wavelength << ", but must be 0 in this version.");
  }
  return Status::Ok;
}

bool isZero(const Spectrum& spectrum) {
  return std::ranges::all_of(spectrum.value, [](double value) { return value == 0.0; });
}

Status checkLight(const DiagnosticSink& sink, uint32_t index, const LightDesc& light) {
  const bool sun = index == 0;
  if (light.kind > LightKind::None) {
    return invalid(sink, Sentence() << "TableDesc::lights[" << index << "].kind is "
                                    << static_cast<uint32_t>(light.kind)
                                    << ", but this enumeration ends at "
                                    << static_cast<uint32_t>(LightKind::None) << ".");
  }
  const LightKind expected = sun ? LightKind::Star : LightKind::None;
  if (light.kind != LightKind::Default && light.kind != expected) {
    constexpr const char* kNames[] = {"Default", "Star", "Moon", "None"};
    return unsupported(sink, Sentence() << "TableDesc::lights[" << index << "].kind is LightKind::"
                                        << kNames[static_cast<uint32_t>(light.kind)]
                                        << ", but this version has one light, lights[0], a Star.");
  }
  if (!sun && !isZero(light.irradiance)) {
    return unsupported(sink, Sentence() << "TableDesc::lights[" << index
                                        << "].irradiance is given, but must be 0 in this version, "
                                           "which has one light.");
  }
  for (const double value : light.irradiance.value) {
    if (value >= 0.0 && value <= parameters::kMaxIrradiance) continue;
    return invalid(sink, Sentence() << "TableDesc::lights[0].irradiance has a value of " << value
                                    << ", but each must be from 0 to " << parameters::kMaxIrradiance
                                    << ".");
  }
  return Status::Ok;
}

Status checkLights(const DiagnosticSink& sink, const TableDesc& desc) {
  for (uint32_t i = 0; i < kMaxLights; ++i) {
    const Status status = checkLight(sink, i, desc.lights[i]);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

// The largest images that any device has.
constexpr uint32_t kMost2D = 32768, kMost3D = 16384;

Status checkImageSizes(const DiagnosticSink& sink, const TableDesc& desc, uint32_t most2D,
                       uint32_t most3D) {
  if (desc.solver != Solver::Standard) return Status::Ok;
  const TableSizes& s = desc.sizes;
  for (const SizeField& field : kStandardFields) {
    const bool in3D = std::string_view(field.name).starts_with("scattering");
    const uint32_t most = in3D ? most3D : most2D;
    if (s.*field.member <= most) continue;
    return invalid(sink, Sentence() << "TableSizes::" << field.name << " is " << s.*field.member
                                    << ", but " << (in3D ? "3D" : "2D") << " images end at " << most
                                    << ".");
  }
  const uint64_t across = uint64_t(s.scatteringMuS) * s.scatteringNu;
  if (across > most3D) {
    return invalid(sink, Sentence()
                             << "TableSizes::scatteringMuS " << s.scatteringMuS
                             << " times scatteringNu " << s.scatteringNu << " are " << across
                             << " texels side by side, but 3D images end at " << most3D << ".");
  }
  const uint64_t side = uint64_t(s.scatteringMuS) * s.scatteringR;
  if (side <= most2D) return Status::Ok;
  return invalid(sink, Sentence() << "TableSizes::scatteringMuS " << s.scatteringMuS
                                  << " times scatteringR " << s.scatteringR << " are " << side
                                  << " rows of a bake, but 2D images end at " << most2D << ".");
}

constexpr VkPipelineStageFlags2 kDefaultReaders =
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
/// Stages that have shaders without an extension, and the flags that stand for all of them.
constexpr VkPipelineStageFlags2 kKnownReaders =
    kDefaultReaders | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
    VK_PIPELINE_STAGE_2_TESSELLATION_CONTROL_SHADER_BIT |
    VK_PIPELINE_STAGE_2_TESSELLATION_EVALUATION_SHADER_BIT |
    VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT | VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT |
    VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT | VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;

Status checkReaders(const DiagnosticSink& sink, const TableDesc& desc) {
  const VkPipelineStageFlags2 unknown = desc.readerStages & ~kKnownReaders;
  if (unknown == 0) return Status::Ok;
  return unsupported(sink, Sentence() << "TableDesc::readerStages has the bits "
                                      << Hexadecimal(unknown).text
                                      << ", but may have shader stages of Vulkan 1.3 alone, "
                                      << Hexadecimal(kKnownReaders).text << ".");
}

Status checkGiven(const DiagnosticSink& sink, const TableDesc& desc) {
  constexpr Status (*kChecks[])(const DiagnosticSink&, const TableDesc&) = {
      checkEnumerations,
      checkCombination,
      [](const DiagnosticSink& to, const TableDesc& d) { return checkRanges(to, d.sizes); },
      checkSuns,
      checkEffects,
      checkOrders,
      checkWavelengths,
      checkLights,
      checkReaders};
  for (const auto check : kChecks) {
    const Status status = check(sink, desc);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

// The paper's.
constexpr TableSizes kStandardSizes = {.transmittanceMu = 256,
                                       .transmittanceR = 64,
                                       .irradianceMuS = 64,
                                       .irradianceR = 16,
                                       .scatteringR = 32,
                                       .scatteringMu = 128,
                                       .scatteringMuS = 32,
                                       .scatteringNu = 8};

void completeMoments(const Parameters& parameters, const TableDesc& desc, TableDesc* full) {
  if (desc.quality == Quality::Default) full->quality = Quality::Medium;
  full->sizes = momentSizes(parameters, desc.quality, desc.sizes);
  // Molecules need no more than the second moments.
  if (!hasEffect(desc.disabledEffects, Effect::Mie) && desc.sizes.degree == 0)
    full->sizes.degree = 2;
  if (!hasEffect(desc.disabledEffects, Effect::MultipleScattering)) full->orders = 1;
  if (desc.sizes.nodesMuS == 0)
    full->sizes.nodesMuS = nodesOfSunRange(parameters, desc, full->sizes.nodesMuS);
}

}  // namespace

Parameters simulated(const Parameters& parameters, EffectFlags disabled) {
  Parameters result = parameters;
  if (!hasEffect(disabled, Effect::Rayleigh)) result.rayleigh.present = false;
  if (!hasEffect(disabled, Effect::Mie)) result.mie.present = false;
  if (!hasEffect(disabled, Effect::Absorption)) result.absorption.present = false;
  return result;
}

TableDesc completed(const Parameters& parameters, const TableDesc& desc) {
  TableDesc full = desc;
  full.wavelengthCount = kSpectrumSize;
  for (LightDesc& light : full.lights) light.kind = LightKind::None;
  full.lights[0].kind = LightKind::Star;
  if (isZero(desc.lights[0].irradiance)) full.lights[0].irradiance = parameters.solarIrradiance;
  if (desc.readerStages == 0) full.readerStages = kDefaultReaders;
  if (desc.solver == Solver::Moments) {
    completeMoments(parameters, desc, &full);
  } else if (isModel(desc.solver)) {
    if (desc.sizes.stepCount == 0) full.sizes.stepCount = defaultStepCount(desc.solver);
  } else {
    for (const SizeField& field : kStandardFields)
      if (desc.sizes.*field.member == 0) full.sizes.*field.member = kStandardSizes.*field.member;
    if (desc.orders == 0) full.orders = 5;
  }
  return full;
}

Status checkDeviceLimits(const engine::Device& device, const TableDesc& desc) {
  return checkImageSizes(device.sink(), desc, device.limits().maxImageDimension2D,
                         device.limits().maxImageDimension3D);
}

}  // namespace alpenglow::tables

namespace alpenglow {
inline namespace v1_0 {

Status resolveTableDesc(const Parameters& parameters, TableDesc* desc, const DiagnosticSink& sink) {
  using parameters::Sentence;
  if (desc == nullptr) return parameters::reportNull(sink, "resolveTableDesc", "the description");
  Status status = validate(parameters, sink);
  if (status == Status::Ok) status = tables::checkGiven(sink, *desc);
  if (status != Status::Ok) return status;
  const TableDesc full =
      tables::completed(tables::simulated(parameters, desc->disabledEffects), *desc);
  if (full.solver == Solver::Moments && 2 * full.sizes.azimuths <= full.sizes.degree) {
    return tables::invalid(sink, Sentence() << "TableSizes::azimuths is " << full.sizes.azimuths
                                            << ", but must be above half the degree, which is "
                                            << full.sizes.degree << ".");
  }
  status = tables::checkImageSizes(sink, full, tables::kMost2D, tables::kMost3D);
  if (status == Status::Ok) *desc = full;
  return status;
}

}  // namespace v1_0
}  // namespace alpenglow
