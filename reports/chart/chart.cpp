#include "reports/chart/chart.h"

#include <fmt/format.h>

#include <algorithm>

#include "fuzz/judge/judge.h"
#include "oracles/abi/measure.h"
#include "reports/chart/chart_rows.h"

namespace touchstone::fuzz {
namespace {

// Engines take turns after each batch of cases, so that a machine that slows down affects all of them.
constexpr std::size_t batch = 32;

struct EngineAnswers {
  CaseObservations first;               // judged
  std::vector<std::vector<double>> ns;  // by query, by round
};

bool answered_any(std::span<const EngineAnswers> asked) {
  return std::any_of(asked.begin(), asked.end(), [](const EngineAnswers& a) {
    const auto& answers = a.first.answers;
    return std::any_of(answers.begin(), answers.end(),
                       [](const Observation& o) { return o.outcome == Outcome::answered; });
  });
}

std::vector<std::vector<EngineAnswers>> run_rounds(std::span<const ChartCase> cases,
                                                   std::span<const EnginePtr> engines, int rounds) {
  std::vector<Case> plain;
  for (const ChartCase& c : cases) plain.push_back(c.c);
  std::vector<std::vector<EngineAnswers>> all(engines.size(), std::vector<EngineAnswers>(cases.size()));
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < engines.size(); ++k) {
      if (round > 0 && !answered_any(all[k])) continue;  // each time-out costs seconds
      auto answers = engines[k]->run(plain);
      for (std::size_t i = 0; i < answers.size(); ++i) {
        EngineAnswers& a = all[k][i];
        a.ns.resize(answers[i].answers.size());
        for (std::size_t q = 0; q < a.ns.size(); ++q)
          a.ns[q].push_back(static_cast<double>(answers[i].answers[q].elapsed_ns));
        if (round == 0) a.first = std::move(answers[i]);
      }
    }
  return all;
}

void add(ChartRows& rows, std::span<const ChartCase> cases, std::span<const EnginePtr> engines, int rounds) {
  const auto asked = run_rounds(cases, engines, rounds);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const ChartCase& c = cases[i];
    Truth truth(c.c.scene);
    for (std::size_t k = 0; k < engines.size(); ++k) {
      const EngineCard& card = engines[k]->card();
      const auto judgements = judge(c.c, card, asked[k][i].first, truth);
      for (std::size_t q = 0; q < judgements.size(); ++q)
        rows.add({card.name, std::string(to_string(c.c.queries[q].question)), c.regime, c.pair, c.scale,
                  c.bodies, judgements[q],
                  card.times_include_pipe ? std::vector<double>() : asked[k][i].ns[q]});
    }
  }
}

void add_all(ChartRows& rows, std::span<const ChartCase> cases, std::span<const EnginePtr> engines,
             int rounds, const std::string& what, const ChartProgress& progress) {
  for (std::size_t first = 0; first < cases.size(); first += batch) {
    if (progress) progress(fmt::format("{}: {} of {} cases", what, first, cases.size()));
    add(rows, cases.subspan(first, std::min(batch, cases.size() - first)), engines, rounds);
  }
}

}  // namespace

ChartScope quick_chart() { return {"quick", 3, 60, 3, false, {64, 256, 1024}}; }
ChartScope full_chart() { return {"full", 6, 300, 5, true, {64, 256, 1024, 4096}}; }

Chart measure_chart(const ChartScope& scope, std::uint64_t seed, std::span<const EnginePtr> engines,
                    std::span<const EnginePtr> broad, const ChartProgress& progress) {
  Chart chart;
  chart.machine = this_machine();
  chart.seed = seed;
  chart.rounds = scope.rounds;
  chart.scope = scope.name;
  chart.measure_ns = measure_ns();
  for (const auto& list : {engines, broad})
    for (const EnginePtr& e : list)
      chart.engines.push_back({e->card().name, e->card().library, e->card().version, e->card().settings});
  ChartRows rows;
  add_all(rows, narrow_chart_cases(seed, scope.per_cell, scope.meshes), engines, scope.rounds, "pairs",
          progress);
  add_all(rows, margin_chart_cases(seed, scope.per_cell, scope.meshes), engines, scope.rounds, "margins",
          progress);
  add_all(rows, ray_chart_cases(seed, 4 * scope.per_motion), engines, scope.rounds, "rays", progress);
  add_all(rows, impact_chart_cases(seed, scope.per_motion), engines, scope.rounds, "motions", progress);
  for (std::uint64_t n : scope.crowds) {
    const ChartCase c = broad_chart_case(seed, n);
    // A single query instead of hundreds: its minimum time needs more rounds.
    add_all(rows, {&c, 1}, broad, 2 * scope.rounds, fmt::format("{} bodies", n), progress);
  }
  chart.rows = rows.rows();
  return chart;
}

}  // namespace touchstone::fuzz
