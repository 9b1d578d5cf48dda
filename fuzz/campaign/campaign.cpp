#include "fuzz/campaign/campaign.h"

#include <exception>
#include <mutex>
#include <thread>

#include "core/base/input_error.h"
#include "fuzz/campaign/store.h"
#include "fuzz/generate/family.h"

namespace touchstone::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

// A chunk is what a job takes at once and what a batch on a worker's pipe holds.
constexpr std::uint64_t chunk_cases = 32;

double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

// Takes chunks in any order, merges them in order, so that what is stored is always a prefix of the campaign.
class Runner {
 public:
  Runner(const CampaignConfig& config, const EngineFactory& factory, const ProgressCallback& progress,
         const std::atomic<bool>& stop)
      : config_(config), factory_(factory), progress_(progress), stop_(stop) {}

  CampaignResult run() {
    prepare();
    std::vector<std::thread> threads;
    for (int i = 0; i < std::max(1, config_.jobs); ++i) threads.emplace_back([this] { job(); });
    for (auto& t : threads) t.join();
    if (error_) std::rethrow_exception(error_);
    state_.finished = ended();
    if (!config_.out.empty()) {
      save_findings(config_, state_.result);
      save_state(config_, state_);
    }
    report(true);
    return state_.result;
  }

 private:
  void prepare() {
    if (!config_.out.empty()) {
      if (auto s = load_state(config_)) state_ = std::move(*s);
      std::error_code ec;
      std::filesystem::create_directories(config_.out, ec);
      if (ec) throw InputError(config_.out.string(), "cannot be made: " + ec.message());
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

  void job() try {
    const auto engines = factory_();
    for (;;) {
      const std::uint64_t k = next_.fetch_add(1);
      if (stop_ || failed_ || exhausted(k) || out_of_time()) return;
      finish(k, run_chunk(k, engines));
    }
  } catch (...) {
    std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
    failed_ = true;
  }

  CampaignResult run_chunk(std::uint64_t k, const std::vector<EnginePtr>& engines) const {
    const auto start = Clock::now();
    std::vector<Case> cases;
    const std::uint64_t first = first_case(k);
    const std::uint64_t end =
        config_.cases ? std::min(first + chunk_cases, *config_.cases) : first + chunk_cases;
    for (std::uint64_t i = first; i < end; ++i) cases.push_back(make_case(config_.seed, i, config_.family));
    CampaignResult r;
    ask_and_judge(r, cases, first, engines);
    r.total_ns = std::chrono::nanoseconds(Clock::now() - start).count();
    return r;
  }

  void finish(std::uint64_t k, CampaignResult r) {
    std::lock_guard lock(mutex_);
    pending_.emplace(k, std::move(r));
    for (auto it = pending_.find(merged_); it != pending_.end(); it = pending_.find(++merged_)) {
      state_.result.merge(it->second);
      pending_.erase(it);
    }
    state_.next_chunk = merged_;
    const auto now = Clock::now();
    if (!config_.out.empty() && seconds(now - saved_) > 10)
      save_state(config_, state_), saved_ = Clock::now();
    if (seconds(now - shown_) > 0.5) report(false), shown_ = now;
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
  Clock::time_point saved_ = start_, shown_ = start_;
  std::atomic<std::uint64_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::exception_ptr error_;
  std::uint64_t merged_ = 0;
  std::uint64_t resumed_cases_ = 0;
  std::map<std::uint64_t, CampaignResult> pending_;
  StoredState state_;
};

}  // namespace

CampaignResult run_campaign(const CampaignConfig& config, const EngineFactory& engines,
                            const ProgressCallback& progress, const std::atomic<bool>& stop) {
  return Runner(config, engines, progress, stop).run();
}

}  // namespace touchstone::fuzz
