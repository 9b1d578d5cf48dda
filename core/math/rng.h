// Reproducible random numbers: xoshiro256++ (Blackman, Vigna 2019) seeded by splitmix64. The distributions
// are our own and use only +, *, comparison, sqrt and ldexp, so that a seed gives the same bytes with every
// libm and compiler.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/math/pose.h"

namespace touchstone {

/// Rejection sampling of a direction discards squared lengths below this: normalising them loses accuracy.
inline constexpr double least_squared_length = 0.01;

/// Distance of neighbouring values of Rng::uniform.
inline constexpr double uniform_step = 0x1p-53;

class Rng {
 public:
  explicit Rng(std::uint64_t seed) {
    for (auto& s : s_) s = splitmix(seed);
  }
  /// An independent stream: the same (seed, stream) gives the same numbers, whatever was drawn before.
  static Rng stream(std::uint64_t seed, std::uint64_t stream) {
    std::uint64_t a = seed, b = stream ^ 0x6a09e667f3bcc909ULL;
    return Rng(splitmix(a) ^ std::rotl(splitmix(b), 23));
  }
  std::uint64_t next() {
    const std::uint64_t result = std::rotl(s_[0] + s_[3], 23) + s_[0];
    const std::uint64_t t = s_[1] << 17;
    s_[2] ^= s_[0];
    s_[3] ^= s_[1];
    s_[1] ^= s_[2];
    s_[0] ^= s_[3];
    s_[2] ^= t;
    s_[3] = std::rotl(s_[3], 45);
    return result;
  }
  /// Uniform in [0,1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * uniform_step; }
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Uniform integer in [0,n), n > 0, by multiplication (bias < n/2^64).
  std::uint64_t below(std::uint64_t n) {
    __extension__ using u128 = unsigned __int128;
    return static_cast<std::uint64_t>((static_cast<u128>(next()) * n) >> 64);
  }
  bool chance(double p) { return uniform() < p; }
  /// 2^e times uniform [1,2), with e a uniform integer in [lo,hi]: log-uniform up to a factor of 1.5 in
  /// density.
  double binary_scale(int lo, int hi) {
    const int e = lo + static_cast<int>(below(static_cast<std::uint64_t>(hi - lo + 1)));
    return std::ldexp(1.0 + uniform(), e);
  }
  /// 1 or -1, equally likely.
  int sign() { return chance(0.5) ? 1 : -1; }
  /// A binary_scale of either sign.
  double signed_binary_scale(int lo, int hi) {
    const double size = binary_scale(lo, hi);
    return size * sign();
  }
  /// Uniform on the unit sphere, by rejection.
  Vec3 unit_vector() {
    for (;;) {
      const Vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};  // braces: evaluated left to right
      const double n = v.squaredNorm();
      if (n > least_squared_length && n <= 1) return v / std::sqrt(n);
    }
  }
  /// A unit vector times a length: the direction is drawn first, whatever the compiler's order of evaluation.
  Vec3 vector(double lo, double hi) {
    const Vec3 u = unit_vector();
    return u * uniform(lo, hi);
  }
  /// Uniform random rotation as a quaternion of length within rounding of 1, by rejection in the 4-ball.
  Quat rotation() {
    for (;;) {
      const Quat q{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      const double n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
      if (n < least_squared_length || n > 1) continue;
      const double s = 1 / std::sqrt(n);
      return {q.x * s, q.y * s, q.z * s, q.w * s};
    }
  }

 private:
  static std::uint64_t splitmix(std::uint64_t& x) {
    std::uint64_t z = (x += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::uint64_t s_[4];
};

}  // namespace touchstone
