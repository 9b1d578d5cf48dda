// touchstone merge OUT IN…: merges shards of a campaign, or with --ledgers, ledgers of known causes.
#include <fmt/format.h>

#include <filesystem>

#include "cli/command.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/shard.h"
#include "fuzz/triage/ledger.h"
#include "reports/text/text.h"

namespace touchstone::cli {
namespace {

struct MergeOptions {
  std::string out;
  std::vector<std::string> in;
  bool ledgers = false, json = false;
};

std::vector<std::filesystem::path> paths(const MergeOptions& o) { return {o.in.begin(), o.in.end()}; }

int merge_shards(const MergeOptions& o) {
  const fuzz::Merged m = fuzz::merge_campaigns(o.out, paths(o));
  if (o.json) {
    const fuzz::Json j = {{"out", o.out},
                          {"digest", fuzz::digest(m.result)},
                          {"cases", m.result.cases},
                          {"findings", m.result.findings.size()},
                          {"shards", m.shards},
                          {"missing", m.missing}};
    fmt::print("{}\n", j.dump(1));
  } else {
    fmt::print("{}\n{}", reports::full_campaign_table(m.result), reports::campaign_footer(m.result));
    fmt::print("{} shards, {} missing; {} kinds of findings in {}/findings; digest {}\n", m.shards.size(),
               m.missing.size(), reports::grouped(m.result.findings.size()), o.out, fuzz::digest(m.result));
  }
  return exit_clean;
}

int run(const MergeOptions& o) {
  if (o.in.empty())
    throw InputError("merge",
                     "needs an output and inputs: touchstone merge OUT SHARD..., or touchstone merge "
                     "--ledgers OUT.db LEDGER.db...");
  if (!o.ledgers) return merge_shards(o);
  const std::size_t n = fuzz::merge_ledgers(o.out, paths(o));
  fmt::print("{} causes in {}\n", reports::grouped(n), o.out);
  return exit_clean;
}

}  // namespace

Run declare_merge(CLI::App& app) {
  auto o = std::make_shared<MergeOptions>();
  app.add_option("out", o->out, "directory (with --ledgers: file) for the result");
  app.add_option("in", o->in,
                 "directories of finished or merged shards, in any order; repetitions are ignored");
  app.add_flag("--ledgers", o->ledgers, "merge ledgers (causes.db) instead");
  app.add_flag("--json", o->json, "one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
