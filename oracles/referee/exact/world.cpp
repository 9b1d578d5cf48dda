#include "oracles/referee/exact/exact_pair.h"

namespace touchstone::referee {
namespace {

struct RationalMatrix {
  Rational3 row[3];
};

RationalMatrix matrix_of(const Pose& p) {
  const Rational x = exact(p.rotation.x), y = exact(p.rotation.y), z = exact(p.rotation.z),
                 w = exact(p.rotation.w);
  const Rational s = Rational(1) / (x * x + y * y + z * z + w * w);
  return {{s * Rational3{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
           s * Rational3{2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
           s * Rational3{2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
}

RationalMatrix matrix_of(const Placement& p) {
  return {{exact(Vec3(p.matrix.row(0))), exact(Vec3(p.matrix.row(1))), exact(Vec3(p.matrix.row(2)))}};
}

RationalMatrix matrix_of(const std::variant<Pose, Placement>& pose) {
  return std::visit([](const auto& p) { return matrix_of(p); }, pose);
}

Rational3 translation_of(const std::variant<Pose, Placement>& pose) {
  return std::visit([](const auto& p) { return exact(p.translation); }, pose);
}

Rational3 apply(const RationalMatrix& m, const Rational3& x) {
  return {dot(m.row[0], x), dot(m.row[1], x), dot(m.row[2], x)};
}

}  // namespace

Rational3 world_point(const std::variant<Pose, Placement>& pose, const Rational3& local) {
  return apply(matrix_of(pose), local) + translation_of(pose);
}

std::vector<Rational3> world_points(const ExactBody& b) {
  const RationalMatrix m = matrix_of(b.pose);
  const Rational3 shift = exact(b.times.front()) * (exact(b.velocity_to) - exact(b.velocity_from));
  const Rational3 base = translation_of(b.pose) + shift;
  std::vector<Rational3> r;
  for (const Vec3& v : b.core) r.push_back(apply(m, exact(v)) + base);
  return r;
}

RationalPlane world_plane(const Placed& half_space) {
  const auto& h = std::get<HalfSpace>(*half_space.shape);
  const RationalMatrix m = matrix_of(half_space.pose);
  RationalPlane p;
  if (std::holds_alternative<Pose>(half_space.pose)) {  // a rotation: its own cofactor matrix, determinant 1
    p.normal = apply(m, exact(h.normal));
    p.offset = exact(h.offset) + dot(p.normal, translation_of(half_space.pose));
    return p;
  }
  // Rows of the cofactor matrix; det(M)·M^-T = cof(M).
  const RationalMatrix cofactor{
      {cross(m.row[1], m.row[2]), cross(m.row[2], m.row[0]), cross(m.row[0], m.row[1])}};
  const Rational det = dot(m.row[0], cofactor.row[0]);
  if (det == 0) return {{0, 0, 0}, 0};
  const Rational sign = det > 0 ? 1 : -1;
  p.normal = sign * apply(cofactor, exact(h.normal));
  p.offset = sign * det * exact(h.offset) + dot(p.normal, translation_of(half_space.pose));
  return p;
}

std::optional<Rational> distance_of_half_spaces(const RationalPlane& x, const RationalPlane& y) {
  const Rational along = dot(x.normal, y.normal);
  if (along >= 0 || !is_zero(cross(x.normal, y.normal))) return std::nullopt;
  // y.normal = -k·x.normal: B = {x.normal·p >= -y.offset/k}.
  const Rational k = -along / dot(x.normal, x.normal);
  return -y.offset / k - x.offset;
}

}  // namespace touchstone::referee
