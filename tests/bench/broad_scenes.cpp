#include "tests/bench/broad_scenes.h"

#include <cmath>

#include "core/math/through_float.h"

namespace touchstone::bench {
namespace {

double exact(double x) { return through_float(x); }

double normal(Rng& r) {
  double sum = -6;
  for (int k = 0; k < 12; ++k) sum += r.uniform();
  return sum;
}

}  // namespace

// Uniform: n boxes of mean side 1 meet n·8/V others each, about four partners a box. Mixed: 1 % of the boxes
// are 50 times larger, and the mean of (s_a + s_b)³/V over pairs is governed by them: 780 units of volume a
// box give about three. Clusters hold 1000 boxes each with a deviation of 2.2 (about 14 partners a box), in a
// world 20 times as wide as the uniform one.
BoxScene::BoxScene(std::string_view kind, int n, std::uint64_t seed) : kind_(kind), n_(n), r_(seed) {
  side_ = std::cbrt((kind == "mixed" ? 780.0 : 2.0) * n);
  if (kind == "clustered") {
    side_ *= 20;
    for (int b = 0; b <= n / 1000; ++b) {
      Vec3 c;
      for (int k = 0; k < 3; ++k) c[k] = r_.uniform(0, side_);
      blobs_.push_back(c);
    }
  }
  boxes_.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) place(i);
}

void BoxScene::place(int i) {
  const double scale = kind_ == "mixed" && i % 100 == 0 ? 50 : 1;
  Aabb& b = boxes_[static_cast<std::size_t>(i)];
  const std::size_t blob = blobs_.empty() ? 0 : r_.below(blobs_.size());
  for (int k = 0; k < 3; ++k) {
    const double c = blobs_.empty() ? r_.uniform(0, side_) : blobs_[blob][k] + 2.2 * normal(r_);
    const double h = r_.uniform(0.25, 0.75) * scale;
    b.lo[k] = exact(c - h);
    b.hi[k] = exact(c + h);
  }
}

void BoxScene::shift(int i) {
  Aabb& b = boxes_[static_cast<std::size_t>(i)];
  const double size = (b.hi - b.lo).mean();
  const Vec3 v = r_.unit_vector() * (0.02 * size);
  for (int k = 0; k < 3; ++k) {
    b.lo[k] = exact(b.lo[k] + v[k]);
    b.hi[k] = exact(b.hi[k] + v[k]);
  }
}

const std::vector<broad::BoxUpdate>& BoxScene::step() {
  moves_.clear();
  for (int i = 0; i < n_; ++i) {
    if (kind_ == "static95" && i % 20 != 0) continue;
    if (kind_ == "teleport")
      place(i);
    else
      shift(i);
    moves_.push_back({i, boxes_[static_cast<std::size_t>(i)]});
  }
  return moves_;
}

}  // namespace touchstone::bench
