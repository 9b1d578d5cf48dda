#include "core/broad/brute_force.h"

#include "core/broad/stored_phase.h"

namespace touchstone::broad {

void BruteForceFinder::find(const BoxStore& store, PairSink& sink) {
  columns_.resize(store.present());
  std::size_t n = 0;
  for (BoxStore::Slot s = 0; s < store.slots(); ++s)
    if (store.is_present(s)) columns_.put(n++, store.keys()[s], plain_code(store, s), 0);
  for (std::size_t i = 0; i + 1 < n; ++i) scan_range(columns_, i, columns_, i + 1, n, sink);
}

BroadPhasePtr make_brute_force() { return std::make_unique<StoredPhase<BruteForceFinder>>(); }

}  // namespace touchstone::broad
