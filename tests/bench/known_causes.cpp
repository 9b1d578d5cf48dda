// Do causes tell the mechanisms of reported failures apart?
//
//   known_causes [--file known-failures.json] [--jobs 2] [--list]
//
// Each reported case is put to the engines that it was reported for, as far as they are installed, and to a
// lying engine that emulates the reported mechanism where there is one. What is wrong is a campaign in which
// every case is a finding of its own. The score: of two cases of one engine, are those with the same
// mechanism in one cause, and those with two mechanisms in two?
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/causes_of_campaign.h"
#include "cli/engine_catalog.h"
#include "core/base/input_error.h"
#include "fuzz/ask/ask.h"
#include "fuzz/ask/evidence.h"
#include "fuzz/causes/causes.h"
#include "scenarios/random/numbers.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/known_failures.h"

using namespace touchstone;
using Json = nlohmann::json;

namespace {

struct Options {
  std::string file = test::known_failures_file().string();
  int jobs = 2;
  bool list = false;
};

// --- reported failures

struct Reported {
  std::string id, mechanism;
  std::vector<std::string> reported_for;  // engines, in the reporter's words
  Case c;
  std::vector<Question> questions;  // those that the report is about, the most telling first
  bool fails = false;               // no answer: an exception, an assertion, an endless loop
};

// The first question shows the reported fault most directly; the others show it in engines that answer
// differently.
std::vector<Question> questions_of(const std::string& phase) {
  if (phase == "ccd") return {Question::time_of_impact};
  if (phase == "distance") return {Question::distance, Question::overlap};
  if (phase == "narrow-overlap") return {Question::overlap, Question::contact, Question::distance};
  return {Question::contact, Question::distance};
}

Body body_of(const Json& e, const std::string& which, int shape) {
  const Json& pose = e.at("pose_" + which);
  Body b;
  b.name = which;
  b.shape = shape;
  b.pose = {test::vector_of(pose.at("translation")), test::quaternion_of(pose)};
  const std::string end = "pose_" + which + "_end";
  if (e.at("motion").is_object()) b.motion = test::motion_between(pose, e.at("motion").at(end));
  return b;
}

Case case_of(const Json& e, const std::vector<Question>& questions) {
  Case c;
  c.id = e.at("id");
  c.family = "known-failure";
  c.scene.name = c.id;
  c.scene.shapes = {test::shape_of(e.at("shape_a")), test::shape_of(e.at("shape_b"))};
  c.scene.bodies = {body_of(e, "a", 0), body_of(e, "b", 1)};
  for (const Question q : questions) c.queries.push_back({q, 0, 1});
  fuzz::renew(c);
  validate(c.scene);
  return c;
}

// "as above" and "as #429" refer to an earlier entry.
std::string mechanism_of(const std::string& words, const std::string& above,
                         const std::vector<Reported>& earlier) {
  if (words == "as above") return above;
  constexpr std::string_view reference = "as #";
  if (!words.starts_with(reference)) return words;
  for (const Reported& r : earlier)
    if (r.id.find("-" + words.substr(reference.size()) + "-") != std::string::npos) return r.mechanism;
  return words;
}

bool is_failure(const Json& seen) {
  if (!seen.is_string()) return false;
  const std::string words = seen;
  for (const char* word :
       {"throw", "threw", "assert", "abort", "crash", "loop", "hang", "recursion", "FailedAt"})
    if (words.find(word) != std::string::npos) return true;
  return false;
}

std::vector<Reported> reported_failures(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file, "cannot be opened");
  std::vector<Reported> all;
  std::string above;
  for (const Json& e : Json::parse(in)) {
    Reported r;
    r.id = e.at("id");
    above = r.mechanism = mechanism_of(e.at("mechanism"), above, all);
    if (!test::has_shapes(e)) continue;
    r.reported_for = e.at("engines_affected").get<std::vector<std::string>>();
    r.questions = questions_of(e.at("phase"));
    r.fails = is_failure(e.at("wrong_answer_seen"));
    r.c = case_of(e, r.questions);
    all.push_back(std::move(r));
  }
  return all;
}

// --- who is asked

// Engines of the catalogue for the words of a report, the first row that fits.
struct EngineRow {
  std::string_view words;
  std::vector<std::string> engines;
};
const std::vector<EngineRow> engine_rows{
    {"CONSERVATIVE_ADVANCEMENT", {"fcl-libccd-tuned"}},
    {"fcl",
     {"fcl-libccd"}},  // its default solver; GST_INDEP fails at an assertion of its own, whatever the report
    {"libccd 2.1 MPR", {"libccd-mpr"}},
    {"libccd", {"libccd-gjk"}},
    {"bullet", {"bullet-f32-query", "bullet-f64-query"}},
    {"Bullet", {"bullet-f32-query", "bullet-f64-query"}},
    {"Jolt", {"jolt"}},
    {"parry", {"rapier"}},
    {"rapier", {"rapier"}},
    {"all",
     {"fcl-libccd", "fcl-indep", "fcl-libccd-tuned", "bullet-f32-query", "bullet-f64-query", "jolt",
      "rapier"}}};

// Lying engines (tests/mutants) that do what the report says went wrong, in the engine of that name.
struct EmulationRow {
  std::string_view mechanism;  // its beginning
  std::string_view engine, lie;
};
constexpr EmulationRow emulation_rows[] = {
    {"sphere-box branch for centre inside the box", "mujoco", "depth_within_smaller"},
    {"overlap of 7.1e-8 of the scale: float rounding", "mujoco", "overlap_in_float"},
    {"float32 cancellation in support differences", "mujoco", "distance_cancels"},
    {"relative tilt 1e-8..1e-6 rad", "mujoco", "parallel_normal_long"},
    {"nearly parallel edges", "mujoco", "parallel_origins"},
    {"zero initial direction: centres coincide exactly", "physx", "overlap_concentric_denied"},
    {"argument order asymmetry", "parry", "overlap_one_order_denied"},
    {"step size bound scales with speed", "parry", "impact_fast_lost"},
    {"GJK ray cast: upper bound stagnates", "parry", "impact_early"},
    {"early out at t=0", "jolt", "impact_start_denied"},
    {"closed or open interval at t=1", "any", "impact_end_denied"}};

bool is_here(const std::string& engine) {
  if (!cli::is_catalogued(engine)) return false;
  try {
    cli::engine_names(engine);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::set<std::string> engines_for(const Reported& r) {
  std::set<std::string> all;
  for (const std::string& words : r.reported_for)
    for (const EngineRow& row : engine_rows)
      if (words.find(row.words) != std::string::npos) {
        for (const std::string& engine : row.engines)
          if (is_here(engine)) all.insert(engine);
        break;
      }
  return all;
}

const EmulationRow* emulation_of(const Reported& r) {
  for (const EmulationRow& row : emulation_rows)
    if (r.mechanism.starts_with(row.mechanism)) return &row;
  return nullptr;
}

EnginePtr make(const std::string& name) try {
  for (const mutants::Mutant& m : mutants::mutants())
    if (m.name == name) return mutants::make_lying_engine(m);
  WorkerLimits limits;
  limits.query_cpu_seconds = 0.1;  // hanging engines are asked often; see cli/causes_of_campaign.cpp
  return cli::make_engine(name, limits);
} catch (const InputError&) {
  return nullptr;
}

// --- what they answer

// A case, and an engine that it shows to be wrong in the way that the report is about.
struct Shown {
  const Reported* of = nullptr;
  std::string path;  // of the engine
  std::string key;
};

struct Asked {
  fuzz::CampaignResult result;
  std::vector<Shown> shown;
  std::set<std::string> not_shown;  // cases that no engine they were reported for gets wrong
  std::set<std::string> not_asked;  // whose engines are not here
  std::size_t emulated = 0;
};

fuzz::EngineKnowledge knowledge() {
  fuzz::EngineKnowledge k = cli::catalogued_knowledge();
  k.path_of = [of_catalogue = k.path_of](const std::string& engine) {
    for (const EmulationRow& row : emulation_rows)
      if (engine == row.lie) return "emulated-" + std::string(row.engine);
    return of_catalogue(engine);
  };
  return k;
}

// The gravest finding about the question; if asked for, only of failures to answer.
const fuzz::Finding* worst_of(const fuzz::CampaignResult& r, Question q, bool failures_only) {
  const fuzz::Finding* worst = nullptr;
  for (const auto& [key, f] : r.findings) {
    if (f.question != to_string(q)) continue;
    if (failures_only && fuzz::symptom_of(f).stage != fuzz::FaultStage::failure) continue;
    if (!worst || fuzz::severity_of(f) < fuzz::severity_of(*worst)) worst = &f;
  }
  return worst;
}

// The finding that the report is about: of a report that there is no answer, a failure to answer, else the
// gravest; about the most telling question that the engine answers wrongly.
std::optional<fuzz::Finding> finding_of(const Reported& r, std::size_t index, const EnginePtr& engine) {
  const auto answers = engine->run({&r.c, 1});
  fuzz::CampaignResult alone;
  fuzz::judge_into(alone, r.c, index, {&engine, 1}, answers);
  for (const Question q : r.questions)
    if (const fuzz::Finding* worst = worst_of(alone, q, r.fails)) return *worst;
  return std::nullopt;
}

Asked ask_all(const std::vector<Reported>& all) {
  Asked asked;
  const fuzz::EngineKnowledge known = knowledge();
  std::map<std::string, EnginePtr> engines;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Reported& r = all[i];
    std::set<std::string> names = engines_for(r);
    const EmulationRow* emulation = names.empty() ? emulation_of(r) : nullptr;
    if (emulation) names.insert(std::string(emulation->lie));
    if (names.empty()) asked.not_asked.insert(r.id);
    bool any = false;
    for (const std::string& name : names) {
      const auto [at, added] = engines.try_emplace(name);
      if (added) at->second = make(name);
      if (!at->second) continue;
      auto f = finding_of(r, i, at->second);
      if (!f) continue;
      any = true;
      f->degeneracy = fmt::format("case{}", i);  // every case is a finding of its own
      asked.shown.push_back({&r, known.path_of(name), f->key()});
      asked.result.findings.emplace(f->key(), *std::move(f));
    }
    if (!any && !names.empty()) asked.not_shown.insert(r.id);
    asked.emulated += any && emulation;
  }
  asked.result.cases = all.size();
  fuzz::write_evidence(asked.result);
  return asked;
}

// --- the score

struct Score {
  std::size_t pairs = 0, right = 0;
  std::vector<std::string> wrong;
  std::string text() const {
    return fmt::format("{} of {} pairs ({:.1f} %)", right, pairs,
                       pairs > 0 ? 100 * static_cast<double>(right) / static_cast<double>(pairs) : 0);
  }
};

using CauseOfKey = std::map<std::string, const fuzz::Cause*>;

std::string told(const Shown& s, const CauseOfKey& causes) {
  const fuzz::Cause& c = *causes.at(s.key);
  return fmt::format("    {} ({})\n        {}: {}\n", s.of->id, s.key, c.id, c.title);
}

void compare(const Shown& x, const Shown& y, const CauseOfKey& causes, Score& same, Score& different) {
  const bool one_mechanism = x.of->mechanism == y.of->mechanism;
  const bool one_cause = causes.at(x.key) == causes.at(y.key);
  Score& score = one_mechanism ? same : different;
  ++score.pairs;
  if (one_mechanism == one_cause)
    ++score.right;
  else
    score.wrong.push_back(told(x, causes) + told(y, causes));
}

void print_wrong(const Score& s, std::string_view what) {
  for (const std::string& pair : s.wrong) fmt::print("  {}\n{}", what, pair);
}

void print_score(const std::vector<Reported>& all, const Asked& asked, const fuzz::Causes& causes,
                 bool list) {
  CauseOfKey of_key;
  for (const fuzz::Cause& c : causes.causes)
    for (const std::string& key : c.keys) of_key[key] = &c;
  std::set<std::string> cases, mechanisms;
  for (const Shown& s : asked.shown) {
    cases.insert(s.of->id);
    mechanisms.insert(s.of->mechanism);
  }
  Score same, different;
  for (std::size_t i = 0; i < asked.shown.size(); ++i)
    for (std::size_t k = i + 1; k < asked.shown.size(); ++k) {
      const Shown &x = asked.shown[i], &y = asked.shown[k];
      if (x.of != y.of && x.path == y.path) compare(x, y, of_key, same, different);
    }
  fmt::print("{} reported cases with shapes: {} shown by {} engines ({} of them by an emulation), {} not reproduced, "
             "{} not asked\n",
             all.size(), cases.size(), asked.result.findings.empty() ? 0 : [&] {
               std::set<std::string> engines;
               for (const auto& [key, f] : asked.result.findings) engines.insert(f.engine);
               return engines.size();
             }(),
             asked.emulated, asked.not_shown.size(), asked.not_asked.size());
  fmt::print("{} answers, {} mechanisms, {} causes\n", asked.shown.size(), mechanisms.size(),
             causes.causes.size());
  fmt::print("one mechanism and engine, in one cause: {}\n", same.text());
  fmt::print("two mechanisms of one engine, in two causes: {}\n", different.text());
  print_wrong(same, "one mechanism, two causes:");
  print_wrong(different, "two mechanisms, one cause:");
  if (!list) return;
  for (const Shown& s : asked.shown) fmt::print("{}", told(s, of_key));
  for (const std::string& id : asked.not_shown) fmt::print("not reproduced: {}\n", id);
  for (const std::string& id : asked.not_asked) fmt::print("not asked: {}\n", id);
}

int run(const Options& o) {
  const std::vector<Reported> all = reported_failures(o.file);
  const Asked asked = ask_all(all);
  fuzz::CausesConfig config;
  config.knowledge = knowledge();
  config.make = make;
  config.jobs = o.jobs;
  config.representatives = asked.result.findings.size();
  print_score(all, asked, fuzz::causes_of(asked.result, config), o.list);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app{"Whether causes tell the mechanisms of reported failures apart"};
  app.add_option("--file", o.file, "the collection of known failures")->capture_default_str();
  app.add_option("--jobs", o.jobs, "number of parallel jobs")->capture_default_str();
  app.add_flag("--list", o.list, "print every answer with its cause, and the cases left out");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(o);
  } catch (const InputError& e) {
    fmt::print(stderr, "known_causes: {}\n", e.what());
    return 2;
  }
}
