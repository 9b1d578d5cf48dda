// One body larger: what vanishes was bound to a size, to a ratio or to a coincidence of sizes.
#include <cmath>

#include "fuzz/causes/intervention.h"
#include "fuzz/causes/interventions/true_pair.h"
#include "fuzz/judge/exact_map.h"

namespace touchstone::fuzz {
namespace {

constexpr double growth = 1.125, much = 16;

// The body with a shape of its own, `by` times as large; nothing for a half-space.
std::optional<Case> grown(const Case& c, int of, double by) {
  const auto body = static_cast<std::size_t>(of);
  Shape shape = c.scene.shape_of(of);
  if (kind_of(shape) == ShapeKind::half_space) return std::nullopt;
  change_numbers(shape, [by](auto& v, Domain) { v *= by; });
  Case r = c;
  r.scene.shapes.push_back(std::move(shape));
  r.scene.bodies[body].shape = static_cast<int>(r.scene.shapes.size()) - 1;
  return r;
}

std::optional<Case> grown_a_little(const Case& c, bool second) {
  if (!asks_about_pair(c)) return std::nullopt;
  return grown(c, second ? c.queries[0].b : c.queries[0].a, growth);
}

// The gap stays as it is.
std::optional<Case> grown_in_place(const Case& c, bool second, double by) {
  const auto before = true_pair(c);
  if (!before) return std::nullopt;
  const auto larger = grown(c, second ? before->b : before->a, by);
  if (!larger) return std::nullopt;
  return with_gap(*larger, before->gap);
}

}  // namespace

std::optional<Case> grow_a(const Case& c) { return grown_a_little(c, false); }
std::optional<Case> grow_b(const Case& c) { return grown_a_little(c, true); }
std::optional<Case> grow_a_much(const Case& c) { return grown_in_place(c, false, much); }
std::optional<Case> grow_b_much(const Case& c) { return grown_in_place(c, true, much); }

std::optional<Case> make_equal(const Case& c) {
  const auto p = true_pair(c);
  if (!p) return std::nullopt;
  const double a = extent(c.scene.shape_of(p->a)), b = extent(c.scene.shape_of(p->b));
  if (!(a > 0) || !(b > 0) || !std::isfinite(a) || !std::isfinite(b) || a == b) return std::nullopt;
  return a < b ? grown_in_place(c, false, b / a) : grown_in_place(c, true, a / b);
}

}  // namespace touchstone::fuzz
