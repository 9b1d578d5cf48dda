#include "oracles/referee/filter/body.h"

#include <algorithm>

#include "oracles/referee/filter/wide.h"

namespace touchstone::referee {
namespace {

// R(q) of a quaternion of doubles. Squares of doubles neither overflow nor underflow in long double. Each
// entry is a sum of at most four products (relative error 2 units each, three additions) over |q|² (3 units),
// so it is within (4 + 3 + 1) units of the exact entry, which is at most 1.
constexpr Real rotation_error = 10 * unit;

// A translation added to what is placed, relative to the sum.
constexpr Real sum_rounding = 2 * unit;
// An entry of a product of two matrices, relative to the largest of the second: three products and two sums,
// and the rows of the first have |·|₁ <= √3.
constexpr Real matrix_product_rounding = 6 * unit;
// The local support point of a computed direction (finish_curved), relative to rho times the matrix.
constexpr Real local_support_rounding = 32 * unit;

Matrix3 rotation_of(const Quat& q) {
  const Real x = q.x, y = q.y, z = q.z, w = q.w;
  const Real n = x * x + y * y + z * z + w * w;
  return {{{(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n},
           {2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n},
           {2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n}}};
}

Matrix3 to_real(const Mat3& m) {
  Matrix3 r;
  for (int i = 0; i < 3; ++i) r.row[i] = {m(i, 0), m(i, 1), m(i, 2)};
  return r;
}

const Vec3& translation_of(const Placed& p) {
  if (const auto* pose = std::get_if<Pose>(&p.pose)) return pose->translation;
  return std::get<Placement>(p.pose).translation;
}

// Rodrigues' formula. The angle carries 3 units of relative error (norm, product), hence θ·3 units in the
// angle; sinl and cosl of glibc are within 1 ulp after exact argument reduction; the axis carries 3 units a
// component, and enters twice. 16 units + 4θ units cover an entry.
Matrix3 turn(const Vec3& angular, double t, Real& error) {
  const Real3 w = referee::to_real(angular);
  const Real speed = norm(w), angle = speed * static_cast<Real>(t);
  if (!(speed > 0) || angle == 0) {
    error = 0;
    return Matrix3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  }
  const Real3 k = (1 / speed) * w;
  const Real s = std::sin(angle), half = std::sin(angle / 2), v = 2 * half * half, c = std::cos(angle);
  error = (16 + 4 * std::fabs(angle)) * unit;
  return {{{c + v * k.x * k.x, v * k.x * k.y - s * k.z, v * k.x * k.z + s * k.y},
           {v * k.x * k.y + s * k.z, c + v * k.y * k.y, v * k.y * k.z - s * k.x},
           {v * k.x * k.z - s * k.y, v * k.y * k.z + s * k.x, c + v * k.z * k.z}}};
}

Real sum_of_sizes(const Real3& p) { return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z); }

// Error of matrix·p + translation for |p|₁ <= rho: per component (matrix_error + 4 units·m)·rho for the
// product and translation_error + 2 units·|sum| for the translation; the vector's length is at most √3 < 2
// times that.
Real placement_error(const Frame& f, Real rho, Real extent) {
  return 2 * ((f.matrix_error + value_rounding * largest(f.matrix)) * rho + f.translation_error +
              sum_rounding * extent);
}

void finish_points(Solid& b, std::span<const Vec3> local, const Frame& f) {
  Real rho = 0, extent_sq = 0, spin_sq = 0;
  b.points.reserve(local.size());
  for (const Vec3& v : local) {
    const Real3 x = referee::to_real(v), turned = f.matrix * x, placed = turned + f.translation;
    rho = std::max(rho, sum_of_sizes(x));
    b.points.push_back(placed);
    extent_sq = std::max(extent_sq, dot(placed, placed));
    spin_sq = std::max(spin_sq, dot(turned, turned));
  }
  b.extent = std::sqrt(extent_sq);
  b.spin_radius = std::sqrt(spin_sq);
  const Real placed = placement_error(f, rho, b.extent);
  b.spin_radius += placed;
  b.extent += placed;
  b.error = placed + value_rounding * b.extent;
}

// Upper bound of the spectral norm: √(1 + |MᵀM - I|∞).
Real stretch(const Frame& f) {
  Real worst = 0;
  for (int i = 0; i < 3; ++i) {
    Real sum = 0;
    for (int j = 0; j < 3; ++j)
      sum += std::fabs(dot(column(f.matrix, i), column(f.matrix, j)) - (i == j ? 1 : 0));
    worst = std::max(worst, sum);
  }
  const Real m = 1 + largest(f.matrix);
  return std::sqrt(1 + worst + 32 * m * (f.matrix_error + unit * m)) * (1 + dot_rounding);
}

// A curved core's local support point maximises m̃·x for the computed m̃ = Mᵀn, |m̃ - Mᵀn| <= 3(3 units·m +
// matrix_error)|n|, so it misses the exact maximum by at most 2·rho times that; then it is placed and
// multiplied like any other point. The local point itself is computed within 4 units of its size.
void finish_curved(Solid& b, const Frame& f, Real rho, Real reach) {
  const Real m = largest(f.matrix);
  b.matrix = f.matrix;
  b.centre = f.translation;
  b.spin_radius = stretch(f) * reach;
  b.extent = norm(f.translation) + b.spin_radius;
  b.error = placement_error(f, rho, b.extent) + (local_support_rounding * m + 6 * f.matrix_error) * rho +
            value_rounding * b.extent;
}

// Above √3, the largest |x|₁ of a unit vector.
constexpr Real root_three = 1.75L;

struct Sizes {
  Solid::Kind kind;
  Real3 size;
  Real rho;    // bound of |x|₁ over the shape
  Real reach;  // bound of |x| over the shape
};

Real reach_of(Real radius, Real half_height) {
  return std::sqrt(radius * radius + half_height * half_height) * (1 + dot_rounding);
}

std::optional<Sizes> curved_sizes(const Shape& s) {
  if (const auto* c = std::get_if<Cylinder>(&s))
    return Sizes{Solid::Kind::cylinder,
                 {c->radius, c->half_height, 0},
                 1.5L * c->radius + c->half_height,
                 reach_of(c->radius, c->half_height)};
  if (const auto* c = std::get_if<Cone>(&s))
    return Sizes{Solid::Kind::cone,
                 {c->radius, c->half_height, 0},
                 1.5L * c->radius + c->half_height,
                 reach_of(c->radius, c->half_height)};
  if (const auto* e = std::get_if<Ellipsoid>(&s)) {
    const Real3 a = referee::to_real(e->semi_axes);
    return Sizes{Solid::Kind::ellipsoid, a, root_three * largest(a), largest(a)};
  }
  return std::nullopt;
}

bool is_ball(const Placed& p) {
  const auto* e = std::get_if<Ellipsoid>(p.shape);
  return e && std::holds_alternative<Pose>(p.pose) && e->semi_axes.x() == e->semi_axes.y() &&
         e->semi_axes.y() == e->semi_axes.z();
}

template <class T>
Triple<T> local_support(const BasicSolid<T>& b, const Triple<T>& m) {
  using Kind = typename BasicSolid<T>::Kind;
  const T r = b.size.x, h = b.size.y;
  if (b.kind == Kind::ellipsoid) {
    const Triple<T> s{b.size.x * m.x, b.size.y * m.y, b.size.z * m.z};
    const T n = norm(s);
    if (!(n * n > least_square<T>)) return {b.size.x, 0, 0};
    return {b.size.x * (s.x / n), b.size.y * (s.y / n), b.size.z * (s.z / n)};
  }
  using std::sqrt;
  const T s_sq = m.x * m.x + m.y * m.y, s = sqrt(s_sq);
  const Triple<T> rim =
      s_sq > least_square<T> ? Triple<T>{r * (m.x / s), r * (m.y / s), -h} : Triple<T>{r, 0, -h};
  if (b.kind == Kind::cylinder) return {rim.x, rim.y, m.z < 0 ? -h : h};
  return h * m.z > r * s - h * m.z ? Triple<T>{0, 0, h} : rim;
}

}  // namespace

Frame frame_of(const Placed& p, const Vec3& origin) {
  Frame f;
  if (const auto* pose = std::get_if<Pose>(&p.pose)) {
    f.matrix = rotation_of(pose->rotation);
    f.matrix_error = rotation_error;
  } else {
    f.matrix = to_real(std::get<Placement>(p.pose).matrix);
  }
  f.translation = referee::to_real(translation_of(p)) - referee::to_real(origin);
  f.translation_error = unit * largest(f.translation);
  return f;
}

Frame frame_at(const Placed& p, const Motion& m, double t, const Vec3& origin) {
  Frame f = frame_of(p, origin);
  Real turn_error = 0;
  const Matrix3 r = turn(m.angular, t, turn_error);
  if (turn_error > 0) {
    // Rows of r have |·|₁ <= √3, columns of the matrix at most 3 entries of size `size`.
    const Real size = largest(f.matrix);
    f.matrix = r * f.matrix;
    f.matrix_error =
        3 * turn_error * (size + f.matrix_error) + 2 * f.matrix_error + matrix_product_rounding * size;
  }
  const Real3 shift = static_cast<Real>(t) * referee::to_real(m.linear);
  f.translation = f.translation + shift;
  f.translation_error += sum_rounding * (largest(shift) + largest(f.translation));
  return f;
}

std::optional<std::vector<Vec3>> core_points(const Placed& p) {
  const Shape& s = *p.shape;
  const auto segment = [](double h) { return std::vector<Vec3>{{0, 0, -h}, {0, 0, h}}; };
  if (std::holds_alternative<Sphere>(s) || is_ball(p)) return std::vector<Vec3>{Vec3::Zero()};
  if (const auto* c = std::get_if<Capsule>(&s)) return segment(c->half_height);
  if (const auto* c = std::get_if<Cylinder>(&s); c && c->radius == 0) return segment(c->half_height);
  if (const auto* c = std::get_if<Cone>(&s); c && c->radius == 0) return segment(c->half_height);
  if (const auto* h = std::get_if<Hull>(&s)) return h->vertices;
  if (const auto* b = std::get_if<Box>(&s)) {
    std::vector<Vec3> v(8, b->half_extents);
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 3; ++k)
        if (!(i >> k & 1)) v[static_cast<std::size_t>(i)][k] = -v[static_cast<std::size_t>(i)][k];
    return v;
  }
  return std::nullopt;
}

double core_radius(const Placed& p) {
  if (const auto* s = std::get_if<Sphere>(p.shape)) return s->radius;
  if (const auto* c = std::get_if<Capsule>(p.shape)) return c->radius;
  return is_ball(p) ? std::get<Ellipsoid>(*p.shape).semi_axes.x() : 0;
}

bool has_core_points(const Placed& p) {
  const Shape& s = *p.shape;
  if (const auto* c = std::get_if<Cylinder>(&s)) return c->radius == 0;
  if (const auto* c = std::get_if<Cone>(&s)) return c->radius == 0;
  return std::holds_alternative<Sphere>(s) || std::holds_alternative<Capsule>(s) ||
         std::holds_alternative<Hull>(s) || std::holds_alternative<Box>(s) || is_ball(p);
}

Solid make_body(const Placed& p, const Frame& f) {
  if (const auto* h = std::get_if<Hull>(p.shape)) return make_body(h->vertices, 0, f);
  if (const auto points = core_points(p)) return make_body(*points, core_radius(p), f);
  const auto s = curved_sizes(*p.shape);
  Solid b;
  b.kind = s->kind;
  b.size = s->size;
  finish_curved(b, f, s->rho, s->reach);
  return b;
}

Solid make_body(const std::vector<Vec3>& core_points, double radius, const Frame& f) {
  Solid b;
  b.radius = radius;
  finish_points(b, core_points, f);
  return b;
}

// The orbit's axis is within 4 units of the exact direction, heights and radii within 8 units of the extent.
Solid make_orbit(const Solid& b, const Real3& centre, const Real3& angular) {
  Solid o;
  o.centre = centre;
  o.radius = b.radius;
  o.extent = norm(centre) + b.spin_radius;
  o.spin_radius = b.spin_radius;
  o.error = b.error + chain_rounding * o.extent;
  if (b.kind != Solid::Kind::points) {
    o.points = {centre};
    o.radius = round_up(static_cast<Real>(b.radius) + b.spin_radius);
    return o;
  }
  o.kind = Solid::Kind::orbit;
  const Real3 axis = normalized(angular);
  o.matrix.row[2] = axis;
  for (const Real3& p : b.points) {
    const Real3 x = p - centre;
    const Real z = dot(axis, x);
    o.points.push_back({z, norm(x - z * axis), 0});
  }
  return o;
}

void add_sweep(Solid& b, const Real3& sweep, Real sweep_error) {
  b.sweep = sweep;
  b.is_swept = true;
  b.extent += 2 * largest(sweep);
  b.error += 2 * sweep_error + dot_rounding * b.extent;
}

namespace {

template <class T>
Triple<T> orbit_support(const BasicSolid<T>& b, const Triple<T>& n) {
  const Triple<T>& axis = b.matrix.row[2];
  const T along = dot(axis, n);
  const Triple<T> across = n - along * axis;
  const T turn = norm(across);
  const Triple<T>* best = &b.points[0];
  for (const Triple<T>& p : b.points)
    if (along * p.x + turn * p.y > along * best->x + turn * best->y) best = &p;
  const Triple<T> out = unit_across(across, axis);
  return b.centre + best->x * axis + best->y * out;
}

// Second to sixth powers of numbers in this range, and their quotients, are far from overflow; what
// underflows is below 2^-1000 of the quantity it is added to.
constexpr Real double_range = 0x1p80L;

bool fits(Real x) { return x < double_range; }

}  // namespace

// With v = 2^-53: a point's coordinates move by v of their size, so the point by v·extent; a computed dot
// product of it is within 4v·|n|·extent (Cauchy-Schwarz on the absolute values), and it is used both to
// choose and to bound: 16v·extent. An orbit's point is composed of an axis that is unit within 4v, two
// coordinates, and a direction perpendicular within 4v: as in extended precision, 64v·extent. A curved core's
// point: rounding the matrix adds v·m to each entry, so, as in finish_curved with matrix_error = v·m and
// translation_error = v·extent, 2(5v·m·rho + 3v·extent) + (32 + 6)v·m·rho + 4v·extent.
bool round_to_double(const Solid& b, BasicSolid<double>& out) {
  using Kind = Solid::Kind;
  out.kind = static_cast<BasicSolid<double>::Kind>(b.kind);
  out.radius = b.radius;
  out.is_swept = b.is_swept;
  if (!fits(b.extent) || !fits(b.radius) || !fits(b.spin_radius)) return false;
  // A single point at the origin is exact; any other tiny body underflows.
  const Real size = b.extent + static_cast<Real>(b.radius);
  if (size > 0 && size < 1 / double_range) return false;
  out.points.resize(b.points.size());
  for (std::size_t i = 0; i < b.points.size(); ++i) out.points[i] = to_double3(b.points[i]);
  out.sweep = to_double3(b.sweep);
  Real error = b.error + projection_rounding_of<double> * b.extent;
  if (b.kind != Kind::points) {
    for (int i = 0; i < 3; ++i) out.matrix.row[i] = to_double3(b.matrix.row[i]);
    out.centre = to_double3(b.centre);
    out.size = to_double3(b.size);
    error += chain_rounding_of<double> * b.extent;
    if (b.kind != Kind::orbit) {
      const Real rho = b.kind == Kind::ellipsoid ? root_three * largest(b.size) : 1.5L * b.size.x + b.size.y;
      const Real m = largest(b.matrix);
      if (!fits(m) || !fits(rho)) return false;
      error += chain_rounding_of<double> * m * rho;
    }
  }
  if (b.is_swept) error += dot_rounding_of<double> * b.extent;
  out.error = static_cast<double>(error) * (1 + value_rounding_of<double>);
  out.extent = static_cast<double>(b.extent) * (1 + value_rounding_of<double>);
  out.spin_radius = static_cast<double>(b.spin_radius) * (1 + value_rounding_of<double>);
  return true;
}

template <class T>
SupportPoint<T> support(const BasicSolid<T>& b, const Triple<T>& n) {
  using Kind = typename BasicSolid<T>::Kind;
  SupportPoint<T> s;
  if (b.kind == Kind::orbit) {
    s.point = orbit_support(b, n);
  } else if (b.kind == Kind::points) {
    T best = dot(b.points[0], n);
    std::size_t index = 0;
    for (std::size_t i = 1; i < b.points.size(); ++i) {
      const T d = dot(b.points[i], n);
      if (d > best) {
        best = d;
        index = i;
      }
    }
    s.index = static_cast<int>(index);
    s.point = b.points[index];
  } else {
    s.point = b.matrix * local_support(b, transpose_times(b.matrix, n)) + b.centre;
  }
  if (b.is_swept && dot(b.sweep, n) > 0) {
    s.point = s.point + b.sweep;
    if (s.index >= 0) s.index += static_cast<int>(b.points.size());
  }
  return s;
}

template SupportPoint<double> support(const BasicSolid<double>&, const Triple<double>&);
template SupportPoint<Real> support(const BasicSolid<Real>&, const Triple<Real>&);
template SupportPoint<Wide> support(const BasicSolid<Wide>&, const Triple<Wide>&);

}  // namespace touchstone::referee
