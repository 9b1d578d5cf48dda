#include "reports/assess/assess.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>
#include <numbers>
#include <set>
#include <thread>

#include "core/base/input_error.h"
#include "core/math/rng.h"
#include "fuzz/judge/judge.h"
#include "oracles/referee/referee.h"
#include "scenarios/value/candidate_pairs.h"

namespace touchstone::fuzz {
namespace {

constexpr std::size_t batch_size = 32;

struct AskedPair {
  std::uint64_t configuration = 0;
  int a = 0, b = 0;
};

bool is_drawn(const ModelJoint& j) {
  const bool has_range = std::isfinite(j.lower) && std::isfinite(j.upper) && j.lower < j.upper;
  return !j.mimic && ((j.type == JointType::hinge) || (j.type == JointType::slide && has_range));
}

Scene scene_at(const Model& model, const Configuration& at) { return scene_of(model, std::span(&at, 1)); }

// The pairs that count whose boxes are at most `near` apart along every axis.
std::vector<BodyPair> near_pairs(const Scene& s, double near) {
  std::vector<BoxedBody> boxed;
  const Vec3 margin = Vec3::Constant(near / 2);
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) {
    Aabb box = referee::outer_box({&s.shape_of(i), s.bodies[static_cast<std::size_t>(i)].pose});
    box.lo -= margin;
    box.hi += margin;
    boxed.push_back({box, i});
  }
  auto pairs = overlapping_boxes(std::move(boxed));
  std::erase_if(pairs, [&](const BodyPair& p) { return !is_reportable(s, p.first, p.second); });
  return pairs;
}

Case case_of(const Scene& scene, const AskedPair& p) {
  Case c;
  c.scene = extract_pair(scene, p.a, p.b);
  c.id = fmt::format("{}/{}/{}-{}", scene.name, p.configuration, p.a, p.b);
  c.queries = {{Question::overlap, 0, 1}, {Question::distance, 0, 1}, {Question::contact, 0, 1}};
  return c;
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
    to.silent += from.silent;
    to.padding = std::max(to.padding, from.padding);
  }
};

class BatchJudge {
 public:
  BatchJudge(std::span<const AskedPair> pairs, std::span<const Case> cases) : pairs_(pairs), cases_(cases) {
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
    measure(i, o, e);
  }

  void measure(std::size_t i, const CaseObservations& o, AssessedEngine& e) {
    const referee::PairTruth& truth = truths_[i].pair(0, 0, 1);
    const Observation &verdict = o.answers[0], &distance = o.answers[1];
    const bool has_distance =
        distance.outcome == Outcome::answered && distance.distance && std::isfinite(*distance.distance);
    if (truth.verdict == referee::Verdict::disjoint && has_distance) {
      const double d = *distance.distance;
      const double error = std::max({truth.gap.lo - d, d - truth.gap.hi, 0.0});
      if (error > e.worst_distance_error) {
        e.worst_distance_error = error;
        const auto& bodies = cases_[i].scene.bodies;
        e.worst_pair = fmt::format("{} and {}, configuration {}", bodies[0].name, bodies[1].name,
                                   pairs_[i].configuration);
      }
    }
    const bool reported = verdict.outcome == Outcome::answered && verdict.overlap.value_or(false);
    if (truth.verdict != referee::Verdict::overlap || reported) return;
    if (has_distance)
      e.padding = std::max(e.padding, *distance.distance);
    else
      ++e.silent;
  }

  std::span<const AskedPair> pairs_;
  std::span<const Case> cases_;
  std::vector<Truth> truths_;
  Part part_;
};

class Assessor {
 public:
  Assessor(const Model& model, const std::vector<Configuration>& configurations,
           const std::vector<AskedPair>& pairs, const AssessProgress& progress, const std::atomic<bool>& stop)
      : model_(model), configurations_(configurations), pairs_(pairs), progress_(progress), stop_(stop) {
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
      progress_(done_, pairs_.size());
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
    for (const AskedPair& p : pairs)
      cases.push_back(case_of(scene_at(model_, configurations_[p.configuration]), p));
    BatchJudge judge(pairs, cases);
    for (const EnginePtr& e : engines) judge.add(*e);
    return judge.take();
  }

  const Model& model_;
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

// At most `most`, evenly spread.
std::vector<AskedPair> thinned(const std::vector<AskedPair>& all, std::uint64_t most) {
  if (all.size() <= most) return all;
  std::vector<AskedPair> some;
  for (std::uint64_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

std::uint64_t possible_pairs(const Scene& s) {
  std::uint64_t n = 0;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
    for (int a = 0; a < b; ++a) n += is_reportable(s, a, b);
  return n;
}

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

std::vector<Configuration> drawn_configurations(const Model& model, const Configuration& standard,
                                                std::uint64_t seed, std::uint64_t count) {
  std::vector<Configuration> all;
  for (std::uint64_t i = 0; i < count; ++i) {
    Rng rng = Rng::stream(seed, i);
    Configuration c = standard;
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const ModelJoint& joint = model.joints[j];
      if (!is_drawn(joint)) continue;
      const bool has_range = std::isfinite(joint.lower) && std::isfinite(joint.upper);
      c[j][0] = has_range ? rng.uniform(joint.lower, joint.upper)
                          : rng.uniform(-std::numbers::pi, std::numbers::pi);
    }
    all.push_back(std::move(c));
  }
  return all;
}

std::vector<std::string> joints_not_drawn(const Model& model) {
  std::vector<std::string> names;
  for (const ModelJoint& j : model.joints)
    if (variable_count(j.type) > 0 && !j.mimic && !is_drawn(j)) names.push_back(j.name);
  return names;
}

Assessment assess(const ImportedModel& robot, const AssessOptions& o, const EnginesOfJob& engines,
                  const AssessProgress& progress, const std::atomic<bool>& stop) {
  Assessment a;
  a.robot = robot.model.name;
  a.seed = o.seed;
  a.near = o.near;
  a.of_trajectory = robot.configurations.size() > 1;
  const std::vector<Configuration> configurations =
      a.of_trajectory ? robot.configurations
                      : drawn_configurations(robot.model, robot.configurations[0], o.seed, o.samples);
  a.configurations = configurations.size();
  std::vector<AskedPair> pairs;
  for (std::size_t i = 0; i < configurations.size() && !stop; ++i) {
    const Scene scene = scene_at(robot.model, configurations[i]);
    if (i == 0) {
      validate(scene);
      a.possible = possible_pairs(scene);
    }
    for (const auto& [x, y] : near_pairs(scene, o.near)) pairs.push_back({i, x, y});
  }
  a.near_pairs = pairs.size();
  pairs = thinned(pairs, o.most_pairs);
  name_engines(a, engines);
  const Part found = Assessor(robot.model, configurations, pairs, progress, stop).run(engines, o.jobs);
  a.interrupted = stop;
  a.asked = found.asked;
  a.overlapping = found.overlapping;
  a.apart = found.apart;
  a.undecided = found.asked - found.overlapping - found.apart;
  for (std::size_t e = 0; e < found.engines.size(); ++e) {
    AssessedEngine& to = a.engines[e];
    const AssessedEngine& from = found.engines[e];
    to.tallies = from.tallies;
    to.worst_distance_error = from.worst_distance_error;
    to.worst_pair = from.worst_pair;
    to.silent = from.silent;
    to.padding = from.padding;
  }
  for (const auto& [configuration, wrong] : found.wrong)
    if (wrong.size() > a.worst_pairs.size()) {
      a.worst_configuration = configuration;
      a.worst_pairs.assign(wrong.begin(), wrong.end());
    }
  return a;
}

}  // namespace touchstone::fuzz
