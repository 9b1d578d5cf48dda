// A campaign in shards: which task runs which shard, and the result of merging them.
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/input_error.h"
#include "fuzz/campaign/shard.h"
#include "fuzz/triage/ledger.h"
#include "fuzz/triage/triage.h"
#include "oracles/core/core_engine.h"
#include "reports/record/stored.h"
#include "reports/text/record_text.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"
#include "tests/support/causes_by_hand.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using touchstone::test::read_all;
using touchstone::test::Workspace;
namespace fs = std::filesystem;

namespace {

// Findings and state of a campaign without its times.
std::map<std::string, std::string> files_of(const fs::path& campaign) {
  std::map<std::string, std::string> r;
  if (fs::exists(campaign / "findings"))
    for (const auto& e : fs::recursive_directory_iterator(campaign / "findings"))
      if (e.is_regular_file()) r[fs::relative(e.path(), campaign).string()] = read_all(e.path());
  for (const char* name : {"state.json", "summary.json"}) {
    auto j = test::parsed<nlohmann::ordered_json>(read_all(campaign / name));
    auto& result = j.contains("result") ? j["result"] : j;
    result.erase("times");
    for (auto& [engine, questions] : result["engines"].items())
      for (auto& [question, tally] : questions.items())
        for (const char* time : {"ns_median", "ns_p99", "ns_histogram"}) tally.erase(time);
    r[name] = j.dump();
  }
  return r;
}

std::vector<EnginePtr> liar() {
  std::vector<EnginePtr> e;
  for (const auto& m : mutants::mutants())
    if (m.name == "depth_halved") e.push_back(mutants::make_lying_engine(m));
  return e;
}

const std::atomic<bool> go{false};

fs::path campaign(const fs::path& out, std::uint64_t shard, std::uint64_t shards) {
  fuzz::CampaignConfig c;
  c.engines = {"depth_halved"};
  c.subject = "depth_halved";
  c.cases = 400;
  c.seed = 9;
  c.shard = shard;
  c.shards = shards;
  c.out = out;
  fuzz::run_campaign(c, liar, {}, go);
  return out;
}

fuzz::Shard shard_of(const std::string& text, const std::map<std::string, std::string>& environment) {
  return fuzz::which_shard(text, [&](const char* name) -> std::optional<std::string> {
    const auto it = environment.find(name);
    return it == environment.end() ? std::nullopt : std::optional(it->second);
  });
}

}  // namespace

TEST_CASE("a task of a cluster knows its shard", "[shards]") {
  const auto is = [](const fuzz::Shard& s, std::uint64_t i, std::uint64_t n) {
    return s.index == i && s.count == n;
  };
  CHECK(is(shard_of("", {}), 0, 1));
  CHECK(is(shard_of("3/8", {}), 3, 8));
  CHECK(is(shard_of("", {{"SLURM_ARRAY_TASK_ID", "2"}, {"SLURM_ARRAY_TASK_COUNT", "4"}}), 2, 4));
  CHECK(is(shard_of("", {{"SLURM_ARRAY_TASK_ID", "7"},
                         {"SLURM_ARRAY_TASK_COUNT", "4"},
                         {"SLURM_ARRAY_TASK_MIN", "1"},
                         {"SLURM_ARRAY_TASK_STEP", "2"}}),
           3, 4));
  CHECK(is(shard_of("", {{"JOB_COMPLETION_INDEX", "1"}, {"JOB_COMPLETIONS", "3"}}), 1, 3));
  // An explicit shard overrides the cluster's variables.
  CHECK(is(shard_of("0/2", {{"SLURM_ARRAY_TASK_ID", "2"}, {"SLURM_ARRAY_TASK_COUNT", "4"}}), 0, 2));
  for (const char* wrong : {"2/2", "1", "a/b", "1/0", "-1/3", "1/3x", "/"})
    CHECK_THROWS_AS(shard_of(wrong, {}), InputError);
  CHECK_THROWS_AS(shard_of("", {{"SLURM_ARRAY_TASK_ID", "2"}}), InputError);
  CHECK_THROWS_AS(shard_of("", {{"JOB_COMPLETION_INDEX", "2"}}), InputError);
  CHECK_THROWS_AS(shard_of("", {{"JOB_COMPLETION_INDEX", "2"}, {"JOB_COMPLETIONS", "2"}}), InputError);
}

TEST_CASE("merged shards are the unsharded campaign, byte for byte but for times", "[shards][merge]") {
  const Workspace w("shards");
  const auto whole = files_of(campaign(w.dir / "whole", 0, 1));
  CHECK(whole.size() > 10);
  std::vector<fs::path> s;
  for (std::uint64_t i = 0; i < 3; ++i) s.push_back(campaign(w.dir / ("shard" + std::to_string(i)), i, 3));
  const auto merge = [&](const char* name, const std::vector<fs::path>& in) {
    return fuzz::merge_campaigns(w.dir / name, in);
  };
  CHECK(merge("a", {s[0], s[1], s[2]}).missing.empty());
  CHECK(files_of(w.dir / "a") == whole);
  merge("b", {s[2], s[0], s[2], s[1], s[0]});
  CHECK(files_of(w.dir / "b") == whole);
  CHECK(merge("part", {s[2], s[0]}).missing == std::vector<std::uint64_t>{1});
  merge("c", {s[1], w.dir / "part", s[0]});
  CHECK(files_of(w.dir / "c") == whole);
  SECTION("a key that names another directory is refused, and nothing is written") {
    const fs::path file = s[0] / "state.json";
    auto j = test::parsed<nlohmann::ordered_json>(read_all(file));
    auto& findings = j["result"]["findings"];
    REQUIRE_FALSE(findings.empty());
    findings["../../victim"] = nlohmann::ordered_json(findings.begin().value());
    std::ofstream(file) << j.dump();
    CHECK_THROWS_WITH(merge("evil", {s[0], s[1], s[2]}), Catch::Contains("state.json"));
    CHECK_FALSE(fs::exists(w.dir / "evil"));
    CHECK_FALSE(fs::exists(w.dir / "victim"));
  }
  SECTION("incompatible parts are refused") {
    merge("other", {s[0], s[1]});
    CHECK_THROWS_AS(merge("d", {w.dir / "part", w.dir / "other"}), InputError);
    CHECK_THROWS_AS(merge("a", {s[0]}), InputError);
    CHECK_THROWS_AS(merge("d", {s[0], campaign(w.dir / "two", 0, 2)}), InputError);
    CHECK_THROWS_AS(merge("d", {w.dir / "nothing"}), InputError);
  }
}

namespace {

int exit_of(const std::string& command, const char* output = " >/dev/null 2>&1") {
  const int status = std::system((command + output).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Merges the shards in `out` and compares them with one whole campaign, both by command line.
void check_shards_are_whole(const std::string& out) {
  const std::string program = TS_BINARY_DIR "/bin/touchstone";
  REQUIRE(exit_of(program + " merge " + out + "/all " + out + "/shard-*") == 0);
  REQUIRE(exit_of(program + " fuzz --cases 200 --seed 3 --engines core,core-f32 --jobs 1 --out " + out +
                  "/whole") == 0);
  CHECK(files_of(out + "/all") == files_of(out + "/whole"));
}

const std::string task_settings =
    "TOUCHSTONE='" TS_BINARY_DIR "/bin/touchstone' CASES=200 SEED=3 ENGINES=core,core-f32 ";

}  // namespace

TEST_CASE("the sbatch script's tasks together equal the campaign of one machine", "[shards][cluster]") {
  const Workspace w("shards");
  const std::string out = w.dir.string();
  for (int task = 5; task < 8; ++task)
    REQUIRE(exit_of("cd '" TS_SOURCE_DIR "' && SLURM_ARRAY_TASK_ID=" + std::to_string(task) +
                    " SLURM_ARRAY_TASK_MIN=5 SLURM_ARRAY_TASK_COUNT=3 SLURM_CPUS_PER_TASK=1 " +
                    task_settings + "OUT='" + out + "' sh fuzz/cluster/campaign.sbatch") == 0);
  check_shards_are_whole(out);
}

TEST_CASE("the same under a single-node Slurm", "[shards][cluster][slurm][optional]") {
  for (const char* daemon : {"slurmctld", "slurmd", "munged", "sbatch"})
    if (exit_of(std::string("PATH=\"$PATH:/usr/sbin\" command -v ") + daemon) != 0)
      return test::skip(std::string(daemon) + " is not installed");
  if (geteuid() != 0) return test::skip("starting a Slurm by hand needs root");
  const Workspace w("shards");
  const std::string out = w.dir.string();
  const std::string cluster = "sh tests/fuzz/single_node_slurm.sh " + out + "/slurm",
                    batch = " sbatch --wait --array=5-7 --cpus-per-task=1 --export=ALL --output=" + out +
                            "/task-%a.log fuzz/cluster/campaign.sbatch";
  REQUIRE(exit_of("cd '" TS_SOURCE_DIR "' && PATH=\"$PATH:/usr/sbin\" OUT='" + out + "' " + task_settings +
                      cluster + batch,
                  " >/dev/null") == 0);
  check_shards_are_whole(out);
}

namespace {

fuzz::KnownCause row(const char* first, const char* last, std::uint64_t count, const char* expired) {
  fuzz::KnownCause k;
  k.id = "e-missed";
  k.title = std::string("as of ") + last;
  k.engine = "e";
  k.key = "e.overlap.missed.box-box.algorithm.solid.gross";
  k.first_seen = first;
  k.last_seen = last;
  k.count = count;
  k.expired = expired;
  k.shown = std::string("case of ") + first;
  k.size.bits = count;
  return k;
}

}  // namespace

TEST_CASE("ledgers merge to the same result in any order and repeatedly", "[shards][merge][ledger]") {
  auto x = row("2026-01-02", "2026-01-05", 7, "2026-01-09"), y = row("2026-01-01", "2026-01-07", 3, ""),
       z = row("2026-01-03", "2026-01-11", 5, "");
  x.severity = fuzz::Severity::missed;
  x.shapes = {"box-box", "box-cone"};
  y.shapes = {"box-box", "box-hull"};
  x.reason = "upstream #1";
  x.until = "2026-03-01";
  y.reason = "upstream #2";
  y.until = "2026-02-01";
  z.shown.clear();  // without a case
  z.engine.clear();
  z.key.clear();
  z.size = {};
  const auto xy = fuzz::merged(x, y);
  CHECK(xy.first_seen == "2026-01-01");
  CHECK(xy.last_seen == "2026-01-07");
  CHECK(xy.title == "as of 2026-01-07");
  CHECK(xy.expired == "2026-01-09");  // the latest status
  CHECK(xy.count == 7);
  CHECK(xy.size.bits == 3);
  CHECK(xy.severity == fuzz::Severity::missed);
  CHECK(xy.shapes == std::vector<std::string>{"box-box", "box-cone", "box-hull"});
  CHECK(xy.reason == "upstream #1");  // it lasts longer
  CHECK(xy == fuzz::merged(y, x));
  CHECK(xy == fuzz::merged(xy, x));
  CHECK(xy == fuzz::merged(xy, xy));
  CHECK(fuzz::merged(xy, z) == fuzz::merged(x, fuzz::merged(z, y)));
  CHECK(fuzz::merged(xy, z).expired.empty());  // seen again since
  CHECK(fuzz::merged(xy, z).shown == y.shown);
  const Workspace w("shards");
  const fs::path a = w.dir / "a.db", b = w.dir / "b.db", sum = w.dir / "sum.db";
  for (const auto& [file, f] : {std::pair{a, x}, {b, y}}) {
    fuzz::Ledger l(file);
    l.put(f);
    l.commit();
  }
  for (const auto& in : {std::vector{a, b}, std::vector{b, a, a}}) {
    CHECK(fuzz::merge_ledgers(sum, in) == 1);
    CHECK(fuzz::Ledger(sum).find(x.id) == xy);
  }
  CHECK_THROWS_AS(fuzz::merge_ledgers(sum, std::vector{w.dir / "none.db"}), InputError);
}

TEST_CASE("triage gives the same result with several jobs as with one", "[shards][triage]") {
  const Workspace w("shards");
  const auto found = test::causes_by_hand(campaign(w.dir / "c", 0, 1)).causes;
  CHECK(found.size() > 2);
  const auto triaged = [&](std::size_t jobs) {
    fuzz::TriageConfig c;
    c.date = "2026-01-01";
    c.build_of = [](const std::string&) { return "b"; };
    // What is shown depends on the case alone.
    c.ask = [](const std::string& engine, const Case& asked) {
      const std::string key = engine + "." + std::string(to_string(asked.queries.at(0).question)) +
                              ".infeasible.box-box.algorithm.solid.gross";
      return std::map<std::string, fuzz::Finding>{{key, fuzz::finding_of_key(engine, key).value()}};
    };
    const std::vector<fuzz::TriageConfig> configs(jobs, c);
    fuzz::Ledger ledger(w.dir / ("ledger" + std::to_string(jobs) + ".db"));
    fuzz::triage(found, ledger, configs);
    const auto r = fuzz::triage({}, ledger, configs);  // asks all of them again
    CHECK(r.size() == found.size());
    std::vector<fuzz::KnownCause> rows;
    for (const auto& t : r) rows.push_back(t.cause);
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    ledger.commit();
    CHECK(ledger.all() == rows);
    return reports::triage_json(r).dump();
  };
  CHECK(triaged(1) == triaged(3));
}
