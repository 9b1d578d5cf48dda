#include <cmath>

#include "fuzz/answer/pair_answer.h"
#include "scenarios/codec/value_codec.h"

namespace touchstone::fuzz {
namespace {

using Json = nlohmann::ordered_json;

// Adding 0 turns -0 into 0.
Json list(const Vec3& v) { return Json::array({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}); }
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }
Json bracket(double lo, double hi) { return Json::array({number(lo), number(hi)}); }
Json bracket(const referee::Bracket& b) { return bracket(b.lo, b.hi); }

Json to_json(const referee::NearMinimalNormals& n) {
  Json j;
  j["normals"] = Json::array();
  for (const Vec3& v : n.normals) j["normals"].push_back(list(v));
  j["slack"] = number(n.slack);
  j["second_best"] = number(n.second_best);
  j["continuum"] = n.continuum;
  j["complete"] = n.certified && !n.capped && !n.continuum;
  return j;
}

Json to_json(const referee::GradientSet& g) {
  Json j{{"unique", g.unique}};
  j["corners"] = Json::array();
  for (const referee::Gradient& c : g.corners)
    j["corners"].push_back(
        {{"normal", list(c.normal)}, {"moment", list(c.moment)}, {"point", list(c.point)}});
  return j;
}

Json to_json(const GapProof& p) {
  Json j = Json::object();
  const auto put = [&](const char* name, const Certificate& c) {
    if (c.kind != Certificate::Kind::none) j[name] = touchstone::to_json(c);
  };
  put("verdict", p.verdict);
  put("at_least", p.at_least);
  put("at_most", p.at_most);
  return j;
}

const char* name_of(referee::TimeTruth::Verdict v) {
  using Verdict = referee::TimeTruth::Verdict;
  return v == Verdict::hit ? "hit" : v == Verdict::none ? "none" : "undecided";
}

Json to_json(const WithinAnswer& w) {
  using enum referee::Verdict;
  const char* const verdict = w.verdict == overlap    ? "within"
                              : w.verdict == disjoint ? "beyond"
                                                      : "undecided";
  return {{"margin", w.margin}, {"verdict", verdict}, {"certified", w.certified}};
}

void put_certified(Json& j, bool certified, const std::string& why_not) {
  j["certified"] = certified;
  if (!why_not.empty()) j["not_certified"] = why_not;
}

}  // namespace

nlohmann::ordered_json to_json(const PairAnswer& answer) {
  const referee::PairTruth& t = answer.truth;
  Json j{{"verdict", to_string(t.verdict)}, {"gap", bracket(t.gap)}};
  if (t.verdict == referee::Verdict::overlap) j["depth"] = bracket(-t.gap.hi, -t.gap.lo);
  if (answer.within) j["within"] = to_json(*answer.within);
  const bool has_normal = std::isfinite(t.gap.lo) && t.normal.allFinite() && !t.normal.isZero(0);
  j["normal"] = has_normal ? list(t.normal) : Json();
  if (answer.normals) j["normals"] = to_json(*answer.normals);
  const bool has_witness = t.witness[0].allFinite() && t.witness[1].allFinite();
  j["witness"] = has_witness && has_normal ? Json::array({list(t.witness[0]), list(t.witness[1])}) : Json();
  if (answer.gradients) j["gradients"] = to_json(*answer.gradients);
  j["level"] = t.level;
  if (!answer.proof) return j;
  j["proven_gap"] = bracket(answer.proof->gap);
  j["certificates"] = to_json(*answer.proof);
  put_certified(j, answer.certified, answer.not_certified);
  return j;
}

nlohmann::ordered_json to_json(const ImpactAnswer& answer) {
  const referee::TimeTruth& t = answer.truth;
  Json j{{"verdict", name_of(t.verdict)}};
  j["time"] = t.verdict == referee::TimeTruth::Verdict::none ? Json() : bracket(t.t_lo, t.t_hi);
  j["least_gap"] = bracket(t.least_gap);
  if (!t.note.empty()) j["note"] = t.note;
  if (!answer.certificate) return j;
  if (!answer.certificate->claims_nothing()) j["certificate"] = touchstone::to_json(*answer.certificate);
  put_certified(j, answer.certified, answer.not_certified);
  return j;
}

}  // namespace touchstone::fuzz
