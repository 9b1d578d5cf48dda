// The history of a scene and its filters.
#include "fuzz/causes/intervention.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {

std::optional<Case> insert_final_poses(const Case& c) {
  if (c.scene.script.empty()) return std::nullopt;
  Truth truth(c.scene);
  if (truth.steps().empty()) return std::nullopt;
  const auto& last = truth.steps().back().pose;
  Case r = c;
  r.scene.script.clear();
  for (std::size_t i = 0; i < last.size(); ++i)
    if (last[i]) r.scene.script.push_back({Step::Op::insert, static_cast<int>(i), last[i]});
  r.scene.script.push_back({});
  return r;
}

std::optional<Case> leave_groups(const Case& c) {
  Case r = c;
  bool any = !r.scene.ignored.empty();
  r.scene.ignored.clear();
  for (Body& b : r.scene.bodies) {
    any |= b.group >= 0;
    b.group = -1;
  }
  if (!any) return std::nullopt;
  return r;
}

}  // namespace touchstone::fuzz
