// Contact: the verdict, then normal and depth by feasibility and regret (docs/truth.md §3).
//
// With w(n) = h_A(n) + h_B(-n), moving B by w(n) along n separates the bodies by a plane with the normal n.
// The direction is worse than the best by w(n) - d*. Any of several best normals passes; nothing else does. A
// depth d is excessive by d - w(n) (pushing by d leaves a gap, §5). Normal and depth are each right within τ,
// so beside a normal that is, d is infeasible by d* - d. Beside a poor one it is so by what is left of the
// overlap after moving by d along n: at most w(n) - d, because a plane with another normal may separate the
// bodies sooner. For bodies that are apart by no more than τ, d* is 0.
#include <fmt/format.h>

#include <cmath>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

// The truth's direction is rounded, while the least depth is along the exact one: the certificate states the
// width along the rounded direction.
Certificate direction_certificate(const CheckInput& in, const StatedContact& c,
                                  const referee::PairTruth& truth) {
  Certificate r;
  r.kind = Certificate::Kind::depth_direction;
  r.direction = truth.normal;
  r.offset = in.truth.width(in.frame, c.a, c.b, truth.normal).hi;
  r.note = "moving B by `offset` along `direction` separates the bodies";
  return r;
}

// A surface has no depth (docs/truth.md §2), so the stated depth is not compared with one. It must still be a
// plausible depth: not negative, and no more than leaving the hull of the surface takes. A normal is judged
// where the surface is flat.
void judge_surface_contact(const CheckInput& in, CheckOutput& out, const StatedContact& c,
                           const referee::PairTruth& truth) {
  const double l = in.truth.scale(c.a, c.b), tau = in.tau(c.a, c.b, l);
  const Query q{in.query.question, c.a, c.b};
  if (c.depth && c.normal) {
    const double excess = *c.depth - std::max(0.0, in.truth.width(in.frame, c.a, c.b, *c.normal).hi);
    out.error(excess, l, tau);
    if (excess > tau)
      out.fault(Fault::depth_excess, excess, l, q,
                fmt::format("states depth {:.9g}, {:.6g} more than the hull of the surface needs along its "
                            "normal",
                            *c.depth, excess),
                truth.verdict_certificate);
  }
  if (c.depth) {
    const double most = truth.gap.lo > 0 ? tau + in.offset() : tau;
    out.error(-*c.depth, l, most);
    if (-*c.depth > most)
      out.fault(Fault::infeasible, -*c.depth, l, q,
                fmt::format("says overlap with depth {:.9g}; a depth is never negative", *c.depth),
                truth.verdict_certificate);
  }
  const bool is_normal_open = c.normal && !judge_inner_edges(in, out, c);
  if (c.depth || is_normal_open)
    out.not_judged(c.depth && is_normal_open ? "normal and depth" : c.depth ? "depth" : "normal", true);
}

// Bodies that are apart and that the engine's contact offset lets it report: their depth is minus the gap.
bool is_speculative(const CheckInput& in, const referee::PairTruth& truth) {
  return in.offset() > 0 && truth.gap.lo > 0;
}

// Bracket of the least depth d*.
referee::Bracket least_depth(const CheckInput& in, const referee::PairTruth& truth) {
  if (is_speculative(in, truth)) return {-truth.gap.hi, -truth.gap.lo};
  return {std::max(0.0, -truth.gap.hi), std::max(0.0, -truth.gap.lo)};
}

// Of bodies that are apart, whose depths are negative, the words speak of distances.
std::string words_on_depth(double depth, double least) {
  return least < 0 ? fmt::format("states a distance of {:.9g}; it is {:.9g}", -depth, -least)
                   : fmt::format("states depth {:.9g}; the least is {:.9g}", depth, least);
}
std::string words_on_normal(double width, double least) {
  return fmt::format("along the stated normal they are {:.9g} {}; the {} is {:.9g}", std::abs(width),
                     width < 0 ? "apart" : "deep", least < 0 ? "distance" : "least depth", std::abs(least));
}
std::string words_on_excess(double depth, double width) {
  return width < 0
             ? fmt::format("states a distance of {:.9g}; along its own normal it is {:.9g}", -depth, -width)
             : fmt::format("states depth {:.9g}; its own normal needs only {:.9g}", depth, width);
}

void judge_depth_alone(const CheckInput& in, CheckOutput& out, const StatedContact& c,
                       const referee::PairTruth& truth) {
  const double l = in.truth.scale(c.a, c.b), tau = in.tau(c.a, c.b, l), depth = *c.depth;
  const Query q{in.query.question, c.a, c.b};
  const referee::Bracket least = least_depth(in, truth);
  out.error(std::max(least.lo - depth, depth - least.hi), l, tau);
  if (least.lo - depth > tau)
    out.fault(Fault::infeasible, least.lo - depth, l, q, words_on_depth(depth, least.lo),
              truth.verdict_certificate);
  if (depth - least.hi > tau)
    out.fault(Fault::depth_excess, depth - least.hi, l, q, words_on_depth(depth, least.hi),
              direction_certificate(in, c, truth));
}

// The depth of a solid mesh that is not convex is known as a bracket. What lies inside it is not judged.
void note_open_depth(const CheckInput& in, CheckOutput& out, const StatedContact& c,
                     const referee::Bracket& w, const referee::Bracket& least, double most_regret) {
  if (!in.is_mesh(c.a) && !in.is_mesh(c.b)) return;
  const double tau = in.tau(c.a, c.b, in.truth.scale(c.a, c.b));
  const bool is_least = w.hi - least.lo <= most_regret;
  const bool is_depth = !c.depth || (w.hi - *c.depth <= tau && *c.depth - w.lo <= tau);
  if (!is_least || !is_depth) out.not_judged("a solid's depth within its bracket", true);
}

// A length that prints like 1 is told by its error.
std::string words_on_length(double length) {
  const std::string digits = fmt::format("{:.9g}", length);
  return digits == "1" ? fmt::format("the normal's length is {:.2g} off 1", std::abs(length - 1))
                       : "the normal has length " + digits;
}

struct Shortfall {
  double value = 0;
  bool is_of_plane = false;  // measured by the plane with the stated normal, whatever other plane separates
};

// By how much a stated depth falls short: beside a normal within τ of the best, of the least depth; beside a
// poor one, what is left of the overlap after the motion; else of what planes with that normal need.
Shortfall shortfall(const CheckInput& in, const StatedContact& c, const referee::Bracket& w,
                    const referee::Bracket& least, double tau, bool is_poor) {
  const double depth = *c.depth, rest = w.lo - depth;
  const auto is_plain = [&](int body) { return is_convex(kind_of(*in.truth.placed(in.frame, body).shape)); };
  if (rest <= tau || !is_plain(c.a) || !is_plain(c.b)) return {rest, depth < 0};
  if (w.lo - least.hi <= tau) return {least.lo - depth, depth < 0};
  if (is_poor && depth >= 0)
    return {-in.truth.pair_after(in.frame, c.a, c.b, depth * *c.normal).gap.hi, false};
  return {rest, true};
}

std::string words_on_shortfall(double depth, const Shortfall& s, const referee::Bracket& w) {
  if (s.is_of_plane && w.lo < 0)
    return fmt::format("states a distance of {:.9g}; along the stated normal they are {:.9g} apart", -depth,
                       -w.lo);
  if (s.is_of_plane)
    return fmt::format("states depth {:.9g}; a plane with the stated normal separates only after {:.9g}",
                       depth, w.lo);
  return fmt::format("moving by the stated depth {:.9g} along the stated normal leaves {:.6g} of overlap",
                     depth, s.value);
}

}  // namespace

double certain_depth(const CheckInput& in, int a, int b, const referee::PairTruth& truth) {
  if (std::isfinite(truth.gap.lo)) return std::max(0.0, -truth.gap.hi);
  return std::max({0.0, -truth.gap.hi, in.truth.depth_in_mesh(in.frame, a, b)});
}

bool judge_validity(const CheckInput& in, CheckOutput& out, const StatedContact& c) {
  const Query q{in.query.question, c.a, c.b};
  const double length = c.normal ? c.normal->stableNorm() : 1;
  const bool unit =
      std::abs(length - 1) <= in.card.tau_factor * pair_roundoff(in.card, in.truth.scene(), c.a, c.b);
  if (!unit) out.fault_always(Fault::normal_not_unit, std::abs(length - 1), q, words_on_length(length));
  const bool number = !c.depth || std::isfinite(*c.depth);
  if (!number) out.fault_always(Fault::no_number, 0, q, fmt::format("the depth is {}", *c.depth));
  return unit && number;
}

void judge_normal_and_depth(const CheckInput& in, CheckOutput& out, const StatedContact& c,
                            const referee::PairTruth& truth) {
  if (!c.normal && !c.depth) return;
  // Half-spaces that are not antiparallel have no depth either: no motion separates them.
  if (in.is_surface(c.a) || in.is_surface(c.b) || !std::isfinite(truth.gap.lo))
    return judge_surface_contact(in, out, c, truth);
  if (!c.normal) return judge_depth_alone(in, out, c, truth);
  const double l = in.truth.scale(c.a, c.b), tau = in.tau(c.a, c.b, l);
  const Query q{in.query.question, c.a, c.b};
  const referee::Bracket w = in.truth.width(in.frame, c.a, c.b, *c.normal), least = least_depth(in, truth);
  const double regret = w.lo - least.hi;
  const double most_regret = tau + in.bias(c.a, c.b) * std::max(0.0, least.lo);
  out.error(regret, l, most_regret);
  if (regret > most_regret)
    out.fault(Fault::not_minimal, regret, l, q, words_on_normal(w.lo, (least.lo + least.hi) / 2),
              direction_certificate(in, c, truth));
  note_open_depth(in, out, c, w, least, most_regret);
  if (!c.depth) return;
  const Shortfall infeasible = shortfall(in, c, w, least, tau, regret > most_regret);
  const double depth = *c.depth, excess = depth - (is_speculative(in, truth) ? w.hi : std::max(0.0, w.hi));
  out.error(std::max(infeasible.value, excess), l, tau);
  if (infeasible.value > tau)
    out.fault(Fault::infeasible, infeasible.value, l, q, words_on_shortfall(depth, infeasible, w),
              truth.verdict_certificate);
  if (excess > tau)
    out.fault(Fault::depth_excess, excess, l, q, words_on_excess(depth, w.hi),
              direction_certificate(in, c, truth));
}

namespace {

// The contact that the answer states, if there is one that can be measured. Bodies farther apart than τ and
// what may be reported beyond it have none: the verdict is a ghost.
std::optional<StatedContact> measurable(const CheckInput& in, CheckOutput& out) {
  if (!in.answer.overlap || !*in.answer.overlap) return std::nullopt;
  const StatedContact stated{in.query.a, in.query.b, in.answer.normal, in.answer.depth};
  if (!judge_validity(in, out, stated)) return std::nullopt;
  const referee::PairTruth& truth = in.truth.pair(in.frame, stated.a, stated.b);
  // The bodies may be apart: the received bodies must be judged for themselves.
  if (truth.verdict != referee::Verdict::overlap) out.frame_matters();
  const double most = in.tau(in.truth.scale(stated.a, stated.b)) + in.offset();
  if (truth.verdict == referee::Verdict::undecided || truth.gap.lo > most) return std::nullopt;
  return stated;
}

}  // namespace

void check_contact(const CheckInput& in, CheckOutput& out) {
  check_overlap(in, out);
  if (const auto stated = measurable(in, out))
    judge_normal_and_depth(in, out, *stated, in.truth.pair(in.frame, stated->a, stated->b));
}

// The verdict is that of `within`; the rest is a contact whose depth is minus the distance of bodies that are
// apart. A surface that is apart from a body has that depth too, but no support plane to judge a normal by.
void check_contact_within(const CheckInput& in, CheckOutput& out) {
  check_within(in, out);
  const auto stated = measurable(in, out);
  if (!stated) return;
  const referee::PairTruth& truth = in.truth.pair(in.frame, stated->a, stated->b);
  const bool has_planes = !in.is_surface(stated->a) && !in.is_surface(stated->b);
  if (has_planes || !is_speculative(in, truth)) return judge_normal_and_depth(in, out, *stated, truth);
  if (stated->depth) judge_depth_alone(in, out, *stated, truth);
  if (stated->normal) out.not_judged("the normal of a surface that is apart", true);
}

}  // namespace touchstone::fuzz
