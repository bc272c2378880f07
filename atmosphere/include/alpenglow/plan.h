// What a scene needs: a request in, descriptions out. A plan says which effects are simulated,
// over which part of the tables, at which resolution and by which method, and for each choice why
// and what it saves. Pure functions; no Vulkan call; thread-safe.
#pragma once

#include <alpenglow/view.h>

namespace alpenglow {
inline namespace v1_0 {

/// Auto: the plan decides.
enum class Force : uint32_t { Auto, On, Off };

/// What a scene may ask for while its plan holds. Zero is the default of each member.
struct PlanRequest {
  /// Values that are given (solver, orders, quality, sizes, format ...) are kept.
  TableDesc tables;
  /// Values that are given are kept: projection, formats, lightShafts, methods that are not the
  /// default.
  ViewDesc view;
  double altitudeFrom_m = 0.0;  ///< Of the camera.
  double altitudeTo_m = 0.0;    ///< 0: no limit.
  /// Of the sun, at the camera's positions and at the ground in view; radians. Both 0: any.
  double sunElevationFrom = 0.0, sunElevationTo = 0.0;
  bool sunFixed = false;  ///< With both of the above equal, 0 too: this elevation and no other.
  bool casters = false;   ///< The scene has casters of light shafts.
  double casterAltitude_m = 0.0;  ///< Greatest altitude of their points; 0: any.
  VisibilityFlags visible = 0;    ///< 0: anything.
  double sunDiscRadius = 0.0;     ///< Greatest radius that is drawn; 0: none.
  /// Greatest factor from radiance (for Parameters::solarIrradiance) to a picture whose white is 1.
  /// Light that it leaves below half an 8-bit step is invisible. 0: any.
  double exposure = 0.0;
  double errorTarget = 0.0;    ///< 95th percentile of the relative error; 0: 0.01.
  uint64_t budgetBytes = 0;    ///< Of device memory that stays; 0: no limit.
  double budgetSeconds = 0.0;  ///< Of a bake; 0: no limit.
  /// Time of a work unit in the host's recordBake; 0: that of lavapipe on 2 cores (docs/plan.md).
  double secondsPerUnit = 0.0;
  Force effects[kEffectCount] = {};  ///< By Effect.
};

/// What something costs, or saves.
struct PlanCost {
  uint64_t bytes = 0;      ///< Of images that stay.
  uint64_t bakeBytes = 0;  ///< Of images that only a bake needs.
  uint64_t texels = 0;     ///< Of images that stay.
  uint64_t images = 0;     ///< That stay.
  uint64_t pipelines = 0;
  uint64_t dispatches = 0;  ///< Of an unsliced bake, and of a frame.
  uint64_t units = 0;       ///< Of a bake: about one table fetch each.
};

/// An effect, a part of the domain, a size or a method.
struct PlanChoice {
  char name[32] = "";     ///< An effect's name, or "sun_zenith", "quality" ...
  char value[96] = "";    ///< "on" or "off" of effects.
  char reason[192] = "";  ///< A sentence.
  bool on = false;        ///< Of effects; others are on.
  bool forced = false;    ///< The request decided it.
  PlanCost saves;  ///< Of an effect that is off: against the same plan with it. Else against the
                   ///< default of the choice.
};
/// The first kEffectCount choices are the effects, by Effect.
inline constexpr uint32_t kMaxPlanChoices = kEffectCount + 12;
inline constexpr uint32_t kMaxPlanImages = 12;

/// Descriptions that serve a request, and the reasons.
struct Plan {
  PlanRequest request;
  TableDesc tables;  ///< For createTables.
  /// For createView; the host adds its formats. `aerialPerspective` and `lightShafts.method` are
  /// Off where the plan disables them.
  ViewDesc view;
  CapabilityFlags capabilities = 0;  ///< What a context for it needs.

  double expectedError = 0.0;        ///< 95th percentile, of the worst band in the sun's range.
  double expectedBakeSeconds = 0.0;  ///< By PlanRequest::secondsPerUnit.
  bool errorMet = false;             ///< expectedError <= PlanRequest::errorTarget.
  bool budgetMet = false;
  PlanCost cost;   ///< Of the whole plan.
  PlanCost whole;  ///< Of the default: everything, everywhere, at the default quality.
  PlanChoice choices[kMaxPlanChoices];
  uint32_t choiceCount = 0;          ///< kEffectCount and more.
  ImageInfo images[kMaxPlanImages];  ///< That stay: name, extent, bytes; the rest is zero.
  uint32_t imageCount = 0;
};

/// Makes a plan. For solvers other than Solver::Moments the effects of tables are not planned. On
/// failure `sink` gets a sentence, and `out` is as it was: InvalidArgument where the
/// parameters, the request or its tables are wrong, OutOfHostMemory.
ALPENGLOW_API Status makePlan(const Parameters& parameters, const PlanRequest& request, Plan* out,
                              const DiagnosticSink& sink);

/// What a frame may show of sky, ground, space and the sun's disc: conservative, as recordSky finds
/// it. The host adds kVisibleScene. All other flags where beginFrame would refuse the frame.
ALPENGLOW_API VisibilityFlags visibleFrom(const Parameters& parameters, Projection projection,
                                          const FrameDesc& frame);

/// What must be recreated when the plan changes. Bits.
enum RecreateFlag : uint32_t {
  kRecreateTables = 1u << 0,  ///< A bake.
  kRecreateView = 1u << 1,    ///< Pipelines and images of the view and its light shafts; no bake.
};
using RecreateFlags = uint32_t;

/// What must be recreated to go from `current` to `next`; 0 while the ranges of `current` cover
/// next.request. The reason is reported to `sink` as Info.
ALPENGLOW_API RecreateFlags comparePlans(const Plan& current, const Plan& next,
                                         const DiagnosticSink& sink);

}  // namespace v1_0
}  // namespace alpenglow
