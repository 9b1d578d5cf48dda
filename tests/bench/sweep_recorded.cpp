// Recorded scenes: how many bodies the criterion flags in a step of 1/60 s, why, how many pairs it queries,
// and what a step costs compared with the discrete one.
//
//   bench_sweep_recorded [--data DIR] [--every 10] [--rounds 3] [--only NAME]
//
// Every tenth frame with its motions, each in its own world; the first step is not timed. unseen: impacts of
// pairs that touch neither at the end pose nor at the start.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>

#include "core/world/step_world.h"
#include "scenarios/import/real_scene.h"
#include "tests/bench/ticks.h"

namespace {

using namespace touchstone;
using namespace touchstone::bench;

struct Sum {
  long frames = 0, bodies = 0, travel = 0, turning = 0, most = 0, asked = 0, spared = 0, impacts = 0,
       unseen = 0, unsettled = 0;
  double discrete_us = 0, swept_us = 0;
};

double least_us(StepWorld& w, const SweepOptions& o, int rounds) {
  double least = HUGE_VAL;
  for (int k = 0; k < rounds; ++k) {
    const double from = clock_ns(CLOCK_THREAD_CPUTIME_ID);
    w.step(o);
    least = std::min(least, (clock_ns(CLOCK_THREAD_CPUTIME_ID) - from) / 1000);
  }
  return least;
}

void add_frame(const Scene& scene, int rounds, Sum& s) {
  StepWorld w(scene);
  const StepReport r = w.step();
  std::set<BodyPair> at_end;
  for (const PairContact& c : r.contacts) at_end.emplace(c.a, c.b);
  ++s.frames;
  s.bodies += static_cast<long>(scene.bodies.size());
  for (const SweptBody& b : r.swept) ++(b.reason == SweepReason::turning ? s.turning : s.travel);
  s.most = std::max(s.most, static_cast<long>(r.swept.size()));
  s.asked += r.asked;
  s.spared += r.spared;
  s.unsettled += r.outcome != Outcome::answered;
  for (const PairImpact& i : r.impacts) {
    if (!i.impact.toi) continue;
    ++s.impacts;
    s.unseen += *i.impact.toi > 0 && !at_end.contains({i.a, i.b});
  }
  s.discrete_us += least_us(w, {SweepOptions::Which::none, 0.5}, rounds);
  s.swept_us += least_us(w, {}, rounds);
}

void print(const std::string& name, const Sum& s) {
  const auto n = static_cast<double>(s.frames);
  const auto mean = [&](long x) { return static_cast<double>(x) / n; };
  fmt::print(
      "{:26} {:6} {:7.0f} {:8.2f} {:8.2f} {:5} {:8.1f} {:8.1f} {:8.1f} {:7.1f} {:10.1f} {:10.1f} {:6.3f} "
      "{:4}\n",
      name, s.frames, mean(s.bodies), mean(s.travel), mean(s.turning), s.most, mean(s.asked), mean(s.spared),
      mean(s.impacts), mean(s.unseen), s.discrete_us / n, s.swept_us / n, s.swept_us / s.discrete_us,
      s.unsettled);
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = std::getenv("TS_SHARED_DATA") ? std::getenv("TS_SHARED_DATA") : "../shared/data", only;
  int every = 10, rounds = 3;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--data")) data = argv[i + 1];
    if (!std::strcmp(argv[i], "--every")) every = std::max(1, std::atoi(argv[i + 1]));
    if (!std::strcmp(argv[i], "--rounds")) rounds = std::max(1, std::atoi(argv[i + 1]));
    if (!std::strcmp(argv[i], "--only")) only = argv[i + 1];
  }
  if (!std::filesystem::exists(data + "/scenes")) {
    fmt::print("skipped: {}/scenes is absent (--data)\n", data);
    return 0;
  }
  fmt::print("{:26} {:>6} {:>7} {:>8} {:>8} {:>5} {:>8} {:>8} {:>8} {:>7} {:>10} {:>10} {:>6} {:>4}\n",
             "mean a step", "frames", "bodies", "travel", "turning", "most", "asked", "spared", "impacts",
             "unseen", "discrete", "swept µs", "ratio", "open");
  std::set<std::filesystem::path> scenes;
  for (const auto& e : std::filesystem::directory_iterator(data + "/scenes")) scenes.insert(e.path());
  for (const auto& path : scenes) {
    if (!only.empty() && path.filename() != only) continue;
    const RealScene recorded = load_real_scene(path);
    std::map<std::string, Sum> by_label;
    for (int f = 0; f < recorded.frame_count(); f += every)
      if (recorded.has_velocities() || recorded.is_followed(f))
        add_frame(recorded.frame_with_motion(f), rounds,
                  by_label[recorded.frames[static_cast<std::size_t>(f)].label]);
    for (const auto& [label, s] : by_label) print(recorded.name + " " + label, s);
  }
}
