#include "reports/record/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/base/exact_text.h"
#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/text/printable.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::fuzz {
namespace {

constexpr double max_coverage = 10;  // of one manifold, see Tally::coverage_permille

}  // namespace

void TimeHistogram::add(std::int64_t ns) {
  const double octaves = ns <= 1 ? 0 : std::log2(static_cast<double>(ns));
  const auto i = std::min(bucket_.size() - 1, static_cast<std::size_t>(octaves * buckets_per_octave));
  ++bucket_[i];
  ++count_;
}

void TimeHistogram::merge(const TimeHistogram& o) {
  for (std::size_t i = 0; i < bucket_.size(); ++i) bucket_[i] += o.bucket_[i];
  count_ += o.count_;
}

double TimeHistogram::quantile(double q) const {
  if (count_ == 0) return 0;
  const auto rank = static_cast<std::uint64_t>(q * static_cast<double>(count_ - 1));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < bucket_.size(); ++i)
    if ((seen += bucket_[i]) > rank) return std::exp2((static_cast<double>(i) + 0.5) / buckets_per_octave);
  return 0;
}

Json TimeHistogram::json() const {
  Json j = Json::array();
  for (std::size_t i = 0; i < bucket_.size(); ++i)
    if (bucket_[i] != 0) j.push_back({i, bucket_[i]});
  return j;
}

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

std::uint64_t Tally::failed() const {
  std::uint64_t n = 0;
  for (auto c : outcomes) n += c;
  return n - answered() - unsupported() - not_asked();
}

void Tally::add(const Judgement& j, const Observation& o, bool time_includes_pipe) {
  ++outcomes[static_cast<std::size_t>(j.outcome)];
  if (j.outcome != Outcome::answered) return;
  time.add(o.elapsed_ns);
  times_include_pipe |= time_includes_pipe;
  slow += o.slow;
  const Ruling ruling = j.ruling();
  right += ruling == Ruling::right;
  wrong += ruling == Ruling::wrong;
  undecided += ruling == Ruling::undecided;
  not_judged += ruling == Ruling::not_judged;
  by_definition += ruling == Ruling::not_judged && j.unjudged_by_definition();
  within_wide_claim += ruling == Ruling::right && j.wide_claim > 0;
  const auto has = [&](Fault f) {
    return std::any_of(j.faults.begin(), j.faults.end(), [&](const FaultReport& r) { return r.fault == f; });
  };
  missed += has(Fault::missed);
  ghost += has(Fault::ghost);
  representation += j.blame == Blame::representation;
  pairs_true += j.pairs_true;
  pairs_reported += j.pairs_reported;
  pairs_duplicate += j.pairs_duplicate;
  worst_in_l = std::max(worst_in_l, j.worst_in_l);
  if (j.manifold_coverage) {
    ++manifolds;
    coverage_permille +=
        static_cast<std::uint64_t>(1000 * std::min(max_coverage, *j.manifold_coverage) + 0.5);
  }
}

void Tally::merge(const Tally& o) {
  for (std::size_t i = 0; i < outcomes.size(); ++i) outcomes[i] += o.outcomes[i];
  right += o.right;
  wrong += o.wrong;
  undecided += o.undecided;
  not_judged += o.not_judged;
  missed += o.missed;
  ghost += o.ghost;
  representation += o.representation;
  by_definition += o.by_definition;
  within_wide_claim += o.within_wide_claim;
  pairs_true += o.pairs_true;
  pairs_reported += o.pairs_reported;
  pairs_duplicate += o.pairs_duplicate;
  manifolds += o.manifolds;
  coverage_permille += o.coverage_permille;
  worst_in_l = std::max(worst_in_l, o.worst_in_l);
  time.merge(o.time);
  times_include_pipe |= o.times_include_pipe;
  slow += o.slow;
}

std::string Finding::key() const {
  return fmt::format("{}.{}.{}.{}.{}.{}.{}", engine, question, fault, shapes, blame, degeneracy, magnitude);
}

void Finding::merge(const Finding& o) {
  const std::uint64_t both = count + o.count;
  const double worst = std::max(worst_in_l, o.worst_in_l);
  std::vector<Example> shown = std::move(examples);
  shown.insert(shown.end(), o.examples.begin(), o.examples.end());
  if (count == 0 || o.first_index < first_index) *this = o;
  count = both;
  worst_in_l = worst;
  examples = shown.empty() ? std::move(shown) : kept_examples(std::move(shown), key());
}

void CampaignResult::merge(const CampaignResult& o) {
  for (const auto& [engine, questions] : o.tallies)
    for (const auto& [q, t] : questions) tallies[engine][q].merge(t);
  for (const auto& [key, f] : o.findings) findings[key].merge(f);
  for (const auto& [engine, of_engine] : o.relations)
    for (const auto& [name, n] : of_engine) {
      RelationCount& sum = relations[engine][name];
      sum.asked += n.asked;
      sum.broken += n.broken;
    }
  for (const auto& [engine, questions] : o.open)
    for (const auto& [q, pairs] : questions)
      for (const auto& [shapes, n] : pairs) {
        OpenCount& sum = open[engine][q][shapes];
        sum.answers += n.answers;
        sum.open += n.open;
      }
  for (const auto& [engine, s] : o.set_aside)
    if (const auto [at, is_new] = set_aside.emplace(engine, s);
        !is_new && s.first_index < at->second.first_index)
      at->second = s;
  for (const auto& [f, n] : o.families) families[f] += n;
  cases += o.cases;
  pair_cases += o.pair_cases;
  overlapping += o.overlapping;
  not_refereed += o.not_refereed;
  undecided += o.undecided;
  for (std::size_t k = 0; k < levels.size(); ++k) levels[k] += o.levels[k];
  total_ns += o.total_ns;
  engine_ns += o.engine_ns;
  judge_ns += o.judge_ns;
  pair_asked += o.pair_asked;
  pair_cpu_ns += o.pair_cpu_ns;
}

std::uint64_t CampaignResult::wrong_of(const std::string& engine) const {
  std::uint64_t n = 0;
  if (const auto it = tallies.find(engine); it != tallies.end())
    for (const auto& [q, t] : it->second) n += t.wrong;
  if (const auto it = relations.find(engine); it != relations.end())
    for (const auto& [name, count] : it->second) n += count.broken;
  return n;
}

std::uint64_t CampaignResult::failed_of(const std::string& engine) const {
  std::uint64_t n = 0;
  if (const auto it = tallies.find(engine); it != tallies.end())
    for (const auto& [q, t] : it->second) n += t.failed();
  return n;
}

std::uint64_t CampaignResult::answered_by(const std::string& engine) const {
  std::uint64_t n = 0;
  if (const auto it = tallies.find(engine); it != tallies.end())
    for (const auto& [q, t] : it->second) n += t.answered();
  return n;
}

std::uint64_t CampaignResult::by_definition_of(const std::string& engine) const {
  std::uint64_t n = 0;
  if (const auto it = tallies.find(engine); it != tallies.end())
    for (const auto& [q, t] : it->second) n += t.by_definition;
  return n;
}

std::vector<std::string> CampaignResult::too_open(const std::string& engine) const {
  std::vector<std::string> all;
  const auto note = [&](Question q, const std::string& shapes, const OpenCount& n) {
    const double share = n.answers > 0 ? static_cast<double>(n.open) / static_cast<double>(n.answers) : 0;
    if (n.answers < least_answers || share <= most_open) return;
    all.push_back(fmt::format(
        "{}: {} of {} answers to {}{} are undecided or not judged, more than {:.0f} %: "
        "this run proves nothing about them",
        engine, n.open, n.answers, to_string(q), shapes.empty() ? "" : " of " + shapes, 100 * most_open));
  };
  const auto of_engine = open.find(engine);
  if (of_engine == open.end()) return all;
  for (const auto& [q, pairs] : of_engine->second) {
    OpenCount every;
    for (const auto& [shapes, n] : pairs) {
      every.answers += n.answers;
      every.open += n.open;
    }
    note(q, "", every);
    for (const auto& [shapes, n] : pairs) note(q, shapes, n);
  }
  return all;
}

std::uint64_t CampaignResult::not_asked_of(const std::string& engine) const {
  std::uint64_t n = 0;
  if (const auto it = tallies.find(engine); it != tallies.end())
    for (const auto& [q, t] : it->second) n += t.not_asked();
  return n;
}

double number_from(const JsonReader& j) {
  if (j.json().is_number()) return j.number();
  const auto v = double_from_text(j.string());
  if (!v) j.fail("is not a number");
  return *v;
}

namespace {

Json to_json(const Tally& t, bool with_times) {
  Json j;
  for (std::size_t i = 0; i < t.outcomes.size(); ++i)
    j["outcomes"][std::string(outcome_names[i])] = t.outcomes[i];
  j["right"] = t.right;
  j["wrong"] = t.wrong;
  j["missed"] = t.missed;
  j["ghost"] = t.ghost;
  j["representation"] = t.representation;
  j["undecided"] = t.undecided;
  j["not_judged"] = t.not_judged;
  j["by_definition"] = t.by_definition;
  j["within_wide_claim"] = t.within_wide_claim;
  j["pairs_true"] = t.pairs_true;
  j["pairs_reported"] = t.pairs_reported;
  j["pairs_duplicate"] = t.pairs_duplicate;
  if (t.manifolds > 0) {
    j["manifolds"] = t.manifolds;
    j["coverage_permille"] = t.coverage_permille;
  }
  j["worst_in_l"] = number(t.worst_in_l);
  if (with_times) {
    j["ns_median"] = t.time.quantile(0.5);
    j["ns_p99"] = t.time.quantile(tail_quantile);
    j["ns_histogram"] = t.time.json();
    if (t.times_include_pipe) j["times_include_pipe"] = true;
    j["slow"] = t.slow;
  }
  return j;
}

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
  t.worst_in_l = number_from(j["worst_in_l"]);
  t.slow = count_or_zero(j, "slow");
  if (j.has("ns_histogram")) t.time = histogram_from(j["ns_histogram"]);
  if (j.has("times_include_pipe")) t.times_include_pipe = j["times_include_pipe"].boolean();
  return t;
}

}  // namespace

Json to_json(const Finding& f) {
  return {{"engine", f.engine},           {"question", f.question}, {"fault", f.fault},
          {"shapes", f.shapes},           {"blame", f.blame},       {"degeneracy", f.degeneracy},
          {"magnitude", f.magnitude},     {"count", f.count},       {"worst_in_l", number(f.worst_in_l)},
          {"first_index", f.first_index}, {"words", f.words}};
}

namespace {

bool is_key_word(const std::string& s) {
  return !s.empty() && std::all_of(s.begin(), s.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

constexpr std::size_t longest_key = 240;  // a file name may have 255 bytes

constexpr const char* parts_of_evidence[] = {"case", "observation", "certificate", "received"};

}  // namespace

bool has_plain_key(const Finding& f) {
  return is_engine_name(f.engine) && is_key_word(f.question) && is_key_word(f.fault) &&
         is_key_word(f.shapes) && is_key_word(f.blame) && is_key_word(f.degeneracy) &&
         is_key_word(f.magnitude) && f.key().size() <= longest_key;
}

Case campaign_case(const Json& j, const std::string& place) {
  Case c = case_from_json(j, place);
  // The body indices of a question about the whole scene are meaningless and not stored; families use -1.
  for (Query& q : c.queries)
    if (!is_pair_question(q.question)) q.a = q.b = -1;
  return c;
}

std::optional<Finding> finding_of_key(const std::string& engine, const std::string& key) {
  if (!key.starts_with(engine + ".")) return std::nullopt;
  Finding f;
  f.engine = engine;
  std::size_t at = engine.size() + 1;
  for (std::string* part : {&f.question, &f.fault, &f.shapes, &f.blame, &f.degeneracy, &f.magnitude}) {
    const std::size_t dot = std::min(key.find('.', at), key.size());
    *part = key.substr(std::min(at, key.size()), dot - std::min(at, key.size()));
    at = dot + 1;
  }
  return f.key() == key && has_plain_key(f) ? std::optional(f) : std::nullopt;
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

// Stores each case, and each scene as received by an engine, once under its hash, however many findings refer
// to it: one of a recording takes a megabyte.
class Documents {
 public:
  /// Moves the document here and leaves its name in its place.
  void take(Json& document) {
    if (!document.is_object()) return;
    std::string name = hex64(Hasher().add(document.dump()).value());
    stored_.try_emplace(name, std::move(document));
    document = std::move(name);
  }
  /// The name of the case's document.
  const std::string& name_of(const Case& c) {
    std::string& name = names_[&c];
    if (name.empty()) {
      Json document = case_to_json(c);
      take(document);
      name = document.get<std::string>();
    }
    return name;
  }
  Json json() && {
    Json j = Json::object();
    for (auto& [name, document] : stored_) j[name] = std::move(document);
    return j;
  }

 private:
  std::map<std::string, Json> stored_;
  std::unordered_map<const Case*, std::string> names_;
};

constexpr const char* documents_of_evidence[] = {"case", "received"};

Json examples_json(const Finding& f, Documents& documents) {
  Json all = Json::array();
  for (const Example& e : f.examples) {
    all.push_back(to_json(e));
    if (e.c) all.back()["case"] = documents.name_of(*e.c);
  }
  return all;
}

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

}  // namespace

Json to_json(const CampaignResult& r, bool with_times) {
  Json j;
  j["cases"] = r.cases;
  j["pair_cases"] = r.pair_cases;
  j["overlapping"] = r.overlapping;
  j["undecided"] = r.undecided;
  if (r.not_refereed > 0) j["not_refereed"] = r.not_refereed;
  j["levels"] = r.levels;
  j["families"] = r.families;
  j["engines"] = Json::object();
  for (const auto& [engine, questions] : r.tallies)
    for (const auto& [q, t] : questions)
      j["engines"][engine][std::string(to_string(q))] = to_json(t, with_times);
  j["open"] = Json::object();
  for (const auto& [engine, questions] : r.open)
    for (const auto& [q, pairs] : questions)
      for (const auto& [shapes, n] : pairs)
        j["open"][engine][std::string(to_string(q))][shapes] = {n.answers, n.open};
  j["relations"] = Json::object();
  for (const auto& [engine, of_engine] : r.relations)
    for (const auto& [name, n] : of_engine)
      j["relations"][engine][name] = {{"asked", n.asked}, {"broken", n.broken}};
  for (const auto& [engine, s] : r.set_aside) {
    j["set_aside"][engine]["first_index"] = s.first_index;
    // Excluded otherwise: it may contain the last output of a crashed process.
    if (with_times) j["set_aside"][engine]["why"] = s.why;
  }
  Documents documents;
  j["findings"] = Json::object();
  for (const auto& [key, f] : r.findings) {
    Json item = to_json(f), evidence = f.evidence_json;
    for (const char* part : documents_of_evidence)
      if (evidence.contains(part)) documents.take(evidence[part]);
    // The last output of a crashed process may contain addresses: for people, not for comparison.
    if (!with_times && evidence.contains("observation")) evidence["observation"].erase("detail");
    item["evidence"] = std::move(evidence);
    if (!f.examples.empty()) item["examples"] = examples_json(f, documents);
    j["findings"][key] = std::move(item);
  }
  j["documents"] = std::move(documents).json();
  if (with_times)
    j["times"] = {{"total_ns", r.total_ns},
                  {"engine_ns", r.engine_ns},
                  {"judge_ns", r.judge_ns},
                  {"pair_asked", r.pair_asked},
                  {"pair_cpu_ns", r.pair_cpu_ns}};
  return j;
}

namespace {

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

std::string digest(const CampaignResult& r) { return hex64(Hasher().add(to_json(r, false).dump()).value()); }

std::map<std::uint64_t, std::vector<std::string>> keys_by_case(const CampaignResult& r) {
  std::map<std::uint64_t, std::vector<std::string>> keys;
  for (const auto& [key, f] : r.findings)
    for (const Example& e : f.examples) keys[e.index].push_back(key);
  return keys;
}

}  // namespace touchstone::fuzz
