// Convex sets in a plane as lists of vertices: a point (1), a segment (2), a polygon (3 or more,
// counter-clockwise).
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace touchstone::referee {

struct Point2 {
  double x = 0, y = 0;
};
inline Point2 operator+(const Point2& a, const Point2& b) { return {a.x + b.x, a.y + b.y}; }
inline Point2 operator-(const Point2& a, const Point2& b) { return {a.x - b.x, a.y - b.y}; }
inline Point2 operator*(double s, const Point2& a) { return {s * a.x, s * a.y}; }
inline double dot(const Point2& a, const Point2& b) { return a.x * b.x + a.y * b.y; }
inline double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }
inline double norm(const Point2& a) { return std::hypot(a.x, a.y); }

using Convex2 = std::vector<Point2>;

/// Andrew's monotone chain (1979).
inline Convex2 hull_of(std::vector<Point2> p) {
  std::sort(p.begin(), p.end(),
            [](const Point2& a, const Point2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  p.erase(std::unique(p.begin(), p.end(),
                      [](const Point2& a, const Point2& b) { return a.x == b.x && a.y == b.y; }),
          p.end());
  if (p.size() < 3) return p;
  Convex2 h;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = h.size();
    for (const Point2& q : p) {
      while (h.size() >= base + 2 && cross(h[h.size() - 1] - h[h.size() - 2], q - h[h.size() - 2]) <= 0)
        h.pop_back();
      h.push_back(q);
    }
    h.pop_back();
    std::reverse(p.begin(), p.end());
  }
  return h;
}

inline double area_of(const Convex2& p) {
  double twice = 0;
  for (std::size_t i = 2; i < p.size(); ++i) twice += cross(p[i - 1] - p[0], p[i] - p[0]);
  return twice / 2;
}

inline Point2 centroid_of(const Convex2& p) {
  if (p.size() < 3) return 0.5 * (p.front() + p.back());
  Point2 sum;
  double weight = 0;
  for (std::size_t i = 2; i < p.size(); ++i) {
    const double w = cross(p[i - 1] - p[0], p[i] - p[0]);
    sum = sum + w * (p[i - 1] + p[i] - 2 * p[0]);
    weight += w;
  }
  return p[0] + 1 / (3 * weight) * sum;
}

/// {p : dot(normal, p) <= offset}
struct HalfPlane {
  Point2 normal;
  double offset;
};

/// The set as half-planes: the edges of a polygon, moved outward by `along`; for a point or a segment a frame
/// that is `across` wide on both sides and extends the ends by `along`.
inline std::vector<HalfPlane> half_planes(const Convex2& p, double along, double across) {
  std::vector<HalfPlane> r;
  if (p.size() < 3) {
    const Point2 d = p.back() - p.front();
    const double length = norm(d);
    const Point2 u = length > 0 ? 1 / length * d : Point2{1, 0}, v{-u.y, u.x};
    const double ends = length > 0 ? along : across;
    for (const auto& [n, margin] : {std::pair{u, ends}, {-1.0 * u, ends}, {v, across}, {-1.0 * v, across}})
      r.push_back({n, std::max(dot(n, p.front()), dot(n, p.back())) + margin});
    return r;
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point2 d = p[(i + 1) % p.size()] - p[i];
    const double length = norm(d);
    if (!(length > 0)) continue;
    const Point2 n{d.y / length, -d.x / length};
    r.push_back({n, dot(n, p[i]) + along});
  }
  return r;
}

/// 0 inside a polygon.
inline double distance_from_origin(const Convex2& p) {
  double least = norm(p.front());
  bool inside = p.size() >= 3;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point2 &a = p[i], d = p[(i + 1) % p.size()] - a;
    inside = inside && cross(a, d) >= 0;
    const double square = dot(d, d), t = square > 0 ? std::clamp(-dot(a, d) / square, 0.0, 1.0) : 0;
    least = std::min(least, norm(a + t * d));
  }
  return inside ? 0 : least;
}

/// Clips by one half-plane (Sutherland and Hodgman 1974).
inline Convex2 clipped(const Convex2& p, const HalfPlane& h) {
  Convex2 r;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point2 &a = p[i], &b = p[(i + 1) % p.size()];
    const double da = dot(h.normal, a) - h.offset, db = dot(h.normal, b) - h.offset;
    if (da <= 0) r.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) r.push_back(a + da / (da - db) * (b - a));
  }
  return hull_of(r);
}

}  // namespace touchstone::referee
