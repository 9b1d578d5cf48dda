#include "fuzz/answer/stated_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math/roundoff.h"
#include "fuzz/judge/check.h"
#include "scenarios/codec/value_codec.h"

namespace touchstone::fuzz {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto answer_fields =
    std::to_array<std::string_view>({"overlap", "distance", "lower_bound", "upper_bound", "witness", "normal",
                                     "moment", "unique_gradient", "depth", "points", "time_of_impact"});
constexpr auto point_fields = std::to_array<std::string_view>({"position", "depth"});

double number_of(const JsonReader& r) {
  if (!r.json().is_string()) return r.number();
  const std::string s = r.string();
  if (s == "NaN") return std::numeric_limits<double>::quiet_NaN();
  if (s == "Infinity") return infinity;
  if (s == "-Infinity") return -infinity;
  r.fail("must be a number, \"NaN\", \"Infinity\" or \"-Infinity\"");
}

Vec3 vector_of(const JsonReader& r) {
  const auto v = r.items(3);
  return {number_of(v[0]), number_of(v[1]), number_of(v[2])};
}

std::array<Vec3, 2> witness_of(const JsonReader& r) {
  if (r.json().is_array() && r.json().size() == 6) {
    const auto v = r.items();
    return {Vec3{number_of(v[0]), number_of(v[1]), number_of(v[2])},
            Vec3{number_of(v[3]), number_of(v[4]), number_of(v[5])}};
  }
  const auto points = r.items(2);
  return {vector_of(points[0]), vector_of(points[1])};
}

// The judge's input for one question; what the answer states is judged by the checks of that question.
struct Asked {
  Truth& truth;
  const Observation& answer;
  EngineCard card;
  CheckOutput& out;

  CheckInput input(Question q) const { return {truth, 0, query_of(q), answer, card}; }
  static const Query& query_of(Question q) {
    static const std::array all{Query{Question::overlap, 0, 1}, Query{Question::distance, 0, 1},
                                Query{Question::contact, 0, 1}, Query{Question::time_of_impact, 0, 1}};
    return all[static_cast<std::size_t>(q)];
  }
};

// Normal and depth of an answer that does not say that the bodies overlap. A contact offset of any size makes
// the judge take bodies that are apart as having depth -gap; the verdict is not judged here.
void judge_undeclared(Asked asked) {
  asked.card.contact_offset = std::numeric_limits<double>::denorm_min();
  asked.card.source = "the depth of bodies apart is minus their gap";
  const CheckInput in = asked.input(Question::contact);
  const StatedContact stated{0, 1, in.answer.normal, in.answer.depth};
  if (!judge_validity(in, asked.out, stated)) return;
  const referee::PairTruth& truth = in.truth.pair(0, 0, 1);
  if (truth.verdict == referee::Verdict::undecided && !std::isfinite(truth.gap.lo))
    asked.out.undecided = true;
  else
    judge_normal_and_depth(in, asked.out, stated, truth);
}

void judge_pair_claims(const Asked& asked) {
  const Observation& o = asked.answer;
  const bool measures = o.normal || o.depth;
  const bool says_contact = o.overlap.value_or(false);
  if (o.distance)
    check_distance(asked.input(Question::distance), asked.out);
  else if (o.overlap && !(says_contact && measures))
    check_overlap(asked.input(Question::overlap), asked.out);
  if (o.witness) check_witness(asked.input(Question::distance), asked.out);
  check_bounds(asked.input(Question::distance), asked.out);
  check_gradient(asked.input(Question::distance), asked.out);
  if (says_contact && measures)
    check_contact(asked.input(Question::contact), asked.out);
  else if (measures)
    judge_undeclared(asked);
  if (o.manifold.empty()) return;
  if (says_contact)
    check_manifold(asked.input(Question::contact), asked.out);
  else
    asked.out.not_judged("points of an answer that does not say that the bodies overlap", false);
}

EngineCard card_for(const StatedPrecision& p) {
  EngineCard card;
  card.name = "stated";
  card.unit_roundoff = p.single ? float_roundoff : double_roundoff;
  card.source = std::string(claimed_by_user);
  return card;
}

void sort_once(std::vector<FaultReport>& faults) {
  std::stable_sort(faults.begin(), faults.end(),
                   [](const auto& x, const auto& y) { return x.error_in_l > y.error_in_l; });
  const auto same = [](const auto& x, const auto& y) { return x.fault == y.fault && x.words == y.words; };
  faults.erase(std::unique(faults.begin(), faults.end(), same), faults.end());
}

}  // namespace

bool StatedAnswer::states_anything() const {
  return pair.overlap || pair.distance || pair.lower_bound || pair.upper_bound || pair.witness ||
         pair.normal || pair.moment || pair.unique_gradient || pair.depth || !pair.manifold.empty() ||
         says_impact;
}

StatedAnswer stated_answer_from_json(const JsonReader& r) {
  r.require_object(answer_fields);
  StatedAnswer s;
  Observation& o = s.pair;
  o.outcome = Outcome::answered;
  if (r.has("overlap") && !r["overlap"].json().is_null()) o.overlap = r["overlap"].boolean();
  if (r.has("distance")) o.distance = number_of(r["distance"]);
  if (r.has("lower_bound")) o.lower_bound = number_of(r["lower_bound"]);
  if (r.has("upper_bound")) o.upper_bound = number_of(r["upper_bound"]);
  if (r.has("normal")) o.normal = vector_of(r["normal"]);
  if (r.has("moment")) o.moment = vector_of(r["moment"]);
  if (r.has("unique_gradient")) o.unique_gradient = r["unique_gradient"].boolean();
  if (r.has("depth")) o.depth = number_of(r["depth"]);
  if (r.has("witness")) o.witness = witness_of(r["witness"]);
  if (r.has("points"))
    for (const JsonReader& p : r["points"].items()) {
      p.require_object(point_fields);
      o.manifold.push_back({vector_of(p["position"]), p.has("depth") ? number_of(p["depth"]) : 0});
    }
  s.says_impact = r.has("time_of_impact");
  if (s.says_impact && !r["time_of_impact"].json().is_null()) o.toi = number_of(r["time_of_impact"]);
  if (!s.states_anything()) r.fail("states nothing");
  complete(s);
  return s;
}

void complete(StatedAnswer& answer) {
  Observation& o = answer.pair;
  if (o.depth && *o.depth >= 0 && !o.overlap && !o.distance) o.overlap = true;
}

Judgement judge_stated(const Scene& scene, const StatedAnswer& answer, const StatedPrecision& precision) {
  Truth truth(scene);
  Observation observation = answer.pair;
  observation.claimed_tolerance = precision.tolerance;
  CheckOutput out;
  const Asked asked{truth, observation, card_for(precision), out};
  judge_pair_claims(asked);
  if (answer.says_impact) check_time_of_impact(asked.input(Question::time_of_impact), out);
  sort_once(out.faults);
  Judgement j;
  j.outcome = Outcome::answered;
  j.undecided = out.undecided;
  j.unjudged = std::move(out.unjudged);
  j.faults = std::move(out.faults);
  j.worst_in_l = out.worst_in_l;
  return j;
}

nlohmann::ordered_json judgement_to_json(const Judgement& j) {
  Json r{{"ruling", to_string(j.ruling())}, {"worst_error_in_l", j.worst_in_l}};
  if (!std::isfinite(j.worst_in_l)) r["worst_error_in_l"] = nullptr;
  r["faults"] = Json::array();
  for (const FaultReport& f : j.faults) {
    Json fault{{"fault", to_string(f.fault)}, {"words", f.words}};
    fault["error"] = std::isfinite(f.error) ? Json(f.error) : Json();
    if (f.certificate.kind != Certificate::Kind::none) fault["certificate"] = to_json(f.certificate);
    r["faults"].push_back(std::move(fault));
  }
  for (const Unjudged& u : j.unjudged) r["not_judged"].push_back(u.claim);
  return r;
}

}  // namespace touchstone::fuzz
