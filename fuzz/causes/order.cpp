#include "fuzz/causes/causes.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace touchstone::fuzz {
namespace {

bool is_more_frequent(const Cause& x, const Cause& y) {
  return x.wrong != y.wrong ? x.wrong > y.wrong : x.id < y.id;
}

// Moves the elements of `some` to the end of `order`, farthest first.
void append_farthest_first(std::vector<std::size_t> some, const std::vector<Cause>& causes,
                           const std::function<double(std::size_t, std::size_t)>& distance,
                           std::vector<std::size_t>& order) {
  std::sort(some.begin(), some.end(),
            [&](std::size_t x, std::size_t y) { return is_more_frequent(causes[x], causes[y]); });
  std::vector<double> nearest(some.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  while (!some.empty()) {
    const std::size_t taken = some[next];
    order.push_back(taken);
    some.erase(some.begin() + static_cast<std::ptrdiff_t>(next));
    nearest.erase(nearest.begin() + static_cast<std::ptrdiff_t>(next));
    for (std::size_t i = 0; i < some.size(); ++i) nearest[i] = std::min(nearest[i], distance(taken, some[i]));
    next = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
  }
}

}  // namespace

std::vector<std::size_t> reading_order(const std::vector<Cause>& causes,
                                       const std::function<double(std::size_t, std::size_t)>& distance) {
  std::map<std::pair<bool, Severity>, std::vector<std::size_t>> ranks;
  for (std::size_t i = 0; i < causes.size(); ++i)
    ranks[{!causes[i].documented.empty(), causes[i].severity}].push_back(i);
  std::vector<std::size_t> order;
  for (auto& [rank, some] : ranks) append_farthest_first(std::move(some), causes, distance, order);
  return order;
}

}  // namespace touchstone::fuzz
