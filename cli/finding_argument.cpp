#include "cli/case_argument.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "cli/command.h"
#include "core/base/input_error.h"
#include "fuzz/shrink/keeps_finding.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// A key starts with its engine's name, which may contain dots if the engine is a plug-in.
std::string engine_of(const std::string& key) {
  std::string found;
  const auto consider = [&](std::string_view name) {
    if (key.starts_with(std::string(name) + ".") && name.size() > found.size()) found = name;
  };
  for (const std::string& name : catalogued_names()) consider(name);
  if (found.empty())
    throw InputError("--key", "names no engine in the catalogue: " + key + " (for a plug-in, add --engine)");
  return found;
}

using Findings = std::map<std::string, fuzz::Finding>;

// The finding requested, or the only one; empty if the case shows none (with that key).
std::string choose(const std::string& key, const Findings& findings) {
  if (!key.empty()) return findings.contains(key) ? key : "";
  if (findings.empty()) return {};
  std::string list;
  for (const auto& [each, f] : findings) list += "\n  " + each;
  if (findings.size() > 1) throw InputError("--key", "which finding? The case shows" + list);
  return findings.begin()->first;
}

}  // namespace

std::string stored_key(const std::string& path) {
  std::error_code ec;
  const fs::path directory = fs::is_directory(path, ec) ? fs::path(path) : fs::path(path).parent_path();
  const fs::path beside = directory / "finding.json";
  if (!fs::exists(beside, ec)) return "";
  const Json finding = load_json(beside);
  return JsonReader(finding, beside.string())["key"].string();
}

void add_finding_argument(CLI::App& app, FindingArgument& to) {
  app.add_option("case", to.path, "a finding's directory, a case or scene file, or the name of a scenario")
      ->required();
  app.add_option("--key", to.key,
                 "key of the finding (default: the one in finding.json beside the case, or the only one)");
  app.add_option("--engine", to.engine, "the engine found wrong (default: that of the key, or core)");
}

AskedFinding ask_for_finding(FindingArgument o, const WorkerLimits& limits) {
  AskedFinding r;
  r.stored = case_argument(o.path);
  const std::string stored = o.key.empty() ? stored_key(o.path) : "";
  if (o.engine.empty()) {
    if (o.key.empty()) o.key = stored;
    o.engine = o.key.empty() ? "core" : engine_of(o.key);
  }
  r.engine_name = o.engine;
  r.engine = make_engine(engine_name(o.engine), limits);
  if (o.key.empty() && stored.starts_with(r.engine->card().name + ".")) o.key = stored;
  // Without a key, relations are tried only if the referee finds no fault, since they mostly show the same
  // error.
  r.findings = fuzz::findings_of({&r.stored.c, 1}, r.engine, fuzz::found_by(o.key))[0];
  if (r.findings.empty() && o.key.empty())
    r.findings = fuzz::findings_of({&r.stored.c, 1}, r.engine, fuzz::FoundBy::relations)[0];
  r.key = choose(o.key, r.findings);
  return r;
}

int not_found(const AskedFinding& asked, const FindingArgument& o) {
  fmt::print(stderr, "{} is not found wrong{}\n", asked.engine_name,
             o.key.empty() ? "" : " in this way: " + o.key);
  return exit_failed;
}

}  // namespace touchstone::cli
