// How far the answers of a way to run a course are from the truth, on a sample of its pairs.
#pragma once

#include <map>
#include <optional>

#include "oracles/referee/referee.h"
#include "reports/plan/plan_measure.h"

namespace touchstone::fuzz {

/// Pairs of a course with what the referee says of them, the same for every way to run it. Half of the pairs
/// are in contact by the referee where there are so many, and kinds of shapes take turns.
class PlanSample {
 public:
  PlanSample(const Course& course, const EndPoses& poses,
             const std::vector<std::vector<BodyPair>>& candidates, std::uint64_t seed, int pairs);

  /// Adds to the row what the referee finds of this step's report.
  void judge(int step, const StepReport& report, double error, PlanRow& row) const;

  std::uint64_t judged() const { return judged_; }
  std::uint64_t undecided() const { return undecided_; }

 private:
  struct Judged {
    BodyPair pair;
    referee::PairTruth truth;
    bool has_depth = true;  // of a mesh that overlaps there is none
  };
  Placed placed(int step, int body) const;

  const Course& course_;
  const EndPoses& poses_;
  std::map<int, std::vector<Judged>> of_step_;
  std::uint64_t judged_ = 0, undecided_ = 0;
};

}  // namespace touchstone::fuzz
