// Vertex-face and edge-edge queries with linear paths: every recorded query (scenarios/import/ccd_queries.h),
// exactly (tolerance 0) and with tolerance 1e-6 only, against the exact truth column.
//
//   bench_primitive [--data DIR] [--rounds 15]
//
// µs: minimum over the rounds for each query, clock overhead subtracted; mean, median, p99, max over the
// queries. FN: a contact not reported. FP: a contact reported that does not exist. late: reported after the
// interval that contains the first contact. The published figures of Tight-Inclusion (Wang et al. 2021) on
// this class of machine are 51/35 µs mean and 1148/892 µs p99 (vertex-face/edge-edge), FP 257 of 7279 at
// 1e-6.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>

#include "core/impact/primitive_impact.h"
#include "scenarios/import/ccd_queries.h"
#include "tests/bench/ticks.h"

namespace {

using namespace touchstone;
using namespace touchstone::bench;

struct Tally {
  std::vector<double> us;
  long false_negatives = 0, false_positives = 0, late = 0, hits = 0, failed = 0, most_steps = 0;
  std::map<PrimitiveExit, long> exits;
};

void count(Tally& t, const CcdQuery& q, const PrimitiveImpact& r, double us) {
  t.us.push_back(us);
  t.hits += q.truth->collides;
  t.failed += r.outcome != Outcome::answered;
  t.false_negatives += q.truth->collides && !r.toi;
  t.false_positives += !q.truth->collides && r.toi;
  t.late += q.truth->collides && r.toi && *r.toi > q.truth->toi_hi;
  t.most_steps = std::max<long>(t.most_steps, r.steps);
  ++t.exits[r.exit];
}

void print(const std::string& name, const Tally& t) {
  double sum = 0;
  for (double x : t.us) sum += x;
  const auto exit = [&](PrimitiveExit e) { return t.exits.count(e) ? t.exits.at(e) : 0; };
  fmt::print(
      "{:34} {:5} {:5} {:8.3f} {:8.3f} {:9.3f} {:9.2f} {:3} {:4} {:4} {:3} {:5} | {:5} {:5} {:4} {:5} {:4}\n",
      name, t.us.size(), t.hits, sum / static_cast<double>(t.us.size()), quantile(t.us, 0.5),
      quantile(t.us, 0.99), quantile(t.us, 1), t.false_negatives, t.false_positives, t.late, t.failed,
      t.most_steps, exit(PrimitiveExit::box), exit(PrimitiveExit::direction), exit(PrimitiveExit::tolerance),
      exit(PrimitiveExit::crossing), exit(PrimitiveExit::exact));
}

std::vector<std::string> groups_of(const CcdQuery& q) {
  const std::string kind = q.is_vertex_face ? "vertex-face" : "edge-edge";
  const std::string family = q.file.substr(0, q.file.find('/'));
  const std::string origin = family.starts_with("motion-") ? "2 recorded motion" : "2 hand-crafted";
  return {"1 " + family + " " + kind, origin + " " + kind, "3 all " + kind, "3 all"};
}

void run(const std::vector<CcdQuery>& queries, const PrimitiveOptions& options, int rounds,
         const Ticks& clock) {
  std::vector<double> least(queries.size(), HUGE_VAL);
  std::vector<PrimitiveImpact> found(queries.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const CcdQuery& q = queries[i];
      const auto kind = q.is_vertex_face ? PrimitiveKind::vertex_face : PrimitiveKind::edge_edge;
      const std::uint64_t from = tick();
      found[i] = primitive_impact(kind, q.start, q.end, options);
      least[i] = std::min(least[i], clock.ns(tick() - from) / 1000);
    }
  std::map<std::string, Tally> tallies;
  for (std::size_t i = 0; i < queries.size(); ++i)
    for (const std::string& g : groups_of(queries[i])) count(tallies[g], queries[i], found[i], least[i]);
  fmt::print(
      "\ntolerance {:g}\n{:34} {:>5} {:>5} {:>8} {:>8} {:>9} {:>9} {:>3} {:>4} {:>4} {:>3} {:>5} | {:>5} "
      "{:>5} {:>4} {:>5} {:>4}\n",
      options.tolerance, "µs", "cases", "hits", "mean", "median", "p99", "max", "FN", "FP", "late", "bad",
      "steps", "box", "dir", "tol", "cross", "int");
  for (const auto& [name, t] : tallies) print(name.substr(2), t);
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = std::getenv("TS_SHARED_DATA") ? std::getenv("TS_SHARED_DATA") : "../shared/data";
  int rounds = 15;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--data")) data = argv[i + 1];
    if (!std::strcmp(argv[i], "--rounds")) rounds = std::max(1, std::atoi(argv[i + 1]));
  }
  if (!std::filesystem::exists(data + "/ccd/truth.csv")) {
    fmt::print("skipped: {}/ccd/truth.csv is absent (--data)\n", data);
    return 0;
  }
  const auto queries = load_ccd_set(data + "/ccd");
  const Ticks clock;
  run(queries, {}, rounds, clock);
  run(queries, {.min_separation = 0, .tolerance = 1e-6}, rounds, clock);
}
