// judge_within. Exact where both bodies are hulls of points rounded by balls, or half-spaces: with cores X, Y
// and a margin m, the gap is at most m if and only if the gap of the cores is at most c = rX + rY + m. For
// c >= 0 that is overlap of the cores with balls that add up to c. For c < 0 the cores must be as deep as |c|
// in each other: their depth is the least w(n)/|n| over the normals of the facets of X - Y, which are among
// the cross products of two edges (of one core or of both), and every other direction only gives more.
// Differences of any two points stand for the edges.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "oracles/checker/checker.h"
#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/filter/convex.h"
#include "oracles/referee/limits.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

Integer power_of_two(int exponent) { return shifted(Integer(1), exponent); }

// The pair in a unit in which the margin is an integer too: `balls` is rX + rY + margin.
struct Scaled {
  ExactPair pair;
  Integer balls;
};

Scaled scaled(ExactPair p, double margin) {
  const Parts m = parts_of(margin);
  const int finer = m.mantissa == 0 ? 0 : std::max(0, p.exponent - m.exponent);
  const Integer factor = power_of_two(finer);
  for (auto* points : {&p.a, &p.b})
    for (Integer3& x : *points) x = factor * x;
  p.radius_a *= factor;
  p.radius_b *= factor;
  p.exponent -= finer;
  Integer balls = p.radius_a + p.radius_b;
  if (m.mantissa != 0) balls += Integer(m.mantissa) * power_of_two(m.exponent - p.exponent) * p.denominator;
  return {std::move(p), std::move(balls)};
}

// Cores of more points, and pairs of more directions, are left undecided (counts).
constexpr std::size_t most_points = 32, most_directions = 300;

void add_direction(std::vector<Integer3>& to, const Integer3& d) {
  if (is_zero(d)) return;
  const auto parallel = [&](const Integer3& e) { return is_zero(cross(d, e)); };
  if (std::none_of(to.begin(), to.end(), parallel)) to.push_back(d);
}

// One of each direction between two points. nullopt: too many points.
std::optional<std::vector<Integer3>> directions_of(const std::vector<Integer3>& points) {
  if (points.size() > most_points) return std::nullopt;
  std::vector<Integer3> r;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) add_direction(r, points[i] - points[k]);
  return r;
}

// h_A(n) + h_B(-n), times |n|.
Integer width_along(const ExactPair& p, const Integer3& n) {
  Integer most = dot(n, p.a[0]), least = dot(n, p.b[0]);
  for (const Integer3& x : p.a) most = std::max(most, dot(n, x));
  for (const Integer3& x : p.b) least = std::min(least, dot(n, x));
  return most - least;
}

// Whether the cores, which overlap, are at least `depth` > 0 deep in each other.
std::optional<bool> are_as_deep(const ExactPair& p, const Integer& depth) {
  auto edges = directions_of(p.a);
  const auto others = directions_of(p.b);
  if (!edges || !others) return std::nullopt;
  edges->insert(edges->end(), others->begin(), others->end());
  if (edges->size() > most_directions) return std::nullopt;
  spend(static_cast<std::int64_t>(edges->size() * edges->size() * (p.a.size() + p.b.size())) * 100);
  bool any = false;
  for (std::size_t i = 0; i < edges->size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Integer3 n = cross((*edges)[i], (*edges)[k]);
      if (is_zero(n)) continue;
      any = true;
      const Integer limit = depth * depth * dot(n, n);
      for (const Integer3& direction : {n, Integer(-1) * n})
        if (const Integer w = width_along(p, direction); w * w < limit) return false;
    }
  return any;  // without a normal the difference is a segment or a point, and has no depth
}

// Of two bodies that are hulls of points with balls. nullopt: too expensive.
std::optional<bool> parts_within(const ExactBody& a, const ExactBody& b, double margin) {
  Scaled s = scaled(make_exact(a, b), margin);
  s.pair.radius_a = std::max(s.balls, Integer(0));
  s.pair.radius_b = 0;
  const bool meets = decide(s.pair, {}).overlap;
  if (!meets || s.balls >= 0) return meets;
  return are_as_deep(s.pair, -s.balls);
}

// value <= margin·√length_sq
bool is_at_most(const Rational& value, const Rational& margin, const Rational& length_sq) {
  const Rational v = value * value, m = margin * margin * length_sq;
  if (value > 0) return margin > 0 && v <= m;
  return margin >= 0 || v >= m;
}

// The gap of a half-space and a body is one support value, whatever its sign.
bool within_of_half_space(const RationalPlane& h, const ExactBody& body, double margin) {
  std::optional<Rational> least;
  for (const Rational3& x : world_points(body)) {
    const Rational d = dot(h.normal, x) - h.offset;
    if (!least || d < *least) least = d;
  }
  return is_at_most(*least, exact(margin) + exact(body.radius), dot(h.normal, h.normal));
}

Verdict verdict_of(bool within) { return within ? Verdict::overlap : Verdict::disjoint; }

// Whether any two parts are within the margin; a mesh has one for each triangle, other bodies one.
Verdict any_within(const Placed& a, const Placed& b, double margin) {
  const Vec3 origin = translation_of(a);
  const std::vector<Operand> x = parts_of(a, origin), y = parts_of(b, origin);
  bool open = false;
  for (const Operand& p : x)
    for (const Operand& q : y) {
      if (!p.has_exact() || !q.has_exact()) return Verdict::undecided;
      if (x.size() * y.size() > 1 && judge_convex(p, q).lo > margin) continue;
      const auto within = parts_within(p.exact_body(), q.exact_body(), margin);
      if (within && *within) return Verdict::overlap;
      open |= !within;
    }
  return open ? Verdict::undecided : Verdict::disjoint;
}

Verdict half_space_within(const Placed& h, const Placed& other, double margin) {
  const RationalPlane plane = world_plane(h);
  if (is_zero(plane.normal)) return Verdict::undecided;
  if (is<HalfSpace>(other)) {
    const RationalPlane second = world_plane(other);
    if (is_zero(second.normal)) return Verdict::undecided;
    const std::optional<Rational> between = distance_of_half_spaces(plane, second);
    return verdict_of(!between || is_at_most(*between, exact(margin), dot(plane.normal, plane.normal)));
  }
  for (const Operand& part : parts_of(other, translation_of(other))) {
    if (!part.has_exact()) return Verdict::undecided;
    if (within_of_half_space(plane, part.exact_body(), margin)) return Verdict::overlap;
  }
  return Verdict::disjoint;
}

// Curved bodies: two points with simple coordinates, one of each body, that are near enough. Only `within`
// can be shown in this way.
bool contains(const Placed& body, const Rational3& point) {
  Certificate c;
  c.kind = Certificate::Kind::common_point;
  for (const Rational* x : {&point.x, &point.y, &point.z}) {
    c.rationals.push_back(text_of(*x));
    c.point[static_cast<Eigen::Index>(c.rationals.size()) - 1] = x->convert_to<double>();
  }
  return static_cast<bool>(checker::check(c, body, body));
}

Rational3 simplest_near(const Vec3& point, double radius) {
  const Rational r = exact(radius);
  const auto simplest = [&](double x) { return simplest_between(exact(x) - r, exact(x) + r); };
  return {simplest(point.x()), simplest(point.y()), simplest(point.z())};
}

bool has_near_points(const Placed& a, const Placed& b, double margin, const PairTruth& truth) {
  double size = std::abs(margin);
  for (const Vec3& w : truth.witness) {
    if (!w.allFinite()) return false;
    size = std::max(size, w.cwiseAbs().maxCoeff());
  }
  const Rational limit = exact(margin) * exact(margin);
  return std::any_of(std::begin(limits::guess_factors), std::end(limits::guess_factors), [&](double factor) {
    const Rational3 p = simplest_near(truth.witness[0], factor * size),
                    q = simplest_near(truth.witness[1], factor * size);
    return dot(q - p, q - p) <= limit && contains(a, p) && contains(b, q);
  });
}

Verdict decide_within(const Placed& a, const Placed& b, double margin, const PairTruth& truth) {
  if (truth.gap.lo > margin) return Verdict::disjoint;
  if (truth.gap.hi <= margin) return Verdict::overlap;
  if (margin == 0) return truth.verdict;
  // An overlapping mesh has no depth to compare with the margin.
  if (margin < 0 && (is<TriangleMesh>(a) || is<TriangleMesh>(b)))
    return truth.verdict == Verdict::disjoint ? Verdict::disjoint : Verdict::undecided;
  Verdict v = is<HalfSpace>(a)   ? half_space_within(a, b, margin)
              : is<HalfSpace>(b) ? half_space_within(b, a, margin)
                                 : any_within(a, b, margin);
  if (v == Verdict::undecided && margin > 0 && !is<HalfSpace>(a) && !is<HalfSpace>(b) &&
      !is<TriangleMesh>(a) && !is<TriangleMesh>(b) && has_near_points(a, b, margin, truth))
    v = verdict_of(true);
  return v;
}

}  // namespace

namespace {

// Apart or inside is known from `truth`; of bodies apart, the surfaces decide.
Verdict decide_within_of_solids(const Placed& a, const Placed& b, double margin, const PairTruth& truth) {
  if (truth.gap.lo > margin) return Verdict::disjoint;
  if (truth.gap.hi <= margin) return Verdict::overlap;
  const AsHulls hulls(a, b);
  if (hulls.are_plain()) return decide_within(hulls.a(), hulls.b(), margin, truth);
  if (margin == 0) return truth.verdict;
  if (truth.verdict != Verdict::disjoint) return Verdict::undecided;
  const AsSurface x(hulls.a()), y(hulls.b());
  return decide_within(*x, *y, margin, truth);
}

}  // namespace

Verdict judge_within(const Placed& a, const Placed& b, double margin, const PairTruth& truth) {
  return within_limit(Verdict::undecided, [&] {
    return has_solid(a, b) ? decide_within_of_solids(a, b, margin, truth)
                           : decide_within(a, b, margin, truth);
  });
}

}  // namespace touchstone::referee
