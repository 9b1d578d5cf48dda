// What the referee says of many cases, so that two versions of it can be compared:
//   bench_truths print 20000 7 rays >before     cases, seed, families (all if none are given)
//   bench_truths compare before after           verdicts equal, brackets intersecting; exit code 1 otherwise
// `print` also reports its CPU time, of pairs and of motions, on the error stream.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>

#include "oracles/abi/measure.h"
#include "oracles/referee/referee.h"
#include "scenarios/random/family.h"

namespace {

using namespace touchstone;

Placed placed(const Scene& s, int body) {
  return {&s.shape_of(body), s.bodies[static_cast<std::size_t>(body)].pose};
}

Motion motion_of(const Scene& s, int body) {
  return s.bodies[static_cast<std::size_t>(body)].motion.value_or(Motion{});
}

/// Totals of `print`.
struct Cost {
  std::int64_t pairs = 0, pair_ns = 0, motions = 0, motion_ns = 0;
};

// A line: index, question, verdict, and two brackets in hexadecimal.
void print_pair(std::uint64_t i, const Case& c, const Query& q, Cost& cost) {
  const std::int64_t before = thread_cpu_ns();
  const referee::PairTruth t = referee::judge_pair(placed(c.scene, q.a), placed(c.scene, q.b));
  cost.pair_ns += thread_cpu_ns() - before;
  ++cost.pairs;
  std::printf("%llu pair %d %a %a 0 0\n", static_cast<unsigned long long>(i), static_cast<int>(t.verdict),
              t.gap.lo, t.gap.hi);
}

void print_motion(std::uint64_t i, const Case& c, const Query& q, Cost& cost) {
  const std::int64_t before = thread_cpu_ns();
  const referee::TimeTruth t = referee::judge_motion(placed(c.scene, q.a), motion_of(c.scene, q.a),
                                                     placed(c.scene, q.b), motion_of(c.scene, q.b));
  cost.motion_ns += thread_cpu_ns() - before;
  ++cost.motions;
  std::printf("%llu motion %d %a %a %a %a\n", static_cast<unsigned long long>(i), static_cast<int>(t.verdict),
              t.t_lo, t.t_hi, t.least_gap.lo, t.least_gap.hi);
}

int print(std::uint64_t cases, std::uint64_t seed, const char* families) {
  Cost cost;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Case c = fuzz::make_case(seed, i, families);
    for (const Query& q : c.queries) {
      if (!is_pair_question(q.question)) continue;
      is_motion_question(q.question) ? print_motion(i, c, q, cost) : print_pair(i, c, q, cost);
      break;
    }
  }
  const auto each = [](std::int64_t ns, std::int64_t n) {
    return n > 0 ? static_cast<double>(ns) / 1e3 / static_cast<double>(n) : 0.0;
  };
  std::fprintf(stderr, "%lld pairs, %.1f us each; %lld motions, %.1f us each\n",
               static_cast<long long>(cost.pairs), each(cost.pair_ns, cost.pairs),
               static_cast<long long>(cost.motions), each(cost.motion_ns, cost.motions));
  return 0;
}

struct Line {
  std::string index, question, verdict;
  double numbers[4] = {0, 0, 0, 0};
  bool read(std::istream& in) {
    if (!(in >> index >> question >> verdict)) return false;
    for (double& x : numbers) {
      std::string text;
      in >> text;
      x = std::strtod(text.c_str(), nullptr);
    }
    return true;
  }
};

bool intersect(const double* x, const double* y) { return !(std::max(x[0], y[0]) > std::min(x[1], y[1])); }

int compare(const char* before, const char* after) {
  std::ifstream old_file(before), new_file(after);
  Line x, y;
  long long lines = 0, differ = 0, decided = 0;
  while (x.read(old_file)) {
    if (!y.read(new_file) || x.index != y.index || x.question != y.question) {
      std::printf("the files are about different cases from line %lld on\n", lines + 1);
      return 1;
    }
    ++lines;
    // What was undecided may be decided now.
    constexpr const char* undecided = "2";
    const bool newly = x.verdict == undecided && y.verdict != undecided;
    decided += newly;
    const bool same = (newly || x.verdict == y.verdict) && intersect(x.numbers, y.numbers) &&
                      (x.question == "pair" || intersect(x.numbers + 2, y.numbers + 2));
    differ += !same;
    if (!same) std::printf("case %s (%s) differs\n", x.index.c_str(), x.question.c_str());
  }
  if (y.read(new_file)) ++differ;
  std::printf("%lld truths, %lld newly decided, %lld differ\n", lines, decided, differ);
  return lines == 0 || differ > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  if (mode == "compare" && argc == 4) return compare(argv[2], argv[3]);
  if (mode == "print" && argc >= 4)
    return print(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10),
                 argc > 4 ? argv[4] : "");
  std::fprintf(stderr, "usage: bench_truths print CASES SEED [FAMILIES] | compare BEFORE AFTER\n");
  return 2;
}
