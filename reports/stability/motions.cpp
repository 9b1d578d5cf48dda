#include "reports/stability/motions.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/input_error.h"
#include "core/math/rng.h"
#include "fuzz/judge/flicker.h"
#include "fuzz/judge/frames.h"
#include "fuzz/judge/judge.h"
#include "scenarios/random/motions.h"

namespace touchstone::fuzz {
namespace {

/// One motion, and what is true of its frames.
struct Followed {
  const Case& motion;
  std::vector<Case> frames;
  std::vector<Truth> truths;

  explicit Followed(const Case& c) : motion(c), frames(frames_of(c)) {
    truths.reserve(frames.size());
    for (const Case& f : frames) truths.emplace_back(f.scene);
  }
};

MotionEvidence evidence(const Followed& m, std::string_view kind, int frame, const Query& q,
                        std::string words) {
  MotionEvidence e;
  e.kind = kind;
  e.motion = m.motion.id;
  e.frame = frame;
  e.frames = static_cast<int>(m.frames.size());
  e.question = to_string(q.question);
  e.a = q.a;
  e.b = q.b;
  e.words = std::move(words);
  return e;
}

void count_answers(MotionResult& r, Followed& m, int frame, const EngineCard& card,
                   const CaseObservations& all) {
  const auto k = static_cast<std::size_t>(frame);
  const std::vector<Judgement> judgements = judge(m.frames[k], card, all, m.truths[k]);
  for (std::size_t q = 0; q < judgements.size(); ++q) {
    const Judgement& j = judgements[q];
    if (was_not_attempted(j.outcome)) continue;
    r.answers += j.outcome == Outcome::answered;
    r.failed += j.outcome != Outcome::answered;
    r.wrong += j.outcome == Outcome::answered && !j.faults.empty();
    r.open += j.ruling() == Ruling::undecided || j.ruling() == Ruling::not_judged;
    if (j.faults.empty()) continue;
    const FaultReport& worst = j.faults.front();
    keep(r.evidence, evidence(m, wrong_evidence, frame, m.frames[k].queries[q],
                              fmt::format("{}: {}", to_string(worst.fault), worst.words)));
  }
}

void add_change(MotionResult& r, const Followed& m, const Query& q, int frame, const FrameChange& change) {
  r.changes += change.compared;
  r.restless = std::max(r.restless, change.restless);
  if (change.true_switch) {
    ++r.switches;
    keep(r.evidence, evidence(m, switch_evidence, frame, q, change.switch_words));
  }
  for (const FlickerReport& f : change.flickers) {
    const auto kind = static_cast<std::size_t>(f.flicker);
    ++r.flickers[kind];
    r.worst[kind] = std::max(r.worst[kind], f.amount);
    MotionEvidence e = evidence(m, to_string(f.flicker), frame, q, f.words);
    e.before = f.before;
    e.after = f.after;
    e.amount = f.amount;
    keep(r.evidence, std::move(e));
  }
}

// Questions are matched by what they ask: a frame lacks those about bodies that are not present.
void compare_frames(MotionResult& r, Followed& m, int frame, const EngineCard& card,
                    const std::vector<CaseObservations>& answers) {
  const auto now = static_cast<std::size_t>(frame), was = now - 1;
  for (std::size_t q = 0; q < m.frames[now].queries.size(); ++q) {
    const Query& query = m.frames[now].queries[q];
    const auto& before = m.frames[was].queries;
    const auto found = std::find(before.begin(), before.end(), query);
    if (found == before.end()) continue;
    const AnsweredFrame earlier{m.truths[was],
                                answers[was].answers[static_cast<std::size_t>(found - before.begin())]},
        later{m.truths[now], answers[now].answers[q]};
    add_change(r, m, query, frame, change_between(earlier, later, query, card, frame));
  }
}

// Each frame again, by an engine that has seen none of the others.
void compare_states(MotionResult& r, Followed& m, Engine& engine, const Forget& forget,
                    const std::vector<CaseObservations>& in_order) {
  for (std::size_t k = 0; k < m.frames.size(); ++k)
    for (std::size_t q = 0; q < m.frames[k].queries.size(); ++q) {
      const Observation& before = in_order[k].answers[q];
      if (was_not_attempted(before.outcome) || depends_on_time(before.outcome)) continue;
      if (!forget(engine)) return;
      Case alone = m.frames[k];
      alone.queries = {m.frames[k].queries[q]};
      const auto answer = engine.run({&alone, 1});
      ++r.state_asked;
      const std::string words =
          difference_by_state(engine.card(), m.truths[k], alone.queries[0], before, answer[0].answers[0]);
      if (words.empty()) continue;
      ++r.state_differs;
      keep(r.evidence, evidence(m, state_evidence, static_cast<int>(k), alone.queries[0], words));
    }
}

MotionResult follow_one(Followed& m, Engine& engine, const Forget& forget, bool ask_alone) {
  MotionResult r;
  r.motion = m.motion.family;
  r.engine = engine.card().name;
  r.motions = 1;
  r.frames = m.frames.size();
  forget(engine);
  const std::vector<CaseObservations> answers = engine.run(m.frames);
  for (std::size_t k = 0; k < m.frames.size(); ++k) {
    count_answers(r, m, static_cast<int>(k), engine.card(), answers[k]);
    if (k > 0) compare_frames(r, m, static_cast<int>(k), engine.card(), answers);
  }
  if (ask_alone) compare_states(r, m, engine, forget, answers);
  return r;
}

Case make_motion(const MotionRow& row, std::size_t number, const MotionPlan& plan, int i) {
  Rng rng = Rng::stream(plan.seed, (number << 32) + static_cast<std::uint64_t>(i));
  Case c;
  row.make(rng, plan.frames, c);
  c.family = row.name;
  c.id = fmt::format("{}/{}/{}", row.name, plan.seed, i);
  return c;
}

}  // namespace

std::vector<MotionResult> follow(const Case& motion, std::span<const EnginePtr> engines, const Forget& forget,
                                 bool ask_alone) {
  Followed m(motion);
  std::vector<MotionResult> results;
  for (const EnginePtr& e : engines) results.push_back(follow_one(m, *e, forget, ask_alone));
  return results;
}

Motions follow_all(const MotionPlan& plan, std::span<const EnginePtr> engines, const Forget& forget,
                   const std::function<void(const std::string&)>& progress) {
  Motions all;
  all.seed = plan.seed;
  all.count = plan.count;
  all.frames = plan.frames;
  const auto rows = motion_rows();
  for (std::size_t number = 0; number < rows.size(); ++number) {
    const MotionRow& row = rows[number];
    if (!plan.motion.empty() && plan.motion != row.name) continue;
    all.rows.push_back({std::string(row.name), std::string(row.line)});
    std::vector<MotionResult> results(engines.size());
    for (int i = 0; i < plan.count; ++i) {
      if (progress) progress(fmt::format("{}: motion {} of {}", row.name, i + 1, plan.count));
      const auto of_motion = follow(make_motion(row, number, plan, i), engines, forget, i % state_every == 0);
      for (std::size_t e = 0; e < results.size(); ++e) {
        results[e].motion = of_motion[e].motion;
        results[e].engine = of_motion[e].engine;
        results[e].merge(of_motion[e]);
      }
    }
    all.results.insert(all.results.end(), results.begin(), results.end());
  }
  if (all.rows.empty()) {
    std::string names;
    for (const MotionRow& r : rows) names += (names.empty() ? "" : ", ") + std::string(r.name);
    throw InputError("--motion " + plan.motion, "there is no such motion, only " + names);
  }
  return all;
}

}  // namespace touchstone::fuzz
