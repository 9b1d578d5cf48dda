#include "reports/assess/assess.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "core/base/input_error.h"
#include "fuzz/judge/judge.h"
#include "oracles/referee/referee.h"

namespace touchstone::fuzz {
namespace {

constexpr std::size_t batch_size = 32;

std::string kinds_of(const Scene& pair) {
  auto a = type_name(pair.shape_of(0)), b = type_name(pair.shape_of(1));
  if (b < a) std::swap(a, b);
  return fmt::format("{}-{}", a, b);
}

// What one job found out about one batch, or about several.
struct Part {
  std::vector<AssessedEngine> engines;
  std::uint64_t asked = 0, overlapping = 0, apart = 0;
  std::map<std::uint64_t, std::set<BodyPair>> wrong;  // by configuration

  void merge(const Part& o) {
    asked += o.asked;
    overlapping += o.overlapping;
    apart += o.apart;
    for (const auto& [configuration, pairs] : o.wrong)
      wrong[configuration].insert(pairs.begin(), pairs.end());
    if (engines.empty()) engines.resize(o.engines.size());
    for (std::size_t e = 0; e < o.engines.size(); ++e) merge(engines[e], o.engines[e]);
  }

 private:
  static void merge(AssessedEngine& to, const AssessedEngine& from) {
    for (const auto& [question, tally] : from.tallies) to.tallies[question].merge(tally);
    if (from.worst_distance_error > to.worst_distance_error) {
      to.worst_distance_error = from.worst_distance_error;
      to.worst_pair = from.worst_pair;
    }
    to.distances_apart += from.distances_apart;
    to.denied += from.denied;
    to.missed += from.missed;
    to.false_alarms += from.false_alarms;
    to.largest_gap = std::max(to.largest_gap, from.largest_gap);
    to.deepest_denied = std::max(to.deepest_denied, from.deepest_denied);
    to.silent += from.silent;
    to.padding = std::max(to.padding, from.padding);
    for (const auto& [kinds, count] : from.unanswered) to.unanswered[kinds] += count;
    to.samples.insert(to.samples.end(), from.samples.begin(), from.samples.end());
    keep_largest(to.samples);
  }
};

class BatchJudge {
 public:
  // `first`: the index of the first of the pairs among all that are asked.
  BatchJudge(double error, std::size_t first, std::span<const AskedPair> pairs, std::span<const Case> cases)
      : error_(error), first_(first), pairs_(pairs), cases_(cases) {
    for (const Case& c : cases) truths_.emplace_back(c.scene);
    part_.asked = cases.size();
    for (Truth& t : truths_) {
      part_.overlapping += t.pair(0, 0, 1).verdict == referee::Verdict::overlap;
      part_.apart += t.pair(0, 0, 1).verdict == referee::Verdict::disjoint;
    }
  }

  void add(Engine& engine) {
    AssessedEngine& e = part_.engines.emplace_back();
    const auto observations = engine.run(cases_);
    for (std::size_t i = 0; i < cases_.size(); ++i) add(engine.card(), i, observations[i], e);
  }
  Part take() { return std::move(part_); }

 private:
  void add(const EngineCard& card, std::size_t i, const CaseObservations& o, AssessedEngine& e) {
    const auto judgements = judge(cases_[i], card, o, truths_[i]);
    for (std::size_t q = 0; q < judgements.size(); ++q) {
      e.tallies[cases_[i].queries[q].question].add(judgements[q], o.answers[q], card.times_include_pipe);
      if (!judgements[q].faults.empty())
        part_.wrong[pairs_[i].configuration].insert({pairs_[i].a, pairs_[i].b});
    }
    measure(i, o, !judgements[1].faults.empty(), e);
  }

  void measure(std::size_t i, const CaseObservations& o, bool distance_is_wrong, AssessedEngine& e) {
    const referee::PairTruth& truth = truths_[i].pair(0, 0, 1);
    const Observation &verdict = o.answers[0], &distance = o.answers[1];
    std::optional<double> stated;
    if (distance.outcome == Outcome::answered && distance.distance && std::isfinite(*distance.distance))
      stated = distance.distance;
    if (truth.verdict == referee::Verdict::disjoint && stated)
      add_error(i, truth, *stated, distance_is_wrong, e);
    const bool answered = verdict.outcome == Outcome::answered && verdict.overlap;
    if (!answered) ++e.unanswered[kinds_of(cases_[i].scene)];
    if (truth.verdict == referee::Verdict::overlap && answered && !*verdict.overlap)
      add_denied(i, truth, stated, e);
    if (truth.verdict == referee::Verdict::disjoint && answered && *verdict.overlap)
      add_false_alarm(i, truth.gap.lo, e);
    keep_largest(e.samples);
  }

  void add_false_alarm(std::size_t i, double gap, AssessedEngine& e) {
    if (gap <= error_) return;
    ++e.false_alarms;
    e.largest_gap = std::max(e.largest_gap, gap);
    add_sample(AssessedSample::Kind::false_alarm, i, gap, e);
  }

  void add_sample(AssessedSample::Kind kind, std::size_t i, double size, AssessedEngine& e) {
    const AskedPair& p = pairs_[i];
    e.samples.push_back({kind, first_ + i, p.configuration, p.a, p.b, size});
  }

  void add_error(std::size_t i, const referee::PairTruth& truth, double d, bool is_wrong, AssessedEngine& e) {
    ++e.distances_apart;
    const double error = std::max({truth.gap.lo - d, d - truth.gap.hi, 0.0});
    if (is_wrong || error > error_) add_sample(AssessedSample::Kind::distance, i, error, e);
    if (error <= e.worst_distance_error) return;
    e.worst_distance_error = error;
    const auto& bodies = cases_[i].scene.bodies;
    e.worst_pair =
        fmt::format("{} and {}, configuration {}", bodies[0].name, bodies[1].name, pairs_[i].configuration);
  }

  void add_denied(std::size_t i, const referee::PairTruth& truth, const std::optional<double>& stated,
                  AssessedEngine& e) {
    ++e.denied;
    const double depth = std::isfinite(truth.gap.lo) ? std::max(0.0, -truth.gap.hi) : 0;
    const bool counts = !std::isfinite(truth.gap.lo) || depth > error_;
    e.missed += counts;
    if (counts) add_sample(AssessedSample::Kind::missed, i, depth, e);
    e.deepest_denied = std::max(e.deepest_denied, depth);
    if (stated)
      e.padding = std::max(e.padding, *stated);
    else
      ++e.silent;
  }

  double error_;  // of a distance that is accepted
  std::size_t first_;
  std::span<const AskedPair> pairs_;
  std::span<const Case> cases_;
  std::vector<Truth> truths_;
  Part part_;
};

class Assessor {
 public:
  Assessor(const Model& model, const Scene& scene, double error,
           const std::vector<Configuration>& configurations, const std::vector<AskedPair>& pairs,
           const AssessProgress& progress, const std::atomic<bool>& stop)
      : model_(model),
        scene_(scene),
        error_(error),
        configurations_(configurations),
        pairs_(pairs),
        progress_(progress),
        stop_(stop) {
    parts_.resize((pairs.size() + batch_size - 1) / batch_size);
  }

  Part run(const EnginesOfJob& engines, int jobs) {
    std::vector<std::thread> threads;
    for (int j = 0; j < jobs; ++j) threads.emplace_back([&] { work(engines); });
    for (std::thread& t : threads) t.join();
    if (failure_) std::rethrow_exception(failure_);
    Part all;
    for (const std::optional<Part>& p : parts_)
      if (p) all.merge(*p);
    return all;
  }

 private:
  void work(const EnginesOfJob& make) try {
    const std::vector<EnginePtr> engines = make();
    for (std::size_t b = next_++; b < parts_.size() && !stop_ && !failed_; b = next_++) {
      parts_[b] = ask(b, engines);
      const std::scoped_lock lock(mutex_);
      done_ += parts_[b]->asked;
      progress_("pairs", done_, pairs_.size());
    }
  } catch (...) {
    const std::scoped_lock lock(mutex_);
    if (!failure_ && !stop_) failure_ = std::current_exception();
    failed_ = true;
  }

  Part ask(std::size_t batch, const std::vector<EnginePtr>& engines) const {
    const std::size_t first = batch * batch_size;
    const auto pairs = std::span(pairs_).subspan(first, std::min(batch_size, pairs_.size() - first));
    std::vector<Case> cases;
    Scene scene = scene_;
    for (const AskedPair& p : pairs) {
      place_bodies(model_, configurations_[p.configuration], scene);
      cases.push_back(case_of_pair(scene, p));
    }
    BatchJudge judge(error_, first, pairs, cases);
    for (const EnginePtr& e : engines) judge.add(*e);
    return judge.take();
  }

  const Model& model_;
  const Scene& scene_;
  double error_;
  const std::vector<Configuration>& configurations_;
  const std::vector<AskedPair>& pairs_;
  const AssessProgress& progress_;
  const std::atomic<bool>& stop_;
  std::vector<std::optional<Part>> parts_;  // by batch
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::uint64_t done_ = 0;
  std::exception_ptr failure_;
};

void name_engines(Assessment& a, const EnginesOfJob& make) {
  const std::vector<EnginePtr> engines = make();
  a.engines.resize(engines.size());
  for (std::size_t i = 0; i < engines.size(); ++i) {
    const EngineCard& card = engines[i]->card();
    a.engines[i].name = card.name;
    a.engines[i].library = card.library;
    a.engines[i].version = card.version;
    a.engines[i].settings = card.settings;
  }
}

}  // namespace

Case case_of_pair(const Scene& scene, const AskedPair& p) {
  Case c;
  c.scene = extract_pair(scene, p.a, p.b);
  c.id = fmt::format("{}/{}/{}-{}", scene.name, p.configuration, p.a, p.b);
  c.queries = {{Question::overlap, 0, 1}, {Question::distance, 0, 1}, {Question::contact, 0, 1}};
  return c;
}

std::vector<Configuration> asked_configurations(const ImportedModel& robot, const AssessOptions& o) {
  return robot.configurations.size() > 1
             ? robot.configurations
             : drawn_configurations(robot.model, robot.configurations[0], o.seed, o.samples);
}

Assessment assess(const ImportedModel& robot, const AssessOptions& o, const EnginesOfJob& engines,
                  const AssessProgress& progress, const std::atomic<bool>& stop) {
  Assessment a;
  a.robot = robot.model.name;
  a.seed = o.seed;
  a.near = o.near;
  a.error = o.error;
  a.of_trajectory = robot.configurations.size() > 1;
  const std::vector<Configuration> configurations = asked_configurations(robot, o);
  a.configurations = configurations.size();
  Scene scene = scene_of(robot.model, std::span(configurations).first(1));
  validate(scene);
  a.possible = possible_pairs(scene);
  const auto near = near_pairs(
      robot.model, scene, configurations, o.near,
      [&](std::uint64_t done, std::uint64_t of) { progress("configurations", done, of); }, stop);
  a.near_pairs = near.size();
  const auto pairs = thinned(near, o.most_pairs);
  name_engines(a, engines);
  const Part found =
      Assessor(robot.model, scene, o.error, configurations, pairs, progress, stop).run(engines, o.jobs);
  a.interrupted = stop;
  a.asked = found.asked;
  a.overlapping = found.overlapping;
  a.apart = found.apart;
  a.undecided = found.asked - found.overlapping - found.apart;
  for (std::size_t e = 0; e < found.engines.size(); ++e) {
    AssessedEngine named = found.engines[e];
    named.name = a.engines[e].name;
    named.library = a.engines[e].library;
    named.version = a.engines[e].version;
    named.settings = a.engines[e].settings;
    a.engines[e] = std::move(named);
  }
  for (const auto& [configuration, wrong] : found.wrong)
    if (wrong.size() > a.worst_pairs.size()) {
      a.worst_configuration = configuration;
      a.worst_pairs.assign(wrong.begin(), wrong.end());
    }
  return a;
}

}  // namespace touchstone::fuzz
