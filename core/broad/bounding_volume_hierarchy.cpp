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

// Changed boxes begin unmarked and are marked once they have looked for partners among the marked ones: a
// pair of two changed boxes is found by the later of them.
void HierarchyFinder::update_few(const BoxStore& store, PairSink& sink) {
  touched_.resize(store.slots());
  for (const BoxStore::Slot s : store.touched()) {
    WideTree& own = store.is_fixed(s) ? fixed_ : moving_;
    own.refit_one(store, s), own.mark(s, false), touched_[s] = 1;
  }
  sink.reserve(kept_.size());
  for (const SlotPair& p : kept_)
    if ((touched_[p.first] | touched_[p.second]) == 0) sink.add(p.first, p.second);
  for (const BoxStore::Slot s : store.touched()) {
    moving_.marked_partners(store, s, sink);
    if (!store.is_fixed(s)) fixed_.marked_partners(store, s, sink);
    (store.is_fixed(s) ? fixed_ : moving_).mark(s, true), touched_[s] = 0;
  }
  fixed_changes_ = store.fixed_changes();
}

void HierarchyFinder::find(const BoxStore& store, PairSink& sink) {
  const bool few = membership_ == store.membership() &&
                   store.touched().size() * tolerance::sweep_local_share < store.present();
  local_ =
      few && has_kept_ && moving_.decay() <= tolerance::tree_decay && fixed_.decay() <= tolerance::tree_decay;
  if (local_) {
    update_few(store, sink);
  } else {
    // Paths were refitted after moves of fixed boxes: an order that has decayed is not left as it is.
    if (fixed_.decay() > tolerance::tree_decay) fixed_changes_ = never;
    update(store);
    moving_.self_pairs(sink);
    moving_.pairs_with(fixed_, sink);
  }
  has_kept_ = few;
  if (!few) return;
  sink.decide_doubtful(store);
  kept_.resize(sink.n);
  for (std::size_t i = 0; i < sink.n; ++i) kept_[i] = {sink.first[i], sink.second[i]};
}

void HierarchyFinder::validate(const BoxStore& store) const {
  moving_.validate(), fixed_.validate();
  if (membership_ == store.membership() && moving_.size() + fixed_.size() != store.present())
    throw std::logic_error("hierarchy: a box is in no tree or in two");
}

std::string HierarchyFinder::explain() const {
  return "trees of " + std::to_string(moving_.size()) + " moving and " + std::to_string(fixed_.size()) +
         " fixed boxes; " + std::to_string(builds_) + " builds and " + std::to_string(refits_) + " refits; " +
         (local_ ? "changed boxes searched" : "all boxes searched");
}

BroadPhasePtr make_bounding_volume_hierarchy(const Options& options) {
  return std::make_unique<StoredPhase<HierarchyFinder>>(options);
}

}  // namespace touchstone::broad
