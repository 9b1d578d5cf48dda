#include "core/broad/bounding_volume_hierarchy.h"

#include "core/broad/stored_phase.h"
#include "core/tolerance.h"

namespace touchstone::broad {

void HierarchyFinder::update(const BoxStore& store) {
  const bool members = membership_ != store.membership();
  if (fixed_changes_ != store.fixed_changes()) fixed_.build(store, true, sample_scene(store));
  if (!members && !store.touched().empty()) moving_.refit(store), ++refits_;
  if (members || moving_.decay() > tolerance::tree_decay)
    moving_.build(store, false, sample_scene(store)), ++builds_;
  membership_ = store.membership(), fixed_changes_ = store.fixed_changes();
}

void HierarchyFinder::find(const BoxStore& store, PairSink& sink) {
  update(store);
  moving_.self_pairs(sink);
  moving_.pairs_with(fixed_, sink);
}

void HierarchyFinder::validate(const BoxStore& store) const {
  moving_.validate(), fixed_.validate();
  if (membership_ == store.membership() && moving_.size() + fixed_.size() != store.present())
    throw std::logic_error("hierarchy: a box is in no tree or in two");
}

std::string HierarchyFinder::explain() const {
  return "trees of " + std::to_string(moving_.size()) + " moving and " + std::to_string(fixed_.size()) +
         " fixed boxes; " + std::to_string(builds_) + " builds and " + std::to_string(refits_) + " refits";
}

BroadPhasePtr make_bounding_volume_hierarchy() { return std::make_unique<StoredPhase<HierarchyFinder>>(); }

}  // namespace touchstone::broad
