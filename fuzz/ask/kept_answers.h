// The answers to a batch of cases, kept so that the batch can be judged again without its engines.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "oracles/abi/engine.h"

namespace touchstone::fuzz {

/// The answer to a question that was put because of the answers before it: a case derived by a relation, or a
/// case put again.
struct LaterAnswer {
  bool again = false;           // in memory with other contents
  bool supported = true;        // false: the engine cannot be asked again
  std::uint64_t case_hash = 0;  // of all numbers of the scene and of the queries
  CaseObservations observations;
};

/// What one engine answered to a batch. Times, and details for people, which differ from run to run, are not
/// kept.
struct KeptAnswers {
  std::vector<CaseObservations> cases;  // one a case of the batch
  /// Several answers to one question are in the order in which they were given. A derived case is a function
  /// of its case and of the answers to that, so its hash identifies it.
  std::vector<LaterAnswer> later;
};

struct KeptBatch {
  std::uint64_t first_index = 0;
  std::vector<Case> cases;
  std::vector<KeptAnswers> engines;
};

/// True when the observations have as many answers, shapes and bodies as the case needs. Those from a file
/// may not.
bool fits(const CaseObservations& all, const Case& c);

/// The engine itself; keeps what it answers.
class KeepingEngine final : public Engine {
 public:
  explicit KeepingEngine(EnginePtr engine) : engine_(std::move(engine)) {}
  const EngineCard& card() const override { return engine_->card(); }
  std::vector<CaseObservations> run(std::span<const Case> cases) override;
  std::vector<CaseObservations> run_again(std::span<const Case> cases) override;
  std::string set_aside() const override { return engine_->set_aside(); }
  void resume() override { engine_->resume(); }
  void suspend(const std::string& why) override { engine_->suspend(why); }

  /// Starts a new batch: the next run() is about its cases, and all later ones about derived cases.
  void start();
  /// The answers since start().
  KeptAnswers take() { return std::move(kept_); }

 private:
  EnginePtr engine_;
  KeptAnswers kept_;
  bool is_first_ = true;
};

/// Answers from what was kept of one batch. What was not asked then is not answered: run() reports it as
/// `not_asked`, run_again() as not supported.
class KeptEngine final : public Engine {
 public:
  /// Precondition: both outlive the engine.
  KeptEngine(const EngineCard& card, const KeptAnswers& answers);
  ~KeptEngine() override;
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override;
  std::vector<CaseObservations> run_again(std::span<const Case> cases) override;

  /// Cases that were needed, but not kept.
  std::uint64_t missing_derived() const { return missing_derived_; }
  std::uint64_t missing_again() const { return missing_again_; }

 private:
  class Lookup;
  const EngineCard& card_;
  const KeptAnswers& answers_;
  std::unique_ptr<Lookup> lookup_;
  bool is_first_ = true;
  std::uint64_t missing_derived_ = 0, missing_again_ = 0;
};

}  // namespace touchstone::fuzz
