#include "cli/causes_of_campaign.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "cli/engine_catalog.h"
#include "cli/own_engines.h"
#include "fuzz/causes/respond.h"
#include "oracles/routes/routes.h"

namespace touchstone::cli {
namespace {

using routes::Related;
using routes::Respect;

// How the search for causes calls the other engine, and how much it says when the fault vanishes
// (fuzz/causes/intervention.h): more than any change of the case, but for another solver or path, which share
// little code.
struct RespectRow {
  Respect respect;
  std::string_view name;
  int telling;
};
constexpr RespectRow respect_rows[] = {
    {Respect::settings, "other_settings", 680},
    {Respect::tighter, "tighter", 670},
    {Respect::looser, "looser", 660},
    {Respect::iterations, "more_iterations", 650},
    {Respect::precision, fuzz::other_precision, 640},
    {Respect::solver, "other_solver", 76},
    {Respect::path, "other_path", 74},
};

constexpr std::string_view tuned_suffix = "-tuned";

std::string without_suffix(const std::string& name) {
  std::string r = name.substr(0, name.find('@'));
  if (r.ends_with(tuned_suffix)) r.resize(r.size() - tuned_suffix.size());
  return r;
}

// Settings in a name are replaced, not added to.
std::string other_name(const std::string& engine, const Related& r) {
  const bool replaces_settings =
      r.part != tuned_suffix && r.respect != Respect::precision && r.respect != Respect::path;
  std::string name = replaces_settings ? without_suffix(engine) : engine;
  if (r.part.empty()) return name + std::string(r.by);
  const auto at = name.find(r.part);
  return at == std::string::npos ? "" : name.replace(at, r.part.size(), r.by);
}

std::vector<fuzz::OtherEngine> others(const std::string& engine) {
  std::vector<fuzz::OtherEngine> all;
  if (is_foreign(engine)) return all;
  const std::string in_adapter = name_in_adapter(engine);
  const routes::Library* library = routes::library_of(in_adapter);
  if (!library) return all;
  for (const Related& r : library->related) {
    if (!in_adapter.starts_with(r.engines)) continue;
    const RespectRow& row = *std::ranges::find(respect_rows, r.respect, &RespectRow::respect);
    const bool known =
        std::ranges::any_of(all, [&](const fuzz::OtherEngine& o) { return o.name == row.name; });
    const std::string other = other_name(in_adapter, r);
    if (known || other.empty()) continue;
    const std::string name = beside(engine, other);
    if (name == engine || !is_catalogued(name)) continue;
    all.push_back({std::string(row.name), std::string(r.change), std::string(r.if_gone), name, row.telling,
                   r.other_calls});
  }
  return all;
}

std::string path_in_adapter(const std::string& engine) {
  const std::string r = without_suffix(engine);
  const routes::Library* library = routes::library_of(r);
  if (library)
    for (const routes::SameCode& same : library->same_code)
      if (r.starts_with(same.begins)) return std::string(same.code) + r.substr(same.begins.size());
  return r;
}

// The user's own build of a library shares no code with the build's.
std::string path_of(const std::string& engine) {
  return beside(engine, path_in_adapter(name_in_adapter(engine)));
}

std::string route_of(const std::string& engine, Question question, ShapeKind a, ShapeKind b) {
  return std::string(routes::route_of(path_in_adapter(name_in_adapter(engine)), {question, a, b}));
}

bool knows_routes(const std::string& engine) {
  return routes::library_of(path_in_adapter(name_in_adapter(engine))) != nullptr;
}

std::string documented(const std::string& name, const fuzz::Symptom& s, const std::string& route, Fault f,
                       bool parting) {
  const std::string engine = name_in_adapter(name);
  const std::string_view always = routes::documented(engine, s.question, route, f);
  return std::string(always.empty() && parting ? routes::documented_of_parting(engine) : always);
}

// True when some engine of the catalogue has this path.
bool is_catalogued_path(const std::string& path) {
  return std::ranges::any_of(catalogued_names(),
                             [&](const std::string& name) { return path_of(name) == path; });
}

}  // namespace

std::string library_of(const std::string& path) {
  const std::string first = path.substr(0, path.find(", "));  // a cause may have several paths
  const routes::Library* library = routes::library_of(first);
  return library && is_catalogued_path(first) ? std::string(library->name) : path;
}

fuzz::EngineKnowledge catalogued_knowledge() { return {path_of, route_of, knows_routes, documented, others}; }

}  // namespace touchstone::cli
