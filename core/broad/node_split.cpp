#include "core/broad/node_split.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace touchstone::broad {
namespace {

KeyBox together(const KeyBox& a, const KeyBox& b) {
  KeyBox u;
  for (int k = 0; k < 3; ++k) {
    u.lo[k] = std::min(a.lo[k], b.lo[k]);
    u.hi[k] = std::max(a.hi[k], b.hi[k]);
  }
  return u;
}

// Cap on a side, so that no difference of two surfaces is a NaN.
constexpr double longest_side = 1e60;

// Half of the surface area.
double surface(const KeyBox& b) {
  double side[3];
  for (int k = 0; k < 3; ++k)
    side[k] = std::min(static_cast<double>(value_of(b.hi[k])) - value_of(b.lo[k]), longest_side);
  return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

double centre(const KeyBox& b, int axis) {
  const double c = static_cast<double>(value_of(b.lo[axis])) + value_of(b.hi[axis]);
  return std::isnan(c) ? 0 : c;
}

void sort_along(std::span<NodeEntry> all, int axis) {
  std::sort(all.begin(), all.end(), [axis](const NodeEntry& a, const NodeEntry& b) {
    const double x = centre(a.box, axis), y = centre(b.box, axis);
    return x < y || (x == y && a.code < b.code);
  });
}

struct Split {
  double cost = HUGE_VAL;
  std::size_t at = 0;
};

Split best_along(std::span<const NodeEntry> all) {
  constexpr std::size_t most = 32;
  std::array<double, most> right{};
  KeyBox u = all.back().box;
  for (std::size_t i = all.size(); i-- > 0;) right[i] = surface(u = together(u, all[i].box));
  Split best;
  u = all.front().box;
  const std::size_t least = all.size() / 4;
  for (std::size_t k = 1; k + least <= all.size(); ++k) {
    u = together(u, all[k - 1].box);
    const double cost = surface(u) * static_cast<double>(k) + right[k] * static_cast<double>(all.size() - k);
    if (k >= least && (best.at == 0 || cost < best.cost)) best = {cost, k};
  }
  return best;
}

}  // namespace

Growth growth(const KeyBox& node, const KeyBox& box) {
  const double s = surface(node);
  return {surface(together(node, box)) - s, s};
}

std::size_t split_node(std::span<NodeEntry> all) {
  Split best;
  int best_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    sort_along(all, axis);
    const Split s = best_along(all);
    if (best.at == 0 || s.cost < best.cost) {
      best = s;
      best_axis = axis;
    }
  }
  sort_along(all, best_axis);
  return best.at;
}

}  // namespace touchstone::broad
