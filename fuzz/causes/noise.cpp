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
  struct Measured {
    std::vector<double> shares, octaves;
  };
  std::map<std::string, Measured> by_path;
  Measured every;
  for (const Representative& r : all) {
    if (!r.second || !r.second->responses.shown || !r.first.responses.shown) continue;
    if (is_fragile(r.first.responses) || is_fragile(r.second->responses)) continue;
    const Difference d = difference(r.first, *r.second);
    for (Measured* m : {&every, &by_path[classes[r.of_class].path]}) {
      m->shares.push_back(d.share);
      m->octaves.push_back(d.octaves);
    }
  }
  constexpr std::size_t fewest_pairs = 4;  // fewer have no quartile
  Noise noise;
  if (every.shares.size() < fewest_pairs) return noise;
  const Difference usual{upper_quartile(every.shares), upper_quartile(every.octaves)};
  for (const FindingClass& c : classes) noise[c.path] = usual;
  for (auto& [path, m] : by_path) {
    if (m.shares.size() < fewest_pairs) continue;
    Difference& n = noise[path];
    n.share = std::max(n.share, upper_quartile(m.shares));
    n.octaves = std::max(n.octaves, upper_quartile(m.octaves));
  }
  return noise;
}

}  // namespace touchstone::fuzz
