// Makes a BroadPhase from a finder. This class stores the boxes, the changes and the output; a finder only
// finds pairs. It has
//   void find(const BoxStore&, PairSink&)   adds each overlapping pair of slots except fixed–fixed once; changes
//                                           since the last call are in store.touched()
//   void validate(const BoxStore&) const    throws std::logic_error
//   std::size_t memory_bytes() const
//   std::string explain() const
// In place of find() it may have
//   bool find_sorted(const BoxStore&, PairSink&, std::vector<IdPair>& out)
//                                           true: sorted pairs of slots in `out`; false: pairs in the sink
// and
//   Structure structure() const
#pragma once

#include "core/broad/pair_sink.h"

namespace touchstone::broad {

template <class Finder>
class StoredPhase final : public BroadPhase {
 public:
  explicit StoredPhase(const Options& options) : sink_(options) {}
  using BroadPhase::insert;
  void insert(int id, const Aabb& box, Mobility mobility) override { store_.insert(id, box, mobility); }
  void move(int id, const Aabb& box) override { store_.move(id, box); }
  void remove(int id) override { store_.remove(id); }
  void update(std::span<const BoxUpdate> moves) override { store_.update(moves); }
  void pairs(std::vector<IdPair>& out) override {
    sink_.clear();
    if constexpr (requires { finder_.find_sorted(store_, sink_, out); }) {
      if (finder_.find_sorted(store_, sink_, out))
        sink_.name(store_, out);
      else
        sink_.finish(store_, out);
    } else {
      finder_.find(store_, sink_);
      sink_.finish(store_, out);
    }
    store_.settle();
    store_.forget_changes();
  }
  void validate() const override {
    store_.validate();
    finder_.validate(store_);
  }
  std::size_t memory_bytes() const override {
    return sizeof *this + store_.memory_bytes() + sink_.memory_bytes() + finder_.memory_bytes();
  }
  std::string explain() const override { return finder_.explain(); }
  Structure structure() const override {
    if constexpr (requires { finder_.structure(); })
      return finder_.structure();
    else
      return {};
  }

 private:
  BoxStore store_;
  PairSink sink_;
  Finder finder_;
};

}  // namespace touchstone::broad
