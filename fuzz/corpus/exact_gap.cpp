#include "fuzz/corpus/truth.h"

#include <boost/multiprecision/integer.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/exact/rational.h"
#include "oracles/referee/filter/body.h"

namespace touchstone::fuzz::corpus {
namespace {

using referee::cross;
using referee::dot;
using referee::Integer;
using referee::Rational;
using referee::Rational3;
using Points = std::vector<Rational3>;

struct ExactCore {
  referee::ExactBody body;
  Points points;      // world
  Points directions;  // of all edges
  Points normals;     // of all faces, and of other planes through three vertices
};

Points differences(const Points& p) {
  Points all;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j) all.push_back(p[j] - p[i]);
  return all;
}

void add_crosses(const Points& a, const Points& b, Points& to) {
  for (const Rational3& x : a)
    for (const Rational3& y : b)
      if (const Rational3 n = cross(x, y); !is_zero(n)) to.push_back(n);
}

// A box's corners are numbered by bits: three edges at corner 0 stand for all.
Points edges_of(const Placed& p, const Points& corners) {
  if (referee::core_form(p).kind != referee::CoreForm::Kind::box) return differences(corners);
  Points edges;
  for (const std::size_t k : {1, 2, 4})
    if (const Rational3 e = corners[k] - corners[0]; !is_zero(e)) edges.push_back(e);
  return edges;
}

std::optional<ExactCore> core_of(const Placed& p) {
  const auto local = referee::core_points(p);
  constexpr std::size_t most_points = 12;  // the work grows with the fourth power
  if (!local || local->size() > most_points) return std::nullopt;
  ExactCore c{{*local, referee::core_form(p).radius, p.pose}, {}, {}, {}};
  c.points = referee::world_points(c.body);
  c.directions = edges_of(p, c.points);
  add_crosses(c.directions, c.directions, c.normals);
  return c;
}

Rational farthest(const Points& points, const Rational3& n) {
  Rational most = dot(points[0], n);
  for (const Rational3& p : points) most = std::max(most, dot(p, n));
  return most;
}

// The point of the affine hull nearest to the origin; empty if the points are not independent.
std::optional<Rational3> nearest_of_hull(const Points& s) {
  if (s.size() == 1) return s[0];
  const Rational3 e = s[1] - s[0];
  if (s.size() == 2) {
    const Rational ee = dot(e, e);
    if (ee == 0) return std::nullopt;
    return s[0] - Rational(dot(e, s[0]) / ee) * e;
  }
  if (s.size() > 3) return Rational3{};
  const Rational3 n = cross(e, s[2] - s[0]);
  const Rational nn = dot(n, n);
  if (nn == 0) return std::nullopt;
  return Rational(dot(n, s[0]) / nn) * n;
}

// The shortest vector from B's core to A's: proven, or empty if the cores meet.
std::optional<Rational3> separation(const ExactCore& a, const ExactCore& b) {
  const referee::ExactVerdict v = referee::nearest(referee::make_exact(a.body, b.body), {});
  Points simplex;
  for (const auto& [i, j] : v.simplex)
    simplex.push_back(a.points[static_cast<std::size_t>(i)] - b.points[static_cast<std::size_t>(j)]);
  if (simplex.empty()) return std::nullopt;
  const auto near = nearest_of_hull(simplex);
  if (!near || is_zero(*near)) return std::nullopt;
  const Rational least = -farthest(a.points, -*near) - farthest(b.points, *near);
  if (least < dot(*near, *near)) return std::nullopt;
  return near;
}

// Of cores that meet: the square of the least width over every direction that can be a face's normal. The
// width is negative for a direction that separates them, which then were not proven to be apart.
std::optional<Rational> square_of_depth(const ExactCore& a, const ExactCore& b) {
  Points normals = a.normals;
  normals.insert(normals.end(), b.normals.begin(), b.normals.end());
  add_crosses(a.directions, b.directions, normals);
  if (normals.empty()) return Rational(0);  // both lie on one line
  std::optional<Rational> least;
  for (const Rational3& unsigned_n : normals)
    for (const Rational3& n : {unsigned_n, -unsigned_n}) {
      const Rational w = farthest(a.points, n) + farthest(b.points, -n);
      if (w < 0) return std::nullopt;
      const Rational square = w * w / dot(n, n);
      if (!least || square < *least) least = square;
    }
  return least;
}

std::optional<Rational> root_of(const Rational& square) {
  const Integer n = numerator(square), d = denominator(square);
  const Integer rn = sqrt(n), rd = sqrt(d);
  if (rn * rn != n || rd * rd != d) return std::nullopt;
  return Rational(rn, rd);
}

// x <= sign * sqrt(square) - less.
bool is_at_most(const Rational& x, int sign, const Rational& square, const Rational& less) {
  const Rational y = x + less;
  if (sign > 0) return y <= 0 || y * y <= square;
  return y <= 0 && y * y >= square;
}
bool is_at_least(const Rational& x, int sign, const Rational& square, const Rational& less) {
  const Rational y = x + less;
  if (sign > 0) return y >= 0 && y * y >= square;
  return y >= 0 || y * y <= square;
}

}  // namespace

std::optional<ExactGap> exact_gap(const Placed& a, const Placed& b, const referee::Bracket& bracket) {
  const auto core_a = core_of(a), core_b = core_of(b);
  if (!core_a || !core_b || !std::isfinite(bracket.lo) || !std::isfinite(bracket.hi)) return std::nullopt;
  const Rational less = referee::exact(core_a->body.radius) + referee::exact(core_b->body.radius);
  std::optional<Rational> square;
  const auto apart = separation(*core_a, *core_b);
  const int sign = apart ? 1 : -1;
  if (apart)
    square = dot(*apart, *apart);
  else
    square = square_of_depth(*core_a, *core_b);
  if (!square) return std::nullopt;
  if (!is_at_most(referee::exact(bracket.lo), sign, *square, less) ||
      !is_at_least(referee::exact(bracket.hi), sign, *square, less))
    throw std::logic_error("the exact gap is outside the referee's bracket");
  ExactGap g{sign, referee::text_of(*square), referee::text_of(less), ""};
  if (const auto root = root_of(*square)) g.value = referee::text_of(sign * *root - less);
  constexpr std::size_t most_digits = 240;
  if (g.value.size() > most_digits) g.value.clear();
  if (g.value.empty() && g.square.size() + g.less.size() > most_digits) return std::nullopt;
  return g;
}

}  // namespace touchstone::fuzz::corpus
