#include "fuzz/shrink/shrink_both.h"

#include <algorithm>

#include "fuzz/shrink/defensible.h"
#include "fuzz/shrink/defensible_forms.h"

namespace touchstone::fuzz {
namespace {

// The predicate costs less than an engine's answer and its judgement, so it comes first.
StillShows while_up_to(Standard standard, const StillShows& still) {
  return [standard, &still](std::span<const Case> cases) {
    std::vector<bool> shows(cases.size(), false);
    std::vector<Case> asked;
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (standard(cases[i])) {
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
  BothShrinker(const Case& c, const StillShows& still, std::size_t max_tries,
               std::span<const Standard> standards)
      : case_(c), still_(still), max_tries_(max_tries), standards_(standards) {}

  ShrunkPair run() {
    if (!shows(case_)) {
      result_.minimum.smallest = case_;
      result_.minimum.before = result_.minimum.after = measure(case_);
      return std::move(result_);
    }
    shrink_defensible(standards_.front(), case_, max_tries_ / 2);
    const bool is_found = result_.defensible.has_value();
    shrink_to_minimum(is_found ? left() : left() * 3 / 4);
    if (is_found || result_.minimum.exit == ShrinkExit::not_shown) return std::move(result_);
    for (std::size_t i = 0; i < standards_.size() && !result_.defensible; ++i) {
      const std::size_t share = left() / (standards_.size() - i);
      if (i > 0) shrink_defensible(standards_[i], case_, share / 2);
      if (!result_.defensible) from_minimum(standards_[i], i > 0 ? share / 2 : share);
    }
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

  void from_minimum(Standard standard, std::size_t tries) {
    if (standard(result_.minimum.smallest)) {
      result_.defensible = result_.minimum;
      result_.defensible->tried = 0;
      return;
    }
    shrink_defensible(standard, result_.minimum.smallest, tries);
    if (result_.defensible && result_.defensible->after < result_.minimum.after) shrink_to_minimum(left());
  }

  void shrink_defensible(Standard standard, const Case& start, std::size_t tries) {
    const std::optional<Case> shown = form_up_to(standard, start, tries / 2);
    if (!shown) return;
    result_.defensible = shrink(*shown, while_up_to(standard, still_), std::max<std::size_t>(tries / 2, 1));
    result_.defensible->before = measure(case_);
  }

  // The first form that meets the standard and shows the finding. They are put one at a time, because an
  // answer may take a second.
  std::optional<Case> form_up_to(Standard standard, const Case& start, std::size_t tries) {
    const std::size_t most = result_.forms_tried + tries;
    for (const Case& form : defensible_forms(start)) {
      if (result_.forms_tried >= most) return std::nullopt;
      if (standard(form) && shows(form)) return form;
    }
    return std::nullopt;
  }

  const Case& case_;
  const StillShows& still_;
  const std::size_t max_tries_;
  const std::span<const Standard> standards_;
  ShrunkPair result_;
};

}  // namespace

ShrunkPair shrink_both(const Case& c, const StillShows& still, std::size_t max_tries,
                       std::span<const Standard> standards) {
  return BothShrinker(c, still, max_tries, standards).run();
}

}  // namespace touchstone::fuzz
