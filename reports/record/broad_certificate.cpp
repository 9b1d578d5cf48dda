#include "reports/record/broad_certificate.h"

#include <fmt/format.h>
#include <array>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/value_codec.h"

namespace touchstone::fuzz {
namespace {

using Json = nlohmann::ordered_json;
constexpr int format_version = 2;  // 2: lists of faults, kinds, and questions not answered in time

std::string hex(std::uint64_t v) { return fmt::format("{:016x}", v); }
std::uint64_t from_hex(const std::string& s) {
  std::uint64_t v = 0;
  const auto r = std::from_chars(s.data(), s.data() + s.size(), v, 16);
  if (s.size() != 16 || r.ec != std::errc{} || r.ptr != s.data() + s.size())
    throw InputError("digest", "is not 16 hexadecimal digits: " + s);
  return v;
}

template <class Names>
std::size_t index_in(const Names& names, const std::string& s, const JsonReader& at) {
  const auto it = std::find(names.begin(), names.end(), s);
  if (it == names.end()) at.fail("is not a known value: " + s);
  return static_cast<std::size_t>(it - names.begin());
}
BroadLevel level_of(const JsonReader& j) {
  return static_cast<BroadLevel>(index_in(level_names, j.string(), j));
}

Json to_json(const EvidenceCount& e) {
  Json j = {{"name", e.name},
            {"line", e.line},
            {"kind", to_string(e.kind)},
            {"level", to_string(e.level)},
            {"planned", e.planned},
            {"population", e.population},
            {"cases", e.cases},
            {"answered", e.answered},
            {"refused", e.refused},
            {"steps", e.steps},
            {"queries", e.queries},
            {"pairs_true", e.pairs_true},
            {"pairs_reported", e.pairs_reported},
            {"undecided", e.undecided},
            {"digest", hex(e.digest)},
            {"refusal", e.refusal}};
  if (e.out_of_time) j["out_of_time"] = true;
  return j;
}

EvidenceCount evidence_from_json(const JsonReader& j) {
  EvidenceCount e;
  e.name = j["name"].string();
  e.line = j["line"].string();
  e.refusal = j["refusal"].string();
  e.kind = static_cast<SuiteKind>(index_in(suite_kind_names, j["kind"].string(), j["kind"]));
  e.level = level_of(j["level"]);
  e.planned = count_of(j["planned"]);
  e.population = count_of(j["population"]);
  e.cases = count_of(j["cases"]);
  e.answered = count_of(j["answered"]);
  e.refused = count_of(j["refused"]);
  e.steps = count_of(j["steps"]);
  e.queries = count_of(j["queries"]);
  e.pairs_true = count_of(j["pairs_true"]);
  e.pairs_reported = count_of(j["pairs_reported"]);
  e.undecided = count_of(j["undecided"]);
  e.digest = from_hex(j["digest"].string());
  if (j.has("out_of_time")) e.out_of_time = j["out_of_time"].boolean();
  return e;
}

FaultClass class_from_json(const JsonReader& j) {
  return {j["fault"].string(),
          static_cast<FaultKind>(index_in(fault_kind_names, j["kind"].string(), j["kind"]))};
}

Json to_json(const FaultCount& f) {
  return {{"level", to_string(f.level)},
          {"evidence", f.evidence},
          {"fault", f.what.fault},
          {"kind", to_string(f.what.kind)},
          {"cases", f.cases},
          {"index", f.index},
          {"share", f.share},
          {"words", f.words}};
}

FaultCount fault_from_json(const JsonReader& j) {
  FaultCount f;
  f.level = level_of(j["level"]);
  f.evidence = j["evidence"].string();
  f.what = class_from_json(j);
  f.cases = count_of(j["cases"]);
  f.index = count_of(j["index"]);
  f.share = j["share"].number();
  f.words = j["words"].string();
  return f;
}

Json to_json(const TooSlow& t) {
  return {{"level", to_string(t.level)}, {"evidence", t.evidence}, {"index", t.index},
          {"bodies", t.bodies},          {"steps", t.steps},       {"allowed", t.allowed},
          {"sufficient", t.sufficient},  {"tried", t.tried}};
}

TooSlow too_slow_from_json(const JsonReader& j) {
  TooSlow t;
  t.level = level_of(j["level"]);
  t.evidence = j["evidence"].string();
  t.index = count_of(j["index"]);
  t.bodies = count_of(j["bodies"]);
  t.steps = count_of(j["steps"]);
  t.allowed = j["allowed"].number();
  t.sufficient = j["sufficient"].number();
  t.tried = j["tried"].number();
  return t;
}

Json to_json(const Refutation& r) {
  Json j = {{"level", to_string(r.level)},
            {"evidence", r.evidence},
            {"index", r.index},
            {"fault", r.what.fault},
            {"kind", to_string(r.what.kind)},
            {"words", r.words},
            {"shrink", r.shrink},
            {"bodies", r.bodies},
            {"steps", r.steps},
            {"shown_again", r.is_shown_again}};
  j["script"] = r.script ? case_to_json(*r.script) : Json();
  return j;
}

Refutation refutation_from_json(const JsonReader& j) {
  Refutation r;
  r.level = level_of(j["level"]);
  r.evidence = j["evidence"].string();
  r.index = count_of(j["index"]);
  r.what = class_from_json(j);
  r.words = j["words"].string();
  r.shrink = j["shrink"].string();
  r.bodies = count_of(j["bodies"]);
  r.steps = count_of(j["steps"]);
  r.is_shown_again = j["shown_again"].boolean();
  if (const JsonReader script = j["script"]; !script.json().is_null())
    r.script = case_from_json(script.json(), script.place());
  return r;
}

// Everything except the digest itself.
Json body_of(const BroadCertificate& c) {
  Json j = {{"touchstone_broad_certificate", format_version},
            {"subject", c.subject},
            {"card", Json::parse(to_json_text(c.card))},
            {"plugin_hash", c.plugin_hash},
            {"program", c.program},
            {"scope", c.scope},
            {"seed", c.seed},
            {"limit", c.limit},
            {"first_fault", c.first_fault},
            {"sweeps", c.sweeps},
            {"without", c.without}};
  if (c.margin) j["margin"] = *c.margin;
  for (const BroadLevel l : c.levels) j["verdict"][std::string(to_string(l))] = to_string(verdict(c, l));
  j["not_proved"] = not_proved(c);
  j["evidence"] = Json::array();
  for (const EvidenceCount& e : c.evidence) j["evidence"].push_back(to_json(e));
  j["faults"] = Json::array();
  for (const FaultCount& f : c.faults) j["faults"].push_back(to_json(f));
  j["refutations"] = Json::array();
  for (const Refutation& r : c.refutations) j["refutations"].push_back(to_json(r));
  j["too_slow"] = Json::array();
  for (const TooSlow& t : c.too_slow) j["too_slow"].push_back(to_json(t));
  return j;
}

std::uint64_t digest_of(const Json& body) { return Hasher().add(std::string_view(body.dump())).value(); }

bool answered_something(const BroadCertificate& c, BroadLevel level) {
  return std::any_of(c.evidence.begin(), c.evidence.end(), [&](const EvidenceCount& e) {
    return e.level == level && e.answered > 0 && e.pairs_true > 0;
  });
}

void note_counts(const BroadCertificate& c, std::vector<std::string>& out) {
  std::uint64_t undecided = 0, refused = 0;
  for (const EvidenceCount& e : c.evidence) {
    undecided += e.undecided;
    refused += e.refused;
    if (e.cases < e.planned)
      out.push_back(fmt::format("{}: stopped after {} of {} cases{}.", e.name, e.cases, e.planned,
                                e.out_of_time ? ", when its share of the time was used" : ""));
    if (e.population > e.planned)
      out.push_back(fmt::format("{}: a sample of {} of {} cases.", e.name, e.planned, e.population));
  }
  if (refused > 0)
    out.push_back(
        fmt::format("{} cases were refused by the subject and prove nothing else about it.", refused));
  if (undecided > 0) out.push_back(fmt::format("{} pairs could not be decided by the referee.", undecided));
}

}  // namespace

std::string in_words(const FaultClass& c) {
  constexpr auto kinds =
      std::to_array<std::string_view>({"solid pair", "pair that touches", "pair that meets within the step",
                                       "", "infinite box", "NaN, infinite or inverted box"});
  const std::string_view kind = kinds[static_cast<std::size_t>(c.kind)];
  return kind.empty() ? c.fault : fmt::format("{}, {}", c.fault, kind);
}

bool is_graver(const FaultClass& x, const FaultClass& y) {
  const auto rank = [](const FaultClass& c) {
    return std::tuple(c.kind == FaultKind::invalid, c.kind == FaultKind::unbounded, c.fault != "missed",
                      c.kind);
  };
  return std::pair(rank(x), std::string_view(x.fault)) < std::pair(rank(y), std::string_view(y.fault));
}

std::string_view to_string(LevelVerdict v) {
  constexpr auto names = std::to_array<std::string_view>(
      {"certified", "refuted", "nothing proved", "not asked", "not certified"});
  static_assert(names.size() == static_cast<std::size_t>(LevelVerdict::not_certified) + 1);
  return names[static_cast<std::size_t>(v)];
}

LevelVerdict verdict(const BroadCertificate& c, BroadLevel level) {
  if (std::find(c.levels.begin(), c.levels.end(), level) == c.levels.end()) return LevelVerdict::not_asked;
  for (const Refutation& r : c.refutations)
    if (r.level == level) return LevelVerdict::refuted;
  for (const TooSlow& t : c.too_slow)
    if (t.level == level) return LevelVerdict::not_certified;
  return answered_something(c, level) ? LevelVerdict::certified : LevelVerdict::nothing_proved;
}

int exit_code(const BroadCertificate& c) {
  if (!c.refutations.empty()) return 1;
  for (const BroadLevel l : c.levels)
    if (const auto v = verdict(c, l); v == LevelVerdict::nothing_proved || v == LevelVerdict::not_certified)
      return 3;
  return 0;
}

std::vector<std::string> not_proved(const BroadCertificate& c) {
  std::vector<std::string> out{
      "That no pair is lost in larger scenes, in longer scripts or with numbers other than those tried.",
      "That the subject is fast, or correct when several threads call it at once.",
      "That another build, compiler or machine behaves like this one."};
  for (const BroadLevel l : {BroadLevel::boxes, BroadLevel::bodies})
    if (verdict(c, l) == LevelVerdict::not_asked)
      out.push_back(fmt::format("Anything at the level of {}: it was not tested.", to_string(l)));
  if (c.margin)
    out.push_back(fmt::format(
        "Anything about other margins than {:g}, or about bodies that move within a step.", *c.margin));
  else if (!c.sweeps)
    out.push_back("Candidates of bodies that move within a step: the subject does not claim to sweep.");
  if (c.first_fault && !c.refutations.empty())
    out.push_back("That there is no other fault: as requested, a level ended at its first.");
  for (const std::string& w : c.without) out.push_back(fmt::format("{}: left out by request.", w));
  note_counts(c, out);
  return out;
}

std::uint64_t digest(const BroadCertificate& c) { return digest_of(body_of(c)); }

Json to_json(const BroadCertificate& c) {
  Json j = body_of(c);
  j["digest"] = hex(digest_of(j));
  return j;
}

BroadCertificate broad_certificate_from_json(const Json& json, bool& digest_holds) {
  const JsonReader j(json, "");
  if (!j.has("touchstone_broad_certificate"))
    throw InputError("touchstone_broad_certificate",
                     "is missing: this is not a certificate of a broad phase");
  if (j["touchstone_broad_certificate"].json() == 1)
    throw InputError(
        "touchstone_broad_certificate",
        "is version 1, of an earlier touchstone, which listed one fault per level; certify again");
  if (j["touchstone_broad_certificate"].json() != format_version)
    throw InputError("touchstone_broad_certificate", "is of a version that this program does not support");
  BroadCertificate c;
  c.subject = j["subject"].string();
  c.card = card_from_json(j["card"].json().dump());
  c.plugin_hash = j["plugin_hash"].string();
  c.program = j["program"].string();
  c.scope = j["scope"].string();
  c.seed = count_of(j["seed"]);
  c.limit = count_of(j["limit"]);
  c.first_fault = j["first_fault"].boolean();
  c.sweeps = j["sweeps"].boolean();
  if (j.has("margin")) c.margin = j["margin"].number();
  for (const JsonReader& name : j["without"].items()) c.without.push_back(name.string());
  for (const auto& [name, v] : members_of(j["verdict"]))
    c.levels.push_back(static_cast<BroadLevel>(index_in(level_names, name, v)));
  for (const JsonReader& e : j["evidence"].items()) c.evidence.push_back(evidence_from_json(e));
  for (const JsonReader& f : j["faults"].items()) c.faults.push_back(fault_from_json(f));
  for (const JsonReader& t : j["too_slow"].items()) c.too_slow.push_back(too_slow_from_json(t));
  for (const JsonReader& r : j["refutations"].items()) c.refutations.push_back(refutation_from_json(r));
  Json rest = json;
  rest.erase("digest");
  digest_holds = from_hex(j["digest"].string()) == digest_of(rest);
  return c;
}

}  // namespace touchstone::fuzz
