#include "cli/replay_expected.h"

#include <fmt/format.h>

#include <utility>

#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/date.h"
#include "cli/output.h"
#include "core/base/outcome.h"
#include "fuzz/ask/ask.h"
#include "reports/record/result.h"
#include "reports/text/junit.h"
#include "reports/text/text.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {

void add_expected(CLI::App& app, ExpectedOptions& to) {
  auto* expected = app.add_option("--expected", to.file,
                                  "file of expected failures (case, engine, question, fault or any, reason, "
                                  "until); only answers that are newly wrong make the exit code 1, of all "
                                  "engines or of the one named by --subject");
  app.add_flag("--strict", to.strict, "with --expected: fixed failures make the exit code 1 too")
      ->needs(expected);
  app.add_option("--write-expected", to.write,
                 "record the present failures in this file; entries of --expected that still hold keep their "
                 "reasons");
  app.add_option("--junit", to.junit, "with --expected: write the result as JUnit XML to this file")
      ->needs(expected);
}

ExpectedFailures::ExpectedFailures(const ExpectedOptions& o, std::string subject)
    : options_(o), subject_(std::move(subject)) {
  prepare_output(o.junit);
  prepare_output(o.write);
  if (o.file.empty()) return;
  const fuzz::Json j = load_json(o.file);
  expected_ = fuzz::expected_from_json(JsonReader(j, o.file));
}

void ExpectedFailures::add(const Case& c, std::span<const EnginePtr> engines,
                           std::span<const CaseObservations> observations,
                           const fuzz::CampaignResult& related) {
  const std::string id = printable(c.id);
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const std::string& engine = engines[e]->card().name;
    for (std::size_t q = 0; q < c.queries.size() && counts(engine); ++q)
      if (!was_not_attempted(observations[e].answers[q].outcome))
        shown_.answered.insert({id, engine, std::string(to_string(c.queries[q].question))});
  }
  fuzz::CampaignResult judged;
  fuzz::judge_into(judged, c, 0, engines, observations);
  for (const fuzz::CampaignResult* r : {&std::as_const(judged), &related})
    for (const auto& [key, f] : r->findings)
      if (counts(f.engine))
        shown_.failures.push_back(
            {{id, f.engine, f.question}, std::string(fuzz::kind_of_fault(f.fault)), printable(f.words)});
}

int ExpectedFailures::finish(const Bad& bad, bool json) const {
  const fuzz::ExpectedComparison c = fuzz::compare(expected_, shown_, utc_now());
  if (json) {
    fuzz::Json j = fuzz::to_json(c);
    j["errors"] = bad.errors;
    fmt::print("{}\n", json_text(j, 1));
  } else if (!options_.file.empty()) {
    fmt::print("{}", reports::expected_text(c));
  }
  if (!options_.junit.empty())
    write_file(options_.junit, reports::expected_junit(shown_, c, options_.strict));
  const bool is_complete = bad.arguments.empty() && !shown_.answered.empty();
  if (!options_.write.empty() && is_complete) {
    const auto now = fuzz::as_shown(expected_, c, "recorded by --write-expected; not explained yet");
    write_file(options_.write, json_text(fuzz::to_json(now), 1) + "\n");
    return print_verdict(
        exit_clean, subject_words(),
        fmt::format("{} recorded in {}",
                    reports::counted(now.size(), "expected failure", "expected failures"), options_.write),
        json);
  }
  return verdict(c, bad, json);
}

int ExpectedFailures::verdict(const fuzz::ExpectedComparison& c, const Bad& bad, bool json) const {
  const std::string words = fuzz::summary_of(c);
  if (!bad.arguments.empty())
    return print_verdict(bad.code, bad.arguments[0],
                         fmt::format("{} of the arguments could not be judged; in the others: {}",
                                     bad.arguments.size(), words),
                         json);
  if (shown_.answered.empty())
    return print_verdict(exit_failed, subject_words(), "it answered nothing; this run proves nothing", json);
  const bool is_wrong = !c.newly_wrong.empty() || (options_.strict && !c.fixed.empty());
  return print_verdict(is_wrong ? exit_wrong : exit_clean, subject_words(), words, json);
}

}  // namespace touchstone::cli
