#include "core/world/simpler_shape.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>

#include "core/math/expansion.h"
#include "core/math/roundoff.h"
#include "core/narrow/narrow_phase.h"

namespace touchstone {
namespace {

// About ten roundings lie between a shape's numbers and a computed length.
constexpr double length_rounding = 0x1p-48;
// A triangle whose normal is shorter than this, relative to the squared size, is a sliver: its plane is
// unreliable.
constexpr double sliver = 0x1p-40;

// A computed length of a shape of this size, rounded up.
double rounded_up(double x, double size) { return x + length_rounding * size; }

double size_of(const Hull& h) {
  double m = 0;
  for (const Vec3& v : h.vertices) m = std::max(m, v.lpNorm<1>());
  return m;
}

struct Extremes {
  Vec3 lo, hi;
};

Extremes extremes(const Hull& h, const Mat3& axes) {
  Extremes e{Vec3::Constant(infinity), Vec3::Constant(-infinity)};
  for (const Vec3& v : h.vertices) {
    const Vec3 x = axes.transpose() * v;
    e.lo = e.lo.cwiseMin(x);
    e.hi = e.hi.cwiseMax(x);
  }
  return e;
}

struct Face {
  Vec3 normal;  // unit
  double area;
};

std::vector<Face> faces_of(const Hull& h) {
  std::vector<Face> r;
  for (const auto& f : h.faces) {
    const Vec3 a = h.vertices[static_cast<std::size_t>(f[0])];
    const Vec3 n = (h.vertices[static_cast<std::size_t>(f[1])] - a)
                       .cross(h.vertices[static_cast<std::size_t>(f[2])] - a);
    if (n.norm() > 0) r.push_back({n.normalized(), n.norm()});
  }
  return r;
}

std::optional<SimplerShape> ball_of(const Hull& h, double allowed) {
  if (h.faces.empty()) return std::nullopt;
  const Extremes e = extremes(h, Mat3::Identity());
  const Vec3 centre = (e.lo + e.hi) / 2;
  double outer = 0, inner = infinity;
  for (const Vec3& v : h.vertices) outer = std::max(outer, (v - centre).norm());
  for (const auto& f : h.faces) {
    const Vec3 a = h.vertices[static_cast<std::size_t>(f[0])];
    const Vec3 n = (h.vertices[static_cast<std::size_t>(f[1])] - a)
                       .cross(h.vertices[static_cast<std::size_t>(f[2])] - a);
    // The neighbours of a sliver share its corners.
    if (n.norm() <= sliver * outer * outer) continue;
    inner = std::min(inner, (a - centre).dot(n) / n.norm());
  }
  const double error = rounded_up((outer - inner) / 2, size_of(h));
  if (!(inner > 0 && error <= allowed)) return std::nullopt;
  return SimplerShape{Sphere{(outer + inner) / 2}, {centre, {}}, error};
}

// Axes from the two largest approximately perpendicular faces; the body axes when there are none.
Mat3 box_axes(const Hull& h) {
  constexpr double about_perpendicular = 0.05;  // cosine of the angle between two normals
  const std::vector<Face> faces = faces_of(h);
  const auto larger = [](const Face& x, const Face& y) { return x.area < y.area; };
  const auto first = std::max_element(faces.begin(), faces.end(), larger);
  if (first == faces.end()) return Mat3::Identity();
  const Face* second = nullptr;
  for (const Face& f : faces)
    if (std::abs(f.normal.dot(first->normal)) < about_perpendicular && (!second || f.area > second->area))
      second = &f;
  if (!second) return Mat3::Identity();
  Mat3 axes;
  axes.col(0) = first->normal;
  axes.col(2) = first->normal.cross(second->normal).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

std::optional<SimplerShape> box_of(const Hull& h, const Mat3& axes, double allowed) {
  const Extremes e = extremes(h, axes);
  const Vec3 half = (e.hi - e.lo) / 2, middle = (e.lo + e.hi) / 2;
  if (!(half.minCoeff() > 0)) return std::nullopt;
  double worst = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 c = middle;
    for (int k = 0; k < 3; ++k) c[k] += (corner >> k & 1) != 0 ? half[k] : -half[k];
    double nearest = infinity;
    for (const Vec3& v : h.vertices) nearest = std::min(nearest, (axes.transpose() * v - c).norm());
    worst = std::max(worst, nearest);
  }
  const double error = rounded_up(worst, size_of(h));
  if (error > allowed) return std::nullopt;
  const Eigen::Quaterniond q(axes);
  return SimplerShape{Box{half}, {axes * middle, {q.x(), q.y(), q.z(), q.w()}}, error};
}

// An upper bound on the distance from a point to the hull.
double upper_distance(const Vec3& p, const Shape& hull) {
  const Shape point = Hull{{p}, {}, 0};
  const DistanceAnswer d = distance({&point, {}}, {&hull, {}});
  if (d.outcome != Outcome::answered) return infinity;
  return std::max(0.0, d.distance) + d.error_bound;
}

// Adds vertices until all others are near enough. Distances only shrink as vertices are added, so an old
// distance is an upper bound, and only the farthest vertex needs a new one.
std::optional<SimplerShape> fewer_vertices(const Hull& h, double allowed) {
  constexpr std::size_t worth_it = 8;
  if (h.vertices.size() <= worth_it || h.dimension < 3) return std::nullopt;
  const double size = size_of(h);
  std::vector<char> in(h.vertices.size(), 0);
  Hull kept;
  kept.dimension = 3;
  const auto take = [&](std::size_t i) {
    if (!in[i]) kept.vertices.push_back(h.vertices[i]);
    in[i] = 1;
  };
  for (int k = 0; k < 3; ++k) {
    const auto less = [k](const Vec3& x, const Vec3& y) { return x[k] < y[k]; };
    const auto [lo, hi] = std::minmax_element(h.vertices.begin(), h.vertices.end(), less);
    take(static_cast<std::size_t>(lo - h.vertices.begin()));
    take(static_cast<std::size_t>(hi - h.vertices.begin()));
  }
  std::priority_queue<std::pair<double, std::size_t>> farthest;
  for (std::size_t i = 0; i < in.size(); ++i)
    if (!in[i]) farthest.emplace(infinity, i);
  Shape shape = kept;
  while (!farthest.empty() && farthest.top().first > allowed) {
    const std::size_t i = farthest.top().second;
    farthest.pop();
    const double d = rounded_up(upper_distance(h.vertices[i], shape), size);
    if (d > allowed && (farthest.empty() || d >= farthest.top().first)) {
      take(i);
      shape = kept;
    } else {
      farthest.emplace(d, i);
    }
  }
  const double error = farthest.empty() ? 0 : farthest.top().first;
  if (kept.vertices.size() == h.vertices.size()) return std::nullopt;
  Hull result = make_hull(std::move(kept.vertices));
  // A solid body must not become flat.
  if (result.dimension < 3) return std::nullopt;
  return SimplerShape{std::move(result), {}, error};
}

std::optional<SimplerShape> simpler(const Hull& h, double allowed) {
  if (h.vertices.size() < 4 || h.dimension < 3) return std::nullopt;
  if (auto s = ball_of(h, allowed)) return s;
  if (auto s = box_of(h, Mat3::Identity(), allowed)) return s;
  if (auto s = box_of(h, box_axes(h), allowed)) return s;
  return fewer_vertices(h, allowed);
}

std::optional<SimplerShape> simpler(const Ellipsoid& e, double allowed) {
  const double lo = e.semi_axes.minCoeff(), hi = e.semi_axes.maxCoeff();
  const double error = hi > lo ? rounded_up((hi - lo) / 2, hi) : 0;
  if (error > allowed) return std::nullopt;
  return SimplerShape{Sphere{lo + (hi - lo) / 2}, {}, error};
}

std::optional<SimplerShape> simpler(const Capsule& c, double allowed) {
  const double error = c.half_height > 0 ? rounded_up(c.half_height / 2, c.radius + c.half_height) : 0;
  if (error > allowed) return std::nullopt;
  return SimplerShape{Sphere{c.radius + c.half_height / 2}, {}, error};
}

// The unit quaternion that takes the z axis to that axis.
Quat from_z(int axis) {
  constexpr double half = std::numbers::sqrt2 / 2;
  if (axis == 0) return {0, half, 0, half};
  return axis == 1 ? Quat{-half, 0, 0, half} : Quat{};
}

std::optional<SimplerShape> simpler(const RoundedBox& b, double allowed) {
  const Vec3& h = b.half_extents;
  if (b.radius == 0) return SimplerShape{Box{h}, {}, 0};
  int longest = 0;
  const double most = h.maxCoeff(&longest);
  const bool is_segment = (h.array() == 0).count() >= 2;
  if (!is_segment) return std::nullopt;
  if (auto ball = simpler(Capsule{b.radius, most}, allowed)) return ball;
  return SimplerShape{Capsule{b.radius, most}, {Vec3::Zero(), from_z(longest)}, 0};
}

template <class S>
std::optional<SimplerShape> simpler(const Padded<S>& p, double) {
  if (p.padding > 0) return std::nullopt;
  return SimplerShape{p.inner, {}, 0};
}

template <class S>
std::optional<SimplerShape> simpler(const S&, double) {
  return std::nullopt;
}

}  // namespace

std::optional<Hull> convex_solid(const TriangleMesh& mesh) {
  const auto at = [&](int i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(i)]; };
  std::map<std::pair<int, int>, int> edges;  // directed
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      used[static_cast<std::size_t>(t[k])] = 1;
      if (++edges[{t[k], t[(k + 1) % 3]}] > 1) return std::nullopt;
    }
  for (const auto& [edge, n] : edges)
    if (!edges.contains({edge.second, edge.first})) return std::nullopt;
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) corners.push_back(mesh.vertices[i]);
  if (corners.size() < 4) return std::nullopt;
  // All corners must lie on the same side of every triangle; either orientation is allowed.
  int side = 0;
  for (const auto& t : mesh.triangles)
    for (const Vec3& v : corners) {
      const int sign = orient3d_sign(at(t[0]), at(t[1]), at(t[2]), v);
      if (sign != 0 && side == 0) side = sign;
      if (sign != 0 && sign != side) return std::nullopt;
    }
  if (side == 0) return std::nullopt;  // flat
  return make_hull(std::move(corners));
}

std::optional<SimplerShape> simpler_shape(const Shape& shape, double allowed, bool solid_meshes) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape); mesh && solid_meshes) {
    std::optional<Hull> hull = convex_solid(*mesh);
    if (!hull) return std::nullopt;
    if (auto simple = simpler(*hull, allowed)) return simple;
    return SimplerShape{std::move(*hull), {}, 0};
  }
  return std::visit([&](const auto& s) { return simpler(s, allowed); }, shape);
}

Pose placed_in(const Pose& body, const Pose& in_body) {
  return {to_transform(body) * in_body.translation, normalized(body.rotation) * in_body.rotation};
}

}  // namespace touchstone
