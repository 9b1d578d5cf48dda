#include <algorithm>
#include <chrono>
#include <optional>

#include "fuzz/ask/ask.h"
#include "fuzz/ask/asked_case.h"
#include "fuzz/ask/degeneracy.h"
#include "fuzz/ask/magnitude.h"
#include "fuzz/ask/novelty.h"
#include "fuzz/ask/unstable.h"
#include "fuzz/judge/judge.h"
#include "oracles/abi/last_words.h"
#include "oracles/abi/measure.h"
#include "reports/record/result.h"
#include "scenarios/codec/case_codec.h"

namespace touchstone::fuzz {
namespace {

// One site in an engine's code is one fault, whatever the case; the first case serves as the example.
void name_by_site(Finding& f, const std::string& site) {
  f.fault += "_" + site_word(site);
  f.shapes = any_shapes;
  f.degeneracy = "any";
}

void add_findings(CampaignResult& r, AskedCase& asked, const std::string& engine, const Query& q,
                  const Judgement& j, const CaseObservations& all, const Observation& o) {
  const Case& c = asked.get();
  for (const FaultReport& fault : j.faults) {
    Finding f;
    f.engine = engine;
    f.question = to_string(q.question);
    // How an answer failed is part of its name: a crash is not a time-out.
    f.fault = fault.fault == Fault::failed ? to_string(j.outcome) : to_string(fault.fault);
    f.shapes = shapes_of(c, fault.a, fault.b);
    f.blame = to_string(j.blame);
    f.degeneracy = degeneracy_of(c, fault.a, fault.b);
    f.magnitude = to_string(magnitude_of(fault.error_in_l));
    if (!o.site.empty()) name_by_site(f, o.site);
    f.count = 1;
    f.worst_in_l = fault.error_in_l;
    f.first_index = asked.index();
    f.examples = {asked.example(fault.error_in_l)};
    auto& kept = r.findings[f.key()];
    if (kept.count == 0 || f.first_index < kept.first_index) {
      // The last words of a dying process stay out of the finding: they may differ from run to run.
      f.words = fault.fault == Fault::failed ? std::string(to_string(j.outcome)) : fault.words;
      if (!o.site.empty()) f.words += " at " + o.site;
      f.evidence = std::make_shared<const Evidence>(
          Evidence{c, o, all.received, fault.certificate, fault.a, fault.b, fault.step, q.question});
    }
    kept.merge(f);
  }
}

bool any_fault(const std::vector<Judgement>& judgements) {
  return std::any_of(judgements.begin(), judgements.end(),
                     [](const Judgement& j) { return !j.faults.empty(); });
}

// The direction that the subject found is the first that the referee tries as a certificate.
void give_hints(Truth& truth, const Case& c, const CaseObservations& o) {
  for (std::size_t i = 0; i < c.queries.size() && i < o.answers.size(); ++i) {
    const Query& q = c.queries[i];
    if (!is_pair_question(q.question)) continue;
    if (o.answers[i].normal) truth.hint(q.a, q.b, *o.answers[i].normal);
    if (o.answers[i].witness) truth.hint(q.a, q.b, (*o.answers[i].witness)[1] - (*o.answers[i].witness)[0]);
  }
}

void count_open(CampaignResult& r, const Case& c, const std::string& engine, const Query& q,
                const Judgement& j) {
  if (j.outcome != Outcome::answered) return;
  const Ruling ruling = j.ruling();
  OpenCount& n = r.open[engine][q.question][is_pair_question(q.question) ? shapes_of(c, q.a, q.b) : "scenes"];
  ++n.answers;
  n.open += ruling == Ruling::undecided || (ruling == Ruling::not_judged && !j.unjudged_by_definition());
}

void count_hit(CampaignResult& r, const Case& c, Truth& truth) {
  if (c.queries.empty() || !is_pair_question(c.queries[0].question)) return;
  const Query& q = c.queries[0];
  if (is_motion_question(q.question)) {
    const auto v = truth.motion(0, q.a, q.b).verdict;
    if (v == referee::TimeTruth::Verdict::undecided) {
      ++r.undecided;
    } else {
      ++r.pair_cases;
      r.overlapping += v == referee::TimeTruth::Verdict::hit;
    }
    return;
  }
  const auto& t = truth.pair(0, q.a, q.b);
  if (t.verdict == referee::Verdict::undecided) {
    ++r.undecided;
  } else {
    ++r.pair_cases;
    r.overlapping += t.verdict == referee::Verdict::overlap;
    ++r.levels[static_cast<std::size_t>(t.level)];
  }
}

// Whether some engine answered, or tried to, so that there is something to referee.
bool was_attempted(std::span<const CaseObservations> observations) {
  for (const CaseObservations& all : observations)
    for (const Observation& o : all.answers)
      if (!was_not_attempted(o.outcome)) return true;
  return false;
}

bool asks_pair(const Case& c) {
  return !c.queries.empty() && c.queries[0].question < Question::time_of_impact;
}

// The cost of running one engine on a batch: this thread's CPU time; where that is less than the time the
// engine reports, the engine worked elsewhere and its time is added (an engine in this process that was held
// up by others counts twice, so the rate is at most too low). The cost is shared in proportion to the
// engine's own times.
void share_asking(CampaignResult& r, std::span<const Case> cases,
                  const std::vector<CaseObservations>& answers, std::int64_t cpu_ns) {
  std::int64_t own = 0, of_pairs = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const Observation& o : answers[i].answers) {
      own += o.elapsed_ns;
      of_pairs += asks_pair(cases[i]) ? o.elapsed_ns : 0;
    }
  const double share = own > 0 ? static_cast<double>(of_pairs) / static_cast<double>(own) : 0;
  r.pair_cpu_ns +=
      static_cast<std::int64_t>(share * static_cast<double>(cpu_ns < own ? cpu_ns + own : cpu_ns));
}

}  // namespace

void judge_into(CampaignResult& r, const Case& c, std::uint64_t index, std::span<const EnginePtr> engines,
                std::span<const CaseObservations> observations, std::vector<std::uint64_t>* features) {
  const auto start = std::chrono::steady_clock::now();
  Truth truth(c.scene);
  AskedCase asked(c, index);
  if (!observations.empty()) give_hints(truth, c, observations[0]);
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const EngineCard& card = engines[e]->card();
    auto judgements = judge(c, card, observations[e], truth);
    std::optional<CaseObservations> without_unstable;
    if (any_fault(judgements)) {
      without_unstable = observations[e];
      remove_unstable(c, *engines[e], *without_unstable, judgements);
    }
    const CaseObservations& all = without_unstable ? *without_unstable : observations[e];
    for (std::size_t i = 0; i < c.queries.size(); ++i) {
      const Observation& o = all.answers[i];
      r.tallies[card.name][c.queries[i].question].add(judgements[i], o, card.times_include_pipe);
      count_open(r, c, card.name, c.queries[i], judgements[i]);
      r.engine_ns += o.elapsed_ns;
      add_findings(r, asked, card.name, c.queries[i], judgements[i], all, o);
      if (features) add_features(c, c.queries[i], card, o, judgements[i], *features);
    }
  }
  if (features)
    for (std::size_t i = 0; i < c.queries.size(); ++i) add_pattern(c, i, observations, *features);
  if (was_attempted(observations))
    count_hit(r, c, truth);
  else
    ++r.not_refereed;
  ++r.cases;
  ++r.families[c.family];
  r.judge_ns += std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
}

void ask_and_judge(CampaignResult& r, std::span<const Case> cases, std::uint64_t first_index,
                   std::span<const EnginePtr> engines, std::uint64_t relations_every,
                   std::vector<std::vector<std::uint64_t>>* features) {
  if (features) features->resize(cases.size());
  std::vector<std::vector<CaseObservations>> by_engine;
  for (const EnginePtr& e : engines) {
    const std::int64_t before = thread_cpu_ns();
    by_engine.push_back(e->run(cases));
    share_asking(r, cases, by_engine.back(), thread_cpu_ns() - before);
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::uint64_t index = first_index + i;
    std::vector<CaseObservations> observations;
    for (auto& of_engine : by_engine) observations.push_back(std::move(of_engine[i]));
    const std::int64_t start = thread_cpu_ns();
    judge_into(r, cases[i], index, engines, observations, features ? &(*features)[i] : nullptr);
    if (asks_pair(cases[i])) {
      ++r.pair_asked;
      r.pair_cpu_ns += thread_cpu_ns() - start;
    }
    if (relations_every == 0 || index % relations_every != 0) continue;
    for (std::size_t e = 0; e < engines.size(); ++e)
      relate_into(r, cases[i], index, engines[e], observations[e]);
  }
}

}  // namespace touchstone::fuzz
