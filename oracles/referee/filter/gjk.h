// Nearest point of D = core(A) - core(B) to the origin, in the arithmetic T.
#pragma once

#include <array>
#include <span>

#include "oracles/referee/filter/minkowski.h"

namespace touchstone::referee {

template <class T>
struct BasicSimplex {
  std::array<BasicVertex<T>, 4> vertex;
  std::array<T, 4> weight{};  // >= 0, sum within 8 units of 1
  int size = 0;
  Triple<T> nearest;  // Σ weight·w
  /// Direction from the origin to the nearest point: the face normal for a triangle, else `nearest`.
  Triple<T> outward;
};
using Simplex = BasicSimplex<Real>;

template <class T>
struct BasicGjkResult {
  enum class Exit { converged, encloses_origin, touches, no_progress, iteration_cap };
  Exit exit = Exit::iteration_cap;
  BasicSimplex<T> simplex;
  BasicCoreGap<T> gap;
};
using GjkResult = BasicGjkResult<Real>;

/// Stops when the bracket is narrower than `target`. `hints`: first directions, A to B. `seed`: a simplex of
/// support points to start from, or nullptr; with a seed, the hints are not used. Instantiated for double,
/// Real and Wide (wide.h), as is `reduce`.
template <class T>
BasicGjkResult<T> gjk(const BasicDifference<T>& d, std::span<const Triple<T>> hints,
                      std::type_identity_t<T> target, const BasicSimplex<T>* seed = nullptr);

/// Reduces the simplex to the face that contains its nearest point to the origin; size 4 afterwards means
/// that it encloses the origin.
template <class T>
void reduce(BasicSimplex<T>& s);

}  // namespace touchstone::referee
