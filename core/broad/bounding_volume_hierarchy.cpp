#include "core/broad/bounding_volume_hierarchy.h"

#include "core/broad/release.h"
#include "core/broad/stored_phase.h"
#include "core/tolerance.h"

namespace touchstone::broad {

// home: the tree that a slot belongs in; holder: the tree that it is in. Null when there is none.
WideTree* HierarchyFinder::home(const BoxStore& store, BoxStore::Slot s) {
  return !store.is_present(s) ? nullptr : store.is_fixed(s) ? &fixed_ : &moving_;
}
WideTree* HierarchyFinder::holder(BoxStore::Slot s) {
  return moving_.holds(s) ? &moving_ : fixed_.holds(s) ? &fixed_ : nullptr;
}

void HierarchyFinder::leave(const BoxStore& store, BoxStore::Slot s) {
  WideTree* const from = holder(s);
  if (from != nullptr && from != home(store, s)) {
    from->remove(s);
    ++went_;
  }
}

// Called after leave(). True when the slot was already in its tree; its box may have moved.
bool HierarchyFinder::enter(const BoxStore& store, BoxStore::Slot s) {
  WideTree* const to = home(store, s);
  if (to == nullptr) return false;
  if (to->holds(s)) return true;
  to->insert(store, s);
  ++came_;
  return false;
}

void HierarchyFinder::build(const BoxStore& store, WideTree& tree) {
  tree.build(store, &tree == &fixed_, sample_scene(store));
  ++builds_;
}

void HierarchyFinder::update_all(const BoxStore& store) {
  std::size_t changes[2] = {}, moved = 0;  // insertions and removals of each tree
  for (const BoxStore::Slot s : store.touched()) {
    const WideTree *const from = holder(s), *const to = home(store, s);
    changes[0] += (from == &moving_) != (to == &moving_) ? 1 : 0;
    changes[1] += (from == &fixed_) != (to == &fixed_) ? 1 : 0;
    moved += to == &moving_ ? 1 : 0;
    leave(store, s);
  }
  const auto many = [](std::size_t n, const WideTree& tree) {
    return n * tolerance::tree_change_share > tree.size();
  };
  const bool build_moving = many(changes[0], moving_), build_fixed = many(changes[1], fixed_);
  if (build_moving) build(store, moving_);
  if (build_fixed) build(store, fixed_);
  const bool refit = !build_moving && many(moved, moving_);
  for (const BoxStore::Slot s : store.touched()) {
    if (!enter(store, s)) continue;
    if (store.is_fixed(s) ? !build_fixed : !build_moving && !refit) home(store, s)->refit_one(store, s);
  }
  if (refit) {
    moving_.refit(store);
    ++refits_;
  }
  if (!build_moving && moving_.decay() > (refit ? tolerance::tree_decay : tolerance::tree_local_decay))
    build(store, moving_);
  if (!build_fixed && fixed_.decay() > tolerance::tree_local_decay) build(store, fixed_);
}

// Changed boxes start unmarked. Each is marked after it has been searched against the marked boxes, so a pair
// of two changed boxes is found by the later one.
void HierarchyFinder::update_few(const BoxStore& store, PairSink& sink) {
  touched_.resize(store.slots());
  for (const BoxStore::Slot s : store.touched()) {
    touched_[s] = 1;
    leave(store, s);
    if (enter(store, s)) home(store, s)->refit_one(store, s);
    if (store.is_present(s)) home(store, s)->mark(s, false);
  }
  sink.reserve(kept_.size());
  for (const SlotPair& p : kept_)
    if ((touched_[p.first] | touched_[p.second]) == 0) sink.add(p.first, p.second);
  for (const BoxStore::Slot s : store.touched()) {
    touched_[s] = 0;
    if (!store.is_present(s)) continue;
    moving_.marked_partners(store, s, sink);
    if (!store.is_fixed(s)) fixed_.marked_partners(store, s, sink);
    home(store, s)->mark(s, true);
  }
  for (WideTree* tree : {&moving_, &fixed_})
    if (tree->decay() > tolerance::tree_local_decay) build(store, *tree);
}

void HierarchyFinder::find(const BoxStore& store, PairSink& sink) {
  const bool few = store.touched().size() * tolerance::sweep_local_share < store.present();
  local_ = few && has_kept_;
  if (local_) {
    update_few(store, sink);
  } else {
    update_all(store);
    moving_.self_pairs(sink);
    moving_.pairs_with(fixed_, sink);
  }
  has_kept_ = few;
  if (!few) {
    release(kept_);
    return;
  }
  sink.decide_doubtful(store);
  kept_.resize(sink.n);
  for (std::size_t i = 0; i < sink.n; ++i) kept_[i] = {sink.first[i], sink.second[i]};
}

void HierarchyFinder::validate(const BoxStore& store) const {
  moving_.validate();
  fixed_.validate();
  if (!store.touched().empty()) return;
  if (moving_.size() + fixed_.size() != store.present())
    throw std::logic_error("hierarchy: a box is in no tree or in both");
  for (BoxStore::Slot s = 0; s < store.slots(); ++s)
    if (store.is_present(s) && !(store.is_fixed(s) ? fixed_ : moving_).holds(s))
      throw std::logic_error("hierarchy: a box is in the wrong tree");
}

std::string HierarchyFinder::explain() const {
  return "trees of " + std::to_string(moving_.size()) + " moving and " + std::to_string(fixed_.size()) +
         " fixed boxes; " + std::to_string(builds_) + " builds, " + std::to_string(refits_) + " refits, " +
         std::to_string(came_) + " boxes inserted and " + std::to_string(went_) + " removed, growth " +
         std::to_string(moving_.decay()) + "; " + (local_ ? "changed boxes searched" : "all boxes searched");
}

BroadPhasePtr make_bounding_volume_hierarchy(const Options& options) {
  return std::make_unique<StoredPhase<HierarchyFinder>>(options);
}

}  // namespace touchstone::broad
