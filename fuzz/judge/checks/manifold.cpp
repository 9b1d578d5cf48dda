// The points of a contact: each within the depth of both bodies and no deeper than they can be there, and
// what share of the true contact region they span (docs/truth.md §3).
#include <fmt/format.h>

#include <cmath>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

// Only charted, never a fault: a manifold for another of several best normals spans another region and is
// skipped.
void measure_coverage(const CheckInput& in, CheckOutput& out, const referee::PairTruth& truth) {
  constexpr double same_normal = 1 - 1e-6;  // cosine of 1.4e-3 rad
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  if (in.answer.normal && !(in.answer.normal->dot(truth.normal) >= same_normal)) return;
  const referee::ContactRegion& region = in.truth.contact_region(in.frame, a, b);
  std::vector<Vec3> points;
  for (const ManifoldPoint& p : in.answer.manifold) points.push_back(p.position);
  out.manifold_coverage = referee::covered_share(region, points, truth.normal);
  out.manifold_centred = referee::holds_centroid(region, points, truth.normal);
}

double positive_or_zero(double x) { return std::isfinite(x) ? std::max(0.0, x) : 0; }

// Where the line p + s·n is within `reach` of the body, and how far along n: proven bounds of the last such
// s. The distance to a convex body is convex along a line.
class LineThroughBody {
 public:
  LineThroughBody(const CheckInput& in, int body, const Vec3& p, const Vec3& n, double reach)
      : in_(in), body_(body), p_(p), n_(n), reach_(reach) {}

  bool is_near(double s) const { return at(s).lo <= reach_; }
  /// An upper bound of the last s in [-range, range]; nullopt when the line certainly misses the body.
  std::optional<double> last(double range) const {
    double lo = -range, hi = range;
    // Ternary search for the nearest point until one is within reach; then bisection for the end of those
    // within reach.
    while (!is_near((lo + hi) / 2)) {
      if (hi - lo <= reach_ / 4) return std::nullopt;
      const double third = (hi - lo) / 3;
      if (at(lo + third).lo <= at(hi - third).lo)
        hi -= third;
      else
        lo += third;
    }
    lo = (lo + hi) / 2;
    hi = range;
    if (is_near(hi)) return hi;
    while (hi - lo > reach_ / 4) (is_near((lo + hi) / 2) ? lo : hi) = (lo + hi) / 2;
    return hi;
  }

 private:
  referee::Bracket at(double s) const { return in_.truth.distance_to(in_.frame, body_, p_ + s * n_, reach_); }
  const CheckInput& in_;
  int body_;
  Vec3 p_, n_;
  double reach_;
};

// How much deeper than possible the point claims to be: on the line through it along the normal, A must reach
// that far ahead of B, or, for a negative depth, be no farther than that from it. Each body is taken within
// τ. Where the line misses a body no depth is possible. 0: possible.
double too_deep(const CheckInput& in, const ManifoldPoint& p, const Vec3& n, double tau) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const LineThroughBody ahead(in, a, p.position, n, tau), behind(in, b, p.position, -n, tau);
  // Engines place points on B, on A or half-way.
  for (const double s : {p.depth / 2, 0.0, p.depth})
    if (ahead.is_near(s) && behind.is_near(p.depth - s)) return 0;
  const double depth = std::abs(p.depth), range = 4 * (depth + in.truth.scale(a, b));
  const auto last = ahead.last(range), first = behind.last(range);
  return !last || !first ? depth : std::max(0.0, p.depth - (*last + *first));
}

// The depth of each point must never exceed what its normal needs as a whole; for manifolds claimed to be
// complete, it must not exceed what the bodies can have there (other engines state depths along normals of
// their own).
void check_point_depths(const CheckInput& in, CheckOutput& out, double l, double tau,
                        const referee::PairTruth& truth) {
  const Vec3& n = *in.answer.normal;
  if (!(std::abs(n.stableNorm() - 1) < 0.5)) return;  // another fault
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  // Bodies within a margin have negative depths where they are apart.
  const bool within = in.query.question == Question::contact_within;
  const double width = in.truth.width(in.frame, a, b, n).hi, most = within ? width : std::max(0.0, width);
  const bool surface = in.is_mesh(a) || in.is_mesh(b) || !std::isfinite(truth.gap.lo);
  for (const ManifoldPoint& p : in.answer.manifold) {
    if (std::isnan(p.depth)) continue;  // not stated
    if (std::isinf(p.depth))
      return out.fault_always(Fault::no_number, 0, in.query, "the depth of a manifold point is infinite");
    const bool told_apart = in.card.complete_manifolds && !surface && in.answer.manifold.size() > 1;
    double error = p.depth - most;
    if (told_apart && error <= tau && (within || p.depth > tau))
      error = std::max(error, too_deep(in, p, n, tau));
    out.error(error, l, tau);
    if (error > tau)
      return out.fault(
          Fault::point_depth, error, l, in.query,
          fmt::format("a manifold point at ({:.6g} {:.6g} {:.6g}) says depth {:.9g}, {:.6g} more "
                      "than the bodies can have there along the normal",
                      p.position.x(), p.position.y(), p.position.z(), p.depth, error),
          truth.verdict_certificate);
  }
}

// For an engine whose card declares complete manifolds. The region covers what lies within a few roundings of
// the support planes across the stated normal, so a nearly parallel face that is left out for good reason is
// not part of it; a region that is nearly a segment or a point is not required. A region bounded by a rim is
// spanned by as many points as an engine cares to give, so only polytopes are checked.
void check_completeness(const CheckInput& in, CheckOutput& out, double l, const referee::PairTruth& truth) {
  // Slack in units of L; least width in units of L; least share of the region's area.
  constexpr double parallel = 0x1p-52, least_width = 1e-6, least_covered = 0.9;
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  if (in.has_rim(a) || in.has_rim(b)) return;
  const Vec3& n = *in.answer.normal;
  const referee::ContactRegion region =
      referee::contact_region(in.truth.placed(in.frame, a), in.truth.placed(in.frame, b), n, parallel * l);
  if (region.kind != referee::ContactRegion::Kind::polygon) return;
  if (region.area < least_width * l * referee::spanned_length(region.vertices, n)) return;
  std::vector<Vec3> points;
  for (const ManifoldPoint& p : in.answer.manifold) points.push_back(p.position);
  const double share = referee::covered_share(region, points, n).value_or(1);
  if (share < least_covered)
    out.fault(Fault::incomplete, std::sqrt((1 - share) * region.area), l, in.query,
              fmt::format("{} points span {:.3g} of the contact region, whose area is {:.6g}", points.size(),
                          share, region.area),
              truth.verdict_certificate);
}

}  // namespace

void check_manifold(const CheckInput& in, CheckOutput& out) {
  if (!in.answer.overlap || !*in.answer.overlap || in.answer.manifold.empty()) return;
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  for (const ManifoldPoint& p : in.answer.manifold)
    if (!p.position.allFinite())
      return out.fault_always(Fault::point_off, 0, in.query, "a manifold point is not finite");
  const referee::PairTruth& truth = in.truth.pair(in.frame, a, b);
  const double l = in.truth.scale(a, b), tau = in.tau(l);
  if (truth.verdict == referee::Verdict::undecided || truth.gap.lo > tau + in.offset()) return;
  // Bodies are inflated by the depth that the engine states: a point of a contact plane lies within that
  // depth of both. One between bodies that are apart, which a contact offset allows, is within their gap.
  const double of_gap = in.offset() > 0 ? positive_or_zero(truth.gap.hi) : 0;
  const double of_contact = std::max(of_gap, positive_or_zero(in.answer.depth.value_or(0)));
  double worst = 0;
  for (const ManifoldPoint& p : in.answer.manifold) {
    const double apart = std::min(positive_or_zero(-p.depth), in.offset());
    const double inflate = std::max({of_contact, positive_or_zero(p.depth), apart});
    worst = std::max({worst, in.truth.distance_to(in.frame, a, p.position, tau + inflate).lo - inflate,
                      in.truth.distance_to(in.frame, b, p.position, tau + inflate).lo - inflate});
  }
  out.error(worst, l, tau);
  const bool within = in.query.question == Question::contact_within;
  const bool has_region =
      (within || truth.verdict == referee::Verdict::overlap) && std::isfinite(truth.gap.lo);
  if (has_region) measure_coverage(in, out, truth);
  if (worst > tau)
    out.fault(Fault::point_off, worst, l, in.query,
              fmt::format("a manifold point is {:.6g} outside a body inflated by the stated depth", worst),
              truth.verdict_certificate);
  if (!in.answer.normal) return out.not_judged("depths of points without a normal", false);
  if (worst <= tau) check_point_depths(in, out, l, tau, truth);
  if (has_region && in.card.complete_manifolds && out.faults.empty()) check_completeness(in, out, l, truth);
}

}  // namespace touchstone::fuzz
