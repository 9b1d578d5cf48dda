#include "oracles/checker/checker_set.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/base/input_error.h"

namespace touchstone::checker {
namespace {

// Our certificates have a few thousand digits at most; beyond this, checking one takes longer than anyone
// will wait.
constexpr std::size_t max_digits = 50'000;

// Whether s is digits only, without leading zeros.
bool is_whole(std::string_view s) {
  return !s.empty() && s.size() <= max_digits && (s.size() == 1 || s[0] != '0') &&
         s.find_first_not_of("0123456789") == std::string_view::npos;
}

using Z = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

// R(q)·x for the quaternion q = (v, w), not zero and not necessarily unit.
V rotated(const V& v, const Q& w, const V& x) {
  return 1 / Q(dot(v, v) + w * w) * (2 * dot(v, x) * v + (w * w - dot(v, v)) * x + 2 * w * cross(v, x));
}

Set placed_axes(const Placed& p, const Carrier& by) {
  Set s;
  for (int i = 0; i < 3; ++i) {
    V& c = s.column[i];
    if (const auto* pose = std::get_if<Pose>(&p.pose)) {
      const Quat& q = pose->rotation;
      c = rotated({Q(q.x), Q(q.y), Q(q.z)}, Q(q.w), {Q(i == 0), Q(i == 1), Q(i == 2)});
    } else {
      c = exact_value(Vec3(std::get<Placement>(p.pose).matrix.col(i)));
    }
    if (dot(by.v, by.v) != 0) c = rotated(by.v, by.w, c);
  }
  s.origin = std::visit([](const auto& pose) { return exact_value(pose.translation); }, p.pose) + by.shift;
  return s;
}

/// In local coordinates: the round piece {centre + Σ u_k·radii_k·e_k, |u| <= 1}.
struct Piece {
  Vec3 centre, radii = Vec3::Zero();
};
using Pieces = std::vector<Piece>;

/// The round pieces of each convex part, and the ball around them.
struct Form {
  std::vector<Pieces> parts;
  double ball = 0;
};

/// The checker's table of shapes: one row for each.
struct FormOf {
  Form operator()(const Sphere& s) const { return convex({{Vec3::Zero()}}, s.radius); }
  Form operator()(const Box& s) const { return convex(corners(s.half_extents)); }
  Form operator()(const RoundedBox& s) const { return convex(corners(s.half_extents), s.radius); }
  Form operator()(const Capsule& s) const {
    return convex({{Vec3(0, 0, -s.half_height)}, {Vec3(0, 0, s.half_height)}}, s.radius);
  }
  Form operator()(const Cylinder& s) const { return discs(s.radius, s.radius, s.half_height); }
  Form operator()(const Cone& s) const { return discs(s.radius, 0, s.half_height); }
  Form operator()(const Ellipsoid& s) const { return convex({{Vec3::Zero(), s.semi_axes}}); }
  Form operator()(const Hull& s) const {
    Pieces points;
    for (const Vec3& v : s.vertices) points.push_back({v});
    return convex(std::move(points));
  }
  template <class S>
  Form operator()(const Padded<S>& s) const {
    Form f = (*this)(s.inner);
    f.ball = s.padding;
    return f;
  }
  Form operator()(const TriangleMesh& s) const {
    Form f;
    const auto at = [&](int k) { return s.vertices[static_cast<std::size_t>(k)]; };
    for (const auto& t : s.triangles) f.parts.push_back({{at(t[0])}, {at(t[1])}, {at(t[2])}});
    return f;
  }
  Form operator()(const HalfSpace&) const { return {}; }  // not bounded: see half_space()

 private:
  static Form convex(Pieces pieces, double ball = 0) {
    Form f;
    f.parts.push_back(std::move(pieces));
    f.ball = ball;
    return f;
  }
  static Pieces corners(const Vec3& half) {
    Pieces points;
    for (int i = 0; i < 8; ++i)
      points.push_back({half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1))});
    return points;
  }
  static Form discs(double below, double above, double h) {
    return convex({{Vec3(0, 0, -h), Vec3(below, below, 0)}, {Vec3(0, 0, h), Vec3(above, above, 0)}});
  }
};

Set placed(Set s, const Pieces& pieces) {
  for (const auto& [centre, radii] : pieces) {
    const V c = exact_value(centre), r = exact_value(radii);
    s.core.push_back({c.x * s.column[0] + c.y * s.column[1] + c.z * s.column[2] + s.origin, {}});
    if (!radii.isZero(0)) s.core.back().axes = {r.x * s.column[0], r.y * s.column[1], r.z * s.column[2]};
  }
  const auto& [centre, radii] = pieces.front();
  if (radii.isZero(0)) return s;
  s.kind = pieces.size() == 1 ? Set::Kind::ellipsoid : Set::Kind::discs;
  s.size =
      exact_value(pieces.size() == 1 ? radii : Vec3(radii.x(), pieces[1].radii.x(), pieces[1].centre.z()));
  return s;
}

// {Mx + t : m·x <= o} = {y : C m·(y - t) <= o·det M}, C the cofactor matrix of M; both sides change sign with
// det M.
std::vector<Set> half_space(Set s, const HalfSpace& x) {
  const V &a = s.column[0], &b = s.column[1], &c = s.column[2], m = exact_value(x.normal);
  const Q det = dot(a, cross(b, c));
  if (det == 0) return {};
  s.kind = Set::Kind::half_space;
  s.normal = Q(det.sign()) * (m.x * cross(b, c) + m.y * cross(c, a) + m.z * cross(a, b));
  s.offset = abs(det) * Q(x.offset) + dot(s.normal, s.origin);
  return {s};
}

// Local coordinates of a curved set by Cramer's rule.
std::optional<V> local_of(const Set& s, const V& x) {
  const V &a = s.column[0], &b = s.column[1], &c = s.column[2], d = x - s.origin;
  const Q det = dot(a, cross(b, c));
  if (det == 0) return std::nullopt;
  return 1 / det * V{dot(d, cross(b, c)), dot(a, cross(d, c)), dot(a, cross(b, d))};
}

// In local coordinates, moves of g along each axis (g across the axis of discs) are at most √2·g together,
// and at most twice as much in the world when |M|² <= 4: r in total for g = r/4.
bool is_within_curved(const Set& s, const V& x, const Q& r) {
  const V &a = s.column[0], &b = s.column[1], &c = s.column[2];
  if (r > 0 && dot(a, a) + dot(b, b) + dot(c, c) > 4) return false;
  const auto local = local_of(s, x);
  if (!local) return false;
  const V& u = *local;
  const Q g = r / 4;
  if (s.kind == Set::Kind::ellipsoid) {
    Q sum = 0;
    for (const auto& [at, axis] :
         {std::pair(u.x, s.size.x), std::pair(u.y, s.size.y), std::pair(u.z, s.size.z)}) {
      if (const Q room = axis + g; room > 0)
        sum += at * at / (room * room);
      else if (at != 0)  // flat across this axis
        return false;
    }
    return sum <= 1;
  }
  const auto& [low, high, h] = s.size;  // low >= high: the room is widest at the lowest z in reach
  const Q z = std::max(Q(-h), Q(u.z - g)),
          room = (h > 0 ? Q(low + (high - low) * (z + h) / (2 * h)) : low) + g;
  return abs(u.z) <= h + g && u.x * u.x + u.y * u.y <= room * room;
}

// Bisections of an interval of doubles: more than separate any two of them in it.
constexpr int bisections = 128;
// What is left of a point of the surface, which rounding may have put outside: by a few of its roundings
// less, and by far more in case they were not enough. Tested by: tests/referee "the checker finds a point of
// a curved core within reach, and none beyond it".
constexpr double shares_inside[] = {1 - 0x1p-49, 1 - 0x1p-40};

// In rounded arithmetic, a point of the ellipsoid or between the discs near u, which is outside.
Vec3 near_point(const Set& s, const Vec3& u) {
  const auto number = [](const Q& q) { return q.convert_to<double>(); };
  if (s.kind == Set::Kind::ellipsoid) {
    // u_i·a_i²/(t + a_i²), with the t >= 0 that makes it a point of the surface.
    const Vec3 semi(number(s.size.x), number(s.size.y), number(s.size.z));
    double low = 0, high = semi.maxCoeff() * u.norm();
    for (int step = 0; step < bisections; ++step) {
      const double t = low + (high - low) / 2;
      const bool is_outside =
          (u.array() * semi.array() / (semi.array().square() + t)).matrix().squaredNorm() > 1;
      (is_outside ? low : high) = t;
    }
    return u.array() * semi.array().square() / (semi.array().square() + high);
  }
  using Point = Eigen::Vector2d;  // across and along the axis
  const double h = number(s.size.z), across = std::hypot(u.x(), u.y());
  const Point at(across, u.z()), corner[] = {{0, -h}, {number(s.size.x), -h}, {number(s.size.y), h}, {0, h}};
  Point best = corner[0];
  for (std::size_t i = 0; i < 3; ++i) {
    const Point side = corner[i + 1] - corner[i];
    const double square = side.squaredNorm(),
                 share = square > 0 ? std::clamp((at - corner[i]).dot(side) / square, 0.0, 1.0) : 0;
    const Point near = corner[i] + share * side;
    if ((near - at).squaredNorm() < (best - at).squaredNorm()) best = near;
  }
  const double k = across > 0 ? best.x() / across : 0;
  return {k * u.x(), k * u.y(), best.y()};
}

// A point of the core, decided exactly, that is at most r from x.
bool has_point_near(const Set& s, const V& x, const Q& r) {
  const auto local = local_of(s, x);
  if (!local) return false;
  const Vec3 near = near_point(
      s, {local->x.convert_to<double>(), local->y.convert_to<double>(), local->z.convert_to<double>()});
  if (!near.allFinite()) return false;
  return std::any_of(std::begin(shares_inside), std::end(shares_inside), [&](double share) {
    const V p = exact_value(Vec3(share * near));
    const V y = p.x * s.column[0] + p.y * s.column[1] + p.z * s.column[2] + s.origin;
    return dot(y - x, y - x) <= r * r && is_within_curved(s, y, 0);
  });
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

// Nearest point of a hull to the origin (Wolfe 1976), or an earlier one for which stop(v, far) holds: v is in
// the hull, and `far` is the point of p with the least product with v.
template <class Stop>
V nearest_until(const std::vector<V>& p, Stop&& stop) {
  std::vector<V> face{p.front()};
  std::vector<Q> weight{1};
  for (;;) {
    V v{0, 0, 0};
    for (std::size_t i = 0; i < face.size(); ++i) v = v + weight[i] * face[i];
    const V* far = &p.front();
    Q least = dot(v, *far);
    for (const V& q : p)
      if (Q product = dot(v, q); product < least) {
        least = std::move(product);
        far = &q;
      }
    if (const Q square = dot(v, v); least >= square || stop(square, least)) return v;
    face.push_back(*far);
    weight.emplace_back(0);
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

// Multiplies the points by the least factor that makes them whole numbers, which are products and sums
// without greatest common divisors. Returns the factor.
Q make_whole(std::vector<V>& points) {
  Z factor = 1;
  for (const V& v : points)
    for (const Q* x : {&v.x, &v.y, &v.z}) factor = lcm(factor, denominator(*x));
  const Q by = factor;
  for (V& v : points) v = by * v;
  return by;
}

}  // namespace

// Lowest terms are not required, but the denominator must have no sign and not be zero: GMP relies on both.
Q rational_of(const std::string& s) {
  const auto slash = std::min(s.find('/'), s.size());
  const std::string numerator = s.substr(0, slash),
                    denominator = slash < s.size() ? s.substr(slash + 1) : "1";
  if (is_whole(std::string_view(numerator).substr(numerator.starts_with('-') ? 1 : 0)) &&
      is_whole(denominator) && denominator != "0")
    return Q(Z(numerator), Z(denominator));
  constexpr std::size_t shown = 40;
  throw InputError("", "is not a rational number \"n/d\" of at most " + std::to_string(max_digits) +
                           " digits (" + (s.size() > shown ? s.substr(0, shown) + "..." : s) + ")");
}

Q times_root(const Q& factor, const Q& square) {
  const Z d = denominator(square), scaled = (numerator(square) * d) << 1024, root = sqrt(scaled);
  const bool up = factor > 0 && root * root != scaled;  // √(n/d) = √(n·d)/d
  return factor * Q(up ? Z(root + 1) : root, d << 512);
}

std::vector<Set> sets_of(const Placed& p, const Carrier& by) {
  Set axes = placed_axes(p, by);
  if (const auto* h = std::get_if<HalfSpace>(p.shape)) return half_space(axes, *h);
  const Form form = std::visit(FormOf{}, *p.shape);
  axes.ball = Q(form.ball);
  std::vector<Set> r;
  for (const Pieces& part : form.parts) r.push_back(placed(axes, part));
  return r;
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
    const Q h = dot(piece.centre, n) + (square > 0 ? times_root(1, square) : Q(0));
    if (!best || h > *best) best = h;
  }
  return best;
}

bool is_within(const Set& s, const V& x, const Q& r) {
  if (s.kind == Set::Kind::half_space) return dot(s.normal, x) <= s.offset;
  if (s.kind != Set::Kind::hull) return is_within_curved(s, x, r) || (r > 0 && has_point_near(s, x, r));
  std::vector<V> about;
  for (const Set::Round& piece : s.core) about.push_back(piece.centre - x);
  const Q reach = r * make_whole(about), limit = reach * reach;
  // A point of the hull within reach, or a plane between the hull and all that is within reach, ends the
  // search.
  const V v = nearest_until(about, [&](const Q& square, const Q& least) {
    return square <= limit || (least > 0 && least * least > limit * square);
  });
  return dot(v, v) <= limit;
}

std::optional<int> crossing(const V& a, const V& b, const V& c, const V& ray) {
  const int side = dot(a, cross(b, c)).sign();
  const int part[] = {dot(ray, cross(b, c)).sign() * side, dot(ray, cross(c, a)).sign() * side,
                      dot(ray, cross(a, b)).sign() * side};
  const int least = *std::min_element(part, part + 3);
  if (side == 0 || least < 0) return 0;
  return least > 0 ? std::optional<int>(side) : std::nullopt;
}

std::optional<bool> is_enclosed(const std::vector<Set>& triangles, const V& x) {
  const auto corner = [&](const Set& t, std::size_t k) { return t.core[k].centre - x; };
  for (const V& ray : {V{1, Q(1009, 1013), Q(-499, 997)}, V{Q(-311, 313), 1, Q(769, 773)},
                       V{Q(107, 109), Q(-211, 223), 1}}) {
    int crossings = 0;
    bool is_clean = true;
    for (const Set& t : triangles) {
      const auto more = crossing(corner(t, 0), corner(t, 1), corner(t, 2), ray);
      is_clean = is_clean && more;
      crossings += more.value_or(0);
    }
    if (is_clean) return crossings != 0;
  }
  return std::nullopt;
}

bool are_not_nested(const Placed& a, const std::vector<Set>& sets_a, const Placed& b,
                    const std::vector<Set>& sets_b) {
  const auto is_solid = [](const Placed& p) { return std::holds_alternative<SolidMesh>(*p.shape); };
  // A point of each part: the centre of its first piece.
  const auto are_outside = [](const std::vector<Set>& solid, const std::vector<Set>& other) {
    return std::all_of(other.begin(), other.end(), [&](const Set& s) {
      return s.kind == Set::Kind::half_space || is_enclosed(solid, s.core.front().centre) == false;
    });
  };
  return (!is_solid(a) || are_outside(sets_a, sets_b)) && (!is_solid(b) || are_outside(sets_b, sets_a));
}

bool is_clear_of_ball(const std::array<V, 3>& t, const Q& r) {
  const V n = cross(t[1] - t[0], t[2] - t[0]);
  const Q along = dot(n, t[0]), nn = dot(n, n);
  if (along != 0 && along * along >= r * r * nn) return true;
  const V near = nearest_until({t[0], t[1], t[2]}, [](const Q&, const Q&) { return false; });
  return dot(near, near) != 0 && dot(near, near) >= r * r;
}

}  // namespace touchstone::checker
