// The passes of a bake: what each reads and writes, in which order, and how much work it is.
#pragma once

#include <alpenglow/tables.h>

#include <vector>

namespace alpenglow::bake {

/// The compute shaders of the standard solver.
enum class PassKind : uint32_t {
  OpticalDepth,
  DirectIrradiance,
  SingleScattering,
  IncidentRadiance,
  ScatteringDensity,
  DiffuseIrradiance,
  MultipleScattering,
};
inline constexpr uint32_t kPassKindCount = 7;

/// Images of a bake. The first four last; the others are scratch, but for DeltaMie, which is the
/// table of single Mie scattering when that is stored in full.
enum ImageId : uint32_t {
  kOpticalDepth,
  kIrradiance,
  kScattering,
  kDeltaMie,
  kDeltaIrradiance,
  kDeltaScattering,
  kDeltaSource,
  kIncident,
  kIncidentMie,
};
inline constexpr uint32_t kImageCount = 9;

inline constexpr uint32_t kMaxOutputs = 3;
inline constexpr uint32_t kNoImage = ~0u;

/// Which images a kind of pass samples and which it stores, in the order of its bindings.
struct PassIo {
  uint32_t inputs[kImageCount + 1];  ///< Ends with kNoImage.
  uint32_t outputs[kMaxOutputs];
  bool
      accumulates;  ///< The last output is read and written in place, each texel by its invocation.
};
const PassIo& passIo(PassKind kind);

struct Pass {
  PassKind kind = PassKind::OpticalDepth;
  uint32_t order = 0;
  bool firstOrder =
      false;  ///< The order before is single scattering, kept without phase functions.
  char name[16] = "";
  uint32_t width = 0, height = 0;
  uint32_t rows = 0;         ///< height times depth.
  uint64_t unitsPerRow = 0;  ///< Work units: about one table fetch each.
};

/// Algorithm 4.1 for `orders` orders: T; dE 1; dS 1; then dL n, dJ n, dE n, dS n for n = 2 ...
/// `orders`.
std::vector<Pass> standardPasses(const TableSizes& sizes, uint32_t orders);

/// Zenith angles of the quadrature of J: kSphereTheta of shaders/glsl/physics/standard.glsl.
inline constexpr uint32_t kSphereTheta = 16;

/// The smallest piece of a pass that is dispatched apart: the height of a workgroup.
inline constexpr uint32_t kTileRows = 8;

}  // namespace alpenglow::bake
