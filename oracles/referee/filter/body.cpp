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

// Above √3 and √2, the largest |x|₁ of a unit vector in space and in a plane.
constexpr Real root_three = 1.75L, root_two = 1.5L;

// Bound of |x|₁ over a curved core.
Real rho_of(Solid::Kind kind, const Real3& size) {
  return kind == Solid::Kind::ellipsoid ? root_three * largest(size) : root_two * size.x + size.y;
}

// Bound of |x| over a curved core.
Real reach_of(Solid::Kind kind, const Real3& size) {
  if (kind == Solid::Kind::ellipsoid) return largest(size);
  return std::sqrt(size.x * size.x + size.y * size.y) * (1 + dot_rounding);
}

/// The referee's table of shapes: one row for each.
struct FormOf {
  using K = CoreForm::Kind;
  CoreForm operator()(const Sphere& s) const { return {K::origin, Vec3::Zero(), s.radius}; }
  CoreForm operator()(const Box& s) const { return {K::box, s.half_extents, 0}; }
  CoreForm operator()(const Capsule& s) const { return {K::segment, Vec3(0, s.half_height, 0), s.radius}; }
  CoreForm operator()(const Cylinder& s) const { return round(K::cylinder, s.radius, s.half_height); }
  CoreForm operator()(const Cone& s) const { return round(K::cone, s.radius, s.half_height); }
  CoreForm operator()(const Ellipsoid& s) const { return {K::ellipsoid, s.semi_axes, 0}; }
  CoreForm operator()(const Hull&) const { return {K::vertices, Vec3::Zero(), 0}; }
  CoreForm operator()(const RoundedBox& s) const { return {K::box, s.half_extents, s.radius}; }
  template <class S>
  CoreForm operator()(const Padded<S>& s) const {
    CoreForm f = (*this)(s.inner);
    f.radius = s.padding;
    return f;
  }
  CoreForm operator()(const HalfSpace&) const { return {}; }
  CoreForm operator()(const TriangleMesh&) const { return {}; }

 private:
  static CoreForm round(K kind, double radius, double half_height) {
    return {radius == 0 ? K::segment : kind, Vec3(radius, half_height, 0), 0};
  }
};

Solid::Kind solid_kind(CoreForm::Kind kind) {
  if (kind == CoreForm::Kind::cylinder) return Solid::Kind::cylinder;
  if (kind == CoreForm::Kind::cone) return Solid::Kind::cone;
  return kind == CoreForm::Kind::ellipsoid ? Solid::Kind::ellipsoid : Solid::Kind::points;
}

std::vector<Vec3> corners(const Vec3& half) {
  std::vector<Vec3> v(8, half);
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k)
      if (!(i >> k & 1)) v[static_cast<std::size_t>(i)][k] = -v[static_cast<std::size_t>(i)][k];
  return v;
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

Vec3 translation_of(const Placed& p) {
  return std::visit([](const auto& x) -> Vec3 { return x.translation; }, p.pose);
}

Placed with_translation(const Placed& p, const Vec3& to) {
  Placed r = p;
  std::visit([&](auto& pose) { pose.translation = to; }, r.pose);
  return r;
}

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

CoreForm core_form(const Placed& p) {
  CoreForm f = std::visit(FormOf{}, *p.shape);
  const bool ball = f.kind == CoreForm::Kind::ellipsoid && f.radius == 0 &&
                    std::holds_alternative<Pose>(p.pose) && f.size.x() == f.size.y() &&
                    f.size.y() == f.size.z();
  return ball ? CoreForm{CoreForm::Kind::origin, Vec3::Zero(), f.size.x()} : f;
}

std::optional<std::vector<Vec3>> core_points(const Placed& p) {
  const CoreForm f = core_form(p);
  switch (f.kind) {
    case CoreForm::Kind::origin:
      return std::vector<Vec3>{Vec3::Zero()};
    case CoreForm::Kind::segment:
      return std::vector<Vec3>{{0, 0, -f.size.y()}, {0, 0, f.size.y()}};
    case CoreForm::Kind::box:
      return corners(f.size);
    case CoreForm::Kind::vertices:
      return hull_if(*p.shape)->vertices;
    case CoreForm::Kind::none:
    case CoreForm::Kind::cylinder:
    case CoreForm::Kind::cone:
    case CoreForm::Kind::ellipsoid:
      break;
  }
  return std::nullopt;
}

Solid make_body(const Placed& p, const Frame& f) {
  const CoreForm form = core_form(p);
  if (form.kind == CoreForm::Kind::vertices) return make_body(hull_if(*p.shape)->vertices, form.radius, f);
  if (form.has_points()) return make_body(*core_points(p), form.radius, f);
  Solid b;
  b.kind = solid_kind(form.kind);
  b.size = referee::to_real(form.size);
  b.radius = form.radius;
  finish_curved(b, f, rho_of(b.kind, b.size), reach_of(b.kind, b.size));
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
      const Real rho = rho_of(b.kind, b.size);
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
