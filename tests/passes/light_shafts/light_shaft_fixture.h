// A small host with casters: draws them into its depth image, and the library's shadows,
// atmosphere and sky; and the same rays for the reference in double.
#pragma once

#include "atmosphere/reference/scene_light.h"
#include "engine/memory.h"
#include "engine/pipeline.h"
#include "tests/passes/light_shafts/light_shaft_rig.h"
#include "tests/reference/test_meshes.h"

namespace alpenglow::testing {

/// Local coordinates: metres up, east and north of the point of the ground at latitude 0, longitude
/// 0, which are the planet's axes there, so `origin()` is all that lies between them.
Vec groundOrigin(const Parameters& parameters);

/// User CPU of each step.
struct LightShaftSeconds {
  double depth = 0.0, luts = 0.0, shadowMap = 0.0, shafts = 0.0, air = 0.0;
};

struct LightShaftPicture {
  Picture light;              ///< Of the atmosphere and the sky over a black scene.
  std::vector<float> sums;    ///< Four a pixel (LightVolume), or two (ShadowVolume).
  std::vector<float> bounds;  ///< Two a pixel (ShadowVolume).
  std::vector<float> depth;   ///< The host's.
  LightShaftSeconds seconds;
};

class LightShaftTest : public SkyTest {
 protected:
  void SetUp() override;
  void TearDown() override;
  static void TearDownTestSuite();

  /// In local coordinates; drawn by the next pictures and known to `rays()`.
  void addCaster(const reference::test::Mesh& mesh);
  void clearCasters();
  /// All casters, in the planet's frame.
  const reference::MeshRays& rays();
  const Box& bounds() const { return bounds_; }
  Casters casters(uint64_t version = 0);
  /// Of `target`'s depth image, with casters().
  FrameDesc frameOf(const LightShaftRig& target, const FrameState& draw);
  bool drawNothing = false;  ///< The callback of casters() draws nothing.
  /// Over a black ground, so that shadows only remove light of the atmosphere. Called by SetUp.
  void useEarth();
  /// A medium of constant density, so thin that light is proportional to the lit length.
  void useThinMedium();
  Parameters parameters;  ///< Of `baked`.
  Tables* baked = nullptr;

  /// At local (up, east, north), looking at angles like a scene's camera.
  FrameState drawFrom(const Vec& local, double heading, double pitch, double fov, VkExtent2D extent,
                      double sunElevation, double sunAzimuth);
  /// With objects that are created at the first use of such a setup and reused by all further ones.
  /// `with`: another view of the same setup, which may be of another size.
  LightShaftPicture draw(const LightShaftSetup& setup, const FrameState& draw,
                         View* with = nullptr);
  LightShaftRig& rigOf(const LightShaftSetup& setup, VkExtent2D size);
  /// The host's depth, which its view reads from then on.
  Status recordDepth(VkCommandBuffer commands, const LightShaftSetup& setup, const FrameState& draw,
                     LightShaftRig& target);
  /// Aerial perspective and sky of the frame that `view` has begun, into the target's colour.
  Status recordLight(VkCommandBuffer commands, const LightShaftSetup& setup, const FrameState& draw,
                     View* view, LightShaftRig& target);
  /// Ray through the middle of a pixel, in the planet's frame: origin and direction.
  std::pair<Vec, Vec> pixelRay(const LightShaftSetup& setup, const FrameState& draw, double x,
                               double y);

 private:
  struct CasterBuffers {
    engine::Buffer vertices, indices;
    engine::MemoryBlock block;
    uint32_t indexCount = 0;
  };
  static std::vector<std::unique_ptr<LightShaftRig>>& rigs();
  void drawAll(VkCommandBuffer commands);

  std::vector<reference::test::Mesh> meshes_;
  std::vector<CasterBuffers> buffers_;
  std::unique_ptr<reference::MeshRays> rays_;
  Box bounds_;
};

}  // namespace alpenglow::testing
