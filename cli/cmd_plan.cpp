#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "cli/case_argument.h"
#include "cli/command.h"
#include "cli/import_options.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "core/shape/convex_body.h"
#include "oracles/routes/routes.h"
#include "reports/plan/plan.h"
#include "reports/text/record_text.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/import/real_scene.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

struct PlanArguments {
  std::string scene, out, use, page;
  fuzz::PlanOptions plan;
  int steps = 24;
  bool json = false;
  ImportOptions import;
};

fuzz::Course course_named(const PlanArguments& o) {
  const auto of = [&](const auto& make) {
    try {
      return make();
    } catch (const InputError& e) {
      throw InputError(o.scene + ": " + e.place(), e.reason());
    }
  };
  if (is_recording(o.scene)) {
    const RealScene recorded = load_real_scene(o.scene);
    return of([&] { return fuzz::course_of(recorded, o.steps); });
  }
  Case c = case_argument(o.scene, o.import).c;
  if (c.scene.name.empty()) c.scene.name = std::filesystem::path(o.scene).stem().string();
  return of([&] { return fuzz::course_of(c.scene); });
}

Fidelity plan_in(const std::string& file) {
  const fuzz::Json json = load_json(file);
  const JsonReader j(json, file);
  if (!j.has("touchstone_plan") || j["touchstone_plan"].json() != 1 || !j.has("run"))
    throw InputError(file, "is not a plan of version 1");
  return fuzz::fidelity_from_json(j["run"].json(), file + ": run");
}

routes::Needs::Broad kind_of_broad_phase(std::string_view name) {
  using enum routes::Needs::Broad;
  return name == "brute_force" ? all_pairs : name.ends_with("_sweep") ? sweep : tree;
}

bool is_curved(const Shape& s) {
  return std::visit([]<class S>(const S&) { return is_convex_shape<S> && !is_polytope_shape<S>; }, s);
}

routes::Needs needs_of(const fuzz::Plan& p, const std::vector<Shape>& shapes) {
  // The least error is 2^-44 of the largest coordinate (reports/plan/plan.h); a float rounds it by 2^-24.
  constexpr double float_over_least = 0x1p20;
  routes::Needs n{.broad = kind_of_broad_phase(p.broad_phase),
                  .error = p.error,
                  .float_rounding = float_over_least * p.least_error,
                  .margin = p.margin,
                  .verdict_only = p.verdict_only,
                  .travel_share = 2 * p.sweep_share};  // of a body that does not turn: |v|/2 > share · r
  for (const Shape& s : shapes) {
    n.curved |= is_curved(s);
    n.half_spaces |= kind_of(s) == ShapeKind::half_space;
    n.surfaces |= is_mesh(s);
  }
  for (const fuzz::PlanSwept& s : p.swept) (s.reason == "turning" ? n.turning : n.travel) = true;
  return n;
}

std::vector<fuzz::PlanTerms> terms_of_libraries(const routes::Needs& n) {
  std::vector<fuzz::PlanTerms> all;
  for (const routes::Library& l : routes::libraries())
    if (l.terms) all.push_back({std::string(l.name), l.terms(n)});
  return all;
}

// What was given, without the files to write.
std::string command_of(const CLI::App& given) {
  std::string s = program_name() + " plan";
  for (const CLI::Option* o : given.get_options([](const CLI::Option* x) { return x->count() > 0; })) {
    const std::string name = o->get_name();
    if (name == "--out" || name == "--page" || name == "--json") continue;
    if (!o->get_positional()) s += " " + name;
    if (o->get_items_expected_max() == 0) continue;  // a flag
    for (const std::string& value : o->results()) s += " " + shell_word(value);
  }
  return s;
}

int run(PlanArguments o, const CLI::App& given) {
  if (given.count("--error") > 0 && !(o.plan.error > 0 && std::isfinite(o.plan.error)))
    throw InputError("--error", fmt::format("{} is not a positive length", o.plan.error));
  if (!(o.plan.margin >= 0 && std::isfinite(o.plan.margin)))
    throw InputError("--margin", fmt::format("{} is not a length", o.plan.margin));
  prepare_output(o.out);
  prepare_output(o.page);
  if (!o.use.empty()) o.plan.given = plan_in(o.use);
  const fuzz::Course course = course_named(o);
  const bool live = isatty(2) == 1;
  fuzz::Plan plan = fuzz::make_plan(course, o.plan, [live](const std::string& what) {
    if (live) fmt::print(stderr, "\r\033[K{}", what);
  });
  if (live) fmt::print(stderr, "\r\033[K");
  plan.terms = terms_of_libraries(needs_of(plan, course.scene.shapes));
  const std::string json = fuzz::to_json(plan).dump(1) + "\n";
  if (!o.out.empty()) write_file(o.out, json);
  fmt::print("{}", o.json ? json : reports::plan_text(plan));
  if (!o.out.empty())
    fmt::print(o.json ? stderr : stdout, "{}: run it with StepWorld, or measure it again with --use\n",
               o.out);
  if (!o.page.empty()) {
    if (!write_page("plan", json_text(reports::plan_page(plan, command_of(given))), o.page))
      return exit_failed;
    fmt::print(stderr, "{}: open it in a browser\n", printable(o.page));
  }
  for (const fuzz::PlanRow& r : plan.rows)
    if (r.is_plan && r.outside > 0) return exit_wrong;
  return plan.judged > plan.undecided ? exit_clean : exit_failed;
}

}  // namespace

Run declare_plan(CLI::App& app) {
  auto o = std::make_shared<PlanArguments>();
  app.add_option(
         "scene", o->scene,
         "scene or case file, robot or world file, name of a scenario, or directory of a recorded scene")
      ->required();
  auto* error =
      app.add_option("--error", o->plan.error,
                     "largest error of a gap or depth, in the scene's unit (default: a millionth of the "
                     "smallest body)");
  auto* margin = app.add_option("--margin", o->plan.margin,
                                "report pairs whose gap is at most this, in the scene's unit, and their gaps")
                     ->capture_default_str();
  auto* verdict = app.add_flag("--verdict-only", o->plan.verdict_only,
                               "only which pairs overlap, or are within the margin: no depths and gaps");
  app.add_flag("--solid-meshes", o->plan.solid_meshes, "treat closed convex meshes as solids");
  app.add_option("--use", o->use, "measure and judge this plan instead of choosing one")
      ->excludes(error)
      ->excludes(margin)
      ->excludes(verdict);
  app.add_option("-o,--out", o->out, "file for the plan (JSON), which StepWorld can run");
  app.add_option("--page", o->page, "file for a page with all bodies, pairs and choices");
  app.add_option("--steps", o->steps, "number of steps of a recording to use")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--rounds", o->plan.rounds, "interleaved measurements of each choice; the fastest counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--judged", o->plan.judged, "number of pairs that the referee judges")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--seed", o->plan.seed, "seed of the samples")->capture_default_str();
  add_import_options(app, o->import);
  app.add_flag("--json", o->json, "the whole result as one JSON document on stdout");
  return [o, &app] { return run(*o, app); };
}

}  // namespace touchstone::cli
