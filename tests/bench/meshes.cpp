// Two meshes of thousands of triangles near contact: the core's trees and, where it is installed, FCL's
// OBBRSS trees, called as its adapter calls them; for each question all engines in turn, round after round.
//
//   bench_meshes [--cases 40] [--rounds 5] [--side 50] [--no-truth]
//
// Meshes: bumpy balls and hilly fields of about 2·side² triangles, stretched, in random poses, moved along
// the core's normal until their gap is ±2^-k of their size. Times: the thread's CPU time of a query, minimum
// over the rounds; median and 99 % over the cases. Wrong: against the referee, as the judge counts.
#include <fmt/format.h>

#include <cstring>
#include <functional>
#include <string_view>

#include "core/tolerance.h"
#include "oracles/referee/referee.h"
#include "tests/bench/ticks.h"
#include "tests/core/random_meshes.h"
#ifdef TOUCHSTONE_FCL
#include "oracles/fcl/queries.h"
#endif

namespace {

using namespace touchstone;
using namespace touchstone::bench;
using test::Pair;

struct Options {
  int cases = 40, rounds = 5, side = 50;
  bool truth = true;
};

Options options_of(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string_view name = argv[i];
    if (name == "--no-truth") {
      o.truth = false;
      continue;
    }
    int* value = name == "--cases"    ? &o.cases
                 : name == "--rounds" ? &o.rounds
                 : name == "--side"   ? &o.side
                                      : nullptr;
    if (!value || ++i == argc) {
      fmt::print(stderr, "usage: bench_meshes [--cases N] [--rounds N] [--side N] [--no-truth]\n");
      std::exit(2);
    }
    *value = std::atoi(argv[i]);
  }
  return o;
}

Shape large_mesh(Rng& r, int side) {
  TriangleMesh m = r.chance(0.5) ? test::bumpy_ball(r, side, side, r.chance(0.5) ? 0.1 : 0)
                                 : test::hills(r, side, r.chance(0.5) ? 0.5 / side : 0.1);
  const Vec3 axes{r.uniform(0.4, 1.2), r.uniform(0.4, 1.2), r.uniform(0.4, 1.2)};
  for (Vec3& v : m.vertices) v = v.cwiseProduct(axes);
  return m;
}

Pair near_contact(int i, int side) {
  Rng r = Rng::stream(20, static_cast<std::uint64_t>(i));
  Pair p{large_mesh(r, side), large_mesh(r, side), {}, {}};
  p.pose_a.rotation = r.rotation();
  p.pose_b.rotation = r.rotation();
  p.pose_b.translation = r.unit_vector() * 4;
  const double gap = std::ldexp(1, -static_cast<int>(4 + r.below(30)));
  test::aim(p, r.chance(0.3) ? -gap : gap);
  return p;
}

enum class Task { overlap, distance, contact };
constexpr std::string_view task_names[] = {"overlap", "distance", "contact"};

struct Found {
  bool overlap = false;
  double distance = 0;
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual std::string_view name() const = 0;
  virtual Found ask(std::size_t i, Task task) = 0;
};

class Core final : public Engine {
 public:
  explicit Core(const std::vector<Pair>& pairs) {
    for (const Pair& p : pairs)
      pairs_.push_back(
          {std::make_unique<Collider>(p.a), std::make_unique<Collider>(p.b), p.pose_a, p.pose_b});
  }
  std::string_view name() const override { return "core"; }
  Found ask(std::size_t i, Task task) override {
    const PlacedShape a = pairs_[i].a->at(pairs_[i].pose_a), b = pairs_[i].b->at(pairs_[i].pose_b);
    if (task == Task::overlap) return {touchstone::overlap(a, b).overlap, 0};
    if (task == Task::contact) return {touchstone::contact(a, b).overlap, 0};
    const double d = touchstone::distance(a, b).distance;
    return {d <= 0, d};
  }

 private:
  struct Prepared {
    std::unique_ptr<Collider> a, b;
    Pose pose_a, pose_b;
  };
  std::vector<Prepared> pairs_;
};

#ifdef TOUCHSTONE_FCL
class Fcl final : public Engine {
 public:
  explicit Fcl(const std::vector<Pair>& pairs) {
    for (const Pair& p : pairs) pairs_.push_back({geometry(p.a), geometry(p.b), p.pose_a, p.pose_b});
  }
  std::string_view name() const override { return "fcl"; }
  Found ask(std::size_t i, Task task) override {
    const Prepared& p = pairs_[i];
    const fcl_adapter::Placed a{p.a.get(), fcl_adapter::make_transform(p.pose_a), TS_MESH};
    const fcl_adapter::Placed b{p.b.get(), fcl_adapter::make_transform(p.pose_b), TS_MESH};
    const fcl_adapter::Settings settings{.solver = fcl::GST_LIBCCD, .tuned = false};
    if (task == Task::overlap) return {fcl_adapter::overlap(a, b, settings), 0};
    if (task == Task::contact) return {fcl_adapter::contact(a, b, settings).overlap, 0};
    const fcl_adapter::Distance d = fcl_adapter::distance(a, b, settings);
    return {d.overlap || d.distance.value_or(0) <= 0, d.distance.value_or(0)};
  }

 private:
  struct Prepared {
    fcl_adapter::Geometry a, b;
    Pose pose_a, pose_b;
  };
  static fcl_adapter::Geometry geometry(const Shape& s) {
    const auto& m = std::get<TriangleMesh>(s);
    ts_shape asked{};
    asked.kind = TS_MESH;
    asked.vertices = m.vertices.front().data();
    asked.vertex_count = m.vertices.size();
    asked.triangles = m.triangles.front().data();
    asked.triangle_count = m.triangles.size();
    return fcl_adapter::make_geometry(asked);
  }
  std::vector<Prepared> pairs_;
};
#endif

struct Truth {
  referee::PairTruth pair;
  double scale = 1;
};

// How far the answer is from the truth; for a verdict, the distance that was overlooked or invented.
double error_of(const Found& f, Task task, const Truth& t) {
  const bool meet = t.pair.verdict == referee::Verdict::overlap;
  if (task == Task::distance) {
    if (meet) return std::max(0.0, f.distance);
    return std::max({0.0, t.pair.gap.lo - f.distance, f.distance - t.pair.gap.hi});
  }
  if (f.overlap == meet || t.pair.verdict == referee::Verdict::undecided) return 0;
  return meet ? std::numeric_limits<double>::infinity() : t.pair.gap.lo;
}

void report(Task task, Engine& e, const std::vector<double>& ns, const std::vector<Found>& found,
            const std::vector<Truth>& truth) {
  int wrong = 0;
  double worst = 0;
  std::string list;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error = error_of(found[i], task, truth[i]) / truth[i].scale;
    worst = std::max(worst, error);
    // FCL's requests have a distance tolerance of 1e-6; the core is held to its own.
    const double tau = e.name() == "core" ? tolerance::core_tau_factor * 0x1p-53 : 1e-6;
    if (!(error > tau)) continue;
    ++wrong;
    if (wrong <= 12) list += fmt::format(" {}", i);
  }
  fmt::print("{:<9} {:<6} {:>12.0f} {:>12.0f} {:>6} {:>10.2g}{}\n",
             task_names[static_cast<std::size_t>(task)], e.name(), quantile(ns, 0.5), quantile(ns, 0.99),
             wrong, worst, list);
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = options_of(argc, argv);
  std::vector<Pair> pairs;
  for (int i = 0; i < o.cases; ++i) pairs.push_back(near_contact(i, o.side));
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<Core>(pairs));
#ifdef TOUCHSTONE_FCL
  engines.push_back(std::make_unique<Fcl>(pairs));
#endif
  std::vector<Truth> truth;
  if (o.truth)
    for (const Pair& p : pairs)
      truth.push_back({referee::judge_pair({&p.a, p.pose_a}, {&p.b, p.pose_b}), test::scale_of(p)});
  long meeting = 0;
  for (const Truth& t : truth) meeting += t.pair.verdict == referee::Verdict::overlap;
  fmt::print("{} pairs, {} of which meet\n{:<9} {:<6} {:>12} {:>12} {:>6} {:>10} cases\n", pairs.size(),
             meeting, "question", "engine", "median ns", "99 % ns", "wrong", "worst/L");
  for (const Task task : {Task::overlap, Task::distance, Task::contact}) {
    std::vector<std::vector<double>> ns(engines.size(), std::vector<double>(pairs.size(), 1e300));
    std::vector<std::vector<Found>> found(engines.size(), std::vector<Found>(pairs.size()));
    for (int round = 0; round < o.rounds; ++round)
      for (std::size_t i = 0; i < pairs.size(); ++i)
        for (std::size_t k = 0; k < engines.size(); ++k) {
          const double start = clock_ns(CLOCK_THREAD_CPUTIME_ID);
          found[k][i] = engines[k]->ask(i, task);
          ns[k][i] = std::min(ns[k][i], clock_ns(CLOCK_THREAD_CPUTIME_ID) - start);
        }
    for (std::size_t k = 0; k < engines.size(); ++k) report(task, *engines[k], ns[k], found[k], truth);
  }
}
