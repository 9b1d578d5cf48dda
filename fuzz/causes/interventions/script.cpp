// The history of a scene and its filters.
#include <algorithm>
#include <vector>

#include "fuzz/causes/intervention.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {
namespace {
constexpr double far_away = 256;
}

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

namespace {

// The case with a script in which the steps are inserted before the first query.
template <class Steps>
std::optional<Case> before_first_query(const Case& c, Steps&& steps) {
  if (!c.queries.empty() && !is_script_question(c.queries[0].question)) return std::nullopt;
  Truth truth(c.scene);
  if (truth.steps().empty()) return std::nullopt;
  Case r = c;
  r.scene.script = effective_script(c.scene);
  const auto at = std::ranges::find(r.scene.script, Step::Op::query, &Step::op);
  const std::vector<Step> added = steps(truth.steps().front().pose);
  r.scene.script.insert(at, added.begin(), added.end());
  return r;
}
using Poses = std::vector<std::optional<Pose>>;

std::vector<Step> moves_in_place(const Poses& poses) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (poses[i]) steps.push_back({Step::Op::move, static_cast<int>(i), poses[i]});
  return steps;
}
std::vector<Step> moves_away_and_back(const Poses& poses) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!poses[i]) continue;
    Pose away = *poses[i];
    away.translation += Vec3::Constant(far_away);
    steps.push_back({Step::Op::move, static_cast<int>(i), away});
    steps.push_back({Step::Op::move, static_cast<int>(i), poses[i]});
  }
  return steps;
}
std::vector<Step> reinserts(const Poses& poses) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!poses[i]) continue;
    steps.push_back({Step::Op::remove, static_cast<int>(i), std::nullopt});
    steps.push_back({Step::Op::insert, static_cast<int>(i), poses[i]});
  }
  return steps;
}

}  // namespace

std::optional<Case> move_in_place(const Case& c) { return before_first_query(c, moves_in_place); }
std::optional<Case> move_away_and_back(const Case& c) { return before_first_query(c, moves_away_and_back); }
std::optional<Case> reinsert(const Case& c) { return before_first_query(c, reinserts); }
std::optional<Case> query_twice(const Case& c) {
  return before_first_query(c, [](const Poses&) { return std::vector<Step>{{}}; });
}
std::optional<Case> query_afterwards(const Case& c) {
  auto r = before_first_query(c, [](const Poses&) { return std::vector<Step>{}; });
  if (r) r->scene.script.push_back({});
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
