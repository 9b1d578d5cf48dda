// Nearest point of D = core(A) - core(B) to the origin, in extended precision.
#pragma once

#include <array>
#include <span>

#include "oracles/referee/minkowski.h"

namespace touchstone::referee {

struct Simplex {
  std::array<Vertex, 4> vertex;
  std::array<Real, 4> weight{};  // >= 0, of sum within 8 units of 1
  int size = 0;
  Real3 nearest;  // Σ weight·w
  Real3
      outward;  // direction of least |.| seen from the origin: the face normal for a triangle, else `nearest`
};

struct GjkResult {
  enum class Exit { converged, encloses_origin, touches, no_progress, iteration_cap };
  Exit exit = Exit::iteration_cap;
  Simplex simplex;
  CoreGap gap;
};

/// Stops when the bracket is narrower than `target`. `hints`: first directions, A to B.
GjkResult gjk(const Difference& d, std::span<const Real3> hints, Real target);

/// Reduces the simplex to the face that holds its nearest point to the origin; size 4 afterwards: it encloses
/// it.
void reduce(Simplex& s);

}  // namespace touchstone::referee
