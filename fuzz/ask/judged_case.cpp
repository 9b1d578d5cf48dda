#include "fuzz/ask/judged_case.h"

#include <cmath>

#include "fuzz/ask/evidence.h"
#include "fuzz/judge/judge.h"

namespace touchstone::fuzz {
namespace {

std::vector<BodyPair> pairs_of(const std::vector<Truth::TruePair>& set) {
  std::vector<BodyPair> pairs;
  for (const Truth::TruePair& p : set) pairs.push_back(p.bodies);
  return pairs;
}

std::string time_verdict(const referee::TimeTruth& t) {
  using V = referee::TimeTruth::Verdict;
  return t.verdict == V::hit ? "impact" : t.verdict == V::none ? "no impact" : "undecided";
}

std::string within_words(referee::Verdict v) {
  using enum referee::Verdict;
  return v == overlap ? "within" : v == disjoint ? "beyond" : "undecided";
}

// True when the text form of a replay states the depth.
bool has_depth(const Query& q, const referee::PairTruth& t) {
  return is_contact_question(q.question) && t.verdict == referee::Verdict::overlap && std::isfinite(t.gap.lo);
}

}  // namespace

const std::vector<Judgement>& CaseJudge::add(const EngineCard& card, const CaseObservations& observations) {
  engines_.push_back({card.name, observations.answers, judge(c_, card, observations, truth_)});
  return engines_.back().judgements;
}

RefereeAnswer CaseJudge::referee_answer(const Query& q, Certificates certificates) {
  RefereeAnswer r;
  const auto exact = [&] {
    return certificates == Certificates::exact ? exact_certificate(c_.scene, q.question, q.a, q.b) : Json();
  };
  switch (q.question) {
    case Question::ray:
    case Question::time_of_impact: {
      const referee::TimeTruth& t = truth_.motion(0, q.a, q.b);
      r.verdict = time_verdict(t);
      r.time = {t.t_lo, t.t_hi};
      r.note = t.note;
      r.certificate = exact();
      return r;
    }
    case Question::candidates:
      for (const auto& set : truth_.true_pairs()) r.pairs.push_back(pairs_of(set));
      return r;
    case Question::candidates_within:
      for (const auto& set : truth_.pairs_within()) r.pairs.push_back(pairs_of(set));
      r.undecided_pairs = truth_.undecided_pairs_within();
      return r;
    case Question::scene_contacts:
      r.pairs = {pairs_of(truth_.scene_pairs(0))};
      return r;
    case Question::swept_candidates:
      r.pairs = {truth_.meeting_pairs()};
      r.undecided_pairs = truth_.undecided_meetings();
      return r;
    case Question::overlap:
    case Question::distance:
    case Question::contact:
    case Question::within:
    case Question::bounded_distance:
    case Question::contact_within:
      break;
  }
  const referee::PairTruth& t = truth_.pair(0, q.a, q.b);
  r.verdict = referee::to_string(t.verdict);
  r.note = t.verdict_certificate.note;
  r.gap = {t.gap.lo, t.gap.hi};
  r.normal = t.normal;
  r.witness = t.witness;
  r.verdict_certificate = t.verdict_certificate;
  if (certificates != Certificates::shown || has_depth(q, t))
    r.depth_certificate = referee::depth_certificate(t, truth_.placed(0, q.a), truth_.placed(0, q.b));
  if (q.question == Question::within || q.question == Question::contact_within)
    r.within = within_words(truth_.within(0, q.a, q.b));
  r.level = t.level;
  r.certificate = exact();
  return r;
}

JudgedCase CaseJudge::result(Certificates certificates) && {
  JudgedCase r{c_, {}, certificates == Certificates::exact, std::move(engines_)};
  for (const Query& q : c_.queries) r.referee.push_back(referee_answer(q, certificates));
  return r;
}

}  // namespace touchstone::fuzz
