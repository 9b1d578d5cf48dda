// Asks the referee and CGAL about random pairs and reports every contradiction:
//
//   build/bin/ts_second_referee [PAIRS [SEED [CPU_SECONDS]]]
//
// Half of the pairs are polytopes (overlap, and whether the exact distance lies in the referee's bracket),
// half are meshes (overlap). PAIRS defaults to 1000000, CPU_SECONDS, the limit of one pair, to 10: CGAL's
// exact solver of quadratic programs does not end on a few pairs. Such pairs are printed and counted as lost.
// Exit code 1 if there is a contradiction or the referee reached the limit.
#include <fmt/format.h>

#include <cstdlib>

#include "oracles/referee/referee.h"
#include "tests/second_referee/limited_run.h"
#include "tests/second_referee/random_polytopes.h"

using namespace touchstone;
using namespace touchstone::second_referee;

namespace {

void contradiction(Count& count, const char* kind, std::uint64_t number, const std::string& words) {
  ++count.contradictions;
  fmt::print("contradiction: {} {}: {}\n", kind, number, words);
}

void compare_polytopes(std::uint64_t seed, std::uint64_t number, Progress& progress) {
  Rng r(seed + number);
  const PolytopePair p = random_pair(r);
  const Shape one = p.hull_a, two = p.hull_b;
  progress.stage = Stage::referee;
  const referee::PairTruth truth = referee::judge_pair({&one, p.pose_a}, {&two, p.pose_b});
  progress.stage = Stage::cgal;
  const Gap gap = gap_of(p.a, p.b, p.scale, truth.gap.lo, truth.gap.hi);
  Count& count = progress.count;
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

void compare_meshes(std::uint64_t seed, std::uint64_t number, Progress& progress) {
  Rng r(seed + number);
  const TriangleMesh a = random_mesh(r), b = random_mesh(r);
  const Shape one = a, two = b;
  progress.stage = Stage::referee;
  const referee::PairTruth truth = referee::judge_pair({&one, Pose{}}, {&two, Pose{}});
  progress.stage = Stage::cgal;
  const bool cgal = overlap(a, b);
  Count& count = progress.count;
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

void print(const char* kind, const char* when, const Count& c) {
  fmt::print("{}{}: {} pairs compared, {} overlap, {} contradictions; no answer: CGAL {}, the referee {}\n",
             kind, when, c.pairs, c.overlaps, c.contradictions, c.cgal_lost, c.referee_lost);
}

template <class Asked>
Count run(const char* kind, std::uint64_t pairs, std::uint64_t seed, const Limits& limits, Asked&& asked) {
  const Told told{.lost =
                      [&](std::uint64_t number, Stage stage, const std::string& how) {
                        fmt::print("lost: {} {}: {}: {}\n", kind, number, to_string(stage), how);
                        std::fflush(stdout);
                      },
                  .so_far = [&](const Progress& p) { print(kind, " so far", p.count); }};
  const Count count = run_limited(
      pairs, limits, [&](std::uint64_t i, Progress& p) { asked(seed, i, p); }, told);
  print(kind, "", count);
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t pairs = number_at(argc, argv, 1, 1'000'000), seed = number_at(argc, argv, 2, 1) << 40;
  Limits limits;
  if (argc > 3) limits.cpu_seconds = std::strtod(argv[3], nullptr);
  if (!(limits.cpu_seconds > 0 && limits.cpu_seconds < 1e6)) {
    fmt::print(stderr, "CPU_SECONDS: {}: must lie in (0, 1e6)\n", argv[3]);
    return 2;
  }
  const Count meshes = run("meshes", pairs / 2, seed, limits, compare_meshes);
  const Count polytopes = run("polytopes", pairs - pairs / 2, seed, limits, compare_polytopes);
  const auto failed = [](const Count& c) { return c.contradictions + c.referee_lost > 0; };
  return failed(meshes) || failed(polytopes) ? 1 : 0;
}
