#include "reports/record/examples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/hash.h"
#include "core/math/rng.h"
#include "reports/record/stored.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {
namespace {

// Without NaN and -0, whose place in the order would depend on what they are compared with.
double comparable(double error) {
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error + 0.0;
}

// Each case once, sorted by index.
void unite(std::vector<Example>& all) {
  for (Example& e : all) e.error_in_l = comparable(e.error_in_l);
  std::sort(all.begin(), all.end(), [](const Example& x, const Example& y) {
    return x.index != y.index ? x.index < y.index : x.error_in_l > y.error_in_l;
  });
  const auto same = [](const Example& x, const Example& y) { return x.index == y.index; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
}

// Marks those of `all` that have the smallest hashes.
void mark_sample(const std::vector<Example>& all, std::string_view key, std::vector<bool>& kept) {
  const std::uint64_t seed = Hasher().add(key).value();
  std::vector<std::pair<std::uint64_t, std::size_t>> drawn;
  for (std::size_t i = 0; i < all.size(); ++i) drawn.emplace_back(Rng::stream(seed, all[i].index).next(), i);
  std::sort(drawn.begin(), drawn.end());
  for (std::size_t i = 0; i < sampled_examples; ++i) kept[drawn[i].second] = true;
}

}  // namespace

std::vector<Example> kept_examples(std::vector<Example> all, std::string_view key) {
  unite(all);
  if (all.size() <= sampled_examples) return all;
  std::vector<bool> kept(all.size());
  const auto mark = [&](auto at) { kept[static_cast<std::size_t>(at - all.begin())] = true; };
  mark(all.begin());
  mark(std::max_element(all.begin(), all.end(),
                        [](const Example& x, const Example& y) { return x.error_in_l < y.error_in_l; }));
  mark(std::min_element(all.begin(), all.end(),
                        [](const Example& x, const Example& y) { return x.size < y.size; }));
  mark_sample(all, key, kept);
  std::vector<Example> some;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (kept[i]) some.push_back(std::move(all[i]));
  return some;
}

Json to_json(const Example& e) {
  return {{"index", e.index},
          {"error_in_l", number(e.error_in_l)},
          {"bodies", e.size.bodies},
          {"steps", e.size.steps},
          {"bits", e.size.bits}};
}

std::vector<Example> examples_from_json(const JsonReader& j) {
  const auto items = j.items();
  if (items.size() > most_examples) j.fail("has more examples than are kept");
  std::vector<Example> all;
  for (const JsonReader& item : items) {
    Example e;
    e.index = count_of(item["index"]);
    e.error_in_l = number_from(item["error_in_l"]);
    e.size.bodies = count_of(item["bodies"]);
    e.size.steps = count_of(item["steps"]);
    e.size.bits = count_of(item["bits"]);
    if (std::isnan(e.error_in_l)) item["error_in_l"].fail("is not a number");
    if (!all.empty() && e.index <= all.back().index) item["index"].fail("is not above the one before it");
    all.push_back(std::move(e));
  }
  return all;
}

}  // namespace touchstone::fuzz
