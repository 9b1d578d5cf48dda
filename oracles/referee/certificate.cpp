#include "oracles/referee/certificate.h"

#include "oracles/checker/checker.h"
#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/filter/half_space.h"
#include "oracles/referee/filter/wide.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

std::vector<std::string> texts(const Rational3& v) { return {text_of(v.x), text_of(v.y), text_of(v.z)}; }

// Bounds of n·x over the bodies, in the filter's frame; false when they leave no gap.
bool gap_along(const Difference& d, const Real3& n, Real& top_a, Real& bottom_b) {
  const Real length = norm(n) * (1 + value_rounding);
  const Real slack = dot_rounding * (d.extent + d.radius);
  top_a = dot(n, support(d.a, n).point) + length * (d.a.error + d.a.radius + slack);
  bottom_b = dot(n, support(d.b, -n).point) - length * (d.b.error + d.b.radius + slack);
  return top_a < bottom_b;
}

}  // namespace

Certificate plane_certificate(const Difference& d, const Real3& direction, const Vec3& origin) {
  Certificate c;
  c.kind = Certificate::Kind::separating_plane;
  c.direction = to_double(normalized(direction));
  const Real3 n = to_real(c.direction), o = to_real(origin);
  Real top = 0, bottom = 0;
  const Real shift = dot(n, o), shift_error = dot_rounding * norm(n) * norm(o);
  if (gap_along(d, n, top, bottom)) {
    const Real from = top + shift, to = bottom + shift, middle = 0.5L * (from + to);
    const Real slack = shift_error + value_rounding * (std::fabs(from) + std::fabs(to));
    c.offset = static_cast<double>(middle);
    if (from + slack <= static_cast<Real>(c.offset) && static_cast<Real>(c.offset) < to - slack) return c;
  }
  // The gap is too narrow for doubles: take the direction in 64 bits, and the offset exact about `origin`.
  const Real3 fine = normalized(direction);
  if (!gap_along(d, fine, top, bottom)) {
    c.kind = Certificate::Kind::none;
    return c;
  }
  const Rational3 exact_fine = exact_of(fine);
  c.rationals = texts(exact_fine);
  c.rationals.push_back(text_of(exact_of(0.5L * top + 0.5L * bottom) + dot(exact_fine, exact(origin))));
  return c;
}

Certificate point_certificate(const Real3& point, const Vec3& origin) {
  Certificate c;
  c.kind = Certificate::Kind::common_point;
  c.point = to_double(point + to_real(origin));
  return c;
}

Certificate common_point_certificate(const Rational3& point) {
  Certificate c;
  c.kind = Certificate::Kind::common_point;
  c.rationals = texts(point);
  c.point = {point.x.convert_to<double>(), point.y.convert_to<double>(), point.z.convert_to<double>()};
  return c;
}

Certificate exact_certificate(const ExactPair& p, const ExactVerdict& v) {
  if (v.overlap) return common_point_certificate(common_point(p, v));
  Certificate c;
  const ExactPlane plane = separating_plane(p, v);
  c.kind = Certificate::Kind::separating_plane;
  // Any positive multiple is the same plane; scaled to a size near 1 it has readable doubles.
  Rational size = 0;
  for (int i = 0; i < 3; ++i) size = std::max(size, Rational(abs(plane.direction[i])));
  const Rational by = Rational(1) / size;
  const Rational3 n = by * plane.direction;
  c.rationals = texts(n);
  c.rationals.push_back(text_of(by * plane.offset));
  c.direction = {n.x.convert_to<double>(), n.y.convert_to<double>(), n.z.convert_to<double>()};
  c.offset = (by * plane.offset).convert_to<double>();
  return c;
}

namespace {

// Subtracts the cost of rounding the points to doubles: twice the checker's allowance for the points, and as
// much again for the facets that moved with them.
double proven_depth(const Certificate& c, Real depth) {
  double largest = 0;
  for (const auto& [p, q] : c.support_pairs)
    largest = std::max({largest, p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff()});
  return round_down(depth - 4 * static_cast<Real>(checker::point_factor) * static_cast<Real>(largest));
}

}  // namespace

Certificate inner_certificate(const InnerPolytope& p, const Vec3& origin, Real depth) {
  Certificate c;
  c.kind = Certificate::Kind::inner_polytope;
  const Real3 o = to_real(origin);
  for (const Vertex& v : p.vertices) c.support_pairs.push_back({to_double(v.a + o), to_double(v.b + o)});
  c.facets = p.facets;
  c.offset = proven_depth(c, depth);
  c.note =
      "depth >= offset: support points of the cores, rounded to doubles; the radii of the balls add to it";
  return c;
}

Certificate core_pair_certificate(const Real3& a, const Real3& b, const Vec3& origin, Real depth) {
  Certificate c;
  c.kind = Certificate::Kind::inner_polytope;
  const Real3 o = to_real(origin);
  c.support_pairs.push_back({to_double(a + o), to_double(b + o)});
  c.offset = proven_depth(c, depth);
  c.note =
      "depth >= offset: the radii minus the distance of two core points, or a point's depth in a half-space";
  return c;
}

Certificate lower_depth_certificate(const ConvexTruth& t, const Difference& d, const Vec3& origin) {
  if (t.inner) return inner_certificate(*t.inner, origin, std::min(t.inner_depth, -t.hi));
  const Real3 a = t.witness_a - static_cast<Real>(d.a.radius) * t.normal;
  const Real3 b = t.witness_b + static_cast<Real>(d.b.radius) * t.normal;
  return core_pair_certificate(a, b, origin, -t.hi);
}

namespace {

// The deepest (or nearest) core point of the body against the half-space: the point itself, or, when it is
// outside by over/|m| <= r, its foot on the plane, which is rational.
Certificate half_space_point(const Placed& h, const ExactBody& body) {
  const RationalPlane p = world_plane(h);
  Rational3 best;
  bool first = true;
  for (const Rational3& x : world_points(body))
    if (first || dot(p.normal, x) < dot(p.normal, best)) {
      best = x;
      first = false;
    }
  const Rational over = dot(p.normal, best) - p.offset;
  if (over > 0) best = best - (over / dot(p.normal, p.normal)) * p.normal;
  return common_point_certificate(best);
}

// The half-space's own plane when it is A. When it is B the plane must lie strictly inside the gap: it is
// moved away from the half-space by `inside` times the normal's length, 0 < inside < gap, halved until the
// other body is clear.
Certificate half_space_plane(const Placed& h, const Placed& a, const Placed& b, Rational inside) {
  const RationalPlane p = world_plane(h);
  Certificate c;
  c.kind = Certificate::Kind::separating_plane;
  if (&h == &a) {
    c.rationals = texts(p.normal);
    c.rationals.push_back(text_of(p.offset));
    return c;
  }
  const Rational size =
      std::max(Rational(abs(p.normal.x)), std::max(Rational(abs(p.normal.y)), Rational(abs(p.normal.z))));
  constexpr unsigned most_halvings = 24;  // together a division by more than 2^50000
  for (unsigned k = 0;; ++k, inside /= Rational(shifted(Integer(1), 1 << std::min(k, 12U)))) {
    c.rationals = texts(Rational(-1) * p.normal);
    c.rationals.push_back(text_of(-p.offset - inside * size));
    if (checker::check(c, a, b)) return c;
    if (k > most_halvings) return {};
  }
}

}  // namespace

namespace {

// Parts of the way from the middle to the common point, besides a half.
constexpr double near_common = 0.9, nearer_common = 0.99;
// Parts of the way from a candidate point towards the middle of a body.
constexpr double inward_steps[] = {0.0, 0x1p-50, 0x1p-40, 0x1p-25, 0x1p-10, 0.25};

/// A point inside the body: for a hull the mean of its vertices, which may all be on one side of its origin.
Vec3 centre(const Placed& p) {
  const Solid b = make_body(p, frame_of(p, Vec3::Zero()));
  if (b.kind != Solid::Kind::points) return to_double(b.centre);
  Real3 sum;
  for (const Real3& x : b.points) sum = sum + x;
  return to_double((1.0L / static_cast<Real>(b.points.size())) * sum);
}

// Curved bodies have no exact nearest points; any point a little inside both will do. Candidates: the middle
// of the witness points, the common point, and these moved towards each other or towards either body's
// centre.
Certificate inner_point(const PairTruth& truth, const Placed& a, const Placed& b) {
  const Vec3 middle = truth.witness[0] + 0.5 * (truth.witness[1] - truth.witness[0]);
  const Vec3& common = truth.verdict_certificate.point;
  // The common point may lie on the boundary and the middle outside; a point between them is often inside.
  const auto towards_common = [&](double step) { return Vec3(middle + step * (common - middle)); };
  for (const Vec3& to : {centre(a), centre(b), Vec3(0.5 * centre(a) + 0.5 * centre(b))})
    for (const Vec3& from : {middle, truth.witness[0], truth.witness[1], common, towards_common(0.5),
                             towards_common(near_common), towards_common(nearer_common)})
      for (double step : inward_steps) {
        Certificate c;
        c.kind = Certificate::Kind::common_point;
        c.point = from + step * (to - from);
        if (checker::check(c, a, b)) return c;
      }
  return {};
}

// One plane for each triangle, or fewer when an earlier one can be reused.
Certificate mesh_planes(const Placed& a, const Placed& b) {
  const bool first = std::holds_alternative<TriangleMesh>(*a.shape);
  const auto& mesh = std::get<TriangleMesh>(*(first ? a : b).shape);
  const Operand other = make_operand(first ? b : a, Vec3::Zero());
  Certificate all;
  all.kind = Certificate::Kind::separating_plane;
  if (!other.has_exact()) return {};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Operand part = make_operand(first ? a : b, mesh, i, Vec3::Zero());
    const ExactPair p =
        first ? make_exact(*part.exact, other.exact_body()) : make_exact(other.exact_body(), *part.exact);
    const Certificate c = exact_certificate(p, decide(p, {}));
    if (c.kind != Certificate::Kind::separating_plane) return {};
    const auto known =
        std::search(all.rationals.begin(), all.rationals.end(), c.rationals.begin(), c.rationals.end());
    if (known == all.rationals.end())
      all.rationals.insert(all.rationals.end(), c.rationals.begin(), c.rationals.end());
  }
  return all;
}

std::optional<ExactBody> exact_body(const Placed& p) {
  auto core = core_points(p);
  if (!core) return std::nullopt;
  return ExactBody{std::move(*core), core_form(p).radius, p.pose};
}

Certificate exact_form(const PairTruth& truth, const Placed& a, const Placed& b) {
  const bool plane_a = is<HalfSpace>(a), plane_b = is<HalfSpace>(b);
  const bool overlap = truth.verdict == Verdict::overlap;
  if (plane_a && plane_b) return {};
  if (is<TriangleMesh>(a) || is<TriangleMesh>(b)) {
    const bool both = is<TriangleMesh>(a) && is<TriangleMesh>(b);
    return overlap || both || plane_a || plane_b ? Certificate{} : mesh_planes(a, b);
  }
  if (plane_a || plane_b) {
    const Placed &h = plane_a ? a : b, &other = plane_a ? b : a;
    if (!overlap) return half_space_plane(h, a, b, exact(truth.gap.lo > 0 ? truth.gap.lo : truth.gap.hi) / 2);
    const auto body = exact_body(other);
    return body ? half_space_point(h, *body) : inner_point(truth, a, b);
  }
  const auto x = exact_body(a), y = exact_body(b);
  if (!x || !y) return overlap ? inner_point(truth, a, b) : Certificate{};
  const ExactPair p = make_exact(*x, *y);
  return exact_certificate(p, decide(p, {}));
}

}  // namespace

namespace {

Certificate first_valid_certificate(const PairTruth& truth, const Placed& a, const Placed& b);

// What holds of the hulls or the surfaces in place of solids need not hold of these: the checker decides.
Certificate certificate_of_solids(const PairTruth& truth, const Placed& a, const Placed& b) {
  const AsHulls hulls(a, b);
  const AsSurface x(hulls.a()), y(hulls.b());
  const Certificate c = first_valid_certificate(truth, *x, *y);
  if (c.kind != Certificate::Kind::none && checker::check(c, a, b)) return c;
  return {};
}

Certificate first_valid_certificate(const PairTruth& truth, const Placed& a, const Placed& b) {
  if (checker::check(truth.verdict_certificate, a, b)) return truth.verdict_certificate;
  if (has_solid(a, b)) return certificate_of_solids(truth, a, b);
  Certificate c = exact_form(truth, a, b);
  if (c.kind != Certificate::Kind::none) return c;
  c = search_wide(a, b);
  const auto expected = truth.verdict == Verdict::overlap ? Certificate::Kind::common_point
                                                          : Certificate::Kind::separating_plane;
  return c.kind == expected ? c : Certificate{};
}

}  // namespace

Certificate checkable_certificate(const PairTruth& truth, const Placed& a, const Placed& b) {
  if (truth.verdict == Verdict::undecided) return {};
  Certificate none;
  none.note = too_expensive;
  return within_limit(std::move(none), [&] { return first_valid_certificate(truth, a, b); });
}

}  // namespace touchstone::referee
