#include "core/broad/scene_stats.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/broad/key_sort.h"
#include "core/broad/pair_kernels.h"

namespace touchstone::broad {
namespace {

// A sample of 256 costs about as much as 1000 boxes, and the character of a scene rarely changes. One box in
// 64 of a large scene detects clusters of a thousand boxes.
constexpr int queries_per_sample = 16;
// Centres beyond these quantiles, and the sides beyond the 99th percentile, are treated as outliers.
constexpr double low_quantile = 1.0 / 64, high_quantile = 63.0 / 64, largest_quantile = 0.99;
constexpr std::size_t min_sample = 256, max_sample = 4096, sampled_share = 64;

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

struct Sample {
  std::vector<double> centre[3], size[3], largest;
  void add(const Aabb& b) {
    const Vec3 c = b.lo / 2 + b.hi / 2, extent = b.hi - b.lo;
    if (!c.allFinite() || !extent.allFinite()) return;
    for (int k = 0; k < 3; ++k) {
      centre[k].push_back(c[k]);
      size[k].push_back(extent[k]);
    }
    largest.push_back(extent.maxCoeff());
  }
};

// Share of the boxes per unit of volume around the average box: the probability that two sampled boxes lie in
// one cell, divided by the cell's volume. Clusters make it larger than one over the scene's volume, provided
// that the cells are as small as the clusters: uses the finest of 2, 4, … 1024 cells per axis in which enough
// pairs of the sample meet. One sort suffices, because cells of all sizes are prefixes of a Morton code.
double seen_density(const Sample& sample, const SceneStats& s) {
  constexpr int bits = 10;
  constexpr double enough = 128;
  const std::size_t n = sample.largest.size();
  double volume = 1;
  std::vector<std::uint32_t> at(n, 0);
  for (int k = 0; k < 3; ++k) {
    const double extent = s.high[k] - s.low[k];
    volume *= std::max(extent, s.median_size[k]);
    for (std::size_t i = 0; i < n; ++i) {
      const double t = extent > 0 ? (sample.centre[k][i] - s.low[k]) / extent * (1 << bits) : 0;
      at[i] |= spread_bits(static_cast<std::uint32_t>(std::clamp(t, 0.0, (1 << bits) - 1.0))) << k;
    }
  }
  std::sort(at.begin(), at.end());
  const double pairs = static_cast<double>(n) * static_cast<double>(n - 1);
  for (int shift = 0; shift < 3 * bits; shift += 3) {
    double same = 0;
    for (std::size_t i = 0, j = 0; i < n; i = j) {
      while (j < n && at[j] >> shift == at[i] >> shift) ++j;
      same += static_cast<double>(j - i) * static_cast<double>(j - i - 1);
    }
    if (same >= std::min(enough, pairs)) return same / pairs * std::exp2(3 * bits - shift) / volume;
  }
  return n > 1 ? 1 / volume : 0;
}

SceneStats summary(Sample& sample) {
  SceneStats stats;
  if (sample.largest.empty()) return stats;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> centre = sample.centre[k];
    stats.median_size[k] = quantile(sample.size[k], 0.5);
    stats.spread[k] = deviation(centre);
    stats.low[k] = quantile(centre, low_quantile);
    stats.high[k] = quantile(centre, high_quantile);
  }
  stats.density = seen_density(sample, stats);
  const double median = quantile(sample.largest, 0.5), high = quantile(sample.largest, largest_quantile);
  stats.largest_ratio = median > 0 ? high / median : 1;
  return stats;
}

std::size_t step_through(std::size_t n) {
  return std::max<std::size_t>(1, n / std::clamp(n / sampled_share, min_sample, max_sample));
}

}  // namespace

SceneStats sample_scene(const BoxStore& store) {
  Sample sample;
  for (std::size_t s = 0; s < store.slots(); s += step_through(store.slots()))
    if (store.is_present(static_cast<BoxStore::Slot>(s))) sample.add(store.boxes()[s]);
  return summary(sample);
}

SceneStats sample_boxes(const KeyBox* boxes, std::span<const std::uint32_t> codes) {
  Sample sample;
  for (std::size_t i = 0; i < codes.size(); i += step_through(codes.size())) {
    const KeyBox& k = boxes[codes[i] & slot_mask];
    sample.add({Vec3(value_of(k.lo[0]), value_of(k.lo[1]), value_of(k.lo[2])),
                Vec3(value_of(k.hi[0]), value_of(k.hi[1]), value_of(k.hi[2]))});
  }
  return summary(sample);
}

const SceneStats& RememberedStats::of(const BoxStore& store) {
  if (age_ == 0 || store.present() > 2 * present_ || present_ > 2 * store.present()) {
    stats_ = sample_scene(store);
    age_ = queries_per_sample;
    present_ = store.present();
  }
  --age_;
  return stats_;
}

int best_axis(const SceneStats& s) {
  int best = 0;
  double most = -1;
  for (int k = 0; k < 3; ++k) {
    const double room = s.median_size[k] > 0 ? s.spread[k] / s.median_size[k] : s.spread[k];
    if (room > most) {
      most = room;
      best = k;
    }
  }
  return best;
}

}  // namespace touchstone::broad
