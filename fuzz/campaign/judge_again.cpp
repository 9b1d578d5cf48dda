#include "fuzz/campaign/judge_again.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

#include "core/base/input_error.h"
#include "fuzz/ask/ask.h"
#include "fuzz/ask/evidence.h"
#include "fuzz/campaign/answers_file.h"
#include "fuzz/campaign/directory_lock.h"
#include "fuzz/campaign/store.h"
#include "oracles/client/worker_limits.h"
#include "reports/record/stored.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {
namespace {

// Runs `work` on 0..n-1 in several threads. The first exception ends all and is thrown again.
template <class Work>
void in_parallel(std::size_t n, int jobs, const std::atomic<bool>& stop, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  const auto run = [&] {
    try {
      for (std::size_t i = next++; i < n; i = next++) {
        if (stop) throw Stopped();
        work(i);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      next = n;
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < std::max(1, jobs); ++i) threads.emplace_back(run);
  for (auto& t : threads) t.join();
  if (error) std::rethrow_exception(error);
}

// The engines to judge. The first engine is always among them: the referee tries its directions first, which
// may change the form of a certificate.
std::vector<std::size_t> engines_judged(const AnswersFile& file, const std::string& engine) {
  const auto& cards = file.cards();
  std::vector<std::size_t> judged;
  for (std::size_t i = 0; i < cards.size(); ++i)
    if (i == 0 || engine.empty() || cards[i].name == engine) judged.push_back(i);
  return judged;
}

void judge_block(const AnswersFile& file, const AnswersFile::Block& block,
                 const std::vector<std::size_t>& engines, std::uint64_t relations_every, JudgedAgain& into) {
  const KeptBatch batch = file.batch(block);
  std::vector<EnginePtr> kept;
  std::vector<const KeptEngine*> views;
  for (const std::size_t i : engines) {
    auto engine = std::make_unique<KeptEngine>(file.cards()[i], batch.engines[i]);
    views.push_back(engine.get());
    kept.push_back(std::move(engine));
  }
  ask_and_judge(into.after, batch.cases, batch.first_index, kept, relations_every);
  for (const KeptEngine* e : views) {
    into.not_kept_derived += e->missing_derived();
    into.not_kept_again += e->missing_again();
  }
}

// Findings of one case share certificates.
void write_all_evidence(CampaignResult& r, ExactCertificates when, int jobs, const std::atomic<bool>& stop) {
  std::map<std::uint64_t, std::vector<Finding*>> by_case;
  for (auto& [key, f] : r.findings) by_case[f.first_index].push_back(&f);
  std::vector<std::vector<Finding*>> groups;
  for (auto& [index, findings] : by_case) groups.push_back(std::move(findings));
  in_parallel(groups.size(), jobs, stop, [&](std::size_t i) {
    CaseCertificates certificates;
    for (Finding* f : groups[i]) write_evidence(*f, certificates, when);
  });
}

template <class Map>
void keep_only(Map& by_engine, const std::string& engine) {
  std::erase_if(by_engine, [&](const auto& entry) { return entry.first != engine; });
}

void keep_only(CampaignResult& r, const std::string& engine) {
  keep_only(r.tallies, engine);
  keep_only(r.relations, engine);
  keep_only(r.open, engine);
  keep_only(r.set_aside, engine);
  std::erase_if(r.findings, [&](const auto& entry) { return entry.second.engine != engine; });
}

// What the answers do not tell.
void carry_over(const CampaignResult& from, CampaignResult& to) {
  for (auto& [engine, questions] : to.tallies)
    for (auto& [question, tally] : questions) {
      const auto of_engine = from.tallies.find(engine);
      if (of_engine == from.tallies.end() || !of_engine->second.contains(question)) continue;
      const Tally& before = of_engine->second.at(question);
      tally.time = before.time;
      tally.slow = before.slow;
    }
  for (auto& [key, f] : to.findings) {
    const auto before = from.findings.find(key);
    if (before == from.findings.end() || before->second.first_index != f.first_index) continue;
    const Json& there = before->second.evidence_json.at("observation");
    if (!there.contains("detail")) continue;
    // In its place among the fields.
    Json observation = Json::object();
    for (const auto& [name, value] : f.evidence_json.at("observation").items()) {
      observation[name] = value;
      if (name == "outcome") observation["detail"] = there.at("detail");
    }
    f.evidence_json["observation"] = std::move(observation);
  }
  to.set_aside = from.set_aside;
  to.total_ns = from.total_ns;
  to.engine_ns = from.engine_ns;
  to.judge_ns = from.judge_ns;
  to.pair_asked = from.pair_asked;
  to.pair_cpu_ns = from.pair_cpu_ns;
}

void require_all_cases(const AnswersFile& file, const std::filesystem::path& path, std::uint64_t cases) {
  std::uint64_t kept = 0;
  for (const auto& b : file.blocks()) kept += b.cases;
  if (kept != cases)
    throw InputError(
        path.string(),
        fmt::format("holds the answers to {} cases, but the campaign has judged {}", kept, cases));
}

}  // namespace

JudgedAgain judge_again(const std::filesystem::path& directory, const std::string& engine, int jobs,
                        const std::atomic<bool>& stop, const JudgeProgress& progress) {
  const auto state_file = directory / "state.json";
  if (!std::filesystem::exists(state_file))
    throw InputError(directory.string(),
                     "does not hold a campaign; touchstone fuzz --keep-answers --out DIR creates one");
  const DirectoryLock lock(directory, DirectoryLock::For::reading);
  const Json json = load_json(state_file, campaign_limits);
  const JsonReader state(json, state_file.string());
  JudgedAgain judged;
  state["settings"].require_object();
  judged.settings = state["settings"].json();
  judged.before = result_with_evidence(state["result"]);
  if (!state["settings"].has("keep_answers"))
    throw InputError(directory.string(), "keeps no answers; run the campaign with --keep-answers");
  const std::uint64_t relations_every = count_of(state["settings"]["relations_every"]);
  const std::uint64_t bytes = state.has("answers_bytes") ? count_of(state["answers_bytes"]) : 0;
  if (bytes == 0) return judged;  // interrupted before the first chunk
  const AnswersFile file(directory, bytes);
  require_all_cases(file, directory / answers_file_name, judged.before.cases);
  const auto engines = engines_judged(file, engine);
  if (!engine.empty() && std::none_of(engines.begin(), engines.end(),
                                      [&](std::size_t i) { return file.cards()[i].name == engine; })) {
    std::string names;
    for (const EngineCard& c : file.cards()) names += (names.empty() ? "" : ", ") + c.name;
    throw InputError("--engine " + engine, "gave none of the answers; those are of " + names);
  }
  std::mutex mutex;
  in_parallel(file.blocks().size(), jobs, stop, [&](std::size_t i) {
    JudgedAgain part;
    judge_block(file, file.blocks()[i], engines, relations_every, part);
    const std::lock_guard hold(mutex);
    judged.after.merge(part.after);
    judged.not_kept_derived += part.not_kept_derived;
    judged.not_kept_again += part.not_kept_again;
    if (progress) progress(judged.after.cases, judged.before.cases);
  });
  if (!engine.empty()) {
    keep_only(judged.before, engine);
    keep_only(judged.after, engine);
  }
  const auto when = state["settings"].has("certificates") ? ExactCertificates::now : ExactCertificates::later;
  write_all_evidence(judged.after, when, jobs, stop);
  carry_over(judged.before, judged.after);
  return judged;
}

void save_judged_again(const std::filesystem::path& out, const JudgedAgain& judged) {
  if (std::filesystem::exists(out / "state.json"))
    throw InputError(out.string(), "holds a campaign already; give another directory");
  make_directory(out);
  const DirectoryLock lock(out, DirectoryLock::For::writing);
  StoredState state;
  state.finished = true;
  state.result = judged.after;
  Json settings = judged.settings;
  settings.erase("keep_answers");
  save_findings(out, state.result);
  save_state(out, settings, state);
}

}  // namespace touchstone::fuzz
