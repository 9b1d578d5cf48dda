// The wide code is compiled once for each instruction set and chosen at run time: each that this machine has
// must report the same pairs.
#include <hwy/targets.h>

#include "core/broad/catalog.h"
#include "tests/core/broad_boxes.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::broad;
using namespace touchstone::test;

namespace {

void use_only(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

TEST_CASE("every instruction set reports the same pairs", "[broad][simd]") {
  std::vector<std::int64_t> targets;
  for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) targets.push_back(all & -all);
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
