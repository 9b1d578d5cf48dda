// Where a ray meets a body, judged like a time of impact: by gaps, and the normal there. The normal n is
// right if no point of A is farther along n than the point p where the ray is then: h_A(n) - n·p, in
// truth.md's terms the width w(n) of A and the point, is how far p would have to move along n to leave A.
#include <fmt/format.h>

#include <cmath>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

// Engines differ in what they report for a ray that starts inside: the start, nothing, or where it leaves.
// Only the start, which follows from the definition, is judged.
bool starts_inside(const CheckInput& in, double tau) {
  return in.truth.pair(in.frame, in.query.a, in.query.b).gap.lo <= tau;
}

void check_normal(const CheckInput& in, CheckOutput& out, double l, double tau) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const Vec3& n = *in.answer.normal;
  if (!judge_validity(in, out, {a, b, n, std::nullopt})) return;
  if (in.is_surface(a)) return out.not_judged("the normal of a surface", true);
  const referee::Bracket w = in.truth.width_at(in.frame, a, b, *in.answer.toi, n);
  // The point may be off by τ along the ray, and w by as much again.
  const double error = w.lo, allowed = 2 * tau;
  out.error(error, l, allowed);
  if (error > allowed)
    out.fault(
        Fault::not_minimal, error, l, in.query,
        fmt::format("the body extends by {:.6g} beyond the point of impact along the stated normal", error));
}

}  // namespace

void check_ray(const CheckInput& in, CheckOutput& out) {
  const double l = in.truth.scale(in.query.a, in.query.b), tau = in.tau(l);
  if (in.answer.overlap) check_overlap(in, out);
  if (starts_inside(in, tau)) {
    out.frame_matters();
    if (in.answer.toi != 0 && in.answer.overlap != true) out.not_judged("a ray that starts inside", true);
    return;
  }
  const std::size_t before = out.faults.size();
  check_time_of_impact(in, out);
  const bool is_placed = in.answer.toi && out.faults.size() == before;
  if (is_placed && in.answer.normal) check_normal(in, out, l, tau);
}

}  // namespace touchstone::fuzz
