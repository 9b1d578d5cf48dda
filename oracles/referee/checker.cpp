#include "oracles/referee/checker.h"

#include <algorithm>
#include <optional>

#include "oracles/referee/body.h"
#include "oracles/referee/world.h"

namespace touchstone::referee {
namespace {

struct RoundedHull {
  std::vector<Rational3> points;
  Rational radius;
};

std::optional<RoundedHull> rounded_hull(const Placed& p) {
  auto core = core_points(p);
  if (!core) return std::nullopt;
  const double radius = core_radius(p);
  return RoundedHull{world_points({std::move(*core), radius, p.pose}), exact(radius)};
}

/// Every point of the rounded hull has n·x <= offset (strictly: n·x < offset).
bool is_below(const RoundedHull& h, const Rational3& n, const Rational& offset, bool strictly) {
  return std::all_of(h.points.begin(), h.points.end(), [&](const Rational3& x) {
    const Rational room = offset - dot(n, x);  // needs room >= r|n|
    if (strictly && room <= 0) return false;
    if (room < 0) return false;
    const Rational room_sq = room * room, need_sq = h.radius * h.radius * dot(n, n);
    return strictly ? room_sq > need_sq : room_sq >= need_sq;
  });
}

bool is_half_space(const Placed& p) { return std::holds_alternative<HalfSpace>(*p.shape); }

bool half_space_below(const Placed& p, const Rational3& n, const Rational& offset, bool strictly) {
  const RationalPlane h = world_plane(p);
  if (is_zero(h.normal) || !is_zero(cross(h.normal, n)) || dot(h.normal, n) <= 0) return false;
  const Rational top = h.offset * dot(n, n) / dot(h.normal, n);
  return strictly ? top < offset : top <= offset;
}

bool below(const Placed& p, const Rational3& n, const Rational& offset, bool strictly) {
  if (is_half_space(p)) return half_space_below(p, n, offset, strictly);
  const auto h = rounded_hull(p);
  return h && is_below(*h, n, offset, strictly);
}

// Does the hull of the points come within r of the origin? Carathéodory: one of its simplexes of at most four
// points does; tried face by face until every point is on the far side of the nearest one found (Wolfe's
// criterion).
Rational3 nearest_to_origin(const std::vector<Rational3>& p);

bool contains(const Placed& body, const Rational3& x) {
  if (is_half_space(body)) {
    const RationalPlane h = world_plane(body);
    return !is_zero(h.normal) && dot(h.normal, x) <= h.offset;
  }
  const auto h = rounded_hull(body);
  if (!h) return false;
  std::vector<Rational3> about;
  for (const Rational3& p : h->points) about.push_back(p - x);
  const Rational3 v = nearest_to_origin(about);
  return dot(v, v) <= h->radius * h->radius;
}

/// The nearest point of the affine hull of 1 to 4 affinely independent points and its weights, by Gaussian
/// elimination on the normal equations G w = 1 (G the Gram matrix plus one): w is proportional to the
/// solution.
std::optional<std::vector<Rational>> affine_weights(const std::vector<Rational3>& p) {
  const std::size_t n = p.size();
  std::vector<std::vector<Rational>> m(n, std::vector<Rational>(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) m[i][j] = dot(p[i], p[j]) + 1;
    m[i][n] = 1;
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    while (pivot < n && m[pivot][k] == 0) ++pivot;
    if (pivot == n) return std::nullopt;
    std::swap(m[k], m[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k || m[i][k] == 0) continue;
      const Rational f = m[i][k] / m[k][k];
      for (std::size_t j = k; j <= n; ++j) m[i][j] = m[i][j] - f * m[k][j];
    }
  }
  std::vector<Rational> w(n);
  Rational sum = 0;
  for (std::size_t i = 0; i < n; ++i) w[i] = m[i][n] / m[i][i], sum += w[i];
  for (Rational& x : w) x = x / sum;
  return w;
}

Rational3 combine(const std::vector<Rational3>& p, const std::vector<Rational>& w) {
  Rational3 v{0, 0, 0};
  for (std::size_t i = 0; i < p.size(); ++i) v = v + w[i] * p[i];
  return v;
}

// Wolfe 1976 with his minor cycle: walk towards the affine nearest point until a weight hits 0, drop that
// point.
Rational3 nearest_to_origin(const std::vector<Rational3>& p) {
  std::vector<Rational3> face{p.front()};
  std::vector<Rational> weight{1};
  for (;;) {
    const Rational3 v = combine(face, weight);
    if (is_zero(v)) return v;
    const auto far = std::min_element(p.begin(), p.end(),
                                      [&](const auto& x, const auto& y) { return dot(v, x) < dot(v, y); });
    if (dot(v, *far) >= dot(v, v)) return v;
    face.push_back(*far), weight.emplace_back(0);
    for (;;) {
      const auto goal = affine_weights(face);
      if (!goal)
        throw std::logic_error(
            "checker: dependent face");  // Wolfe: the new point never lies in the affine hull
      Rational step = 1;
      for (std::size_t i = 0; i < face.size(); ++i)
        if ((*goal)[i] < 0) step = std::min(step, Rational(weight[i] / (weight[i] - (*goal)[i])));
      for (std::size_t i = 0; i < face.size(); ++i) weight[i] = weight[i] + step * ((*goal)[i] - weight[i]);
      const std::size_t before = face.size();
      for (std::size_t i = face.size(); i-- > 0;)
        if (weight[i] == 0) {
          face.erase(face.begin() + static_cast<std::ptrdiff_t>(i));
          weight.erase(weight.begin() + static_cast<std::ptrdiff_t>(i));
        }
      if (face.size() == before || step == 1) break;
    }
  }
}

Rational3 negated(const Rational3& n) { return {-n.x, -n.y, -n.z}; }

bool check_plane(const Rational3& n, const Rational& offset, const Placed& a, const Placed& b) {
  return !is_zero(n) && below(a, n, offset, false) && below(b, negated(n), -offset, true);
}

}  // namespace

bool check(const Certificate& c, const Placed& a, const Placed& b) {
  std::vector<Rational> r;
  for (const std::string& s : c.rationals) r.push_back(rational_from_text(s));
  if (c.kind == Certificate::Kind::separating_plane) {
    if (r.size() == 4) return check_plane({r[0], r[1], r[2]}, r[3], a, b);
    return r.empty() && check_plane(exact(c.direction), exact(c.offset), a, b);
  }
  if (c.kind != Certificate::Kind::common_point) return false;
  if (!r.empty() && r.size() != 3) return false;
  const Rational3 x = r.empty() ? exact(c.point) : Rational3{r[0], r[1], r[2]};
  return contains(a, x) && contains(b, x);
}

}  // namespace touchstone::referee
