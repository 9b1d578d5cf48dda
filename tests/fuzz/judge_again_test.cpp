// Kept answers: the file, and campaigns that are judged again from it.
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/base/input_error.h"
#include "fuzz/campaign/answers_file.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/judge_again.h"
#include "fuzz/campaign/shard.h"
#include "fuzz/campaign/store.h"
#include "oracles/core/core_engine.h"
#include "reports/record/changes.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/stops_after.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using touchstone::test::read_all;
using touchstone::test::Workspace;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

const std::atomic<bool> go{false};

// The core, whose distances change when it is asked again, and which crashes with last words of its own.
class Unsteady final : public Engine {
 public:
  Unsteady() : card_(core_.card()) { card_.name = "unsteady"; }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override { return answers(cases, 7); }
  std::vector<CaseObservations> run_again(std::span<const Case> cases) override { return answers(cases, 9); }

 private:
  std::vector<CaseObservations> answers(std::span<const Case> cases, double distance) {
    auto all = core_.run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (std::size_t k = 0; k < cases[i].queries.size(); ++k) {
        Observation& o = all[i].answers[k];
        const bool is_box = kind_of(cases[i].scene.shapes[0]) == ShapeKind::box;
        if (cases[i].queries[k].question == Question::distance && o.distance && is_box) o.distance = distance;
        if (cases[i].queries[k].question == Question::overlap && is_box)
          o = no_answer(Outcome::crashed, "SIGSEGV at " + std::to_string(++died_), "a.cpp:1");
      }
    return all;
  }
  CoreEngine core_;
  EngineCard card_;
  int died_ = 0;
};

// Engines with every kind of finding: wrong answers, broken relations, unstable answers, crashes.
std::vector<EnginePtr> engines() {
  std::vector<EnginePtr> e;
  e.push_back(std::make_unique<CoreEngine>());
  for (const auto& m : mutants::mutants())
    if (m.name == "depth_halved" || m.name == "errs_when_large") e.push_back(mutants::make_lying_engine(m));
  e.push_back(std::make_unique<Unsteady>());
  return e;
}

fuzz::CampaignConfig config_of(const fs::path& out, std::uint64_t cases = 192) {
  fuzz::CampaignConfig c;
  c.engines = {"core", "depth_halved", "errs_when_large", "unsteady"};
  c.cases = cases;
  c.seed = 5;
  c.relations_every = 8;
  c.keep_answers = true;
  c.out = out;
  return c;
}

// Every file of the findings, and the digest.
std::map<std::string, std::string> findings_in(const fs::path& campaign) {
  std::map<std::string, std::string> r;
  for (const auto& e : fs::recursive_directory_iterator(campaign / "findings"))
    if (e.is_regular_file()) r[fs::relative(e.path(), campaign).string()] = read_all(e.path());
  r["summary"] = read_all(campaign / "summary.json");
  return r;
}

std::string reason_of(const fs::path& campaign) {
  try {
    fuzz::judge_again(campaign, "", 1, go);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

Body body_at(int shape, const Vec3& t) {
  Body b;
  b.shape = shape;
  b.pose.translation = t;
  return b;
}

// A batch with every field that can be kept.
fuzz::KeptBatch batch_of_everything() {
  fuzz::KeptBatch b;
  b.first_index = 96;
  Case c;
  c.id = "id";
  c.family = "family";
  c.scene.name = "name";
  c.scene.shapes = {Sphere{1}, make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})};
  c.scene.bodies = {body_at(0, {-0.0, 1e-300, 0.1}), body_at(1, {1, 2, 3})};
  c.scene.bodies[0].name = "body";
  c.scene.bodies[1].motion = Motion{{1, 0, 0}, {0, 0.1, 0}};
  c.queries = {{Question::overlap, 0, 1}, {Question::scene_contacts, -1, -1}};
  Observation full, crashed = no_answer(Outcome::crashed, "", "a.cpp:7"),
                    set_aside = no_answer(Outcome::not_asked, "");
  full.outcome = Outcome::answered;
  full.overlap = true;
  full.distance = -0.0;
  full.witness = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
  full.normal = Vec3(0, 0, 1);
  full.depth = 0.1;
  full.manifold = {{Vec3(1, 2, 3), 0.5}};
  full.toi = 0.25;
  full.candidate_pairs = {{{0, 1}}, {}};
  full.contacts = {{0, 1, Vec3(0, 0, 1), 0.1}};
  full.claimed_tolerance = 1e-6;
  CaseObservations held{{}, {full, crashed}};
  held.received.bodies = {Placement{}, std::nullopt};
  held.received.shapes = {std::nullopt, c.scene.shapes[1]};
  b.cases = {c};
  b.engines.resize(2);
  b.engines[0].cases = {held};
  b.engines[0].later = {{false, true, 1, held}, {true, true, 2, held}, {true, false, 3, {}}};
  b.engines[1].cases = {{{}, {set_aside, set_aside}}};
  return b;
}

}  // namespace

TEST_CASE("a campaign that keeps its answers is judged again to the same findings, byte for byte",
          "[judge-again]") {
  const Workspace w("judge-again");
  auto config = config_of(w.dir / "run");
  config.jobs = 2;
  const auto result = fuzz::run_campaign(config, engines, {}, go);
  std::set<std::string> faults;
  for (const auto& [key, f] : result.findings) faults.insert(f.fault.substr(0, f.fault.find('_')));
  CHECK(faults.contains("unstable"));
  CHECK(faults.contains("crashed"));
  CHECK(faults.contains("relation"));
  CHECK(result.findings.size() > 10);
  const auto judged = fuzz::judge_again(w.dir / "run", "", 3, go);
  CHECK(fuzz::digest(judged.after) == fuzz::digest(result));
  CHECK(fuzz::to_json(judged.after, true).dump() == fuzz::to_json(judged.before, true).dump());
  CHECK(fuzz::changes_between(judged.before, judged.after).none);
  CHECK(judged.not_kept_derived == 0);
  CHECK(judged.not_kept_again == 0);
  fuzz::save_judged_again(w.dir / "again", judged);
  CHECK(findings_in(w.dir / "again") == findings_in(w.dir / "run"));
  CHECK_THROWS_AS(fuzz::save_judged_again(w.dir / "again", judged), InputError);
}

TEST_CASE("one engine is judged again alone, with the findings that it has among all", "[judge-again]") {
  const Workspace w("judge-again");
  const auto result = fuzz::run_campaign(config_of(w.dir), engines, {}, go);
  const auto judged = fuzz::judge_again(w.dir, "unsteady", 1, go);
  REQUIRE(judged.after.tallies.size() == 1);
  CHECK(judged.after.wrong_of("unsteady") == result.wrong_of("unsteady"));
  CHECK(judged.after.failed_of("unsteady") > 0);
  CHECK(fuzz::changes_between(judged.before, judged.after).none);
  for (const auto& [key, f] : judged.after.findings) CHECK(f.engine == "unsteady");
  CHECK_THROWS_AS(fuzz::judge_again(w.dir, "fcl", 1, go), InputError);
}

TEST_CASE("kept answers are the same bytes for any number of jobs, after a stop, and merged from shards",
          "[judge-again]") {
  const Workspace w("judge-again");
  fuzz::run_campaign(config_of(w.dir / "one"), engines, {}, go);
  const std::string whole = read_all(w.dir / "one/answers.bin");
  REQUIRE(whole.size() > 10'000);
  auto three = config_of(w.dir / "three");
  three.jobs = 3;
  fuzz::run_campaign(three, engines, {}, go);
  CHECK(read_all(w.dir / "three/answers.bin") == whole);

  const auto stopped = config_of(w.dir / "stopped");
  std::atomic<bool> stop{false};
  const auto stopping = [&] {
    auto all = engines();
    all[0] = std::make_unique<test::StopsAfter>(7, stop);  // in the second of six chunks
    return all;
  };
  fuzz::run_campaign(stopped, stopping, {}, stop);
  const auto state = test::parsed<nlohmann::json>(read_all(w.dir / "stopped/state.json"));
  CHECK_FALSE(state.at("finished").get<bool>());
  // Killed while it wrote a block whose end the state does not know.
  write(w.dir / "stopped/answers.bin", read_all(w.dir / "stopped/answers.bin") + "half a block");
  CHECK(fuzz::changes_between(fuzz::judge_again(w.dir / "stopped", "", 1, go).before,
                              fuzz::judge_again(w.dir / "stopped", "", 1, go).after)
            .none);
  fuzz::run_campaign(stopped, engines, {}, go);
  CHECK(read_all(w.dir / "stopped/answers.bin") == whole);

  std::vector<fs::path> shards;
  for (std::uint64_t i = 0; i < 3; ++i) {
    auto c = config_of(w.dir / ("shard" + std::to_string(i)));
    c.shard = i;
    c.shards = 3;
    fuzz::run_campaign(c, engines, {}, go);
    shards.push_back(c.out);
  }
  const std::vector<fs::path> two = {shards[2], shards[0]}, rest = {shards[1], w.dir / "two"};
  fuzz::merge_campaigns(w.dir / "two", two);
  CHECK(fuzz::changes_between(fuzz::judge_again(w.dir / "two", "", 1, go).before,
                              fuzz::judge_again(w.dir / "two", "", 1, go).after)
            .none);
  fuzz::merge_campaigns(w.dir / "merged", rest);
  CHECK(read_all(w.dir / "merged/answers.bin") == whole);
}

TEST_CASE("judging again names what changed against the stored result", "[judge-again]") {
  const Workspace w("judge-again");
  fuzz::run_campaign(config_of(w.dir, 64), engines, {}, go);
  auto state = test::parsed<nlohmann::ordered_json>(read_all(w.dir / "state.json"));
  auto& stored = state["result"];
  // As if an older version had not known one finding, had counted another twice, and had reported a third.
  auto& findings = stored["findings"];
  REQUIRE(findings.size() > 3);
  const std::string unknown = findings.begin().key();
  auto other = std::next(findings.begin());
  const std::string twice = other.key();
  findings[twice]["count"] = 2 * findings[twice]["count"].get<int>();
  auto third = findings[std::next(other).key()];
  third["fault"] = "ghost";
  third["shapes"] = "ball-cube";
  std::string gone;
  for (const char* part : {"engine", "question", "fault", "shapes", "blame", "degeneracy", "magnitude"})
    gone += (gone.empty() ? "" : ".") + third[part].get<std::string>();
  findings[gone] = third;
  findings.erase(unknown);
  stored["engines"]["depth_halved"]["contact"]["wrong"] = 0;
  write(w.dir / "state.json", state.dump());
  const auto judged = fuzz::judge_again(w.dir, "", 1, go);
  const fuzz::ResultChanges c = fuzz::changes_between(judged.before, judged.after);
  CHECK_FALSE(c.none);
  CHECK(c.appeared == std::vector{unknown});
  CHECK(c.gone == std::vector{gone});
  REQUIRE(c.changed.size() == 1);
  CHECK(c.changed[0].key == twice);
  CHECK(c.changed[0].count_before == 2 * c.changed[0].count_after);
  REQUIRE(c.counts.size() == 1);
  CHECK(c.counts[0].subject == "contact");
  CHECK(c.counts[0].count == "wrong");
  CHECK(c.counts[0].before == 0);
  CHECK(c.counts[0].after > 0);
}

TEST_CASE("a batch of answers reads back as it was written", "[judge-again]") {
  const fuzz::KeptBatch b = batch_of_everything();
  const std::string bytes = fuzz::to_bytes(b);
  const fuzz::KeptBatch back = fuzz::batch_from_bytes(bytes, 1, 2, "batch");
  CHECK(back.cases == b.cases);
  CHECK(fuzz::to_bytes(back) == bytes);
  REQUIRE(back.engines[0].later.size() == 3);
  CHECK(back.engines[0].cases[0].answers == b.engines[0].cases[0].answers);
  CHECK(back.engines[0].cases[0].received == b.engines[0].cases[0].received);
  CHECK_FALSE(back.engines[0].later[2].supported);
  CHECK(back.engines[1].cases[0].answers[0].outcome == Outcome::not_asked);
  CHECK(std::signbit(*back.engines[0].cases[0].answers[0].distance));
  for (std::size_t n = 0; n < bytes.size(); ++n)
    CHECK_THROWS_AS(fuzz::batch_from_bytes(bytes.substr(0, n), 1, 2, "batch"), InputError);
  CHECK_THROWS_AS(fuzz::batch_from_bytes(bytes, 1, 3, "batch"), InputError);
}

TEST_CASE("a case of every family reads back as it was drawn", "[judge-again]") {
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case c = fuzz::make_case(11, i);
    fuzz::KeptBatch b;
    b.cases = {c};
    const fuzz::KeptBatch back = fuzz::batch_from_bytes(fuzz::to_bytes(b), 1, 0, "batch");
    // NaN differs from itself.
    CHECK(hash(back.cases[0].scene) == hash(c.scene));
    CHECK(back.cases[0].queries == c.queries);
    CHECK(back.cases[0].id == c.id);
    CHECK(back.cases[0].family == c.family);
  }
}

TEST_CASE("what was not asked then is not judged, and counted", "[judge-again]") {
  const fuzz::KeptBatch b = batch_of_everything();
  EngineCard card;
  card.name = "e";
  fuzz::KeptEngine engine(card, b.engines[0]);
  CHECK(engine.run(b.cases)[0].answers == b.engines[0].cases[0].answers);
  const auto later = engine.run(b.cases);
  REQUIRE(later[0].answers.size() == 2);
  CHECK(later[0].answers[0].outcome == Outcome::not_asked);
  CHECK(engine.missing_derived() == 1);
  CHECK(engine.run_again(b.cases).empty());
  CHECK(engine.missing_again() == 1);
}

TEST_CASE("a damaged file of answers is refused with file, byte and reason", "[judge-again]") {
  const Workspace w("judge-again");
  fuzz::run_campaign(config_of(w.dir, 64), engines, {}, go);
  const fs::path file = w.dir / "answers.bin";
  const std::string good = read_all(file);
  const auto damaged = [&](std::size_t at, const std::string& with) {
    std::string bytes = good;
    bytes.replace(at, with.size(), with);
    write(file, bytes);
    const std::string why = reason_of(w.dir);
    INFO(why);
    CHECK(why.starts_with(file.string()));
    return why;
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(damaged(0, "X"), "byte 0: is not a file of kept answers"));
  CHECK(has(damaged(8, "\xff\xff\xff\x7f"), "too long a header"));
  CHECK(has(damaged(20, "X"), "checksum differs"));
  const std::size_t header =
      16 + static_cast<unsigned char>(good[8]) + 256u * static_cast<unsigned char>(good[9]);
  CHECK(has(damaged(header, "X"), "is not the start of a block"));
  CHECK(has(damaged(header + 16, "\xff\xff\xff\xff"), "impossible cases"));
  CHECK(has(damaged(header + 20, "\xff\xff\xff\xff"), "bytes of contents"));
  CHECK(has(damaged(header + 24, "\xff\xff\xff\x7f"), "ends inside of a block"));
  CHECK(has(damaged(header + 100, "XYZ"), "checksum differs"));
  write(file, good.substr(0, good.size() - 1));
  CHECK(has(reason_of(w.dir), "truncated"));
  fs::remove(file);
  CHECK(has(reason_of(w.dir), "no such file"));
  // A resumed campaign refuses it too.
  auto state = test::parsed<nlohmann::ordered_json>(read_all(w.dir / "state.json"));
  state["finished"] = false;
  write(w.dir / "state.json", state.dump());
  CHECK_THROWS_AS(fuzz::run_campaign(config_of(w.dir, 64), engines, {}, go), InputError);
  write(file, good);
  // So are engines that describe themselves differently now.
  const auto others = [] {
    auto all = engines();
    std::swap(all[0], all[1]);
    return all;
  };
  CHECK_THROWS_AS(fuzz::run_campaign(config_of(w.dir, 64), others, {}, go), InputError);
  CHECK(read_all(file) == good);
  CHECK_NOTHROW(fuzz::run_campaign(config_of(w.dir, 64), engines, {}, go));
  CHECK(reason_of(w.dir).empty());
  state = test::parsed<nlohmann::ordered_json>(read_all(w.dir / "state.json"));
  state["result"]["cases"] = 65;
  write(w.dir / "state.json", state.dump());
  CHECK(has(reason_of(w.dir), "holds the answers to 64 cases, but the campaign has judged 65"));
  state["settings"].erase("keep_answers");
  write(w.dir / "state.json", state.dump());
  CHECK(has(reason_of(w.dir), "keeps no answers"));
}
