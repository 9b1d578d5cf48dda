#include "oracles/referee/checker_set.h"

#include <algorithm>
#include <stdexcept>

namespace touchstone::referee::checker {
namespace {

using Z = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

// R(q)·x for the quaternion q = (v, w), not zero and not necessarily unit.
V rotated(const V& v, const Q& w, const V& x) {
  return 1 / Q(dot(v, v) + w * w) * (2 * dot(v, x) * v + (w * w - dot(v, v)) * x + 2 * w * cross(v, x));
}

V unit(int axis) { return {Q(axis == 0), Q(axis == 1), Q(axis == 2)}; }

V placed(const Set& s, const V& x) {
  return x.x * s.column[0] + x.y * s.column[1] + x.z * s.column[2] + s.origin;
}

Set placed_axes(const Placed& p, const Carrier& by) {
  Set s;
  V c[3], origin;
  if (const auto* pose = std::get_if<Pose>(&p.pose)) {
    const Quat& q = pose->rotation;
    for (int i = 0; i < 3; ++i) c[i] = rotated({Q(q.x), Q(q.y), Q(q.z)}, Q(q.w), unit(i));
    origin = exact_value(pose->translation);
  } else {
    const auto& place = std::get<Placement>(p.pose);
    for (int i = 0; i < 3; ++i) c[i] = exact_value(Vec3(place.matrix.col(i)));
    origin = exact_value(place.translation);
  }
  const bool turns = dot(by.v, by.v) != 0;
  for (int i = 0; i < 3; ++i) s.column[i] = turns ? rotated(by.v, by.w, c[i]) : c[i];
  s.origin = origin + by.shift;
  return s;
}

Set hull(Set s, const std::vector<Vec3>& local, double ball = 0) {
  for (const Vec3& v : local) s.core.push_back({placed(s, exact_value(v)), {}});
  s.ball = Q(ball);
  return s;
}

// A disc of the radius at each height (0: a point), in local coordinates.
Set discs(Set s, Set::Kind kind, double radius, double half_height, bool top_is_point) {
  const Q r(radius), h(half_height);
  s.kind = kind, s.size = {r, h, 0};
  const std::vector<V> rim{r * s.column[0], r * s.column[1]};
  s.core = {{placed(s, {0, 0, -h}), rim}, {placed(s, {0, 0, h}), top_is_point ? std::vector<V>{} : rim}};
  return s;
}

std::vector<Set> of_shape(const Set& s, const Sphere& x) { return {hull(s, {Vec3::Zero()}, x.radius)}; }
std::vector<Set> of_shape(const Set& s, const Hull& x) { return {hull(s, x.vertices)}; }
std::vector<Set> of_shape(const Set& s, const Capsule& x) {
  return {hull(s, {{0, 0, -x.half_height}, {0, 0, x.half_height}}, x.radius)};
}
std::vector<Set> of_shape(const Set& s, const Box& x) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(x.half_extents.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return {hull(s, corners)};
}
std::vector<Set> of_shape(const Set& s, const Cylinder& x) {
  return {discs(s, Set::Kind::cylinder, x.radius, x.half_height, false)};
}
std::vector<Set> of_shape(const Set& s, const Cone& x) {
  return {discs(s, Set::Kind::cone, x.radius, x.half_height, true)};
}
std::vector<Set> of_shape(Set s, const Ellipsoid& x) {
  s.kind = Set::Kind::ellipsoid, s.size = exact_value(x.semi_axes);
  s.core = {{s.origin, {s.size.x * s.column[0], s.size.y * s.column[1], s.size.z * s.column[2]}}};
  return {s};
}
// {Mx + t : m·x <= o} = {y : C m·(y - t) <= o·det M}, C the cofactor matrix of M; both sides turn about with
// the sign of det M.
std::vector<Set> of_shape(Set s, const HalfSpace& x) {
  const V &a = s.column[0], &b = s.column[1], &c = s.column[2], m = exact_value(x.normal);
  const Q det = dot(a, cross(b, c));
  if (det == 0) return {};
  s.kind = Set::Kind::half_space;
  s.normal = Q(det.sign()) * (m.x * cross(b, c) + m.y * cross(c, a) + m.z * cross(a, b));
  s.offset = abs(det) * Q(x.offset) + dot(s.normal, s.origin);
  return {s};
}
std::vector<Set> of_shape(const Set& s, const TriangleMesh& x) {
  std::vector<Set> r;
  const auto at = [&](int k) { return x.vertices[static_cast<std::size_t>(k)]; };
  for (const auto& t : x.triangles) r.push_back(hull(s, {at(t[0]), at(t[1]), at(t[2])}));
  return r;
}

// Local coordinates of a curved set by Cramer's rule. There, moves of g along each axis (g across the axis of
// a cylinder or cone) are at most √2·g together, and at most twice as much in the world where |M|² <= 4: r in
// all for g = r/4.
bool is_within_curved(const Set& s, const V& x, const Q& r) {
  const V &a = s.column[0], &b = s.column[1], &c = s.column[2], d = x - s.origin;
  const Q det = dot(a, cross(b, c)), g = r / 4;
  if (det == 0 || (r > 0 && dot(a, a) + dot(b, b) + dot(c, c) > 4)) return false;
  const V u = 1 / det * V{dot(d, cross(b, c)), dot(a, cross(d, c)), dot(a, cross(b, d))};
  if (s.kind == Set::Kind::ellipsoid) {
    const V k{u.x / (s.size.x + g), u.y / (s.size.y + g), u.z / (s.size.z + g)};
    return dot(k, k) <= 1;
  }
  const Q &radius = s.size.x, &h = s.size.y, low = std::max(Q(-h), Q(u.z - g));
  if (abs(u.z) > h + g) return false;
  const bool narrows = s.kind == Set::Kind::cone && h > 0;
  const Q room = (narrows ? Q(radius * (h - low) / (2 * h)) : radius) + g;
  return u.x * u.x + u.y * u.y <= room * room;
}

// Weights of the nearest point of the affine hull to the origin, from (Gram + 1)·w = 1 by elimination.
std::vector<Q> affine_weights(const std::vector<V>& p) {
  const std::size_t n = p.size();
  std::vector<std::vector<Q>> m(n, std::vector<Q>(n + 1, Q(1)));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) m[i][j] = dot(p[i], p[j]) + 1;
  for (std::size_t k = 0; k < n; ++k) {
    // Positive definite for affinely independent points: every pivot is positive.
    if (m[k][k] == 0) throw std::logic_error("checker: dependent face");
    for (std::size_t i = 0; i < n; ++i) {
      const Q f = m[i][k] / m[k][k];
      for (std::size_t j = k; i != k && j <= n; ++j) m[i][j] -= f * m[k][j];
    }
  }
  std::vector<Q> w(n);
  Q sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += w[i] = m[i][n] / m[i][i];
  for (Q& x : w) x /= sum;
  return w;
}

}  // namespace

Q times_root(const Q& factor, const Q& square) {
  const Z d = denominator(square), scaled = (numerator(square) * d) << 1024, root = sqrt(scaled);
  const bool up = factor > 0 && root * root != scaled;  // √(n/d) = √(n·d)/d
  return factor * Q(up ? Z(root + 1) : root, d << 512);
}

std::vector<Set> sets_of(const Placed& p, const Carrier& by) {
  const Set s = placed_axes(p, by);
  return std::visit([&](const auto& shape) { return of_shape(s, shape); }, *p.shape);
}

std::optional<Q> core_support(const Set& s, const V& n) {
  if (s.kind == Set::Kind::half_space) {
    const V off = cross(s.normal, n);
    const Q along = dot(s.normal, n);
    if (dot(off, off) != 0 || along <= 0) return std::nullopt;
    return s.offset * along / dot(s.normal, s.normal);
  }
  std::optional<Q> best;
  for (const Set::Round& piece : s.core) {
    Q square = 0;
    for (const V& a : piece.axes) square += dot(a, n) * dot(a, n);
    const Q h = dot(piece.centre, n) + times_root(1, square);
    if (!best || h > *best) best = h;
  }
  return best;
}

bool is_within(const Set& s, const V& x, const Q& r) {
  if (s.kind == Set::Kind::half_space) return dot(s.normal, x) <= s.offset;
  if (s.kind != Set::Kind::hull) return is_within_curved(s, x, r);
  std::vector<V> about;
  for (const Set::Round& piece : s.core) about.push_back(piece.centre - x);
  const V v = nearest_to_origin(about);
  return dot(v, v) <= r * r;
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
