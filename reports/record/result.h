// The results of a campaign: counts, times and findings. Plain values whose merge does not depend on the
// order.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/outcome.h"
#include "reports/record/examples.h"
#include "reports/record/observation_json.h"
#include "scenarios/value/case.h"
#include "scenarios/value/engine_card.h"
#include "scenarios/value/judgement.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

/// As values; fuzz/ask/evidence.h writes them as JSON, with a certificate that `touchstone check` verifies.
struct Evidence {
  Case c;
  Observation observation;
  ReceivedScene received;
  Certificate certificate;
  int a = -1, b = -1;  // bodies A and B of the certificate; a < 0: it is not about a pair
  int step = -1;       // >= 0: poses at that query of the script; < 0: the bodies' own
  Question question = Question::overlap;
};

/// The fault without the site that a failure is named by: "crashed" of "crashed_distance-inl-h-177". A site
/// has a line number or a function's name, so the next version of an engine crashes at "another" site.
constexpr std::string_view kind_of_fault(std::string_view fault) {
  for (const std::string_view outcome : outcome_names)
    if (fault.size() > outcome.size() && fault.starts_with(outcome) && fault[outcome.size()] == '_')
      return outcome;
  return fault;
}

/// "box-sphere", in alphabetical order; "scene" when a and b name no bodies.
inline std::string shapes_of(const Case& c, int a, int b) {
  const int n = static_cast<int>(c.scene.bodies.size());
  if (a < 0 || b < 0 || a >= n || b >= n) return "scene";
  auto x = type_name(c.scene.shape_of(a)), y = type_name(c.scene.shape_of(b));
  if (y < x) std::swap(x, y);
  return std::string(x) + "-" + std::string(y);
}

inline constexpr double tail_quantile = 0.99;  // printed and stored as p99

/// Times on a logarithmic scale with 8 buckets per octave (9 % wide), so that percentiles merge exactly.
class TimeHistogram {
 public:
  void add(std::int64_t ns);
  void merge(const TimeHistogram& o);
  /// The q-quantile in ns, 0 when empty; accurate to half a bucket (5 %).
  double quantile(double q) const;
  std::uint64_t count() const { return count_; }
  Json json() const;
  static TimeHistogram from_json(const Json& j);

 private:
  static constexpr int buckets_per_octave = 8;
  std::array<std::uint64_t, 40 * buckets_per_octave> bucket_{};
  std::uint64_t count_ = 0;
};

/// Counts for one engine and one question.
struct Tally {
  std::array<std::uint64_t, outcome_names.size()> outcomes{};  // by Outcome
  /// Each answered query is right, wrong, undecided or not judged (scenarios/value/judgement.h). The second
  /// line counts subsets: of the wrong, `missed`, `ghost`, and `representation` (right for the scene as
  /// received); of the not judged, those `by_definition`; of the right, those with a claimed tolerance above
  /// `wide_claim` of L.
  std::uint64_t right = 0, wrong = 0, undecided = 0, not_judged = 0;
  std::uint64_t missed = 0, ghost = 0, representation = 0, by_definition = 0, within_wide_claim = 0;
  std::uint64_t pairs_true = 0, pairs_reported = 0, pairs_duplicate = 0;
  /// Manifolds whose true region is a face or an edge, the sum of their coverages in thousandths, and how
  /// many have the region's centroid among their points. Integers, so that the order of summation does not
  /// matter.
  std::uint64_t manifolds = 0, coverage_permille = 0, manifolds_centred = 0;
  double worst_in_l = 0;
  std::uint64_t slow = 0;           // answered, but beyond the time limit; never hashed
  TimeHistogram time;               // of answered queries; never hashed
  bool times_include_pipe = false;  // they are not the engine's alone; never hashed

  std::uint64_t answered() const { return outcomes[static_cast<std::size_t>(Outcome::answered)]; }
  std::uint64_t unsupported() const { return outcomes[static_cast<std::size_t>(Outcome::unsupported)]; }
  std::uint64_t not_asked() const { return outcomes[static_cast<std::size_t>(Outcome::not_asked)]; }
  std::uint64_t failed() const;  // queried, but neither answered nor unsupported
  void add(const Judgement& j, const Observation& o, bool time_includes_pipe = false);
  void merge(const Tally& o);
};

/// Instead of shapes, in findings of failures whose place in the code is known (fuzz/ask): one kind of
/// finding, wherever it was met.
inline constexpr std::string_view any_shapes = "any";

/// One kind of wrong answer: the same engine (whose name includes its path), question, fault, shapes, blame,
/// degeneracy (degeneracy.h) and magnitude of the error (magnitude.h). Keeps the evidence of its first case,
/// and some cases as examples.
struct Finding {
  std::string engine, question, fault, shapes, blame, degeneracy, magnitude;
  std::uint64_t count = 0;
  double worst_in_l = 0;
  std::uint64_t first_index = 0;
  std::string words;
  std::shared_ptr<const Evidence> evidence;  // of the first case; empty when read back from disk
  /// The evidence as JSON: {"case", "observation", "certificate", "received"}; null until write_evidence
  /// (fuzz/ask/evidence.h) has filled it in.
  Json evidence_json;
  /// Of all cases that show it (kept_examples), sorted by index. Empty in results of earlier versions.
  std::vector<Example> examples;
  std::string key() const;
  void merge(const Finding& o);
};
Json to_json(const Finding& f);  // without evidence and examples

/// Answers to one question about one kind of pair, and how many of them the judge left open: undecided, or
/// not judged for a reason other than by definition.
struct OpenCount {
  std::uint64_t answers = 0, open = 0;
};
/// A campaign proves nothing about a question for a kind of pair (or for all kinds) if, of at least
/// `least_answers` answers, a share above `most_open` is open.
inline constexpr double most_open = 0.25;
inline constexpr std::uint64_t least_answers = 12;

struct CampaignResult {
  std::map<std::string, std::map<Question, Tally>> tallies;  // by engine
  std::map<std::string, Finding> findings;                   // by key
  /// Relations (fuzz/judge/relation.h) by engine and name: the derived cases that were run, and how many of
  /// them contradict the engine's answer to the original.
  struct RelationCount {
    std::uint64_t asked = 0, broken = 0;
  };
  std::map<std::string, std::map<std::string, RelationCount>> relations;
  /// By engine, question and kinds of shapes.
  std::map<std::string, std::map<Question, std::map<std::string, OpenCount>>> open;
  /// Engines that are no longer queried, with the index of the first case of the chunk in which that began.
  struct SetAside {
    std::uint64_t first_index = 0;
    std::string why;
  };
  std::map<std::string, SetAside> set_aside;
  std::uint64_t cases = 0, pair_cases = 0,
                overlapping = 0;  // pair cases with a decided verdict, and how many overlap
  std::uint64_t undecided = 0;
  std::uint64_t not_refereed = 0;         // cases that no engine answers
  std::array<std::uint64_t, 3> levels{};  // decided discrete pairs by referee::PairTruth::level
  std::map<std::string, std::uint64_t> families;
  // Times, never hashed: the total of all jobs, and the shares of the engines and of referee and judge.
  std::int64_t total_ns = 0, engine_ns = 0, judge_ns = 0;
  /// Cases about overlap, distance or contact of a pair, and the CPU time that the harness's threads and the
  /// engines spent on them, without other cases and relations.
  std::uint64_t pair_asked = 0;
  std::int64_t pair_cpu_ns = 0;

  void merge(const CampaignResult& o);
  double hit_rate() const {
    return pair_cases == 0 ? 0 : static_cast<double>(overlapping) / static_cast<double>(pair_cases);
  }
  /// Pair cases per core-second, 0 when there are none.
  double pair_rate() const {
    constexpr double ns_per_second = 1e9;  // exact
    return pair_cpu_ns > 0
               ? ns_per_second * static_cast<double>(pair_asked) / static_cast<double>(pair_cpu_ns)
               : 0;
  }
  /// Wrong or failed answers of one engine; broken relations are wrong.
  std::uint64_t wrong_of(const std::string& engine) const;
  std::uint64_t failed_of(const std::string& engine) const;
  std::uint64_t answered_by(const std::string& engine) const;
  /// Answers of one engine that by definition are not judged.
  std::uint64_t by_definition_of(const std::string& engine) const;
  /// One sentence for each question and kind of pair about which the campaign proves nothing.
  std::vector<std::string> too_open(const std::string& engine) const;
  std::uint64_t not_asked_of(const std::string& engine) const;
};

/// The whole result, or with `with_times` false the part that the same seed must reproduce byte for byte.
Json to_json(const CampaignResult& r, bool with_times);
/// Hash of the reproducible part.
std::string digest(const CampaignResult& r);

/// By index of a case: the keys of the findings that it is an example of, sorted.
std::map<std::uint64_t, std::vector<std::string>> keys_by_case(const CampaignResult& r);

}  // namespace touchstone::fuzz
