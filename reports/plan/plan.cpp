#include "reports/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/input_error.h"
#include "reports/chart/chart.h"
#include "reports/plan/plan_evidence.h"
#include "reports/plan/plan_measure.h"

namespace touchstone::fuzz {
namespace {

void simplify(const Course& c, Fidelity& f) {
  for (const Shape& s : c.scene.shapes)
    f.simpler.push_back(simpler_shape(s, Fidelity::shape_share * f.error, f.solid_meshes));
}

void make_solid(Scene& scene) {
  for (Shape& s : scene.shapes)
    if (const auto* mesh = std::get_if<TriangleMesh>(&s))
      if (auto hull = convex_solid(*mesh)) s = std::move(*hull);
}

std::uint64_t vertices_of(const Shape& s) {
  const auto* h = hull_if(s);
  return h ? h->vertices.size() : 0;
}

std::vector<PlanShape> shape_rows(const Course& c, const Fidelity& f) {
  std::vector<PlanShape> rows;
  for (std::size_t i = 0; i < f.simpler.size(); ++i) {
    if (!f.simpler[i]) continue;
    PlanShape r;
    r.shape = static_cast<int>(i);
    r.error = f.simpler[i]->error;
    r.was = type_name(c.scene.shapes[i]);
    r.becomes = type_name(f.simpler[i]->shape);
    r.vertices = vertices_of(c.scene.shapes[i]);
    r.left = vertices_of(f.simpler[i]->shape);
    for (const Body& b : c.scene.bodies) r.bodies += b.shape == r.shape;
    rows.push_back(r);
  }
  return rows;
}

// What is asked, without any saving.
Fidelity asked_of(const PlanOptions& o) {
  Fidelity f;
  f.margin = o.given ? o.given->margin : o.margin;
  f.verdict_only = o.given ? o.given->verdict_only : o.verdict_only;
  return f;
}

// The fixed choices that a user could make without a plan.
std::vector<Way> fixed_ways(const Course& c, const std::vector<PlanPhase>& phases, const Fidelity& asked) {
  // Broad phases slower than this, relative to the fastest, are left out.
  constexpr double too_slow = 8;
  std::vector<Way> ways;
  for (const PlanPhase& p : phases) {
    if (p.ns_step > too_slow * phases.front().ns_step && p.name != "automatic") continue;
    Way w{p.name + ", double", asked, false, {}};
    w.fidelity.broad_phase = p.name;
    ways.push_back(w);
  }
  Way single{"automatic, float unproven", asked, false, {}};
  single.fidelity.error = std::numeric_limits<double>::infinity();
  for (auto& row : single.fidelity.method) row.fill({false, Arithmetic::float32});
  ways.push_back(single);
  if (!c.moves()) return ways;
  Way all{"automatic, double, all swept", asked, false, {}},
      none{"automatic, double, none swept", asked, false, {}};
  all.fidelity.sweep.which = SweepOptions::Which::all;
  none.fidelity.sweep.which = SweepOptions::Which::none;
  ways.push_back(all);
  ways.push_back(none);
  return ways;
}

std::vector<PlanPair> with_double(std::vector<PlanPair> pairs) {
  for (PlanPair& p : pairs) {
    p.balls_first = false;
    p.arithmetic = "double";
    p.ns = p.ns_double;
    p.balls_share = p.cheap_share = 0;
  }
  return pairs;
}

// The least error, relative to the largest coordinate, that double arithmetic can prove (plan.h).
constexpr double least_relative_error = 0x1p-44;

struct Scenery {
  const Course& course;
  EndPoses poses;
  std::vector<std::vector<BodyPair>> candidates;
  std::vector<PlanPhase> phases;
};

// Adds plans with the shapes of `base`: with and without remembered searches, and with double alone. The
// fastest choice pair by pair, or for boxes alone, need not be the fastest in a whole step.
void add_plans(const Scenery& s, const PlanOptions& o, const Fidelity& base, std::vector<Way>& ways) {
  Fidelity f = base;
  const auto measured = choose_methods(s.course, s.poses, s.candidates, o.seed, o.rounds, f);
  std::vector<std::string> broad_phases{s.phases.front().name};
  if (broad_phases.front() != "automatic") broad_phases.emplace_back("automatic");
  for (const std::string& phase : broad_phases) {
    for (const bool remember : {false, true}) {
      f.broad_phase = phase;
      f.remember = remember;
      ways.push_back({"plan", f, true, measured});
    }
    Fidelity all_double = base;
    all_double.broad_phase = phase;
    ways.push_back({"plan", all_double, true, with_double(measured)});
  }
}

void add_planned_ways(const Scenery& s, const PlanOptions& o, double error, std::vector<Way>& ways) {
  const std::size_t before = ways.size();
  Fidelity f = asked_of(o);
  f.error = error;
  f.loose_boxes = true;  // equally safe, and cheaper
  f.solid_meshes = o.solid_meshes;
  if (!f.solid_meshes) add_plans(s, o, f, ways);
  simplify(s.course, f);
  if (std::any_of(f.simpler.begin(), f.simpler.end(), [](const auto& x) { return x.has_value(); }) ||
      ways.size() == before)
    add_plans(s, o, f, ways);
}

double least(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }

// Runs rounds in which every way runs the course once; after the first round, only ways that may still be the
// fastest. Runs `rounds` of them, or more while they are short. Returns the ns of each way and round.
std::vector<std::vector<double>> run_ways(const Course& c, const std::vector<Way>& ways, int rounds,
                                          const PlanProgress& progress) {
  // A way is dropped when it is slower than the best by `after_one` (first round) or `after_more`.
  constexpr double after_one = 1.6, after_more = 1.25, enough_ns = 1e9;
  constexpr int max_rounds = 64;
  std::vector<std::vector<double>> times(ways.size());
  double best = std::numeric_limits<double>::infinity(), spent = 0;
  for (int round = 0; round < rounds || (rounds > 1 && round < max_rounds && spent < enough_ns); ++round)
    for (std::size_t w = 0; w < ways.size(); ++w) {
      if (round > 0 && least(times[w]) > (round == 1 ? after_one : after_more) * best) continue;
      if (progress) progress(fmt::format("round {}: {}", round + 1, ways[w].name));
      times[w].push_back(run_course(c, ways[w].fidelity));
      // A way that misses passes must not set the standard for the others.
      if (ways[w].fidelity.sweep.which != SweepOptions::Which::none) best = std::min(best, times[w].back());
      spent += times[w].back() * static_cast<double>(c.steps.size());
    }
  return times;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

void note_swept(const Course& c, const StepReport& r, std::vector<PlanSwept>& swept) {
  for (const SweptBody& s : r.swept) {
    auto known =
        std::find_if(swept.begin(), swept.end(), [&](const PlanSwept& x) { return x.body == s.body; });
    const bool is_new = known == swept.end();
    if (is_new) known = swept.emplace(swept.end());
    PlanSwept& p = *known;
    const bool farther = is_new || s.pass_bound * p.inner > p.pass_bound * s.inner;
    ++p.steps;
    if (!farther) continue;
    p.body = s.body;
    p.name = c.scene.bodies[at(s.body)].name;
    p.reason = s.reason == SweepReason::turning ? "turning" : "travel";
    p.pass_bound = s.pass_bound;
    p.inner = s.inner;
  }
}

void mark_front(std::vector<PlanRow>& rows) {
  for (PlanRow& r : rows)
    r.front = r.sound() && std::none_of(rows.begin(), rows.end(), [&](const PlanRow& o) {
                return o.sound() && o.ns_min < r.ns_min && o.error <= r.error;
              });
}

// Runs ways and judges their answers. The plan comes first: it determines which bodies must be swept.
struct Judging {
  const Course& course;
  const PlanSample& sample;
  Plan& plan;
  std::vector<std::uint64_t> needed;  // number of bodies swept by the plan, by step

  void judge(const Way& way, const std::vector<double>& times, bool is_plan) {
    PlanRow row;
    row.name = way.name;
    row.is_plan = is_plan;
    row.ns_min = least(times);
    row.ns_median = median(times);
    run_course(course, way.fidelity, [&](int step, const StepReport& r) {
      sample.judge(step, r, plan.error, row);
      row.unanswered += r.outcome != Outcome::answered;
      if (is_plan) {
        needed[at(step)] = r.swept.size();
        plan.unsupported += static_cast<std::uint64_t>(r.unsupported);
        note_swept(course, r, plan.swept);
      } else if (r.swept.size() < needed[at(step)]) {
        row.unswept += needed[at(step)] - r.swept.size();
      }
    });
    plan.rows.push_back(row);
  }
};

void sort_rows(Plan& p) {
  std::stable_sort(p.rows.begin(), p.rows.end(),
                   [](const PlanRow& x, const PlanRow& y) { return x.ns_min < y.ns_min; });
  mark_front(p.rows);
  std::stable_sort(p.swept.begin(), p.swept.end(), [](const PlanSwept& x, const PlanSwept& y) {
    return x.pass_bound * y.inner > y.pass_bound * x.inner;
  });
}

void require_fits(const Course& c, const Fidelity& f) {
  if (f.simpler.size() > c.scene.shapes.size())
    throw InputError("run.simpler", fmt::format("names shape {}; the scene has {}", f.simpler.size() - 1,
                                                c.scene.shapes.size()));
  // Each simpler shape must be what this scene's shape yields; otherwise the plan belongs to another scene.
  for (std::size_t i = 0; i < f.simpler.size(); ++i) {
    if (!f.simpler[i]) continue;
    const auto again = simpler_shape(c.scene.shapes[i], Fidelity::shape_share * f.error, f.solid_meshes);
    if (again != f.simpler[i])
      throw InputError("run.simpler", fmt::format("shape {} is different in this scene", i));
  }
}

}  // namespace

double least_error(const Course& c) {
  double size = 0;
  for (std::size_t i = 0; i < c.scene.bodies.size(); ++i) {
    const double r = bounding_radius(c.scene.shape_of(static_cast<int>(i)));
    if (std::isfinite(r))
      size = std::max(size, r + c.scene.bodies[i].pose.translation.lpNorm<Eigen::Infinity>());
  }
  for (const Course::Step& s : c.steps)
    for (const Course::Move& m : s.moves)
      size = std::max(size, m.start.translation.lpNorm<Eigen::Infinity>() + m.motion.linear.norm());
  return least_relative_error * size;
}

double default_error(const Course& c) {
  constexpr double share_of_smallest = 1e-6;  // of the extent of the smallest shape
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < c.scene.bodies.size(); ++i)
    if (const double e = extent(c.scene.shape_of(static_cast<int>(i))); e > 0)
      smallest = std::min(smallest, e);
  return std::max(least_error(c), std::isfinite(smallest) ? share_of_smallest * smallest : 0);
}

std::vector<double> candidate_errors(double error, double least) {
  // In the scene's unit, the same for every error.
  static constexpr double rungs[] = {1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15};
  std::vector<double> errors{error};
  for (const double rung : rungs)
    if (rung < error && rung >= least) errors.push_back(rung);
  return errors;
}

Plan make_plan(const Course& c, const PlanOptions& o, const PlanProgress& progress) {
  const auto say = [&](const std::string& what) {
    if (progress) progress(what);
  };
  Plan p;
  p.machine = this_machine();
  p.scene = c.name;
  p.seed = o.seed;
  p.bodies = c.scene.bodies.size();
  p.steps = c.steps.size();
  p.least_error = least_error(c);
  p.error = o.given ? o.given->error : o.error > 0 ? o.error : default_error(c);
  if (!(p.error >= p.least_error))
    throw InputError("error", fmt::format("{:g} is less than double can prove on this scene: {:.2g}", p.error,
                                          p.least_error));
  if (o.given) require_fits(c, *o.given);
  const Fidelity asked = asked_of(o);
  p.margin = asked.margin;
  p.verdict_only = asked.verdict_only;
  if (!(p.margin >= 0 && std::isfinite(p.margin)))
    throw InputError("margin", fmt::format("{:g} is not a length", p.margin));

  // The scene for the referee; convex meshes become solids if requested.
  Course solid = c;
  if (o.given ? o.given->solid_meshes : o.solid_meshes) make_solid(solid.scene);
  for (const Shape& s : c.scene.shapes)
    if (const auto* mesh = std::get_if<TriangleMesh>(&s)) p.convex_meshes += convex_solid(*mesh).has_value();

  say("broad phases");
  Scenery scenery{c, end_poses(c), {}, {}};
  const EndPoses& poses = scenery.poses;
  scenery.candidates = course_candidates(c, poses, asked.margin);
  scenery.phases = p.phases = measure_phases(c, poses, o.rounds, asked.margin);
  std::vector<Way> ways;
  if (o.given)
    ways.push_back({"plan", *o.given, true, {}});
  else
    for (const double error : candidate_errors(p.error, p.least_error)) {
      say(fmt::format("pairs of shapes, for an error of {:g}", error));
      add_planned_ways(scenery, o, error, ways);
    }
  const std::size_t planned = ways.size();
  for (Way& w : fixed_ways(c, p.phases, asked)) ways.push_back(std::move(w));
  const auto times = run_ways(c, ways, o.rounds, progress);
  for (const auto& of_way : times) p.rounds = std::max<std::uint64_t>(p.rounds, of_way.size());
  std::size_t best = 0;
  for (std::size_t w = 1; w < planned; ++w)
    if (least(times[w]) < least(times[best])) best = w;

  say("the referee");
  const PlanSample sample(solid, poses, scenery.candidates, o.seed, o.judged, p.margin);
  p.judged = sample.judged();
  p.undecided = sample.undecided();
  Judging judging{c, sample, p, std::vector<std::uint64_t>(c.steps.size(), 0)};
  judging.judge(ways[best], times[best], true);
  for (std::size_t w = planned; w < ways.size(); ++w) judging.judge(ways[w], times[w], false);
  sort_rows(p);
  const Fidelity& chosen = ways[best].fidelity;
  p.pairs = ways[best].pairs;
  p.shapes = shape_rows(c, chosen);
  p.broad_phase = chosen.broad_phase;
  p.solid_meshes = chosen.solid_meshes;
  p.remember = chosen.remember;
  p.sweep_share = chosen.sweep.share;
  p.run = to_json(chosen);
  return p;
}

}  // namespace touchstone::fuzz
