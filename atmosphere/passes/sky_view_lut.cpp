#include "atmosphere/passes/sky_view_lut.h"

#include <algorithm>
#include <iterator>

#include "atmosphere/passes/shader_choice.h"
#include "atmosphere/tables/effect_constants.h"

namespace alpenglow::passes {
namespace {

/// Push constants of sky_view_lut.comp; the standard solver's reads the first two, Hillaire's
/// three.
struct SkyViewLutConstants {
  float altitude, muS, horizon, span, bend;
};

/// Texels by quality, Draft ... Ultra, matched to the accuracy of the tables. Whole groups; half of
/// the columns is used inside the atmosphere. Errors of each: docs/luts.md.
constexpr VkExtent3D kMomentLutExtents[] = {
    {48, 64, 1}, {64, 96, 1}, {128, 160, 1}, {128, 160, 1}, {128, 160, 1}};
static_assert(std::size(kMomentLutExtents) == static_cast<size_t>(Quality::Ultra));

VkExtent3D momentLutExtent(Quality quality) {
  const Quality level = quality == Quality::Default ? Quality::Medium : quality;
  return kMomentLutExtents[static_cast<size_t>(level) - 1];
}

SkyViewLutConstants constantsOf(const Tables& tables, const FrameState& draw) {
  const EyeCamera& camera = draw.camera;
  const double altitude = cameraAltitude(tables.parameters(), camera);
  const double muS = dot(camera.position_m, draw.sun.direction) / cameraRadius(camera);
  const physics_f64::SkyViewParams view = skyViewParams(tables.parameters(), altitude);
  const auto f = [](double value) { return static_cast<float>(value); };
  return {f(altitude), f(muS), f(view.horizon), f(view.span), f(view.bend)};
}

}  // namespace

VkExtent3D SkyViewLut::extentFor(const TableDesc& desc, EffectFlags disabledEffects) {
  if (desc.solver == Solver::Hillaire) return {192, 108, 1};  // The paper's.
  if (desc.solver != Solver::Moments) return {desc.sizes.scatteringNu, desc.sizes.scatteringMu, 1};
  VkExtent3D extent = momentLutExtent(desc.quality);
  if (!hasEffect(disabledEffects, Effect::SpaceViews)) extent.width /= 2;
  return extent;
}

uint32_t SkyViewLut::countFor(const TableDesc& desc, EffectFlags disabledEffects) {
  const bool mie = desc.mie == MieStorage::Full && hasEffect(disabledEffects, Effect::Mie);
  return mie && desc.solver != Solver::Hillaire ? 2 : 1;
}

Status SkyViewLut::make(const TableDesc& desc, EffectFlags disabledEffects,
                        VkPipelineStageFlags2 readers) {
  solver_ = desc.solver;
  extent_ = extentFor(desc, disabledEffects);
  columns_ = extentFor(desc, 0).width;
  LutDesc lut;
  lut.name = "Alpenglow sky-view LUT";
  lut.extent = extent_;
  lut.count = countFor(desc, disabledEffects);
  lut.bindings = 2;
  lut.constantBytes = sizeof(SkyViewLutConstants);
  lut.format = tables::finestFormat(lut_.device(), TableFormat::Half);
  lut.readers = readers;
  engine::SpecConstant constants[3 + tables::kEffectConstants] = {
      engine::specBool(0, desc.mie == MieStorage::Packed),
      engine::specFloat(11, static_cast<float>(columns_)),
      engine::specFloat(12, static_cast<float>(extent_.height))};
  std::ranges::copy(tables::effectConstants(disabledEffects), constants + 3);
  return lut_.make(lut, skyViewLutShader(solver_, disabledEffects, lut.format), constants,
                   3 + tables::kEffectConstants);
}

bool SkyViewLut::possible(const Tables& tables, const FrameState& draw) {
  if (tables.desc().solver == Solver::Moments) return true;
  const Parameters& p = tables.parameters();
  return cameraAltitude(p, draw.camera) <= p.topRadius_m - p.bottomRadius_m;
}

bool SkyViewLut::current(const Tables& tables, const FrameState& draw) const {
  const SkyViewLutConstants constants = constantsOf(tables, draw);
  return lut_.current(tables, &constants);
}

Status SkyViewLut::record(VkCommandBuffer commands, const Tables& tables, const FrameState& draw) {
  const SkyViewLutConstants constants = constantsOf(tables, draw);
  const physics_f64::SkyViewParams view =
      skyViewParams(tables.parameters(), cameraAltitude(tables.parameters(), draw.camera));
  const uint32_t columns = solver_ == Solver::Moments
                               ? static_cast<uint32_t>(physics_f64::azimuthColumns(view, columns_))
                               : extent_.width;
  return lut_.record(commands, tables, &constants, (columns + 7) / 8, (extent_.height + 7) / 8);
}

}  // namespace alpenglow::passes
