// The result of a campaign as JSON.
#include <algorithm>
#include <unordered_map>

#include "core/base/exact_text.h"
#include "core/base/hash.h"
#include "reports/record/result.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"

namespace touchstone::fuzz {
Json TimeHistogram::json() const {
  Json j = Json::array();
  for (std::size_t i = 0; i < bucket_.size(); ++i)
    if (bucket_[i] != 0) j.push_back({i, bucket_[i]});
  return j;
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
    j["manifolds_centred"] = t.manifolds_centred;
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

Json examples_json(const Finding& f, Documents& documents) {
  Json all = Json::array();
  for (const Example& e : f.examples) {
    all.push_back(to_json(e));
    if (e.c) all.back()["case"] = documents.name_of(*e.c);
  }
  return all;
}

}  // namespace

Json to_json(const Finding& f) {
  return {{"engine", f.engine},           {"question", f.question}, {"fault", f.fault},
          {"shapes", f.shapes},           {"blame", f.blame},       {"degeneracy", f.degeneracy},
          {"magnitude", f.magnitude},     {"count", f.count},       {"worst_in_l", number(f.worst_in_l)},
          {"first_index", f.first_index}, {"words", f.words}};
}

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

std::string digest(const CampaignResult& r) { return hex64(Hasher().add(to_json(r, false).dump()).value()); }

}  // namespace touchstone::fuzz
