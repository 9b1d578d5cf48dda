#include "oracles/referee/certificate.h"

#include <nlohmann/json.hpp>

#include "oracles/referee/checker.h"
#include "oracles/referee/half_space.h"
#include "oracles/referee/world.h"

namespace touchstone::referee {
namespace {

std::string_view name_of(Certificate::Kind k) {
  switch (k) {
    case Certificate::Kind::none:
      return "none";
    case Certificate::Kind::separating_plane:
      return "separating_plane";
    case Certificate::Kind::common_point:
      return "common_point";
    case Certificate::Kind::depth_direction:
      return "depth_direction";
    case Certificate::Kind::inner_polytope:
      return "inner_polytope";
    case Certificate::Kind::closed_form:
      return "closed_form";
  }
  return "none";
}

nlohmann::ordered_json list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::vector<std::string> texts(const Rational3& v) { return {text_of(v.x), text_of(v.y), text_of(v.z)}; }

Rational exact_of(Real x) {
  const auto high = static_cast<double>(x);
  const auto low = static_cast<double>(x - static_cast<Real>(high));  // 64 bits are at most two doubles
  return exact(high) + exact(low);
}

Rational3 exact_of(const Real3& v) { return {exact_of(v.x), exact_of(v.y), exact_of(v.z)}; }

// Bounds of n·x over the bodies in the filter's frame; false when they leave no gap.
bool gap_along(const Difference& d, const Real3& n, Real& top_a, Real& bottom_b) {
  const Real length = norm(n) * (1 + 4 * unit);
  const Real slack = 8 * unit * (d.extent + d.radius);
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
  const Real shift = dot(n, o), shift_error = 8 * unit * norm(n) * norm(o);
  if (gap_along(d, n, top, bottom)) {
    const Real from = top + shift, to = bottom + shift, middle = 0.5L * (from + to);
    const Real slack = shift_error + 4 * unit * (std::fabs(from) + std::fabs(to));
    c.offset = static_cast<double>(middle);
    if (from + slack <= static_cast<Real>(c.offset) && static_cast<Real>(c.offset) < to - slack) return c;
  }
  // The gap is too narrow for doubles here: the direction in 64 bits, and the offset exact about `origin`.
  const Real3 fine = normalized(direction);
  if (!gap_along(d, fine, top, bottom)) return c.kind = Certificate::Kind::none, c;
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

Certificate exact_certificate(const ExactPair& p, const ExactVerdict& v) {
  Certificate c;
  if (v.overlap) {
    const Rational3 x = common_point(p, v);
    c.kind = Certificate::Kind::common_point;
    c.rationals = texts(x);
    c.point = {x.x.convert_to<double>(), x.y.convert_to<double>(), x.z.convert_to<double>()};
    return c;
  }
  const ExactPlane plane = separating_plane(p, v);
  c.kind = Certificate::Kind::separating_plane;
  // Any positive multiple is the same plane; one of size near 1 has readable doubles.
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

Certificate inner_certificate(const InnerPolytope& p, const Vec3& origin) {
  Certificate c;
  c.kind = Certificate::Kind::inner_polytope;
  const Real3 o = to_real(origin);
  for (const Vertex& v : p.vertices) c.support_pairs.push_back({to_double(v.a + o), to_double(v.b + o)});
  c.facets = p.facets;
  c.note = "support points of the cores, rounded to doubles; the radii of the balls add to the depth";
  return c;
}

namespace {

// The deepest (or nearest) core point of the body against the half-space, moved by its radius: rational for
// hulls and for axis-aligned normals; for a ball the point a·|m| is irrational, so its square-root is
// replaced from below.
Certificate half_space_point(const Placed& h, const ExactBody& body) {
  const RationalPlane p = world_plane(h);
  Rational3 best;
  bool first = true;
  for (const Rational3& x : world_points(body))
    if (first || dot(p.normal, x) < dot(p.normal, best)) best = x, first = false;
  Certificate c;
  c.kind = Certificate::Kind::common_point;
  const Rational over = dot(p.normal, best) - p.offset;
  // Foot of the core point on the plane: at distance over/|m| <= r, rational.
  if (over > 0) best = best - (over / dot(p.normal, p.normal)) * p.normal;
  c.rationals = texts(best);
  c.point = {best.x.convert_to<double>(), best.y.convert_to<double>(), best.z.convert_to<double>()};
  return c;
}

// The half-space's own plane when it is A; when it is B the plane must lie strictly inside the gap: a
// fraction 2^-k of the core's distance away, for the first k that leaves the ball clear.
Certificate half_space_plane(const Placed& h, const Placed& a, const Placed& b, const ExactBody& body) {
  const RationalPlane p = world_plane(h);
  Certificate c;
  c.kind = Certificate::Kind::separating_plane;
  if (&h == &a) {
    c.rationals = texts(p.normal);
    c.rationals.push_back(text_of(p.offset));
    return c;
  }
  std::optional<Rational> least;
  for (const Rational3& x : world_points(body)) {
    const Rational d = dot(p.normal, x) - p.offset;
    if (!least || d < *least) least = d;
  }
  for (unsigned k = 1;; k *= 2) {
    c.rationals = texts(Rational(-1) * p.normal);
    c.rationals.push_back(
        text_of(-p.offset - *least * Rational(Integer(1), shifted(Integer(1), static_cast<int>(k)))));
    if (check(c, a, b) || k > (1U << 16)) return c;
  }
}

bool is_half_space(const Placed& p) { return std::holds_alternative<HalfSpace>(*p.shape); }

}  // namespace

Certificate checkable_certificate(const PairTruth& truth, const Placed& a, const Placed& b) {
  if (truth.verdict == Verdict::undecided) return {};
  if (check(truth.verdict_certificate, a, b)) return truth.verdict_certificate;
  const bool plane_a = is_half_space(a), plane_b = is_half_space(b);
  const auto body = [](const Placed& p) -> std::optional<ExactBody> {
    auto core = core_points(p);
    if (!core) return std::nullopt;
    return ExactBody{std::move(*core), core_radius(p), p.pose};
  };
  if (plane_a && plane_b) return {};
  if (plane_a || plane_b) {
    const auto other = body(plane_a ? b : a);
    if (!other) return {};
    if (truth.verdict == Verdict::overlap) return half_space_point(plane_a ? a : b, *other);
    return half_space_plane(plane_a ? a : b, a, b, *other);
  }
  const auto x = body(a), y = body(b);
  if (!x || !y) return {};
  const ExactPair p = make_exact(*x, *y);
  return exact_certificate(p, decide(p, {}));
}

nlohmann::ordered_json to_json(const Certificate& c) {
  nlohmann::ordered_json j;
  j["kind"] = name_of(c.kind);
  const bool plane = c.kind == Certificate::Kind::separating_plane;
  if (plane || c.kind == Certificate::Kind::depth_direction) j["direction"] = list(c.direction);
  if (plane) j["offset"] = c.offset;
  if (c.kind == Certificate::Kind::common_point) j["point"] = list(c.point);
  if (!c.rationals.empty()) j["rationals"] = c.rationals;
  if (!c.support_pairs.empty()) {
    j["support_pairs"] = nlohmann::ordered_json::array();
    for (const auto& [p, q] : c.support_pairs) j["support_pairs"].push_back({list(p), list(q)});
    j["facets"] = c.facets;
  }
  if (!c.note.empty()) j["note"] = c.note;
  return j;
}

}  // namespace touchstone::referee
