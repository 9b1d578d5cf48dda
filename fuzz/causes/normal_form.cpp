#include "fuzz/causes/plain_cases.h"

#include <algorithm>
#include <span>
#include <vector>

#include "core/base/input_error.h"
#include "fuzz/causes/intervention.h"
#include "fuzz/causes/interventions/true_pair.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {
namespace {

// About two bodies, without a history.
bool is_about_two(const Case& c) {
  return c.scene.bodies.size() == 2 && c.scene.script.empty() && !c.queries.empty() &&
         c.queries[0].question != Question::swept_candidates;
}

bool is_valid(const Case& c) try {
  validate(c.scene);
  return true;
} catch (const InputError&) {
  return false;
}

bool is_about_scene(const Case& c) {
  return !c.queries.empty() && std::ranges::none_of(c.queries, is_pair_question, &Query::question);
}

// Without those in which shapes move that cannot.
std::vector<Case> valid(std::vector<Case> all) {
  std::erase_if(all, [](const Case& plain) { return !is_valid(plain); });
  return all;
}

// Where the gap has no value, as that of a mesh that overlaps, it stands for half of the size.
std::optional<TruePair> pair_with_a_gap(const Case& c) {
  if (auto p = true_pair(c)) return p;
  const auto bodies = pair_of(c);
  if (!bodies) return std::nullopt;
  Truth truth(c.scene);
  const referee::Verdict verdict = truth.pair(0, bodies->first, bodies->second).verdict;
  if (verdict == referee::Verdict::undecided) return std::nullopt;
  const double gap = verdict == referee::Verdict::overlap ? -0.5 : 0.5;
  return TruePair{bodies->first, bodies->second, gap, Vec3::UnitX(), 1};
}

std::vector<Case> plain_cases(const Case& c, PlainForms forms) {
  if (is_motion_question(c.queries[0].question)) return valid(plain_impacts(c, *pair_of(c)));
  const auto p = forms == PlainForms::all ? pair_with_a_gap(c) : true_pair(c);
  if (!p) return {};
  return valid(forms == PlainForms::all ? plain_pairs(c, *p) : nearest_plain_pairs(c, *p));
}

// Put in batches, because the first ones show most faults.
std::optional<Case> first_shown(std::span<const Case> cases, const StillShows& still) {
  constexpr std::size_t batch = 16;
  for (; !cases.empty(); cases = cases.subspan(std::min(batch, cases.size()))) {
    const auto part = cases.first(std::min(batch, cases.size()));
    const std::vector<bool> shows = still(part);
    for (std::size_t i = 0; i < part.size(); ++i)
      if (shows[i]) return part[i];
  }
  return std::nullopt;
}

using Change = std::optional<Case> (*)(const Case&);

// With the gap that the case has.
std::optional<Case> in_place(const Case& c, Change change) {
  const auto before = true_pair(c);
  if (!before) return std::nullopt;
  const auto changed = change(c);
  if (!changed) return std::nullopt;
  return with_gap(*changed, before->gap);
}

class Plainer {
 public:
  Plainer(Case c, const StillShows& still) : best_(std::move(c)), still_(still) {}

  bool take(const std::optional<Case>& plainer) {
    if (!plainer || !is_valid(*plainer) || !still_({&*plainer, 1})[0]) return false;
    best_ = *plainer;
    return true;
  }
  bool take_in_place(Change change) { return take(in_place(best_, change)); }

  Case run(PlainForms forms) {
    if (forms == PlainForms::all)
      for (const Change change : {stop_turning, stop_turning_a, stop_turning_b, move_b_only})
        take(change(best_));
    if (!take_in_place(a_as_sphere)) take_in_place(a_as_cube);
    if (!take_in_place(b_as_sphere)) take_in_place(b_as_cube);
    take_in_place(set_a_upright);
    take_in_place(set_b_upright);
    if (is_motion_question(best_.queries[0].question)) take(meet_half_way(best_));
    return best_;
  }

 private:
  Case best_;
  const StillShows& still_;
};

}  // namespace

Case normal_form(const Case& c, const StillShows& still, PlainForms forms) {
  if (forms == PlainForms::all && is_about_scene(c)) {
    const bool moving = c.queries[0].question == Question::swept_candidates;
    if (auto shown = first_shown(valid(plain_scenes(c, moving)), still)) return *std::move(shown);
  }
  if (!is_about_two(c)) return c;
  if (forms == PlainForms::nearest && is_motion_question(c.queries[0].question)) return c;
  const std::vector<Case> plain = plain_cases(c, forms);
  if (auto shown = first_shown(plain, still)) return *std::move(shown);
  if (plain.empty()) return c;
  return Plainer(c, still).run(forms);
}

}  // namespace touchstone::fuzz
