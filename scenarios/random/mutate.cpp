#include "scenarios/random/mutate.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/base/input_error.h"
#include "scenarios/random/numbers.h"
#include "scenarios/random/place.h"

namespace touchstone::fuzz {
namespace {

double nudged(double v, int ulps) {
  const double to =
      ulps < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i) v = std::nextafter(v, to);
  return v;
}

double simple(double v, std::uint8_t argument) {
  constexpr std::array values{0.0, -0.0, 1.0, -1.0, 0.5, -0.5};
  if (argument < 128) return values[argument % values.size()];
  const int bits = 1 + argument % 24;
  int exponent = 0;
  const double m = std::frexp(v, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(m, bits)), exponent - bits);
}

void change_number(std::vector<double*>& all, const Change& c, Change::Kind kind) {
  if (all.empty()) return;
  double& v = *all[c.number % all.size()];
  const auto signed_argument = static_cast<std::int8_t>(c.argument);
  if (kind == Change::Kind::nudge) v = nudged(v, signed_argument);
  if (kind == Change::Kind::scale) v = std::ldexp(v, signed_argument / 16);
  if (kind == Change::Kind::copy) {
    const double other = *all[c.argument / 2 % all.size()];
    v = c.argument % 2 == 0 ? other : -other;
  }
  if (kind == Change::Kind::offset) v += std::ldexp(c.argument < 128 ? 1.0 : -1.0, -(c.argument % 60));
  if (kind == Change::Kind::simple) v = simple(v, c.argument);
}

// Origins nearer than this give no direction worth steering along.
constexpr double least_origin_distance = 1e-6;

// Directions along which faces are parallel: the first body's axes, the world axes, the line between the
// origins.
Vec3 steering_direction(const Scene& s, std::uint16_t choice) {
  const Vec3 between = s.bodies[1].pose.translation - s.bodies[0].pose.translation;
  if (choice % 7 == 6 && between.norm() > least_origin_distance) return between.normalized();
  const Vec3 axis = Vec3::Unit(choice % 3) * (choice % 2 == 0 ? 1 : -1);
  return choice % 7 < 3 ? axis : Vec3((rotation_matrix(s.bodies[0].pose.rotation) * axis).normalized());
}

void steer(Scene& s, const Change& c) {
  if (s.bodies.size() != 2) return;
  for (const int i : {0, 1})
    if (!is_convex(kind_of(s.shape_of(i)))) return;
  const double size = mean_extent(s);
  const int step = c.argument % 32;
  const double magnitude = step == 0 ? 0 : step < 8 ? step * 0x1p-53 : std::ldexp(1.0, -2 * (step - 7));
  Rng rng = Rng::stream(c.number, c.argument);
  const double sideways = c.argument < 96 ? 0 : 0.3;
  place_along(rng, s, steering_direction(s, c.number), (c.number & 0x8000 ? -magnitude : magnitude) * size,
              sideways);
}

}  // namespace

Change random_change(Rng& rng) {
  Change c;
  c.number = static_cast<std::uint16_t>(rng.below(65536));
  c.kind = static_cast<std::uint8_t>(rng.below(static_cast<std::uint64_t>(Change::Kind::kinds)));
  c.argument = static_cast<std::uint8_t>(rng.below(256));
  return c;
}

bool apply(const Change& change, Case& c) {
  const auto kind = static_cast<Change::Kind>(change.kind % static_cast<int>(Change::Kind::kinds));
  try {
    if (kind == Change::Kind::steer) {
      steer(c.scene, change);
    } else if (kind == Change::Kind::align) {
      if (c.scene.bodies.size() >= 2) c.scene.bodies[1].pose.rotation = c.scene.bodies[0].pose.rotation;
    } else {
      auto all = numbers(c);
      change_number(all, change, kind);
      renew(c);
    }
    validate(c.scene);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace touchstone::fuzz
