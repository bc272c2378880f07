// The atmosphere over a host's scene, with light shafts, from tables and views without effects.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/passes/light_shafts/light_shaft_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr EffectFlags kMie = effectBit(Effect::Mie),
                      kGroundAndDisc = effectBit(Effect::Ground) | effectBit(Effect::SunDisc);
constexpr VkExtent2D kExtent = {48, 32};

class EffectSceneTest : public LightShaftTest {
 protected:
  void SetUp() override {
    LightShaftTest::SetUp();
    addCaster(
        reference::test::box(reference::Vector(0, 1500, -600), reference::Vector(2000, 2500, 600)));
    view_ = drawFrom({50, 0, 0}, 90, 50, 60, kExtent, 30, 140);
  }

  LightShaftPicture seen(EffectFlags disabledEffects, bool fromLut, bool shafts) {
    LightShaftSetup setup;
    setup.disabledEffects = disabledEffects;
    setup.fromLut = fromLut;
    setup.shafts = shafts;
    setup.shadowMapSize = 256;
    setup.meshSize = 128;
    return draw(setup, view_);
  }

  /// The greatest difference of two pictures, relative to the first's pixel or a hundredth of its
  /// brightest.
  static double difference(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.data.size(), b.data.size());
    float brightest = 0.0f;
    for (const float value : a.data) brightest = std::max(brightest, value);
    EXPECT_GT(brightest, 0.0f);
    double most = 0.0;
    for (size_t i = 0; i < a.data.size() && i < b.data.size(); ++i) {
      if (i % 4 == 3) continue;
      const double own = std::max(a.data[i], 0.01f * brightest);
      most = std::max(most, std::abs(double(a.data[i]) - b.data[i]) / own);
    }
    return most;
  }

  void expectShadow(const Picture& shaded, bool fromLut) {
    const Picture sunny = seen(kViewEffects, fromLut, false).light;
    EXPECT_GT(difference(shaded, sunny), 0.05) << "The shadow is not in the picture.";
  }

  FrameState view_;
};

// The complete tables have no aerosols either; molecules need fewer harmonics.
TEST_F(EffectSceneTest, AbsentAerosolsDoNotChangeThePicture) {
  parameters.mie.present = false;
  Tables* const whole = tables("earth, black ground, clear", parameters);
  TableDesc desc;
  desc.quality = Quality::Draft;
  desc.disabledEffects = kMie;
  Tables* part = nullptr;
  parameters.mie.present = true;
  ASSERT_EQ(createTables(context(), parameters, desc, &part), Status::Ok) << message();
  bakeAll(device(), part);
  for (const bool fromLut : {true, false}) {
    baked = whole;
    const Picture wanted = seen(kViewEffects, fromLut, true).light;
    expectShadow(wanted, fromLut);
    baked = part;
    const double most = difference(wanted, seen(kMie | kViewEffects, fromLut, true).light);
    std::printf("without aerosols, %s: %.2e\n", fromLut ? "sliced" : "integrated", most);
    EXPECT_LT(most, 1e-5);
  }
  destroyTables(part);
}

TEST_F(EffectSceneTest, DisablingSpaceViewsKeepsPicturesFromInside) {
  for (const bool fromLut : {true, false}) {
    const Picture wanted = seen(kGroundAndDisc, fromLut, true).light;
    const double most = difference(wanted, seen(kViewEffects, fromLut, true).light);
    std::printf("without space, %s: %.2e\n", fromLut ? "sliced" : "integrated", most);
    EXPECT_LT(most, 1e-5);
  }
}

}  // namespace
}  // namespace alpenglow::testing
