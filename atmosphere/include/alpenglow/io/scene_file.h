// Scene files (docs/schema/scene.schema.json): an atmosphere, a sun, a camera, the ground
// and a picture.
#pragma once

#include <alpenglow/io/result.h>
#include <alpenglow/io/tone_map.h>
#include <alpenglow/plan.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace alpenglow::io {

/// About the camera's local vertical; radians. Files hold degrees.
struct SceneSun {
  double elevation = 0.0;   ///< Above the horizontal.
  double azimuth = 0.0;     ///< Clockwise from north. Default 0.
  double discRadius = 0.0;  ///< 0 draws no disc. Default 0.2667 degrees.
};

/// Radians. Each field may be left out of the file; the values here are the defaults.
struct SceneCamera {
  double latitude = 0.0;
  double longitude = 0.0;
  double altitude_m = 2.0;  ///< Below 0 is drawn as 0.
  double heading = 0.0;     ///< Clockwise from north.
  double pitch = 0.0;       ///< Above the horizontal.
  double roll = 0.0;        ///< Clockwise.
  Projection projection = Projection::Perspective;
  double fov = 0.0;  ///< Default 60 degrees, or 180 for a fisheye; 0 where orthographic.
  /// Given: the camera is orthographic and its picture spans this many metres from bottom to top;
  /// `projection` is then Perspective.
  std::optional<double> orthographicHeight_m;
};

/// A height map on the ground. Angles in radians; see TerrainDesc for what the numbers do.
struct SceneTerrain {
  std::string heightMap;          ///< A path that can be opened from here, of an image.
  double metersPerPixel[2] = {};  ///< Along a row, and from row to row.
  double metersPerUnit = 1.0;     ///< Of the image's values.
  double heightScale = 1.0;
  double base_m = 0.0;
  double fade_m = 0.0;
  double latitude = 0.0;   ///< Of the centre. Default: the camera's.
  double longitude = 0.0;  ///< Likewise.
  double heading = 0.0;    ///< Clockwise; 0: the image's top edge faces north.
  Spectrum albedo;         ///< Default: the atmosphere's groundAlbedo.
  std::string albedoMap;   ///< An image over the height map, instead of `albedo`; empty: none.
};

/// A hot-air balloon of translucent cloth: half a sphere, drawn out below. It casts no shadow.
/// Angles in radians.
struct SceneBalloon {
  double latitude = 0.0;
  double longitude = 0.0;
  double altitude_m = 0.0;  ///< Of the sphere's centre.
  double radius_m = 10.0;
  Spectrum color{{0.8, 0.8, 0.8}};  ///< Albedo of the cloth.
  double opacity = 1.0;             ///< Share of what is behind that it hides.
};

/// The night sky, where a program draws one.
struct SceneStars {
  double siderealHours = 0.0;  ///< Sidereal time of longitude 0: any number; 24 turn them once.
};

/// How light shafts are drawn.
enum class SceneLightShafts : uint32_t {
  Auto,          ///< The program's choice; none where there is no terrain.
  ShadowVolume,  ///< Shadow volumes with one length of shadow per ray, as in the 2008 paper.
  LightVolume,   ///< Light-volume mesh: the sum over all lit segments of a ray.
  RayMarch,      ///< Samples along the ray in a shadow map.
  Off,
};

/// The model of a scene's atmosphere: docs/baselines.md.
enum class SceneModel : uint32_t {
  Bruneton,  ///< All orders, by the scene's solver.
  Single,    ///< The same with one scattering event.
  HoffmanPreetham,
  ONeil,
  Schafhitzel,
  Hillaire,
};

/// What a scene may ask for while it is shown: alpenglow/plan.h. Without it the scene is one still
/// picture.
struct SceneRequirements {
  std::optional<double> altitude_m[2];    ///< Of the camera, from and to. None: its own.
  std::optional<double> sunElevation[2];  ///< Radians. None: its own.
  std::optional<double> exposure;         ///< The greatest. None: any.
  double error = 0.0;                     ///< As PlanRequest::errorTarget; the next as well.
  uint64_t budgetBytes = 0;
  double budgetSeconds = 0.0;
};

struct Scene {
  Parameters atmosphere;
  SceneSun sun;
  SceneCamera camera;
  std::string albedoMap;  ///< A path that can be opened from here; empty: the uniform albedo.
  std::optional<SceneTerrain> terrain;
  std::vector<SceneBalloon> balloons;
  std::optional<SceneStars> stars;                   ///< None: no stars.
  SceneLightShafts shafts = SceneLightShafts::Auto;  ///< Also off where effects.light_shafts is.
  uint32_t lightShaftStepCount = 32;  ///< Along a ray, of SceneLightShafts::RayMarch.
  uint32_t width = 1024;
  uint32_t height = 768;
  std::optional<double> exposure;  ///< A factor; none: automatic.
  ToneMap toneMap = ToneMap::Filmic;
  SceneModel model = SceneModel::Bruneton;
  std::optional<uint32_t> modelStepCount;  ///< TableDesc::stepCount; None: the model's default.
  std::optional<Solver> solver;            ///< None: the default.
  std::optional<uint32_t> orders;    ///< None: the solver's default; 1 with SceneModel::Single.
  std::optional<Quality> quality;    ///< Of Solver::Moments; none: the default.
  Force effects[kEffectCount] = {};  ///< By Effect.
  std::optional<SceneRequirements> requirements;
};

/// Most pixels along a side of a picture.
inline constexpr uint32_t kMaxPictureSide = 16384;
/// Most samples along a ray for light shafts.
inline constexpr uint32_t kMaxLightShaftSteps = 4096;
/// Most balloons of a scene.
inline constexpr uint32_t kMaxBalloons = 1000;

/// How files spell the models, in the order of their values.
const std::vector<std::string>& modelNames();
std::string modelName(SceneModel model);
/// The solver of a model that is one of its own; none for Bruneton and Single.
std::optional<Solver> solverOf(SceneModel model);

/// Reads and checks everything, the atmosphere included; paths in the file are relative to it.
Result<Scene> readScene(const std::string& path);
/// As readScene, for text; `folder` is where its paths start.
Result<Scene> parseScene(const std::string& text, const std::string& name,
                         const std::string& folder);

/// The content of a scene file, for a scene that a file could hold. Parameters of a preset become
/// its name. Sun, camera, terrain and balloons have all their fields; others are left out at their
/// defaults. Paths are made absolute and lexically normal ("a/../b" is "b"), since the content may
/// be put anywhere; bytes that are no UTF-8 become U+FFFD in them.
///
/// Read back it is the same scene with those paths: all numbers bit for bit, and the angles of
/// scenes that were read. About one in eleven of other angles equals no number of degrees;
/// it comes back as a neighbouring double, and stays that when it is written again. A lone end of a
/// range in `needs` comes back with the scene's own value at the other.
std::string formatScene(const Scene& scene);
/// Fails, too, when no scene file can hold the scene: a reader would refuse it or open other paths.
Done writeScene(const std::string& path, const Scene& scene);

/// What an ATMOSPHERE on the command line gave: a preset's name, an atmosphere file, or a scene
/// file whose atmosphere is meant. The last two are distinguished by content.
struct AtmosphereSource {
  Parameters parameters;
  std::optional<Scene> scene;  ///< Present when it was a scene file.
};
Result<AtmosphereSource> findAtmosphereOrScene(const std::string& nameOrPath);

}  // namespace alpenglow::io
