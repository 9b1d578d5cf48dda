// The first common t is where the least t of [0,1] is at which no limit of the body is negative; it is 0 or a
// root of one of them. A root is m + f·√s with rational m, f, s, and so is the value of a quadratic there,
// whose sign follows from comparing squares.
//
// A plane that keeps the point outside is found like this. Outside an ellipsoid: across the gradient at the
// path's point nearest in the coordinates in which the body is a ball. Outside a cylinder or a cone: across
// an end; across the side where the path comes nearest to it; or across the rim, where the path is outside
// the side when it passes the plane of an end: across the normals of both, weighted so that the path is
// parallel to the plane. Each is only proposed: what counts is that the body's support value is below the
// path.
#include "oracles/referee/exact/ray.h"

#include <algorithm>
#include <limits>

#include "oracles/referee/filter/body.h"

namespace touchstone::referee {
namespace {

// Bits of the quotient below that a root of a rational is enclosed in, far below what decides or separates.
constexpr int root_bits = 256;

struct Enclosure {
  Rational lo, hi;  // equal: exact
};

// √(n/d) = √(n·d)/d.
Enclosure root_of(const Rational& square) {
  const Integer d = denominator(square), scaled = shifted(numerator(square) * d, 2 * root_bits);
  const Integer root = sqrt(scaled), unit_of_root = shifted(d, root_bits);
  return {Rational(root, unit_of_root),
          root * root == scaled ? Rational(root, unit_of_root) : Rational(Integer(root + 1), unit_of_root)};
}

Enclosure enclosure_of(const QuadraticRoot& t) {
  if (t.factor == 0) return {t.mean, t.mean};
  const Enclosure root = root_of(t.square);
  const Rational x = t.mean + t.factor * root.lo, y = t.mean + t.factor * root.hi;
  return {std::min(x, y), std::max(x, y)};
}

// Conversion to double cuts off what does not fit.
double double_below(const Rational& x) {
  const double r = x.convert_to<double>();
  return exact(r) > x ? std::nextafter(r, -std::numeric_limits<double>::infinity()) : r;
}
double double_above(const Rational& x) {
  const double r = x.convert_to<double>();
  return exact(r) < x ? std::nextafter(r, std::numeric_limits<double>::infinity()) : r;
}

// The square of the distance from the axis.
Rational radius_squared(const Rational3& v) { return v.x * v.x + v.y * v.y; }

Quadratic linear(const Rational& at_0, const Rational& slope) { return {{at_0, slope, 0}}; }

// s·(x0 + x1·t)² added to p.
void add_square(Quadratic& p, const Rational& s, const Rational& x0, const Rational& x1) {
  p.c[0] += s * x0 * x0;
  p.c[1] += 2 * s * x0 * x1;
  p.c[2] += s * x1 * x1;
}

// The t in [0, until] nearest to the root of a + b·t, b >= 0.
Rational nearest_time(const Rational& a, const Rational& b, const Rational& until) {
  if (b == 0) return 0;
  return std::clamp<Rational>(-a / b, 0, until);
}

}  // namespace

std::vector<QuadraticRoot> roots_of(const Quadratic& p) {
  const auto& [c, b, a] = p.c;
  if (a == 0) {
    if (b == 0) return {};
    return {{-c / b, 0, 0}};
  }
  const Rational square = b * b - 4 * a * c, half = Rational(1) / (2 * a);
  if (square < 0) return {};
  const Rational mean = -b * half, factor = square == 0 ? Rational(0) : half;
  return {{mean, -factor, square}, {mean, factor, square}};
}

int sign_at(const Quadratic& p, const QuadraticRoot& t) {
  const auto& [c, b, a] = p.c;
  const Rational whole = c + b * t.mean + a * (t.mean * t.mean + t.factor * t.factor * t.square);
  const Rational part = t.factor * (b + 2 * a * t.mean);
  const int w = whole.sign(), q = t.square == 0 ? 0 : part.sign();
  if (w == q || q == 0) return w;
  if (w == 0) return q;
  const Rational difference = whole * whole - part * part * t.square;
  return difference > 0 ? w : difference < 0 ? q : 0;
}

void enclose(const QuadraticRoot& t, double& lo, double& hi) {
  const Enclosure e = enclosure_of(t);
  lo = std::max(0.0, double_below(e.lo));
  hi = std::min(1.0, double_above(e.hi));
}

std::optional<Ray> Ray::past(const Placed& body, const Rational3& start, const Rational3& velocity) {
  const CoreForm form = core_form(body);
  using K = CoreForm::Kind;
  if (form.kind != K::cylinder && form.kind != K::cone && form.kind != K::ellipsoid) return std::nullopt;
  if (form.radius > 0) return std::nullopt;
  const Rational3 centre = world_point(body.pose, {0, 0, 0});
  const Rational3 x = world_point(body.pose, {1, 0, 0}) - centre,
                  y = world_point(body.pose, {0, 1, 0}) - centre,
                  z = world_point(body.pose, {0, 0, 1}) - centre;
  const Rational det = dot(x, cross(y, z));
  if (det == 0) return std::nullopt;
  Ray r;
  const Rational by = Rational(1) / det;
  r.to_local_[0] = by * cross(y, z);
  r.to_local_[1] = by * cross(z, x);
  r.to_local_[2] = by * cross(x, y);
  const auto local = [&](const Rational3& v) -> Rational3 {
    return {dot(r.to_local_[0], v), dot(r.to_local_[1], v), dot(r.to_local_[2], v)};
  };
  r.start_ = start;
  r.velocity_ = velocity;
  r.local_start_ = local(start);
  r.local_velocity_ = local(velocity);
  r.size_ = exact(form.size);
  // A cone without height is a disc, as is a cylinder.
  r.kind_ = form.kind == K::ellipsoid                       ? Kind::ellipsoid
            : form.kind == K::cone && !(form.size.y() == 0) ? Kind::cone
                                                            : Kind::cylinder;
  r.limits_ = r.limits();
  return r;
}

std::vector<Quadratic> Ray::limits() const {
  const Rational3 &p = local_start_, &v = local_velocity_;
  std::vector<Quadratic> all{linear(0, 1), linear(1, -1)};
  if (kind_ == Kind::ellipsoid) {
    Quadratic round = linear(1, 0);
    for (int i = 0; i < 3; ++i) {
      if (size_[i] > 0) {
        add_square(round, Rational(-1) / (size_[i] * size_[i]), p[i], v[i]);
      } else {
        all.push_back(linear(p[i], v[i]));
        all.push_back(linear(-p[i], -v[i]));
      }
    }
    all.push_back(round);
    return all;
  }
  const Rational &r = size_.x, &h = size_.y;
  const Quadratic below_top = linear(h - p.z, -v.z);
  all.push_back(below_top);
  all.push_back(linear(h + p.z, v.z));
  // The squared radius at the height of the point, times a number that is not negative.
  Quadratic round = linear(r * r, 0);
  Rational scale = 1;
  if (kind_ == Kind::cone) {
    round = linear(0, 0);
    add_square(round, r * r, below_top.c[0], below_top.c[1]);
    scale = 4 * h * h;
  }
  add_square(round, -scale, p.x, v.x);
  add_square(round, -scale, p.y, v.y);
  all.push_back(round);
  return all;
}

bool Ray::is_flat_ellipsoid() const {
  return kind_ == Kind::ellipsoid && (size_.x == 0 || size_.y == 0 || size_.z == 0);
}

bool Ray::is_inside(const QuadraticRoot& t) const {
  return std::all_of(limits_.begin(), limits_.end(), [&](const Quadratic& p) { return sign_at(p, t) >= 0; });
}

std::optional<Ray::Meeting> Ray::first_meeting() const {
  std::optional<Meeting> first;
  Enclosure least;
  for (const Quadratic& p : limits_)
    for (const QuadraticRoot& t : roots_of(p)) {
      if (!is_inside(t)) continue;
      const Enclosure e = enclosure_of(t);
      if (first && !(e.lo < least.lo)) continue;
      least = e;
      first.emplace();
      enclose(t, first->lo, first->hi);
    }
  if (!first) return std::nullopt;
  // As where the time is bisected: there is no contact at lo.
  if (first->lo == first->hi && first->lo > 0) first->lo = std::nextafter(first->lo, 0);
  if (is_flat_ellipsoid()) return first;  // whose points the checker does not decide
  for (const Rational& t : {least.lo, exact(first->hi), least.hi})
    if (is_inside({t, 0, 0})) {
      first->contact = t;
      break;
    }
  return first;
}

// At least the support value of the body, and above it by 2^-256 of it at most.
Rational Ray::support_above(const Rational3& n) const {
  if (kind_ == Kind::ellipsoid) {
    const Rational3 m{size_.x * n.x, size_.y * n.y, size_.z * n.z};
    return root_of(dot(m, m)).hi;
  }
  const Rational rim = size_.x * root_of(radius_squared(n)).hi, end = size_.y * n.z;
  return kind_ == Kind::cylinder ? rim + abs(end) : std::max<Rational>(end, rim - end);
}

// Directions, in local coordinates, in which the path may be beyond the body.
std::vector<Rational3> Ray::proposals(const Rational& until) const {
  const Rational3 &p = local_start_, &v = local_velocity_;
  if (kind_ == Kind::ellipsoid) {
    if (is_flat_ellipsoid()) return {};
    const auto squared = [&](const Rational3& x) -> Rational3 {
      return {x.x / (size_.x * size_.x), x.y / (size_.y * size_.y), x.z / (size_.z * size_.z)};
    };
    return {squared(local_at(nearest_time(dot(p, squared(v)), dot(v, squared(v)), until)))};
  }
  std::vector<Rational3> all{{0, 0, 1}, {0, 0, -1}};
  const Rational &r = size_.x, &h = size_.y;
  const bool is_cone = kind_ == Kind::cone;
  // The outward normal of the side next to a point.
  const auto side = [&](const Rational3& x) -> Rational3 {
    if (!is_cone) return {x.x, x.y, 0};
    return {2 * h * x.x, 2 * h * x.y, r * root_of(radius_squared(x)).hi};
  };
  const Rational w = radius_squared(v), nearest = nearest_time(p.x * v.x + p.y * v.y, w, until);
  all.push_back(side(local_at(nearest)));
  if (is_cone && w > 0) {
    // How far a point is outside the side is convex in t, and least at a distance from the axis's nearest
    // time that follows from the slopes of path and side.
    const Rational m = r * v.z / (2 * h), across = p.x * v.y - p.y * v.x;
    const Rational axis = -(p.x * v.x + p.y * v.y) / w;
    if (w > m * m) {
      const Rational off = m * abs(across) / w * root_of(Rational(1) / (w - m * m)).hi;
      all.push_back(side(local_at(std::clamp<Rational>(axis - off, 0, until))));
      all.push_back({-v.z * v.x, -v.z * v.y, w});  // past the apex: along the path
    }
    all.push_back(side(local_at(0)));
    all.push_back(side(local_at(until)));
  }
  for (const Rational& end : {h, Rational(-h)}) {
    if (v.z == 0 || (is_cone && end > 0)) continue;
    const Rational t = (end - p.z) / v.z;
    if (t < 0 || t > until) continue;
    const Rational3 n = side(local_at(t));
    all.push_back({n.x, n.y, n.z - dot(n, v) / v.z});
  }
  return all;
}

std::optional<ExactPlane> Ray::plane_until(const Rational& until) const {
  for (const Rational3& n : proposals(until)) {
    const Rational top = support_above(n), bottom = std::min(dot(n, local_start_), dot(n, local_at(until)));
    if (!(top < bottom)) continue;
    ExactPlane plane;
    for (int i = 0; i < 3; ++i) {
      const Rational3 column{to_local_[0][i], to_local_[1][i], to_local_[2][i]};
      (i == 0 ? plane.direction.x : i == 1 ? plane.direction.y : plane.direction.z) = dot(n, column);
    }
    plane.offset = (top + bottom) / 2;
    return plane;
  }
  return std::nullopt;
}

}  // namespace touchstone::referee
