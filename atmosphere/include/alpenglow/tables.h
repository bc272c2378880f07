// The precomputed tables of an atmosphere, baked in slices into the host's command buffers: those
// of the moment solver, or T, E and S of Bruneton & Neyret 2008.
#pragma once

#include <alpenglow/context.h>
#include <alpenglow/effects.h>
#include <alpenglow/parameters.h>

namespace alpenglow {
inline namespace v1 {

struct Tables;  ///< Opaque.

enum class TableFormat : uint32_t { Half, Float };  ///< RGBA16F, RGBA32F.
/// Of Solver::Standard.
enum class MieStorage : uint32_t {
  Full,    ///< Single Mie scattering in a table of its own, three channels (six values).
  Packed,  ///< Its first channel in the alpha of S; the others by the paper's rule (four values).
};
enum class Solver : uint32_t {
  Moments,   ///< Light on nodes of (r, mu_s); rays are integrated: docs/moment-solver.md.
  Standard,  ///< The paper's Algorithm 4.1; tables of rays.
  // Simpler models, each as its paper has it, to compare with: docs/models.md.
  HoffmanPreetham,  ///< 2002: air of constant density, one event, in closed form. No table.
  ONeil,            ///< 2005: one event, TableDesc::samples points along a ray.
  Schafhitzel,      ///< 2007: one event, a table of (r, mu, mu_s) without the azimuth.
  Hillaire,         ///< 2020: a sky-view table each frame, multiple scattering in 32 x 32 texels.
};
/// Points of the moment solver's curve of error against cost: docs/accuracy.md has both, measured.
enum class Quality : uint32_t { Default, Draft, Low, Medium, High, Ultra };  ///< Default: Medium.

/// Texels of each table. 0 means the paper's: T 256x64 (mu x r), E 64x16 (mu_s x r) and
/// S 32x128x32x8 (r x mu x mu_s x nu). Each at least 2; scatteringMu at least 4 and even.
struct TableSizes {
  uint32_t transmittanceMu = 0, transmittanceR = 0;
  uint32_t irradianceMuS = 0, irradianceR = 0;
  uint32_t scatteringR = 0, scatteringMu = 0, scatteringMuS = 0, scatteringNu = 0;
};
ALPENGLOW_API TableSizes defaultTableSizes();

/// Where a simpler model is undefined or leaves something out: a sentence, static; "" for the
/// solvers that have no such place.
ALPENGLOW_API const char* modelLimit(Solver solver);

/// Resolution of the moment solver. 0 means what momentSettings() says.
struct MomentSettings {
  uint32_t depthMu = 0, depthH = 0;   ///< Texels of the table of optical depths.
  uint32_t nodesR = 0, nodesMuS = 0;  ///< Where the field is solved.
  uint32_t ringsSky = 0;              ///< Zenith angles of incoming light above the horizontal;
  uint32_t ringsLimb = 0;             ///< between it and the horizon;
  uint32_t ringsGround = 0;           ///< below the horizon.
  uint32_t azimuths = 0;              ///< Over half a turn.
  uint32_t degree = 0;                ///< Of the spherical harmonics, at most kMaxDegree.
  uint32_t sourceGamma = 0, sourcePsi = 0;  ///< Directions of the table of sources.
  uint32_t solverPanels = 0;  ///< Panels of 2 points for each smooth stretch of a ray: of the bake,
  uint32_t viewPanels = 0;    ///< and of a ray that is looked along.
};
inline constexpr uint32_t kMaxDegree = 47;
/// Texels across a layer of the table of moments: the nodes, and two between any two of them.
constexpr uint32_t fieldTexels(uint32_t nodes) { return 3 * (nodes - 1) + 1; }

/// Most orders of a bake: more than any air needs, few enough to number the passes.
inline constexpr uint32_t kMaxOrders = 1000;
/// Most of TableDesc::samples.
inline constexpr uint32_t kMaxSamples = 1024;

struct TableDesc {
  Solver solver = Solver::Moments;
  uint32_t orders = 0;  ///< Most events of a path; 0: all of them (moments), or 5 (standard).
  TableFormat format = TableFormat::Half;
  bool keepOrders = false;  ///< Keeps the scratch tables, so that each order's can be read back.
  Quality quality = Quality::Default;  ///< Of Solver::Moments.
  MomentSettings moments;              ///< Of Solver::Moments; beats the quality.
  MieStorage mie = MieStorage::Full;   ///< Of Solver::Standard.
  TableSizes sizes;                    ///< Of Solver::Standard.
  /// Bits of kTableEffects: nothing is baked, allocated or compiled for these. Views and shaders
  /// that read the tables are without the same. Of Solver::Moments. Default: none left out.
  EffectFlags without = 0;
  /// Of Solver::Moments: zenith angles of the sun, radians, seen from wherever light is asked for;
  /// the tables reach beyond them as far as rays do. Both 0: any. Light of other suns is that of
  /// the nearest that the tables hold.
  double sunZenithFrom = 0.0, sunZenithTo = 0.0;
  uint32_t samples = 0;  ///< Points of a ray, of Solver::ONeil (0: 10) and Hillaire (0: 32).
};

/// The settings that a quality level has for an atmosphere, by the rule of docs/accuracy.md, with
/// what `custom` gives in place of it. Pure; thread-safe.
ALPENGLOW_API MomentSettings momentSettings(const Parameters& parameters, Quality quality,
                                            const MomentSettings& custom);

/// Checks parameters and sizes, allocates, and records nothing. The tables are then Ok to bake or
/// to upload; on a context without kCapabilityBake only to upload, and they take no scratch memory.
/// Those of the simpler models are only baked: they have no TableId.
/// `tables` is destroyed with destroyTables, before its context.
ALPENGLOW_API Status createTables(Context* context, const Parameters& parameters,
                                  const TableDesc& desc, Tables** out);

/// Frees the tables once `frame.completed` of a later call reaches `frame.submitting`. Also cancels
/// a bake. Null is ignored.
ALPENGLOW_API void destroyTables(Tables* tables, const FrameInfo& frame);

/// One pass of the bake.
struct BakeProgress {
  bool done = false;
  const char* pass = "";   ///< The pass this call recorded into, such as "dJ 3". Static string
                           ///< of the tables, valid while they live.
  uint32_t passIndex = 0;  ///< 0 ... passCount - 1.
  uint32_t passCount = 0;
  bool passFinished = false;  ///< This call recorded the pass's last tile.
  uint32_t order = 0;         ///< Scattering order that the pass belongs to; 0 for T.
  uint64_t unitsDone = 0;     ///< Work units recorded so far; a unit is about one table fetch.
  uint64_t unitsTotal = 0;
  uint64_t unitsRecorded = 0;  ///< By this call.
};

/// Records the next slice of the bake: at least one tile, at most about `budget` work units, never
/// more than one pass (0: the rest of the pass). Call it until `progress->done`; each call's
/// commands must execute in order on one queue. The finished tables are the same, byte for byte,
/// however the bake is sliced. Leaves no state bound but the compute pipeline, set 0 and push
/// constants. Scratch tables are freed when the frame of the last call completes.
ALPENGLOW_API Status recordBake(Tables* tables, VkCommandBuffer commands, const FrameInfo& frame,
                                uint64_t budget, BakeProgress* progress);

enum class TableId : uint32_t {
  OpticalDepth,  ///< ln(1 + 1e5 tau), T = exp(-tau) towards the top: x mu, y r. Either solver; of
                 ///< Moments tau times the shell's thickness over the ray's length.
  Moments,       ///< Mean radiance, its second moments and E, five tables below each other: x mu_s,
                 ///< y r (shaders/glsl/physics/field.glsl). Moments; the next as well.
  Source,        ///< Light that aerosols scatter, as a ratio, into angle gamma from the sun and
                 ///< azimuth psi about it: x gamma + gammas psi, y mu_s, z r, at the nodes.
  Irradiance,    ///< E of the sky on the ground, per unit solar irradiance: x mu_s, y r. Standard;
                 ///< the next two as well.
  Scattering,    ///< S: C_* = S_R[L0] + S[L_*] / P_R, alpha C_M first channel if packed.
  SingleMie,     ///< C_M = S_M[L0] / P_M; only with MieStorage::Full.
  OrderMoments,  ///< Moments of the order just finished, at the nodes alone. Moments.
  OrderSource,   ///< Source of the order after the one just finished. Moments.
  OrderIrradiance,  ///< dE of the order just finished (order 1: the sun's direct light).
  OrderScattering,  ///< dS of the order just finished (order 1: Rayleigh, without phase).
  OrderSingleMie,   ///< Order 1 only: Mie, without phase function.
};
inline constexpr uint32_t kTableIdCount = 11;

/// Shape of a table as its image has it. Texel (x, y, z); S has x = mu_s + sizeMuS * nu, y = mu,
/// z = r.
struct TableInfo {
  const char* name = "";
  uint32_t width = 0, height = 0, depth = 0;
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint64_t bytes = 0;  ///< Of a tightly packed copy.
};
/// Unsupported for a table that this description doesn't have.
ALPENGLOW_API Status tableInfo(const Tables* tables, TableId id, TableInfo* out);

/// Records a copy into `buffer` (usage TRANSFER_DST), tightly packed from `offset` (a multiple of
/// 16). Legal when the table is finished: T, E, S and the single Mie once the bake is done; those
/// of an order, with TableDesc::keepOrders, right after the pass that finished them ("dS n"),
/// before the next recordBake. The copy is made visible to the host's reads. NotReady otherwise.
ALPENGLOW_API Status recordTableReadback(Tables* tables, VkCommandBuffer commands, TableId id,
                                         VkBuffer buffer, VkDeviceSize offset);

/// Records the filling of OpticalDepth, Irradiance, Scattering or SingleMie from `buffer` (usage
/// TRANSFER_SRC), laid out as a readback leaves it. When all of them are uploaded, the tables are
/// ready, without a bake. The host checks that the data are for these parameters.
ALPENGLOW_API Status recordTableUpload(Tables* tables, VkCommandBuffer commands,
                                       const FrameInfo& frame, TableId id, VkBuffer buffer,
                                       VkDeviceSize offset);

/// True when the tables are baked or uploaded, so that views and probes may use them.
ALPENGLOW_API bool tablesReady(const Tables* tables);

/// The descriptor set that alpenglow/atmosphere.glsl binds: 0 uniform parameters, then of the
/// moment solver 1 optical depth, 2 moments, 3 and 4 source; of the standard one 1 T, 2 E, 3 S, 4
/// single Mie (S again when packed); of the simpler models 1 T, then what docs/models.md says. A
/// binding whose table TableDesc::without leaves out holds the optical depths: a shader must not
/// declare it (ALPENGLOW_WITHOUT_SOURCE and ALPENGLOW_WITHOUT_MULTIPLE of
/// alpenglow/atmosphere.glsl). For compute and fragment stages. The images are in
/// VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL once ready. Owned by the context and the tables.
ALPENGLOW_API VkDescriptorSetLayout tableSetLayout(const Context* context);
ALPENGLOW_API VkDescriptorSet tableSet(const Tables* tables);

}  // namespace v1
}  // namespace alpenglow
