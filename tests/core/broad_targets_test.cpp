// The SIMD code is compiled once per instruction set and chosen at run time. All those that this machine
// supports must report the same pairs.
#include <hwy/targets.h>

#include "core/broad/catalog.h"
#include "core/broad/pair_kernels.h"
#include "tests/core/broad_boxes.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::broad;
using namespace touchstone::test;

namespace {

std::vector<std::int64_t> targets_here() {
  std::vector<std::int64_t> targets;
  for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) targets.push_back(all & -all);
  return targets;
}

// A float in memory is rounded to float; in a register the rounding may have been optimised away.
double number(std::int32_t key) {
  volatile float f = value_of(key);
  return static_cast<double>(f);
}

void use_only(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

TEST_CASE("every instruction set reports the same pairs", "[broad][simd]") {
  const std::vector<std::int64_t> targets = targets_here();
  long pairs = 0;
  for (const std::int64_t target : targets) {
    use_only(target);
    INFO(hwy::TargetName(target));
    for (const CatalogRow& row : catalog)
      for (int k = 0; k < box_kinds; ++k) {
        const auto kind = static_cast<BoxKind>(k);
        INFO(row.name);
        Rng r(17);
        const auto subject = row.make();
        Reference reference;
        for (int id = 0; id < 200; ++id) {
          const Aabb box = make_box(r, kind);
          const bool fixed = r.chance(0.3);
          subject->insert(id, box, fixed ? Mobility::fixed : Mobility::moving);
          reference.bodies[id] = {box, fixed};
        }
        std::vector<IdPair> out;
        subject->pairs(out);
        REQUIRE(out == reference.pairs());
        pairs += static_cast<long>(out.size());
      }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  CHECK(targets.size() >= 2);
  CHECK(pairs > 1000);
}

TEST_CASE("on every instruction set a key is the nearest float outside its box", "[broad][simd]") {
  Rng r(18);
  std::vector<BoxUpdate> moves(500);
  std::vector<std::uint32_t> at(moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    at[i] = static_cast<std::uint32_t>(i);
    for (int k = 0; k < 3; ++k) {
      moves[i].box.lo[k] = r.uniform(-100, 100);
      moves[i].box.hi[k] = moves[i].box.lo[k] + r.uniform(0, 3);
    }
  }
  long keys = 0;
  const auto check = [&](const Aabb& box, const KeyBox& key) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double lo = box.lo[static_cast<int>(k)], hi = box.hi[static_cast<int>(k)];
      REQUIRE(number(key.lo[k]) <= lo);
      REQUIRE(number(key.lo[k] + 1) > lo);
      REQUIRE(number(key.hi[k]) >= hi);
      REQUIRE(number(key.hi[k] - 1) < hi);
      keys += 2;
    }
  };
  for (const BoxUpdate& m : moves) check(m.box, key_box(m.box));
  const std::vector<std::int64_t> targets = targets_here();
  for (const std::int64_t target : targets) {
    use_only(target);
    INFO(hwy::TargetName(target));
    std::vector<Aabb> boxes(moves.size());
    std::vector<KeyBox> key(moves.size());
    std::vector<float> steps(moves.size());
    put_boxes(moves, at.data(), boxes.data(), key.data(), steps.data());
    for (std::size_t i = 0; i < moves.size(); ++i) check(moves[i].box, key[i]);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  CHECK(keys == static_cast<long>(6 * moves.size() * (targets.size() + 1)));
}
