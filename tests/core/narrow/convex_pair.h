// Pairs of convex bodies for tests of single building blocks, in the form that each of them takes.
#pragma once

#include "core/narrow/convex_core.h"
#include "core/narrow/filtered/difference.h"

namespace touchstone::test {

/// Two placed shapes, A at the origin.
struct ConvexPair {
  Shape a, b;
  Pose at_b, at_a;
};

inline ConvexPair pair_at(const Shape& a, const Shape& b, const Vec3& from_a, const Quat& turn = {}) {
  return {a, b, {from_a, turn}, {}};
}

/// The cores in extended precision, with the length that tolerances are relative to.
struct ExtendedPair {
  narrow::ConvexCore<Wide> a, b;
  Wide size;
  explicit ExtendedPair(const ConvexPair& p)
      : a(narrow::make_core(p.a, wide_frame(p.at_a))),
        b(narrow::make_core(p.b, wide_frame(p.at_b))),
        size(a.reach + b.reach + (b.frame.translation - a.frame.translation).norm()) {}
  /// As in the product (core/tolerance.h).
  Wide tolerance() const { return Wide(0x1p-52) * size; }
  Wide touching() const { return Wide(0x1p-54) * size; }
};

/// The same in double or float.
template <class R>
struct FilteredPair {
  ConvexBody<R> a, b;
  narrow::filtered::Relative<R> at;
  narrow::filtered::Difference<R> difference{a, b, at};
  R size;
  explicit FilteredPair(const ConvexPair& p)
      : a(convex_body<R>(p.a)),
        b(convex_body<R>(p.b)),
        at(narrow::filtered::relative(narrow::filtered::rounded_pose<R>(p.at_a),
                                      narrow::filtered::rounded_pose<R>(p.at_b))),
        size(a.reach + b.reach + at.offset.norm()) {}
  FilteredPair(const FilteredPair&) = delete;
  FilteredPair& operator=(const FilteredPair&) = delete;
};

}  // namespace touchstone::test
