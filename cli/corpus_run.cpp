#include "cli/corpus_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/in_parallel.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "fuzz/corpus/score.h"
#include "reports/text/junit.h"
#include "reports/text/text.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

namespace corpus = fuzz::corpus;

// Two bodies: engines answer in microseconds, and those that hang do so in many cases.
constexpr double most_case_seconds = 0.05;

using Json = nlohmann::ordered_json;

std::vector<corpus::StoredCorpusCase> wanted_cases(const CorpusRunOptions& o) {
  auto cases = corpus::load_corpus(o.directory);
  std::erase_if(cases, [&](const auto& c) { return !c.id.starts_with(o.only); });
  if (cases.empty()) throw InputError("--only", "no id begins with " + o.only);
  return cases;
}

// Of one engine, one row a case.
using Scores = std::vector<std::vector<corpus::Scored>>;

Scores scores_of(Engine& engine, const std::vector<corpus::StoredCorpusCase>& stored) {
  constexpr std::size_t batch = 32;
  std::vector<Case> cases;
  for (const auto& c : stored) cases.push_back(corpus::as_case(c.id, c.scene));
  Scores scores;
  for (std::size_t first = 0; first < cases.size(); first += batch) {
    const std::span<const Case> part(cases.data() + first, std::min(batch, cases.size() - first));
    const auto observations = engine.run(part);
    for (std::size_t i = 0; i < part.size(); ++i)
      scores.push_back(corpus::score(stored[first + i], engine.card(), observations[i]));
  }
  return scores;
}

std::string answer_lines(const std::string& engine, const Scores& scores) {
  std::string text;
  for (const auto& of_case : scores)
    for (const corpus::Scored& s : of_case) {
      Json line = s.line;
      line["engine"] = engine;
      text += json_text(line) + "\n";
    }
  return text;
}

void add_tests(const std::string& engine, const std::vector<corpus::StoredCorpusCase>& cases,
               const Scores& scores, std::vector<reports::JUnitTest>& to) {
  using reports::TestResult;
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const corpus::Scored& s : scores[i]) {
      reports::JUnitTest t{engine, fmt::format("{} {}", cases[i].id, to_string(s.question)),
                           TestResult::passed, "", ""};
      if (s.score == corpus::Score::wrong || s.score == corpus::Score::failed)
        t = {t.suite, t.name, TestResult::failed, std::string(to_string(s.score)),
             fmt::format("{} ({})", s.words, cases[i].mechanism)};
      else if (s.score != corpus::Score::right)
        t = {t.suite, t.name, TestResult::skipped, std::string(to_string(s.score)), ""};
      to.push_back(std::move(t));
    }
}

Json results_json(const std::vector<corpus::StoredCorpusCase>& cases, const Scores& scores) {
  Json all = Json::array();
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const corpus::Scored& s : scores[i]) {
      Json r{{"case", cases[i].id}, {"question", to_string(s.question)}, {"result", to_string(s.score)}};
      if (!s.words.empty()) r["words"] = s.words;
      all.push_back(std::move(r));
    }
  return all;
}

struct AllScores {
  std::vector<std::string> engines;
  std::vector<Scores> scores;
};

AllScores ask_all(const CorpusRunOptions& o, const std::vector<std::string>& names,
                  const std::vector<corpus::StoredCorpusCase>& cases) {
  const std::vector<EnginePtr> engines = make_engines(names, o.limits);
  AllScores all;
  all.scores.resize(engines.size());
  for (const EnginePtr& e : engines) all.engines.push_back(e->card().name);
  in_parallel(engines.size(), processor_count(),
              [&](std::size_t i) { all.scores[i] = scores_of(*engines[i], cases); });
  return all;
}

std::vector<CorpusColumn> columns_of(const AllScores& all,
                                     const std::vector<corpus::StoredCorpusCase>& cases) {
  std::vector<CorpusColumn> columns;
  for (std::size_t e = 0; e < all.engines.size(); ++e) {
    CorpusColumn& column = columns.emplace_back();
    column.engine = all.engines[e];
    for (std::size_t i = 0; i < cases.size(); ++i) add_scores(column, cases[i], all.scores[e][i]);
  }
  return columns;
}

void write_files(const CorpusRunOptions& o, const AllScores& all,
                 const std::vector<corpus::StoredCorpusCase>& cases) {
  std::string lines;
  std::vector<reports::JUnitTest> tests;
  for (std::size_t e = 0; e < all.engines.size(); ++e) {
    if (!o.answers.empty()) lines += answer_lines(all.engines[e], all.scores[e]);
    if (!o.junit.empty()) add_tests(all.engines[e], cases, all.scores[e], tests);
  }
  if (!o.answers.empty()) write_file(o.answers, lines);
  if (!o.junit.empty()) write_file(o.junit, reports::junit(tests));
}

int verdict(const CorpusColumn& subject, bool json) {
  const CorpusCount& t = subject.total;
  const std::string words = fmt::format("{} of {} wrong or failed", reports::grouped(t.bad()),
                                        reports::counted(t.attempted(), "answer", "answers"));
  if (t.attempted() == 0)
    return print_verdict(exit_failed, subject.engine, "it answered nothing; this run proves nothing", json);
  return print_verdict(t.bad() > 0 ? exit_wrong : exit_clean, subject.engine, words, json);
}

}  // namespace

void declare_corpus_run(CLI::App& app, CorpusRunOptions& to) {
  to.limits.query_cpu_seconds = most_case_seconds;
  app.add_option("directory", to.directory, "the corpus")->capture_default_str();
  add_engine_choice(app, to.choice, "--engines,--engine");
  app.add_option("--only", to.only, "only cases whose ids begin with this");
  app.add_flag("--all", to.all, "show every mechanism, not only the ten with the most wrong answers");
  app.add_option(
      "--answers", to.answers,
      "write the answers as JSON lines to this file, as corpus/run.py and corpus/run.mjs read them");
  app.add_option("--junit", to.junit, "write a test for each case and question as JUnit XML to this file");
  add_case_seconds(app, to.limits);
  app.add_flag("--json", to.json, "one JSON document on stdout: the score, and the result of each case");
}

int corpus_run(const CorpusRunOptions& o) {
  prepare_output(o.answers);
  prepare_output(o.junit);
  const auto cases = wanted_cases(o);
  const ChosenEngines chosen = chosen_engines(o.choice, o.limits);
  const AllScores all = ask_all(o, chosen.names, cases);
  const std::vector<CorpusColumn> columns = columns_of(all, cases);
  write_files(o, all, cases);
  if (o.json) {
    Json j = Json::array();
    for (std::size_t e = 0; e < columns.size(); ++e) {
      j.push_back(to_json(columns[e]));
      j.back()["results"] = results_json(cases, all.scores[e]);
    }
    fmt::print("{}\n", json_text(j, 1));
  } else {
    fmt::print("{}: {}\n{}", o.directory, reports::counted(cases.size(), "case", "cases"),
               corpus_table(columns, o.all));
  }
  const auto subject = std::find_if(columns.begin(), columns.end(),
                                    [&](const CorpusColumn& c) { return c.engine == chosen.subject; });
  if (subject == columns.end()) throw InputError("--subject", chosen.subject + " was not queried");
  return verdict(*subject, o.json);
}

}  // namespace touchstone::cli
