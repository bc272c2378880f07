// What a scene calls for: needs in, plan out. A plan says which effects are simulated, over which
// part of the tables, at which resolution and by which method, and for each choice why and what it
// saves. Pure functions; no Vulkan call; thread-safe.
#pragma once

#include <alpenglow/shafts.h>
#include <alpenglow/view.h>

namespace alpenglow {
inline namespace v1 {

/// What may come into view. Bits.
enum Seen : uint32_t {
  kSeenSky = 1u << 0,
  kSeenGround = 1u << 1,   ///< The planet's own surface.
  kSeenTerrain = 1u << 2,  ///< The host's opaque scene, in a depth image.
  kSeenSpace = 1u << 3,    ///< Pixels whose rays meet no air.
  kSeenSun = 1u << 4,      ///< The sun's disc.
};
using SeenFlags = uint32_t;

enum class Force : uint32_t { Auto, On, Off };

/// What a scene may ask for while its plan holds. Zero means the default.
struct Needs {
  double altitudeFrom_m = 0.0;  ///< Of the camera.
  double altitudeTo_m = 0.0;    ///< 0: no limit.
  /// Of the sun, seen from the camera's places and from the ground in view; radians. Both 0: any.
  double sunElevationFrom = 0.0, sunElevationTo = 0.0;
  bool sunFixed = false;  ///< With both of the above equal, 0 too: this elevation and no other.
  SeenFlags seen = 0;     ///< 0: anything.
  double sunDiscRadius = 0.0;  ///< The greatest that is drawn; 0: none.
  /// Factor from radiance (for Parameters::solarIrradiance) to a picture whose white is 1: the
  /// greatest that is used. Light of less than half an 8-bit step under it can't be seen. 0: any.
  double exposureTo = 0.0;
  bool occluders = false;  ///< Casters of light shafts.
  Projection projection = Projection::Perspective;
  double error = 0.0;          ///< Wanted 95th percentile of the relative error; 0: 0.01.
  uint64_t budgetBytes = 0;    ///< Of device memory that stays; 0: none.
  double budgetSeconds = 0.0;  ///< Of a bake; 0: none.
  /// Of the host's own timings of recordBake; 0: that of lavapipe on 2 cores (docs/plan.md).
  double secondsPerUnit = 0.0;
  Force effects[kEffectCount] = {};
};

/// What something costs, or saves.
struct PlanCost {
  uint64_t bytes = 0;      ///< Of images that stay.
  uint64_t bakeBytes = 0;  ///< Of images that a bake takes besides.
  uint64_t texels = 0;     ///< Of images that stay.
  uint64_t images = 0;     ///< That stay.
  uint64_t pipelines = 0;
  uint64_t dispatches = 0;  ///< Of a bake in one piece, and of a frame.
  uint64_t units = 0;       ///< Of a bake: about one table fetch each.
};

struct EffectChoice {
  bool on = false;
  bool forced = false;
  char reason[192] = "";  ///< A sentence.
  PlanCost saves;         ///< Off: against the same plan with it. On: zeros.
};

/// A part of the domain, a size or a method.
struct PlanChoice {
  const char* name = "";  ///< Such as "sun_zenith" or "quality"; static.
  char value[96] = "";
  char reason[192] = "";
  PlanCost saves;
};
inline constexpr uint32_t kMaxPlanChoices = 12;
inline constexpr uint32_t kMaxPlanTables = 12;

/// An image that stays.
struct PlanTable {
  const char* name = "";  ///< Static.
  uint32_t width = 0, height = 0, depth = 0;
  uint64_t bytes = 0;
};

struct Plan {
  Needs needs;
  EffectChoice effects[kEffectCount];  ///< By Effect.
  PlanChoice choices[kMaxPlanChoices];
  uint32_t choiceCount = 0;
  PlanTable tables[kMaxPlanTables];
  uint32_t tableCount = 0;

  TableDesc tableDesc;
  EffectFlags viewWithout = 0;  ///< ViewDesc::without.
  bool skySlice = true;         ///< ViewDesc::skySlice and alwaysSliced.
  bool sceneDepth = false;      ///< ViewDesc::sceneDepth.
  bool shafts = false;          ///< ViewDesc::shafts.
  ShaftMethod shaftMethod = ShaftMethod::Exact;
  CapabilityFlags capabilities = 0;  ///< What a context for it needs.

  double expectedError = 0.0;  ///< 95th percentile, of the worst band in the sun's range.
  bool errorMet = true;        ///< expectedError <= Needs::error.
  bool budgetMet = true;
  PlanCost cost;   ///< Of all of it.
  PlanCost whole;  ///< Of the default: everything, everywhere, at the default quality.
};

/// Plans. Values of `base` that are given (solver, orders, quality, moments, format ...) are kept;
/// Solver::Moments profits, others have their effects planned but for those of tables. On
/// InvalidArgument `message` (of `messageSize` bytes, may be 0) is a sentence that names the wrong
/// field, and `out` is as it was.
ALPENGLOW_API Status makePlan(const Parameters& parameters, const Needs& needs,
                              const TableDesc& base, Plan* out, char* message, size_t messageSize);

/// What a draw may see of sky, ground, space and the sun's disc: conservative, as recordSky finds
/// it. Terrain is the host's to add.
ALPENGLOW_API SeenFlags seenBy(const Parameters& parameters, Projection projection,
                               const SkyDraw& draw);

/// Fills what a plan decides of a view: solver, mie, without, alwaysSliced. The host adds its
/// formats, skySlice if Plan::skySlice, sceneDepth and shafts.
ALPENGLOW_API void describeView(const Plan& plan, ViewDesc* view);

/// What must be made anew when needs change: until it is ready, the old serves on.
struct PlanChange {
  bool tables = false;  ///< A bake.
  bool view = false;    ///< Pipelines and images of the view; no bake.
  bool shafts = false;
  char reason[256] = "";  ///< A sentence; "" when the plan still serves.
};
/// Whether a plan in use serves other needs, and if not, what the plan for them makes anew. Nothing
/// while altitude, sun and what is seen stay in the plan's ranges.
ALPENGLOW_API PlanChange comparePlans(const Plan& current, const Plan& next);
/// As comparePlans, but only whether `current` covers `needs`; false with a sentence of what it
/// lacks.
ALPENGLOW_API bool planServes(const Plan& plan, const Needs& needs, char* reason,
                              size_t reasonSize);

}  // namespace v1
}  // namespace alpenglow
