#include "reports/record/judged_case.h"

#include "scenarios/codec/value_codec.h"

namespace touchstone::fuzz {
namespace {

Json referee_json(const Query& q, const RefereeAnswer& r, bool exact) {
  if (q.question == Question::time_of_impact || q.question == Question::ray) {
    Json j = {{"verdict", r.verdict}, {"t_lo", r.time[0]}, {"t_hi", r.time[1]}, {"note", r.note}};
    if (exact) j["certificate"] = r.certificate;
    return j;
  }
  if (q.question == Question::swept_candidates)
    return {{"meeting_pairs", r.pairs.at(0)}, {"undecided_pairs", r.undecided_pairs}};
  if (q.question == Question::candidates_within)
    return {{"pairs_within", r.pairs}, {"undecided_pairs", r.undecided_pairs}};
  if (!is_pair_question(q.question)) return {{"overlapping_pairs", r.pairs}};
  Json j;
  if (!r.within.empty()) j["within"] = r.within;
  j.update({{"verdict", r.verdict},
            {"gap", {number(r.gap[0]), number(r.gap[1])}},
            {"normal", vector(r.normal)},
            {"witness", {vector(r.witness[0]), vector(r.witness[1])}},
            {"verdict_certificate",
             r.certificate.is_null() ? touchstone::to_json(r.verdict_certificate) : r.certificate},
            {"depth_certificate", touchstone::to_json(r.depth_certificate)},
            {"filter_level", r.level}});
  return j;
}

Json answer_json(const Observation& o, const Judgement& g) {
  Json faults = Json::array(), unjudged = Json::array();
  for (const FaultReport& f : g.faults)
    faults.push_back({{"fault", to_string(f.fault)},
                      {"words", f.words},
                      {"error", number(f.error)},
                      {"error_in_l", number(f.error_in_l)}});
  for (const Unjudged& u : g.unjudged)
    unjudged.push_back({{"claim", u.claim}, {"by_definition", u.by_definition}});
  Json j = {{"answer", to_json(o)},
            {"elapsed_ns", o.elapsed_ns},
            {"manifold_coverage", g.manifold_coverage ? number(*g.manifold_coverage) : Json()},
            {"ruling", to_string(g.ruling())},
            {"right", g.right()},
            {"undecided", g.undecided},
            {"not_judged", std::move(unjudged)},
            {"claimed_in_l", number(g.wide_claim_in_l)},
            {"blame", to_string(g.blame)},
            {"faults", std::move(faults)}};
  if (g.manifold_centred) j["manifold_centred"] = *g.manifold_centred;
  if (g.bound_slack_in_l) j["bound_slack_in_l"] = number(*g.bound_slack_in_l);
  return j;
}

}  // namespace

Json to_json(const JudgedCase& j) {
  Json out = {{"case", j.c.id}, {"queries", Json::array()}};
  for (std::size_t i = 0; i < j.c.queries.size(); ++i) {
    const Query& q = j.c.queries[i];
    Json item = {{"question", to_string(q.question)},
                 {"a", q.a},
                 {"b", q.b},
                 {"referee", referee_json(q, j.referee[i], j.exact)}};
    for (const JudgedCase::OfEngine& e : j.engines)
      item["engines"][e.engine] = answer_json(e.answers[i], e.judgements[i]);
    out["queries"].push_back(std::move(item));
  }
  return out;
}

}  // namespace touchstone::fuzz
