// Which examples of a finding are kept: the same in whatever order and groups its cases arrive.
#include "reports/record/examples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/rng.h"
#include "tests/support/catch.h"

using namespace touchstone;
using fuzz::Example;
using fuzz::kept_examples;

namespace {

// Few different errors and sizes, so that many are equal.
std::vector<Example> shown_by(Rng& rng, std::size_t cases) {
  std::vector<Example> all;
  for (std::size_t i = 0; i < cases; ++i) {
    Example e;
    e.index = 3 * i + rng.below(3);
    e.error_in_l = static_cast<double>(rng.below(6));
    e.size = {2 + rng.below(2), rng.below(2), 10 + rng.below(4)};
    all.push_back(e);
    if (!rng.chance(0.2)) continue;
    e.error_in_l = static_cast<double>(rng.below(8));  // shown a second time by the same case
    all.push_back(e);
  }
  return all;
}

std::vector<Example> shuffled(std::vector<Example> all, Rng& rng) {
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[rng.below(i)]);
  return all;
}

std::string text_of(const std::vector<Example>& all) {
  std::string text;
  for (const Example& e : all) text += fuzz::to_json(e).dump() + "\n";
  return text;
}

std::vector<Example> both(std::vector<Example> x, const std::vector<Example>& y) {
  x.insert(x.end(), y.begin(), y.end());
  return x;
}

bool holds(const std::vector<Example>& kept, std::uint64_t index) {
  return std::any_of(kept.begin(), kept.end(), [&](const Example& e) { return e.index == index; });
}

}  // namespace

TEST_CASE("the same examples are kept in any order and any grouping of the cases", "[examples]") {
  Rng rng(1);
  for (int round = 0; round < 300; ++round) {
    const auto all = shown_by(rng, 1 + rng.below(60));
    const std::string whole = text_of(kept_examples(all, "key"));
    CHECK(text_of(kept_examples(shuffled(all, rng), "key")) == whole);
    std::vector<std::vector<Example>> groups(1 + rng.below(6));
    for (const Example& e : shuffled(all, rng)) {
      auto& group = groups[rng.below(groups.size())];
      group = kept_examples(both(group, {e}), "key");
    }
    while (groups.size() > 1) {
      auto& into = groups[rng.below(groups.size() - 1)];
      into = kept_examples(both(into, groups.back()), "key");
      groups.pop_back();
    }
    REQUIRE(text_of(groups[0]) == whole);
    CHECK(text_of(kept_examples(both(groups[0], groups[0]), "key")) == whole);
  }
}

TEST_CASE("the first, the worst and the simplest case are kept, and a sample of the others", "[examples]") {
  Rng rng(2);
  for (int round = 0; round < 100; ++round) {
    const auto all = shuffled(shown_by(rng, 40), rng);
    const auto kept = kept_examples(all, "key");
    CHECK(kept.size() >= fuzz::sampled_examples);
    CHECK(kept.size() <= fuzz::most_examples);
    CHECK(std::is_sorted(kept.begin(), kept.end(),
                         [](const Example& x, const Example& y) { return x.index < y.index; }));
    Example first = all[0], worst = all[0], simplest = all[0];
    for (const Example& e : all) {
      if (e.index < first.index) first = e;
      if (e.error_in_l > worst.error_in_l || (e.error_in_l == worst.error_in_l && e.index < worst.index))
        worst = e;
      if (e.size < simplest.size || (e.size == simplest.size && e.index < simplest.index)) simplest = e;
    }
    CHECK(holds(kept, first.index));
    CHECK(holds(kept, worst.index));
    CHECK(holds(kept, simplest.index));
  }
}

TEST_CASE("the sample favours no case and differs from key to key", "[examples]") {
  std::vector<Example> all(1000);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].index = i;
  std::vector<int> quarters(4);
  std::string last;
  for (int k = 0; k < 200; ++k) {
    const auto kept = kept_examples(all, "key" + std::to_string(k));
    REQUIRE(kept.size() <= fuzz::sampled_examples + 1);  // case 0 is the first, the worst and the simplest
    for (const Example& e : kept)
      if (e.index != 0) ++quarters[e.index / 250];
    CHECK(text_of(kept) != last);
    last = text_of(kept);
  }
  for (const int n : quarters) {  // of about 250
    CHECK(n > 190);
    CHECK(n < 310);
  }
}

TEST_CASE("of a case that is shown twice the larger error is kept; NaN counts as infinite", "[examples]") {
  Example small, large, none;
  small.error_in_l = 1;
  large.error_in_l = 2;
  none.error_in_l = std::numeric_limits<double>::quiet_NaN();
  for (const auto& two : {std::vector{small, large}, std::vector{large, small}}) {
    const auto kept = kept_examples(two, "key");
    REQUIRE(kept.size() == 1);
    CHECK(kept[0].error_in_l == 2);
  }
  for (const auto& two : {std::vector{none, large}, std::vector{large, none}})
    CHECK(std::isinf(kept_examples(two, "key").at(0).error_in_l));
}
