#include "atmosphere/passes/aerial_perspective_lut.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/camera/viewport_partition.h"
#include "atmosphere/passes/shader_choice.h"
#include "atmosphere/tables/effect_constants.h"

namespace alpenglow::passes {
namespace {

/// Push constants of aerial_perspective_lut.comp.
struct AerialPerspectiveLutConstants {
  float altitude, muS, horizon, span, bend, extinction, startHeight, height;
};

/// Seen from inside, half of the columns are in use.
constexpr VkExtent3D kExtent = {physics_f32::kAerialColumns, physics_f32::kAerialRows,
                                physics_f32::kAerialDistances};
static_assert(kExtent.width % 16 == 0 && kExtent.height % 8 == 0);

}  // namespace

physics_f64::AerialView aerialView(const Parameters& parameters, double altitude) {
  return physics_f64::aerialView(makeMediumF64(parameters), skyViewParams(parameters, altitude),
                                 altitude);
}

AerialPerspectiveLookup aerialPerspectiveLookup(const Parameters& parameters,
                                                const FrameState& draw) {
  AerialPerspectiveLookup lookup = {};
  lookup.view = aerialView(parameters, cameraAltitude(parameters, draw.camera));
  const double r = cameraRadius(draw.camera);
  for (int i = 0; i < 3; ++i) lookup.up[i] = draw.camera.position_m[i] / r;
  sunAzimuth(draw, lookup.sunAzimuth);
  return lookup;
}

VkExtent3D AerialPerspectiveLut::extentFor(EffectFlags disabledEffects) {
  VkExtent3D extent = kExtent;
  if (!hasEffect(disabledEffects, Effect::SpaceViews)) extent.width /= 2;
  return extent;
}

Status AerialPerspectiveLut::make(EffectFlags disabledEffects, VkPipelineStageFlags2 readers) {
  LutDesc lut;
  lut.name = "Alpenglow aerial-perspective LUT";
  lut.type = VK_IMAGE_TYPE_3D;
  lut.extent = extentFor(disabledEffects);
  lut.count = lut.bindings = kImages;
  lut.constantBytes = sizeof(AerialPerspectiveLutConstants);
  lut.format = tables::finestFormat(lut_.device(), TableFormat::Half);
  lut.readers = readers | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const auto constants = tables::effectConstants(disabledEffects);
  return lut_.make(lut, aerialPerspectiveLutShader(disabledEffects, lut.format), constants.data(),
                   tables::kEffectConstants);
}

namespace {

AerialPerspectiveLutConstants constantsOf(const Tables& tables, const FrameState& draw) {
  const EyeCamera& camera = draw.camera;
  const double altitude = cameraAltitude(tables.parameters(), camera);
  const double muS = dot(camera.position_m, draw.sun.direction) / cameraRadius(camera);
  const physics_f64::AerialView view = aerialView(tables.parameters(), altitude);
  const auto f = [](double value) { return static_cast<float>(value); };
  return {f(altitude),
          f(muS),
          f(view.skyView.horizon),
          f(view.skyView.span),
          f(view.skyView.bend),
          f(view.extinction_),
          f(view.startHeight),
          f(view.height)};
}

}  // namespace

bool AerialPerspectiveLut::current(const Tables& tables, const FrameState& draw) const {
  const AerialPerspectiveLutConstants constants = constantsOf(tables, draw);
  return lut_.current(tables, &constants);
}

Status AerialPerspectiveLut::record(VkCommandBuffer commands, const Tables& tables,
                                    const FrameState& draw) {
  const AerialPerspectiveLutConstants constants = constantsOf(tables, draw);
  const physics_f64::SkyViewParams view =
      skyViewParams(tables.parameters(), cameraAltitude(tables.parameters(), draw.camera));
  const auto columns = static_cast<uint32_t>(physics_f64::aerialGrid(view).columns);
  return lut_.record(commands, tables, &constants, (columns + 7) / 8, kExtent.height / 8);
}

}  // namespace alpenglow::passes
