#include "fuzz/answer/pair_answer.h"

#include <algorithm>
#include <cmath>

#include "core/math/roundoff.h"
#include "oracles/checker/checker.h"

namespace touchstone::fuzz {
namespace {

bool is_mesh(const Placed& p) { return touchstone::is_mesh(*p.shape); }

// Radius of the ball that the checker adds to the shape's core.
double ball_of(const Placed& p) {
  return std::visit(
      [](const auto& s) -> double {
        if constexpr (is_convex_shape<std::decay_t<decltype(s)>>) return s.ball_radius();
        return 0;
      },
      *p.shape);
}

Certificate direction_certificate(const referee::PairTruth& truth, const Placed& a, const Placed& b) {
  Certificate c;
  c.kind = Certificate::Kind::depth_direction;
  c.direction = truth.normal;
  c.offset = referee::width(a, b, truth.normal).hi;
  c.note = "gap >= -offset: moving B by `offset` along `direction` brings the bodies into contact at most";
  return c;
}

// Bodies that are apart: two points of the cores prove gap <= their distance - both radii, less what the
// checker allows for the rounding of the points; a half-space needs the point of the other body alone.
Certificate nearest_points_certificate(const referee::PairTruth& truth, const Placed& a, const Placed& b) {
  const double ball_a = ball_of(a), ball_b = ball_of(b);
  const Vec3 p = truth.witness[0] - ball_a * truth.normal, q = truth.witness[1] + ball_b * truth.normal;
  Certificate c;
  c.kind = Certificate::Kind::inner_polytope;
  c.support_pairs.push_back({p, q});
  const double largest = std::max(p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff());
  constexpr double allowances = 4;  // two for the points, two for the roundings of this sum and of the gap
  const double allowed = allowances * checker::point_factor * largest;
  const bool plane = is<HalfSpace>(a) || is<HalfSpace>(b);
  const double apart = plane ? truth.gap.hi : (q - p).stableNorm() - ball_a - ball_b;
  c.offset = -(apart + allowed);
  c.note = "gap <= -offset: one point of each core, less the radii of the balls around them";
  return c;
}

Certificate accepted(Certificate c, const Placed& a, const Placed& b) {
  return c.kind != Certificate::Kind::none && checker::check(c, a, b) ? c : Certificate{};
}

GapProof prove(const referee::PairTruth& truth, const Placed& a, const Placed& b) {
  GapProof r;
  r.gap = {-infinity, infinity};
  if (truth.verdict == referee::Verdict::undecided) return r;
  r.verdict = accepted(referee::checkable_certificate(truth, a, b), a, b);
  if (is_mesh(a) || is_mesh(b)) return r;
  if (truth.normal.allFinite() && !truth.normal.isZero(0))
    r.at_least = accepted(direction_certificate(truth, a, b), a, b);
  const bool apart = truth.verdict == referee::Verdict::disjoint;
  r.rounded = ball_of(a) > 0 || ball_of(b) > 0;
  r.at_most = accepted(
      apart ? nearest_points_certificate(truth, a, b) : referee::depth_certificate(truth, a, b), a, b);
  if (r.at_least.kind != Certificate::Kind::none) r.gap.lo = -r.at_least.offset;
  if (r.at_most.kind != Certificate::Kind::none) r.gap.hi = -r.at_most.offset;
  return r;
}

std::string missing_in(const GapProof& proof, const referee::PairTruth& truth, const Placed& a,
                       const Placed& b) {
  const auto has = [](const Certificate& c) { return c.kind != Certificate::Kind::none; };
  if (truth.verdict == referee::Verdict::undecided) return "the verdict is undecided";
  if (!has(proof.verdict)) return "the verdict has no certificate of a form that can be checked";
  const bool surface = is_mesh(a) || is_mesh(b);
  if (surface && truth.verdict == referee::Verdict::overlap) return "";
  if (surface) return "the distance of a mesh has no certificate, only the verdict";
  if (!has(proof.at_least)) return "the lower end of the gap has no certificate";
  if (!has(proof.at_most)) return "the upper end of the gap has no certificate";
  return "";
}

std::string missing_in(const ImpactCertificate& c, const referee::TimeTruth& truth) {
  using Verdict = referee::TimeTruth::Verdict;
  if (truth.verdict == Verdict::undecided) return "the verdict is undecided";
  const bool clear_needed = truth.verdict == Verdict::none || truth.t_lo > 0;
  if (clear_needed && c.tracks.empty()) return "that the bodies are apart before has no certificate";
  if (truth.verdict == Verdict::hit && !c.contact) return "the contact has no certificate";
  return "";
}

// The largest of the bodies' bounded extents and their distance.
double pair_scale(const Placed& a, const Placed& b) {
  const auto origin = [](const Placed& p) {
    return std::visit([](const auto& pose) -> Vec3 { return pose.translation; }, p.pose);
  };
  const auto reach = [](const Placed& p) { return is<HalfSpace>(p) ? 0 : 2 * bounding_radius(*p.shape); };
  return std::max({reach(a), reach(b), (origin(b) - origin(a)).stableNorm()});
}

// A flat shape has minima along a whole plane of directions, whose search takes minutes.
bool has_listed_normals(const Placed& p) {
  const ShapeKind k = kind_of(*p.shape);
  constexpr double flat = 0x1p-40;  // of the size
  const double inside = std::visit([](const auto& s) { return s.inner_radii().anywhere; }, *p.shape);
  if (inside <= flat * bounding_radius(*p.shape)) return false;
  return k == ShapeKind::sphere || k == ShapeKind::box || k == ShapeKind::capsule || k == ShapeKind::hull ||
         k == ShapeKind::rounded_box;
}

// Bodies apart have one normal. Of those that overlap, the listed ones are all; without a list, or where they
// form a continuum, the set holds one of them.
std::optional<referee::GradientSet> gradients_of(const PairAnswer& r, const Placed& a, const Placed& b) {
  const referee::PairTruth& t = r.truth;
  if (t.verdict == referee::Verdict::undecided || !t.normal.allFinite() || t.normal.isZero(0))
    return std::nullopt;
  const bool apart = t.verdict == referee::Verdict::disjoint;
  const bool listed = r.normals && r.normals->certified && !r.normals->capped && !r.normals->continuum;
  const double l = pair_scale(a, b);
  std::vector<Vec3> normals{t.normal};
  if (!apart && listed) {
    normals.clear();
    // Normals that are only nearly best belong to other gradients.
    for (std::size_t i = 0; i < r.normals->normals.size(); ++i)
      if (r.normals->widths[i] <= r.normals->widths[0] + referee::gradient_slack_factor * l)
        normals.push_back(r.normals->normals[i]);
  }
  referee::GradientSet set = referee::gradient_set(a, b, normals, apart || listed, l);
  if (set.corners.empty()) return std::nullopt;
  return set;
}

// GapProof::gap is infinite where there is no certificate.
bool shows(const GapProof& proof, const WithinAnswer& within) {
  if (within.verdict == referee::Verdict::overlap) return proof.gap.hi <= within.margin;
  return within.verdict == referee::Verdict::disjoint && proof.gap.lo > within.margin;
}

}  // namespace

PairAnswer answer_pair(const Placed& a, const Placed& b, const AnswerOptions& options) {
  PairAnswer r;
  r.truth = referee::with_witness(referee::judge_pair(a, b), a, b);
  if (options.normals && has_listed_normals(a) && has_listed_normals(b))
    r.normals = referee::near_minimal_normals(a, b);
  if (options.gradients) r.gradients = gradients_of(r, a, b);
  if (options.margin)
    r.within = WithinAnswer{*options.margin, referee::judge_within(a, b, *options.margin, r.truth), false};
  if (!options.certificates) return r;
  r.proof = prove(r.truth, a, b);
  r.not_certified = missing_in(*r.proof, r.truth, a, b);
  r.certified = r.not_certified.empty();
  if (r.within) r.within->certified = shows(*r.proof, *r.within);
  return r;
}

ImpactAnswer answer_motion(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                           const AnswerOptions& options) {
  ImpactAnswer r;
  r.truth = referee::judge_motion(a, motion_a, b, motion_b);
  if (!options.certificates) return r;
  ImpactCertificate c = referee::impact_certificate(a, motion_a, b, motion_b, r.truth);
  if (!c.claims_nothing() && !checker::check(c, a, motion_a, b, motion_b)) c = {};
  r.not_certified = missing_in(c, r.truth);
  r.certified = r.not_certified.empty();
  r.certificate = std::move(c);
  return r;
}

}  // namespace touchstone::fuzz
