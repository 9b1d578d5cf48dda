// The body-frame coordinates of the point, times |q|², are integers on the grid of all the numbers involved;
// each shape is then a comparison of polynomials in them. Bits, with k for a coordinate on the grid and b for
// a quaternion's: local coordinates have k + 2b + 5; cone: 4(k + 2b) + 25; ellipsoid: 6k + 4b + 12; below 512
// for k <= 60, b <= 30.
#include "oracles/referee/exact/exact_point.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/exact/rational.h"
#include "oracles/referee/filter/body.h"

namespace touchstone::referee {
namespace {

constexpr int coordinate_bits = 60, quaternion_bits = 30;

/// Doubles as integers in units of the largest power of two that fits them all.
class Grid {
 public:
  void fit(double x) {
    const Parts p = parts_of(x);
    if (p.mantissa == 0) return;
    const int top = p.exponent +
                    static_cast<int>(std::bit_width(static_cast<unsigned long long>(std::llabs(p.mantissa))));
    least_ = any_ ? std::min(least_, p.exponent) : p.exponent;
    top_ = any_ ? std::max(top_, top) : top;
    any_ = true;
  }
  void fit(const Vec3& v) {
    for (int k = 0; k < 3; ++k) fit(v[k]);
  }
  int bits() const { return any_ ? top_ - least_ : 0; }
  Short operator()(double x) const {
    const Parts p = parts_of(x);
    if (p.mantissa == 0) return 0;
    return Short(p.mantissa) << static_cast<unsigned>(p.exponent - least_);
  }

 private:
  int least_ = 0, top_ = 0;
  bool any_ = false;
};

Short square(const Short& x) { return x * x; }

struct Local {
  Short x, y, z, denominator;  // coordinates times |q|², and |q|²
};

Local local_of(const Pose& pose, const Vec3& point, const Grid& g, const Grid& turn) {
  const Quat& r = pose.rotation;
  const Short x = turn(r.x), y = turn(r.y), z = turn(r.z), w = turn(r.w);
  const Short xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  const auto offset = [&](int k) -> Short { return g(point[k]) - g(pose.translation[k]); };
  const Short a = offset(0), b = offset(1), c = offset(2);
  // Columns of the rotation.
  return {(ww + xx - yy - zz) * a + 2 * (x * y + w * z) * b + 2 * (x * z - w * y) * c,
          2 * (x * y - w * z) * a + (ww - xx + yy - zz) * b + 2 * (y * z + w * x) * c,
          2 * (x * z + w * y) * a + 2 * (y * z - w * x) * b + (ww - xx - yy + zz) * c, ww + xx + yy + zz};
}

bool in_cylinder(const Local& p, const Short& radius, const Short& half) {
  return abs(p.z) <= half * p.denominator && square(p.x) + square(p.y) <= square(radius * p.denominator);
}

// At height z the radius is r(h - z)/2h.
bool in_cone(const Local& p, const Short& radius, const Short& half) {
  const Short below_apex = half * p.denominator - p.z;
  return abs(p.z) <= half * p.denominator &&
         (square(p.x) + square(p.y)) * square(2 * half) <= square(radius * below_apex);
}

bool in_ellipsoid(const Local& p, const Short& a, const Short& b, const Short& c) {
  const Short aa = square(a), bb = square(b), cc = square(c);
  return square(p.x) * bb * cc + square(p.y) * aa * cc + square(p.z) * aa * bb <=
         aa * bb * cc * square(p.denominator);
}

}  // namespace

std::optional<bool> contains_short(const Placed& body, const Vec3& point_w) {
  const CoreForm form = core_form(body);
  if (form.has_points()) {
    const auto v = decide_short(ExactBody{{point_w}, 0, Pose{}},
                                ExactBody{*core_points(body), form.radius, body.pose}, {});
    return v ? std::optional<bool>(v->overlap) : std::nullopt;
  }
  const auto* pose = std::get_if<Pose>(&body.pose);
  if (pose == nullptr) return std::nullopt;
  Grid g, turn;
  g.fit(point_w);
  g.fit(pose->translation);
  for (double q : {pose->rotation.x, pose->rotation.y, pose->rotation.z, pose->rotation.w}) turn.fit(q);
  using K = CoreForm::Kind;
  // A ball around a curved core has no such closed form.
  if (form.kind == K::none || form.radius > 0) return std::nullopt;
  const bool round = form.kind != K::ellipsoid;
  const Vec3 size = round ? Vec3(form.size.x(), form.size.y(), 1) : form.size;
  if (!(size.minCoeff() > 0)) return std::nullopt;
  g.fit(size);
  if (g.bits() > coordinate_bits || turn.bits() > quaternion_bits) return std::nullopt;
  const Local p = local_of(*pose, point_w, g, turn);
  if (form.kind == K::cylinder) return in_cylinder(p, g(size.x()), g(size.y()));
  if (form.kind == K::cone) return in_cone(p, g(size.x()), g(size.y()));
  return in_ellipsoid(p, g(size.x()), g(size.y()), g(size.z()));
}

}  // namespace touchstone::referee
