#include "atmosphere/view/warnings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atmosphere/camera/camera_math.h"

namespace alpenglow::view {
namespace {

/// Greatest finite value that a colour format holds; infinity where it has no such limit here.
double greatestValue(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R16G16B16_SFLOAT:
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return 65504.0;
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
      return 64512.0;  // Of the ten-bit channel.
    default:
      return std::numeric_limits<double>::infinity();
  }
}

}  // namespace

bool Warnings::once(bool* reported, bool seen) {
  if (!seen || *reported) return false;
  *reported = true;
  return true;
}

void Warnings::checkAdvanced(engine::Device& device) {
  if (!device.frames().forgotten()) return;
  device.notice(Severity::Warning,
                "beginFrame was called a thousand times without advanceFrame, which must be called "
                "once a frame: what was destroyed, and scratch of bakes, is never freed.");
}

void Warnings::check(const engine::Device& device, const Parameters& parameters,
                     const FrameState& state, VkFormat colorFormat) {
  const double depth = parameters.bottomRadius_m - passes::cameraRadius(state.camera);
  if (once(&deepCamera_, depth > 0.1 * parameters.bottomRadius_m)) {
    device.notice(Severity::Warning,
                  "The camera is %g m below the ground of a planet of %g m: its position may be in "
                  "kilometres, or FrameDesc::world may lack the world's origin or axes.",
                  depth, parameters.bottomRadius_m);
  }
  double brightest = 0.0;
  for (uint32_t i = 0; i < kSpectrumSize; ++i)
    brightest = std::max(brightest, state.sun.irradiance[i]);
  if (once(&darkSun_, brightest == 0.0)) {
    device.notice(Severity::Warning,
                  "Light 0 has an irradiance of 0, so that the picture is black: see "
                  "Parameters::solarIrradiance, LightDesc::irradiance and Light::dimming.");
  }
  const double radius = state.sun.discRadius;
  const double solidAngle = 4.0 * 3.14159265358979323846 * std::pow(std::sin(0.5 * radius), 2.0);
  const double scale = state.radianceScale == 0.0 ? 1.0 : state.radianceScale;
  const double most = greatestValue(colorFormat);
  if (overflow_ || radius <= 0.0 || brightest * scale / solidAngle <= most) return;
  const Spectrum light = passes::sunlight(parameters, state);
  const double disc =
      *std::max_element(light.value, light.value + kSpectrumSize) * scale / solidAngle;
  if (once(&overflow_, disc > most)) {
    device.notice(
        Severity::Warning,
        "FrameDesc::radianceScale of %g makes the sun's disc %g, but ViewDesc::colorFormat "
        "holds at most %g, and infinity beyond: choose a smaller scale, draw without a "
        "disc, or let your tone mapping take infinity for white, as tone_map.glsl does.",
        scale, disc, most);
  }
}

}  // namespace alpenglow::view
