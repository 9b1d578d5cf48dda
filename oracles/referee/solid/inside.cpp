// Which points are inside a solid, and whether it is convex: rounded where an error bound allows it, else
// exact.
#include <algorithm>
#include <map>
#include <set>

#include "oracles/referee/filter/body.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

using Corner = std::size_t;

int sign_of(const Rational& x) { return x.sign(); }

// The corners of a surface relative to a point: rounded, each within `error`, and exact on demand.
class SeenFrom {
 public:
  SeenFrom(const Placed& solid, const TriangleMesh& mesh, const Rational3& point)
      : solid_(solid), mesh_(mesh), point_(point), exact_(mesh.vertices.size()) {
    const Vec3 origin{point.x.convert_to<double>(), point.y.convert_to<double>(),
                      point.z.convert_to<double>()};
    const Solid body = make_body(mesh.vertices, 0, frame_of(solid, origin));
    near_ = body.points;
    // The point is rounded to doubles: within a rounding of each coordinate.
    const Real moved = std::numeric_limits<double>::epsilon() * Real{origin.cwiseAbs().sum()};
    error_ = body.error + moved;
  }

  /// Of the plane angle from corner a to corner b seen along z, with the point moved by (e, e²).
  int turn(Corner a, Corner b) const {
    const Real3 &p = near_[a], &q = near_[b];
    const Real det = p.x * q.y - p.y * q.x;
    const Real sizes = std::fabs(p.x) + std::fabs(p.y) + std::fabs(q.x) + std::fabs(q.y);
    const Real slack = 4 * error_ * (sizes + error_) + value_rounding * sizes * sizes;
    if (std::fabs(det) > slack) return det > 0 ? 1 : -1;
    const Rational3 &x = exact(a), &y = exact(b);
    if (const int s = sign_of(x.x * y.y - x.y * y.x); s != 0) return s;
    if (x.y != y.y) return x.y > y.y ? 1 : -1;
    return x.x == y.x ? 0 : y.x > x.x ? 1 : -1;
  }

  /// Of det(a, b, c).
  int volume(Corner a, Corner b, Corner c) const {
    const Real3 &p = near_[a], &q = near_[b], &r = near_[c];
    const Real det = dot(p, cross(q, r));
    const Real most = std::max({largest(p), largest(q), largest(r)}) + error_;
    constexpr Real terms = 64;  // six products of three factors, each off by error_ or a few roundings
    if (std::fabs(det) > terms * most * most * (error_ + value_rounding * most)) return det > 0 ? 1 : -1;
    return sign_of(dot(exact(a), cross(exact(b), exact(c))));
  }

  /// Whether the triangle is certainly beside or below the ray upward.
  bool is_off(Corner a, Corner b, Corner c) const {
    const Real3 &p = near_[a], &q = near_[b], &r = near_[c];
    return std::max({p.x, q.x, r.x}) < -error_ || std::min({p.x, q.x, r.x}) > error_ ||
           std::max({p.y, q.y, r.y}) < -error_ || std::min({p.y, q.y, r.y}) > error_ ||
           std::max({p.z, q.z, r.z}) < -error_;
  }

 private:
  const Rational3& exact(Corner i) const {
    if (!exact_[i]) exact_[i] = world_point(solid_.pose, referee::exact(mesh_.vertices[i])) - point_;
    return *exact_[i];
  }

  const Placed& solid_;
  const TriangleMesh& mesh_;
  const Rational3& point_;
  std::vector<Real3> near_;
  mutable std::vector<std::optional<Rational3>> exact_;
  Real error_ = 0;
};

using Edge = std::pair<int, int>;

}  // namespace

// Triangles above the point, +1 for those that turn counter-clockwise about the ray upward. The ray is moved
// aside by an infinitesimal amount, so that it meets no edge.
bool is_inside(const Placed& solid, const Rational3& point_w) {
  const TriangleMesh& mesh = std::get<SolidMesh>(*solid.shape);
  spend(static_cast<std::int64_t>(mesh.triangles.size()) * 200);
  const SeenFrom seen(solid, mesh, point_w);
  int winding = 0;
  for (const auto& t : mesh.triangles) {
    const auto a = static_cast<Corner>(t[0]), b = static_cast<Corner>(t[1]), c = static_cast<Corner>(t[2]);
    if (seen.is_off(a, b, c)) continue;
    const int turn = seen.turn(a, b);
    if (turn == 0 || seen.turn(b, c) != turn || seen.turn(c, a) != turn) continue;
    if (seen.volume(a, b, c) * turn > 0) winding += turn;
  }
  return winding != 0;
}

bool is_convex_inside(const TriangleMesh& m) {
  std::map<std::array<double, 3>, int> numbers;
  std::vector<int> number;
  for (const Vec3& v : m.vertices)
    number.push_back(
        numbers.try_emplace({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}, static_cast<int>(numbers.size()))
            .first->second);
  const auto of = [&](const std::array<int, 3>& t, std::size_t k) {
    return number[static_cast<std::size_t>(t[k % 3])];
  };
  std::map<Edge, std::size_t> edges;
  for (std::size_t i = 0; i < m.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) edges[{of(m.triangles[i], k), of(m.triangles[i], k + 1)}] = i;
  // A connected surface with V - E + F = 2 is a sphere.
  const auto faces = static_cast<long>(m.triangles.size());
  if (static_cast<long>(numbers.size()) - static_cast<long>(edges.size()) / 2 + faces != 2) return false;
  std::vector<bool> reached(m.triangles.size(), false);
  std::vector<std::size_t> open{0};
  reached[0] = true;
  std::size_t count = 0;
  while (!open.empty()) {
    const auto t = m.triangles[open.back()];
    open.pop_back();
    ++count;
    const auto corner = [&](std::size_t k) { return exact(m.vertices[static_cast<std::size_t>(t[k])]); };
    const Rational3 p = corner(0), n = cross(corner(1) - p, corner(2) - p);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto next = edges.find({of(t, k + 1), of(t, k)});
      if (next == edges.end()) return false;
      for (const int v : m.triangles[next->second])
        if (dot(n, exact(m.vertices[static_cast<std::size_t>(v)]) - p) > 0) return false;
      if (!reached[next->second]) open.push_back(next->second);
      reached[next->second] = true;
    }
  }
  return count == m.triangles.size();
}

namespace {

// A point of a convex body, or of each triangle of a mesh, in the body's frame.
std::vector<Vec3> points_of(const Placed& p) {
  if (const TriangleMesh* m = triangles_if(*p.shape)) {
    // Triangles that share a vertex are inside together.
    std::vector<Vec3> r;
    std::vector<int> part(m->vertices.size());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<int>(i);
    const auto root = [&](int v) {
      while (part[static_cast<std::size_t>(v)] != v) v = part[static_cast<std::size_t>(v)];
      return v;
    };
    for (const auto& t : m->triangles)
      for (const int v : t) part[static_cast<std::size_t>(root(v))] = root(t[0]);
    std::set<int> seen;
    for (const auto& t : m->triangles)
      if (seen.insert(root(t[0])).second) r.push_back(m->vertices[static_cast<std::size_t>(t[0])]);
    return r;
  }
  if (const auto* h = hull_if(*p.shape)) return {h->vertices.front()};
  return {Vec3::Zero()};
}

}  // namespace

std::optional<Rational3> point_inside(const Placed& a, const Placed& b) {
  for (const auto& [solid, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    if (!is_solid(*solid)) continue;
    for (const Vec3& p : points_of(*other)) {
      const Rational3 point = world_point(other->pose, exact(p));
      if (is_inside(*solid, point)) return point;
    }
  }
  return std::nullopt;
}

AsSurface::AsSurface(const Placed& p) : placed_(p) {
  const auto* solid = std::get_if<SolidMesh>(p.shape);
  if (!solid) return;
  own_ = static_cast<const TriangleMesh&>(*solid);
  placed_.shape = &own_;
}

AsHulls::AsHulls(const Placed& a, const Placed& b) : a_(a), b_(b) {
  const auto replace = [](Placed& p, Shape& own, const Placed& other) {
    const auto* solid = std::get_if<SolidMesh>(p.shape);
    if (!solid || (!std::holds_alternative<HalfSpace>(*other.shape) && !is_convex_inside(*solid))) return;
    Hull hull;
    hull.vertices = solid->vertices;
    own = std::move(hull);
    p.shape = &own;
  };
  replace(a_, own_a_, b);
  replace(b_, own_b_, a);
}

}  // namespace touchstone::referee
