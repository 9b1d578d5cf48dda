#include "fuzz/causes/normal_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/input_error.h"
#include "fuzz/causes/intervention.h"
#include "fuzz/causes/interventions/true_pair.h"

namespace touchstone::fuzz {
namespace {

// About two bodies at rest, without a history.
bool is_plain_question(const Case& c) {
  return c.scene.bodies.size() == 2 && c.scene.script.empty() && !c.queries.empty() &&
         c.queries[0].question != Question::time_of_impact &&
         c.queries[0].question != Question::swept_candidates;
}

double power_of_two_near(double x) {
  constexpr double touching = 0x1p-50;  // of the size: less is a rounding
  if (std::abs(x) < touching) return 0;
  return std::copysign(std::exp2(std::round(std::log2(std::abs(x)))), x);
}

// Shapes of half extent 1, side by side along x; the gap is a share of that.
Case side_by_side(const Case& c, const TruePair& p, const Shape& a, const Shape& b, double gap) {
  Case r = c;
  const bool is_shared = a == b && c.scene.bodies[0].shape == c.scene.bodies[1].shape;
  r.scene.shapes = is_shared ? std::vector{a} : std::vector{a, b};
  Body &first = r.scene.bodies[static_cast<std::size_t>(p.a)],
       &second = r.scene.bodies[static_cast<std::size_t>(p.b)];
  first.pose = second.pose = {};
  first.shape = 0;
  second.shape = is_shared ? 0 : 1;
  second.pose.translation.x() = 2 + std::max(-2.0, gap);
  return r;
}

std::vector<Case> plain_pairs(const Case& c) {
  const auto p = true_pair(c);
  if (!p) return {};
  const double gap = power_of_two_near(p->gap / p->size);
  const Shape sphere = Sphere{1}, cube = Box{Vec3::Ones()};
  std::vector<Case> all;
  for (const auto& [a, b] : {std::pair{sphere, sphere}, {cube, cube}, {sphere, cube}, {cube, sphere}})
    all.push_back(side_by_side(c, *p, a, b, gap));
  return all;
}

// With the gap that the case has.
std::optional<Case> in_place(const Case& c, std::optional<Case> (*change)(const Case&)) {
  const auto before = true_pair(c);
  if (!before) return std::nullopt;
  const auto changed = change(c);
  if (!changed) return std::nullopt;
  return with_gap(*changed, before->gap);
}

bool is_valid(const Case& c) try {
  validate(c.scene);
  return true;
} catch (const InputError&) {
  return false;
}

}  // namespace

Case normal_form(const Case& c, const StillShows& still) {
  if (!is_plain_question(c)) return c;
  const std::vector<Case> pairs = plain_pairs(c);
  if (pairs.empty()) return c;
  const std::vector<bool> shows = still(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (shows[i]) return pairs[i];
  Case best = c;
  const auto try_change = [&](std::optional<Case> (*change)(const Case&)) {
    const auto plainer = in_place(best, change);
    if (!plainer || !is_valid(*plainer) || !still({&*plainer, 1})[0]) return false;
    best = *plainer;
    return true;
  };
  if (!try_change(a_as_sphere)) try_change(a_as_cube);
  if (!try_change(b_as_sphere)) try_change(b_as_cube);
  try_change(set_a_upright);
  try_change(set_b_upright);
  return best;
}

}  // namespace touchstone::fuzz
