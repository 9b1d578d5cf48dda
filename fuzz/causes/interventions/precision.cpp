// Numbers that a machine format cannot hold.
#include <cmath>

#include "core/math/through_float.h"
#include "fuzz/causes/intervention.h"
#include "scenarios/random/numbers.h"

namespace touchstone::fuzz {
namespace {

std::optional<Case> if_changed(const Case& before, Case after) {
  if (after.scene == before.scene) return std::nullopt;
  return after;
}

}  // namespace

std::optional<Case> round_to_float(const Case& c) {
  Case r = c;
  for (double* x : numbers(r)) *x = through_float(*x);
  renew(r);
  return if_changed(c, std::move(r));
}

std::optional<Case> normalize_rotations(const Case& c) {
  Case r = c;
  bool any = false;
  const auto change = [&](Quat& q) {
    constexpr double unit_within = 1e-15;  // the rounding of a normalized quaternion, in its squared length
    const double squared = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    if (std::abs(squared - 1) <= unit_within) return;
    q = normalized(q);
    any = true;
  };
  for (Body& b : r.scene.bodies) change(b.pose.rotation);
  for (Step& s : r.scene.script)
    if (s.pose) change(s.pose->rotation);
  if (!any) return std::nullopt;
  return r;
}

}  // namespace touchstone::fuzz
