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
  for (const Representative& r : all) {
    if (!r.second || !r.second->responses.shown || !r.first.responses.shown) continue;
    if (is_fragile(r.first.responses) || is_fragile(r.second->responses)) continue;
    const Difference d = difference(r.first, *r.second);
    Measured& m = by_path[classes[r.of_class].path];
    m.shares.push_back(d.share);
    m.octaves.push_back(d.octaves);
  }
  constexpr std::size_t fewest_pairs = 4;  // fewer have no quartile
  Noise noise;
  std::vector<double> shares, octaves;
  for (auto& [path, m] : by_path) {
    if (m.shares.size() < fewest_pairs) continue;
    noise[path] = {upper_quartile(m.shares), upper_quartile(m.octaves)};
    shares.push_back(noise[path].share);
    octaves.push_back(noise[path].octaves);
  }
  if (shares.empty()) return noise;
  const Difference usual{upper_quartile(shares), upper_quartile(octaves)};
  for (const FindingClass& c : classes) noise.try_emplace(c.path, usual);
  return noise;
}

}  // namespace touchstone::fuzz
