#include "atmosphere/sky/air_volume.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/bake/effect_constants.h"
#include "atmosphere/sky/parts.h"
#include "atmosphere/sky/shader_choice.h"

namespace alpenglow::sky {
namespace {

/// Push constants of air_volume.comp.
struct VolumeConstants {
  float altitude, muS, horizon, span, bend, extinction, startHeight, height;
};

/// Seen from inside, half of the columns are in use.
constexpr VkExtent3D kExtent = {physics_f32::kAirColumns, physics_f32::kAirRows,
                                physics_f32::kAirDistances};
static_assert(kExtent.width % 16 == 0 && kExtent.height % 8 == 0);

}  // namespace

physics_f64::AirView airView(const Parameters& parameters, double altitude) {
  return physics_f64::airView(makeMediumF64(parameters), sliceView(parameters, altitude), altitude);
}

AirLookup airLookup(const Parameters& parameters, const FrameState& draw) {
  AirLookup lookup = {};
  lookup.view = airView(parameters, cameraAltitude(parameters, draw.camera));
  const double r = cameraRadius(draw.camera);
  for (int i = 0; i < 3; ++i) lookup.up[i] = draw.camera.position_m[i] / r;
  sunAzimuth(draw, lookup.sunAzimuth);
  return lookup;
}

VkExtent3D AirVolume::extentFor(EffectFlags disabledEffects) {
  VkExtent3D extent = kExtent;
  if (!hasEffect(disabledEffects, Effect::SpaceViews)) extent.width /= 2;
  return extent;
}

Status AirVolume::make(EffectFlags disabledEffects, VkPipelineStageFlags2 readers) {
  LutDesc lut;
  lut.name = "Alpenglow aerial-perspective LUT";
  lut.type = VK_IMAGE_TYPE_3D;
  lut.extent = extentFor(disabledEffects);
  lut.count = lut.bindings = kImages;
  lut.constantBytes = sizeof(VolumeConstants);
  lut.format = bake::finestFormat(lut_.device(), TableFormat::Half);
  lut.readers = readers | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const auto constants = bake::effectConstants(disabledEffects);
  return lut_.make(lut, volumeShader(disabledEffects, lut.format), constants.data(),
                   bake::kEffectConstants);
}

namespace {

VolumeConstants constantsOf(const Tables& tables, const FrameState& draw) {
  const EyeCamera& camera = draw.camera;
  const double altitude = cameraAltitude(tables.parameters(), camera);
  const double muS = dot(camera.position_m, draw.sun.direction) / cameraRadius(camera);
  const physics_f64::AirView view = airView(tables.parameters(), altitude);
  const auto f = [](double value) { return static_cast<float>(value); };
  return {f(altitude),        f(muS),           f(view.slice.horizon), f(view.slice.span),
          f(view.slice.bend), f(view.extinction_), f(view.startHeight),   f(view.height)};
}

}  // namespace

bool AirVolume::current(const Tables& tables, const FrameState& draw) const {
  const VolumeConstants constants = constantsOf(tables, draw);
  return lut_.current(tables, &constants);
}

Status AirVolume::record(VkCommandBuffer commands, const Tables& tables, const FrameState& draw) {
  const VolumeConstants constants = constantsOf(tables, draw);
  const physics_f64::SliceView view =
      sliceView(tables.parameters(), cameraAltitude(tables.parameters(), draw.camera));
  const auto columns = static_cast<uint32_t>(physics_f64::airGrid(view).columns);
  return lut_.record(commands, tables, &constants, (columns + 7) / 8, kExtent.height / 8);
}

}  // namespace alpenglow::sky
