// The question: does the hull of D = {a_i - b_j} come nearer to the origin than rA + rB? The state is an
// affinely independent set of at most four points of D and the nearest point v of its hull. A step adds the
// point of D that is extreme against v. |v| decreases strictly and there are finitely many sets, so it ends
// (Wolfe 1976, "Finding the nearest point in a polytope"). v is kept only up to a positive factor: v·p is the
// same for all points p of its face, so "v is the nearest point of D" reads v·w >= v·p, and |v|² =
// (v·p)²/(v·v) compares with (rA + rB)² in integers.
#include "oracles/referee/exact_pair.h"

#include <algorithm>
#include <array>

namespace touchstone::referee {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Doubles as integers in units of 2^exponent (the largest that fits them all).
class Grid {
 public:
  void fit(double x) {
    const Parts p = parts_of(x);
    if (p.mantissa == 0) return;
    exponent_ = any_ ? std::min(exponent_, p.exponent) : p.exponent;
    any_ = true;
  }
  void fit(const Vec3& v) { fit(v.x()), fit(v.y()), fit(v.z()); }
  Integer operator()(double x) const {
    const Parts p = parts_of(x);
    return p.mantissa == 0 ? Integer(0) : shifted(Integer(p.mantissa), p.exponent - exponent_);
  }
  Integer3 operator()(const Vec3& v) const { return {(*this)(v.x()), (*this)(v.y()), (*this)(v.z())}; }
  int exponent() const { return exponent_; }

 private:
  int exponent_ = 0;
  bool any_ = false;
};

struct Linear {
  Integer3 row[3];
  Integer denominator = 1;
  int exponent = 0;  // matrix = row·2^exponent/denominator
};

Linear linear_part(const Placement& p) {
  Grid g;
  for (int i = 0; i < 3; ++i) g.fit(Vec3(p.matrix.row(i)));
  Linear l;
  for (int i = 0; i < 3; ++i) l.row[i] = g(Vec3(p.matrix.row(i)));
  l.exponent = g.exponent();
  return l;
}

Linear linear_part(const Pose& p) {
  Grid g;
  const Quat& q = p.rotation;
  g.fit(q.x), g.fit(q.y), g.fit(q.z), g.fit(q.w);
  const Integer x = g(q.x), y = g(q.y), z = g(q.z), w = g(q.w);
  const Integer xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  Linear l;
  l.row[0] = {ww + xx - yy - zz, 2 * (x * y - w * z), 2 * (x * z + w * y)};
  l.row[1] = {2 * (x * y + w * z), ww - xx + yy - zz, 2 * (y * z - w * x)};
  l.row[2] = {2 * (x * z - w * y), 2 * (y * z + w * x), ww - xx - yy + zz};
  l.denominator = ww + xx + yy + zz;
  return l;
}

/// A body's parts, each in integers with an exponent of its own.
struct Scaled {
  Linear linear;
  std::vector<Integer3> turned;  // in 2^turned_exponent/denominator
  int turned_exponent = 0;
  Integer3 translation;
  int translation_exponent = 0;
  std::vector<Integer3> shifts;
  int shift_exponent = 0;
  Parts radius;
};

Scaled scale(const ExactBody& b) {
  Scaled s;
  s.linear = std::visit([](const auto& p) { return linear_part(p); }, b.pose);
  Grid points, place, speed, time;
  for (const Vec3& v : b.core) points.fit(v);
  for (const Vec3& v : b.core) {
    const Integer3 x = points(v);
    s.turned.push_back({dot(s.linear.row[0], x), dot(s.linear.row[1], x), dot(s.linear.row[2], x)});
  }
  s.turned_exponent = points.exponent() + s.linear.exponent;
  const Vec3& t = std::visit([](const auto& p) -> const Vec3& { return p.translation; }, b.pose);
  place.fit(t);
  s.translation = place(t);
  s.translation_exponent = place.exponent();
  speed.fit(b.velocity_to), speed.fit(b.velocity_from);
  for (double x : b.times) time.fit(x);
  for (double x : b.times) s.shifts.push_back(time(x) * (speed(b.velocity_to) - speed(b.velocity_from)));
  s.shift_exponent = speed.exponent() + time.exponent();
  s.radius = parts_of(b.radius);
  return s;
}

int least_exponent(const Scaled& s) {
  int e = std::min(std::min(s.turned_exponent, s.translation_exponent), s.shift_exponent);
  return s.radius.mantissa == 0 ? e : std::min(e, s.radius.exponent);
}

std::vector<Integer3> place(const Scaled& s, int exponent, const Integer& other_denominator) {
  std::vector<Integer3> r;
  const Integer unit_translation =
      shifted(s.linear.denominator * other_denominator, s.translation_exponent - exponent);
  const Integer unit_shift = shifted(s.linear.denominator * other_denominator, s.shift_exponent - exponent);
  const Integer unit_turned = shifted(other_denominator, s.turned_exponent - exponent);
  for (const Integer3& shift : s.shifts) {
    const Integer3 base = unit_translation * s.translation + unit_shift * shift;
    for (const Integer3& x : s.turned) r.push_back(unit_turned * x + base);
  }
  return r;
}

struct Nearest {
  std::array<int, 4> face{};  // indices into the simplex
  int size = 0;
  Integer3 direction;  // positive multiple of the nearest point; zero: the origin is in the hull
  Integer reach;       // direction·p for every p of the face
};

// Nearest point of the affine hull of the face, if it lies in the face's relative interior or on its border.
std::optional<Integer3> foot_in_face(std::span<const Integer3> p) {
  if (p.size() == 1) return p[0];
  if (p.size() == 2) {
    const Integer3 d = p[1] - p[0];
    const Integer dd = dot(d, d), t = -dot(p[0], d);
    if (dd == 0 || t < 0 || t > dd) return std::nullopt;
    return dd * p[0] + t * d;
  }
  if (p.size() == 3) {
    const Integer3 n = cross(p[1] - p[0], p[2] - p[0]);
    if (is_zero(n)) return std::nullopt;
    if (dot(cross(p[1], p[2]), n) < 0 || dot(cross(p[2], p[0]), n) < 0 || dot(cross(p[0], p[1]), n) < 0)
      return std::nullopt;
    return Integer(dot(n, p[0]).sign()) * n;
  }
  const Integer3 m = cross(p[2], p[3]), k = cross(p[0], p[1]);
  const int s[4] = {dot(p[1], m).sign(), -dot(p[0], m).sign(), dot(p[3], k).sign(), -dot(p[2], k).sign()};
  const auto [lo, hi] = std::minmax_element(s, s + 4);
  if (*lo == 0 && *hi == 0) return std::nullopt;
  if (*lo < 0 && *hi > 0) return std::nullopt;
  return Integer3{0, 0, 0};
}

// The face of the simplex whose foot is optimal for the whole simplex (the Kuhn-Tucker conditions, exact).
Nearest nearest_face(std::span<const Integer3> points) {
  const int n = static_cast<int>(points.size());
  for (int size = 1; size <= n; ++size)
    for (int bits = 1; bits < 1 << n; ++bits) {
      Nearest r;
      std::vector<Integer3> face;
      for (int i = 0; i < n; ++i)
        if (bits >> i & 1) face.push_back(points[at(i)]), r.face[at(static_cast<int>(face.size()) - 1)] = i;
      if (static_cast<int>(face.size()) != size) continue;
      const auto foot = foot_in_face(face);
      if (!foot) continue;
      r.size = size;
      r.direction = *foot;
      r.reach = dot(*foot, face[0]);
      const bool optimal = std::all_of(points.begin(), points.end(),
                                       [&](const Integer3& p) { return dot(r.direction, p) >= r.reach; });
      if (optimal) return r;
    }
  throw std::logic_error("referee: a simplex has no nearest face");  // excluded by convexity
}

Integer square(const Integer& x) { return x * x; }

}  // namespace

ExactPair make_exact(const ExactBody& a, const ExactBody& b) {
  const Scaled x = scale(a), y = scale(b);
  ExactPair r;
  r.exponent = std::min(least_exponent(x), least_exponent(y));
  r.denominator = x.linear.denominator * y.linear.denominator;
  r.a = place(x, r.exponent, y.linear.denominator);
  r.b = place(y, r.exponent, x.linear.denominator);
  const auto radius = [&](const Parts& p) -> Integer {
    return p.mantissa == 0 ? Integer(0)
                           : shifted(Integer(p.mantissa), p.exponent - r.exponent) * r.denominator;
  };
  r.radius_a = radius(x.radius);
  r.radius_b = radius(y.radius);
  return r;
}

ExactVerdict decide(const ExactPair& p, std::span<const IndexPair> seed) {
  const Integer radius = p.radius_a + p.radius_b, radius_sq = square(radius);
  std::vector<IndexPair> simplex(seed.begin(), seed.end());
  if (simplex.empty()) simplex.emplace_back(0, 0);
  for (;;) {
    std::vector<Integer3> points;
    for (const auto& [i, j] : simplex) points.push_back(p.a[at(i)] - p.b[at(j)]);
    const Nearest v = nearest_face(points);
    ExactVerdict r;
    for (int i = 0; i < v.size; ++i) r.simplex.push_back(simplex[at(v.face[at(i)])]);
    r.direction = v.direction;
    r.overlap = true;
    const Integer length_sq = dot(v.direction, v.direction);
    if (length_sq == 0 || v.reach == 0) return r;
    const auto compare = square(v.reach).compare(radius_sq * length_sq);
    if (compare < 0) return r;
    int i = 0, j = 0;
    Integer least = dot(v.direction, p.a[0]), most = dot(v.direction, p.b[0]);
    for (std::size_t k = 1; k < p.a.size(); ++k)
      if (const Integer d = dot(v.direction, p.a[k]); d < least) least = d, i = static_cast<int>(k);
    for (std::size_t k = 1; k < p.b.size(); ++k)
      if (const Integer d = dot(v.direction, p.b[k]); d > most) most = d, j = static_cast<int>(k);
    const Integer reach = least - most;
    if (reach > 0 && square(reach) > radius_sq * length_sq) return r.overlap = false, r;
    if (compare == 0) return r.touching = reach == v.reach, r;
    if (reach >= v.reach) return r;  // not reached with compare > 0: the two tests above are exhaustive then
    simplex = r.simplex;
    simplex.emplace_back(i, j);
  }
}

namespace {

Rational3 to_world(const ExactPair& p, const Rational3& x) {
  const Rational unit = p.exponent >= 0 ? Rational(shifted(Integer(1), p.exponent), p.denominator)
                                        : Rational(Integer(1), shifted(p.denominator, -p.exponent));
  return unit * x;
}

Rational3 rational(const Integer3& v) { return {Rational(v.x), Rational(v.y), Rational(v.z)}; }

// Weights of the nearest point of the face's affine hull, which lies in the face.
std::vector<Rational> foot_weights(std::span<const Integer3> p) {
  if (p.size() == 1) return {Rational(1)};
  if (p.size() == 2) {
    const Integer3 d = p[1] - p[0];
    const Rational t(-dot(p[0], d), dot(d, d));
    return {1 - t, t};
  }
  std::vector<Integer> w;
  if (p.size() == 3) {
    const Integer3 n = cross(p[1] - p[0], p[2] - p[0]);
    w = {dot(cross(p[1], p[2]), n), dot(cross(p[2], p[0]), n), dot(cross(p[0], p[1]), n)};
  } else {
    const Integer3 m = cross(p[2], p[3]), k = cross(p[0], p[1]);
    w = {dot(p[1], m), -dot(p[0], m), dot(p[3], k), -dot(p[2], k)};
  }
  Integer sum = 0;
  for (const Integer& x : w) sum += x;
  std::vector<Rational> r;
  for (const Integer& x : w) r.emplace_back(x, sum);
  return r;
}

}  // namespace

Rational3 common_point(const ExactPair& p, const ExactVerdict& v) {
  std::vector<Integer3> face;
  for (const auto& [i, j] : v.simplex) face.push_back(p.a[at(i)] - p.b[at(j)]);
  const std::vector<Rational> weight = foot_weights(face);
  Rational3 a{0, 0, 0}, b{0, 0, 0};
  for (std::size_t k = 0; k < face.size(); ++k) {
    a = a + weight[k] * rational(p.a[at(v.simplex[k].first)]);
    b = b + weight[k] * rational(p.b[at(v.simplex[k].second)]);
  }
  const Integer radius = p.radius_a + p.radius_b;
  // |b - a| <= rA + rB, so the point that divides the segment as the radii do is within rA of a and within rB
  // of b.
  if (radius > 0) a = a + Rational(p.radius_a, radius) * (b - a);
  return to_world(p, a);
}

ExactPlane separating_plane(const ExactPair& p, const ExactVerdict& v) {
  const Integer3 n = Integer(-1) * v.direction;
  Integer most = dot(n, p.a[0]), least = dot(n, p.b[0]);
  for (const Integer3& x : p.a) most = std::max(most, dot(n, x));
  for (const Integer3& x : p.b) least = std::min(least, dot(n, x));
  // |n| in units of 2^-bits, rounded up, until the planes that the balls push apart still leave room.
  for (unsigned bits = 0;; bits += 64) {
    const Integer length = sqrt(Integer(dot(n, n) << (2 * bits))) + 1;
    const Integer from = (most << bits) + p.radius_a * length, to = (least << bits) - p.radius_b * length;
    if (from >= to && p.radius_a + p.radius_b > 0) continue;
    const Rational scale(Integer(1), Integer(1) << (bits + 1));
    const Rational middle = scale * Rational(from + to);
    // World units: x = k·2^exponent/denominator, with n taken as it is.
    return {rational(n), to_world(p, {middle, 0, 0}).x};
  }
}

}  // namespace touchstone::referee
