// Atmospheres and queries that the tests of the reference share.
#pragma once

#include <alpenglow/parameters.h>
#include <alpenglow/query.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace alpenglow::test {

inline constexpr double kDegree = std::numbers::pi / 180.0;

inline Parameters preset(const char* name) {
  Parameters p;
  EXPECT_EQ(findPreset(name, &p, {}), Status::Ok) << name;
  return p;
}

inline ProbeQuery rayQuery(double altitude_m, double viewZenith_deg, double sunZenith_deg,
                           double azimuth_deg, double distance_m = -1.0) {
  ProbeQuery query;
  query.altitude_m = altitude_m;
  query.zenith = viewZenith_deg * kDegree;
  query.sunZenith = sunZenith_deg * kDegree;
  query.azimuth = azimuth_deg * kDegree;
  query.bounded = distance_m >= 0.0;
  query.distance_m = std::max(distance_m, 0.0);
  return query;
}

inline ProbeQuery irradianceQuery(double altitude_m, double sunZenith_deg) {
  ProbeQuery query;
  query.kind = QueryKind::Irradiance;
  query.altitude_m = altitude_m;
  query.sunZenith = sunZenith_deg * kDegree;
  return query;
}

/// Each value within `relative` of the expected one.
inline void expectClose(const Spectrum& actual, const Spectrum& expected, double relative,
                        const char* what) {
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    EXPECT_NEAR(actual[i], expected[i], relative * std::abs(expected[i])) << what << " " << i;
  }
}

inline void expectAll(const Spectrum& actual, double value, const char* what) {
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    EXPECT_EQ(actual[i], value) << what << " " << i;
  }
}

}  // namespace alpenglow::test
