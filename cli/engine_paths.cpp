#include "cli/engine_paths.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/engine_catalog.h"
#include "cli/own_engines.h"
#include "fuzz/causes/respond.h"
#include "oracles/routes/routes.h"

namespace touchstone::cli {
namespace {

// A way to put a question differently: the name of the other engine is that of the engine with `part`
// replaced by `by`.
struct OtherRow {
  std::string_view engines;  // those whose names begin so
  std::string_view part, by;
  std::string_view name, change, if_gone;
};

constexpr std::string_view double_name = fuzz::other_precision, settings_name = "other_settings",
                           looser_name = "looser", tighter_name = "tighter", path_name = "other_path",
                           solver_name = "other_solver", iterations_name = "more_iterations";

constexpr OtherRow other_rows[] = {
    {"bullet-f32-", "-f32-", "-f64-", double_name, "asked in double precision",
     "only in single precision: vanishes in double"},
    {"bullet-f64-", "-f64-", "-f32-", double_name, "asked in single precision", "only in double precision"},
    {"fcl-libccd-tuned", "-tuned", "", settings_name, "asked as shipped", "only with tight tolerances"},
    {"fcl-indep-tuned", "-tuned", "", settings_name, "asked as shipped", "only with tight tolerances"},
    {"libccd-gjk-tuned", "-tuned", "", settings_name, "asked as shipped", "only with tight tolerances"},
    {"libccd-mpr-tuned", "-tuned", "", settings_name, "asked as shipped", "only with tight tolerances"},
    {"fcl-libccd", "", "-tuned", settings_name, "asked with tight tolerances",
     "a matter of settings: vanishes with tight tolerances"},
    {"fcl-indep", "", "-tuned", settings_name, "asked with tight tolerances",
     "a matter of settings: vanishes with tight tolerances"},
    {"libccd-gjk", "", "-tuned", settings_name, "asked with tight tolerances",
     "a matter of settings: vanishes with tight tolerances"},
    {"libccd-mpr", "", "-tuned", settings_name, "asked with tight tolerances",
     "a matter of settings: vanishes with tight tolerances"},
    {"bullet-f32-query-tuned", "-tuned", "", settings_name, "asked with default margins",
     "only without margins"},
    {"bullet-f32-sim-tuned", "-tuned", "", settings_name, "asked with default margins",
     "only without margins"},
    {"bullet-f64-query-tuned", "-tuned", "", settings_name, "asked with default margins",
     "only without margins"},
    {"bullet-f64-sim-tuned", "-tuned", "", settings_name, "asked with default margins",
     "only without margins"},
    {"bullet-", "", "-tuned", settings_name, "asked with margin 0", "vanishes with margin 0"},
    {"fcl-libccd", "", "@1e-3", looser_name, "tolerances 1e-3", "vanishes with looser tolerances"},
    {"fcl-indep", "", "@1e-3", looser_name, "tolerances 1e-3", "vanishes with looser tolerances"},
    {"libccd-gjk", "", "@1e-2", looser_name, "tolerances 1e-2", "vanishes with looser tolerances"},
    {"libccd-mpr", "", "@1e-2", looser_name, "tolerance 1e-2", "vanishes with looser tolerances"},
    {"fcl-libccd", "", "@1e-9", tighter_name, "tolerances 1e-9", "vanishes with tighter tolerances"},
    {"fcl-indep", "", "@1e-9", tighter_name, "tolerances 1e-9", "vanishes with tighter tolerances"},
    {"libccd-gjk", "", "@1e-8", tighter_name, "tolerances 1e-8", "vanishes with tighter tolerances"},
    {"libccd-mpr", "", "@1e-8", tighter_name, "tolerance 1e-8", "vanishes with tighter tolerances"},
    {"bullet-f32-query", "query", "epa@1e-9", tighter_name, "EPA tolerance 1e-9",
     "vanishes with a tighter EPA tolerance"},
    {"bullet-f64-query", "query", "epa@1e-9", tighter_name, "EPA tolerance 1e-9",
     "vanishes with a tighter EPA tolerance"},
    {"libccd-gjk", "", "-iterations@128", iterations_name, "at most 128 iterations",
     "vanishes with a limit of iterations"},
    {"libccd-mpr", "", "-iterations@128", iterations_name, "at most 128 iterations",
     "vanishes with a limit of iterations"},
    {"bullet-f32-query", "query", "sim", path_name, "asked by the simulation",
     "only in queries: vanishes in the simulation"},
    {"bullet-f64-query", "query", "sim", path_name, "asked by the simulation",
     "only in queries: vanishes in the simulation"},
    {"bullet-f32-sim", "sim", "query", path_name, "asked by a query",
     "only in the simulation: vanishes in a query"},
    {"bullet-f64-sim", "sim", "query", path_name, "asked by a query",
     "only in the simulation: vanishes in a query"},
    {"fcl-libccd", "libccd", "indep", solver_name, "asked with GST_INDEP", "only with GST_LIBCCD"},
    {"fcl-indep", "indep", "libccd", solver_name, "asked with GST_LIBCCD", "only with GST_INDEP"},
    {"libccd-gjk", "gjk", "mpr", solver_name, "asked by MPR", "in GJK or EPA: vanishes with MPR"},
    {"libccd-mpr", "mpr", "gjk", solver_name, "asked by GJK and EPA", "in MPR: vanishes with GJK and EPA"},
    {"bullet-f32-query", "query", "minkowski@0", solver_name, "asked with the Minkowski depth solver",
     "in EPA: vanishes with the Minkowski depth solver"},
    {"bullet-f64-query", "query", "minkowski@0", solver_name, "asked with the Minkowski depth solver",
     "in EPA: vanishes with the Minkowski depth solver"},
};

// How much it says when the fault vanishes (fuzz/causes/intervention.h): more than any change of the case,
// but for another solver or path, which share little code.
struct TellingRow {
  std::string_view name;
  int telling;
};
constexpr TellingRow telling_rows[] = {
    {settings_name, 680}, {tighter_name, 670}, {looser_name, 660}, {iterations_name, 650},
    {double_name, 640},   {solver_name, 76},   {path_name, 74},
};

// FCL's settings name other calls (oracles/fcl/queries.cpp): the signed distance as shipped and the unsigned
// one with tight tolerances; for the libccd solver, contacts by the signed distance instead of collide(); and
// conservative advancement instead of ten samples.
std::vector<Question> other_calls(const std::string& engine, const OtherRow& row) {
  if (row.name != settings_name || !engine.starts_with("fcl-")) return {};
  if (engine.starts_with("fcl-indep")) return {Question::distance, Question::time_of_impact};
  return {Question::distance, Question::contact, Question::time_of_impact};
}

constexpr std::string_view tuned_suffix = "-tuned";

std::string without_suffix(const std::string& name) {
  std::string r = name.substr(0, name.find('@'));
  if (r.ends_with(tuned_suffix)) r.resize(r.size() - tuned_suffix.size());
  return r;
}

// Settings in a name are replaced, not added to.
std::string other_name(const std::string& engine, const OtherRow& row) {
  const bool replaces_settings = row.part != tuned_suffix && row.name != double_name && row.name != path_name;
  std::string r = replaces_settings ? without_suffix(engine) : engine;
  if (row.part.empty()) return r + std::string(row.by);
  const auto at = r.find(row.part);
  return at == std::string::npos ? "" : r.replace(at, row.part.size(), row.by);
}

std::vector<fuzz::OtherEngine> others(const std::string& engine) {
  std::vector<fuzz::OtherEngine> all;
  if (is_foreign(engine)) return all;
  const std::string in_adapter = name_in_adapter(engine);
  for (const OtherRow& row : other_rows) {
    if (!in_adapter.starts_with(row.engines)) continue;
    const bool known =
        std::ranges::any_of(all, [&](const fuzz::OtherEngine& o) { return o.name == row.name; });
    const std::string other = other_name(in_adapter, row);
    if (known || other.empty()) continue;
    const std::string name = beside(engine, other);
    if (name == engine || !is_catalogued(name)) continue;
    all.push_back({std::string(row.name), std::string(row.change), std::string(row.if_gone), name,
                   std::ranges::find(telling_rows, row.name, &TellingRow::name)->telling,
                   other_calls(in_adapter, row)});
  }
  return all;
}

std::string path_in_adapter(const std::string& engine) {
  std::string r = without_suffix(engine);
  for (const std::string_view precision : {"bullet-f32-", "bullet-f64-"})
    if (r.starts_with(precision)) r.replace(0, precision.size(), "bullet-");
  return r;
}

// The user's own build of a library shares no code with the build's.
std::string path_of(const std::string& engine) {
  return beside(engine, path_in_adapter(name_in_adapter(engine)));
}

// Empty for an engine whose routines are not known.
std::optional<std::string_view> known_route(const std::string& engine, const routes::Pair& p) {
  const std::string path = path_in_adapter(name_in_adapter(engine));
  if (path.starts_with("fcl-")) return routes::fcl_route(p);
  if (path.starts_with("bullet-")) return routes::bullet_route(p, path.find("sim") != path.npos);
  if (path.starts_with("libccd-")) return routes::libccd_route(p);
  if (path == "ode") return routes::ode_route(p);
  if (path == "dart" || path.starts_with("dart-")) return routes::dart_route(path, p);
  if (path == "mujoco2") return routes::mujoco2_route(p);
  if (path.starts_with("mujoco")) return routes::mujoco_route(p);
  if (path.starts_with("physx-")) return routes::physx_route(path, p);
  return std::nullopt;
}

std::string route_of(const std::string& engine, Question question, ShapeKind a, ShapeKind b) {
  const routes::Pair p{question, a, b};
  return std::string(known_route(engine, p).value_or(routes::common_route(p)));
}

bool knows_routes(const std::string& engine) {
  return known_route(engine, {Question::overlap, ShapeKind::sphere, ShapeKind::sphere}).has_value();
}

std::string documented(const std::string& name, const fuzz::Symptom& s, const std::string& route, Fault f) {
  const std::string engine = name_in_adapter(name);
  if (engine.starts_with("fcl-")) return std::string(routes::fcl_documents(engine, s.question, route, f));
  if (engine.starts_with("libccd-"))
    return std::string(routes::libccd_documents(engine, s.question, route, f));
  if (engine.starts_with("mujoco"))
    return std::string(routes::mujoco_documents(engine, s.question, route, f));
  return "";
}

// True when some engine of the catalogue has this path.
bool is_catalogued_path(const std::string& path) {
  return std::ranges::any_of(catalogued_names(),
                             [&](const std::string& name) { return path_of(name) == path; });
}

}  // namespace

std::string library_of(const std::string& path) {
  struct Library {
    std::string_view paths, name;
  };
  constexpr Library libraries[] = {
      {"fcl-", "FCL"}, {"bullet-", "Bullet"}, {"libccd-", "libccd"}, {"ode", "ODE"}, {"core", "the core"}};
  const std::string first = path.substr(0, path.find(", "));  // a cause may have several paths
  for (const Library& l : libraries)
    if (first.starts_with(l.paths) && is_catalogued_path(first)) return std::string(l.name);
  return path;
}

fuzz::EngineKnowledge catalogued_knowledge() { return {path_of, route_of, knows_routes, documented, others}; }

}  // namespace touchstone::cli
