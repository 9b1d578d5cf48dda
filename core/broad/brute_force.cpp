#include "core/broad/brute_force.h"

#include "core/broad/box_set.h"

namespace touchstone::broad {
namespace {

class BruteForce final : public BroadPhase {
 public:
  void insert(int id, const Aabb& box) override { set_.insert(id, box); }
  void move(int id, const Aabb& box) override { set_.move(id, box); }
  void remove(int id) override { set_.remove(id); }
  void pairs(std::vector<IdPair>& out) override {
    out.clear();
    const auto e = set_.entries();
    for (std::size_t i = 0; i < e.size(); ++i)
      for (std::size_t j = i + 1; j < e.size(); ++j)
        if (overlaps(e[i].box, e[j].box)) out.push_back({e[i].id, e[j].id});
  }
  void validate() const override { set_.validate(); }

 private:
  BoxSet set_;
};

}  // namespace

BroadPhasePtr make_brute_force() { return std::make_unique<BruteForce>(); }

}  // namespace touchstone::broad
