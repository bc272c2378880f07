// Worlds and cameras, without a device: what one function makes another takes.
#include <alpenglow/camera.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/parameters/heard.h"

namespace alpenglow {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

Parameters earth() { return testing::allPresets()[0].parameters; }

double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

constexpr WorldAxes kLocalAxes[] = {WorldAxes::ZUp, WorldAxes::YUp, WorldAxes::ZUpLeftHanded,
                                    WorldAxes::YUpLeftHanded};

// East, north and up of the place, as the enumeration says.
TEST(Camera, DirectionsLieInTheAxesThatAreNamed) {
  constexpr double kExpected[4][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                         {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
  for (int axes = 0; axes < 4; ++axes) {
    World world;
    ASSERT_EQ(placeWorld(earth(), 0.7, -1.9, 300.0, kLocalAxes[axes], &world, {}), Status::Ok);
    EXPECT_NEAR(std::sqrt(dot(world.origin_m, world.origin_m)), earth().bottomRadius_m + 300.0,
                1e-6);
    const double angles[3][2] = {{0.0, 90.0 * kDegree}, {0.0, 0.0}, {90.0 * kDegree, 0.0}};
    for (int i = 0; i < 3; ++i) {
      double direction[3];
      directionAt(world, 0.7, -1.9, angles[i][0], angles[i][1], direction);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(direction[k], kExpected[axes][i][k], 1e-12) << axes << i << k;
    }
  }
}

// The camera that a host's world holds is that of the planet frame, wherever the world lies.
TEST(Camera, TheSamePlaceInAnyWorld) {
  const Camera inPlanet = cameraAt(earth(), {}, 0.8, 0.2, 1500.0, 0.9, -0.3, 0.4);
  for (const WorldAxes axes : {WorldAxes::EarthCentered, WorldAxes::ZUp, WorldAxes::YUp,
                               WorldAxes::ZUpLeftHanded, WorldAxes::YUpLeftHanded}) {
    World world;
    ASSERT_EQ(placeWorld(earth(), 0.79, 0.21, 10.0, axes, &world, {}), Status::Ok);
    const Camera camera = cameraAt(earth(), world, 0.8, 0.2, 1500.0, 0.9, -0.3, 0.4);
    EXPECT_NEAR(dot(camera.forward, camera.forward), 1.0, 1e-12);
    EXPECT_NEAR(dot(camera.forward, camera.up), 0.0, 1e-12);
    for (int k = 0; k < 3; ++k) {
      double position = world.origin_m[k], forward = 0.0, up = 0.0;
      for (int i = 0; i < 3; ++i) {
        const double axis = axes == WorldAxes::EarthCentered && world.axes[i][i] == 0.0
                                ? double(i == k)
                                : world.axes[i][k];
        position += axis * camera.position[i];
        forward += axis * camera.forward[i];
        up += axis * camera.up[i];
      }
      EXPECT_NEAR(position, inPlanet.position[k], 1e-6) << int(axes) << k;
      EXPECT_NEAR(forward, inPlanet.forward[k], 1e-12) << int(axes) << k;
      EXPECT_NEAR(up, inPlanet.up[k], 1e-12) << int(axes) << k;
    }
  }
}

// Degrees in place of radians are what is mistaken most often.
TEST(Camera, PlacesBeyondThePolesAreRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  World world;
  world.origin_m[0] = 7.0;
  testing::Heard heard;
  const auto place = [&](double latitude, double longitude, double altitude) {
    return placeWorld(earth(), latitude, longitude, altitude, WorldAxes::YUp, &world, heard.sink());
  };
  EXPECT_EQ(place(36.5, 0.0, 0.0), Status::InvalidArgument);
  EXPECT_NE(heard.sentence.find("latitude of 36.5"), std::string::npos) << heard.sentence;
  EXPECT_NE(heard.sentence.find("radians"), std::string::npos) << heard.sentence;
  EXPECT_EQ(place(kNan, 0.0, 0.0), Status::InvalidArgument);
  EXPECT_EQ(place(0.1, kNan, 0.0), Status::InvalidArgument);
  EXPECT_EQ(place(0.1, 0.0, kInfinity), Status::InvalidArgument);
  EXPECT_EQ(heard.count, 4);
  EXPECT_EQ(world.origin_m[0], 7.0);
  EXPECT_EQ(world.axes[0][0], 0.0);
  EXPECT_EQ(placeWorld(earth(), 0.0, 0.0, 0.0, WorldAxes::YUp, nullptr, heard.sink()),
            Status::InvalidArgument);
  EXPECT_NE(heard.sentence.find("null for world"), std::string::npos) << heard.sentence;
  // Both poles are places.
  EXPECT_EQ(place(90.0 * kDegree, 0.0, 0.0), Status::Ok);
  EXPECT_EQ(place(-90.0 * kDegree, 400.0, 0.0), Status::Ok);

  for (const double bad : {36.5, kNan}) {
    const Camera camera = cameraAt(earth(), {}, bad, 0.0, 2.0, 0.0, 0.0, 0.0);
    EXPECT_EQ(dot(camera.forward, camera.forward), 0.0);
    double direction[3] = {1.0, 1.0, 1.0};
    directionAt({}, bad, 0.0, 0.5, 0.0, direction);
    EXPECT_EQ(dot(direction, direction), 0.0);
  }
  for (const double elevation : {20.0, -1.7, kNan}) {
    double direction[3] = {1.0, 1.0, 1.0};
    directionAt({}, 0.1, 0.0, elevation, 0.0, direction);
    EXPECT_EQ(dot(direction, direction), 0.0) << elevation;
  }
  const Camera camera = cameraAt(earth(), {}, 0.1, 0.0, 2.0, 0.0, kNan, 0.0);
  EXPECT_EQ(dot(camera.forward, camera.forward), 0.0);
}

// The host's matrices give the camera whose own matrix is theirs.
TEST(Camera, MatricesGoBothWays) {
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    for (const DepthConvention depth : {DepthConvention::Standard, DepthConvention::Reversed}) {
      for (const double farPlane : {0.0, 5000.0}) {
        const bool parallel = projection == Projection::Orthographic;
        if (parallel && farPlane == 0.0) continue;
        Camera camera = cameraAt(earth(), {}, 0.1, 0.2, 100.0, 0.7, 0.2, 0.3);
        camera.fov = parallel ? 0.0 : 0.9;
        camera.height = parallel ? 400.0 : 0.0;
        camera.nearPlane = 2.0;
        camera.farPlane = farPlane;
        camera.viewport.extent = {640, 360};
        float clip[16];
        ASSERT_EQ(clipFromCamera(projection, depth, camera, clip), Status::Ok);
        // View axes: right, up, backwards.
        double view[16] = {}, ofView[16] = {};
        const double *f = camera.forward, *u = camera.up;
        const double right[3] = {f[1] * u[2] - f[2] * u[1], f[2] * u[0] - f[0] * u[2],
                                 f[0] * u[1] - f[1] * u[0]};
        for (int k = 0; k < 3; ++k) {
          view[k] = right[k];
          view[4 + k] = u[k];
          view[8 + k] = -f[k];
        }
        // clipFromView is clipFromCamera times the rotation.
        for (int column = 0; column < 3; ++column)
          for (int row = 0; row < 4; ++row)
            for (int k = 0; k < 3; ++k)
              ofView[4 * column + row] += double(clip[4 * k + row]) * view[4 * column + k];
        for (double& value : ofView)
          if (std::abs(value) < 1e-6) value = 0.0;  // Rounding of floats, which a host hasn't.
        for (int row = 0; row < 4; ++row) ofView[12 + row] = clip[12 + row];
        if (!parallel) ofView[11] = std::round(ofView[11]);
        std::copy_n(camera.position, 3, view + 12);
        view[15] = 1.0;
        Camera back;
        back.viewport = camera.viewport;
        testing::Heard heard;
        ASSERT_EQ(cameraFromMatrices(view, ofView, depth, false, &back, heard.sink()), Status::Ok)
            << heard.sentence;
        EXPECT_NEAR(back.fov, camera.fov, 1e-5);
        EXPECT_NEAR(back.height, camera.height, 1e-2);
        EXPECT_NEAR(back.nearPlane, 2.0, 2e-2);
        EXPECT_NEAR(back.farPlane, farPlane, 0.02 * farPlane);
        for (int k = 0; k < 3; ++k) {
          EXPECT_EQ(back.position[k], camera.position[k]);
          EXPECT_EQ(back.forward[k], camera.forward[k]);
          EXPECT_EQ(back.up[k], camera.up[k]);
        }
        EXPECT_EQ(back.viewport.extent.width, 640u);
      }
    }
  }
  float clip[16];
  Camera none;
  EXPECT_EQ(clipFromCamera(Projection::Fisheye, DepthConvention::Standard, none, clip),
            Status::InvalidArgument);
  EXPECT_EQ(clipFromCamera(Projection::Perspective, DepthConvention::Standard, none, clip),
            Status::InvalidArgument);
}

}  // namespace
}  // namespace alpenglow
