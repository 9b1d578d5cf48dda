// Judges every engine's answers to one case and keeps all that was judged, for people.
#pragma once

#include <span>
#include <string>

#include "fuzz/judge/truth.h"
#include "reports/record/judged_case.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::fuzz {

/// Which certificates a judged case holds. `shown`: those of the verdicts and, for contacts, of the depths;
/// `depths`: of every depth; `exact`: also the verdicts' in exact arithmetic, which may take minutes for a
/// moving mesh.
enum class Certificates { shown, depths, exact };

class CaseJudge {
 public:
  explicit CaseJudge(const Case& c) : c_(c), truth_(c.scene) {}
  /// The judgements of one engine's answers, one a query; valid until the next engine is added.
  const std::vector<Judgement>& add(const EngineCard& card, const CaseObservations& observations);
  JudgedCase result(Certificates certificates) &&;

 private:
  RefereeAnswer referee_answer(const Query& q, Certificates certificates);
  const Case& c_;
  Truth truth_;
  std::vector<JudgedCase::OfEngine> engines_;
};

}  // namespace touchstone::fuzz
