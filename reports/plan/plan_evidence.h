// Measures the errors of a way to run a course, on a sample of its pairs.
#pragma once

#include <map>
#include <optional>

#include "oracles/referee/referee.h"
#include "reports/plan/plan_measure.h"

namespace touchstone::fuzz {

/// A sample of the course's pairs with the referee's verdicts, the same for every way to run it. Up to half
/// of the pairs are in contact, or within the margin, and kinds of shapes take turns.
class PlanSample {
 public:
  PlanSample(const Course& course, const EndPoses& poses,
             const std::vector<std::vector<BodyPair>>& candidates, std::uint64_t seed, int pairs,
             double margin = 0);

  /// Adds the errors in this step's report to the row.
  void judge(int step, const StepReport& report, double error, PlanRow& row) const;

  std::uint64_t judged() const { return judged_; }
  std::uint64_t undecided() const { return undecided_; }

 private:
  struct Judged {
    BodyPair pair;
    referee::PairTruth truth;
    bool has_depth = true;  // false for a mesh, whose depth is undefined
  };
  Placed placed(int step, int body) const;
  double error_of(int step, const Judged& j, const StepReport& report) const;

  const Course& course_;
  const EndPoses& poses_;
  double margin_;
  std::map<int, std::vector<Judged>> of_step_;
  std::uint64_t judged_ = 0, undecided_ = 0;
};

}  // namespace touchstone::fuzz
