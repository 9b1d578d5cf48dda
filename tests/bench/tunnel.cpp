// Tunnelling: 1,000 bodies, 3 of them bullets. The discrete step, the step that sweeps what the criterion
// flags, the step that sweeps everything, and sub-stepping: what each costs and which passes it misses.
//
//   bench_tunnel [--bodies 1000] [--steps 40] [--rounds 3] [--most 64]     (most: sub-steps)
//
// A pass: a bullet and a body that meet at some time of the step (core/impact, called for every pair whose
// swept boxes meet). Missed: neither an impact nor a contact at any pose that was tested. Time: minimum CPU
// time over the rounds for each step, summed. There are no dynamics: bodies keep their velocities; bullets
// are shot again.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <set>

#include "core/broad/body_box.h"
#include "core/world/step_world.h"
#include "tests/bench/ticks.h"
#include "tests/bench/tunnel_scene.h"

namespace {

using namespace touchstone;
using namespace touchstone::bench;

struct Method {
  const char* name;
  SweepOptions sweep;
  int substeps = 1;
};

struct Run {
  Method method;
  std::vector<double> step_ns;  // minimum over the rounds
  long missed = 0, bullets_flagged = 0, others_flagged = 0, most_others = 0, asked = 0;
  double sweep_contacts = 0;
};

using Shots = std::vector<std::vector<Shot>>;  // one entry per step
using Passes = std::vector<std::set<BodyPair>>;

void place_bullets(StepWorld& w, const std::vector<Shot>& fired, int substeps) {
  for (std::size_t i = 0; i < fired.size(); ++i)
    w.set(static_cast<int>(i), fired[i].start,
          {fired[i].motion.linear / substeps, fired[i].motion.angular / substeps});
}

Scene slowed(Scene s, int substeps) {
  for (Body& b : s.bodies)
    if (b.motion) {
      b.motion->linear /= substeps;
      b.motion->angular /= substeps;
    }
  return s;
}

Passes find_passes(const TunnelScene& t, const Shots& fired) {
  Passes all;
  StepWorld w(t.scene);
  for (const auto& shots_of_step : fired) {
    place_bullets(w, shots_of_step, 1);
    std::set<BodyPair> found;
    const Scene& s = w.scene();
    const auto moving = [&](int i) {
      const Body& b = s.bodies[static_cast<std::size_t>(i)];
      return MovingShape{&s.shape_of(i), b.pose, b.motion.value_or(Motion{})};
    };
    for (int i = 0; i < t.bullets; ++i)
      for (int j = 0; j < static_cast<int>(s.bodies.size()); ++j) {
        const MovingShape a = moving(i), b = moving(j);
        if (i == j || !overlaps(broad::swept_box(*a.shape, a.pose, a.motion),
                                broad::swept_box(*b.shape, b.pose, b.motion)))
          continue;
        if (time_of_impact(a, b).toi) found.insert(std::minmax(i, j));
      }
    all.push_back(std::move(found));
    w.step({SweepOptions::Which::none, 0.5});
    w.accept();
  }
  return all;
}

void run_round(const TunnelScene& t, const Shots& fired, const Passes& passes, Run& run, bool count) {
  StepWorld w(slowed(t.scene, run.method.substeps));
  for (std::size_t step = 0; step < fired.size(); ++step) {
    place_bullets(w, fired[step], run.method.substeps);
    std::set<BodyPair> seen;
    double ns = 0;
    for (int k = 0; k < run.method.substeps; ++k) {
      const double from = clock_ns(CLOCK_THREAD_CPUTIME_ID);
      const StepReport r = w.step(run.method.sweep);
      ns += clock_ns(CLOCK_THREAD_CPUTIME_ID) - from;
      w.accept();
      if (!count) continue;
      for (const PairContact& c : r.contacts) seen.emplace(c.a, c.b);
      for (const PairImpact& i : r.impacts)
        if (i.impact.toi) seen.emplace(i.a, i.b);
      long others = 0;
      for (const SweptBody& b : r.swept) ++(b.body < t.bullets ? run.bullets_flagged : others);
      run.others_flagged += others;
      run.most_others = std::max(run.most_others, others);
      run.asked += r.asked;
      run.sweep_contacts += static_cast<double>(r.contacts.size()) / run.method.substeps;
    }
    run.step_ns[step] = std::min(run.step_ns[step], ns);
    if (count)
      for (const BodyPair& p : passes[step]) run.missed += !seen.contains(p);
  }
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  int bodies = 1000, steps = 40, rounds = 3, most = 64;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--bodies")) bodies = std::atoi(argv[i + 1]);
    if (!std::strcmp(argv[i], "--steps")) steps = std::max(1, std::atoi(argv[i + 1]));
    if (!std::strcmp(argv[i], "--rounds")) rounds = std::max(1, std::atoi(argv[i + 1]));
    if (!std::strcmp(argv[i], "--most")) most = std::atoi(argv[i + 1]);
  }
  const TunnelScene t = tunnel_scene(bodies, 7);
  Rng r(8);
  Shots fired;
  for (int i = 0; i < steps; ++i) fired.push_back(shots(t, r));
  const Passes passes = find_passes(t, fired);
  long total = 0;
  for (const auto& p : passes) total += static_cast<long>(p.size());
  using Which = SweepOptions::Which;
  std::vector<Run> runs;
  const auto add = [&](const char* name, Which which, int substeps) {
    Run run;
    run.method = {name, {which, 0.5}, substeps};
    run.step_ns.assign(fired.size(), HUGE_VAL);
    runs.push_back(std::move(run));
  };
  add("discrete", Which::none, 1);
  add("swept where needed", Which::by_criterion, 1);
  add("all swept", Which::all, 1);
  add("4 sub-steps", Which::none, 4);
  add("16 sub-steps", Which::none, 16);
  add("64 sub-steps", Which::none, 64);
  if (most >= 256) add("256 sub-steps", Which::none, 256);
  for (int round = 0; round < rounds; ++round)
    for (Run& run : runs)
      if (round == 0 || run.method.substeps < 64) run_round(t, fired, passes, run, round == 0);
  fmt::print("{} bodies, {} bullets, {} steps, {} passes of bullets\n", bodies, t.bullets, steps, total);
  fmt::print("{:20} {:>10} {:>10} {:>8} {:>7} {:>16} {:>20} {:>7} {:>9}\n", "", "median µs", "mean µs",
             "x disc.", "missed", "bullets flagged", "others, mean (most)", "asked", "contacts");
  double base = 0;
  for (const Run& run : runs) {
    double sum = 0;
    for (double ns : run.step_ns) sum += ns / 1000;
    if (base == 0) base = sum;
    fmt::print("{:20} {:10.1f} {:10.1f} {:8.3f} {:7} {:16} {:>20} {:7} {:9.1f}\n", run.method.name,
               median(run.step_ns) / 1000, sum / steps, sum / base, run.missed, run.bullets_flagged,
               fmt::format("{:.2f} ({})", static_cast<double>(run.others_flagged) / steps, run.most_others),
               run.asked, run.sweep_contacts / steps);
  }
}
