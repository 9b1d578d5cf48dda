// The result of a campaign read back from JSON, which is checked.
#include <cmath>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "reports/record/result.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/text/printable.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::fuzz {
TimeHistogram TimeHistogram::from_json(const Json& j) {
  TimeHistogram h;
  const JsonReader buckets(j, "");
  for (const JsonReader& e : buckets.items()) {
    const auto pair = e.items(2);
    const std::uint64_t i = count_of(pair[0]), n = count_of(pair[1]);
    if (i >= h.bucket_.size()) pair[0].fail("is not a bucket of the histogram");
    h.bucket_[i] = n;
    h.count_ += n;
  }
  return h;
}

double number_from(const JsonReader& j) {
  if (j.json().is_number()) return j.number();
  const auto v = double_from_text(j.string());
  if (!v) j.fail("is not a number");
  return *v;
}

namespace {

// For fields that results of earlier versions lack.
std::uint64_t count_or_zero(const JsonReader& j, std::string_view field) {
  return j.has(field) ? count_of(j[field]) : 0;
}

// Limited, so that the times of several shards can be added.
std::int64_t ns_from(const JsonReader& j) {
  constexpr double max_ns = 1e18;  // 32 years; the sum of nine fits into 64 bits
  if (!j.json().is_number_integer() || !(std::abs(j.number()) <= max_ns))
    j.fail("must be a whole number of nanoseconds, at most 1e18");
  return j.json().get<std::int64_t>();
}

TimeHistogram histogram_from(const JsonReader& j) try {
  return TimeHistogram::from_json(j.json());
} catch (const InputError& e) {
  throw InputError(j.place() + e.place(), e.reason());
}

Tally tally_from_json(const JsonReader& j) {
  Tally t;
  const JsonReader outcomes = j["outcomes"];
  outcomes.require_object();
  for (std::size_t i = 0; i < t.outcomes.size(); ++i)
    t.outcomes[i] = count_or_zero(outcomes, outcome_names[i]);
  t.right = count_of(j["right"]);
  t.wrong = count_of(j["wrong"]);
  t.missed = count_of(j["missed"]);
  t.ghost = count_of(j["ghost"]);
  t.representation = count_of(j["representation"]);
  t.undecided = count_of(j["undecided"]);
  t.not_judged = count_or_zero(j, "not_judged");
  t.by_definition = count_or_zero(j, "by_definition");
  t.within_wide_claim = count_or_zero(j, "within_wide_claim");
  t.pairs_true = count_of(j["pairs_true"]);
  t.pairs_reported = count_of(j["pairs_reported"]);
  t.pairs_duplicate = count_of(j["pairs_duplicate"]);
  t.manifolds = count_or_zero(j, "manifolds");
  t.coverage_permille = count_or_zero(j, "coverage_permille");
  t.manifolds_centred = count_or_zero(j, "manifolds_centred");
  t.worst_in_l = number_from(j["worst_in_l"]);
  t.slow = count_or_zero(j, "slow");
  if (j.has("ns_histogram")) t.time = histogram_from(j["ns_histogram"]);
  if (j.has("times_include_pipe")) t.times_include_pipe = j["times_include_pipe"].boolean();
  return t;
}

constexpr const char* parts_of_evidence[] = {"case", "observation", "certificate", "received"};

}  // namespace

Case campaign_case(const Json& j, const std::string& place) {
  Case c = case_from_json(j, place);
  // The body indices of a question about the whole scene are meaningless and not stored; families use -1.
  for (Query& q : c.queries)
    if (!is_pair_question(q.question)) q.a = q.b = -1;
  return c;
}

Finding finding_from_json(const JsonReader& j) {
  Finding f;
  f.engine = j["engine"].string();
  f.question = j["question"].string();
  f.fault = j["fault"].string();
  f.shapes = j["shapes"].string();
  f.blame = j["blame"].string();
  f.degeneracy = j["degeneracy"].string();
  f.magnitude = j["magnitude"].string();
  f.count = count_of(j["count"]);
  f.worst_in_l = number_from(j["worst_in_l"]);
  f.first_index = count_of(j["first_index"]);
  f.words = j["words"].string();
  if (!has_plain_key(f)) j.fail("the key of a finding cannot name a directory: " + printable(f.key()));
  if (j.has("evidence")) {
    const JsonReader evidence = j["evidence"];
    for (const char* part : parts_of_evidence)
      if (!evidence.has(part)) j.fail("has no evidence: " + std::string(part) + " is missing");
    evidence["observation"].require_object();
    f.evidence_json = evidence.json();
  }
  if (j.has("examples")) f.examples = examples_from_json(j["examples"]);
  return f;
}

namespace {

class NamedDocuments {
 public:
  explicit NamedDocuments(const JsonReader& j) {
    if (!j.has("documents")) return;
    for (const auto& [name, document] : members_of(j["documents"])) documents_.emplace(name, document);
  }
  const Json& at(const JsonReader& name) const { return find(name).json(); }
  /// The document as a case, read once.
  std::shared_ptr<const Case> case_at(const JsonReader& name) {
    auto& c = cases_[name.string()];
    if (!c) {
      const JsonReader& document = find(name);
      c = std::make_shared<const Case>(campaign_case(document.json(), document.place()));
    }
    return c;
  }

 private:
  const JsonReader& find(const JsonReader& name) const {
    const auto document = documents_.find(name.string());
    if (document == documents_.end()) name.fail("names a document that does not exist");
    return document->second;
  }

  std::map<std::string, JsonReader> documents_;
  std::map<std::string, std::shared_ptr<const Case>> cases_;
};

// Puts documents back in place; results of earlier versions already have them there.
void fill_in(Finding& f, const JsonReader& at, const NamedDocuments& documents) {
  for (const char* part : documents_of_evidence)
    if (f.evidence_json.is_object() && f.evidence_json[part].is_string())
      f.evidence_json[part] = documents.at(at["evidence"][part]);
  if (f.evidence_json.is_object() && !f.evidence_json["case"].is_object())
    at["evidence"]["case"].fail("is not a case");
}

// A summary has no documents, and its examples no cases.
void fill_in_examples(Finding& f, const JsonReader& at, NamedDocuments& documents) {
  if (f.examples.empty()) return;
  const auto items = at["examples"].items();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].has("case")) continue;
    Example& e = f.examples[i];
    e.c = documents.case_at(items[i]["case"]);
    if (e.size.bodies != e.c->scene.bodies.size() || e.size.steps != e.c->scene.script.size())
      items[i].fail("is not of the size of its case");
  }
}

// Visits the values stored by engine and question.
template <class Use>
void for_each_question(const JsonReader& j, Use&& use) {
  for (const auto& [engine, questions] : members_of(j)) {
    if (!is_engine_name(engine)) questions.fail("is not the name of an engine");
    for (const auto& [name, value] : members_of(questions)) {
      const auto question = question_from_string(name);
      if (!question) value.fail("is not a question");
      use(engine, *question, value);
    }
  }
}

// Fields that results of earlier versions lack.
void read_later_additions(const JsonReader& j, CampaignResult& r) {
  if (j.has("not_refereed")) r.not_refereed = count_of(j["not_refereed"]);
  if (j.has("levels")) {
    const auto levels = j["levels"].items(r.levels.size());
    for (std::size_t i = 0; i < levels.size(); ++i) r.levels[i] = count_of(levels[i]);
  }
  if (j.has("open"))
    for_each_question(j["open"], [&](const std::string& engine, Question q, const JsonReader& pairs) {
      for (const auto& [shapes, n] : members_of(pairs)) {
        const auto counts = n.items(2);
        r.open[engine][q][printable(shapes)] = {count_of(counts[0]), count_of(counts[1])};
      }
    });
  if (j.has("relations"))
    for (const auto& [engine, of_engine] : members_of(j["relations"]))
      for (const auto& [name, n] : members_of(of_engine))
        r.relations[printable(engine)][printable(name)] = {count_of(n["asked"]), count_of(n["broken"])};
  if (j.has("set_aside"))
    for (const auto& [engine, s] : members_of(j["set_aside"]))
      r.set_aside[printable(engine)] = {count_of(s["first_index"]), s.has("why") ? s["why"].string() : ""};
}

void read_times(const JsonReader& times, CampaignResult& r) {
  r.total_ns = ns_from(times["total_ns"]);
  r.engine_ns = ns_from(times["engine_ns"]);
  r.judge_ns = ns_from(times["judge_ns"]);
  r.pair_asked = count_or_zero(times, "pair_asked");
  if (times.has("pair_cpu_ns")) r.pair_cpu_ns = ns_from(times["pair_cpu_ns"]);
}

}  // namespace

CampaignResult result_from_json(const JsonReader& j) {
  CampaignResult r;
  r.cases = count_of(j["cases"]);
  r.pair_cases = count_of(j["pair_cases"]);
  r.overlapping = count_of(j["overlapping"]);
  r.undecided = count_of(j["undecided"]);
  for (const auto& [family, n] : members_of(j["families"])) r.families[printable(family)] = count_of(n);
  for_each_question(j["engines"], [&](const std::string& engine, Question q, const JsonReader& t) {
    r.tallies[engine][q] = tally_from_json(t);
  });
  read_later_additions(j, r);
  NamedDocuments documents(j);
  for (const auto& [key, f] : members_of(j["findings"])) {
    Finding finding = finding_from_json(f);
    if (finding.key() != key) f.fail("a finding is filed under a key other than its own");
    fill_in(finding, f, documents);
    fill_in_examples(finding, f, documents);
    r.findings.emplace(key, std::move(finding));
  }
  if (j.has("times")) read_times(j["times"], r);
  return r;
}

CampaignResult result_with_evidence(const JsonReader& j) {
  CampaignResult r = result_from_json(j);
  for (const auto& [key, f] : r.findings) {
    if (f.evidence_json.is_null()) j["findings"][key].fail("has no evidence");
    for (const Example& e : f.examples)
      if (!e.c) j["findings"][key]["examples"].fail("has an example without its case");
  }
  return r;
}

}  // namespace touchstone::fuzz
