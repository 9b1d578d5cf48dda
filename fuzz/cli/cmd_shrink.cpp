// touchstone shrink CASE: the smallest case that shows the same finding.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "core/scene/input_file.h"
#include "fuzz/cli/case_argument.h"
#include "fuzz/cli/command.h"
#include "fuzz/cli/engine_catalog.h"
#include "fuzz/shrink/keeps_finding.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Options {
  std::string path, out, engine, key;
  std::size_t tries = 20000;
  bool json = false;
  WorkerLimits limits;
};

// Of a finding's directory: the key that its finding.json names.
std::string stored_key(const std::string& path) {
  const fs::path beside =
      (fs::is_directory(path) ? fs::path(path) : fs::path(path).parent_path()) / "finding.json";
  if (!fs::exists(beside)) return {};
  try {
    return Json::parse(read_file(beside, std::uintmax_t{1} << 28)).at("key");
  } catch (const Json::exception& e) {
    throw InputError(beside.string(), std::string("is not a finding: ") + e.what());
  }
}

// A key starts with its engine's name; those of plug-ins may hold dots themselves.
std::string engine_of(const std::string& key) {
  std::string found;
  for (const EngineRow& row : engine_catalog())
    if (key.starts_with(std::string(row.name) + ".") && row.name.size() > found.size()) found = row.name;
  if (found.empty())
    throw InputError("--key", "names no engine of the catalog: " + key + " (give --engine for a plug-in)");
  return found;
}

using Findings = std::map<std::string, fuzz::Finding>;

// The finding asked for, or the only one; empty: the case shows none (of that key).
std::string choose(const std::string& key, const Findings& findings) {
  if (!key.empty()) return findings.contains(key) ? key : "";
  if (findings.empty()) return {};
  std::string list;
  for (const auto& [each, f] : findings) list += "\n  " + each;
  if (findings.size() > 1) throw InputError("--key", "which finding? The case shows" + list);
  return findings.begin()->first;
}

std::string in_words(const fuzz::Measure& m) {
  return fmt::format("{} bodies, {} steps, {} bits", m.bodies, m.steps, m.bits);
}

Json to_json(const fuzz::Measure& m) { return {{"bodies", m.bodies}, {"steps", m.steps}, {"bits", m.bits}}; }

void print(const Options& o, const std::string& key, const fuzz::Shrunk& r, const StoredCase& result) {
  if (o.json) {
    const Json j = {{"key", key},
                    {"exit", to_string(r.exit)},
                    {"tried", r.tried},
                    {"before", to_json(r.before)},
                    {"after", to_json(r.after)},
                    {"case", stored_case_to_json(result)}};
    fmt::print("{}\n", j.dump(1));
    return;
  }
  fmt::print(stderr, "{}\nbefore: {}\nafter:  {} ({}, {} cases tried)\n", key, in_words(r.before),
             in_words(r.after), to_string(r.exit), r.tried);
  if (o.out.empty())
    fmt::print("{}", to_text(result));
  else
    fmt::print("{}\n", o.out);
}

int run(Options o) {
  StoredCase stored = case_argument(o.path);
  if (o.key.empty() && o.engine.empty()) o.key = stored_key(o.path);
  if (o.engine.empty()) o.engine = o.key.empty() ? "core" : engine_of(o.key);
  const EnginePtr engine = make_engine(engine_names(o.engine).at(0), o.limits);
  const std::string key = choose(o.key, fuzz::findings_of({&stored.c, 1}, engine)[0]);
  if (key.empty()) {
    fmt::print(stderr, "{} is not found wrong{}\n", o.engine, o.key.empty() ? "" : " in this way: " + o.key);
    return exit_failed;
  }
  const auto shrunk = fuzz::shrink(stored.c, fuzz::keeps_finding(engine, key), o.tries);
  StoredCase result;
  result.c = shrunk.smallest;
  result.description = "shows " + key;
  result.source = "shrunk from " + (stored.source.empty() ? stored.c.id : stored.source);
  if (!o.out.empty()) save_case(result, o.out);
  print(o, key, shrunk, result);
  if (shrunk.exit == fuzz::ShrinkExit::not_shown) {
    fmt::print(stderr, "the finding came once and not again: the engine does not answer the same twice\n");
    return exit_failed;
  }
  return exit_clean;
}

}  // namespace

Run declare_shrink(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("case", o->path, "a finding's directory, a case or scene file, or the name of a scenario")
      ->required();
  app.add_option("-o,--out", o->out, "file for the shrunk case (default: stdout)");
  app.add_option("--key", o->key,
                 "the finding to keep (default: that of finding.json beside the case, or the only one)");
  app.add_option("--engine", o->engine, "the engine found wrong (default: that of the key, or core)");
  app.add_option("--tries", o->tries, "cases to ask about at most")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
