// One pair of boxes in many pairs of poses: overlap() for one after the other, and overlaps() for all at
// once, in turn, round after round. The thread's CPU time per pair of poses, minimum over the rounds.
//
//   bench_batch [--rounds 200]
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>

#include "core/math/rng.h"
#include "core/narrow/narrow_phase.h"
#include "tests/bench/ticks.h"

using namespace touchstone;
using namespace touchstone::bench;

namespace {

struct Times {
  double alone = HUGE_VAL, batch = HUGE_VAL;
};

// `count` pairs of poses of two boxes about their size apart; about half of them overlap.
Times measure(std::size_t count, int rounds) {
  Rng r(1);
  const Shape box_a = Box{{0.5, 0.75, 1}}, box_b = Box{{0.75, 0.5, 0.625}};
  const Collider a(box_a), b(box_b);
  std::vector<Pose> poses_a, poses_b;
  for (std::size_t i = 0; i < count; ++i) {
    poses_a.push_back({r.unit_vector(), r.rotation()});
    poses_b.push_back({poses_a.back().translation + r.unit_vector() * r.uniform(1, 2), r.rotation()});
  }
  std::vector<OverlapAnswer> one(count), all(count);
  const int passes = static_cast<int>(1 + 4096 / count);
  const double calls = static_cast<double>(count) * passes;
  Times t;
  for (int k = 0; k < rounds; ++k) {
    const double start = clock_ns(CLOCK_THREAD_CPUTIME_ID);
    for (int pass = 0; pass < passes; ++pass)
      for (std::size_t i = 0; i < count; ++i) one[i] = overlap(a.at(poses_a[i]), b.at(poses_b[i]));
    const double middle = clock_ns(CLOCK_THREAD_CPUTIME_ID);
    for (int pass = 0; pass < passes; ++pass) overlaps(a, poses_a, b, poses_b, all);
    const double end = clock_ns(CLOCK_THREAD_CPUTIME_ID);
    t.alone = std::min(t.alone, (middle - start) / calls);
    t.batch = std::min(t.batch, (end - middle) / calls);
  }
  return t;
}

}  // namespace

int main(int argc, char** argv) {
  const bool given = argc == 3 && !std::strcmp(argv[1], "--rounds");
  if (argc != 1 && !given) {
    fmt::print(stderr, "bench_batch [--rounds N]\n");
    return 2;
  }
  const int rounds = given ? std::max(1, std::atoi(argv[2])) : 200;
  fmt::print("{:>6} {:>9} {:>9}  ns per pair of poses\n", "poses", "alone", "batch");
  for (const std::size_t count : {std::size_t{1}, std::size_t{8}, std::size_t{32}, std::size_t{1000}}) {
    const Times t = measure(count, rounds);
    fmt::print("{:>6} {:>9.1f} {:>9.1f}\n", count, t.alone, t.batch);
  }
  return 0;
}
