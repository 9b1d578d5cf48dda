#include "tests/mutants/lying_engine.h"

#include "oracles/core/core_engine.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

class LyingEngine final : public Engine {
 public:
  explicit LyingEngine(const Mutant& m)
      : lie_(m.lie), card_(core_.card()), reads_unwritten_(m.reads_unwritten) {
    card_.name = m.name;
  }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto result = core_.run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (std::size_t k = 0; k < cases[i].queries.size(); ++k)
        lie_(cases[i], cases[i].queries[k], result[i].answers[k]);
    return result;
  }
  std::vector<CaseObservations> run_again(std::span<const Case> cases) override {
    return reads_unwritten_ ? core_.run(cases) : std::vector<CaseObservations>{};
  }

 private:
  CoreEngine core_;
  Lie lie_;
  EngineCard card_;
  bool reads_unwritten_;
};

}  // namespace

const std::vector<Mutant>& mutants() {
  static const std::vector<Mutant> all = [] {
    std::vector<Mutant> list;
    for (const auto topic :
         {broad_list_lies,     broad_box_lies, broad_script_lies, overlap_lies, distance_lies, normal_lies,
          depth_lies,          manifold_lies,  impact_lies,       outcome_lies, scene_lies,    relation_lies,
          regime_lies,         memory_lies,    swept_lies,        trigger_lies, symptom_lies,  margin_lies,
          margin_contact_lies, gradient_lies,  solid_lies,        ground_lies})
      for (Mutant& m : topic()) list.push_back(std::move(m));
    return list;
  }();
  return all;
}

EnginePtr make_lying_engine(const Mutant& m) { return std::make_unique<LyingEngine>(m); }

}  // namespace touchstone::mutants
