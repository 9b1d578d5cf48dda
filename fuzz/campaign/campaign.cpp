#include "fuzz/campaign/campaign.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "core/base/input_error.h"
#include "core/math/rng.h"
#include "fuzz/ask/evidence.h"
#include "fuzz/campaign/answers_file.h"
#include "fuzz/campaign/directory_lock.h"
#include "fuzz/campaign/store.h"
#include "oracles/abi/measure.h"
#include "oracles/client/worker_limits.h"
#include "scenarios/random/family.h"

namespace touchstone::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

// A job takes one chunk at a time; a chunk is also one batch on a worker's pipe.
constexpr std::uint64_t chunk_cases = 32;

// A guided campaign draws from the pool as it was before the current generation, so the result does not
// depend on which job was faster. Jobs synchronise once per generation.
constexpr std::uint64_t generation_chunks = 16;

// Bounds the work lost when a campaign is killed. Saving takes at most a twentieth of the time; early states
// are small.
constexpr double min_save_interval_s = 0.25, save_interval_per_cost = 20;

constexpr double report_interval_s = 0.5;

double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

// Processes chunks in any order but merges them in order, so the stored state is always a prefix of the
// campaign.
class Runner {
 public:
  Runner(const CampaignConfig& config, const EngineFactory& factory, const ProgressCallback& progress,
         const std::atomic<bool>& stop)
      : config_(config), factory_(factory), progress_(progress), stop_(stop) {}

  CampaignResult run() {
    prepare();
    std::vector<std::thread> threads;
    for (int i = 0; i < std::max(1, config_.jobs); ++i) threads.emplace_back([this] { run_job(); });
    for (auto& t : threads) t.join();
    if (error_) std::rethrow_exception(error_);
    state_.finished = ended();
    if (!config_.out.empty()) {
      save_findings(config_.out, state_.result);
      save_state(config_, state_);
    }
    report(true);
    return std::move(state_.result);
  }

 private:
  void prepare() {
    if (config_.keep_answers && config_.out.empty())
      throw InputError("--keep-answers", "needs a directory for the results");
    if (!config_.out.empty()) {
      make_directory(config_.out);
      lock_.emplace(config_.out, DirectoryLock::For::writing);
      if (config_.fresh && move_aside(config_.out)) {
        make_directory(config_.out);
        lock_.emplace(config_.out, DirectoryLock::For::writing);
      }
      if (auto s = load_state(config_)) state_ = std::move(*s);
      if (config_.keep_answers) answers_.emplace(config_.out, state_.answers_bytes);
      save_state(config_, state_);
    }
    next_ = merged_ = state_.next_chunk;
    resumed_cases_ = state_.result.cases;
  }

  // Chunk k of this shard is chunk k·shards + shard of the campaign.
  std::uint64_t first_case(std::uint64_t k) const {
    return (k * config_.shards + config_.shard) * chunk_cases;
  }
  bool exhausted(std::uint64_t k) const { return config_.cases && first_case(k) >= *config_.cases; }
  bool out_of_time() const {
    return config_.minutes && seconds(Clock::now() - start_) >= *config_.minutes * 60;
  }
  bool ended() const { return !stop_ && (exhausted(merged_) || out_of_time()); }

  // The engines of one job; `keeping`: the same ones, if their answers are kept.
  struct Job {
    std::vector<EnginePtr> engines;
    std::vector<KeepingEngine*> keeping;
  };

  Job new_job() {
    Job job{factory_(), {}};
    if (!answers_) return job;
    std::vector<EngineCard> cards;
    for (EnginePtr& e : job.engines) {
      auto keeping = std::make_unique<KeepingEngine>(std::move(e));
      cards.push_back(keeping->card());
      job.keeping.push_back(keeping.get());
      e = std::move(keeping);
    }
    const std::lock_guard lock(mutex_);
    answers_->start(answers_header(cards));
    return job;
  }

  void run_job() try {
    const Job job = new_job();
    for (;;) {
      const std::uint64_t k = next_.fetch_add(1);
      if (exhausted(k)) return;
      // The first chunk always runs, however slow the machine: a campaign without an answer proves nothing.
      if (!wait_for_generation(k) || stop_ || failed_ || (k > 0 && out_of_time())) return abandon_chunk();
      finish(k, ask(k, job), job);
    }
  } catch (const Stopped&) {
    abandon_chunk();
  } catch (...) {
    std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
    failed_ = gap_ = true;
    merge_advanced_.notify_all();
  }

  // A chunk was taken but will not be finished: releases the jobs that wait for it.
  void abandon_chunk() {
    std::lock_guard lock(mutex_);
    gap_ = true;
    merge_advanced_.notify_all();
  }

  using SetAside = std::map<std::string, CampaignResult::SetAside>;
  struct Chunk {
    CampaignResult result;
    SetAside known;  // engines already set aside when the chunk ran
    std::vector<Case> cases;
    std::vector<std::vector<std::uint64_t>> features;  // guided campaigns only, of each case
    std::string answers;                               // as a block of the file, if answers are kept
  };

  // Half of a guided campaign's cases are mutations of earlier ones.
  Case next_case(std::uint64_t index) {
    constexpr std::uint64_t guided_stream = 0x677569646564ULL;  // keeps it apart from the case's own stream
    Rng rng = Rng::stream(config_.seed ^ guided_stream, index);
    if (config_.guided && rng.chance(0.5)) {
      std::lock_guard lock(mutex_);
      Case c = state_.pool.empty() ? Case{} : state_.pool.draw(rng);
      c.id = "guided/" + std::to_string(config_.seed) + "/" + std::to_string(index);
      if (!c.queries.empty()) return c;
    }
    return make_case(config_.seed, index, config_.family, config_.kinds);
  }

  // Waits until all chunks of earlier generations are in the pool; false if that will never happen.
  bool wait_for_generation(std::uint64_t k) {
    if (!config_.guided) return true;
    std::unique_lock lock(mutex_);
    const std::uint64_t first = k / generation_chunks * generation_chunks;
    merge_advanced_.wait(lock, [&] { return merged_ >= first || gap_; });
    return merged_ >= first;
  }

  Chunk ask(std::uint64_t k, const Job& job) {
    const std::vector<EnginePtr>& engines = job.engines;
    SetAside known;
    {
      const std::lock_guard lock(mutex_);
      known = state_.result.set_aside;
    }
    for (const EnginePtr& e : engines) {
      const auto aside = known.find(e->card().name);
      e->resume();
      if (aside != known.end()) e->suspend(aside->second.why);
    }
    for (KeepingEngine* e : job.keeping) e->start();
    Chunk chunk = run_chunk(k, engines);
    if (answers_) chunk.answers = answers_of(first_case(k), chunk.cases, job);
    if (!config_.guided) chunk.cases.clear();
    for (const EnginePtr& e : engines)
      if (const auto& name = e->card().name; !e->set_aside().empty() && !known.contains(name))
        chunk.result.set_aside[name] = {first_case(k), e->set_aside()};
    chunk.known = std::move(known);
    write_new_evidence(chunk.result);
    return chunk;
  }

  static std::string answers_of(std::uint64_t first_index, const std::vector<Case>& cases, const Job& job) {
    KeptBatch batch{first_index, cases, {}};
    for (KeepingEngine* e : job.keeping) batch.engines.push_back(e->take());
    return answers_block(batch);
  }

  Chunk run_chunk(std::uint64_t k, const std::vector<EnginePtr>& engines) {
    const auto start = Clock::now();
    const std::uint64_t first = first_case(k);
    const std::uint64_t end =
        config_.cases ? std::min(first + chunk_cases, *config_.cases) : first + chunk_cases;
    Chunk chunk;
    CampaignResult& r = chunk.result;
    for (std::uint64_t i = first; i < end; ++i) {
      const std::int64_t before = thread_cpu_ns();
      chunk.cases.push_back(next_case(i));
      const auto& queries = chunk.cases.back().queries;
      if (!queries.empty() && queries[0].question < Question::time_of_impact)
        r.pair_cpu_ns += thread_cpu_ns() - before;
    }
    ask_and_judge(r, chunk.cases, first, engines, config_.relations_every,
                  config_.guided ? &chunk.features : nullptr);
    r.total_ns = std::chrono::nanoseconds(Clock::now() - start).count();
    return chunk;
  }

  // Evidence takes time, and a certificate may take seconds of exact arithmetic. The job that found a new
  // kind writes it here, outside the lock and within the time limit, while the others continue. Further
  // findings of that kind need none, since only the first is kept. If another job adds the same kind
  // meanwhile, it is written twice, with the same bytes.
  void write_new_evidence(CampaignResult& found) {
    std::vector<Finding*> fresh;
    {
      std::lock_guard lock(mutex_);
      for (auto& [key, f] : found.findings)
        if (!state_.result.findings.contains(key)) fresh.push_back(&f);
    }
    CaseCertificates certificates;
    const auto when = config_.certificates ? ExactCertificates::now : ExactCertificates::later;
    for (Finding* f : fresh) write_evidence(*f, certificates, when);
  }

  void merge(const Chunk& c) {
    state_.result.merge(c.result);
    if (answers_) {
      answers_->append(c.answers);
      state_.answers_bytes = answers_->bytes();
    }
    for (std::size_t i = 0; i < c.features.size(); ++i) state_.pool.note(c.cases[i], c.features[i]);
    if ((merged_ + 1) % generation_chunks == 0) state_.pool.publish();
    ++merged_;
  }

  static bool same_engines(const SetAside& a, const SetAside& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& x, const auto& y) { return x.first == y.first; });
  }

  void finish(std::uint64_t k, Chunk c, const Job& job) {
    std::unique_lock lock(mutex_);
    pending_.emplace(k, std::move(c));
    for (auto it = pending_.find(merged_); it != pending_.end(); it = pending_.find(merged_)) {
      Chunk next = std::move(it->second);
      pending_.erase(it);
      if (same_engines(next.known, state_.result.set_aside)) {
        merge(next);
        continue;
      }
      // This chunk ran before a slower, earlier chunk found that an engine must be set aside. It runs again,
      // so that the result is that of a single job.
      const std::uint64_t again = merged_;
      lock.unlock();
      next = ask(again, job);
      lock.lock();
      pending_.emplace(again, std::move(next));
    }
    merge_advanced_.notify_all();
    state_.next_chunk = merged_;
    const auto now = Clock::now();
    if (!config_.out.empty() &&
        seconds(now - saved_) > std::max(min_save_interval_s, save_interval_per_cost * save_cost_))
      save();
    if (seconds(now - reported_) > report_interval_s) {
      report(false);
      reported_ = now;
    }
  }

  void save() {
    const auto before = Clock::now();
    save_state(config_, state_);
    saved_ = Clock::now();
    save_cost_ = seconds(saved_ - before);
  }

  void report(bool last) {
    const double elapsed = seconds(Clock::now() - start_);
    const double done = static_cast<double>(state_.result.cases - resumed_cases_);
    const double rate = elapsed > 0 ? done / elapsed : 0;
    std::optional<double> left;
    if (config_.minutes) left = std::max(0.0, *config_.minutes * 60 - elapsed);
    if (config_.cases && rate > 0) {
      const double total = static_cast<double>(*config_.cases) / static_cast<double>(config_.shards);
      const double by_cases = std::max(0.0, total - static_cast<double>(state_.result.cases)) / rate;
      left = left ? std::min(*left, by_cases) : by_cases;
    }
    if (progress_) progress_({state_.result, elapsed, rate, left, last});
  }

  const CampaignConfig& config_;
  const EngineFactory& factory_;
  const ProgressCallback& progress_;
  const std::atomic<bool>& stop_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point saved_ = start_, reported_ = start_;
  double save_cost_ = 0;
  std::atomic<std::uint64_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::exception_ptr error_;
  std::uint64_t merged_ = 0;
  std::uint64_t resumed_cases_ = 0;
  std::map<std::uint64_t, Chunk> pending_;
  std::condition_variable merge_advanced_;
  bool gap_ = false;
  StoredState state_;
  std::optional<AnswersWriter> answers_;
  std::optional<DirectoryLock> lock_;  // on config_.out
};

}  // namespace

CampaignResult run_campaign(const CampaignConfig& config, const EngineFactory& engines,
                            const ProgressCallback& progress, const std::atomic<bool>& stop) {
  return Runner(config, engines, progress, stop).run();
}

}  // namespace touchstone::fuzz
