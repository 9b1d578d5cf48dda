#include "fuzz/certify/certify.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/input_error.h"
#include "fuzz/shrink/defensible.h"
#include "fuzz/shrink/shrink_both.h"
#include "scenarios/value/candidate_pairs.h"
#include "scenarios/value/invalid_numbers.h"

namespace touchstone::fuzz {
namespace {

// A crash costs a worker on every try.
std::size_t most_tries(const std::string& fault) { return fault == "crashed" ? 1500 : 12000; }

class SubjectRunner {
 public:
  SubjectRunner(const Subject& s, const EvidenceRow& e, FaultClass what)
      : s_(s), level_(e.level), invalid_(e.invalid), what_(std::move(what)) {}

  /// From now on every case gets a new engine.
  void use_new_engines() { new_engines_ = true; }

  /// Returns the fault of the wanted class if the subject shows it.
  std::optional<CandidateFault> fault(const Case& c) {
    Engine& e = engine();
    const auto o = e.run({&c, 1});
    return fault_of(e, c, o[0]);
  }
  std::vector<bool> shows(std::span<const Case> cases) {
    std::vector<bool> out(cases.size());
    std::vector<Case> fit;
    std::vector<std::size_t> place;
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (is_fit(cases[i])) {
        fit.push_back(cases[i]);
        place.push_back(i);
      }
    if (new_engines_) {
      for (std::size_t i = 0; i < fit.size(); ++i) out[place[i]] = fault(fit[i]).has_value();
      return out;
    }
    Engine& e = engine();
    const auto all = e.run(fit);
    for (std::size_t i = 0; i < fit.size(); ++i) out[place[i]] = fault_of(e, fit[i], all[i]).has_value();
    return out;
  }

 private:
  std::optional<CandidateFault> fault_of(Engine& e, const Case& c, const CaseObservations& o) const {
    CandidateVerdict v = judge_with_cause(e, c, o.answers.at(0), level_, invalid_);
    for (CandidateFault& f : v.faults)
      if (f.what == what_) return std::move(f);
    return std::nullopt;
  }
  // At the level of boxes, every body must stay a box whose corners are exact in the subject's scalar type.
  bool is_fit(const Case& c) {
    if (c.queries.size() != 1 || !is_broad_question(c.queries[0].question)) return false;
    if (c.scene.bodies.empty()) return false;
    if (has_swept_candidates_query(c)) return level_ == BroadLevel::bodies;
    if (c.scene.script.empty()) return false;  // would mean: insert all bodies
    if (level_ == BroadLevel::bodies) return true;
    const Scalar scalar = roundoff_of(engine().card(), ShapeKind::box) > max_float64_roundoff
                              ? Scalar::float32
                              : Scalar::float64;
    for (const Step& step : c.scene.script) {
      if (step.op != Step::Op::insert && step.op != Step::Op::move) continue;
      const Pose p = step.pose.value_or(c.scene.bodies[static_cast<std::size_t>(step.body)].pose);
      const auto box = exact_box(c.scene.shape_of(step.body), p);
      if (!box) return false;
      if (invalid_ && !(box->lo.array() <= box->hi.array()).all()) continue;
      if (box->lo.allFinite() && box->hi.allFinite() &&
          !exact_corners(p.translation, box->hi - p.translation, scalar))
        return false;
    }
    return true;
  }
  Engine& engine() {
    if (!engine_ || new_engines_) engine_ = s_.make(level_);
    return *engine_;
  }
  const Subject& s_;
  BroadLevel level_;
  bool invalid_;
  FaultClass what_;
  bool new_engines_ = false;
  EnginePtr engine_;
};

// Cuts the script after the given query.
Case cut_after(Case c, int query) {
  int k = 0;
  auto& script = c.scene.script;
  for (std::size_t i = 0; i < script.size(); ++i)
    if (script[i].op == Step::Op::query && k++ == query) {
      script.resize(i + 1);
      break;
    }
  return c;
}

void keep_steps_of(Case& c, const std::set<int>& bodies) {
  std::erase_if(c.scene.script,
                [&](const Step& s) { return s.op != Step::Op::query && !bodies.contains(s.body); });
}

// Often enough of a long script: the steps of the two bodies with one query; then with all queries.
std::vector<Case> guesses(const Case& c, const CandidateFault& v) {
  std::vector<Case> out;
  if (v.a < 0 || v.b < 0) return out;
  Case both = c;
  keep_steps_of(both, {v.a, v.b});
  Case last = both;
  std::size_t left = last.scene.script.size();
  std::erase_if(last.scene.script, [&](const Step& s) { return --left > 0 && s.op == Step::Op::query; });
  out.push_back(std::move(last));
  out.push_back(std::move(both));
  return out;
}

Case start_of(SubjectRunner& runner, const Case& c, const CandidateFault& v) {
  const Case cut = v.query < 0 ? c : cut_after(c, v.query);
  if (!runner.shows({&cut, 1})[0]) return c;
  for (const Case& g : guesses(cut, v))
    if (runner.shows({&g, 1})[0]) return g;
  return cut;
}

// Boxes without volume get some, and the two bodies touch along an axis, at their own poses.
std::vector<Case> touching_forms(const Case& c, const CandidateFault& v) {
  std::vector<Case> forms;
  // A subject may report bodies that do not exist.
  const int n = static_cast<int>(c.scene.bodies.size());
  if (std::min(v.a, v.b) < 0 || std::max(v.a, v.b) >= n) return forms;
  constexpr double restored = 0.5;  // of a half extent that is 0, in a scene about 1
  Case solid = c;
  for (Shape& shape : solid.scene.shapes)
    if (auto* box = std::get_if<Box>(&shape))
      for (double& h : box->half_extents)
        if (!(h > 0)) h = restored;
  const auto *a = std::get_if<Box>(&solid.scene.shape_of(v.a)),
             *b = std::get_if<Box>(&solid.scene.shape_of(v.b));
  if (!a || !b) return forms;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Case form = solid;
    const Vec3 apart = (a->half_extents[axis] + b->half_extents[axis]) * Vec3::Unit(axis);
    std::vector<Body>& bodies = form.scene.bodies;
    bodies[static_cast<std::size_t>(v.b)].pose.translation =
        bodies[static_cast<std::size_t>(v.a)].pose.translation + apart;
    forms.push_back(std::move(form));
  }
  return forms;
}

// The start itself, or bodies with volume that show the same class of fault.
Case solid_start(SubjectRunner& runner, Case start, const CandidateFault& v) {
  if (is_solid(start)) return start;
  for (Case& form : touching_forms(start, v))
    if (is_solid(form) && runner.shows({&form, 1})[0]) return std::move(form);
  return start;
}

std::string in_words(const Vec3& v) { return fmt::format("({:g}, {:g}, {:g})", v.x(), v.y(), v.z()); }

// Lists the bodies whose numbers are not finite or do not make a box.
std::string invalid_boxes(const Scene& s) {
  std::string out;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const auto* box = std::get_if<Box>(&s.shape_of(static_cast<int>(i)));
    if (!box || is_closed_set(*box, s.bodies[i].pose)) continue;
    out += fmt::format("; body {} is not a valid box: at {}, half extents {}", i,
                       in_words(s.bodies[i].pose.translation), in_words(box->half_extents));
  }
  return out;
}

}  // namespace

std::size_t bodies_used(const Case& c) {
  if (has_swept_candidates_query(c)) return c.scene.bodies.size();
  std::set<int> used;
  for (const Step& step : c.scene.script)
    if (step.op == Step::Op::insert) used.insert(step.body);
  return used.size();
}

Refutation refute(const Subject& subject, const EvidenceRow& e, const FaultCount& found, const Case& c) {
  Refutation r{e.level, found.evidence, found.index, found.what, found.words, "not shrunk", 0, 0, false, {}};
  r.bodies = bodies_used(c);
  r.steps = c.scene.script.size();
  SubjectRunner runner(subject, e, found.what);
  auto fault = runner.fault(c);
  if (!fault) {
    runner.use_new_engines();
    fault = runner.fault(c);
  }
  if (!fault) {
    r.shrink = "not reproduced: the subject's answers vary";
    r.script = c;
    return r;
  }
  const StillShows still = [&](std::span<const Case> cases) { return runner.shows(cases); };
  const ShrunkPair both = shrink_solid(solid_start(runner, start_of(runner, c, *fault), *fault), still,
                                       most_tries(found.what.fault));
  const Shrunk& shrunk = both.defensible ? *both.defensible : both.minimum;
  r.is_shown_again = both.minimum.exit != ShrinkExit::not_shown;
  r.shrink = r.is_shown_again ? std::string(to_string(shrunk.exit))
                              : "not reproduced every time: the subject's answers vary";
  r.script = shrunk.smallest;
  r.bodies = bodies_used(shrunk.smallest);
  r.steps = shrunk.smallest.scene.script.size();
  if (const auto smallest = runner.fault(shrunk.smallest))
    r.words = smallest->words + invalid_boxes(shrunk.smallest.scene);
  return r;
}

}  // namespace touchstone::fuzz
