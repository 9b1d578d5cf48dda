// The core's narrow phase on pairs near contact, in five variants: for each pair of shapes and question every
// variant in turn, round after round, so that a change in the machine's speed affects all of them alike.
// Other engines are measured by `chart`.
//
//   bench_narrow [--cases 200] [--rounds 15] [--filter box-box] [--task contact] [--only core] [--no-truth]
//
// mean: the thread's CPU time over a whole pass of different cases, minimum over the rounds. median, p99:
// over the cases, of the minimum time of each over the rounds, clock overhead subtracted. Error: |gap −
// truth| / L against the referee (for contacts: the excess of the depth along the reported normal over the
// least depth).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/narrow/narrow_phase.h"
#include "core/scene/scene.h"
#include "oracles/referee/referee.h"
#include "tests/bench/narrow_cases.h"
#include "tests/bench/pair_options.h"

namespace {

using namespace touchstone;
using namespace touchstone::bench;

/// What a variant found; NaN for what it does not report.
struct Found {
  bool overlap = false;
  double gap = std::numeric_limits<double>::quiet_NaN();
  Vec3 normal = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  // unit, A to B
};

/// Holds all cases of a cell in its own form; only ask() is timed.
class Variant {
 public:
  virtual ~Variant() = default;
  virtual void ask(std::size_t i, Found& out) = 0;
};
using VariantPtr = std::unique_ptr<Variant>;

class Plain final : public Variant {
 public:
  Plain(Task task, Arithmetic arithmetic, const std::vector<PairCase>& cases, bool graphs = true)
      : task_(task), arithmetic_(arithmetic), with_graphs_(graphs) {
    colliders_.reserve(2 * cases.size());
    for (const PairCase& c : cases)
      pairs_.push_back({collider_of(c.a).at(c.pose_a), collider_of(c.b).at(c.pose_b)});
  }
  void ask(std::size_t i, Found& out) override { ask_with(i, out, nullptr); }
  void ask_with(std::size_t i, Found& out, PairMemory* memory) const {
    const auto& [a, b] = pairs_[i];
    if (task_ == Task::overlap) {
      out.overlap = overlap(a, b, arithmetic_, memory).overlap;
    } else if (task_ == Task::distance) {
      const DistanceAnswer r = distance(a, b, arithmetic_, memory);
      out.gap = r.distance;
      out.normal = r.normal;
      out.overlap = r.distance <= 0;
    } else {
      const ContactAnswer r = contact(a, b, arithmetic_, memory);
      out.overlap = r.overlap;
      out.gap = -r.depth;
      out.normal = r.normal;
    }
  }

 private:
  struct Placed2 {
    PlacedShape a, b;
  };
  const Collider& collider_of(const Shape& s) {
    return colliders_.emplace_back(s, with_graphs_ ? hull_graph_least : Collider::no_graph);
  }
  Task task_;
  Arithmetic arithmetic_;
  bool with_graphs_;
  std::vector<Collider> colliders_;
  std::vector<Placed2> pairs_;
};

VariantPtr make_plain(Task task, const PairKind&, const std::vector<PairCase>& cases) {
  return std::make_unique<Plain>(task, Arithmetic::float64, cases);
}
VariantPtr make_f32(Task task, const PairKind&, const std::vector<PairCase>& cases) {
  return std::make_unique<Plain>(task, Arithmetic::float32, cases);
}

// Large hulls by checking all vertices.
VariantPtr make_scan(Task task, const PairKind& kind, const std::vector<PairCase>& cases) {
  if (static_cast<std::size_t>(kind.vertices) < hull_graph_least) return nullptr;
  return std::make_unique<Plain>(task, Arithmetic::float64, cases, false);
}

// Warm start with the memory of a query one frame ago, when B was offset by `share` of its size and rotated
// by as many radians.
class Warm final : public Variant {
 public:
  Warm(Task task, const std::vector<PairCase>& cases, double share)
      : task_(task), now_(task, Arithmetic::float64, cases) {
    for (const PairCase& c : cases) {
      Pose before = c.pose_b;
      before.translation += share * Vec3(0.6, -0.5, 0.6);
      before.rotation = Quat{0.3 * share, 0.4 * share, -0.3 * share, 1} * before.rotation;
      ask_pair({&c.a, c.pose_a}, {&c.b, before}, memory_.emplace_back());
    }
  }
  void ask(std::size_t i, Found& out) override {
    PairMemory memory = memory_[i];
    now_.ask_with(i, out, &memory);
  }

 private:
  void ask_pair(const PlacedShape& a, const PlacedShape& b, PairMemory& m) const {
    if (task_ == Task::overlap) static_cast<void>(overlap(a, b, Arithmetic::float64, &m));
    if (task_ == Task::distance) static_cast<void>(distance(a, b, Arithmetic::float64, &m));
    if (task_ == Task::contact) static_cast<void>(contact(a, b, Arithmetic::float64, &m));
  }
  Task task_;
  Plain now_;
  std::vector<PairMemory> memory_;
};

VariantPtr make_warm(Task task, const PairKind&, const std::vector<PairCase>& cases) {
  return std::make_unique<Warm>(task, cases, 0.01);
}
// Resting and sliding bodies.
VariantPtr make_rest(Task task, const PairKind&, const std::vector<PairCase>& cases) {
  return std::make_unique<Warm>(task, cases, 1e-3);
}

struct NamedVariant {
  std::string_view name;
  VariantPtr (*make)(Task, const PairKind&, const std::vector<PairCase>&);  // null: not for this pair
};

constexpr NamedVariant variants[] = {
    {"core", &make_plain},     {"core-f32", &make_f32},   {"core-scan", &make_scan},
    {"core-warm", &make_warm}, {"core-rest", &make_rest},
};

struct Row {
  std::string_view name;
  VariantPtr subject;
  std::vector<Found> found;
  PairTimes times;
};

struct Truth {
  referee::PairTruth pair;
  double scale = 1;
};

double scale_of(const PairCase& c) {
  return std::max({extent(c.a), extent(c.b), c.pose_a.translation.cwiseAbs().maxCoeff(),
                   c.pose_b.translation.cwiseAbs().maxCoeff()});
}

double outside(double x, const referee::Bracket& b) { return std::max({b.lo - x, x - b.hi, 0.0}); }

struct Judged {
  long wrong = 0;
  std::vector<double> error;
};

Judged judge(const Row& row, Task task, const std::vector<PairCase>& cases, const std::vector<Truth>& truth) {
  Judged j;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Found& f = row.found[i];
    const Truth& t = truth[i];
    const bool overlap = t.pair.verdict == referee::Verdict::overlap;
    const double gap = std::min(std::abs(t.pair.gap.lo), std::abs(t.pair.gap.hi));
    const bool states = task != Task::distance || overlap == (f.gap <= 0) || std::isnan(f.gap);
    if ((task != Task::distance && f.overlap != overlap) || !states) j.wrong += gap > 1e-12 * t.scale;
    if (task == Task::overlap || std::isnan(f.gap)) continue;
    double error = outside(f.gap, t.pair.gap);
    if (task == Task::contact && f.overlap && f.normal.allFinite()) {
      const auto w = referee::width({&cases[i].a, cases[i].pose_a}, {&cases[i].b, cases[i].pose_b}, f.normal);
      error = std::max(error, outside(-f.gap, w));
    }
    j.error.push_back(error / t.scale);
  }
  return j;
}

void run_cell(const PairKind& kind, Task task, const PairOptions& o, const Ticks& clock) {
  const auto cases = make_cases(kind, task, o.cases, 1);
  std::vector<Row> rows;
  for (const NamedVariant& v : variants)
    if (!o.only.empty() && v.name != o.only)
      continue;
    else if (auto subject = v.make(task, kind, cases))
      rows.push_back({v.name, std::move(subject), std::vector<Found>(cases.size()), PairTimes(cases.size())});
  for (int r = 0; r < o.rounds; ++r)
    for (Row& row : rows) row.times.round(4, [&](std::size_t i) { row.subject->ask(i, row.found[i]); });
  std::vector<Truth> truth;
  for (std::size_t i = 0; o.truth && i < cases.size(); ++i) {
    const PairCase& c = cases[i];
    truth.push_back({referee::judge_pair({&c.a, c.pose_a}, {&c.b, c.pose_b}), scale_of(c)});
  }
  for (const Row& row : rows) {
    const std::vector<double> ns = row.times.each_ns(clock);
    const Judged j = judge(row, task, cases, truth);
    fmt::print("{:<20} {:<9} {:<15} {:>9.1f} {:>9.1f} {:>9.1f} {:>6} {:>9.1e} {:>9.1e} {:>9.1e}\n", kind.name,
               task_names[static_cast<int>(task)], row.name, row.times.mean_ns, quantile(ns, 0.5),
               quantile(ns, 0.99), j.wrong, quantile(j.error, 0.5), quantile(j.error, 0.99),
               quantile(j.error, 1));
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  PairOptions o;
  o.rounds = 15;
  if (!parse(argc, argv, "--task", o)) {
    fmt::print(stderr,
               "bench_narrow [--cases N] [--rounds N] [--filter PAIR] [--task TASK] [--only NAME] "
               "[--no-truth]\n");
    return 2;
  }
  const Ticks clock;
  fmt::print("{:<20} {:<9} {:<15} {:>9} {:>9} {:>9} {:>6} {:>9} {:>9} {:>9}\n", "pair", "question", "variant",
             "mean ns", "median ns", "p99 ns", "wrong", "err p50/L", "p99", "max");
  for (const PairKind& kind : pair_kinds)
    for (const Task task : {Task::overlap, Task::distance, Task::contact}) {
      if (!o.filter.empty() && kind.name.find(o.filter) == std::string_view::npos) continue;
      if (!o.column.empty() && o.column != task_names[static_cast<int>(task)]) continue;
      run_cell(kind, task, o, clock);
    }
  return 0;
}
