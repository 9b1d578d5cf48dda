// The gradient of the signed distance by the pose of B (docs/truth.md §2, §3): `normal` and `moment`. A
// gradient is that of the gap of two parallel planes: the normal must be one of the best, which is judged by
// regret, and the line along it on which the moment says that the force acts must meet both bodies at their
// support planes.
//
// A normal within τ of the best may be off by an angle of √(τ/L), and what is measured across it by as much
// of a length: points on the line are allowed √(τL) besides τ. Such an error e is charted as what it costs in
// distance, e²/L.
#include <fmt/format.h>

#include <cmath>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

using Region = referee::ContactRegion;

Vec3 origin_of(const Placed& p) {
  return std::visit([](const auto& pose) -> Vec3 { return pose.translation; }, p.pose);
}

struct Stated {
  Vec3 normal, moment, origin;  // origin: of B's frame
  double l, tau;
  double across() const { return tau + std::sqrt(tau * l); }  // allowed for points
};

void report(const CheckInput& in, CheckOutput& out, double error, const Stated& s, double most,
            std::string words) {
  const bool is_across = most > s.tau && s.l > 0;
  out.error(is_across ? error * error / s.l : error, s.l, most);
  if (error > most) out.fault(Fault::gradient_off, error, s.l, in.query, std::move(words));
}

// How far from the body the point of the line is that its support plane across the normal cuts out.
double off_body(const CheckInput& in, int body, bool is_a, const Vec3& on_line, const Stated& s) {
  static const Shape point = Sphere{0};
  const Placed probe{&point, Pose{on_line, Quat{}}}, placed = in.truth.placed(in.frame, body);
  const referee::Bracket ahead =
      is_a ? referee::width(placed, probe, s.normal) : referee::width(probe, placed, s.normal);
  const double way = (ahead.lo + ahead.hi) / 2;
  if (!std::isfinite(way)) return std::numeric_limits<double>::infinity();
  return in.truth.distance_to(in.frame, body, on_line + (is_a ? way : -way) * s.normal, s.across()).lo;
}

void judge_solid(const CheckInput& in, CheckOutput& out, const Stated& s, const referee::PairTruth& truth) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const double regret = in.truth.width(in.frame, a, b, s.normal).lo + truth.gap.lo;
  report(in, out, regret, s, s.tau,
         fmt::format(
             "the gradient's derivative by translations is off: along it the bodies are {:.6g} less apart "
             "than they are",
             regret));
  const double along = std::abs(s.moment.dot(s.normal));
  report(in, out, along, s, s.across(),
         fmt::format("the gradient's derivative by a rotation about its own normal is {:.6g} instead of 0",
                     along));
  if (!out.faults.empty()) return;
  const Vec3 on_line = s.origin + s.normal.cross(s.moment);
  const double off = std::max(off_body(in, a, true, on_line, s), off_body(in, b, false, on_line, s));
  report(
      in, out, off, s, s.across(),
      fmt::format("the gradient's derivative by rotations is that of points {:.6g} outside the bodies", off));
}

// A mesh has no support plane at its nearest triangle, but the nearest points determine the gradient there.
void judge_surface(const CheckInput& in, CheckOutput& out, const Stated& s, const referee::PairTruth& truth) {
  if (truth.verdict != referee::Verdict::disjoint) return out.not_judged("the gradient at a surface", true);
  if (!in.answer.witness) return out.not_judged("a gradient at a surface without witness points", false);
  const auto& [p, q] = *in.answer.witness;
  const double direction = ((q - p) - truth.gap.hi * s.normal).norm();
  report(
      in, out, direction, s, s.across(),
      fmt::format("the gradient's derivative by translations is not along the nearest points, off by {:.6g}",
                  direction));
  const double moment = ((q - s.origin).cross(s.normal) - s.moment).norm();
  report(
      in, out, moment, s, s.across(),
      fmt::format("the gradient's derivative by rotations is {:.6g} off that of the nearest points", moment));
}

double smaller_extent(const CheckInput& in) {
  const Scene& s = in.truth.scene();
  const double a = extent(s.shape_of(in.query.a)), b = extent(s.shape_of(in.query.b));
  return a == 0 || !std::isfinite(a) ? b : b == 0 || !std::isfinite(b) ? a : std::min(a, b);
}

double length_of(const Region& r, const Vec3& normal) {
  if (r.kind == Region::Kind::segment) return r.length;
  return r.kind == Region::Kind::polygon ? referee::spanned_length(r.vertices, normal) : 0;
}

// "Unique" is wrong when the nearest points of polytopes within rounding of these certainly fill a line or a
// polygon. Other normals of the same depth are not looked for.
void judge_unique(const CheckInput& in, CheckOutput& out, const referee::PairTruth& truth, double l) {
  constexpr double parallel = 0x1p-51, least_length = 1e-6;  // of the smaller extent; of L
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const double slack = parallel * smaller_extent(in);
  if (in.has_rim(a) || in.has_rim(b) || !(slack > 0)) return;
  const double length = length_of(referee::contact_region(in.truth.placed(in.frame, a),
                                                          in.truth.placed(in.frame, b), truth.normal, slack),
                                  truth.normal);
  if (length > least_length * l)
    out.fault(Fault::gradient_off, length, l, in.query,
              fmt::format("says that the gradient is unique; the nearest points are as far apart as {:.6g}",
                          length));
}

// "Not unique" is wrong when bodies apart have features that meet in a point, whatever the slack from
// rounding to 1e-6 L: a feature shorter than a slack looks like a point, one that leans by more than it is
// none.
void judge_not_unique(const CheckInput& in, CheckOutput& out, const referee::PairTruth& truth, double l) {
  constexpr double same_direction = 1e-7, next = 1.0 / 1024;  // an angle; a factor between slacks
  constexpr double least_slack = 0x1p-51;                     // of the smaller extent
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const double least = least_slack * smaller_extent(in);
  if (!(truth.gap.lo > in.tau(l)) || !(least > 0)) return;
  const Vec3 way = truth.witness[1] - truth.witness[0];
  if (!(way.cross(truth.normal).norm() <= same_direction * way.norm())) return;
  for (double slack = referee::contact_slack_factor * l; slack > least; slack *= next)
    if (referee::contact_region(in.truth.placed(in.frame, a), in.truth.placed(in.frame, b), truth.normal,
                                slack)
            .kind != Region::Kind::point)
      return;
  out.fault(Fault::gradient_off, 0, l, in.query,
            "says that the gradient is not unique; the nearest points are one of each body");
}

}  // namespace

void check_gradient(const CheckInput& in, CheckOutput& out) {
  if (!in.answer.moment && !in.answer.unique_gradient) return;
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  out.frame_matters();
  const referee::PairTruth& truth = in.truth.pair(in.frame, a, b);
  const double l = in.truth.scale(a, b);
  const bool surface = in.is_mesh(a) || in.is_mesh(b);
  const bool known = truth.verdict != referee::Verdict::undecided && (surface || std::isfinite(truth.gap.lo));
  if (!known) {
    // Two half-spaces that overlap have no depth.
    if (truth.verdict == referee::Verdict::overlap)
      return out.not_judged("the gradient without a depth", true);
    out.undecided = true;
    return;
  }
  if (in.answer.unique_gradient && !surface)
    *in.answer.unique_gradient ? judge_unique(in, out, truth, l) : judge_not_unique(in, out, truth, l);
  if (!in.answer.moment) return;
  if (!in.answer.normal) return out.not_judged("a moment without a normal", false);
  const Stated s{*in.answer.normal, *in.answer.moment, origin_of(in.truth.placed(in.frame, b)), l, in.tau(l)};
  if (!s.normal.allFinite() || !s.moment.allFinite())
    return out.fault_always(Fault::no_number, 0, in.query, "the gradient is not finite");
  const double length = std::abs(s.normal.stableNorm() - 1);
  if (length > in.card.tau_factor * pair_roundoff(in.card, in.truth.scene(), a, b))
    return out.fault_always(Fault::gradient_off, length, in.query,
                            "the gradient's derivative by translations is not a unit vector");
  surface ? judge_surface(in, out, s, truth) : judge_solid(in, out, s, truth);
}

}  // namespace touchstone::fuzz
