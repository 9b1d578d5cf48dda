#include <fmt/format.h>

#include <algorithm>

#include "cli/case_argument.h"
#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/import_options.h"
#include "cli/judged_by.h"
#include "cli/query_file.h"
#include "cli/replay_capture.h"
#include "cli/replay_expected.h"
#include "core/base/input_error.h"
#include "fuzz/ask/evidence.h"
#include "fuzz/ask/judged_case.h"
#include "fuzz/campaign/campaign.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "scenarios/import/real_scene.h"
#include "scenarios/text/printable.h"
#include "scenarios/value/moving_pairs.h"

namespace touchstone::cli {
namespace {

struct ReplayOptions {
  std::vector<std::string> paths;
  EngineChoice choice;
  std::string frames, error;
  bool json = false, certificates = false, single = false;
  ExpectedOptions expected;
  WorkerLimits limits;
  ImportOptions import;
};

using Engines = std::vector<EnginePtr>;

// A name from a file, made safe for a terminal: no control characters, limited length.
std::string shown(std::string name) {
  if (name.size() > 200) name = name.substr(0, 197) + "...";
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return name;
}

std::vector<CaseObservations> ask(const Engines& engines, const Case& c) {
  std::vector<CaseObservations> r;
  for (const EnginePtr& e : engines) r.push_back(e->run({&c, 1})[0]);
  return r;
}

// The basis of the exit code: cases in which the subject is wrong or fails. For recordings, with thousands of
// cases each, answers are counted instead.
struct Count {
  std::uint64_t cases = 0, wrong_cases = 0;
  std::uint64_t recorded = 0, wrong_recorded = 0;  // answers about recordings
  std::uint64_t answered = 0;                      // by the subject, right or wrong
  std::vector<std::string> bad;                    // arguments that could not be judged
  bool failed = false;                             // one of them failed for a reason other than bad input
};

struct ReplayEngines {
  Engines engines;
  std::string subject;
};

fuzz::CampaignResult relations_of(const Case& c, const Engines& engines,
                                  const std::vector<CaseObservations>& observations) {
  fuzz::CampaignResult related;
  for (std::size_t e = 0; e < engines.size(); ++e)
    fuzz::relate_into(related, c, 0, engines[e], observations[e]);
  return related;
}

// One case in full.
void replay_case(const ReplayOptions& o, const ReplayEngines& asked, const Case& c, Count& count,
                 fuzz::Json& json) {
  const Engines& engines = asked.engines;
  fuzz::CaseJudge judge(c);
  bool subject_wrong = false;
  const auto observations = ask(engines, c);
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const EngineCard& card = engines[e]->card();
    const auto& judgements = judge.add(card, observations[e]);
    if (card.name != asked.subject) continue;
    for (const auto& j : judgements) {
      subject_wrong |= !j.faults.empty();
      count.answered += j.outcome == Outcome::answered;
    }
  }
  const fuzz::CampaignResult related = relations_of(c, engines, observations);
  subject_wrong |= related.wrong_of(asked.subject) > 0;
  ++count.cases;
  count.wrong_cases += subject_wrong;
  if (o.json) {
    using Which = fuzz::Certificates;
    json.push_back(to_json(std::move(judge).result(o.certificates ? Which::exact : Which::depths)));
    json.back()["impacts_not_asked"] = impacts_not_asked(c);
    json.back()["relations"] = fuzz::Json::array();
    for (const auto& [key, f] : related.findings) json.back()["relations"].push_back(fuzz::to_json(f));
    return;
  }
  fmt::print("{}", reports::replay_text(std::move(judge).result(fuzz::Certificates::shown)));
  if (const std::string words = words_on_impacts_not_asked(c); !words.empty())
    fmt::print("{}\n\n", reports::wrapped(words, 78, 4));
  if (!related.findings.empty()) fmt::print("\nEngines that contradict their own answers:\n");
  for (const auto& [key, f] : related.findings)
    fmt::print("  {}\n", reports::wrapped(fmt::format("{} {}: {}", f.engine, f.fault, f.words), 76, 4));
}

// A recorded scene has thousands of pairs, so counts and findings are printed instead of every answer.
void replay_real_scene(const ReplayOptions& o, const ReplayEngines& asked, const std::string& directory,
                       Count& count, fuzz::Json& json) {
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
      fuzz::ask_and_judge(result, part, index, asked.engines);
      index += part.size();
    }
    fmt::print(stderr, "{} frame {}: {} cases\n", scene.name, f, cases.size());
  }
  result.total_ns = std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
  if (o.json) {
    fuzz::write_evidence(result);
    json.push_back(fuzz::to_json(result, true));
  } else {
    fmt::print("{}: {} bodies, {} of {} frames\n{}\n", scene.name, scene.frame(0).bodies.size(),
               frames.size(), scene.frame_count(), reports::full_campaign_table(result));
    fmt::print("{}{}\n", reports::findings_summary(result, 3), reports::campaign_footer(result));
  }
  const std::uint64_t answered = result.answered_by(asked.subject), failed = result.failed_of(asked.subject);
  count.answered += answered;
  count.recorded += answered + failed;
  count.wrong_recorded += result.wrong_of(asked.subject) + failed;
}

std::string describe(const Count& count) {
  std::string text;
  if (count.cases > 0 || count.recorded == 0)
    text = fmt::format("{} of {} cases", reports::grouped(count.wrong_cases), reports::grouped(count.cases));
  if (count.recorded > 0)
    text += fmt::format("{}{} of {} answers about recordings", text.empty() ? "" : " and ",
                        reports::grouped(count.wrong_recorded), reports::grouped(count.recorded));
  return text;
}

int verdict(const Count& count, const std::string& subject, bool json) {
  if (!count.bad.empty() && count.cases + count.recorded == 0)  // already reported
    return count.failed ? exit_failed : exit_usage;
  if (!count.bad.empty())
    return print_verdict(
        count.failed ? exit_failed : exit_usage, count.bad[0],
        fmt::format("{} of the arguments could not be judged; in the others {} is wrong in {}",
                    count.bad.size(), subject, describe(count)),
        json);
  if (count.wrong_cases + count.wrong_recorded > 0)
    return print_verdict(exit_wrong, subject, "wrong in " + describe(count), json);
  if (count.answered == 0)
    return print_verdict(exit_failed, subject, "it answered nothing; this run proves nothing", json);
  return print_verdict(exit_clean, subject, "wrong in " + describe(count), json);
}

// Prints the origin recorded in the file. It is only text to show, never a name to run.
void print_origin(const std::string& path, const StoredCase& stored, const Engines& engines) {
  constexpr std::string_view made_by = "certify ";
  if (!stored.source.starts_with(made_by)) return;
  const std::string subject =
      shown(stored.source.substr(made_by.size(), stored.source.find(", ") - made_by.size()));
  const bool asked = std::any_of(engines.begin(), engines.end(),
                                 [&](const EnginePtr& e) { return e->card().name == subject; });
  fmt::print("{}: a script against {} ({})\n", path, subject,
             asked ? "queried below" : "not queried here; add it with --engines");
}

void replay_stored(const ReplayOptions& o, const ReplayEngines& asked, const std::string& path, Count& count,
                   fuzz::Json& json) {
  const StoredCase stored = case_argument(path, o.import);
  if (!o.json) print_origin(path, stored, asked.engines);
  replay_case(o, asked, stored.c, count, json);
}

// Calls `judge` for an argument. An error is reported and does not stop the others.
template <class Judge>
void attempt(const std::string& path, Count& count, fuzz::Json& json, const Judge& judge) {
  const auto refuse = [&](const std::string& words) {
    const std::string why = printable(words, "\n");
    fmt::print(stderr, "touchstone: {}\n", why);
    count.bad.push_back(path);
    json.push_back({{"argument", path}, {"error", why}});
  };
  try {
    judge();
  } catch (const InputError& e) {
    refuse(e.what());
  } catch (const std::exception& e) {
    count.failed = true;
    refuse(path + ": failed: " + e.what());
  }
}

void replay(const ReplayOptions& o, const ReplayEngines& asked, const std::string& path, Count& count,
            fuzz::Json& json) {
  if (is_recording(path))
    replay_real_scene(o, asked, path, count, json);
  else
    replay_stored(o, asked, path, count, json);
}

// All engines count, unless --subject names one.
int replay_expected(const ReplayOptions& o) {
  const bool all_count = o.choice.subject.empty();
  const ChosenEngines chosen =
      all_count ? ChosenEngines{engine_names(o.choice.engines), "", {}} : chosen_engines(o.choice, o.limits);
  const Engines engines = judged_by(make_engines(chosen.names, o.limits), o.error);
  ExpectedFailures expected(o.expected, chosen.subject);
  Count count;
  fuzz::Json errors = fuzz::Json::array();
  for (const std::string& path : o.paths)
    attempt(path, count, errors, [&] {
      if (is_recording(path)) throw InputError(path, "is a recording; expected failures are of single cases");
      const Case c = case_argument(path, o.import).c;
      const auto observations = ask(engines, c);
      expected.add(c, engines, observations, relations_of(c, engines, observations));
    });
  return expected.finish({count.bad, errors, count.failed ? exit_failed : exit_usage}, o.json);
}

// Engines answer beside the recorded answers only if they are named.
int replay_captured(const ReplayOptions& o, bool engines_named) {
  for (const std::string& path : o.paths)
    if (!is_query_file(path)) throw InputError(path, "is no capture (.jsonl); replay captures by themselves");
  std::vector<EnginePtr> beside;
  if (engines_named) beside = judged_by(make_engines(engine_names(o.choice.engines), o.limits), o.error);
  CaptureOptions capture{.precision = {.single = o.single, .tolerance = 0}, .json = o.json};
  if (!o.error.empty()) capture.precision.tolerance = length_from_text(o.error);
  return replay_captures(o.paths, beside, capture);
}

int run(const ReplayOptions& o, bool engines_named) {
  if (std::any_of(o.paths.begin(), o.paths.end(), is_query_file)) return replay_captured(o, engines_named);
  if (o.single) throw InputError("--single", "is about the answers of a capture (.jsonl)");
  if (o.expected.given()) return replay_expected(o);
  const ChosenEngines chosen = chosen_engines(o.choice, o.limits);
  const ReplayEngines asked{judged_by(make_engines(chosen.names, o.limits), o.error), chosen.subject};
  Count count;
  fuzz::Json json = fuzz::Json::array();
  for (const std::string& path : o.paths)
    attempt(path, count, json, [&] { replay(o, asked, path, count, json); });
  if (o.json) fmt::print("{}\n", json.dump(1));
  return verdict(count, asked.subject, o.json);
}

}  // namespace

Run declare_replay(CLI::App& app) {
  auto o = std::make_shared<ReplayOptions>();
  app.add_option("case", o->paths,
                 "case or scene files, robot or world files, directories of findings, names of scenarios, "
                 "directories of "
                 "recorded scenes (scene.txt, frames.npy), or captures (.jsonl), whose recorded answers are "
                 "judged; engines answer beside those only if --engines names them")
      ->required();
  add_engine_choice(app, o->choice);
  app.add_option("--frames", o->frames,
                 "frames of recorded scenes, first:end:step (default: about five frames)");
  add_expected(app, o->expected);
  add_error(app, o->error);
  add_case_seconds(app, o->limits);
  app.add_flag("--single", o->single, "the answers of a capture were computed in single precision");
  add_import_options(app, o->import);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  app.add_flag(
      "--certificates", o->certificates,
      "add certificates in exact arithmetic to the JSON, as `touchstone check` takes them (takes minutes for "
      "moving meshes)");
  const CLI::Option* engines = app.get_option("--engines");
  return [o, engines] { return run(*o, engines->count() > 0); };
}

}  // namespace touchstone::cli
