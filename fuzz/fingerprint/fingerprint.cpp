#include "fuzz/fingerprint/fingerprint.h"

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/hash.h"
#include "oracles/client/worker_limits.h"
#include "scenarios/random/family.h"

namespace touchstone::fuzz {
namespace {

constexpr std::uint64_t seed = 20'261'123;
/// Named, so that a family added to the default mix does not change the set.
constexpr std::string_view families_of_set =
    "separate,near,shallow,deep,contained,lattice,tiny,far,translate,spin,crowd,script,start,"
    "graze,bullet,last,whirl,swarm,tiles,errands,throng,zero,unequal,parallel,mesh,vertices,"
    "company,dialogue,later";

// A job takes one block at a time, for which it creates an engine: what an engine keeps between cases does
// not depend on the number of jobs. An engine that is no longer asked because of its time-outs is asked again
// in the next batch of the block.
constexpr std::uint64_t block_cases = 1000, batch_cases = 32;

std::uint64_t digest_of(const Case& c) {
  Hasher h;
  h.add(hash(c.scene));
  for (const Query& q : c.queries) h.add(static_cast<int>(q.question)).add(q.a).add(q.b);
  return h.value();
}

struct Asked {
  std::uint64_t digest = 0;
  struct Answer {
    Question question;
    std::string shapes;
    std::uint32_t hash;
  };
  std::vector<Answer> answers;
};

std::vector<Asked> ask_batch(Engine& engine, std::uint64_t first, std::uint64_t end) {
  std::vector<Case> cases;
  for (std::uint64_t i = first; i < end; ++i) cases.push_back(fingerprint_case(i));
  engine.resume();
  const auto observed = engine.run(cases);
  std::vector<Asked> all;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Asked asked{digest_of(cases[i]), {}};
    for (std::size_t q = 0; q < cases[i].queries.size(); ++q) {
      const Query& query = cases[i].queries[q];
      asked.answers.push_back(
          {query.question, fingerprint_shapes(cases[i], query), hash_of_answer(observed[i].answers[q])});
    }
    all.push_back(std::move(asked));
  }
  return all;
}

class Jobs {
 public:
  explicit Jobs(const FingerprintConfig& config) : config_(config), all_(config.cases) {}

  std::vector<Asked> run() {
    std::vector<std::thread> threads;
    for (int i = 0; i < std::max(1, config_.jobs); ++i) threads.emplace_back([this] { work(); });
    for (std::thread& t : threads) t.join();
    if (error_) std::rethrow_exception(error_);
    return std::move(all_);
  }

 private:
  void work() try {
    const std::uint64_t blocks = (config_.cases + block_cases - 1) / block_cases;
    for (std::uint64_t k; !failed_ && (k = next_.fetch_add(1)) < blocks;)
      ask_block(k * block_cases, std::min(config_.cases, (k + 1) * block_cases));
  } catch (...) {
    const std::lock_guard lock(guard_);
    if (!error_) error_ = std::current_exception();
    failed_ = true;
  }

  void ask_block(std::uint64_t first, std::uint64_t end) {
    const EnginePtr engine = config_.make();
    for (; first < end && !failed_; first += batch_cases) {
      if (config_.stop && *config_.stop) throw Stopped();
      auto answers = ask_batch(*engine, first, std::min(end, first + batch_cases));
      std::move(answers.begin(), answers.end(), all_.begin() + static_cast<std::ptrdiff_t>(first));
    }
  }

  const FingerprintConfig& config_;
  std::vector<Asked> all_;  // each job writes the elements of its own blocks
  std::atomic<std::uint64_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex guard_;
  std::exception_ptr error_;
};

}  // namespace

Case fingerprint_case(std::uint64_t i) { return make_case(seed, i, families_of_set); }

Fingerprint fingerprint_of(const FingerprintConfig& config) {
  const EngineCard card = config.make()->card();
  Fingerprint f{fingerprint_set, config.cases, 0, card.name, card.library, card.version, card.settings, {}};
  std::map<std::pair<Question, std::string>, Fingerprint::Group> groups;
  Hasher digest;
  for (const Asked& asked : Jobs(config).run()) {
    digest.add(asked.digest);
    for (const Asked::Answer& a : asked.answers) {
      auto& group = groups[{a.question, a.shapes}];
      group.question = to_string(a.question);
      group.shapes = a.shapes;
      group.answers.push_back(a.hash);
    }
  }
  f.digest = digest.value();
  for (auto& [key, group] : groups) f.groups.push_back(std::move(group));
  return f;
}

std::optional<FingerprintPlace> place_in_set(const std::string& question, const std::string& shapes,
                                             std::size_t index, std::uint64_t cases) {
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Case c = fingerprint_case(i);
    for (std::size_t q = 0; q < c.queries.size(); ++q)
      if (to_string(c.queries[q].question) == question && fingerprint_shapes(c, c.queries[q]) == shapes &&
          index-- == 0)
        return FingerprintPlace{i, q};
  }
  return std::nullopt;
}

}  // namespace touchstone::fuzz
