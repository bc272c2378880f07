#include <algorithm>
#include <numbers>
#include <vector>

#include "exact_geometry.h"
#include "physics_overloads.h"

namespace alpenglow::test {
namespace {

template <class P>
class Geometry : public testing::Test {};
TYPED_TEST_SUITE(Geometry, Precisions, PrecisionNames);

const double kAltitudes[] = {0, 0.1, 2, 30, 1000, 9000, 30e3, 59.9e3, 60e3};

/// Cosines of every kind for an observer at h: steep, level, and to both sides of the horizon by
/// angles down to what `Real` resolves.
template <class Real>
std::vector<Real> cosines(double bottom, double h) {
  const double horizon = -std::sqrt(h * (2 * bottom + h)) / (bottom + h);
  std::vector<double> list = {1,     0.9,   0.3,   0.05, 1e-3, 1e-5, 0,
                              -1e-5, -1e-3, -0.05, -0.3, -0.9, -1};
  for (double degrees : {0.0, 1e-5, 1e-3, 0.01, 0.05, 0.5}) {
    for (double sign : {-1.0, 1.0}) {
      list.push_back(std::cos(std::acos(horizon) + sign * degrees * std::numbers::pi / 180));
    }
  }
  std::vector<Real> result;
  for (double mu : list) {
    result.push_back(static_cast<Real>(mu));
  }
  for (int i = 0; i < 3; ++i) {  // The horizon's neighbours in Real.
    result.push_back(std::nextafter(result.back(), Real(-1)));
  }
  return result;
}

/// How far an exact distance moves when mu does by two units in the last place: near the tangent no
/// arithmetic on that mu can do better.
template <class Real, class Distance>
Long spread(const ExactRay& ray, Distance distance) {
  const Long step = 2 * std::numeric_limits<Real>::epsilon();
  Long least = distance(ray), most = least;
  for (Long factor : {1 - step, 1 + step}) {
    const Long d =
        distance(ExactRay{ray.bottom, ray.h, std::clamp(ray.mu * factor, Long(-1), Long(1))});
    least = std::min(least, d);
    most = std::max(most, d);
  }
  return most - least;
}

template <class Precision>
void expectDistancesAgree(const Parameters& p, double tolerance) {
  using Real = typename Precision::Real;
  const auto m = Precision::medium(p);
  for (double altitude : kAltitudes) {
    const Real h = static_cast<Real>(altitude);
    for (Real mu : cosines<Real>(p.bottomRadius_m, altitude)) {
      SCOPED_TRACE(testing::Message() << "h " << altitude << " mu " << mu);
      const ExactRay exact{m.bottomRadius, h, mu};
      const bool hits = rayHitsGround(m, h, mu);
      const Long slack = 4 * std::numeric_limits<Real>::epsilon() * exact.rho2();
      if (std::abs(exact.delta()) > slack) {
        EXPECT_EQ(hits, exact.hitsGround());
      }
      if (hits && exact.hitsGround()) {
        const auto toGround = [](const ExactRay& ray) { return ray.toGround(); };
        EXPECT_NEAR(static_cast<double>(distanceToGround(m, h, mu)),
                    static_cast<double>(exact.toGround()),
                    tolerance + static_cast<double>(spread<Real>(exact, toGround)));
      }
      const auto toTop = [&](const ExactRay& ray) { return ray.toTop(m.thickness); };
      EXPECT_NEAR(static_cast<double>(distanceToTop(m, h, mu)),
                  static_cast<double>(exact.toTop(m.thickness)),
                  tolerance + static_cast<double>(spread<Real>(exact, toTop)));
    }
  }
}

TEST(GeometryInFloat, DistancesAgreeToAMetreOnEarth) {
  expectDistancesAgree<InFloat>(preset("earth"), 1.0);
}

TEST(GeometryInDouble, DistancesAgreeToAMicrometreOnAnyPlanet) {
  for (double radius : {10e3, 3389.5e3, 6360e3, 100e6}) {
    expectDistancesAgree<InDouble>(earthOfRadius(radius), 1e-6);
  }
}

TYPED_TEST(Geometry, DistancesAreFiniteWhateverWasDecided) {
  // The horizon is decided once: the other branch's functions must bear rays that miss by rounding.
  using Real = typename TypeParam::Real;
  for (double radius : {10e3, 6360e3, 100e6}) {
    const Parameters p = earthOfRadius(radius);
    const auto m = TypeParam::medium(p);
    for (double altitude : kAltitudes) {
      const Real h = static_cast<Real>(altitude);
      for (Real mu : cosines<Real>(radius, altitude)) {
        if (mu < 0) {
          EXPECT_GE(distanceToGround(m, h, mu), Real(0)) << altitude << " " << mu;
        }
        EXPECT_GE(distanceToTop(m, h, mu), Real(0)) << altitude << " " << mu;
      }
    }
  }
}

TEST(GeometryInFloat, RhoDoesNotCancel) {
  const auto m = makeMediumF32(preset("earth"));
  const double exact = std::sqrt(2.0 * (2 * 6360e3 + 2.0));
  EXPECT_NEAR(horizonRho(m, 2.0f), exact, 1e-6 * exact);
  EXPECT_NEAR(horizonMu(m, 2.0f), -exact / 6360002.0, 1e-6 * exact / 6360002.0);
  // What it would be from r alone. volatile: x87 or contraction would hide the rounding.
  volatile float r = 6360002.3f, r2 = r * r, bottom2 = 6360000.0f * 6360000.0f;
  const double naive = std::sqrt(static_cast<double>(r2 - bottom2));
  EXPECT_GT(std::abs(naive - std::sqrt(2.3 * (2 * 6360e3 + 2.3))) / exact, 0.01);
}

TEST(GeometryInFloat, AltitudesAlongRaysKeepADecimetre) {
  const Parameters p = preset("earth");
  const auto m = makeMediumF32(p);
  for (double altitude : kAltitudes) {
    const float h = static_cast<float>(altitude);
    for (float mu : cosines<float>(p.bottomRadius_m, altitude)) {
      const ExactRay exact{m.bottomRadius, h, mu};
      const bool hits = rayHitsGround(m, h, mu);
      const float length = hits ? distanceToGround(m, h, mu) : distanceToTop(m, h, mu);
      for (float fraction : {0.0f, 0.001f, 0.25f, 0.5f, 0.75f, 0.999f}) {
        const float t = fraction * length;
        const double expected = std::max(0.0, static_cast<double>(exact.altitudeAt(t)));
        // r mu is rounded to a float, and t times it comes back in the altitude.
        EXPECT_NEAR(altitudeAt(m, h, mu, t), expected, 0.1) << altitude << " " << mu << " " << t;
      }
    }
  }
}

TEST(GeometryInFloat, AltitudeContractOfThePositionSplit) {
  // Positions are double; the altitude is taken there and travels alone. 0.1 m at 2 m, 1e-6 of it
  // at 36,000 km, wherever the camera stands.
  const double bottom = 6360e3;
  for (double altitude : {2.0, 1000.0, 36e6}) {
    for (double latitude : {-1.5, -0.7, 0.0, 0.3, 1.2}) {
      for (double longitude : {-3.0, 0.1, 2.2}) {
        const double r = bottom + altitude;
        const double x = r * std::cos(latitude) * std::cos(longitude);
        const double y = r * std::cos(latitude) * std::sin(longitude);
        const double z = r * std::sin(latitude);
        const float h = static_cast<float>(std::sqrt(x * x + y * y + z * z) - bottom);
        EXPECT_NEAR(h, altitude, std::max(1e-6 * altitude, 1e-6));
      }
    }
  }
}

TYPED_TEST(Geometry, FarObserversFindTheirEntry) {
  using Real = typename TypeParam::Real;
  const bool single = std::is_same_v<Real, float>;
  const Parameters p = preset("earth");
  const auto m = TypeParam::medium(p);
  const double altitude = 36e6, r = p.bottomRadius_m + altitude;
  for (double zenith = 171.31; zenith <= 180.0; zenith += 0.1) {
    const double angle = zenith * std::numbers::pi / 180;
    const auto ray = makeRay(m, static_cast<Real>(altitude), static_cast<Real>(std::cos(angle)),
                             static_cast<Real>(std::sin(angle)), Real(0.5), Real(0.1));
    const Long b = r * std::sin(static_cast<Long>(angle));
    ASSERT_EQ(ray.inAtmosphere, b < p.topRadius_m) << zenith;
    if (!ray.inAtmosphere) {
      continue;
    }
    const Long halfTop = std::sqrt(Long(p.topRadius_m) * p.topRadius_m - b * b);
    const Long start = -r * std::cos(static_cast<Long>(angle)) - halfTop;
    EXPECT_NEAR(static_cast<double>(ray.start), static_cast<double>(start),
                (single ? 1e-6 : 1e-12) * altitude)
        << zenith;
    EXPECT_NEAR(static_cast<double>(ray.mu), static_cast<double>(-halfTop / p.topRadius_m),
                single ? 2e-6 : 1e-12)
        << zenith;
    EXPECT_EQ(ray.h, m.thickness);
    EXPECT_EQ(ray.hitsGround, b < p.bottomRadius_m) << zenith;
  }
}

TYPED_TEST(Geometry, RaysInsideStartAtTheObserver) {
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  const auto ray = makeRay(m, Real(1000), Real(-0.1), std::sqrt(Real(0.99)), Real(0.4), Real(0.2));
  EXPECT_EQ(ray.start, Real(0));
  EXPECT_EQ(ray.h, Real(1000));
  EXPECT_EQ(ray.mu, Real(-0.1));
  EXPECT_EQ(ray.muS, Real(0.4));
  EXPECT_TRUE(ray.inAtmosphere);
  EXPECT_TRUE(ray.hitsGround);
  EXPECT_EQ(ray.extent, distanceToGround(m, Real(1000), Real(-0.1)));
}

TYPED_TEST(Geometry, RaysAwayFromThePlanetMiss) {
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  EXPECT_FALSE(makeRay(m, Real(400e3), Real(0.2), Real(0.98), Real(1), Real(0)).inAtmosphere);
  EXPECT_FALSE(makeRay(m, Real(36e6), Real(0), Real(1), Real(1), Real(0)).inAtmosphere);
}

TYPED_TEST(Geometry, TangentRayMisses) {
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  EXPECT_FALSE(rayHitsGround(m, Real(0), Real(0)));
  EXPECT_TRUE(rayHitsGround(m, Real(0), Real(-1e-6)));
  EXPECT_EQ(distanceToGround(m, Real(0), Real(-1e-6)), Real(0));
}

}  // namespace
}  // namespace alpenglow::test
