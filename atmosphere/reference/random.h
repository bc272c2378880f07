// Random numbers of the path tracer: a counter-based generator, and a scrambled Sobol sequence for
// the first dimensions of a path, which most of the variance comes from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace alpenglow::reference {

/// The finaliser of SplitMix64 (Steele, Lea & Flood 2014): every bit depends on every bit.
inline uint64_t mixBits(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// SplitMix64. Streams of different (seed, stream) pairs have nothing in common.
class Random {
 public:
  Random(uint64_t seed, uint64_t stream)
      : state_(mixBits(mixBits(seed + 0x9E3779B97F4A7C15u) ^ (stream * 0xD1342543DE82EF95u + 1))) {}
  uint64_t bits() { return mixBits(state_ += 0x9E3779B97F4A7C15u); }
  /// In (0, 1), ends excluded.
  double uniform() { return (static_cast<double>(bits() >> 12) + 0.5) * 0x1p-52; }

 private:
  uint64_t state_;
};

/// The numbers of one batch of paths. leading() gives the next coordinate of the path's point of an
/// Owen-scrambled Sobol sequence, as long as there is one; random() never does.
class PathSampler {
 public:
  static constexpr size_t kDimensions = 6;

  PathSampler(uint64_t seed, uint64_t stream) : random_(seed, stream) {
    for (uint32_t& scramble : scramble_) scramble = static_cast<uint32_t>(random_.bits() >> 32);
  }

  /// Begins the batch's next path.
  void nextPath() {
    if (index_ > 0) {
      const auto changed = static_cast<size_t>(__builtin_ctzll(index_));
      for (size_t d = 0; d < kDimensions; ++d) point_[d] ^= directions()[d][changed % 32];
    }
    ++index_;
    dimension_ = 0;
  }

  double leading() {
    if (dimension_ >= kDimensions) return random_.uniform();
    const uint32_t bits = scrambled(point_[dimension_], scramble_[dimension_]);
    ++dimension_;
    // Random digits below the sequence's 32, which also keep it off 0.
    return (static_cast<double>(bits) + random_.uniform()) * 0x1p-32;
  }
  double random() { return random_.uniform(); }

 private:
  using Directions = std::array<std::array<uint32_t, 32>, kDimensions>;

  /// Joe & Kuo 2008, new-joe-kuo-6: degree, coefficients and first numbers of each dimension.
  static const Directions& directions() {
    static const Directions table = [] {
      struct Polynomial {
        uint32_t degree, coefficients, first[4];
      };
      constexpr Polynomial kPolynomials[kDimensions - 1] = {
          {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}, {4, 1, {1, 1, 3, 3}}};
      Directions v{};
      for (uint32_t i = 0; i < 32; ++i) v[0][i] = uint32_t{1} << (31 - i);
      for (size_t d = 1; d < kDimensions; ++d) {
        const Polynomial& p = kPolynomials[d - 1];
        for (uint32_t i = 0; i < p.degree; ++i) v[d][i] = p.first[i] << (31 - i);
        for (uint32_t i = p.degree; i < 32; ++i) {
          v[d][i] = v[d][i - p.degree] ^ (v[d][i - p.degree] >> p.degree);
          for (uint32_t k = 1; k < p.degree; ++k) {
            if ((p.coefficients >> (p.degree - 1 - k)) & 1) v[d][i] ^= v[d][i - k];
          }
        }
      }
      return v;
    }();
    return table;
  }

  static uint32_t reversed(uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0F0F0F0Fu) | ((x & 0x0F0F0F0Fu) << 4);
    return __builtin_bswap32(x);
  }
  /// Owen's nested scrambling by a hash that only lets low bits act on high ones, in reverse
  /// (Laine & Karras 2011, with the constants of Vegdahl 2021).
  static uint32_t scrambled(uint32_t x, uint32_t seed) {
    x = reversed(x);
    x ^= x * 0x3D20ADEAu;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526C56u;
    x ^= x * 0x53A22864u;
    return reversed(x);
  }

  Random random_;
  uint64_t index_ = 0;
  size_t dimension_ = 0;
  std::array<uint32_t, kDimensions> point_{};
  std::array<uint32_t, kDimensions> scramble_{};
};

}  // namespace alpenglow::reference
