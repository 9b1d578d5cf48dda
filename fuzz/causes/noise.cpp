#include <algorithm>
#include <cmath>

#include "fuzz/causes/group.h"

namespace touchstone::fuzz {
namespace {

double upper_quartile(std::vector<double>& v) {
  constexpr double quartile = 0.75;
  const auto at = static_cast<std::size_t>(std::ceil(quartile * static_cast<double>(v.size())));
  std::sort(v.begin(), v.end());
  return v[at - 1];
}

}  // namespace

Noise noise_of(std::span<const FindingClass> classes, std::span<const Representative> all) {
  std::map<std::string, std::vector<double>> by_path;
  std::vector<double> every;
  for (const Representative& r : all) {
    if (!r.second || !r.second->responses.shown || !r.first.responses.shown) continue;
    if (is_fragile(r.first.responses) || is_fragile(r.second->responses)) continue;
    const double d = difference(r.first, *r.second);
    every.push_back(d);
    by_path[classes[r.of_class].path].push_back(d);
  }
  constexpr std::size_t fewest_pairs = 4;  // fewer have no quartile
  Noise noise;
  if (every.size() < fewest_pairs) return noise;
  const double usual = upper_quartile(every);
  for (const FindingClass& c : classes) noise[c.path] = usual;
  for (auto& [path, measured] : by_path)
    if (measured.size() >= fewest_pairs) noise[path] = std::max(noise[path], upper_quartile(measured));
  return noise;
}

}  // namespace touchstone::fuzz
