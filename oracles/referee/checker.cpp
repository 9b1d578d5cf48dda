#include "oracles/referee/checker.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "core/tolerance.h"
#include "oracles/referee/checker_set.h"

namespace touchstone::referee {
namespace {

using namespace checker;

bool is_zero(const V& v) { return v.x == 0 && v.y == 0 && v.z == 0; }
V negated(const V& v) { return {-v.x, -v.y, -v.z}; }
bool is_half_space(const Set& s) { return s.kind == Set::Kind::half_space; }

Q rational(const std::string& s) {
  const bool plain = !s.empty() && s.find_first_not_of("-0123456789/") == std::string::npos &&
                     s.back() != '/' && s.find("/0") == std::string::npos;
  try {
    if (plain) return Q(s);
  } catch (const std::exception&) {
  }
  throw InputError("", "is not a rational number \"n/d\" (" + s + ")");
}

/// h(n) <= bound, or < bound.
bool is_below(const Set& s, const V& n, const Q& bound, bool strictly) {
  if (is_half_space(s)) {
    if (!is_zero(cross(s.normal, n)) || dot(s.normal, n) <= 0) return false;
    const Q top = s.offset * dot(n, n) / dot(s.normal, n);
    return strictly ? top < bound : top <= bound;
  }
  const auto values = support_values(s, n);
  return std::all_of(values.begin(), values.end(), [&](const Sum& h) {
    return is_at_most_zero(h + Sum{-bound, {}}, strictly);
  });
}

bool has_plane(const Certificate& c, const Set& a, const Set& b) {
  const auto separates = [&](const V& n, const Q& at) {
    return !is_zero(n) && is_below(a, n, at, false) && is_below(b, negated(n), -at, true);
  };
  if (c.rationals.empty()) return separates(exact_value(c.direction), Q(c.offset));
  for (std::size_t i = 0; i + 3 < c.rationals.size(); i += 4) {
    const auto r = [&](std::size_t k) { return rational(c.rationals[i + k]); };
    if (separates({r(0), r(1), r(2)}, r(3))) return true;
  }
  return false;
}

bool check_planes(const Certificate& c, const std::vector<Set>& a, const std::vector<Set>& b) {
  if (c.rationals.size() % 4 != 0) return false;
  for (const Set& s : a)
    for (const Set& t : b)
      if (!has_plane(c, s, t)) return false;
  return true;
}

bool check_point(const Certificate& c, const std::vector<Set>& a, const std::vector<Set>& b) {
  if (!c.rationals.empty() && c.rationals.size() != 3) return false;
  const V x = c.rationals.empty()
                  ? exact_value(c.point)
                  : V{rational(c.rationals[0]), rational(c.rationals[1]), rational(c.rationals[2])};
  const auto in = [&](const std::vector<Set>& sets) {
    return std::any_of(sets.begin(), sets.end(), [&](const Set& s) { return contains(s, x); });
  };
  return in(a) && in(b);
}

// h_A(n) + h_B(-n) <= d·|n|. For a half-space m·x <= o: the lowest m·x of the other, moved along n, is o or
// more.
bool check_direction(const V& n, const Q& d, const Set& a, const Set& b) {
  if (is_zero(n) || (is_half_space(a) && is_half_space(b))) return false;
  if (is_half_space(b)) return check_direction(negated(n), d, b, a);
  if (is_half_space(a)) {
    const Q nn = dot(n, n);
    for (const Sum& h : support_values(b, negated(a.normal)))
      if (!is_at_most_zero(h + Sum{a.offset, {{-d * dot(a.normal, n) / nn, nn}}}, false)) return false;
    return true;
  }
  for (const Sum& h : support_values(a, n))
    for (const Sum& k : support_values(b, negated(n)))
      if (!is_at_most_zero(h + k + Sum{0, {{-d, dot(n, n)}}}, false)) return false;
  return true;
}

// Every directed edge as often as its reverse.
bool is_closed(const std::vector<std::array<int, 3>>& facets) {
  std::vector<std::pair<int, int>> forward, backward;
  for (const auto& f : facets)
    for (std::size_t i = 0; i < 3; ++i) {
      forward.emplace_back(f[i], f[(i + 1) % 3]);
      backward.emplace_back(f[(i + 1) % 3], f[i]);
    }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return forward == backward;
}

using Triangle = std::array<V, 3>;

// How often the surface winds about the origin: signed crossings of a ray. Nothing when the ray meets an
// edge.
std::optional<int> winding(const std::vector<Triangle>& surface, const V& ray) {
  int sum = 0;
  for (const auto& [a, b, c] : surface) {
    const int side = dot(a, cross(b, c)).sign();
    const int u = dot(ray, cross(b, c)).sign() * side, v = dot(a, cross(ray, c)).sign() * side,
              w = dot(a, cross(b, ray)).sign() * side;
    if (side == 0 || u < 0 || v < 0 || w < 0) continue;
    if (u == 0 || v == 0 || w == 0) return std::nullopt;
    sum += side;
  }
  return sum;
}

bool encloses_origin(const std::vector<Triangle>& surface) {
  for (const auto& [a, b, c] : surface)
    if (const auto n = winding(surface, a + Q(2) * b + Q(4) * c)) return *n != 0;
  return false;
}

// All points of the triangle are at distance >= r: by its plane, or, where that is not enough, by its nearest
// point.
bool is_clear(const Triangle& t, const Q& r) {
  const V n = cross(t[1] - t[0], t[2] - t[0]);
  const Q reach = dot(n, t[0]);
  if (reach != 0 && reach * reach >= r * r * dot(n, n)) return true;
  const V v = nearest_to_origin({t[0], t[1], t[2]});
  return dot(v, v) > 0 && dot(v, v) >= r * r;
}

using Pairs = std::vector<std::array<Vec3, 2>>;

Q allowance(const Pairs& pairs) {
  double largest = 0;
  for (const auto& [p, q] : pairs)
    largest = std::max({largest, p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff()});
  return Q(tolerance::checker_point_factor) * Q(largest);
}

// m·x - o <= -(depth - ball + e)·|m| for one point x within e of the body's core.
bool check_depth_in_half_space(const Certificate& c, const Set& half_space, const Set& body,
                               const Vec3& point) {
  if (c.support_pairs.size() != 1 || !c.facets.empty()) return false;
  const Q e = allowance(c.support_pairs), need = Q(c.offset) - body.ball + e;
  const V x = exact_value(point), &m = half_space.normal;
  if (!is_near_core(body, x, e)) return false;
  Sum s;
  s.rational = dot(m, x) - half_space.offset;
  s.roots.push_back({need, dot(m, m)});
  return is_at_most_zero(s, false);
}

// The surface of the facets holds a ball of this radius about the origin.
bool holds_ball(const std::vector<V>& vertices, const std::vector<std::array<int, 3>>& facets,
                const Q& radius) {
  std::vector<Triangle> surface;
  for (const auto& f : facets) {
    for (int k : f)
      if (k < 0 || k >= static_cast<int>(vertices.size())) return false;
    const auto at = [&](std::size_t i) { return vertices[static_cast<std::size_t>(f[i])]; };
    surface.push_back({at(0), at(1), at(2)});
    if (!is_clear(surface.back(), radius)) return false;
  }
  return is_closed(facets) && encloses_origin(surface);
}

// Points within e of the cores cost e each: the hull of the differences is within 2e of the difference of the
// cores.
bool check_inner(const Certificate& c, const Set& a, const Set& b) {
  if (c.support_pairs.empty() || (is_half_space(a) && is_half_space(b))) return false;
  if (is_half_space(a)) return check_depth_in_half_space(c, a, b, c.support_pairs[0][1]);
  if (is_half_space(b)) return check_depth_in_half_space(c, b, a, c.support_pairs[0][0]);
  const Q e = allowance(c.support_pairs), core_depth = Q(c.offset) - a.ball - b.ball + 2 * e;
  std::vector<V> difference;
  for (const auto& [p, q] : c.support_pairs) {
    const V x = exact_value(p), y = exact_value(q);
    if (!is_near_core(a, x, e) || !is_near_core(b, y, e)) return false;
    difference.push_back(x - y);
  }
  if (!c.facets.empty()) return holds_ball(difference, c.facets, core_depth > 0 ? core_depth : Q(0));
  return core_depth <= 0 && difference.size() == 1 &&
         dot(difference[0], difference[0]) <= core_depth * core_depth;
}

Certificate::Kind kind_named(const std::string& s) {
  using K = Certificate::Kind;
  constexpr std::pair<std::string_view, K> names[] = {{"none", K::none},
                                                      {"separating_plane", K::separating_plane},
                                                      {"common_point", K::common_point},
                                                      {"depth_direction", K::depth_direction},
                                                      {"inner_polytope", K::inner_polytope},
                                                      {"closed_form", K::closed_form}};
  for (const auto& [name, kind] : names)
    if (s == name) return kind;
  throw InputError("kind", "is not a kind of certificate (" + s + ")");
}

Vec3 vector_of(const nlohmann::ordered_json& j) {
  if (!j.is_array() || j.size() != 3) throw InputError("", "a vector of a certificate has three numbers");
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}

}  // namespace

bool check(const Certificate& c, const Placed& a, const Placed& b) {
  const std::vector<Set> x = sets_of(a), y = sets_of(b);
  if (x.empty() || y.empty()) return false;
  const bool finite = c.direction.allFinite() && std::isfinite(c.offset) && c.point.allFinite() &&
                      std::all_of(c.support_pairs.begin(), c.support_pairs.end(),
                                  [](const auto& p) { return p[0].allFinite() && p[1].allFinite(); });
  if (!finite) return false;
  using K = Certificate::Kind;
  if (c.kind == K::separating_plane) return check_planes(c, x, y);
  if (c.kind == K::common_point) return check_point(c, x, y);
  // A mesh is a surface without inside: it has no depth.
  const auto is_mesh = [](const Placed& p) { return std::holds_alternative<TriangleMesh>(*p.shape); };
  if (is_mesh(a) || is_mesh(b)) return false;
  if (c.kind == K::depth_direction) return check_direction(exact_value(c.direction), Q(c.offset), x[0], y[0]);
  return c.kind == K::inner_polytope && check_inner(c, x[0], y[0]);
}

Certificate certificate_from_json(const nlohmann::ordered_json& j) {
  try {
    Certificate c;
    c.kind = kind_named(j.at("kind").get<std::string>());
    using K = Certificate::Kind;
    const bool plane = c.kind == K::separating_plane, point = c.kind == K::common_point;
    if ((plane || point) && j.contains("rationals")) {
      c.rationals = j.at("rationals").get<std::vector<std::string>>();
      if (c.rationals.empty()) throw InputError("rationals", "is empty");
    } else if (point) {
      c.point = vector_of(j.at("point"));
    }
    if ((plane && c.rationals.empty()) || c.kind == K::depth_direction)
      c.direction = vector_of(j.at("direction"));
    const bool has_offset =
        (plane && c.rationals.empty()) || c.kind == K::depth_direction || c.kind == K::inner_polytope;
    if (has_offset) c.offset = j.at("offset").get<double>();
    if (c.kind == K::inner_polytope) {
      for (const auto& p : j.at("support_pairs"))
        c.support_pairs.push_back({vector_of(p.at(0)), vector_of(p.at(1))});
      c.facets = j.at("facets").get<std::vector<std::array<int, 3>>>();
    }
    return c;
  } catch (const nlohmann::json::exception& e) {
    throw InputError("certificate", std::string("cannot be read: ") + e.what());
  }
}

}  // namespace touchstone::referee
