#include "cli/release_engines.h"

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/npm_releases.h"
#include "core/base/input_error.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

std::vector<std::string> installed_of(const NpmRow& row) {
  std::vector<std::string> releases;
  for (const NpmEngine& e : installed_releases())
    if (e.row == &row) releases.push_back(e.release);
  if (releases.empty())
    throw InputError("--installed", fmt::format("no release of {0} is installed (engines --install {0}@{1})",
                                                row.name, row.version));
  return releases;
}

}  // namespace

void add_release_choice(CLI::App& app, ReleaseChoice& to) {
  app.add_option("--only", to.only,
                 "only these releases, separated by commas: 0.29.0, or 0.29 for its newest");
  app.add_flag("--installed", to.installed, "only releases that are installed; npm is not asked");
}

std::vector<std::string> chosen_releases(const NpmRow& row, const ReleaseChoice& choice) {
  const std::vector<std::string> there =
      choice.installed ? installed_of(row) : published_releases(row.package);
  if (there.empty()) throw InputError(std::string(row.package), "npm has no release of it");
  if (choice.only.empty()) return there;
  std::vector<std::string> chosen;
  for_each_in_list(choice.only, [&](std::string_view part) {
    const std::string release = newest_matching(there, part);
    if (release.empty())
      throw InputError("--only " + choice.only,
                       fmt::format("{} has no release that begins with '{}'", row.package, part));
    chosen.push_back(release);
  });
  sort_releases(chosen);
  return chosen;
}

const EnginePtr& ReleaseEngines::of(const NpmEngine& engine) {
  const std::string name = engine.name();
  const auto [at, added] = engines_.try_emplace(name);
  if (!added) return at->second;
  if (fetch_npm_engines({engine}) != exit_clean)
    throw InputError("engine " + name, "npm could not install it");
  try {
    at->second = make_engine(name, limits_);
  } catch (const InputError& e) {
    why_not_[name] = e.what();
  }
  return at->second;
}

const NpmRow& npm_row_named(const std::string& name) {
  const auto engine = find_npm_engine(name);
  if (engine && engine->release.empty()) return *engine->row;
  std::string list;
  std::vector<std::string> known;
  for (const NpmRow& row : npm_catalog()) {
    list += fmt::format("{}{}", known.empty() ? "" : ", ", row.name);
    known.emplace_back(row.name);
  }
  throw InputError("engine " + name, fmt::format("is not one that npm has releases of ({}){}", list,
                                                 did_you_mean(name, known)));
}

}  // namespace touchstone::cli
