// Answers of the narrow phase. Unless stated otherwise, `error_bound` is proven by the query itself (duality
// gap of GJK and EPA plus rounding) and is in the scene's unit.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/outcome.h"
#include "core/math/wide.h"

namespace touchstone {

/// The signed separation of a pair in extended precision. The origin of the coordinates is A's translation.
struct Separation {
  Outcome outcome = Outcome::answered;
  Wide gap = 0;                                      // > 0: distance; <= 0: minus the depth
  WideVec normal = WideVec::UnitX();                 // unit, A to B
  WideVec a = WideVec::Zero(), b = WideVec::Zero();  // b − a = gap·normal
  /// Distance: |gap − truth|. Depth: `normal` is feasible for −gap within rounding, and −gap exceeds the
  /// least depth by at most `slack`, proven. Where the minima form a curve or surface (coaxial or concentric
  /// round bodies), −gap is a local minimum to within `local_slack`, and `slack` states how far it is proven
  /// to be global.
  Wide slack = 0, local_slack = 0;
  Wide size = 0;  // tolerances are relative to this length
};

struct OverlapAnswer {
  Outcome outcome = Outcome::answered;
  bool overlap = false;
  double error_bound = 0;  // of the gap that decided the verdict
};

struct DistanceAnswer {
  Outcome outcome = Outcome::answered;
  double distance = 0;  // signed
  Vec3 normal = Vec3::Zero();
  std::array<Vec3, 2> witness{Vec3::Zero(), Vec3::Zero()};  // on A, on B: b − a = distance·normal
  double error_bound = 0;
};

struct ContactPoint {
  Vec3 position;  // world; halfway between the two surfaces
  double depth;
  std::uint32_t feature;  // identifies the pair of features; 0 for a single point
};

/// Contact points stored in place, without allocation. Unused points are neither initialised nor copied.
class Manifold {
 public:
  static constexpr std::size_t capacity = 32;
  Manifold() {}
  Manifold(const Manifold& o) { *this = o; }
  Manifold& operator=(const Manifold& o) {
    size_ = o.size_;
    for (std::size_t i = 0; i < size_; ++i) points_[i] = o.points_[i];
    return *this;
  }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// Ignored once the manifold is full.
  void push_back(const ContactPoint& p) {
    if (size_ < capacity) points_[size_++] = p;
  }
  const ContactPoint& operator[](std::size_t i) const { return points_[i]; }
  const ContactPoint* begin() const { return points_.data(); }
  const ContactPoint* end() const { return points_.data() + size_; }

 private:
  std::size_t size_ = 0;
  std::array<ContactPoint, capacity> points_;
};

struct ContactAnswer {
  Outcome outcome = Outcome::answered;
  bool overlap = false;
  Vec3 normal = Vec3::Zero();  // unit, A to B; zero when there is no overlap
  double depth = 0;
  Manifold manifold;        // up to the full clipped polygon; see reduced()
  double error_bound = 0;   // of the depth along `normal` and of its local minimality
  double regret_bound = 0;  // proven: depth − least depth over all directions
};

}  // namespace touchstone
