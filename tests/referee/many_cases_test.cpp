// How many cases of the fuzz generator each level of the referee decides: a short run in the suite, a long
// one by hand:
//   TOUCHSTONE_CASES=10000000 test_referee_many_cases "[.many]"   (TOUCHSTONE_SEED for other cases)
#include <cstdio>
#include <cstdlib>

#include "oracles/referee/counters.h"
#include "oracles/referee/referee.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

struct Count {
  std::uint64_t cases = 0, undecided = 0, wide = 0, level[3] = {0, 0, 0};
};

bool is_exact_kind(const Shape& s) {
  const ShapeKind k = kind_of(s);
  return k == ShapeKind::sphere || k == ShapeKind::box || k == ShapeKind::capsule || k == ShapeKind::hull;
}

bool is_discrete_pair(const Case& c) {
  return !c.queries.empty() && c.queries[0].question == Question::overlap && c.scene.bodies.size() == 2;
}

void judge(const Case& c, Count& count) {
  const referee::PairTruth t = referee::judge_pair({&c.scene.shape_of(0), c.scene.bodies[0].pose},
                                                   {&c.scene.shape_of(1), c.scene.bodies[1].pose});
  ++count.cases;
  ++count.level[t.level];
  count.undecided += t.verdict == referee::Verdict::undecided;
  count.wide += std::isfinite(t.gap.lo) && t.gap.hi - t.gap.lo > 1e-14 * scale_of_pair(c.scene, 0, 1);
}

Count run(std::uint64_t seed, std::uint64_t cases, bool exact_kinds_only) {
  Count count;
  for (std::uint64_t i = 0; count.cases < cases; ++i) {
    const Case c = fuzz::make_case(seed, i);
    if (!is_discrete_pair(c)) continue;
    if (exact_kinds_only && !(is_exact_kind(c.scene.shape_of(0)) && is_exact_kind(c.scene.shape_of(1))))
      continue;
    judge(c, count);
  }
  return count;
}

void print(const char* what, const Count& c) {
  std::printf("%s: %llu cases; levels %llu / %llu / %llu; %llu undecided; %llu brackets wider than 1e-14 L\n",
              what, static_cast<unsigned long long>(c.cases), static_cast<unsigned long long>(c.level[0]),
              static_cast<unsigned long long>(c.level[1]), static_cast<unsigned long long>(c.level[2]),
              static_cast<unsigned long long>(c.undecided), static_cast<unsigned long long>(c.wide));
}

std::uint64_t number_from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

}  // namespace

TEST_CASE("the default mix: polytopes and rounded shapes are decided, nearly all by the first two levels",
          "[referee][levels]") {
  const Count exact = run(2, 3000, true), all = run(3, 3000, false);
  print("polytopes and rounded shapes", exact);
  print("all shapes", all);
  REQUIRE(exact.undecided == 0);
  REQUIRE(exact.wide == 0);
  REQUIRE(all.undecided == 0);
  REQUIRE(exact.level[2] <= 3);
  REQUIRE(exact.level[0] >= 2850);
  REQUIRE(all.level[2] <= 15);
  REQUIRE(all.wide <= 9);
}

TEST_CASE("none of ten million polytopes, spheres and capsules is undecided", "[.many]") {
  const Count c = run(number_from_environment("TOUCHSTONE_SEED", 4),
                      number_from_environment("TOUCHSTONE_CASES", 10000000), true);
  print("polytopes and rounded shapes", c);
  REQUIRE(c.undecided == 0);
}

TEST_CASE("all shapes: how many are undecided or wide", "[.many-all]") {
  const Count c = run(number_from_environment("TOUCHSTONE_SEED", 5),
                      number_from_environment("TOUCHSTONE_CASES", 1000000), false);
  print("all shapes", c);
  REQUIRE(c.undecided * 1000000 <= c.cases);
}
