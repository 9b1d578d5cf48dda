#include "fuzz/shrink/shrink_both.h"

#include <algorithm>

#include "fuzz/shrink/defensible.h"

namespace touchstone::fuzz {
namespace {

// The predicate costs less than an engine's answer and its judgement, so it comes first.
StillShows as_long_as(bool (*is_fit)(const Case&), const StillShows& still) {
  return [is_fit, &still](std::span<const Case> cases) {
    std::vector<bool> shows(cases.size(), false);
    std::vector<Case> asked;
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (is_fit(cases[i])) {
        shows[i] = true;
        asked.push_back(cases[i]);
      }
    if (asked.empty()) return shows;
    const std::vector<bool> answers = still(asked);
    for (std::size_t i = 0, next = 0; i < cases.size(); ++i)
      if (shows[i]) shows[i] = answers[next++];
    return shows;
  };
}

class BothShrinker {
 public:
  BothShrinker(const Case& c, const StillShows& still, std::size_t max_tries)
      : case_(c), still_(still), max_tries_(max_tries) {}

  ShrunkPair run() {
    if (!shows(case_)) {
      result_.minimum.smallest = case_;
      result_.minimum.before = result_.minimum.after = measure(case_);
      return std::move(result_);
    }
    shrink_defensible(case_, max_tries_ / 2);
    const bool is_found = result_.defensible.has_value();
    shrink_to_minimum(is_found ? left() : left() * 3 / 4);
    if (is_found || result_.minimum.exit == ShrinkExit::not_shown) return std::move(result_);
    if (is_defensible(result_.minimum.smallest)) {
      result_.defensible = result_.minimum;
      result_.defensible->tried = 0;
      return std::move(result_);
    }
    shrink_defensible(result_.minimum.smallest, left());
    if (result_.defensible && result_.defensible->after < result_.minimum.after) shrink_to_minimum(left());
    return std::move(result_);
  }

 private:
  std::size_t left() const { return max_tries_ - std::min(result_.tried(), max_tries_); }

  bool shows(const Case& c) {
    ++result_.forms_tried;
    return still_({&c, 1})[0];
  }

  // From the defensible case if there is a small one: this takes fewer tries.
  void shrink_to_minimum(std::size_t tries) {
    const CaseSize before = measure(case_);
    const bool from_defensible = result_.defensible && result_.defensible->after <= before;
    const std::size_t tried_before = result_.minimum.tried;
    result_.minimum = shrink(from_defensible ? result_.defensible->smallest : case_, still_,
                             std::max<std::size_t>(tries, 1));
    result_.minimum.before = before;
    result_.minimum.tried += tried_before;
  }

  void shrink_defensible(const Case& start, std::size_t tries) {
    const std::optional<Case> shown = defensible_form(start, tries / 2);
    if (!shown) return;
    result_.defensible =
        shrink(*shown, as_long_as(is_defensible, still_), std::max<std::size_t>(tries / 2, 1));
    result_.defensible->before = measure(case_);
  }

  // The first form that is defensible and shows the finding. They are put one at a time, because an answer
  // may take a second.
  std::optional<Case> defensible_form(const Case& start, std::size_t tries) {
    const std::size_t most = result_.forms_tried + tries;
    for (const Case& form : defensible_forms(start)) {
      if (result_.forms_tried >= most) return std::nullopt;
      if (is_defensible(form) && shows(form)) return form;
    }
    return std::nullopt;
  }

  const Case& case_;
  const StillShows& still_;
  const std::size_t max_tries_;
  ShrunkPair result_;
};

}  // namespace

ShrunkPair shrink_both(const Case& c, const StillShows& still, std::size_t max_tries) {
  return BothShrinker(c, still, max_tries).run();
}

ShrunkPair shrink_solid(const Case& c, const StillShows& still, std::size_t max_tries) {
  constexpr std::size_t most_forms = 8;  // that are asked: c itself and those nearest to it
  const StillShows solid = as_long_as(is_solid, still);
  std::size_t tried = 0;
  for (const Case& form : defensible_forms(c)) {
    if (tried >= std::min(most_forms, max_tries)) break;
    if (!is_solid(form)) continue;
    ++tried;
    if (!still({&form, 1})[0]) continue;
    ShrunkPair r = shrink_both(form, solid, max_tries - tried);
    r.minimum.before = measure(c);
    r.forms_tried += tried;
    return r;
  }
  ShrunkPair r = shrink_both(c, still, max_tries - tried);
  r.forms_tried += tried;
  return r;
}

}  // namespace touchstone::fuzz
