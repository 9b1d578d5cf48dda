// Two half-spaces are apart only while they face each other: normals exactly antiparallel, with room between.
// As long as neither turns, the room is linear in t with rational end values. A visible turn (not about the
// normal) that is not the same for both ends the separation at once: the normals m_A(t) and -m_B(t) are
// analytic and differ in the first or second derivative at 0 unless ω is the same, so they differ at all
// small t > 0. Then the half-spaces overlap: the first contact is at 0, as an infimum.
#include "oracles/referee/motion/motion.h"

#include <limits>

#include "core/math/roundoff.h"
#include "oracles/referee/exact/exact_pair.h"

namespace touchstone::referee {
namespace {

/// Room between two that face each other at t = 0 and its rate of change, both times the length of A's
/// normal.
struct Room {
  Rational3 normal;
  Rational start, rate;
};

std::optional<Room> room_between(const Placed& a, const Motion& ma, const Placed& b, const Motion& mb) {
  const RationalPlane x = world_plane(a), y = world_plane(b);
  const Rational along = dot(x.normal, y.normal);
  if (along >= 0 || !is_zero(cross(x.normal, y.normal))) return std::nullopt;
  // y.normal = -k·x.normal: B = {x.normal·p >= -y.offset/k}.
  const Rational k = -along / dot(x.normal, x.normal);
  return Room{x.normal, -y.offset / k - x.offset, dot(x.normal, exact(mb.linear) - exact(ma.linear))};
}

Bracket scaled(const Rational& room, const Rational3& normal) {
  const Rational sq = dot(normal, normal);
  const Real value = room.convert_to<Real>() / std::sqrt(sq.convert_to<Real>());
  const Real slack = projection_rounding * std::fabs(value);
  return {round_down(value - slack), round_up(value + slack)};
}

double below(const Rational& t) {
  const double d = t.convert_to<double>();
  return exact(d) > t ? std::nextafter(d, -infinity) : d;
}

bool is_singular(const Placed& p) { return is_zero(world_plane(p).normal); }

TimeTruth undecided(const char* note) {
  TimeTruth r;
  r.least_gap = {-infinity, infinity};
  r.note = note;
  return r;
}

TimeTruth apart_throughout(const Bracket& least_gap) {
  TimeTruth r;
  r.verdict = TimeTruth::Verdict::none;
  r.t_lo = 1;
  r.least_gap = least_gap;
  return r;
}

}  // namespace

Vec3 visible_turn(const Placed& half_space, const Vec3& angular) {
  return is_zero(cross(world_plane(half_space).normal, exact(angular))) ? Vec3(Vec3::Zero()) : angular;
}

TimeTruth judge_half_spaces_in_motion(const Placed& a, const Motion& motion_a, const Placed& b,
                                      const Motion& motion_b) {
  if (is_singular(a) || is_singular(b)) return undecided("a singular placement leaves no half-space");
  const auto room = room_between(a, motion_a, b, motion_b);
  if (!room || room->start <= 0) return hit_between(0, 0, "overlap at the start");
  const Vec3 turn_a = visible_turn(a, motion_a.angular), turn_b = visible_turn(b, motion_b.angular);
  if (turn_a != turn_b)
    return hit_between(0, std::numeric_limits<double>::denorm_min(),
                       "they face each other only at the start");
  if (!turn_a.isZero(0)) return undecided("two half-spaces that turn alike are not judged in motion");
  const Rational end = room->start + room->rate;
  if (end > 0) return apart_throughout(scaled(std::min(room->start, end), room->normal));
  const Rational t = room->start / -room->rate;
  const double lo = below(t);
  return hit_between(lo, exact(lo) == t ? lo : std::nextafter(lo, infinity));
}

Bracket gap_of_half_spaces(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                           double t) {
  const bool turn = visible_turn(a, motion_a.angular) != visible_turn(b, motion_b.angular) ||
                    !visible_turn(a, motion_a.angular).isZero(0);
  if (is_singular(a) || is_singular(b) || (turn && t > 0)) return {-infinity, infinity};
  const auto room = room_between(a, motion_a, b, motion_b);
  if (!room) return {-infinity, -infinity};
  return scaled(room->start + exact(t) * room->rate, room->normal);
}

}  // namespace touchstone::referee
