// The precomputed tables of an atmosphere, baked in slices into the host's command buffers: those
// of the moment solver, or T, E and S of Bruneton & Neyret 2008.
#pragma once

#include <alpenglow/context.h>
#include <alpenglow/effects.h>
#include <alpenglow/parameters.h>

namespace alpenglow {
inline namespace v1_0 {

/// Opaque. Host access must be externally synchronised while the tables are baked, uploaded or
/// destroyed. Tables that are ready are only read: any number of threads and views may use them.
struct Tables;

enum class TableFormat : uint32_t { Half, Float };  ///< RGBA16F, RGBA32F.
/// Of Solver::Standard.
enum class MieStorage : uint32_t {
  Full,    ///< Single Mie scattering in a table of its own, three channels (six values).
  Packed,  ///< Its first channel in the alpha of S; the others by the paper's rule (four values).
};
enum class Solver : uint32_t {
  Moments,   ///< Light on nodes of (r, mu_s); rays are integrated: docs/moment-solver.md.
  Standard,  ///< The paper's Algorithm 4.1; tables of rays.
  // Simpler models for comparison, each as published: docs/baselines.md.
  HoffmanPreetham,  ///< 2002: air of constant density, one event, in closed form. No table.
  ONeil,            ///< 2005: one event, TableSizes::stepCount points along a ray.
  Schafhitzel,      ///< 2007: one event, a table of (r, mu, mu_s) without the azimuth.
  Hillaire,         ///< 2020: a sky-view LUT each frame, multiple scattering in 32 x 32 texels.
};
/// Of Solver::Moments: points of its curve of error against cost; docs/accuracy.md has both,
/// measured.
enum class Quality : uint32_t { Default, Draft, Low, Medium, High, Ultra };  ///< Default: Medium.

/// Host copies of tables for answerQueries on the CPU.
enum class CpuQueries : uint32_t {
  None,
  Light,  ///< All but skyRadiance of rays.
  All,
};

/// Resolution. 0 means the value that solver, quality and atmosphere give: resolveTableDesc().
/// Those of another solver must be 0.
struct TableSizes {
  // Of Solver::Moments.
  uint32_t depthMu = 0, depthH = 0;   ///< Texels of the table of optical depths.
  uint32_t nodesR = 0, nodesMuS = 0;  ///< Where the field is solved.
  uint32_t zenithsSky = 0;            ///< Zenith angles of incoming light above the horizontal;
  uint32_t zenithsLimb = 0;           ///< between it and the horizon;
  uint32_t zenithsGround = 0;         ///< below the horizon.
  uint32_t azimuths = 0;              ///< Over half a turn.
  uint32_t degree = 0;                ///< Of the spherical harmonics, at most 47.
  uint32_t sourceGamma = 0, sourcePsi = 0;  ///< Directions of the table of sources.
  uint32_t solverPanels = 0;  ///< Panels of 2 points for each smooth segment of a ray: of the bake,
  uint32_t viewPanels = 0;    ///< and of a view ray.
  // Of Solver::Standard, in texels; 0: the paper's, T 256x64 (mu x r), E 64x16 (mu_s x r) and
  // S 32x128x32x8 (r x mu x mu_s x nu). Each at least 2; scatteringMu at least 4 and even.
  uint32_t transmittanceMu = 0, transmittanceR = 0;
  uint32_t irradianceMuS = 0, irradianceR = 0;
  uint32_t scatteringR = 0, scatteringMu = 0, scatteringMuS = 0, scatteringNu = 0;
  /// Points of a ray, of Solver::ONeil (0: 10) and Hillaire (0: 32); at most 1024.
  uint32_t stepCount = 0;
};

/// Most orders of a bake: more than any medium needs, few enough to number the passes.
inline constexpr uint32_t kMaxOrders = 1000;
inline constexpr uint32_t kMaxLights = 4;
inline constexpr uint32_t kMaxWavelengths = 12;

enum class LightKind : uint32_t {
  Default,  ///< Light 0: Star; others: None.
  Star,
  Moon,  ///< Refused by this version.
  None,
};
/// What tables must know of a light.
struct LightDesc {
  LightKind kind = LightKind::Default;
  Spectrum irradiance;  ///< At the top of the atmosphere; 0: Parameters::solarIrradiance.
};

struct TableDesc {
  Solver solver = Solver::Moments;
  Quality quality = Quality::Default;  ///< Of Solver::Moments.
  uint32_t orders = 0;  ///< Most events of a path; 0: all (Moments), or 5 (Standard).
  TableFormat format = TableFormat::Half;
  MieStorage mie = MieStorage::Full;            ///< Of Solver::Standard.
  uint32_t wavelengthCount = 0;                 ///< 0 or 3. This version refuses others.
  double wavelengths_nm[kMaxWavelengths] = {};  ///< Must be 0 in this version.
  TableSizes sizes;                             ///< What is given beats the quality.
  LightDesc lights[kMaxLights];  ///< This version refuses all but lights[0] of kind Star.
  /// Bits of kTableEffects: nothing is baked, allocated or compiled for these. Views and shaders
  /// that read the tables lack the same effects. Of Solver::Moments. Default: none left out.
  EffectFlags disabledEffects = 0;
  /// Of Solver::Moments: zenith angles of the sun, radians, seen from wherever light is asked for;
  /// the tables reach beyond them as far as rays do. Both 0: any. Light of other sun elevations is
  /// that of the nearest that the tables hold.
  double sunZenithFrom = 0.0, sunZenithTo = 0.0;
  CpuQueries cpuQueries = CpuQueries::None;  ///< Of Solver::Moments.
  bool keepOrders = false;  ///< Keeps the scratch tables, so that each order's can be read back.
  /// Stages of the baking queue that read the tables, of shaders; 0: compute and fragment. A
  /// compute-only queue names the compute stage alone. recordProbe needs the compute stage.
  VkPipelineStageFlags2 readerStages = 0;
};

/// Fills every 0 of `desc` with the value that it stands for. What has no other value stays 0: all
/// orders, any sun, no effect left out, and Quality::Default of solvers that have no quality.
/// InvalidArgument or Unsupported, with a sentence that names the field, for what createTables
/// refuses on any device; `desc` is then unchanged. Pure; thread-safe.
ALPENGLOW_API Status resolveTableDesc(const Parameters& parameters, TableDesc* desc,
                                      const DiagnosticSink& sink);

/// Where a simpler model is undefined or leaves something out: a sentence, static; "" for the
/// solvers that have no such place.
ALPENGLOW_API const char* modelLimit(Solver solver);

/// Checks parameters and sizes, allocates, and records nothing. The tables are then Ok to bake or
/// to upload; on a context without kCapabilityBake only to upload, and they take no scratch memory.
/// Those of the simpler models are only baked: they have no TableId.
/// destroyTables, or destroyContext, destroys `*out`.
ALPENGLOW_API Status createTables(Context* context, const Parameters& parameters,
                                  const TableDesc& desc, Tables** out);

/// Deferred: freed once the frame being recorded has completed (advanceFrame). Cancels a bake. Null
/// is ignored.
ALPENGLOW_API void destroyTables(Tables* tables);

/// What a call of recordBake has done, and how far the bake is.
struct BakeProgress {
  bool done = false;
  bool passFinished = false;   ///< This call recorded the pass's last tile.
  const char* pass = nullptr;  ///< The pass this call recorded into, such as "dJ 3"; null: none.
                               ///< Static string of the tables, valid while they live.
  uint32_t passIndex = 0;      ///< 0 ... passCount - 1.
  uint32_t passCount = 0;
  uint32_t order = 0;      ///< Scattering order that the pass belongs to; 0 for T.
  uint64_t unitsDone = 0;  ///< Work units recorded so far; a unit is about one table fetch.
  uint64_t unitsTotal = 0;
  uint64_t unitsRecorded = 0;  ///< By this call.
};

/// Records the next slice of the bake: at least one tile, at most about `budget` work units, never
/// more than one pass (0: the rest of the pass). Call it until `progress->done`; each call's
/// commands must execute in order on one queue. The finished tables are the same, byte for byte,
/// however the bake is sliced. Leaves no state bound but the compute pipeline, set 0 and push
/// constants. Scratch tables are freed when the frame of the last call completes.
ALPENGLOW_API Status recordBake(Tables* tables, VkCommandBuffer commands, uint64_t budget,
                                BakeProgress* progress);

enum class TablesState : uint32_t {
  Empty,
  Baking,    ///< Some slices, or some of the tables of an upload, are recorded.
  Recorded,  ///< Ready for commands that execute later: on the same queue, or behind a semaphore.
  Complete,  ///< The frame of the last slice or upload has completed: ready for answerQueries, and
             ///< for other queues.
};

/// Index of TablesInfo::images.
enum TableId : uint32_t {
  kTableOpticalDepth,  ///< ln(1 + 1e5 tau), T = exp(-tau) towards the top: x mu, y r. Both
                       ///< solvers; of Moments tau times the shell's thickness over the ray's
                       ///< length.
  kTableMoments,       ///< Mean radiance, its second moments and E, five tables below each other:
                       ///< x mu_s, y r (shaders/glsl/physics/field.glsl). Moments; the next too.
  kTableSource,        ///< Light that aerosols scatter, as a ratio, into angle gamma from the sun
                       ///< and azimuth psi about it: x gamma + gammas psi, y mu_s, z r, at the
                       ///< nodes.
  kTableIrradiance,    ///< E of the sky on the ground, per unit solar irradiance: x mu_s, y r.
                       ///< Standard; the next two as well.
  kTableScattering,    ///< S: C_* = S_R[L0] + S[L_*] / P_R, alpha C_M first channel if packed;
                       ///< x = mu_s + sizeMuS * nu, y = mu, z = r.
  kTableSingleMie,     ///< C_M = S_M[L0] / P_M; only with MieStorage::Full.
  kTableOrderMoments,  ///< Moments of the order just finished, at the nodes alone. Moments.
  kTableOrderSource,   ///< Source of the order after the one just finished. Moments.
  kTableOrderIrradiance,  ///< dE of the order just finished (order 1: the sun's direct light).
  kTableOrderScattering,  ///< dS of the order just finished (order 1: Rayleigh, without phase).
  kTableOrderSingleMie,   ///< Order 1 only: Mie, without phase function.
  kTableIdCount,
};

/// What tables are and hold. The simpler models have none of `images`.
///
/// The descriptor set has at binding 0 the uniform parameters; then of the moment solver 1 optical
/// depth, 2 moments, 3 and 4 source; of the standard one 1 T, 2 E, 3 S, 4 single Mie (S again when
/// packed); of the simpler models 1 T, then what docs/baselines.md says. A binding whose table
/// TableDesc::disabledEffects leaves out holds the optical depths: a shader must not declare it
/// (ALPENGLOW_WITHOUT_SOURCE and ALPENGLOW_WITHOUT_MULTIPLE of alpenglow/atmosphere.glsl). For
/// compute and fragment stages. The images are in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL once
/// they are Recorded.
struct TablesInfo {
  TablesState state = TablesState::Empty;
  TableDesc desc;                                    ///< Completed, as by resolveTableDesc.
  VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;  ///< Identical for all tables of a context.
  VkDescriptorSet set = VK_NULL_HANDLE;              ///< For alpenglow/atmosphere.glsl.
  /// By TableId; a null name: not had. Those of single orders only with TableDesc::keepOrders.
  ImageInfo images[kTableIdCount];
};
ALPENGLOW_API Status tablesInfo(const Tables* tables, TablesInfo* out);

/// Records a copy into `buffer` (usage TRANSFER_DST), tightly packed from `offset` (a multiple of
/// 16). Legal when the table is finished: tables of all orders once the bake is done; those
/// of one order, with TableDesc::keepOrders, right after the pass that finished them ("dS n"),
/// before the next recordBake. The copy is made visible to the host's reads. NotReady otherwise.
/// Unsupported for a table that this description doesn't have.
ALPENGLOW_API Status recordTableReadback(Tables* tables, VkCommandBuffer commands, TableId id,
                                         VkBuffer buffer, VkDeviceSize offset);

/// Records the filling of a table that is not of a single order from `buffer` (usage TRANSFER_SRC),
/// laid out as a readback leaves it. When all of them are uploaded, the tables are ready, without a
/// bake. The host checks that the data are for these parameters.
ALPENGLOW_API Status recordTableUpload(Tables* tables, VkCommandBuffer commands, TableId id,
                                       VkBuffer buffer, VkDeviceSize offset);

}  // namespace v1_0
}  // namespace alpenglow
