#include "fuzz/record/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/exact_text.h"
#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "core/base/printable.h"
#include "oracles/api/engine_name.h"
#include "scenarios/case_codec.h"

namespace touchstone::fuzz {

void TimeHistogram::add(std::int64_t ns) {
  const double octaves = ns <= 1 ? 0 : std::log2(static_cast<double>(ns));
  const auto i = std::min(bucket_.size() - 1, static_cast<std::size_t>(octaves * 8));
  ++bucket_[i], ++count_;
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
    if ((seen += bucket_[i]) > rank) return std::exp2((static_cast<double>(i) + 0.5) / 8);
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
  for (const Json& e : j) {
    const auto i = e.at(0).get<std::size_t>();
    if (i >= h.bucket_.size()) throw InputError("time histogram", "bucket out of range");
    h.count_ += h.bucket_[i] = e.at(1).get<std::uint64_t>();
  }
  return h;
}

std::uint64_t Tally::failed() const {
  std::uint64_t n = 0;
  for (auto c : outcomes) n += c;
  return n - answered() - unsupported() - not_asked();
}

void Tally::add(const Judgement& j, const Observation& o) {
  ++outcomes[static_cast<std::size_t>(j.outcome)];
  if (j.outcome != Outcome::answered) return;
  time.add(o.elapsed_ns);
  slow += o.slow;
  const Ruling ruling = j.ruling();
  right += ruling == Ruling::right, wrong += ruling == Ruling::wrong;
  undecided += ruling == Ruling::undecided, not_judged += ruling == Ruling::not_judged;
  by_definition += ruling == Ruling::not_judged && j.unjudged_by_definition();
  within_wide_claim += ruling == Ruling::right && j.wide_claim > 0;
  const auto has = [&](Fault f) {
    return std::any_of(j.faults.begin(), j.faults.end(), [&](const FaultReport& r) { return r.fault == f; });
  };
  missed += has(Fault::missed), ghost += has(Fault::ghost);
  representation += j.blame == Blame::representation;
  pairs_true += j.pairs_true, pairs_reported += j.pairs_reported, pairs_duplicate += j.pairs_duplicate;
  worst_in_l = std::max(worst_in_l, j.worst_in_l);
  if (j.manifold_coverage)
    ++manifolds,
        coverage_permille += static_cast<std::uint64_t>(1000 * std::min(10.0, *j.manifold_coverage) + 0.5);
}

void Tally::merge(const Tally& o) {
  for (std::size_t i = 0; i < outcomes.size(); ++i) outcomes[i] += o.outcomes[i];
  right += o.right, wrong += o.wrong, undecided += o.undecided, not_judged += o.not_judged;
  missed += o.missed, ghost += o.ghost, representation += o.representation;
  by_definition += o.by_definition, within_wide_claim += o.within_wide_claim;
  pairs_true += o.pairs_true, pairs_reported += o.pairs_reported, pairs_duplicate += o.pairs_duplicate;
  manifolds += o.manifolds, coverage_permille += o.coverage_permille;
  worst_in_l = std::max(worst_in_l, o.worst_in_l);
  time.merge(o.time);
  slow += o.slow;
}

std::string Finding::key() const {
  return fmt::format("{}.{}.{}.{}.{}.{}.{}", engine, question, fault, shapes, blame, degeneracy, magnitude);
}

Json Finding::evidence_json() const { return evidence ? evidence->json() : stored; }

void Finding::merge(const Finding& o) {
  const std::uint64_t both = count + o.count;
  const double worst = std::max(worst_in_l, o.worst_in_l);
  if (count == 0 || o.first_index < first_index) *this = o;
  count = both, worst_in_l = worst;
}

void CampaignResult::merge(const CampaignResult& o) {
  for (const auto& [engine, questions] : o.tallies)
    for (const auto& [q, t] : questions) tallies[engine][q].merge(t);
  for (const auto& [key, f] : o.findings) findings[key].merge(f);
  for (const auto& [engine, of_engine] : o.relations)
    for (const auto& [name, n] : of_engine) {
      RelationCount& sum = relations[engine][name];
      sum.asked += n.asked, sum.broken += n.broken;
    }
  for (const auto& [engine, questions] : o.open)
    for (const auto& [q, pairs] : questions)
      for (const auto& [shapes, n] : pairs) {
        OpenCount& sum = open[engine][q][shapes];
        sum.answers += n.answers, sum.open += n.open;
      }
  for (const auto& [engine, s] : o.set_aside)
    if (const auto [at, is_new] = set_aside.emplace(engine, s);
        !is_new && s.first_index < at->second.first_index)
      at->second = s;
  for (const auto& [f, n] : o.families) families[f] += n;
  cases += o.cases, pair_cases += o.pair_cases, overlapping += o.overlapping, undecided += o.undecided;
  for (std::size_t k = 0; k < levels.size(); ++k) levels[k] += o.levels[k];
  total_ns += o.total_ns, engine_ns += o.engine_ns, judge_ns += o.judge_ns;
  pair_asked += o.pair_asked, pair_cpu_ns += o.pair_cpu_ns;
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
        "{}: {} of {} answers to {}{} undecided or not judged, more than {:.0f} %: "
        "this run proves nothing of them",
        engine, n.open, n.answers, to_string(q), shapes.empty() ? "" : " of " + shapes, 100 * most_open));
  };
  const auto of_engine = open.find(engine);
  if (of_engine == open.end()) return all;
  for (const auto& [q, pairs] : of_engine->second) {
    OpenCount every;
    for (const auto& [shapes, n] : pairs) every.answers += n.answers, every.open += n.open;
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

namespace {

Json to_json(const Tally& t, bool with_times) {
  Json j;
  for (std::size_t i = 0; i < t.outcomes.size(); ++i)
    j["outcomes"][std::string(outcome_names[i])] = t.outcomes[i];
  j["right"] = t.right, j["wrong"] = t.wrong, j["missed"] = t.missed, j["ghost"] = t.ghost;
  j["representation"] = t.representation, j["undecided"] = t.undecided;
  j["not_judged"] = t.not_judged, j["by_definition"] = t.by_definition;
  j["within_wide_claim"] = t.within_wide_claim;
  j["pairs_true"] = t.pairs_true, j["pairs_reported"] = t.pairs_reported,
  j["pairs_duplicate"] = t.pairs_duplicate;
  if (t.manifolds > 0) {
    j["manifolds"] = t.manifolds;
    j["coverage_permille"] = t.coverage_permille;
  }
  j["worst_in_l"] = number(t.worst_in_l);
  if (with_times) {
    j["ns_median"] = t.time.quantile(0.5), j["ns_p99"] = t.time.quantile(0.99);
    j["ns_histogram"] = t.time.json();
    j["slow"] = t.slow;
  }
  return j;
}

double number_from(const Json& j) {
  if (j.is_number()) return j.get<double>();
  const auto v = double_from_text(j.get<std::string>());
  return v ? *v : std::numeric_limits<double>::quiet_NaN();
}

Tally tally_from_json(const Json& j) {
  Tally t;
  for (std::size_t i = 0; i < t.outcomes.size(); ++i)
    t.outcomes[i] = j.at("outcomes").value(std::string(outcome_names[i]), std::uint64_t{0});
  t.right = j.at("right"), t.wrong = j.at("wrong"), t.missed = j.at("missed"), t.ghost = j.at("ghost");
  t.representation = j.at("representation"), t.undecided = j.at("undecided");
  constexpr std::uint64_t none = 0;  // absent from results of earlier versions
  t.not_judged = j.value("not_judged", none), t.by_definition = j.value("by_definition", none);
  t.within_wide_claim = j.value("within_wide_claim", none);
  t.pairs_true = j.at("pairs_true"), t.pairs_reported = j.at("pairs_reported");
  t.pairs_duplicate = j.at("pairs_duplicate");
  t.manifolds = j.value("manifolds", std::uint64_t{0});
  t.coverage_permille = j.value("coverage_permille", std::uint64_t{0});
  t.worst_in_l = number_from(j.at("worst_in_l"));
  t.slow = j.value("slow", std::uint64_t{0});
  if (j.contains("ns_histogram")) t.time = TimeHistogram::from_json(j.at("ns_histogram"));
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

// Directories are named by keys: nothing but the name of an engine and words of our own, no longer than a name may be.
void require_plain_key(const Finding& f) {
  constexpr std::size_t longest = 240;
  const auto is_word = [](const std::string& s) {
    return !s.empty() && std::all_of(s.begin(), s.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
  };
  if (!is_engine_name(f.engine) || !is_word(f.question) || !is_word(f.fault) || !is_word(f.shapes) ||
      !is_word(f.blame) || !is_word(f.degeneracy) || !is_word(f.magnitude) || f.key().size() > longest)
    throw InputError("stored result", "a finding's key may not name a directory: " + printable(f.key()));
}

}  // namespace

Finding finding_from_json(const Json& j) {
  Finding f;
  f.engine = j.at("engine"), f.question = j.at("question"), f.fault = j.at("fault"),
  f.shapes = j.at("shapes"), f.degeneracy = j.at("degeneracy"), f.magnitude = j.at("magnitude");
  f.blame = j.at("blame"), f.count = j.at("count"), f.worst_in_l = number_from(j.at("worst_in_l"));
  f.first_index = j.at("first_index"), f.words = j.at("words");
  if (j.contains("evidence")) f.stored = j.at("evidence");
  require_plain_key(f);
  return f;
}

namespace {

// A case, and a scene as an engine received it, is stored once, by its hash, however many findings it shows:
// that of a recording has a megabyte.
class Documents {
 public:
  /// Moved here; its name stays in its place.
  void take(Json& document) {
    if (!document.is_object()) return;
    std::string name = hex64(Hasher().add(document.dump()).value());
    stored_.try_emplace(name, std::move(document));
    document = std::move(name);
  }
  Json json() && {
    Json j = Json::object();
    for (auto& [name, document] : stored_) j[name] = std::move(document);
    return j;
  }

 private:
  std::map<std::string, Json> stored_;
};

constexpr const char* documents_of_evidence[] = {"case", "received"};

// Puts documents back; results of earlier versions hold them in place.
void fill_in(Json& evidence, const std::map<std::string, const Json*>& documents) {
  for (const char* part : documents_of_evidence) {
    if (!evidence.is_object() || !evidence.contains(part) || !evidence[part].is_string()) continue;
    const auto name = evidence[part].get<std::string>();
    const auto document = documents.find(name);
    if (document == documents.end())
      throw InputError("stored result", "documents: " + name + " is not there");
    evidence[part] = *document->second;
  }
}

}  // namespace

Json to_json(const CampaignResult& r, bool with_times) {
  Json j;
  j["cases"] = r.cases, j["pair_cases"] = r.pair_cases, j["overlapping"] = r.overlapping;
  j["undecided"] = r.undecided, j["levels"] = r.levels;
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
    // What a dying process last said may be in it.
    if (with_times) j["set_aside"][engine]["why"] = s.why;
  }
  Documents documents;
  j["findings"] = Json::object();
  for (const auto& [key, f] : r.findings) {
    Json item = to_json(f), evidence = f.evidence_json();
    for (const char* part : documents_of_evidence)
      if (evidence.contains(part)) documents.take(evidence[part]);
    // What a dying process last said may name addresses: for people, not for comparison.
    if (!with_times && evidence.contains("observation")) evidence["observation"].erase("detail");
    item["evidence"] = std::move(evidence);
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

CampaignResult result_from_json(const Json& j) try {
  CampaignResult r;
  r.cases = j.at("cases"), r.pair_cases = j.at("pair_cases"), r.overlapping = j.at("overlapping");
  r.undecided = j.at("undecided");
  if (j.contains("levels")) r.levels = j["levels"];  // absent from results of earlier versions
  for (const auto& [f, n] : j.at("families").items()) r.families[f] = n;
  for (const auto& [engine, questions] : j.at("engines").items())
    for (const auto& [q, t] : questions.items()) {
      const auto question = question_from_string(q);
      if (!question) throw InputError("engines." + engine, "unknown question " + q);
      r.tallies[engine][*question] = tally_from_json(t);
    }
  if (j.contains("open"))  // absent from results of earlier versions
    for (const auto& [engine, questions] : j["open"].items())
      for (const auto& [q, pairs] : questions.items()) {
        const auto question = question_from_string(q);
        if (!question) throw InputError("open." + engine, "unknown question " + q);
        for (const auto& [shapes, n] : pairs.items()) r.open[engine][*question][shapes] = {n.at(0), n.at(1)};
      }
  if (j.contains("relations"))  // absent from results of earlier versions
    for (const auto& [engine, of_engine] : j["relations"].items())
      for (const auto& [name, n] : of_engine.items())
        r.relations[engine][name] = {n.at("asked"), n.at("broken")};
  if (j.contains("set_aside"))  // only where there are any
    for (const auto& [engine, s] : j["set_aside"].items())
      r.set_aside[engine] = {s.at("first_index"), s.value("why", "")};
  std::map<std::string, const Json*> documents;
  if (j.contains("documents"))
    for (const auto& [name, document] : j["documents"].items()) documents[name] = &document;
  for (const auto& [key, f] : j.at("findings").items()) {
    Finding& finding = r.findings[key] = finding_from_json(f);
    if (finding.key() != key)
      throw InputError("stored result", "a finding is filed under another key than its own: " + printable(key));
    fill_in(finding.stored, documents);
  }
  if (j.contains("times")) {
    r.total_ns = j["times"].at("total_ns"), r.engine_ns = j["times"].at("engine_ns");
    r.judge_ns = j["times"].at("judge_ns");
    r.pair_asked = j["times"].value("pair_asked", std::uint64_t{0});
    r.pair_cpu_ns = j["times"].value("pair_cpu_ns", std::int64_t{0});
  }
  return r;
} catch (const Json::exception& e) {
  throw InputError("stored result", e.what());
}

std::string digest(const CampaignResult& r) { return hex64(Hasher().add(to_json(r, false).dump()).value()); }

}  // namespace touchstone::fuzz
