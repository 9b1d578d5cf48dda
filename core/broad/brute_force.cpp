#include "core/broad/brute_force.h"

#include "core/broad/stored_phase.h"

namespace touchstone::broad {

void BruteForceFinder::find(const BoxStore& store, PairSink& sink) {
  columns_.resize(store.present());
  std::size_t n = 0;
  for (BoxStore::Slot s = 0; s < store.slots(); ++s)
    if (store.is_present(s)) columns_.put(n++, store.keys()[s], plain_code(store, s), 0);
  // A box costs n/2 tests here; the other methods need only a handful.
  const std::size_t parts = sink.parts(n * n / 64);
  sink.in_parts(parts, [&](std::size_t p, PairSink& out) {
    deal_chunks(n, 16, parts, p, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) scan_range(columns_, i, columns_, i + 1, n, out);
    });
  });
}

BroadPhasePtr make_brute_force(const Options& options) {
  return std::make_unique<StoredPhase<BruteForceFinder>>(options);
}

}  // namespace touchstone::broad
