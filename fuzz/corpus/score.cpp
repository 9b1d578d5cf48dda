#include "fuzz/corpus/score.h"

#include <algorithm>
#include <cmath>

#include "fuzz/judge/judge.h"
#include "fuzz/judge/tau.h"

namespace touchstone::fuzz::corpus {
namespace {

using Json = nlohmann::ordered_json;

// How far an answer may be off (corpus/README.md).
struct Limits {
  double tau = 0;     // a length
  double unit = 0;    // of a normal's length from 1
  double offset = 0;  // bodies apart by this much more may be in contact
  double skin = 0;    // an impact may be reported at a gap larger by this
  double bias = 0;    // share of the least depth by which a normal may need more
};

Limits limits_of(const EngineCard& card, const Observation& o, const Scene& s) {
  Limits l;
  l.tau = tau_of(card, o, s, 0, 1, scale_of_pair(s, 0, 1));
  l.unit = card.tau_factor * pair_roundoff(card, s, 0, 1);
  l.offset = contact_offset(card);
  l.skin = sweep_skin(card);
  l.bias = depth_bias(card, kind_of(s.shape_of(0)), kind_of(s.shape_of(1)));
  return l;
}

// The least tolerance that the case lists times for and that is not smaller; empty if all are.
std::optional<double> listed(double tau, const std::vector<int>& exponents, double scale) {
  for (const int k : exponents)
    if (const double t = std::ldexp(scale, -k); tau <= t) return t;
  return std::nullopt;
}

// Times are listed for some tolerances: the engine's is raised to the next one.
struct Raised {
  EngineCard card;
  Observation answer;
};
std::optional<Raised> with_listed_tolerance(const EngineCard& card, const Observation& o,
                                            const StoredCorpusCase& c) {
  const Scene& s = c.scene;
  const double scale = scale_of_pair(s, 0, 1);
  const Limits l = limits_of(card, o, s);
  const auto late = listed(l.tau, c.exponents, scale), early = listed(l.tau + l.skin, c.exponents, scale);
  if (!late || !early) return std::nullopt;
  Raised r{card, o};
  r.card.contact_offset = contact_offset(card);
  r.card.depth_biases.clear();
  r.card.source = "corpus";
  r.card.sweep_skin = *early - *late;
  Observation unclaimed = o;
  unclaimed.claimed_tolerance = 0;
  r.answer.claimed_tolerance = (*late - tau_of(card, unclaimed, s, 0, 1, scale)) / (1 + l.unit);
  return r;
}

// What the corpus judges.
Observation asked_part(Observation o, Question q) {
  o.witness.reset();
  o.moment.reset();
  o.unique_gradient.reset();
  o.manifold.clear();
  if (q == Question::overlap) o.distance.reset();
  if (q != Question::contact) {
    o.normal.reset();
    o.depth.reset();
  }
  return o;
}

// NaN and infinities, which JSON lacks, as strings.
Json number(double x) {
  if (std::isnan(x)) return "NaN";
  return std::isfinite(x) ? Json(x) : Json(x > 0 ? "Infinity" : "-Infinity");
}

Json answer_json(const Observation& o, Question q) {
  Json j = Json::object();
  if (q == Question::time_of_impact) {
    j["time_of_impact"] = o.toi ? number(*o.toi) : Json();
    return j;
  }
  if (o.overlap) j["overlap"] = *o.overlap;
  if (q == Question::distance && o.distance) j["distance"] = number(*o.distance);
  if (o.normal) j["normal"] = {number(o.normal->x()), number(o.normal->y()), number(o.normal->z())};
  if (o.depth) j["depth"] = number(*o.depth);
  return j;
}

Json limits_json(const Limits& l) {
  Json j{{"tau", l.tau}, {"unit", l.unit}};
  if (l.offset > 0) j["offset"] = l.offset;
  if (l.skin > 0) j["skin"] = l.skin;
  if (l.bias > 0) j["bias"] = l.bias;
  return j;
}

void rule(Scored& r, const Judgement& j) {
  switch (j.ruling()) {
    case Ruling::wrong:
      r.score = Score::wrong;
      break;
    case Ruling::right:
      r.score = Score::right;
      break;
    case Ruling::failed:
      r.score = Score::failed;
      break;
    case Ruling::unsupported:
    case Ruling::refused:
      r.score = Score::unsupported;
      break;
    case Ruling::undecided:
    case Ruling::not_judged:
      r.score = Score::not_judged;
  }
  if (!j.faults.empty()) r.words = j.faults.front().words;
}

bool is_rest(Question q) { return q != Question::time_of_impact; }

bool is_too_wide(const Limits& l, Question q, const Scene& s) {
  return std::max(l.tau, q == Question::distance ? 0 : l.offset) >= scale_of_pair(s, 0, 1);
}

Scored score_one(const StoredCorpusCase& c, const EngineCard& card, const Observation& given, Question q,
                 const ReceivedScene& received, Truth& truth) {
  Scored r{q, Score::not_judged, "", {{"case", c.id}, {"question", to_string(q)}}};
  Case one = as_case(c.id, c.scene);
  one.queries = {{q, 0, 1}};
  Raised asked{card, asked_part(given, q)};
  if (given.outcome == Outcome::answered) {
    r.line["answer"] = answer_json(asked.answer, q);
    r.line["limits"] = limits_json(limits_of(card, asked.answer, c.scene));
  } else {
    r.line[was_not_attempted(given.outcome) ? "unsupported" : "failed"] = to_string(given.outcome);
  }
  if (!is_rest(q) && given.outcome == Outcome::answered) {
    auto raised = with_listed_tolerance(card, asked.answer, c);
    if (!raised) return r;
    asked = std::move(*raised);
  }
  rule(r, judge(one, asked.card, {received, {asked.answer}}, truth).at(0));
  if (r.score == Score::right && is_rest(q) &&
      is_too_wide(limits_of(card, asked.answer, c.scene), q, c.scene))
    r.score = Score::not_judged;
  return r;
}

}  // namespace

std::vector<Scored> score(const StoredCorpusCase& c, const EngineCard& card,
                          const CaseObservations& observations) {
  Truth truth(c.scene);
  std::vector<Scored> all;
  const auto questions = questions_about(c.scene);
  for (std::size_t i = 0; i < questions.size(); ++i)
    all.push_back(score_one(c, card, observations.answers.at(i), questions[i], observations.received, truth));
  return all;
}

}  // namespace touchstone::fuzz::corpus
