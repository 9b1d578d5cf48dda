// Asks the referee and CGAL about random pairs and reports every contradiction:
//
//   build/bin/ts_second_referee [PAIRS [SEED]]
//
// Half of the pairs are polytopes (overlap, and whether the exact distance lies in the referee's bracket),
// half are meshes (overlap). PAIRS defaults to 1000000. Exit code 1 if there is a contradiction.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "oracles/referee/referee.h"
#include "tests/second_referee/random_polytopes.h"

using namespace touchstone;
using namespace touchstone::second_referee;

namespace {

struct Count {
  std::uint64_t pairs = 0, overlaps = 0, contradictions = 0;
};

void contradiction(Count& count, const char* kind, std::uint64_t number, const std::string& words) {
  ++count.contradictions;
  fmt::print("contradiction: {} {}: {}\n", kind, number, words);
}

void compare_polytopes(std::uint64_t seed, std::uint64_t number, Count& count) {
  Rng r(seed + number);
  const PolytopePair p = random_pair(r);
  const Shape one = p.hull_a, two = p.hull_b;
  const referee::PairTruth truth = referee::judge_pair({&one, p.pose_a}, {&two, p.pose_b});
  const Gap gap = gap_of(p.a, p.b, p.scale, truth.gap.lo, truth.gap.hi);
  ++count.pairs;
  count.overlaps += gap.overlap;
  if (truth.verdict != (gap.overlap ? referee::Verdict::overlap : referee::Verdict::disjoint))
    return contradiction(count, "polytopes", number,
                         fmt::format("the referee says {}, CGAL {}", referee::to_string(truth.verdict),
                                     gap.overlap ? "overlap" : "disjoint"));
  if (!gap.overlap && !gap.is_within)
    contradiction(count, "polytopes", number,
                  fmt::format("CGAL's distance is not in [{}, {}]", truth.gap.lo, truth.gap.hi));
}

void compare_meshes(std::uint64_t seed, std::uint64_t number, Count& count) {
  Rng r(seed + number);
  const TriangleMesh a = random_mesh(r), b = random_mesh(r);
  const Shape one = a, two = b;
  const referee::PairTruth truth = referee::judge_pair({&one, Pose{}}, {&two, Pose{}});
  const bool cgal = overlap(a, b);
  ++count.pairs;
  count.overlaps += cgal;
  if (truth.verdict != (cgal ? referee::Verdict::overlap : referee::Verdict::disjoint))
    contradiction(count, "meshes", number,
                  fmt::format("the referee says {}, CGAL {}", referee::to_string(truth.verdict),
                              cgal ? "overlap" : "disjoint"));
}

std::uint64_t number_at(int argc, char** argv, int i, std::uint64_t otherwise) {
  return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
}

void print(const char* kind, const Count& c, double seconds) {
  fmt::print("{}: {} pairs, {} overlap, {} contradictions, {:.0f} pairs a second\n", kind, c.pairs,
             c.overlaps, c.contradictions, static_cast<double>(c.pairs) / seconds);
}

template <class Compare>
Count run(const char* kind, std::uint64_t pairs, std::uint64_t seed, Compare&& compare) {
  Count count;
  const auto start = std::chrono::steady_clock::now();
  for (std::uint64_t i = 0; i < pairs; ++i) compare(seed, i, count);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  print(kind, count, took.count());
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t pairs = number_at(argc, argv, 1, 1'000'000), seed = number_at(argc, argv, 2, 1) << 40;
  const Count polytopes = run("polytopes", pairs - pairs / 2, seed, compare_polytopes);
  const Count meshes = run("meshes", pairs / 2, seed, compare_meshes);
  return polytopes.contradictions + meshes.contradictions > 0 ? 1 : 0;
}
