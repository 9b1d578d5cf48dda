// The cheapest sufficient model of a scene, found by `touchstone plan`: what to run, what it saves, and the
// evidence.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reports/record/chart.h"

namespace touchstone::fuzz {

struct PlanPhase {
  std::string name;
  double ns_step = 0;  // boxes in, pairs out; in the fastest round
};

struct PlanPair {
  std::string pair;  // kinds of the shapes as run, "box-hull"
  bool balls_first = false;
  std::string arithmetic;        // double, double alone, float
  std::uint64_t candidates = 0;  // over all steps
  std::uint64_t sampled = 0;     // of them measured
  double ns_double = 0, ns = 0;  // per pair, with double alone and with the method, shapes as run
  double balls_share = 0;        // decided by bounding balls
  double cheap_share = 0;        // of the rest, answered by that arithmetic within the error
  double certified_error = 0;    // largest bound among them, including that of the shapes
};

struct PlanShape {
  int shape = 0;
  std::string was, becomes;              // kinds
  std::uint64_t vertices = 0, left = 0;  // hulls only
  std::uint64_t bodies = 0;
  double error = 0;
};

struct PlanSwept {
  int body = 0;
  std::string name, reason;  // travel, turning
  std::uint64_t steps = 0;
  double pass_bound = 0, inner = 0;  // where their ratio was largest
};

/// One way to run all steps: a fixed choice, or the plan.
struct PlanRow {
  std::string name;
  double ns_min = 0, ns_median = 0;  // per step, over the rounds
  double error = 0;                  // largest in the sample, by the referee
  std::uint64_t outside = 0;         // sampled pairs whose error exceeds the limit
  std::uint64_t unanswered = 0;      // pairs with not_converged
  std::uint64_t unswept = 0;         // (body, step) that the criterion would sweep and this does not
  bool is_plan = false, front = false;
  bool sound() const { return outside == 0 && unanswered == 0 && unswept == 0; }
};

/// What the plan chose, in the classes and settings of another library.
struct PlanTerms {
  std::string library;
  std::vector<std::string> lines;  // sentences
};

struct Plan {
  Machine machine;
  std::string scene;
  std::uint64_t seed = 0, bodies = 0, steps = 0, rounds = 0;
  double error = 0, least_error = 0;  // requested; the least that double can prove on this scene
  double margin = 0;                  // pairs this near are reported
  bool verdict_only = false;          // which they are, and nothing else
  std::string broad_phase;
  bool remember = false, solid_meshes = false;
  std::uint64_t convex_meshes = 0;  // closed, convex meshes
  double sweep_share = 0;
  Json run;                       // input of StepWorld, reports/plan/plan.h
  std::vector<PlanPhase> phases;  // fastest first
  std::vector<PlanPair> pairs;    // most expensive first
  std::vector<PlanShape> shapes;
  std::vector<PlanSwept> swept;                              // farthest beyond the criterion first
  std::uint64_t judged = 0, undecided = 0, unsupported = 0;  // sampled pairs
  std::vector<PlanRow> rows;                                 // fastest first
  std::vector<PlanTerms> terms;
};

Json to_json(const Plan& p);

}  // namespace touchstone::fuzz
