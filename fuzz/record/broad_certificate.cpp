#include "fuzz/record/broad_certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "scenarios/case_codec.h"

namespace touchstone::fuzz {
namespace {

using Json = nlohmann::ordered_json;
constexpr int format_version = 2;  // 2: lists of faults, kinds, questions not answered in time

std::string hex(std::uint64_t v) { return fmt::format("{:016x}", v); }
std::uint64_t from_hex(const std::string& s) {
  std::size_t used = 0;
  const std::uint64_t v = s.size() == 16 ? std::stoull(s, &used, 16) : 0;
  if (used != 16) throw InputError("digest", "is not 16 hexadecimal digits: " + s);
  return v;
}

template <class Names>
std::size_t index_in(const Names& names, const std::string& s, const char* what) {
  const auto it = std::find(names.begin(), names.end(), s);
  if (it == names.end()) throw InputError(what, "is none of those there are: " + s);
  return static_cast<std::size_t>(it - names.begin());
}
Level level_of(const std::string& s) { return static_cast<Level>(index_in(level_names, s, "level")); }

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
  return j;
}

EvidenceCount evidence_from_json(const Json& j) {
  EvidenceCount e;
  e.name = j.at("name"), e.line = j.at("line"), e.refusal = j.at("refusal");
  e.kind = static_cast<EvidenceKind>(index_in(evidence_kind_names, j.at("kind"), "kind"));
  e.level = level_of(j.at("level"));
  e.planned = j.at("planned"), e.population = j.at("population"), e.cases = j.at("cases");
  e.answered = j.at("answered"), e.refused = j.at("refused"), e.steps = j.at("steps");
  e.queries = j.at("queries"), e.pairs_true = j.at("pairs_true"), e.pairs_reported = j.at("pairs_reported");
  e.undecided = j.at("undecided"), e.digest = from_hex(j.at("digest"));
  return e;
}

FaultClass class_from_json(const Json& j) {
  return {j.at("fault"), static_cast<FaultKind>(index_in(fault_kind_names, j.at("kind"), "kind"))};
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

FaultCount fault_from_json(const Json& j) {
  FaultCount f;
  f.level = level_of(j.at("level")), f.evidence = j.at("evidence"), f.what = class_from_json(j);
  f.cases = j.at("cases"), f.index = j.at("index"), f.share = j.at("share"), f.words = j.at("words");
  return f;
}

Json to_json(const TooSlow& t) {
  return {{"level", to_string(t.level)}, {"evidence", t.evidence}, {"index", t.index},
          {"bodies", t.bodies},          {"steps", t.steps},       {"allowed", t.allowed},
          {"sufficient", t.sufficient},  {"tried", t.tried}};
}

TooSlow too_slow_from_json(const Json& j) {
  TooSlow t;
  t.level = level_of(j.at("level")), t.evidence = j.at("evidence"), t.index = j.at("index");
  t.bodies = j.at("bodies"), t.steps = j.at("steps");
  t.allowed = j.at("allowed"), t.sufficient = j.at("sufficient"), t.tried = j.at("tried");
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

Refutation refutation_from_json(const Json& j) {
  Refutation r;
  r.level = level_of(j.at("level"));
  r.evidence = j.at("evidence"), r.index = j.at("index"), r.what = class_from_json(j);
  r.words = j.at("words"), r.shrink = j.at("shrink"), r.bodies = j.at("bodies"), r.steps = j.at("steps");
  r.is_shown_again = j.at("shown_again");
  if (!j.at("script").is_null()) r.script = case_from_json(j.at("script"), "script");
  return r;
}

// All but the digest itself.
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
  for (const Level l : c.levels) j["verdict"][std::string(to_string(l))] = to_string(verdict(c, l));
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

bool answered_something(const BroadCertificate& c, Level level) {
  return std::any_of(c.evidence.begin(), c.evidence.end(), [&](const EvidenceCount& e) {
    return e.level == level && e.answered > 0 && e.pairs_true > 0;
  });
}

void note_counts(const BroadCertificate& c, std::vector<std::string>& out) {
  std::uint64_t undecided = 0, refused = 0;
  for (const EvidenceCount& e : c.evidence) {
    undecided += e.undecided, refused += e.refused;
    if (e.cases < e.planned)
      out.push_back(
          fmt::format("{}: {} of {} cases were asked, then it was stopped.", e.name, e.cases, e.planned));
    if (e.population > e.planned)
      out.push_back(fmt::format("{}: {} of {} were tried, a sample.", e.name, e.planned, e.population));
  }
  if (refused > 0)
    out.push_back(
        fmt::format("{} cases were refused by the subject; they say nothing of it but that.", refused));
  if (undecided > 0) out.push_back(fmt::format("{} pairs were left open by the referee.", undecided));
}

}  // namespace

std::string in_words(const FaultClass& c) {
  constexpr std::array<std::string_view, 6> kinds{
      "solid pair", "pair that touches", "pair that meets within the step",
      "",           "infinite box",      "NaN, infinite or inverted box"};
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
  constexpr std::array<std::string_view, 5> names{"certified", "refuted", "nothing proved", "not asked",
                                                  "not certified"};
  return names[static_cast<std::size_t>(v)];
}

LevelVerdict verdict(const BroadCertificate& c, Level level) {
  if (std::find(c.levels.begin(), c.levels.end(), level) == c.levels.end()) return LevelVerdict::not_asked;
  for (const Refutation& r : c.refutations)
    if (r.level == level) return LevelVerdict::refuted;
  for (const TooSlow& t : c.too_slow)
    if (t.level == level) return LevelVerdict::not_certified;
  return answered_something(c, level) ? LevelVerdict::certified : LevelVerdict::nothing_proved;
}

int exit_code(const BroadCertificate& c) {
  if (!c.refutations.empty()) return 1;
  for (const Level l : c.levels)
    if (const auto v = verdict(c, l); v == LevelVerdict::nothing_proved || v == LevelVerdict::not_certified)
      return 3;
  return 0;
}

std::vector<std::string> not_proved(const BroadCertificate& c) {
  std::vector<std::string> out{
      "That no pair is lost in scenes larger, in scripts longer or of numbers other than those tried.",
      "That the subject is fast, or right when several threads call it at once.",
      "That another build, compiler or machine behaves as this one."};
  for (const Level l : {Level::boxes, Level::bodies})
    if (verdict(c, l) == LevelVerdict::not_asked)
      out.push_back(fmt::format("Anything at the level of {}: it was not asked.", to_string(l)));
  if (!c.sweeps)
    out.push_back("Candidates of bodies that move within a step: the subject is not said to sweep.");
  if (c.first_fault && !c.refutations.empty())
    out.push_back("That there is no other fault: by request a level ended with its first.");
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

BroadCertificate broad_certificate_from_json(const Json& j, bool& digest_holds) try {
  if (!j.is_object() || !j.contains("touchstone_broad_certificate"))
    throw InputError("touchstone_broad_certificate", "is missing: this is no certificate of a broad phase");
  if (j.at("touchstone_broad_certificate") == 1)
    throw InputError("touchstone_broad_certificate",
                     "is version 1, of an earlier touchstone, which listed one fault a level; certify again");
  if (j.at("touchstone_broad_certificate") != format_version)
    throw InputError("touchstone_broad_certificate", "is a version that this program does not know");
  BroadCertificate c;
  c.subject = j.at("subject"), c.card = card_from_json(j.at("card").dump());
  c.plugin_hash = j.at("plugin_hash"), c.program = j.at("program"), c.scope = j.at("scope");
  c.seed = j.at("seed"), c.limit = j.at("limit"), c.first_fault = j.at("first_fault"),
  c.sweeps = j.at("sweeps");
  c.without = j.at("without").get<std::vector<std::string>>();
  for (const auto& [name, v] : j.at("verdict").items()) c.levels.push_back(level_of(name));
  for (const Json& e : j.at("evidence")) c.evidence.push_back(evidence_from_json(e));
  for (const Json& f : j.at("faults")) c.faults.push_back(fault_from_json(f));
  for (const Json& t : j.at("too_slow")) c.too_slow.push_back(too_slow_from_json(t));
  for (const Json& r : j.at("refutations")) c.refutations.push_back(refutation_from_json(r));
  Json rest = j;
  rest.erase("digest");
  digest_holds = from_hex(j.at("digest")) == digest_of(rest);
  return c;
} catch (const Json::exception& e) {
  throw InputError("", std::string("is no certificate of a broad phase: ") + e.what());
}

}  // namespace touchstone::fuzz
