#include "core/broad/automatic.h"

#include <utility>

#include "core/broad/stored_phase.h"
#include "core/tolerance.h"

namespace touchstone::broad {
namespace {

// √12: the width of a uniform distribution in standard deviations.
constexpr double uniform_width = 3.4641016151377544;

// The number of boxes that a sweep compares each box with: those that begin within one box length of it.
double boxes_in_reach(const SceneStats& s, std::size_t n) {
  const int axis = best_axis(s);
  const double width = s.spread[axis] * uniform_width;
  return width > 0 ? static_cast<double>(n) * s.median_size[axis] / width : static_cast<double>(n);
}

}  // namespace

bool AutomaticFinder::find_sorted(const BoxStore& store, PairSink& sink, std::vector<IdPair>& out) {
  const std::size_t n = store.present();
  boxes_ = n;
  changed_ = store.touched().size();
  reach_ = -1;
  if (n <= tolerance::brute_force_max) {
    method_ = Method::brute_force;
    list_.forget();
    brute_force_.find(store, sink);
    return false;
  }
  if (list_.keep_up(store, sink, out)) {
    if (std::exchange(method_, Method::neighbour_list) == Method::sweep) sweep_ = {};
    return true;
  }
  reach_ = boxes_in_reach(stats_.of(store), n);
  const Method method = reach_ <= tolerance::sweep_max_reach ? Method::sweep : Method::grid;
  if (std::exchange(method_, method) == Method::sweep && method != Method::sweep) sweep_ = {};
  if (method_ == Method::sweep) {
    list_.forget();
    sweep_.find(store, sink);
  } else {
    list_.search(store, sink);
  }
  return false;
}

void AutomaticFinder::validate(const BoxStore& store) const {
  if (method_ == Method::sweep) sweep_.validate(store);
  if (method_ == Method::grid || method_ == Method::neighbour_list) list_.validate(store);
}

std::size_t AutomaticFinder::memory_bytes() const {
  return brute_force_.memory_bytes() + sweep_.memory_bytes() + list_.memory_bytes();
}

std::string AutomaticFinder::explain() const {
  const std::string how = method_ == Method::brute_force ? brute_force_.explain()
                          : method_ == Method::sweep     ? sweep_.explain()
                                                         : list_.explain();
  std::string why = std::to_string(boxes_) + " boxes, " + std::to_string(changed_) + " changed";
  if (reach_ >= 0) why += ", " + std::to_string(reach_) + " in the reach of a sweep";
  return how + " (" + why + ")";
}

Structure AutomaticFinder::structure() const {
  if (method_ == Method::brute_force) return {};
  return method_ == Method::sweep ? sweep_.structure() : list_.structure();
}

BroadPhasePtr make_automatic(const Options& options) {
  return std::make_unique<StoredPhase<AutomaticFinder>>(options);
}

}  // namespace touchstone::broad
