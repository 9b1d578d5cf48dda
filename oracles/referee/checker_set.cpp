#include "oracles/referee/checker_set.h"

#include <algorithm>
#include <stdexcept>

namespace touchstone::referee::checker {
namespace {

using Z = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

// floor and ceiling of 2^bits·√s, over 2^bits: √(n/d) = √(n·d)/d.
std::pair<Q, Q> root_bounds(const Q& s, unsigned bits) {
  const Z n = numerator(s), d = denominator(s), shifted = (n * d) << (2 * bits);
  const Z r = sqrt(shifted), unit = d << bits;
  return {Q(r, unit), Q(r * r == shifted ? r : Z(r + 1), unit)};
}

// The same sum without rational roots, equal squares under one root.
Sum tidy(const Sum& s) {
  Sum t{s.rational, {}};
  for (const Sum::Root& r : s.roots) {
    const auto [lo, hi] = root_bounds(r.square, 0);
    if (lo == hi) {
      t.rational += r.factor * lo;
      continue;
    }
    auto same =
        std::find_if(t.roots.begin(), t.roots.end(), [&](const auto& o) { return o.square == r.square; });
    if (same == t.roots.end())
      t.roots.push_back(r);
    else
      same->factor += r.factor;
  }
  std::erase_if(t.roots, [](const auto& r) { return r.factor == 0; });
  return t;
}

V apply(const Set& s, const V& x) {
  return x.x * s.column[0] + x.y * s.column[1] + x.z * s.column[2] + s.centre;
}

void place(Set& s, const Pose& p) {
  const Q x(p.rotation.x), y(p.rotation.y), z(p.rotation.z), w(p.rotation.w);
  const Q k = 1 / Q(x * x + y * y + z * z + w * w);
  s.column[0] = k * V{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
  s.column[1] = k * V{2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
  s.column[2] = k * V{2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
  s.centre = exact_value(p.translation);
}
void place(Set& s, const Placement& p) {
  for (int i = 0; i < 3; ++i) s.column[i] = exact_value(Vec3(p.matrix.col(i)));
  s.centre = exact_value(p.translation);
}

// Local coordinates by Cramer's rule; nothing when the placement is singular.
std::optional<V> local(const Set& s, const V& world) {
  const V d = world - s.centre;
  const V &a = s.column[0], &b = s.column[1], &c = s.column[2];
  const Q det = dot(a, cross(b, c));
  if (det == 0) return std::nullopt;
  return V{dot(d, cross(b, c)) / det, dot(a, cross(d, c)) / det, dot(a, cross(b, d)) / det};
}

bool holds_local(const Set& s, const V& x) {
  const Q &r = s.size.x, &h = s.size.y;
  const Q across = x.x * x.x + x.y * x.y;
  if (s.kind == Set::Kind::ellipsoid) {
    const V u{x.x / s.size.x, x.y / s.size.y, x.z / s.size.z};
    return dot(u, u) <= 1;
  }
  if (x.z < -h || x.z > h) return false;
  if (s.kind == Set::Kind::cylinder) return across <= r * r;
  return 4 * h * h * across <= r * r * (h - x.z) * (h - x.z) && across <= r * r;
}

// |Mx|² <= 2|x|² by Gershgorin's bound of MᵀM.
bool stretches_little(const Set& s) {
  for (const V& c : s.column) {
    Q sum = 0;
    for (const V& d : s.column) sum += abs(dot(c, d));
    if (sum > 2) return false;
  }
  return true;
}

// Moves of at most e/2 along the axis and e/2 across it (an ellipsoid: of e/2) lead into the set. With
// |Mx|² <= 2|x|² that is at most e in the world.
bool holds_local_within(const Set& s, const V& x, const Q& e) {
  const Q half = e / 2, across = x.x * x.x + x.y * x.y;
  if (s.kind != Set::Kind::cone) {
    Set larger = s;
    larger.size = s.size + V{half, half, half};
    return holds_local(larger, x);
  }
  const Q &r = s.size.x, &h = s.size.y;
  if (x.z < -h - half) return false;
  const Q z = std::max(Q(-h), Q(x.z - half)), room = r * (h - z) + 2 * h * half;
  return z <= h && 4 * h * h * across <= room * room && across <= (r + half) * (r + half);
}

// Wolfe's step: weights of the nearest point of the affine hull, from (Gram + 1)·w = 1 by elimination.
std::vector<Q> affine_weights(const std::vector<V>& p) {
  const std::size_t n = p.size();
  std::vector<std::vector<Q>> m(n, std::vector<Q>(n + 1, Q(1)));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) m[i][j] = dot(p[i], p[j]) + 1;
  for (std::size_t k = 0; k < n; ++k) {
    // The matrix is positive definite for affinely independent points: every pivot is positive.
    if (m[k][k] == 0) throw std::logic_error("checker: dependent face");
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Q f = m[i][k] / m[k][k];
      for (std::size_t j = k; j <= n; ++j) m[i][j] -= f * m[k][j];
    }
  }
  std::vector<Q> w(n);
  Q sum = 0;
  for (std::size_t i = 0; i < n; ++i) w[i] = m[i][n] / m[i][i], sum += w[i];
  for (Q& x : w) x /= sum;
  return w;
}

Set points_set(const std::vector<Vec3>& local_points, double ball, const Placed& p) {
  Set s;
  std::visit([&](const auto& pose) { place(s, pose); }, p.pose);
  s.ball = ball;
  for (const Vec3& v : local_points) s.points.push_back(apply(s, exact_value(v)));
  return s;
}

Set curved_set(Set::Kind kind, const Vec3& size, const Placed& p) {
  Set s;
  std::visit([&](const auto& pose) { place(s, pose); }, p.pose);
  s.kind = kind;
  s.size = exact_value(size);
  return s;
}

std::vector<Vec3> corners(const Vec3& h) {
  std::vector<Vec3> v;
  for (double x : {-h.x(), h.x()})
    for (double y : {-h.y(), h.y()})
      for (double z : {-h.z(), h.z()}) v.emplace_back(x, y, z);
  return v;
}

// {x : Mᵀ⁻¹m·(x - t) <= o}: the plane's world normal times |det M| is the signed cofactor matrix times m.
std::vector<Set> half_space_set(const HalfSpace& h, const Placed& p) {
  Set s = curved_set(Set::Kind::half_space, Vec3::Zero(), p);
  const V &a = s.column[0], &b = s.column[1], &c = s.column[2], m = exact_value(h.normal);
  const Q det = dot(a, cross(b, c));
  if (det == 0) return {};
  const V n = m.x * cross(b, c) + m.y * cross(c, a) + m.z * cross(a, b);
  s.normal = det > 0 ? n : Q(-1) * n;
  s.offset = abs(det) * Q(h.offset) + dot(s.normal, s.centre);
  return {s};
}

std::vector<Set> mesh_sets(const TriangleMesh& m, const Placed& p) {
  std::vector<Set> r;
  for (const auto& t : m.triangles) {
    std::vector<Vec3> v;
    for (int k : t) v.push_back(m.vertices[static_cast<std::size_t>(k)]);
    r.push_back(points_set(v, 0, p));
  }
  return r;
}

}  // namespace

Sum operator+(Sum a, const Sum& b) {
  a.rational += b.rational;
  a.roots.insert(a.roots.end(), b.roots.begin(), b.roots.end());
  return a;
}

bool is_at_most_zero(const Sum& given, bool strictly) {
  const Sum s = tidy(given);
  if (s.roots.empty()) return strictly ? s.rational < 0 : s.rational <= 0;
  for (unsigned bits = 64; bits <= 4096; bits *= 2) {
    Q least = s.rational, most = s.rational;
    for (const auto& r : s.roots) {
      const auto [lo, hi] = root_bounds(r.square, bits);
      least += r.factor * (r.factor > 0 ? lo : hi);
      most += r.factor * (r.factor > 0 ? hi : lo);
    }
    if (most < 0) return true;
    if (least > 0) return false;
  }
  return false;
}

std::vector<Set> sets_of(const Placed& p) {
  const Shape& shape = *p.shape;
  using K = Set::Kind;
  if (const auto* s = std::get_if<Sphere>(&shape)) return {points_set({Vec3::Zero()}, s->radius, p)};
  if (const auto* s = std::get_if<Box>(&shape)) return {points_set(corners(s->half_extents), 0, p)};
  if (const auto* s = std::get_if<Capsule>(&shape))
    return {points_set({{0, 0, -s->half_height}, {0, 0, s->half_height}}, s->radius, p)};
  if (const auto* s = std::get_if<Hull>(&shape)) return {points_set(s->vertices, 0, p)};
  if (const auto* s = std::get_if<Cylinder>(&shape))
    return {curved_set(K::cylinder, {s->radius, s->half_height, 0}, p)};
  if (const auto* s = std::get_if<Cone>(&shape))
    return {curved_set(K::cone, {s->radius, s->half_height, 0}, p)};
  if (const auto* s = std::get_if<Ellipsoid>(&shape)) return {curved_set(K::ellipsoid, s->semi_axes, p)};
  if (const auto* s = std::get_if<HalfSpace>(&shape)) return half_space_set(*s, p);
  return mesh_sets(std::get<TriangleMesh>(shape), p);
}

std::vector<Sum> support_values(const Set& s, const V& n) {
  if (s.kind == Set::Kind::points) {
    Q best = dot(n, s.points.front());
    for (const V& p : s.points) best = std::max(best, Q(dot(n, p)));
    return {{best, {{s.ball, dot(n, n)}}}};
  }
  const V m{dot(n, s.column[0]), dot(n, s.column[1]), dot(n, s.column[2])};
  const Q base = dot(n, s.centre), across = m.x * m.x + m.y * m.y;
  if (s.kind == Set::Kind::ellipsoid) {
    const V u{s.size.x * m.x, s.size.y * m.y, s.size.z * m.z};
    return {{base, {{1, dot(u, u)}}}};
  }
  const Q &r = s.size.x, &h = s.size.y;
  if (s.kind == Set::Kind::cylinder) return {{base + h * abs(m.z), {{r, across}}}};
  return {{base + h * m.z, {}}, {base - h * m.z, {{r, across}}}};
}

bool contains(const Set& s, const V& x) {
  if (s.kind == Set::Kind::half_space) return dot(s.normal, x) <= s.offset;
  if (s.kind == Set::Kind::points) return is_near_core(s, x, s.ball);
  const auto u = local(s, x);
  return u && holds_local(s, *u);
}

bool is_near_core(const Set& s, const V& x, const Q& e) {
  if (s.kind == Set::Kind::points) {
    std::vector<V> about;
    for (const V& p : s.points) about.push_back(p - x);
    const V v = nearest_to_origin(about);
    return dot(v, v) <= e * e;
  }
  const auto u = local(s, x);
  return u && stretches_little(s) && holds_local_within(s, *u, e);
}

V nearest_to_origin(const std::vector<V>& p) {
  std::vector<V> face{p.front()};
  std::vector<Q> weight{1};
  for (;;) {
    V v{0, 0, 0};
    for (std::size_t i = 0; i < face.size(); ++i) v = v + weight[i] * face[i];
    const V* far = &p.front();
    for (const V& q : p)
      if (dot(v, q) < dot(v, *far)) far = &q;
    if (dot(v, *far) >= dot(v, v)) return v;
    face.push_back(*far), weight.emplace_back(0);
    for (bool clear = false; !clear;) {
      const std::vector<Q> goal = affine_weights(face);
      Q step = 1;
      for (std::size_t i = 0; i < face.size(); ++i)
        if (goal[i] < 0) step = std::min(step, Q(weight[i] / (weight[i] - goal[i])));
      for (std::size_t i = face.size(); i-- > 0;) {
        weight[i] += step * (goal[i] - weight[i]);
        if (weight[i] != 0) continue;
        face.erase(face.begin() + static_cast<std::ptrdiff_t>(i));
        weight.erase(weight.begin() + static_cast<std::ptrdiff_t>(i));
      }
      clear = step == 1;
    }
  }
}

}  // namespace touchstone::referee::checker
