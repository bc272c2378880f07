// Frames for tests of views: states, numbers and commands that never execute.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {

inline constexpr VkExtent2D kExtent = {24, 16};
inline const VkCommandBuffer kNoCommands = reinterpret_cast<VkCommandBuffer>(uintptr_t{1});

struct RecordCall {
  const char* name;
  Status (*record)(View*, VkCommandBuffer);
};
inline constexpr RecordCall kRecordCalls[] = {{"recordLuts", alpenglow::recordLuts},
                                              {"recordShadowMap", recordShadowMap},
                                              {"recordLightShafts", recordLightShafts},
                                              {"recordAerialPerspective", recordAerialPerspective},
                                              {"recordSky", alpenglow::recordSky}};

/// The sun at an elevation, seen from 0 degrees north, 0 degrees east.
inline Vec sunAt(double elevation, double azimuth = 0.5) {
  double sun[3];
  sunDirection(0.0, 0.0, elevation, azimuth, sun);
  return vec(sun);
}

class FrameTest : public SkyTest {
 protected:
  static FrameState drawAt(double altitude, double elevation, double heading = 0.0) {
    return makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, altitude, heading, 0.1, 0.0, 1.0),
                    sunAt(elevation), kExtent);
  }

  /// A frame number that nothing has been recorded in.
  uint64_t nextFrame() {
    finishFrames(context());
    return device().frame();
  }

  ResourceReport report() {
    ResourceReport result;
    resourceReport(context(), &result);
    return result;
  }

  /// Records something whose commands never execute.
  void recordInVain(const std::function<void(VkCommandBuffer)>& record) {
    std::string error;
    EXPECT_FALSE(device().run(
        [&](VkCommandBuffer commands) {
          record(commands);
          return false;
        },
        &error));
  }

  Picture pictureOf(View* with, const FrameDesc& desc) {
    run([&](VkCommandBuffer commands) {
      return beginFrame(with, desc, nullptr) == Status::Ok &&
             alpenglow::recordLuts(with, commands) == Status::Ok;
    });
    TargetDesc targetDesc;
    targetDesc.extent = kExtent;
    Target target(device(), targetDesc);
    return target.draw([&](VkCommandBuffer commands) {
      return alpenglow::recordSky(with, commands) == Status::Ok;
    });
  }
};

/// Moved about the axis towards the sun: neither altitude nor the sun's elevation change. And
/// turned.
inline FrameState movedSideways(const FrameState& draw, double angle, double heading) {
  const Vec k = vec(draw.sun.direction), p = vec(draw.camera.position_m), across = cross(k, p);
  const double along = dot(k, p) * (1.0 - std::cos(angle));
  Vec q;
  for (size_t i = 0; i < 3; ++i)
    q[i] = p[i] * std::cos(angle) + across[i] * std::sin(angle) + k[i] * along;
  const Parameters earth = preset("earth");
  FrameState moved = draw;
  moved.camera = cameraFromGeodetic(earth, std::asin(q[2] / length(q)), std::atan2(q[1], q[0]),
                                    length(q) - earth.bottomRadius_m, heading, -0.2, 0.3, 1.2);
  return moved;
}

}  // namespace alpenglow::testing
