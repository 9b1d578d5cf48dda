// The examples of a campaign's findings: those of all cases that showed them, with their cases, and read back
// from its directory.
#include <atomic>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/shard.h"
#include "fuzz/campaign/store.h"
#include "oracles/core/core_engine.h"
#include "reports/record/stored.h"
#include "scenarios/random/family.h"
#include "scenarios/random/numbers.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/stops_after.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using touchstone::test::Workspace;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t seed_of_examples = 5;
const std::atomic<bool> not_stopped{false};

// Wrong answers, and broken relations.
std::vector<EnginePtr> liars_with_examples() {
  std::vector<EnginePtr> e;
  e.push_back(std::make_unique<CoreEngine>());
  for (const auto& m : mutants::mutants())
    if (m.name == "depth_halved" || m.name == "overlap_always") e.push_back(mutants::make_lying_engine(m));
  return e;
}

fuzz::CampaignConfig config_in(const fs::path& out, std::uint64_t cases) {
  fuzz::CampaignConfig c;
  c.engines = {"core", "depth_halved", "overlap_always"};
  c.cases = cases;
  c.seed = seed_of_examples;
  c.relations_every = 8;
  c.out = out;
  return c;
}

std::string examples_of(const fuzz::CampaignResult& r) {
  std::string text;
  for (const auto& [key, f] : r.findings) {
    text += key + "\n";
    for (const fuzz::Example& e : f.examples) text += "  " + fuzz::to_json(e).dump() + " " + e.c->id + "\n";
  }
  return text;
}

nlohmann::ordered_json state_in(const fs::path& campaign) {
  return test::parsed<nlohmann::ordered_json>(test::read_all(campaign / "state.json"));
}

}  // namespace

TEST_CASE("a campaign keeps the examples of all its cases, for any number of jobs", "[examples]") {
  constexpr std::uint64_t cases = 480;
  fuzz::CampaignConfig config = config_in("", cases);
  const auto one = fuzz::run_campaign(config, liars_with_examples, {}, not_stopped);
  config.jobs = 3;
  const auto three = fuzz::run_campaign(config, liars_with_examples, {}, not_stopped);
  CHECK(examples_of(one) == examples_of(three));
  CHECK(fuzz::digest(one) == fuzz::digest(three));

  // Every case by itself.
  std::map<std::string, std::vector<fuzz::Example>> shown;
  std::map<std::uint64_t, std::set<std::string>> opened;
  const auto engines = liars_with_examples();
  for (std::uint64_t i = 0; i < cases; ++i) {
    fuzz::CampaignResult alone;
    const Case c = fuzz::make_case(seed_of_examples, i);
    fuzz::ask_and_judge(alone, {&c, 1}, i, engines, config.relations_every);
    for (const auto& [key, f] : alone.findings) {
      REQUIRE(f.examples.size() == 1);
      CHECK(f.examples[0].size == fuzz::measure(c));
      CHECK(f.examples[0].error_in_l == f.worst_in_l);
      shown[key].push_back(f.examples[0]);
      opened[i].insert(key);
    }
  }
  REQUIRE(shown.size() == one.findings.size());
  bool any_full = false, any_relation = false;
  for (const auto& [key, f] : one.findings) {
    INFO(key);
    const auto expected = fuzz::kept_examples(shown[key], key);
    REQUIRE(f.examples.size() == expected.size());
    CHECK(f.examples.front().index == f.first_index);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      CHECK(fuzz::to_json(f.examples[i]) == fuzz::to_json(expected[i]));
      CHECK(*f.examples[i].c == *expected[i].c);
    }
    any_full |= shown[key].size() > fuzz::most_examples && f.examples.size() > fuzz::sampled_examples;
    any_relation |= f.fault.starts_with("relation") && f.examples.size() > 1;
  }
  CHECK(any_full);
  CHECK(any_relation);

  const auto keys = fuzz::keys_by_case(one);
  bool any_several = false;
  for (const auto& [index, of_case] : keys) {
    CHECK(std::is_sorted(of_case.begin(), of_case.end()));
    for (const std::string& key : of_case) CHECK(opened.at(index).contains(key));
    any_several |= of_case.size() > 1;
  }
  CHECK(any_several);
}

TEST_CASE("examples come back from a campaign's directory with their cases", "[examples]") {
  const Workspace w("examples");
  auto config = config_in(w.dir / "run", 320);
  config.jobs = 2;
  std::atomic<bool> stop{false};
  const auto stopping = [&] {
    auto all = liars_with_examples();
    all[0] = std::make_unique<test::StopsAfter>(12, stop);
    return all;
  };
  const auto part = fuzz::run_campaign(config, stopping, {}, stop);
  REQUIRE(part.cases < 320);
  CHECK(examples_of(fuzz::load_result(config.out)) == examples_of(part));  // of an unfinished one
  const auto whole = fuzz::run_campaign(config, liars_with_examples, {}, not_stopped);
  const auto back = fuzz::load_result(config.out);
  CHECK(examples_of(back) == examples_of(whole));
  CHECK(fuzz::digest(back) == fuzz::digest(whole));
  CHECK(fuzz::digest(back) ==
        fuzz::digest(fuzz::run_campaign(config_in("", 320), liars_with_examples, {}, not_stopped)));
  for (const auto& [key, f] : back.findings)
    for (const fuzz::Example& e : f.examples) {
      INFO(key << " " << e.index);
      // NaN differs from itself.
      const Case drawn = fuzz::make_case(seed_of_examples, e.index);
      CHECK(hash(e.c->scene) == hash(drawn.scene));
      CHECK(e.c->queries == drawn.queries);
      CHECK(fuzz::measure(*e.c) == e.size);
    }

  const auto settings = fuzz::load_settings(config.out);
  CHECK(settings.at("seed") == seed_of_examples);
  CHECK(settings.at("family") == "");
  CHECK(settings.at("engines") == config.engines);

  const auto& [key, f] = *back.findings.begin();
  const auto stored =
      test::parsed<nlohmann::ordered_json>(test::read_all(config.out / "findings" / key / "finding.json"));
  REQUIRE(stored.at("examples").size() == f.examples.size());
  CHECK(stored.at("examples")[0] == fuzz::to_json(f.examples[0]));
}

TEST_CASE("a result without examples, of an earlier version, is read and merged", "[examples]") {
  const Workspace w("examples");
  for (std::uint64_t shard = 0; shard < 2; ++shard) {
    auto c = config_in(w.dir / std::to_string(shard), 128);
    c.shards = 2;
    c.shard = shard;
    fuzz::run_campaign(c, liars_with_examples, {}, not_stopped);
  }
  auto old = state_in(w.dir / "0");
  for (auto& [key, f] : old["result"]["findings"].items()) f.erase("examples");
  std::ofstream(w.dir / "0/state.json") << old.dump();
  for (const auto& [key, f] : fuzz::load_result(w.dir / "0").findings) CHECK(f.examples.empty());
  const std::vector<fs::path> in = {w.dir / "0", w.dir / "1"};
  const auto merged = fuzz::merge_campaigns(w.dir / "all", in).result;
  const auto other = fuzz::load_result(w.dir / "1");
  CHECK(merged.findings.size() > other.findings.size());
  CHECK(fuzz::keys_by_case(merged) == fuzz::keys_by_case(other));
  CHECK(examples_of(fuzz::load_result(w.dir / "all")) == examples_of(merged));
}

TEST_CASE("a directory without a campaign, or with damaged settings, is refused with its name",
          "[examples]") {
  const Workspace w("examples");
  CHECK_THROWS_WITH(fuzz::load_result(w.dir), Catch::Contains(w.dir.string()) && Catch::Contains("campaign"));
  CHECK_THROWS_AS(fuzz::load_settings(w.dir), InputError);
  const std::pair<const char*, const char*> damaged[] = {
      {R"({"settings": {"seed": -1, "family": "", "engines": []}})", "settings.seed"},
      {R"({"settings": {"seed": 1, "family": 2, "engines": []}})", "settings.family"},
      {R"({"settings": {"seed": 1, "family": "", "engines": ["core", 7]}})", "settings.engines[1]"},
      {R"({"settings": []})", "settings"}};
  for (const auto& [text, place] : damaged) {
    std::ofstream(w.dir / "state.json") << text;
    CHECK_THROWS_WITH(fuzz::load_settings(w.dir), Catch::Contains("state.json") && Catch::Contains(place));
    CHECK_THROWS_WITH(fuzz::load_result(w.dir), Catch::Contains("state.json"));
  }
}
