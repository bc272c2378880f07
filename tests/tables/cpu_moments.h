// The moment solver's own text as C++ in double, reading tables that the device has baked: what the
// tables of the next order must be.
#pragma once

#include <utility>

#include "tests/tables/cpu_table.h"

namespace alpenglow::moments_f64 {
using namespace physics_f64;             // NOLINT: as the source has it
using Spectrum = physics_f64::Spectrum;  // not the public one
using testing::DoubleTable;

#define IN(type) const type&
#define OUT(type) type&
#define ALPENGLOW_FN inline
#define ALPENGLOW_PI 3.14159265358979323846
#define SPECTRUM(value) Spectrum(value)
#define REAL(literal) static_cast<double>(literal)

/// One order at a time: set `depth_`, and from order 2 on `source_` of the order before and its
/// field by setNodes(); then solve().
class Solver {
 public:
  DoubleTable depth_, field_, source_;

  Solver(const Medium& medium, const MomentShape& shape) : medium_(medium), shape_(shape) {
    fill(&rules_, zenithCount(shape, kFineZeniths), 2, [&](int x, int y) {
      const bool used = x < zenithCount(shape, y == 0 ? 1 : kFineZeniths);
      return used ? Spectrum(zenithRule(shape, x, y), 0.0) : Spectrum(0.0);
    });
    fill(&legendre_, harmonics(), legendreRowOfSource(shape, 0) + int(shape.sourceGamma),
         [&](int x, int y) { return Spectrum(legendreOfTexel(medium, shape, x, y)); });
    const int degrees = int(shape.degree) + 1;
    fill(&rotations_, degrees * degrees, degrees * int(shape.nodesMuS),
         [&](int x, int y) { return Spectrum(rotationOfTexel(shape, x, y)); });
  }

  /// Pass I: the field between the nodes, from the layers of the nodes below each other.
  void setNodes(const DoubleTable& nodes) {
    nodes_ = nodes;
    const int rows = int(shape_.fieldR);
    fill(&field_, int(shape_.fieldMuS), rows * int(shape_.layers), [&](int x, int y) {
      return interpolatedNode(shape_, x, y % rows, y / rows * int(shape_.nodesR));
    });
  }

  /// Passes L, F, M, R and H.
  void solve(bool first);

  Spectrum readDepth(Real2 u) const { return Spectrum(depth_.sample(u[0], u[1], 0.5)); }
  Spectrum readMoments(Real2 u) const { return Spectrum(field_.sample(u[0], u[1], 0.5)); }
  Spectrum readSource(Real3 u) const { return Spectrum(source_.sample(u[0], u[1], u[2])); }
  Spectrum fetchRadiance(int x, int y) { return fetch(&light_[0], x, y); }
  Spectrum fetchRadianceMie(int x, int y) { return fetch(&light_[1], x, y); }
  Spectrum fetchRadianceGround(int x, int y) { return fetch(&light_[2], x, y); }
  Spectrum fetchModes(int x, int y) { return fetch(&modes_, x, y); }
  Spectrum fetchMoments(int x, int y) { return fetch(&moments_, x, y); }
  Spectrum fetchSourceModes(int x, int y) { return fetch(&sourceModes_, x, y); }
  Real2 fetchRule(int x, int y) { return Real2(fetch(&rules_, x, y)); }
  Real fetchLegendre(int x, int y) { return fetch(&legendre_, x, y)[0]; }
  Real fetchRotation(int x, int y) { return fetch(&rotations_, x, y)[0]; }
  Spectrum fetchNode(int x, int y) { return fetch(&nodes_, x, y); }

#include "shaders/glsl/physics/field_lookup.glsl"
#include "shaders/glsl/physics/inscattering.glsl"
// After those that it needs.
#include "shaders/glsl/physics/harmonics.glsl"
//
#include "shaders/glsl/physics/moments.glsl"
#include "shaders/glsl/physics/node_interpolation.glsl"

  NodeField field(int node, bool first) { return fieldOfNode(medium_, shape_, node, first); }
  /// Texel x of a node, over `unit` (see sourceNorm).
  Spectrum source(int x, int node, Spectrum mean) {
    return sourceOfTexel(shape_, x, node) / sourceNorm(shape_, x, mean);
  }

 private:
  static Spectrum fetch(DoubleTable* table, int x, int y) {
    const double* texel = table->at(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 0);
    return {texel[0], texel[1], texel[2]};
  }

  template <class Function>
  static void fill(DoubleTable* table, int width, int height, Function&& function) {
    *table = DoubleTable(static_cast<uint32_t>(width), static_cast<uint32_t>(height), 1);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Spectrum value = function(x, y);
        double* texel = table->at(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 0);
        for (int c = 0; c < 3; ++c) texel[c] = value[c];
      }
  }

  int harmonics() const { return (int(shape_.degree) + 1) * (int(shape_.degree) + 2) / 2; }

  void makeSingle(int nodes) {
    const int width = int(shape_.azimuths) * zenithCount(shape_, kFineZeniths);
    for (int which = 0; which < 3; ++which)
      fill(&light_[which], width, nodes, [&](int x, int y) {
        Spectrum part[3];
        singleLight(medium_, shape_, x, y, part[0], part[1], part[2]);
        return part[which];
      });
  }

  void makeModes(bool first, int nodes) {
    const int modes = int(shape_.degree) + 1, groups = modeGroups(shape_);
    const int zeniths = zenithCount(shape_, first ? kFineZeniths : 1);
    fill(&modes_, modes * zeniths, nodes, [&](int x, int y) {
      const int mode = x % modes;
      const EightModes e =
          modesOfZenith(medium_, shape_, mode / 8 + groups * (x / modes), y, first);
      const Spectrum all[] = {e.a, e.b, e.c, e.d, e.e, e.f, e.g, e.h};
      return all[mode % 8];
    });
  }

  Medium medium_;
  MomentShape shape_;
  DoubleTable rules_, legendre_, rotations_, nodes_, light_[3], modes_, moments_, sourceModes_;
};

inline void Solver::solve(bool first) {
  const int nodes = int(shape_.nodesR) * int(shape_.nodesMuS);
  if (first) {
    makeSingle(nodes);
  } else {
    fill(&light_[0], int(shape_.azimuths) * zenithCount(shape_, 1), nodes,
         [&](int x, int y) { return multipleLight(medium_, shape_, x, y); });
  }
  makeModes(first, nodes);
  fill(&moments_, harmonics(), nodes,
       [&](int x, int y) { return momentOfNode(shape_, x, y, first); });
  DoubleTable turned;
  fill(&turned, harmonics(), nodes, [&](int x, int y) { return turnedMoment(shape_, x, y); });
  const DoubleTable aboutZenith = std::exchange(moments_, turned);
  fill(&sourceModes_, (int(shape_.degree) + 1) * int(shape_.sourceGamma), nodes,
       [&](int x, int y) { return sourceModeOfNode(shape_, x, y); });
  moments_ = aboutZenith;
}

#undef IN
#undef OUT
#undef ALPENGLOW_FN
#undef ALPENGLOW_PI
#undef SPECTRUM
#undef REAL

}  // namespace alpenglow::moments_f64
