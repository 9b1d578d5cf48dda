#include <fmt/format.h>

#include <algorithm>

#include "core/base/input_error.h"
#include "core/scene/real_scene.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/cli/case_argument.h"
#include "fuzz/cli/command.h"
#include "fuzz/cli/engine_catalog.h"
#include "fuzz/explore/real_scene_cases.h"
#include "fuzz/judge/judge.h"
#include "reports/replay_text.h"
#include "reports/text.h"
#include "scenarios/moving_pairs.h"

namespace touchstone::cli {
namespace {

struct ReplayOptions {
  std::vector<std::string> paths;
  std::string engines = "all", subject = "core", frames;
  bool json = false;
  WorkerLimits limits;
};

using Engines = std::vector<EnginePtr>;

std::vector<CaseObservations> ask(const Engines& engines, const Case& c) {
  std::vector<CaseObservations> r;
  for (const EnginePtr& e : engines) r.push_back(e->run({&c, 1})[0]);
  return r;
}

// One case in full. True when the subject is wrong or fails.
bool replay_case(const ReplayOptions& o, const Engines& engines, const Case& c, fuzz::Json& json) {
  fuzz::Truth truth(c.scene);
  reports::ReplayText text(c, truth);
  bool subject_wrong = false;
  const auto observations = ask(engines, c);
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const EngineCard& card = engines[e]->card();
    const auto judgements = fuzz::judge(c, card, observations[e], truth);
    text.add(card.name, observations[e], judgements);
    if (card.name == o.subject)
      for (const auto& j : judgements) subject_wrong |= !j.faults.empty();
  }
  fuzz::CampaignResult related;
  for (std::size_t e = 0; e < engines.size(); ++e)
    fuzz::relate_into(related, c, 0, engines[e], observations[e]);
  subject_wrong |= related.wrong_of(o.subject) > 0;
  if (o.json) {
    json.push_back(text.json());
    json.back()["impacts_not_asked"] = impacts_not_asked(c);
    json.back()["relations"] = fuzz::Json::array();
    for (const auto& [key, f] : related.findings) json.back()["relations"].push_back(fuzz::to_json(f));
    return subject_wrong;
  }
  fmt::print("{}", text.str());
  if (const std::string words = words_on_impacts_not_asked(c); !words.empty())
    fmt::print("{}\n\n", reports::wrapped(words, 78, 4));
  if (!related.findings.empty()) fmt::print("\nAgainst their own answers:\n");
  for (const auto& [key, f] : related.findings)
    fmt::print("  {}\n", reports::wrapped(fmt::format("{} {}: {}", f.engine, f.fault, f.words), 76, 4));
  return subject_wrong;
}

// A recorded scene: thousands of pairs, so counts and findings instead of every answer.
bool replay_real_scene(const ReplayOptions& o, const Engines& engines, const std::string& directory,
                       fuzz::Json& json) {
  const RealScene scene = load_real_scene(directory);
  const auto frames = fuzz::frames_from_text(o.frames, scene.frame_count());
  fuzz::CampaignResult result;
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t index = 0;
  constexpr std::size_t batch = 64;
  for (int f : frames) {
    const auto cases = fuzz::real_scene_cases(scene, f);
    for (std::size_t first = 0; first < cases.size(); first += batch) {
      const std::span<const Case> part(cases.data() + first, std::min(batch, cases.size() - first));
      fuzz::ask_and_judge(result, part, index, engines);
      index += part.size();
    }
    fmt::print(stderr, "{} frame {}: {} cases\n", scene.name, f, cases.size());
  }
  result.total_ns = std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
  if (o.json) {
    json.push_back(fuzz::to_json(result, true));
  } else {
    fmt::print("{}: {} bodies, {} of {} frames\n{}\n", scene.name, scene.frame(0).bodies.size(),
               frames.size(), scene.frame_count(), reports::campaign_table(result));
    fmt::print("{}{}\n", reports::findings_summary(result, 3), reports::campaign_footer(result));
  }
  return result.wrong_of(o.subject) + result.failed_of(o.subject) > 0;
}

int run(const ReplayOptions& o) {
  Engines engines;
  for (const auto& name : engine_names(o.engines)) engines.push_back(make_engine(name, o.limits));
  bool subject_wrong = false;
  fuzz::Json json = fuzz::Json::array();
  for (const std::string& path : o.paths) {
    if (std::filesystem::exists(std::filesystem::path(path) / "scene.txt"))
      subject_wrong |= replay_real_scene(o, engines, path, json);
    else
      subject_wrong |= replay_case(o, engines, case_argument(path).c, json);
  }
  if (o.json) fmt::print("{}\n", json.dump(1));
  return subject_wrong ? exit_wrong : exit_clean;
}

}  // namespace

Run declare_replay(CLI::App& app) {
  auto o = std::make_shared<ReplayOptions>();
  app.add_option("case", o->paths,
                 "case or scene files, directories of findings, names of scenarios, or directories of "
                 "recorded scenes "
                 "(scene.txt, frames.npy)")
      ->required();
  app.add_option("--engines", o->engines, "engines to ask: names, plug-in paths, or all")
      ->capture_default_str();
  app.add_option("--subject", o->subject, "the engine whose faults decide the exit code")
      ->capture_default_str();
  app.add_option("--frames", o->frames, "of recorded scenes: first:end:step (default: about five frames)");
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
