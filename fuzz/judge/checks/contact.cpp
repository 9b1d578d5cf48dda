// Contact: the verdict, then normal and depth by feasibility and regret (truth.md §3), then the manifold.
//
// With w(n) = h_A(n) + h_B(-n), moving B by w(n) along n separates the bodies and moving by less does not. So
// a depth d with normal n is infeasible by w(n) - d, in excess by d - w(n) (pushing by d leaves a gap, §5),
// and the direction is poor by w(n) - d*. Any of several best normals passes; nothing else does.
#include <fmt/format.h>

#include <cmath>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

// The truth's direction is rounded, and the least depth is along the exact one: what is certified is the
// width along the direction as it stands.
referee::Certificate direction_certificate(const CheckInput& in, int a, int b,
                                           const referee::PairTruth& truth) {
  referee::Certificate c;
  c.kind = referee::Certificate::Kind::depth_direction;
  c.direction = truth.normal;
  c.offset = in.truth.width(in.frame, a, b, truth.normal).hi;
  c.note = "moving B by `offset` along `direction` separates the bodies";
  return c;
}

}  // namespace

void judge_normal_and_depth(const CheckInput& in, CheckOutput& out, int a, int b,
                            const referee::PairTruth& truth, const Vec3& n, double depth) {
  const double l = in.truth.scale(a, b), tau = in.tau(l);
  const Query q{in.query.question, a, b};
  const double length = n.stableNorm();
  const double unit_error = std::abs(length - 1);
  if (!(unit_error <= in.card.tau_factor * in.card.unit_roundoff)) {
    out.fault_always(Fault::normal_not_unit, unit_error, q,
                     fmt::format("the normal has length {:.9g}", length));
    return;
  }
  if (!std::isfinite(depth)) {
    out.fault_always(Fault::no_number, 0, q, fmt::format("the depth is {}", depth));
    return;
  }
  const referee::Bracket w = in.truth.width(in.frame, a, b, n);
  const double infeasible = w.lo - depth, excess = depth - w.hi, regret = w.lo + truth.gap.lo;
  out.error(std::max({infeasible, excess, regret}), l, tau);
  const double d_star = -(truth.gap.lo + truth.gap.hi) / 2;
  if (infeasible > tau)
    out.fault(
        Fault::infeasible, infeasible, l, q,
        fmt::format("moving by the stated depth {:.9g} along the stated normal leaves {:.6g} of overlap",
                    depth, infeasible),
        truth.verdict_certificate);
  if (regret > tau)
    out.fault(Fault::not_minimal, regret, l, q,
              fmt::format("the stated normal needs {:.9g}; the least depth is {:.9g}", w.lo, d_star),
              direction_certificate(in, a, b, truth));
  if (excess > tau)
    out.fault(Fault::depth_excess, excess, l, q,
              fmt::format("states depth {:.9g}; its own normal needs only {:.9g}", depth, w.hi),
              direction_certificate(in, a, b, truth));
}

void check_contact(const CheckInput& in, CheckOutput& out) {
  check_overlap(in, out);
  if (!in.answer.overlap || !*in.answer.overlap) return;
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const referee::PairTruth& truth = in.truth.pair(in.frame, a, b);
  // A contact claimed where there is none, within τ: its depth is 0 within τ or the verdict is already a
  // ghost. Meshes have no depth in this definition. Both leave nothing to measure.
  if (truth.verdict != referee::Verdict::overlap) out.frame_matters();
  if (truth.verdict != referee::Verdict::overlap || !std::isfinite(truth.gap.lo)) return;
  if (!in.answer.normal || !in.answer.depth) return;
  judge_normal_and_depth(in, out, a, b, truth, *in.answer.normal, *in.answer.depth);
}

namespace {

// Charted, never a fault: a manifold for another of several best normals spans another region, and is left
// out.
std::optional<double> coverage(const CheckInput& in, const referee::PairTruth& truth) {
  constexpr double same_normal = 1 - 1e-6;
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  if (in.answer.normal && !(in.answer.normal->dot(truth.normal) >= same_normal)) return std::nullopt;
  const referee::ContactRegion& region = in.truth.contact_region(in.frame, a, b);
  std::vector<Vec3> points;
  for (const ManifoldPoint& p : in.answer.manifold) points.push_back(p.position);
  using K = referee::ContactRegion::Kind;
  if (region.kind == K::polygon) return referee::spanned_area(points, truth.normal) / region.area;
  if (region.kind == K::segment) return referee::spanned_length(points, truth.normal) / region.length;
  return std::nullopt;
}

}  // namespace

void check_manifold(const CheckInput& in, CheckOutput& out) {
  if (!in.answer.overlap || !*in.answer.overlap || in.answer.manifold.empty()) return;
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const referee::PairTruth& truth = in.truth.pair(in.frame, a, b);
  if (truth.verdict != referee::Verdict::overlap || !std::isfinite(truth.gap.lo)) return;
  const double l = in.truth.scale(a, b), tau = in.tau(l);
  // Bodies are inflated by the depth that the engine states: a point of a contact plane lies within it of
  // both.
  const double inflate =
      in.answer.depth && std::isfinite(*in.answer.depth) ? std::max(0.0, *in.answer.depth) : 0.0;
  double worst = 0;
  for (const ManifoldPoint& p : in.answer.manifold) {
    if (!p.position.allFinite()) {
      out.fault_always(Fault::point_off, 0, in.query, "a manifold point is not finite");
      return;
    }
    worst = std::max({worst, in.truth.distance_to(in.frame, a, p.position, tau + inflate).lo - inflate,
                      in.truth.distance_to(in.frame, b, p.position, tau + inflate).lo - inflate});
  }
  out.error(worst, l, tau);
  out.manifold_coverage = coverage(in, truth);
  if (worst > tau)
    out.fault(Fault::point_off, worst, l, in.query,
              fmt::format("a manifold point is {:.6g} outside a body inflated by the stated depth", worst),
              truth.verdict_certificate);
}

}  // namespace touchstone::fuzz
