// touchstone primitives [PATH...]: deforming primitives (a vertex against a triangle, an edge against an
// edge, every vertex on a straight path), answered by the core and decided exactly by the referee. Queries
// come from files in the format of the published Sample-Queries (scenarios/import/ccd_queries.h) or from a
// generator.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "cli/command.h"
#include "core/base/input_error.h"
#include "core/impact/primitive_impact.h"
#include "oracles/referee/referee.h"
#include "reports/record/primitives.h"
#include "reports/text/text.h"
#include "scenarios/import/ccd_queries.h"
#include "scenarios/random/primitive_motions.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

struct PrimitiveRun {
  std::vector<std::string> paths;
  std::uint64_t random = 0, seed = 1;
  double tolerance = 0;
  bool json = false;
};

std::string_view kind_name(bool is_vertex_face) { return is_vertex_face ? "vertex-face" : "edge-edge"; }

void judge(const CcdQuery& q, bool from_file, const PrimitiveOptions& options, fuzz::PrimitiveTally& t) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const PrimitiveImpact answer = primitive_impact(
      q.is_vertex_face ? PrimitiveKind::vertex_face : PrimitiveKind::edge_edge, q.start, q.end, options);
  t.time.add(std::chrono::nanoseconds(Clock::now() - start).count());
  const referee::PrimitiveTruth truth = referee::judge_primitive_motion(
      q.is_vertex_face ? referee::PrimitivePair::vertex_face : referee::PrimitivePair::edge_edge, q.start,
      q.end);
  ++t.queries;
  t.hits += truth.collides;
  t.source_wrong += from_file && q.file_truth != truth.collides;
  if (answer.outcome != Outcome::answered) {
    ++t.failed;
    return;
  }
  t.missed += truth.collides && !answer.toi;
  if (!truth.collides && answer.toi) ++(options.tolerance > 0 ? t.not_judged : t.ghost);
  t.late += truth.collides && answer.toi && *answer.toi > truth.t_hi;
}

bool names_kind(const fs::path& folder) { return folder == "vertex-face" || folder == "edge-edge"; }

// The published layout: SOURCE/vertex-face/*.csv and SOURCE/edge-edge/*.csv.
void read_file_of_queries(const fs::path& file, const PrimitiveOptions& options,
                          fuzz::PrimitiveTallies& all) {
  const fs::path folder = file.parent_path().filename();
  if (!names_kind(folder))
    throw InputError(file.string(),
                     "lies in no folder `vertex-face` or `edge-edge`, which says what its queries are");
  const bool is_vertex_face = folder == "vertex-face";
  std::string source = printable(file.parent_path().parent_path().filename().string());
  if (source.empty()) source = ".";
  for (const CcdQuery& q : load_ccd_file(file, is_vertex_face))
    judge(q, true, options, all[{source, std::string(kind_name(is_vertex_face))}]);
}

void read_path(const fs::path& path, const PrimitiveOptions& options, fuzz::PrimitiveTallies& all) {
  if (!fs::is_directory(path)) return read_file_of_queries(fs::absolute(path), options, all);
  std::vector<fs::path> files;
  for (const auto& e : fs::recursive_directory_iterator(path))
    if (e.is_regular_file() && e.path().extension() == ".csv" &&
        names_kind(e.path().parent_path().filename()))
      files.push_back(fs::absolute(e.path()));
  if (files.empty())
    throw InputError(path.string(), "holds no queries (folders `vertex-face` and `edge-edge` of CSV files)");
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) read_file_of_queries(file, options, all);
}

void draw(const PrimitiveRun& run, const PrimitiveOptions& options, fuzz::PrimitiveTallies& all) {
  for (std::uint64_t i = 0; i < run.random; ++i) {
    Rng rng = Rng::stream(run.seed, i);
    const primitives::PrimitiveMotion m = primitives::random_motion(rng, i);
    CcdQuery q;
    q.is_vertex_face = i % 2 == 0;
    q.start = m.a;
    q.end = m.b;
    judge(q, false, options, all[{"random", std::string(kind_name(q.is_vertex_face))}]);
  }
}

void print_row(std::string_view source, std::string_view kind, const fuzz::PrimitiveTally& t) {
  fmt::print("{:<22.22} {:<11} {:>7} {:>5} {:>3} {:>3} {:>4} {:>4} {:>6} {:>6}\n", source, kind, t.queries,
             t.hits, t.missed, t.ghost, t.late, t.failed, reports::nanoseconds(t.time.quantile(0.5)),
             reports::nanoseconds(t.time.quantile(fuzz::tail_quantile)));
}

void print_text(const fuzz::PrimitiveTallies& all, const fuzz::PrimitiveTally& sum) {
  fmt::print("{:<22} {:<11} {:>7} {:>5} {:>3} {:>3} {:>4} {:>4} {:>6} {:>6}\n", "source", "kind", "queries",
             "hits", "FN", "FP", "late", "fail", "ns", "p99");
  for (const auto& [key, t] : all) print_row(key.first, key.second, t);
  print_row("all", "", sum);
  fmt::print(
      "\nFN: a contact that the core misses. FP: a contact that does not exist. late: a\n"
      "time after the first contact. ns: median time of one query. The referee decides\n"
      "every query in exact arithmetic.\n");
  if (sum.not_judged > 0)
    fmt::print("{} contacts that do not exist are within --tolerance by the core's account: not judged.\n",
               sum.not_judged);
  if (sum.source_wrong > 0)
    fmt::print("{} verdicts stated in the files are not the exact ones.\n", sum.source_wrong);
  fmt::print("core: {} of {} queries wrong\n", sum.wrong(), sum.queries);
}

int run_primitives(const PrimitiveRun& run) {
  if (run.paths.empty() && run.random == 0)
    throw InputError("primitives", "name files or folders of queries, or --random N");
  const PrimitiveOptions options{.min_separation = 0, .tolerance = run.tolerance};
  fuzz::PrimitiveTallies all;
  for (const std::string& path : run.paths) {
    if (!fs::exists(path)) throw InputError(path, "does not exist");
    read_path(path, options, all);
  }
  draw(run, options, all);
  fuzz::PrimitiveTally sum;
  for (const auto& [key, t] : all) sum.merge(t);
  if (run.json)
    fmt::print("{}\n", to_json(all).dump(1));
  else
    print_text(all, sum);
  if (sum.queries == 0) return exit_failed;
  return sum.wrong() > 0 ? exit_wrong : exit_clean;
}

}  // namespace

Run declare_primitives(CLI::App& app) {
  auto run = std::make_shared<PrimitiveRun>();
  app.add_option("path", run->paths,
                 "files of queries, or folders that hold them in folders vertex-face and edge-edge");
  app.add_option("--random", run->random, "also this many random queries")->check(a_count());
  app.add_option("--seed", run->seed, "seed of the random queries");
  app.add_option("--tolerance", run->tolerance,
                 "distance at which the core may call it a contact (default: none, exact)")
      ->check(a_positive_number());
  app.add_flag("--json", run->json, "one JSON document");
  app.footer("Exit code: 0 all right, 1 the core was wrong, 2 bad input, 3 nothing was asked.");
  return [run] { return run_primitives(*run); };
}

}  // namespace touchstone::cli
