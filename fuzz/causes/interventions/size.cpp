// One body a little larger: what vanishes was bound to a size or to a coincidence of sizes.
#include "fuzz/causes/intervention.h"
#include "fuzz/judge/exact_map.h"

namespace touchstone::fuzz {
namespace {

constexpr double growth = 1.125;

std::optional<Case> grown(const Case& c, bool second) {
  if (!asks_about_pair(c)) return std::nullopt;
  Case r = c;
  const auto body = static_cast<std::size_t>(second ? c.queries[0].b : c.queries[0].a);
  Shape shape = c.scene.shapes[static_cast<std::size_t>(c.scene.bodies[body].shape)];
  if (kind_of(shape) == ShapeKind::half_space) return std::nullopt;
  change_numbers(shape, [](auto& v, Domain) { v *= growth; });
  r.scene.shapes.push_back(std::move(shape));
  r.scene.bodies[body].shape = static_cast<int>(r.scene.shapes.size()) - 1;
  return r;
}

}  // namespace

std::optional<Case> grow_a(const Case& c) { return grown(c, false); }
std::optional<Case> grow_b(const Case& c) { return grown(c, true); }

}  // namespace touchstone::fuzz
