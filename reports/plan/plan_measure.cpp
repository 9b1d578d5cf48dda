#include "reports/plan/plan_measure.h"

#include <algorithm>
#include <map>

#include "core/broad/body_box.h"
#include "core/broad/catalog.h"
#include "core/math/rng.h"
#include "core/world/world.h"
#include "oracles/abi/measure.h"
#include "reports/plan/plan.h"

namespace touchstone::fuzz {
namespace {

// CPU time of this thread, which does all the work, so other processes disturb the result less.
double ns_since(std::int64_t start) { return static_cast<double>(thread_cpu_ns() - start); }

// A body's box with half of the margin around it.
Aabb box_about(const Course& c, int body, const Pose& pose, double margin) {
  const Aabb box = broad::body_box(c.scene.shape_of(body), pose);
  return margin == 0 ? box : widened(box, margin / 2);
}

// The boxes of the moving bodies in every step, as updates for a broad phase.
std::vector<std::vector<broad::BoxUpdate>> box_updates(const Course& c, const EndPoses& poses,
                                                       double margin) {
  std::vector<std::vector<broad::BoxUpdate>> all;
  for (std::size_t s = 0; s < c.steps.size(); ++s) {
    all.emplace_back();
    for (const Course::Move& m : c.steps[s].moves)
      all.back().push_back({m.body, box_about(c, m.body, poses[s][at(m.body)], margin)});
  }
  return all;
}

void insert_bodies(const Course& c, double margin, broad::BroadPhase& phase) {
  for (int i = 0; i < static_cast<int>(c.scene.bodies.size()); ++i) {
    const Body& b = c.scene.bodies[at(i)];
    phase.insert(i, box_about(c, i, b.pose, margin),
                 b.is_static ? broad::Mobility::fixed : broad::Mobility::moving);
  }
}

double time_phase(const Course& c, const std::vector<std::vector<broad::BoxUpdate>>& updates,
                  std::string_view name, double margin) {
  const auto phase = broad::make_broad_phase(name);
  insert_bodies(c, margin, *phase);
  std::vector<broad::IdPair> pairs;
  double total = 0;
  int counted = 0;
  for (std::size_t s = 0; s < updates.size(); ++s) {
    const auto start = thread_cpu_ns();
    phase->update(updates[s]);
    phase->pairs(pairs);
    if (c.steps[s].follows || updates.size() == 1) {
      total += ns_since(start);
      ++counted;
    }
  }
  return counted ? total / counted : 0;
}

struct Sample {
  std::uint64_t candidates = 0;
  std::vector<Occurrence> pairs;
};

using Kinds = std::pair<ShapeKind, ShapeKind>;  // smaller kind first

// Reservoir sampling: every candidate is equally likely.
std::map<Kinds, Sample> sample_pairs(const Course& c, const std::vector<PlannedShape>& shapes,
                                     const std::vector<std::vector<BodyPair>>& candidates, Rng& rng) {
  constexpr std::size_t sample_size = 192;
  std::map<Kinds, Sample> samples;
  const auto kind = [&](int i) { return kind_of(shapes[at(c.scene.bodies[at(i)].shape)].shape()); };
  for (std::size_t s = 0; s < candidates.size(); ++s)
    for (const auto& [a, b] : candidates[s]) {
      Sample& of = samples[std::minmax(kind(a), kind(b))];
      const Occurrence o{static_cast<int>(s), a, b};
      if (of.pairs.size() < sample_size)
        of.pairs.push_back(o);
      else if (const auto place = rng.below(of.candidates + 1); place < sample_size)
        of.pairs[place] = o;
      ++of.candidates;
    }
  return samples;
}

// The bodies of a sample at their poses, for one set of shapes.
class Bench {
 public:
  Bench(const Course& c, const EndPoses& poses, const std::vector<PlannedShape>& shapes,
        const Sample& sample) {
    for (const Occurrence& o : sample.pairs) {
      const auto planned = [&](int i) -> const PlannedShape& {
        return shapes[at(c.scene.bodies[at(i)].shape)];
      };
      pairs_.push_back({&planned(o.a), &planned(o.b), planned_body(planned(o.a), poses[at(o.step)][at(o.a)]),
                        planned_body(planned(o.b), poses[at(o.step)][at(o.b)])});
    }
  }

  // Returns ns per pair. Uses the answers, so that the compiler cannot remove the calls.
  double time(const Fidelity& f) {
    const auto start = thread_cpu_ns();
    for (const Pair& p : pairs_) contacts_ += planned_near(f, *p.a, p.at_a, *p.b, p.at_b).within;
    return ns_since(start) / static_cast<double>(pairs_.size());
  }

  void count(const Fidelity& f, PlanPair& r) const {
    std::uint64_t balls = 0, cheap = 0;
    for (const Pair& p : pairs_) {
      DecidedBy by{};
      double bound = 0;
      const PlannedNear c = planned_near(f, *p.a, p.at_a, *p.b, p.at_b, nullptr, &by, &bound);
      balls += by == DecidedBy::balls;
      cheap += by == DecidedBy::cheap;
      if (c.outcome == Outcome::answered) r.certified_error = std::max(r.certified_error, bound);
    }
    const auto n = static_cast<double>(pairs_.size()), rest = n - static_cast<double>(balls);
    r.balls_share = static_cast<double>(balls) / n;
    r.cheap_share = rest > 0 ? static_cast<double>(cheap) / rest : 0;
  }

 private:
  struct Pair {
    const PlannedShape *a, *b;
    PlannedBody at_a, at_b;
  };
  std::vector<Pair> pairs_;
  std::uint64_t contacts_ = 0;
};

PlanPair choose_method(const Kinds& kinds, const Sample& sample, Bench bench, int rounds, Fidelity& f) {
  constexpr PairMethod methods[] = {{false, Arithmetic::float64},       {true, Arithmetic::float64},
                                    {false, Arithmetic::float64_alone}, {true, Arithmetic::float64_alone},
                                    {false, Arithmetic::float32},       {true, Arithmetic::float32}};
  // Any other method must beat plain double by more than the noise of a measurement.
  constexpr double worth_it = 0.95;
  double least[std::size(methods)];
  std::fill(std::begin(least), std::end(least), std::numeric_limits<double>::infinity());
  PairMethod& method = f.of(kinds.first, kinds.second);
  for (int round = 0; round < rounds; ++round)
    for (std::size_t m = 0; m < std::size(methods); ++m) {
      method = methods[m];
      least[m] = std::min(least[m], bench.time(f));
    }
  std::size_t best = 0;
  for (std::size_t m = 1; m < std::size(methods); ++m)
    if (least[m] < least[best] * (best == 0 ? worth_it : 1)) best = m;
  method = methods[best];
  PlanPair r;
  r.pair = std::string(type_name(kinds.first)).append(1, '-').append(type_name(kinds.second));
  r.balls_first = method.balls_first;
  r.arithmetic = to_string(method.arithmetic);
  r.candidates = sample.candidates;
  r.sampled = sample.pairs.size();
  r.ns_double = least[0];
  r.ns = least[best];
  bench.count(f, r);
  return r;
}

}  // namespace

EndPoses end_poses(const Course& c) {
  EndPoses all;
  for (const Course::Step& step : c.steps) {
    std::vector<Pose> poses;
    for (const Body& b : c.scene.bodies) poses.push_back(b.pose);
    for (const Course::Move& m : step.moves) poses[at(m.body)] = pose_at(m.start, m.motion, 1);
    all.push_back(std::move(poses));
  }
  return all;
}

std::vector<std::vector<BodyPair>> course_candidates(const Course& c, const EndPoses& poses, double margin) {
  const auto phase = broad::make_broad_phase("automatic");
  insert_bodies(c, margin, *phase);
  std::vector<std::vector<BodyPair>> all;
  std::vector<broad::IdPair> pairs;
  for (const auto& updates : box_updates(c, poses, margin)) {
    phase->update(updates);
    phase->pairs(pairs);
    all.emplace_back();
    for (const auto& [a, b] : pairs)
      if (is_reported(c.scene, a, b)) all.back().emplace_back(a, b);
  }
  return all;
}

std::vector<PlanPhase> measure_phases(const Course& c, const EndPoses& poses, int rounds, double margin) {
  // A broad phase slower than the fastest by this factor is not measured again.
  constexpr double too_slow = 8;
  const auto updates = box_updates(c, poses, margin);
  std::vector<PlanPhase> phases;
  for (const auto& row : broad::catalog)
    phases.push_back({std::string(row.name), time_phase(c, updates, row.name, margin)});
  for (int round = 1; round < rounds; ++round) {
    const double best = std::min_element(phases.begin(), phases.end(), [](const auto& x, const auto& y) {
                          return x.ns_step < y.ns_step;
                        })->ns_step;
    for (PlanPhase& p : phases)
      if (p.ns_step < too_slow * best)
        p.ns_step = std::min(p.ns_step, time_phase(c, updates, p.name, margin));
  }
  std::stable_sort(phases.begin(), phases.end(),
                   [](const auto& x, const auto& y) { return x.ns_step < y.ns_step; });
  return phases;
}

std::vector<PlanPair> choose_methods(const Course& c, const EndPoses& poses,
                                     const std::vector<std::vector<BodyPair>>& candidates, std::uint64_t seed,
                                     int rounds, Fidelity& f) {
  Rng rng(seed);
  const std::vector<PlannedShape> shapes = planned_shapes(c.scene, f);
  std::vector<PlanPair> pairs;
  for (const auto& [kinds, sample] : sample_pairs(c, shapes, candidates, rng))
    pairs.push_back(choose_method(kinds, sample, Bench(c, poses, shapes, sample), rounds, f));
  std::stable_sort(pairs.begin(), pairs.end(), [](const PlanPair& x, const PlanPair& y) {
    return x.ns * static_cast<double>(x.candidates) > y.ns * static_cast<double>(y.candidates);
  });
  return pairs;
}

double run_course(const Course& c, const Fidelity& f,
                  const std::function<void(int, const StepReport&)>& each) {
  StepWorld world(c.scene, f);
  const bool any_follows =
      std::any_of(c.steps.begin(), c.steps.end(), [](const Course::Step& s) { return s.follows; });
  double total = 0;
  int counted = 0;
  for (std::size_t s = 0; s < c.steps.size(); ++s) {
    const auto start = thread_cpu_ns();
    for (const Course::Move& m : c.steps[s].moves) world.set(m.body, m.start, m.motion);
    const StepReport r = world.step();
    if (c.steps[s].follows || !any_follows) {
      total += ns_since(start);
      ++counted;
    }
    if (each) each(static_cast<int>(s), r);
  }
  return total / counted;
}

}  // namespace touchstone::fuzz
