// The representatives of all classes, examined by several jobs, each with engines of its own.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "fuzz/causes/causes.h"
#include "oracles/client/worker_limits.h"

namespace touchstone::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

class Examiner {
 public:
  Examiner(std::size_t classes, const CausesConfig& config, std::vector<Representative>& all)
      : classes_(classes), config_(config), all_(all) {}

  void run() {
    std::vector<std::thread> threads;
    for (int i = 1; i < config_.jobs; ++i) threads.emplace_back([this] { run_job(); });
    run_job();
    for (std::thread& t : threads) t.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  bool is_over() const {
    if (config_.stop && *config_.stop) return true;
    const double minutes = std::chrono::duration<double>(Clock::now() - start_).count() / 60;
    return config_.minutes && minutes >= *config_.minutes;
  }

  void run_job() try {
    EnginePool pool(config_.make);
    for (std::size_t i = next_++; i < all_.size() && !is_over(); i = next_++) {
      const bool is_known = config_.examinations && config_.examinations->restore(all_[i]);
      if (!is_known) examine(all_[i], config_.knowledge, config_.tries, i < classes_, pool);
      const std::lock_guard lock(mutex_);
      if (config_.examinations && !is_known && all_[i].asked) config_.examinations->add(all_[i]);
      if (config_.progress) config_.progress(++done_, all_.size());
    }
  } catch (const Stopped&) {
    next_ = all_.size();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
    next_ = all_.size();
  }

  const std::size_t classes_;  // as many representatives are the first of their class
  const CausesConfig& config_;
  std::vector<Representative>& all_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr error_;
};

}  // namespace

std::vector<Representative> examined(const std::vector<FindingClass>& classes, const CausesConfig& config) {
  std::vector<Representative> all;
  // The first of every class comes before the second of any, so that a short budget covers all classes.
  std::vector<std::vector<Representative>> by_class;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const bool is_explained = classes[i].symptom.stage == FaultStage::contradiction;
    const std::size_t most =
        is_explained ? std::max<std::size_t>(config.representatives / 3, 1) : config.representatives;
    by_class.push_back(representatives_of(classes[i], i, most));
  }
  for (std::size_t k = 0; k < config.representatives; ++k)
    for (std::vector<Representative>& of_class : by_class)
      if (k < of_class.size()) all.push_back(std::move(of_class[k]));
  Examiner(classes.size(), config, all).run();
  return all;
}

}  // namespace touchstone::fuzz
