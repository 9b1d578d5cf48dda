// Does the hull of D = {a_i - b_j} come nearer to the origin than rA + rB? The state is an affinely
// independent set of at most four points of D and the nearest point v of its hull. Each step adds the point
// of D that is extreme in the direction -v. |v| decreases strictly and there are finitely many sets, so it
// terminates (Wolfe 1976, "Finding the nearest point in a polytope"). v is kept only up to a positive factor:
// v·p is the same for all points p of its face, so "v is the nearest point of D" reads v·w >= v·p, and |v|² =
// (v·p)²/(v·v) is compared with (rA + rB)² in integers.
#include "oracles/referee/exact/exact_pair.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <limits>

#include "oracles/referee/exact/rational.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <class I>
I scaled(I x, int bits) {
  x <<= static_cast<unsigned>(bits);
  return x;
}

/// Doubles as integers in units of 2^exponent (the largest that fits them all).
template <class I>
class Grid {
 public:
  void fit(double x) {
    const Parts p = parts_of(x);
    if (p.mantissa == 0) return;
    exponent_ = any_ ? std::min(exponent_, p.exponent) : p.exponent;
    top_ = any_ ? std::max(top_, top_of(p)) : top_of(p);
    any_ = true;
  }
  void fit(const Vec3& v) {
    for (int k = 0; k < 3; ++k) fit(v[k]);
  }
  I operator()(double x) const {
    const Parts p = parts_of(x);
    return p.mantissa == 0 ? I(0) : scaled<I>(I(p.mantissa), p.exponent - exponent_);
  }
  Triple<I> operator()(const Vec3& v) const { return {(*this)(v.x()), (*this)(v.y()), (*this)(v.z())}; }
  int exponent() const { return exponent_; }
  /// The integers are below 2^bits.
  int bits() const { return any_ ? top_ - exponent_ : 0; }

 private:
  static int top_of(const Parts& p) {
    return p.exponent +
           static_cast<int>(std::bit_width(static_cast<unsigned long long>(std::llabs(p.mantissa))));
  }
  int exponent_ = 0, top_ = 0;
  bool any_ = false;
};

template <class I>
struct Linear {
  Triple<I> row[3];
  I denominator = 1;
  int exponent = 0;  // matrix = row·2^exponent/denominator
  int bits = 0, denominator_bits = 0;
};

template <class I>
Linear<I> linear_part(const Placement& p) {
  Grid<I> g;
  for (int i = 0; i < 3; ++i) g.fit(Vec3(p.matrix.row(i)));
  Linear<I> l;
  for (int i = 0; i < 3; ++i) l.row[i] = g(Vec3(p.matrix.row(i)));
  l.exponent = g.exponent();
  l.bits = g.bits();
  l.denominator_bits = 1;
  return l;
}

template <class I>
Linear<I> linear_part(const Pose& p) {
  Grid<I> g;
  const Quat& q = p.rotation;
  for (double c : {q.x, q.y, q.z, q.w}) g.fit(c);
  const I x = g(q.x), y = g(q.y), z = g(q.z), w = g(q.w);
  const I xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  Linear<I> l;
  l.row[0] = {ww + xx - yy - zz, 2 * (x * y - w * z), 2 * (x * z + w * y)};
  l.row[1] = {2 * (x * y + w * z), ww - xx + yy - zz, 2 * (y * z - w * x)};
  l.row[2] = {2 * (x * z - w * y), 2 * (y * z + w * x), ww - xx - yy + zz};
  l.denominator = ww + xx + yy + zz;
  l.bits = l.denominator_bits = 2 * g.bits() + 2;
  return l;
}

/// The parts of a body's placement, each in integers with its own exponent.
template <class I>
struct Scaled {
  Linear<I> linear;
  std::vector<Triple<I>> turned;  // in 2^turned_exponent/denominator
  int turned_exponent = 0;
  Triple<I> translation;
  int translation_exponent = 0;
  std::vector<Triple<I>> shifts;
  int shift_exponent = 0;
  Parts radius;
  int turned_bits = 0, translation_bits = 0, shift_bits = 0, radius_bits = 0;
};

template <class I>
Scaled<I> scale(const ExactBody& b) {
  Scaled<I> s;
  s.linear = std::visit([](const auto& p) { return linear_part<I>(p); }, b.pose);
  Grid<I> points, place, speed, time;
  for (const Vec3& v : b.core) points.fit(v);
  for (const Vec3& v : b.core) {
    const Triple<I> x = points(v);
    s.turned.push_back({dot(s.linear.row[0], x), dot(s.linear.row[1], x), dot(s.linear.row[2], x)});
  }
  s.turned_exponent = points.exponent() + s.linear.exponent;
  const Vec3& t = std::visit([](const auto& p) -> const Vec3& { return p.translation; }, b.pose);
  place.fit(t);
  s.translation = place(t);
  s.translation_exponent = place.exponent();
  speed.fit(b.velocity_to);
  speed.fit(b.velocity_from);
  for (double x : b.times) time.fit(x);
  for (double x : b.times) s.shifts.push_back(time(x) * (speed(b.velocity_to) - speed(b.velocity_from)));
  s.shift_exponent = speed.exponent() + time.exponent();
  s.radius = parts_of(b.radius);
  s.turned_bits = points.bits() + s.linear.bits + 2;
  s.translation_bits = place.bits();
  s.shift_bits = time.bits() + speed.bits() + 1;
  s.radius_bits = static_cast<int>(std::bit_width(static_cast<unsigned long long>(s.radius.mantissa)));
  return s;
}

template <class I>
int least_exponent(const Scaled<I>& s) {
  int e = std::min(std::min(s.turned_exponent, s.translation_exponent), s.shift_exponent);
  return s.radius.mantissa == 0 ? e : std::min(e, s.radius.exponent);
}

template <class I>
std::vector<Triple<I>> place(const Scaled<I>& s, int exponent, const I& other_denominator) {
  std::vector<Triple<I>> r;
  const I unit_translation =
      scaled<I>(s.linear.denominator * other_denominator, s.translation_exponent - exponent);
  const I unit_shift = scaled<I>(s.linear.denominator * other_denominator, s.shift_exponent - exponent);
  const I unit_turned = scaled<I>(other_denominator, s.turned_exponent - exponent);
  for (const Triple<I>& shift : s.shifts) {
    const Triple<I> base = unit_translation * s.translation + unit_shift * shift;
    for (const Triple<I>& x : s.turned) r.push_back(unit_turned * x + base);
  }
  return r;
}

template <class I>
struct Nearest {
  std::array<int, 4> face{};  // indices into the simplex
  int size = 0;
  Triple<I> direction;  // positive multiple of the nearest point; zero: the origin is in the hull
  I reach;              // direction·p for every p of the face
};

// Nearest point of the face's affine hull, if it lies in the face (its border included).
template <class I>
std::optional<Triple<I>> foot_in_face(std::span<const Triple<I>> p) {
  if (p.size() == 1) return p[0];
  if (p.size() == 2) {
    const Triple<I> d = p[1] - p[0];
    const I dd = dot(d, d), t = -dot(p[0], d);
    if (dd == 0 || t < 0 || t > dd) return std::nullopt;
    return dd * p[0] + t * d;
  }
  if (p.size() == 3) {
    const Triple<I> n = cross(p[1] - p[0], p[2] - p[0]);
    if (is_zero(n)) return std::nullopt;
    if (dot(cross(p[1], p[2]), n) < 0 || dot(cross(p[2], p[0]), n) < 0 || dot(cross(p[0], p[1]), n) < 0)
      return std::nullopt;
    return I(dot(n, p[0]).sign()) * n;
  }
  const Triple<I> m = cross(p[2], p[3]), k = cross(p[0], p[1]);
  const int s[4] = {dot(p[1], m).sign(), -dot(p[0], m).sign(), dot(p[3], k).sign(), -dot(p[2], k).sign()};
  const auto [lo, hi] = std::minmax_element(s, s + 4);
  if (*lo == 0 && *hi == 0) return std::nullopt;
  if (*lo < 0 && *hi > 0) return std::nullopt;
  return Triple<I>{0, 0, 0};
}

// The face of the simplex whose foot is optimal for the whole simplex (the Kuhn-Tucker conditions, exact).
template <class I>
Nearest<I> nearest_face(std::span<const Triple<I>> points) {
  const int n = static_cast<int>(points.size());
  for (int size = 1; size <= n; ++size)
    for (int bits = 1; bits < 1 << n; ++bits) {
      Nearest<I> r;
      std::vector<Triple<I>> face;
      for (int i = 0; i < n; ++i)
        if (bits >> i & 1) {
          r.face[face.size()] = i;
          face.push_back(points[at(i)]);
        }
      if (static_cast<int>(face.size()) != size) continue;
      const auto foot = foot_in_face<I>(face);
      if (!foot) continue;
      r.size = size;
      r.direction = *foot;
      r.reach = dot(*foot, face[0]);
      const bool optimal = std::all_of(points.begin(), points.end(),
                                       [&](const Triple<I>& p) { return dot(r.direction, p) >= r.reach; });
      if (optimal) return r;
    }
  throw std::logic_error("referee: a simplex has no nearest face");  // excluded by convexity
}

template <class I>
I square(const I& x) {
  return x * x;
}

template <class I>
BasicExactPair<I> assemble(const Scaled<I>& x, const Scaled<I>& y, int exponent) {
  BasicExactPair<I> r;
  r.exponent = exponent;
  r.denominator = x.linear.denominator * y.linear.denominator;
  r.a = place(x, exponent, y.linear.denominator);
  r.b = place(y, exponent, x.linear.denominator);
  const auto radius = [&](const Parts& p) -> I {
    return p.mantissa == 0 ? I(0) : scaled<I>(I(p.mantissa), p.exponent - exponent) * r.denominator;
  };
  r.radius_a = radius(x.radius);
  r.radius_b = radius(y.radius);
  return r;
}

// Bits of the coordinates and radii in `place` and `assemble`, sums included.
template <class I>
int bits_of(const Scaled<I>& s, int exponent, int denominators) {
  const int turned = s.turned_bits + s.turned_exponent - exponent;
  const int rest = std::max({s.translation_bits + s.translation_exponent, s.shift_bits + s.shift_exponent,
                             s.radius.mantissa == 0 ? exponent : s.radius_bits + s.radius.exponent}) -
                   exponent;
  return std::max(turned, rest) + denominators + 2;
}

// With coordinates and radii below 2^k: differences 2^(k+1); the direction of an edge 2^(3k+8), of a triangle
// 2^(2k+5), reach 2^(4k+11), and the two squares that are compared, reach² and radius²·direction², 2^(8k+22).
constexpr int short_bits = 60;
// Bound for the intermediate products in `scale` and `place`: the bits and exponents of the parts stay below
// it.
constexpr int short_parts = 200;

// reach/√length_sq in units of the scene, within 16 units: the conversions, the square root, the quotient and
// the scaling are each within one. NaN or infinite where long double cannot hold the integers.
template <class I>
Real length_of(const BasicExactPair<I>& p, const I& reach, const I& length_sq) {
  const Real x = reach.template convert_to<Real>(), y = std::sqrt(length_sq.template convert_to<Real>());
  return std::ldexp(x / y / p.denominator.template convert_to<Real>(), p.exponent);
}

// Work units of one product of a coordinate and a direction (itself made of three coordinates), sums
// included.
template <class I>
std::int64_t work_of_products(const BasicExactPair<I>& p) {
  I most = 1;
  for (const auto* points : {&p.a, &p.b})
    for (const Triple<I>& x : *points)
      for (const I* c : {&x.x, &x.y, &x.z})
        if (const I size = abs(*c); size > most) most = size;
  const auto limbs = static_cast<std::int64_t>(msb(most) / 64 + 1);
  return 100 + 10 * limbs * limbs;
}

template <class I>
ExactVerdict decide_in(const BasicExactPair<I>& p, std::span<const IndexPair> seed,
                       bool find_nearest = false) {
  const I radius = p.radius_a + p.radius_b, radius_sq = square(radius);
  std::vector<IndexPair> simplex(seed.begin(), seed.end());
  if (simplex.empty()) simplex.emplace_back(0, 0);
  const std::int64_t work = work_of_products(p) * static_cast<std::int64_t>(64 + p.a.size() + p.b.size());
  for (;;) {
    spend(work);
    std::vector<Triple<I>> points;
    for (const auto& [i, j] : simplex) points.push_back(p.a[at(i)] - p.b[at(j)]);
    const Nearest<I> v = nearest_face<I>(points);
    ExactVerdict r;
    for (int i = 0; i < v.size; ++i) r.simplex.push_back(simplex[at(v.face[at(i)])]);
    r.direction = {Integer(v.direction.x), Integer(v.direction.y), Integer(v.direction.z)};
    r.overlap = true;
    const I length_sq = dot(v.direction, v.direction);
    if (length_sq == 0 || v.reach == 0) return r;
    const auto compare = square(v.reach).compare(radius_sq * length_sq);
    if (compare < 0 && !find_nearest) return r;
    int i = 0, j = 0;
    I least = dot(v.direction, p.a[0]), most = dot(v.direction, p.b[0]);
    for (std::size_t k = 1; k < p.a.size(); ++k)
      if (const I d = dot(v.direction, p.a[k]); d < least) {
        least = d;
        i = static_cast<int>(k);
      }
    for (std::size_t k = 1; k < p.b.size(); ++k)
      if (const I d = dot(v.direction, p.b[k]); d > most) {
        most = d;
        j = static_cast<int>(k);
      }
    const I reach = least - most;
    if (find_nearest && reach >= v.reach) {
      r.overlap = compare <= 0;
      r.touching = compare == 0;
      r.core_distance = length_of(p, v.reach, length_sq);
      return r;
    }
    if (find_nearest) {
      simplex = r.simplex;
      simplex.emplace_back(i, j);
      continue;
    }
    if (reach > 0 && square(reach) > radius_sq * length_sq) {
      r.overlap = false;
      return r;
    }
    if (compare == 0) {
      r.touching = reach == v.reach;
      return r;
    }
    simplex = r.simplex;
    simplex.emplace_back(i, j);
  }
}

}  // namespace

ExactPair make_exact(const ExactBody& a, const ExactBody& b) {
  const auto x = scale<Integer>(a), y = scale<Integer>(b);
  return assemble(x, y, std::min(least_exponent(x), least_exponent(y)));
}

ExactVerdict decide(const ExactPair& p, std::span<const IndexPair> seed) { return decide_in(p, seed); }

ExactVerdict nearest(const ExactPair& p, std::span<const IndexPair> seed) { return decide_in(p, seed, true); }

namespace {

// Whether 512 bits hold every intermediate product on the way to the integers of `assemble`: a part has at
// most 53 bits more than its grid's span, and a rotation squares it.
bool parts_are_short(const ExactBody& b) {
  Grid<Short> points, linear, place;
  for (const Vec3& v : b.core) points.fit(v);
  if (const auto* pose = std::get_if<Pose>(&b.pose)) {
    for (double x : {pose->rotation.x, pose->rotation.y, pose->rotation.z, pose->rotation.w}) linear.fit(x);
    place.fit(pose->translation);
  } else {
    for (int i = 0; i < 3; ++i) linear.fit(Vec3(std::get<Placement>(b.pose).matrix.row(i)));
    place.fit(std::get<Placement>(b.pose).translation);
  }
  return points.bits() + 2 * linear.bits() + place.bits() < short_parts && b.velocity_to.isZero(0) &&
         b.velocity_from.isZero(0);
}

std::optional<BasicExactPair<Short>> make_short(const ExactBody& a, const ExactBody& b,
                                                int at_most_exponent) {
  if (!parts_are_short(a) || !parts_are_short(b)) return std::nullopt;
  const auto x = scale<Short>(a), y = scale<Short>(b);
  const int exponent = std::min({least_exponent(x), least_exponent(y), at_most_exponent});
  const int denominators = x.linear.denominator_bits + y.linear.denominator_bits;
  if (std::max(bits_of(x, exponent, denominators), bits_of(y, exponent, denominators)) > short_bits)
    return std::nullopt;
  return assemble(x, y, exponent);
}

}  // namespace

Real3 direction_of(const ExactVerdict& v) {
  const auto part = [](const Integer& x) { return x.convert_to<Real>(); };
  const Real3 n{part(v.direction.x), part(v.direction.y), part(v.direction.z)};
  return normalized((1 / largest(n)) * n);
}

std::optional<ExactVerdict> decide_short(const ExactBody& a, const ExactBody& b,
                                         std::span<const IndexPair> seed) {
  const auto p = make_short(a, b, std::numeric_limits<int>::max());
  if (!p) return std::nullopt;
  return decide_in(*p, seed);
}

// The half-space is {y : N·(y - t) <= offset}, N = R·normal = (R·normal + t) - t, so placing the points
// `normal` and 0 like a body gives N and t in the pair's unit 2^e/D. N·(y - t) is then in units of its
// square, in which offset is offset·D²/2^2e. With k bits for a coordinate: 2k + 6 bits, squared 4k + 12;
// |offset|·D² is bounded separately.
std::optional<bool> overlaps_half_space_short(const Vec3& normal, double offset, const Pose& half_space,
                                              const ExactBody& body) {
  const ExactBody frame{{normal, Vec3::Zero()}, 0, half_space};
  const Parts d = parts_of(offset);
  const int half = d.exponent >= 0 ? d.exponent / 2 : -((1 - d.exponent) / 2);
  const auto p = make_short(frame, body, d.mantissa == 0 ? std::numeric_limits<int>::max() : half);
  if (!p) return std::nullopt;
  const Triple<Short> n = p->a[0] - p->a[1];
  const int shift = d.mantissa == 0 ? 0 : d.exponent - 2 * p->exponent;
  if (shift < 0 || shift > short_bits) return std::nullopt;
  const Short limit = scaled<Short>(Short(d.mantissa), shift) * square(p->denominator);
  Short least = dot(n, p->b[0] - p->a[1]);
  for (const Triple<Short>& y : p->b) least = std::min(least, Short(dot(n, y - p->a[1])));
  least -= limit;
  return !(least > 0 && square(least) > square(p->radius_b) * dot(n, n));
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
  // |b - a| <= rA + rB, so the point that divides the segment in the ratio of the radii is within rA of a and
  // within rB of b.
  if (radius > 0) a = a + Rational(p.radius_a, radius) * (b - a);
  return to_world(p, a);
}

ExactPlane separating_plane(const ExactPair& p, const ExactVerdict& v) {
  const Integer3 n = Integer(-1) * v.direction;
  Integer most = dot(n, p.a[0]), least = dot(n, p.b[0]);
  for (const Integer3& x : p.a) most = std::max(most, dot(n, x));
  for (const Integer3& x : p.b) least = std::min(least, dot(n, x));
  // |n| in units of 2^-bits, rounded up; more bits until the planes, shifted outward by the balls, still
  // leave room.
  for (unsigned bits = 0;; bits += 64) {
    const Integer length = sqrt(Integer(dot(n, n) << (2 * bits))) + 1;
    const Integer from = (most << bits) + p.radius_a * length, to = (least << bits) - p.radius_b * length;
    if (from >= to && p.radius_a + p.radius_b > 0) continue;
    const Rational scale(Integer(1), Integer(1) << (bits + 1));
    const Rational middle = scale * Rational(from + to);
    // In world units x = k·2^exponent/denominator; n is used unscaled.
    return {rational(n), to_world(p, {middle, 0, 0}).x};
  }
}

}  // namespace touchstone::referee
