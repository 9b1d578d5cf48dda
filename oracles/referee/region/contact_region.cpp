// Given a normal n and a slack, which parts of A and B face each other across the contact plane? For
// polytopes the feature along n is the hull of the vertices within slack of the support plane; projected onto
// the plane and intersected, the two features form a convex polygon (or segment, or point). Whether a vertex
// belongs is decided with the filter's error bounds, and in rationals where those do not suffice; the polygon
// is then clipped in doubles relative to A's origin (Sutherland and Hodgman 1974).
//
// Error: a projected vertex is off by the rounding of its two coordinates, at most 8 units (of doubles) of
// the features' size; a corner of the clipped polygon by that over the sine of the angle between its two
// edges. Edges closer to parallel than the error over their length make corners that are still nearly on both
// edges: the area is off by at most error·perimeter.
#include "oracles/referee/region/contact_region.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>

#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/filter/convex.h"
#include "oracles/referee/region/plane_polygon.h"
#include "oracles/referee/solid/solid.h"

namespace touchstone::referee {
namespace {

/// Extreme points, relative to the origin.
struct Extremes {
  std::vector<Real3> points;
  Real error = 0;
};

/// Cosine and sine of the corners of a regular polygon, the first at angle 0.
const std::array<std::array<Real, 2>, rim_corners>& corners() {
  static const auto table = [] {
    std::array<std::array<Real, 2>, rim_corners> t;
    for (int k = 0; k < rim_corners; ++k) {
      const Real angle = 2 * std::numbers::pi_v<Real> * k / rim_corners;
      t[static_cast<std::size_t>(k)] = {std::cos(angle), std::sin(angle)};
    }
    return t;
  }();
  return table;
}

// The first corner is the highest along n; when the rim leans enough, the others are below it by more than
// the slack and would be dropped again.
void add_rim(Extremes& e, const Solid& s, Real height, const Real3& n, Real slack) {
  const Real3 u = column(s.matrix, 0), v = column(s.matrix, 1), w = column(s.matrix, 2);
  const Real x = dot(u, n), y = dot(v, n), lean = std::sqrt(x * x + y * y);
  const Real cos = lean > 0 ? x / lean : 1, sin = lean > 0 ? y / lean : 0;
  const Real3 first = cos * u + sin * v, second = cos * v - sin * u;
  const Real next_below = s.size.x * lean / norm(n) * (1 - corners()[1][0]);
  for (const auto& [along, across] : corners()) {
    e.points.push_back(s.centre + height * w + s.size.x * (along * first + across * second));
    if (next_below > 2 * slack + chain_rounding * s.extent) break;
  }
}

Extremes extremes_of(const Placed& p, const Vec3& origin, const Real3& n, Real slack) {
  Extremes e;
  const Solid s = make_body(p, frame_of(p, origin));
  e.error = s.error + projection_rounding * s.extent;
  if (s.kind == Solid::Kind::points) {
    e.points = s.points;
  } else if (s.kind == Solid::Kind::ellipsoid) {
    e.points = {support(s, n).point};
  } else {
    add_rim(e, s, -s.size.y, n, slack);
    if (s.kind == Solid::Kind::cylinder)
      add_rim(e, s, s.size.y, n, slack);
    else
      e.points.push_back(s.centre + s.size.y * column(s.matrix, 2));
  }
  return e;
}

/// Decides in rationals which vertices of a core are within slack of the support plane.
class ExactFeature {
 public:
  ExactFeature(const Placed& p, const Vec3& direction, double slack)
      : points_(world_points({*core_points(p), core_form(p).radius, p.pose})),
        n_(exact(direction)),
        limit_(exact(slack) * exact(slack) * dot(n_, n_)) {
    top_ = dot(n_, points_.front());
    for (const Rational3& x : points_) top_ = std::max(top_, dot(n_, x));
  }
  // (top - n·x)/|n| <= slack
  bool has(std::size_t i) const {
    const Rational below = top_ - dot(n_, points_[i]);
    return below * below <= limit_;
  }

 private:
  std::vector<Rational3> points_;
  Rational3 n_;
  Rational limit_, top_;
};

/// The points of the feature, and the height of the support plane over the origin, in units of |n|.
struct Feature {
  std::vector<Real3> points;
  Real height = 0;
};

Feature feature_of(const Placed& p, const Vec3& origin, const Vec3& direction, double slack) {
  const Real3 n = to_real(direction);
  const Real length = norm(n);
  const Extremes e = extremes_of(p, origin, n, slack);
  Feature f;
  f.height = -std::numeric_limits<Real>::infinity();
  for (const Real3& x : e.points) f.height = std::max(f.height, dot(n, x) / length);
  const bool has_vertices = core_form(p).has_points();
  std::optional<ExactFeature> decide;
  for (std::size_t i = 0; i < e.points.size(); ++i) {
    const Real below = f.height - dot(n, e.points[i]) / length - slack;
    bool belongs = below <= 0;
    if (has_vertices && std::fabs(below) <= 4 * e.error) {
      if (!decide) decide.emplace(p, direction, slack);
      belongs = decide->has(i);
    }
    if (belongs) f.points.push_back(e.points[i]);
  }
  f.height += core_form(p).radius;
  return f;
}

/// The plane through the origin with its two axes; x ⨯ y = normal.
struct ProjectionPlane {
  Real3 normal, x, y;
  explicit ProjectionPlane(const Vec3& n) : normal(normalized(to_real(n))) {
    x = unit_across(perpendicular(normal), normal);
    y = cross(normal, x);
  }
  Point2 project(const Real3& p) const {
    return {static_cast<double>(dot(x, p)), static_cast<double>(dot(y, p))};
  }
};

Convex2 projected(const std::vector<Real3>& points, const ProjectionPlane& plane) {
  std::vector<Point2> p;
  for (const Real3& v : points) p.push_back(plane.project(v));
  return hull_of(std::move(p));
}

std::pair<Point2, Point2> farthest(const Convex2& p) {
  std::pair<Point2, Point2> best{p.front(), p.front()};
  double most = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      const Point2 d = p[j] - p[i];
      if (const double square = dot(d, d); square > most) {
        most = square;
        best = {p[i], p[j]};
      }
    }
  return best;
}

// A set thinner than the margin all round becomes a point; thinner on two sides, a segment.
Convex2 simplified(const Convex2& p, double margin) {
  if (p.empty()) return p;
  const auto [a, b] = farthest(p);
  const double diameter = norm(b - a);
  if (diameter <= 4 * margin) return {0.5 * (a + b)};
  if (p.size() < 3 || area_of(p) <= 4 * margin * diameter) return {a, b};
  return p;
}

// Intersects the sets as given; when they miss each other and one of them is thin, extends them by the
// margin.
Convex2 intersection(const Convex2& a, const Convex2& b, double margin) {
  const bool thin = a.size() < 3 || b.size() < 3;
  const Convex2 &whole = a.size() >= b.size() ? b : a, &frame = a.size() >= b.size() ? a : b;
  for (const double along : {0.0, margin}) {
    Convex2 r = whole;
    for (const HalfPlane& h : half_planes(frame, along, margin))
      if (!r.empty()) r = clipped(r, h);
    if (!r.empty() || !thin) return r;
  }
  return {};
}

ContactRegion region_of(const Convex2& p, const ProjectionPlane& plane, Real height, const Vec3& origin) {
  ContactRegion r;
  using K = ContactRegion::Kind;
  r.kind = p.empty() ? K::none : p.size() == 1 ? K::point : p.size() == 2 ? K::segment : K::polygon;
  for (const Point2& q : p)
    r.vertices.push_back(to_double(static_cast<Real>(q.x) * plane.x + static_cast<Real>(q.y) * plane.y +
                                   height * plane.normal + to_real(origin)));
  if (r.kind == K::polygon) r.area = area_of(p);
  if (r.kind == K::segment) r.length = norm(p[1] - p[0]);
  return r;
}

// Against a half-space the contact plane is its boundary, and the region is the feature of the other body.
ContactRegion region_on_half_space(const Placed& other, const Vec3& out_of_other, bool other_is_a,
                                   const Vec3& normal, const Placed& half_space, double slack) {
  const Vec3 origin = translation_of(other);
  const ProjectionPlane plane(normal);
  const Feature f = feature_of(other, origin, out_of_other, slack);
  const RationalPlane bound = world_plane(half_space);
  const Rational sq = dot(bound.normal, bound.normal);
  if (sq == 0) return {};
  const Real at =
      (bound.offset - dot(bound.normal, exact(origin))).convert_to<Real>() / std::sqrt(sq.convert_to<Real>());
  // Heights along the normal: the half-space ends at `at` along its own outward normal, which is
  // -out_of_other.
  const Real side = other_is_a ? 1 : -1;
  return region_of(simplified(projected(f.points, plane), slack), plane, side * 0.5L * (f.height - at),
                   origin);
}

/// A point of the plane through a side of a prism: along the side, and below the face.
struct Deep {
  double along, below;
};

// The lower border of the points' hull, as long as it does not bend by less than the slack.
std::vector<Deep> deepest_of(std::vector<Deep> p, double slack) {
  std::sort(p.begin(), p.end(), [](const Deep& a, const Deep& b) {
    return a.along < b.along || (a.along == b.along && a.below < b.below);
  });
  std::vector<Deep> chain;
  const auto is_corner = [&](const Deep& a, const Deep& b, const Deep& c) {
    const double x = c.along - a.along, y = c.below - a.below;
    return x * (b.below - a.below) - y * (b.along - a.along) > slack * std::hypot(x, y);
  };
  for (const Deep& q : p) {
    while (chain.size() >= 2 && !is_corner(chain[chain.size() - 2], chain.back(), q)) chain.pop_back();
    chain.push_back(q);
  }
  return chain;
}

// How deep the chain is within the slack of a place, if it is there.
std::optional<double> depth_at(const std::vector<Deep>& chain, double along, double slack) {
  std::optional<double> deepest;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Deep &a = chain[i], &b = chain[i + 1];
    if (!(a.along - slack <= along && along <= b.along + slack)) continue;
    const bool is_steep = b.along - a.along <= 2 * slack;
    const double t = is_steep ? 0 : std::clamp((along - a.along) / (b.along - a.along), 0.0, 1.0);
    const double below = is_steep ? std::max(a.below, b.below) : a.below + t * (b.below - a.below);
    deepest = std::max(below, deepest.value_or(below));
  }
  return deepest;
}

/// A point of the other body: in the plane of a face, and how far below it.
struct Sunk {
  Point2 at;
  double below;
};

// Where the plane through p and q, along the normal, cuts the chords between the points; and the points that
// are as near to it as `near`.
std::vector<Deep> cut(const std::vector<Sunk>& points, const Point2& p, const Point2& q, double near) {
  const Point2 along = 1 / norm(q - p) * (q - p);
  std::vector<Deep> r;
  for (const Sunk& a : points) {
    const double side_a = cross(along, a.at - p);
    if (std::abs(side_a) <= near) r.push_back({dot(along, a.at - p), a.below});
    if (!(side_a > 0)) continue;
    for (const Sunk& b : points) {
      const double side_b = cross(along, b.at - p);
      if (!(side_b < 0)) continue;
      const double t = side_a / (side_a - side_b);
      r.push_back({dot(along, a.at - p) + t * dot(along, b.at - a.at), a.below + t * (b.below - a.below)});
    }
  }
  return r;
}

// Whether the hull of the points is deeper there than the point.
bool is_covered(const Sunk& p, const std::vector<Sunk>& points, double slack) {
  const std::optional<double> below =
      depth_at(deepest_of(cut(points, p.at, p.at + Point2{1, 0}, slack), slack), 0, slack);
  return below && *below > p.below + slack;
}

std::vector<Sunk> corners_beyond(const Convex2& face, const std::vector<Sunk>& points, double slack) {
  std::vector<Sunk> r;
  const auto sides = half_planes(face, 0, 0);
  for (const Sunk& p : points)
    if (p.below > slack &&
        std::all_of(sides.begin(), sides.end(),
                    [&](const HalfPlane& h) { return dot(h.normal, p.at) <= h.offset; }) &&
        !is_covered(p, points, slack))
      r.push_back(p);
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Point2 &p = face[i], &q = face[(i + 1) % face.size()];
    const double length = norm(q - p);
    const std::vector<Deep> chain = deepest_of(cut(points, p, q, 0), slack);
    for (const Deep& d : chain)
      if (d.along > slack && d.along < length - slack && d.below > slack)
        r.push_back({p + d.along / length * (q - p), d.below});
    if (const auto below = depth_at(chain, 0, slack); below && *below > slack) r.push_back({p, *below});
  }
  return r;
}

}  // namespace

std::optional<std::vector<Vec3>> corners_beyond_face(const Placed& face, const Placed& body,
                                                     const Vec3& face_normal, double slack) {
  const auto is_convex = [](const Placed& p) { return !is<TriangleMesh>(p) && !is<HalfSpace>(p); };
  if (has_solid(face, body) || !is_convex(face) || !is_convex(body)) return std::nullopt;
  const Vec3 origin = translation_of(face);
  const ProjectionPlane plane(face_normal);
  const Feature f = feature_of(face, origin, face_normal, slack);
  const Convex2 outline = simplified(projected(f.points, plane), slack);
  if (outline.size() < 3) return std::nullopt;
  std::vector<Sunk> points;
  for (const Real3& x : extremes_of(body, origin, to_real(-face_normal), slack).points) {
    const Real below = f.height - dot(plane.normal, x) + core_form(body).radius;
    points.push_back({plane.project(x), static_cast<double>(below)});
  }
  std::vector<Vec3> r;
  for (const Sunk& c : corners_beyond(outline, points, slack))
    r.push_back(to_double(static_cast<Real>(c.at.x) * plane.x + static_cast<Real>(c.at.y) * plane.y +
                          (f.height - static_cast<Real>(c.below) / 2) * plane.normal + to_real(origin)));
  return r;
}

ContactRegion contact_region(const Placed& a, const Placed& b, const Vec3& normal_ab, double slack) {
  return contact_region(a, b, normal_ab, slack, slack);
}

ContactRegion contact_region(const Placed& a, const Placed& b, const Vec3& normal_ab, double slack_a,
                             double slack_b) {
  if (has_solid(a, b)) {
    const AsHulls hulls(a, b);
    return hulls.are_plain() ? contact_region(hulls.a(), hulls.b(), normal_ab, slack_a, slack_b)
                             : ContactRegion{};
  }
  if (is<TriangleMesh>(a) || is<TriangleMesh>(b) || (is<HalfSpace>(a) && is<HalfSpace>(b))) return {};
  ContactRegion r;
  double size = 0;
  if (is<HalfSpace>(a)) {
    r = region_on_half_space(b, -normal_ab, false, normal_ab, a, slack_b);
    size = bounding_radius(*b.shape);
  } else if (is<HalfSpace>(b)) {
    r = region_on_half_space(a, normal_ab, true, normal_ab, b, slack_a);
    size = bounding_radius(*a.shape);
  } else {
    const Vec3 origin = translation_of(a);
    const ProjectionPlane plane(normal_ab);
    const Feature x = feature_of(a, origin, normal_ab, slack_a),
                  y = feature_of(b, origin, -normal_ab, slack_b);
    const double margin = std::min(slack_a, slack_b);
    const Convex2 common = intersection(simplified(projected(x.points, plane), margin),
                                        simplified(projected(y.points, plane), margin), margin);
    r = region_of(simplified(common, margin), plane, 0.5L * (x.height - y.height), origin);
    size = bounding_radius(*a.shape) + bounding_radius(*b.shape) + (translation_of(b) - origin).stableNorm();
  }
  double far = 0;
  for (const Vec3& v : r.vertices) far = std::max(far, v.cwiseAbs().maxCoeff());
  r.error = unit_of<double> * (8 * size + 2 * far);
  return r;
}

std::optional<double> covered_share(const ContactRegion& region, const std::vector<Vec3>& points,
                                    const Vec3& normal) {
  using K = ContactRegion::Kind;
  if (region.kind != K::polygon && region.kind != K::segment) return std::nullopt;
  if (points.empty()) return 0.0;
  const ProjectionPlane plane(normal);
  const Vec3& origin = region.vertices.front();
  const auto about = [&](const std::vector<Vec3>& v) {
    std::vector<Real3> r;
    for (const Vec3& p : v) r.push_back(to_real(p) - to_real(origin));
    return projected(r, plane);
  };
  Convex2 part = about(points);
  const Convex2 whole = about(region.vertices);
  if (region.kind == K::segment) {
    // Only the position along the segment counts.
    const Point2 way = whole.back() - whole.front();
    double lo = 1, hi = 0;
    for (const Point2& p : part) {
      const double t = std::clamp(dot(p - whole.front(), way) / dot(way, way), 0.0, 1.0);
      lo = std::min(lo, t);
      hi = std::max(hi, t);
    }
    return std::max(0.0, hi - lo);
  }
  if (part.size() < 3) return 0.0;
  for (const HalfPlane& h : half_planes(whole, 0, 0))
    if (!part.empty()) part = clipped(part, h);
  return std::min(1.0, area_of(part) / area_of(whole));
}

std::optional<bool> holds_centroid(const ContactRegion& region, const std::vector<Vec3>& points,
                                   const Vec3& normal) {
  using K = ContactRegion::Kind;
  if (region.kind != K::polygon && region.kind != K::segment) return std::nullopt;
  if (points.empty()) return false;
  constexpr double margin_factor = 1e-3;  // of the diameter
  const ProjectionPlane plane(normal);
  const Vec3& origin = region.vertices.front();
  const auto about = [&](const std::vector<Vec3>& v) {
    std::vector<Real3> r;
    for (const Vec3& p : v) r.push_back(to_real(p) - to_real(origin));
    return projected(r, plane);
  };
  const Convex2 whole = about(region.vertices), part = about(points);
  const auto [a, b] = farthest(whole);
  const double margin = margin_factor * norm(b - a);
  const Point2 centroid = centroid_of(whole);
  const auto frames = half_planes(part, margin, margin);
  return std::all_of(frames.begin(), frames.end(),
                     [&](const HalfPlane& h) { return dot(h.normal, centroid) <= h.offset; });
}

std::vector<double> corner_heights(const Placed& body, const Vec3& normal) {
  if (kind_of(*body.shape) == ShapeKind::half_space) return {};
  const Vec3 origin = translation_of(body);
  const Real3 n = to_real(normal);
  std::vector<double> heights;
  for (const Real side : {1, -1})  // the highest points of rims, and the lowest
    for (const Real3& x : extremes_of(body, origin, side * n, 0).points)
      heights.push_back(static_cast<double>(dot(n, x) / norm(n)));
  std::sort(heights.begin(), heights.end(), std::greater<>());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  const double top = heights.front();
  for (double& h : heights) h = top - h;
  return heights;
}

double spanned_area(const std::vector<Vec3>& points, const Vec3& normal) {
  if (points.size() < 3) return 0;
  std::vector<Real3> about;
  for (const Vec3& p : points) about.push_back(to_real(p) - to_real(points.front()));
  return area_of(projected(about, ProjectionPlane(normal)));
}

double spanned_length(const std::vector<Vec3>& points, const Vec3& normal) {
  if (points.empty()) return 0;
  std::vector<Real3> about;
  for (const Vec3& p : points) about.push_back(to_real(p) - to_real(points.front()));
  const auto [a, b] = farthest(projected(about, ProjectionPlane(normal)));
  return norm(b - a);
}

double distance_from_span(const Vec3& p, const std::vector<Vec3>& points, const Vec3& normal) {
  const ProjectionPlane plane(normal);
  std::vector<Real3> about;
  Interval<double> heights{infinity, -infinity};
  for (const Vec3& q : points) {
    about.push_back(to_real(q) - to_real(p));
    const double height = static_cast<double>(dot(plane.normal, about.back()));
    heights = {std::min(heights.lo, height), std::max(heights.hi, height)};
  }
  return std::hypot(distance_from_origin(projected(about, plane)), std::max({0.0, heights.lo, -heights.hi}));
}

}  // namespace touchstone::referee
