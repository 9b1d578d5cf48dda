// Shows one case in full: the scene, the referee's answer with its certificate, and every engine's answer
// with its blame.
#pragma once

#include <string>
#include <vector>

#include "fuzz/judge/truth.h"
#include "reports/record/observation_json.h"
#include "scenarios/value/judgement.h"

namespace touchstone::reports {

class ReplayText {
 public:
  ReplayText(const Case& c, fuzz::Truth& truth) : case_(c), truth_(truth) {}
  void add(const std::string& engine, const CaseObservations& observations,
           const std::vector<Judgement>& judgements);
  /// At most 80 columns.
  std::string str() const;
  /// `certificates`: include those in exact arithmetic, which may take minutes for a moving mesh.
  fuzz::Json json(bool certificates) const;

 private:
  struct Row {
    std::string engine;
    CaseObservations observations;
    std::vector<Judgement> judgements;
  };
  std::string referee_lines(const Query& q) const;
  fuzz::Json referee_json(const Query& q, bool certificates) const;
  Certificate depth_certificate(const Query& q) const;
  const Case& case_;
  fuzz::Truth& truth_;
  std::vector<Row> rows_;
};

}  // namespace touchstone::reports
