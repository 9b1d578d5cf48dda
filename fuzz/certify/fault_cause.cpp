#include "fuzz/certify/candidate_verdict.h"

#include <algorithm>

#include "scenarios/value/invalid_numbers.h"

namespace touchstone::fuzz {
namespace {

bool is_half_space(const Scene& s, int body) { return kind_of(s.shape_of(body)) == ShapeKind::half_space; }

// The body's own numbers, or a pose in one of its steps, do not describe a closed finite set.
bool is_invalid(const Scene& s, int body) {
  const Shape& shape = s.shape_of(body);
  return !is_closed_set(shape, s.bodies[static_cast<std::size_t>(body)].pose) ||
         std::any_of(s.script.begin(), s.script.end(), [&](const Step& step) {
           return step.body == body && step.pose && !is_closed_set(shape, *step.pose);
         });
}

// Body indices stay the same. Bodies that are left out become unit boxes that are never inserted, because an
// engine may read shapes before the script begins.
template <class Odd>
std::optional<Case> without(Case c, Odd&& is_odd) {
  Scene& s = c.scene;
  std::vector<int> odd;
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
    if (is_odd(s, i)) odd.push_back(i);
  if (odd.empty()) return std::nullopt;
  std::erase_if(s.script, [&](const Step& step) {
    return step.op != Step::Op::query && std::binary_search(odd.begin(), odd.end(), step.body);
  });
  const int unit = static_cast<int>(s.shapes.size());
  s.shapes.push_back(Box{Vec3::Ones()});
  for (const int i : odd) {
    Body& b = s.bodies[static_cast<std::size_t>(i)];
    s.shapes[static_cast<std::size_t>(b.shape)] = Box{Vec3::Ones()};
    b.shape = unit;
    b.pose = {};
  }
  return c;
}

class Causes {
 public:
  Causes(Engine& engine, BroadLevel level, bool invalid)
      : engine_(engine), level_(level), invalid_(invalid) {}

  // Gives `kind` to the faults that the subject does not show in `rest`.
  void blame(CandidateVerdict& v, const Case& rest, FaultKind kind) const {
    const auto observed = engine_.run({&rest, 1});
    const CandidateVerdict alone = judge_candidates(rest, observed[0].answers.at(0), level_, invalid_);
    for (CandidateFault& f : v.faults)
      if (is_unattributed(f) && !alone.shows(f.what)) {
        f.what.kind = kind;
        f.share = 0;
      }
  }
  static bool is_unattributed(const CandidateFault& f) {
    return f.what.kind != FaultKind::unbounded && f.what.kind != FaultKind::invalid;
  }

 private:
  Engine& engine_;
  BroadLevel level_;
  bool invalid_;
};

// Two faults may have ended up in the same class.
void sort_and_unite(std::vector<CandidateFault>& faults) {
  std::stable_sort(faults.begin(), faults.end(), [](const CandidateFault& x, const CandidateFault& y) {
    return is_graver(x.what, y.what);
  });
  faults.erase(std::unique(faults.begin(), faults.end(),
                           [](const CandidateFault& x, const CandidateFault& y) { return x.what == y.what; }),
               faults.end());
}

}  // namespace

CandidateVerdict judge_with_cause(Engine& engine, const Case& c, const Observation& o, BroadLevel level,
                                  bool invalid) {
  CandidateVerdict v = judge_candidates(c, o, level, invalid);
  if (std::none_of(v.faults.begin(), v.faults.end(), Causes::is_unattributed)) return v;
  const Causes causes(engine, level, invalid);
  const auto finite = without(c, is_invalid);
  if (finite) causes.blame(v, *finite, FaultKind::invalid);
  const auto bounded = without(finite.value_or(c), is_half_space);
  if (bounded) causes.blame(v, *bounded, FaultKind::unbounded);
  sort_and_unite(v.faults);
  return v;
}

}  // namespace touchstone::fuzz
