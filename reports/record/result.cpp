#include "reports/record/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace touchstone::fuzz {
namespace {}  // namespace

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
    coverage_permille += static_cast<std::uint64_t>(1000 * *j.manifold_coverage + 0.5);
    manifolds_centred += j.manifold_centred.value_or(false);
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
  manifolds_centred += o.manifolds_centred;
  worst_in_l = std::max(worst_in_l, o.worst_in_l);
  time.merge(o.time);
  times_include_pipe |= o.times_include_pipe;
  slow += o.slow;
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

std::map<std::uint64_t, std::vector<std::string>> keys_by_case(const CampaignResult& r) {
  std::map<std::uint64_t, std::vector<std::string>> keys;
  for (const auto& [key, f] : r.findings)
    for (const Example& e : f.examples) keys[e.index].push_back(key);
  return keys;
}

}  // namespace touchstone::fuzz
