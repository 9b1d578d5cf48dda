#include "core/broad/automatic.h"

#include "core/broad/stored_phase.h"
#include "core/tolerance.h"

namespace touchstone::broad {
namespace {

// Boxes that a sweep compares each box with: those that begin within one box's length of it. √12 standard
// deviations are the width of a uniform spread.
double boxes_in_reach(const SceneStats& s, std::size_t n) {
  const int axis = best_axis(s);
  const double width = s.spread[axis] * 3.4641016151377544;
  return width > 0 ? static_cast<double>(n) * s.median_size[axis] / width : static_cast<double>(n);
}

}  // namespace

AutomaticFinder::Method AutomaticFinder::choose(const BoxStore& store) {
  const std::size_t n = store.present();
  const bool same_members = membership_ == store.membership();
  membership_ = store.membership();
  const bool quiet = same_members && store.touched().size() * tolerance::sweep_local_share < n;
  quiet_queries_ = quiet ? quiet_queries_ + 1 : 0;
  why_ = std::to_string(n) + " boxes";
  if (n <= tolerance::brute_force_most) return Method::brute_force;
  why_ += ", " + std::to_string(store.touched().size()) + " changed";
  if (quiet_queries_ >= tolerance::quiet_queries) return Method::hierarchy;
  why_ += ", " + std::to_string(store.fixed()) + " fixed";
  if (store.fixed() * 2 > n || n >= tolerance::hierarchy_least) return Method::hierarchy;
  const double reach = boxes_in_reach(stats_.of(store), n);
  why_ += ", " + std::to_string(reach) + " in the reach of a sweep";
  return reach <= tolerance::sweep_reach_most ? Method::sweep : Method::grid;
}

// What remembers the last query starts anew when it was not asked last time.
void AutomaticFinder::find(const BoxStore& store, PairSink& sink) {
  const Method last = method_;
  method_ = choose(store);
  if (method_ != last) hierarchy_.forget();
  switch (method_) {
    case Method::brute_force:
      return brute_force_.find(store, sink);
    case Method::hierarchy:
      return hierarchy_.find(store, sink);
    case Method::sweep:
      return sweep_.find(store, sink);
    case Method::grid:
      return grid_.find(store, sink);
  }
}

void AutomaticFinder::validate(const BoxStore& store) const {
  if (method_ == Method::hierarchy) hierarchy_.validate(store);
  if (method_ == Method::sweep) sweep_.validate(store);
  if (method_ == Method::grid) grid_.validate(store);
}

std::size_t AutomaticFinder::memory_bytes() const {
  return brute_force_.memory_bytes() + hierarchy_.memory_bytes() + sweep_.memory_bytes() +
         grid_.memory_bytes();
}

std::string AutomaticFinder::explain() const {
  const auto how = [this] {
    switch (method_) {
      case Method::hierarchy:
        return hierarchy_.explain();
      case Method::sweep:
        return sweep_.explain();
      case Method::grid:
        return grid_.explain();
      case Method::brute_force:
        break;
    }
    return brute_force_.explain();
  };
  return how() + " (" + why_ + ")";
}

BroadPhasePtr make_automatic() { return std::make_unique<StoredPhase<AutomaticFinder>>(); }

}  // namespace touchstone::broad
