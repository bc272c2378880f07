// An aerial-perspective LUT of one's own, and queries of it through a small compute shader
// (aerial_perspective_lookup.comp).
#pragma once

#include "atmosphere/passes/aerial_perspective_lut.h"
#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {

/// Where to look in the LUT: a unit vector, and metres in the atmosphere, or the negative share of
/// all that there are.
struct AerialQuery {
  float direction[3];
  float inside;
};

/// From the LUT, and (wanted) by integration. `inside`: metres in the atmosphere; the fourth values
/// else unused.
struct AerialAnswer {
  float single[3], inside;
  float multiple[3], unused0;
  float depth[3], unused1;
  float singleAlone[3], unused2;
  float wantedSingle[3], hitsGround;
  float wantedMultiple[3], extent;
  float wantedDepth[3], inAtmosphere;
};
static_assert(sizeof(AerialAnswer) == 112);

/// What the shader is specialized for: the last three answer in `single` alone, for timing.
enum class AerialAsk : uint32_t { All, Light, SingleAlone, Nothing };

/// Push constants that the test shaders share: what a lookup needs of a draw.
struct LookupConstants {
  float up[3], altitude;
  float sun[3], count;
  float azimuth[3], horizon;
  float span, bend, extinction, startHeight;
  float height;
};

class AerialPerspectiveTest : public SkyTest {
 protected:
  static void TearDownTestSuite();

  /// One for all tests of a program, made at the first use.
  passes::AerialPerspectiveLut* volume();
  void fill(const FrameState& draw, Tables* with = nullptr);
  /// Looks into the LUT as it was filled last.
  std::vector<AerialAnswer> ask(const FrameState& draw, const std::vector<AerialQuery>& queries,
                                Tables* with = nullptr);
  /// User CPU seconds of a submit with `count` queries, or of filling the LUT: the least of
  /// some.
  double askSeconds(const FrameState& draw, AerialAsk what,
                    const std::vector<AerialQuery>& queries);
  double fillSeconds(const FrameState& draw);
  static LookupConstants lookupConstants(const Parameters& parameters, const FrameState& draw);

 private:
  void makeObjects();
  bool recordAsk(VkCommandBuffer commands, const FrameState& draw, AerialAsk what, size_t count,
                 Tables* baked);
  double leastSeconds(const std::function<bool(VkCommandBuffer)>& record);
};

}  // namespace alpenglow::testing
