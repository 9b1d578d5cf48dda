#include "core/broad/sort_and_sweep.h"

#include <algorithm>
#include <cmath>

#include "core/broad/box_set.h"

namespace touchstone::broad {
namespace {

using Entry = BoxSet::Entry;

// Variance of the centres of the finite intervals. Only a choice of axis: any answer is right, so rounding,
// overflow and infinite boxes cannot cost a pair.
int axis_of_most_spread(std::span<const Entry> boxes) {
  int best = 0;
  double most = -1;
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0, sum_sq = 0, n = 0;
    for (const Entry& e : boxes) {
      const double c = e.box.lo[axis] / 2 + e.box.hi[axis] / 2;
      if (!std::isfinite(c)) continue;
      sum += c, sum_sq += c * c, ++n;
    }
    const double spread = n > 0 ? sum_sq / n - (sum / n) * (sum / n) : 0;
    if (spread > most) most = spread, best = axis;
  }
  return best;
}

class SortAndSweep final : public BroadPhase {
 public:
  void insert(int id, const Aabb& box) override { set_.insert(id, box); }
  void move(int id, const Aabb& box) override { set_.move(id, box); }
  void remove(int id) override { set_.remove(id); }
  void pairs(std::vector<IdPair>& out) override {
    out.clear();
    const int axis = axis_of_most_spread(set_.entries());
    sorted_.assign(set_.entries().begin(), set_.entries().end());
    std::sort(sorted_.begin(), sorted_.end(), [axis](const Entry& a, const Entry& b) {
      return a.box.lo[axis] != b.box.lo[axis] ? a.box.lo[axis] < b.box.lo[axis] : a.id < b.id;
    });
    for (std::size_t i = 0; i < sorted_.size(); ++i)
      for (std::size_t j = i + 1; j < sorted_.size() && sorted_[j].box.lo[axis] <= sorted_[i].box.hi[axis];
           ++j)
        if (overlaps(sorted_[i].box, sorted_[j].box))
          out.push_back({std::min(sorted_[i].id, sorted_[j].id), std::max(sorted_[i].id, sorted_[j].id)});
    std::sort(out.begin(), out.end());
  }
  void validate() const override { set_.validate(); }

 private:
  BoxSet set_;
  std::vector<Entry> sorted_;
};

}  // namespace

BroadPhasePtr make_sort_and_sweep() { return std::make_unique<SortAndSweep>(); }

}  // namespace touchstone::broad
