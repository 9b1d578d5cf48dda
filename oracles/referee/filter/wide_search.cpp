#include "oracles/referee/filter/wide.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "oracles/checker/checker.h"
#include "oracles/referee/certificate.h"
#include "oracles/referee/counters.h"
#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/exact/exact_point.h"
#include "oracles/referee/filter/gjk.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

using WideSolid = BasicSolid<Wide>;

struct WidePart {
  WideSolid solid;
  std::vector<Rational3> exact_points;  // for a polytope: the points of which solid.points are roundings
};
using WideDifference = BasicDifference<Wide>;

Wide wide(const Rational& x) { return Wide(numerator(x)) / Wide(denominator(x)); }
Wide3 wide(const Rational3& v) { return {wide(v.x), wide(v.y), wide(v.z)}; }
Wide3 wide(const Real3& v) { return {Wide(v.x), Wide(v.y), Wide(v.z)}; }

WidePart of_points(const ExactBody& b) {
  WidePart s;
  s.solid.radius = b.radius;
  s.exact_points = world_points(b);
  Wide most = 0;
  for (const Rational3& v : s.exact_points) {
    s.solid.points.push_back(wide(v));
    most = std::max<Wide>(most, dot(s.solid.points.back(), s.solid.points.back()));
  }
  using std::sqrt;
  s.solid.extent = sqrt(most);
  return s;
}

WidePart of_curved(const Placed& p) {
  const Solid known = make_body(p, frame_of(p, Vec3::Zero()));
  WideSolid s;
  s.kind = static_cast<WideSolid::Kind>(known.kind);
  s.size = {Wide(known.size.x), Wide(known.size.y), Wide(known.size.z)};
  const Rational3 centre = world_point(p.pose, {0, 0, 0});
  s.centre = wide(centre);
  const Wide3 x = wide(world_point(p.pose, {1, 0, 0}) - centre),
              y = wide(world_point(p.pose, {0, 1, 0}) - centre),
              z = wide(world_point(p.pose, {0, 0, 1}) - centre);
  for (int i = 0; i < 3; ++i) s.matrix.row[i] = {x[i], y[i], z[i]};
  s.extent = Wide(known.extent);
  return {std::move(s), {}};
}

std::vector<WidePart> wide_parts_of(const Placed& p) {
  std::vector<WidePart> all;
  if (const auto* mesh = std::get_if<TriangleMesh>(p.shape)) {
    for (const auto& t : mesh->triangles) {
      std::vector<Vec3> core;
      for (const int k : t) core.push_back(mesh->vertices[static_cast<std::size_t>(k)]);
      all.push_back(of_points({core, 0, p.pose}));
    }
  } else if (const auto core = core_points(p)) {
    all.push_back(of_points({*core, core_form(p).radius, p.pose}));
  } else {
    all.push_back(of_curved(p));
  }
  return all;
}

constexpr std::size_t max_pairs_of_parts = 256;  // a pair takes a hundredth of a second

// Powers of two: the gap along a plane, in units of the extent, that is above rounding; the part of the
// distance by which a point is moved inward; the refinement of a gap, below what 64 bits can show.
constexpr int rounding_bits = -200, inward_bits = -120, gap_bits = -80;
// Bounds the error of core points, in units of the extent, with room to spare.
constexpr Real core_rounding = 0x1p-130L;
// Conversion to 64 bits, and a sum, relative to it.
constexpr Real conversion_rounding = 2 * unit;
// Distances, as powers of two of the extent, within which a simpler number is looked for.
constexpr int guess_bits[] = {-200, -100, -60, -40, -20, -10, -6};

std::size_t count_parts(const Placed& p) {
  const auto* mesh = std::get_if<TriangleMesh>(p.shape);
  return mesh ? mesh->triangles.size() : 1;
}

bool is_at_rest(const Operand& x) { return x.exact ? x.exact->times.size() == 1 : x.placed.shape != nullptr; }

WidePart part_of(const Operand& x) { return x.exact ? of_points(*x.exact) : wide_parts_of(x.placed).front(); }

Wide3 middle(const WideSolid& s) {
  if (s.kind != WideSolid::Kind::points) return s.centre;
  Wide3 sum;
  for (const Wide3& p : s.points) sum = sum + p;
  return (1 / Wide(s.points.size())) * sum;
}

// The plane across `direction` half-way between the two; kind none when they are not apart along it by more
// than rounding.
Certificate plane_between(const WideDifference& d, const Wide3& direction) {
  const Wide top = dot(direction, support(d.a, direction).point) + Wide(d.a.radius) * norm(direction);
  const Wide bottom = dot(direction, support(d.b, -direction).point) - Wide(d.b.radius) * norm(direction);
  Certificate c;
  if (!(bottom - top > ldexp(d.extent, rounding_bits))) return c;
  c.kind = Certificate::Kind::separating_plane;
  for (int i = 0; i < 3; ++i) c.rationals.push_back(text_of(exact_of(direction[i])));
  c.rationals.push_back(text_of(exact_of((top + bottom) / 2)));
  return c;
}

/// A plane of a certificate, and its numbers as the search uses them.
struct WidePlane {
  std::vector<std::string> texts;
  Wide3 direction;
  Wide offset;
};

WidePlane wide_plane(std::vector<std::string> texts) {
  const auto number = [&](std::size_t i) { return wide(rational_from_text(texts[i])); };
  const Wide3 direction{number(0), number(1), number(2)};
  const Wide offset = number(3);
  return {std::move(texts), direction, offset};
}

// Whether it keeps the two apart by more than rounding.
bool separates(const WidePlane& p, const WideDifference& d) {
  const Wide length = norm(p.direction), room = ldexp(d.extent, rounding_bits) * length;
  const Wide top = dot(p.direction, support(d.a, p.direction).point) + Wide(d.a.radius) * length;
  const Wide bottom = dot(p.direction, support(d.b, -p.direction).point) - Wide(d.b.radius) * length;
  return top + room < p.offset && p.offset + room < bottom;
}

// The point between the nearest points of the cores that divides them in the ratio of the radii.
Wide3 common_point(const WideDifference& d, const BasicSimplex<Wide>& s) {
  Wide3 a, b;
  for (int i = 0; i < s.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    a = a + s.weight[k] * s.vertex[k].a;
    b = b + s.weight[k] * s.vertex[k].b;
  }
  const Wide share = d.radius > 0 ? Wide(d.a.radius) / d.radius : Wide(1) / 2;
  return a + share * (b - a);
}

Rational simplest_near(const Rational& x, const Rational& e) { return simplest_between(x - e, x + e); }

Rational3 simplest_near(const Rational3& x, const Rational& e) {
  return {simplest_near(x.x, e), simplest_near(x.y, e), simplest_near(x.z, e)};
}

/// Where the two meet or nearly meet: as a point, and as weights of the vertices of polytope cores.
struct Meeting {
  Wide3 point;
  std::map<int, Wide> weights[2];
};

Meeting meeting(const WideDifference& d, const BasicSimplex<Wide>& s) {
  Meeting m{common_point(d, s), {}};
  for (int i = 0; i < s.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (const int v = s.vertex[k].ia; v >= 0) m.weights[0][v] += s.weight[k];
    if (const int v = s.vertex[k].ib; v >= 0) m.weights[1][v] += s.weight[k];
  }
  return m;
}

Meeting mean(const std::vector<Meeting>& all) {
  const Wide share = 1 / Wide(all.size());
  Meeting m;
  for (const Meeting& x : all) {
    m.point = m.point + share * x.point;
    for (int i = 0; i < 2; ++i)
      for (const auto& [v, w] : x.weights[i]) m.weights[i][v] += share * w;
  }
  return m;
}

// A point of a polytope with simple weights is exactly in the polytope, on the same face or edge.
std::optional<Rational3> with_simple_weights(const std::map<int, Wide>& weights, const WidePart& part,
                                             const Rational& e) {
  if (weights.empty() || part.exact_points.empty()) return std::nullopt;
  Rational3 sum{0, 0, 0};
  Rational all = 0;
  for (const auto& [v, w] : weights) {
    const Rational simple = simplest_near(exact_of(w), e);
    if (simple < 0) continue;
    all += simple;
    sum = sum + simple * part.exact_points[static_cast<std::size_t>(v)];
  }
  if (all == 0) return std::nullopt;
  return Rational(1) / all * sum;
}

// The overlap may be only 1e-17 thick and the point on the boundary of one body, so that rounding moves it
// outside; a step of 1e-36 towards that body's middle keeps it inside.
Certificate inside_both(const WideDifference& d, const Wide3& point, Holder& a, Holder& b) {
  for (const Wide3& to : {point, middle(d.a), middle(d.b)})
    if (Certificate c =
            common_point_certificate(exact_of(point + ldexp(Wide(1), inward_bits) * (to - point)));
        is_common_point(c, a, b))
      return c;
  return {};
}

// Bodies that touch by construction touch at fractions, or in a segment or an area that contains some: start
// from the middle of what several searches found, far from its border, and move to simpler numbers.
Certificate simple_point(const std::vector<Meeting>& found, const WidePart& x, const WidePart& y, Holder& a,
                         Holder& b) {
  const Wide extent = x.solid.extent + y.solid.extent;
  for (const int bits : guess_bits)
    for (const Meeting& m : {mean(found), found.front()}) {
      std::vector<Rational3> guesses{simplest_near(exact_of(m.point), exact_of(ldexp(extent, bits)))};
      for (int i = 0; i < 2; ++i)
        if (const auto p = with_simple_weights(m.weights[i], i == 0 ? x : y, exact_of(ldexp(Wide(1), bits))))
          guesses.push_back(*p);
      for (const Rational3& guess : guesses)
        if (Certificate c = common_point_certificate(guess); is_common_point(c, a, b)) return c;
    }
  return {};
}

/// Part i of A and part j of B, and the direction from one to the other in extended precision.
struct Likely {
  std::size_t i, j;
  Real gap;
  Real3 direction;
};

// A common point is in the parts that are nearest in extended precision, and the others need a plane only.
std::vector<Likely> nearest_first(const Placed& a, const Placed& b) {
  const std::vector<Operand> x = parts_of(a, Vec3::Zero()), y = parts_of(b, Vec3::Zero());
  const Counters before = counters();  // these parts have been counted
  std::vector<Likely> all;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j) {
      const ConvexTruth t = judge_convex(x[i], y[j], {}, Effort::verdict_only);
      all.push_back({i, j, t.lo, t.normal});
    }
  counters() = before;
  std::stable_sort(all.begin(), all.end(), [](const Likely& p, const Likely& q) { return p.gap < q.gap; });
  return all;
}

Wide3 start_direction(const WideDifference& d) {
  const Wide3 towards = normalized(middle(d.b) - middle(d.a));
  return largest(towards) > 0 ? towards : Wide3{1, 0, 0};
}

// On a segment or an area, the end of the search depends on the start direction.
std::vector<Wide3> start_directions(const WideDifference& d) {
  std::vector<Wide3> all{start_direction(d)};
  for (int i = 0; i < 8; ++i)
    all.push_back(normalized(
        all[0] + Wide3{Wide(i & 1 ? 1 : -1) / 2, Wide(i & 2 ? 1 : -1) / 3, Wide(i & 4 ? 1 : -1) / 5}));
  return all;
}

// For two convex parts, one of each body: a plane between them (not yet checked), or a point in both bodies.
// `likely`: the direction from one to the other that extended precision found.
Certificate search(const WideDifference& d, const WidePart& x, const WidePart& y, const Wide3& likely,
                   Holder& a, Holder& b) {
  if (largest(likely) > 0)
    if (Certificate c = plane_between(d, likely); c.kind != Certificate::Kind::none) return c;
  spend(10'000'000);
  std::vector<Meeting> found;
  for (const Wide3& n : start_directions(d)) {
    const auto g = gjk(d, std::span<const Wide3>(&n, 1), Wide(0));
    if (Certificate c = plane_between(d, g.gap.direction); c.kind != Certificate::Kind::none) return c;
    found.push_back(meeting(d, g.simplex));
    for (const Wide3& p : {found.back().point, mean(found).point})
      if (Certificate c = inside_both(d, p, a, b); c.kind != Certificate::Kind::none) return c;
  }
  return simple_point(found, x, y, a, b);
}

}  // namespace

Certificate search_wide(const Placed& a, const Placed& b) {
  if (std::holds_alternative<HalfSpace>(*a.shape) || std::holds_alternative<HalfSpace>(*b.shape)) return {};
  if (count_parts(a) * count_parts(b) > max_pairs_of_parts) return {};
  const std::vector<WidePart> x = wide_parts_of(a), y = wide_parts_of(b);
  Holder holds_a(a), holds_b(b);
  std::vector<WidePlane> planes;
  bool all_apart = true;
  for (const Likely& l : nearest_first(a, b)) {
    const WideDifference d(x[l.i].solid, y[l.j].solid);
    // The planes between the nearest parts usually serve for the others too.
    if (std::any_of(planes.begin(), planes.end(), [&](const WidePlane& p) { return separates(p, d); }))
      continue;
    Certificate c = search(d, x[l.i], y[l.j], wide(l.direction), holds_a, holds_b);
    if (c.kind == Certificate::Kind::common_point) return c;
    all_apart = all_apart && c.kind == Certificate::Kind::separating_plane;
    if (c.kind == Certificate::Kind::separating_plane) planes.push_back(wide_plane(std::move(c.rationals)));
  }
  if (!all_apart) return {};
  Certificate all;
  all.kind = Certificate::Kind::separating_plane;
  for (const WidePlane& p : planes) all.rationals.insert(all.rationals.end(), p.texts.begin(), p.texts.end());
  return checker::check(all, a, b) ? all : Certificate{};
}

// Core points are sums of a few products and one or two roots in 237-bit arithmetic: they are within 2^-220
// of the extent of the exact ones, which a single rounding to 64 bits covers many times over.
std::optional<WideGap> wide_gap(const Operand& a, const Operand& b) {
  if (!is_at_rest(a) || !is_at_rest(b)) return std::nullopt;
  const WidePart x = part_of(a), y = part_of(b);
  const WideDifference d(x.solid, y.solid);
  const Wide3 n = start_direction(d);
  const auto g = gjk(d, std::span<const Wide3>(&n, 1), ldexp(d.extent, gap_bits));
  const Real above = static_cast<Real>(norm(g.simplex.nearest));
  const Wide3& u = g.gap.direction;
  return WideGap{{static_cast<Real>(u.x), static_cast<Real>(u.y), static_cast<Real>(u.z)},
                 above + conversion_rounding * (above + static_cast<Real>(d.extent) * core_rounding)};
}

}  // namespace touchstone::referee
