#include "core/broad/scene_stats.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace touchstone::broad {
namespace {

constexpr std::size_t sample_size = 1024;

double quantile(std::vector<double>& v, double q) {
  const auto k = static_cast<std::ptrdiff_t>(q * static_cast<double>(v.size() - 1));
  std::nth_element(v.begin(), v.begin() + k, v.end());
  return v[static_cast<std::size_t>(k)];
}

double deviation(const std::vector<double>& v) {
  double mean = 0, sum = 0;
  for (const double x : v) mean += x / static_cast<double>(v.size());
  for (const double x : v) sum += (x - mean) * (x - mean);
  return std::sqrt(sum / static_cast<double>(v.size()));
}

}  // namespace

SceneStats sample_scene(const BoxStore& store) {
  SceneStats stats;
  std::vector<double> centre[3], size[3], largest;
  const std::size_t step = std::max<std::size_t>(1, store.slots() / sample_size);
  for (std::size_t s = 0; s < store.slots(); s += step) {
    const Aabb& b = store.boxes()[s];
    const Vec3 c = b.lo / 2 + b.hi / 2, extent = b.hi - b.lo;
    if (!store.is_present(static_cast<BoxStore::Slot>(s)) || !c.allFinite() || !extent.allFinite()) continue;
    for (int k = 0; k < 3; ++k) centre[k].push_back(c[k]), size[k].push_back(extent[k]);
    largest.push_back(extent.maxCoeff());
  }
  if (largest.empty()) return stats;
  for (int k = 0; k < 3; ++k) {
    stats.median_size[k] = quantile(size[k], 0.5);
    stats.spread[k] = deviation(centre[k]);
    stats.low[k] = quantile(centre[k], 1.0 / 64), stats.high[k] = quantile(centre[k], 63.0 / 64);
  }
  const double median = quantile(largest, 0.5), high = quantile(largest, 0.99);
  stats.largest_ratio = median > 0 ? high / median : 1;
  return stats;
}

int best_axis(const SceneStats& s) {
  int best = 0;
  double most = -1;
  for (int k = 0; k < 3; ++k) {
    const double room = s.median_size[k] > 0 ? s.spread[k] / s.median_size[k] : s.spread[k];
    if (room > most) most = room, best = k;
  }
  return best;
}

}  // namespace touchstone::broad
