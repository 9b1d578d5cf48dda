#include "cli/chosen_engines.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/input_error.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string subject_by_rule(const Names& chosen) {
  if (chosen.size() == 1) return chosen[0];
  if (contains(chosen, "core")) return "core";
  throw InputError("--subject", "which of " + joined(chosen) + " decides the exit code? (--subject NAME)");
}

// The plug-in or pipe among `chosen` whose card has this name; empty if there is none.
std::string named_on_card(const std::string& card_name, const Names& chosen, const WorkerLimits& limits) {
  for (const std::string& name : chosen)
    if (is_foreign(name) && make_engine(name, limits)->card().name == card_name) return name;
  return "";
}

std::string subject_given(const std::string& subject, const Names& chosen, const WorkerLimits& limits) {
  if (contains(chosen, subject)) return subject;
  if (!is_foreign(subject) && !is_catalogued(subject))
    if (const std::string name = named_on_card(subject, chosen, limits); !name.empty()) return name;
  try {
    return engine_name(subject);
  } catch (const InputError& e) {
    throw InputError("--subject", e.what());
  }
}

}  // namespace

void add_engine_choice(CLI::App& app, EngineChoice& to, const std::string& names) {
  app.add_option(names, to.engines,
                 "engines to query: names, libraries (bullet), plug-in paths, pipe:COMMAND, all")
      ->capture_default_str();
  app.add_option("--subject", to.subject,
                 "the engine whose faults decide the exit code (default: the only one queried, or core)");
}

ChosenEngines chosen_engines(const EngineChoice& choice, const WorkerLimits& limits) {
  ChosenEngines r;
  r.names = engine_names(choice.engines);
  const std::string subject =
      choice.subject.empty() ? subject_by_rule(r.names) : subject_given(choice.subject, r.names, limits);
  if (!contains(r.names, subject)) r.names.insert(r.names.begin(), subject);
  r.subject = subject;
  if (!is_foreign(subject)) return r;
  const EnginePtr engine = make_engine(subject, limits);
  r.subject = engine->card().name;
  r.shapes = engine->card().shapes;
  return r;
}

std::vector<EnginePtr> make_engines(const std::vector<std::string>& names, const WorkerLimits& limits) {
  std::vector<EnginePtr> engines;
  std::map<std::string, std::string> by_card;
  for (const std::string& name : names) {
    engines.push_back(make_engine(name, limits));
    const std::string& card_name = engines.back()->card().name;
    const auto [it, added] = by_card.try_emplace(card_name, name);
    if (!added)
      throw InputError("--engines",
                       fmt::format("{} and {} are both called {}, so their results could not be told apart",
                                   it->second, name, card_name));
  }
  return engines;
}

void require_subject(const std::string& subject, const std::vector<std::string>& known,
                     const std::string& what) {
  if (contains(known, subject)) return;
  throw InputError("--subject", fmt::format("{} is not one of {} ({}){}", subject, what, joined(known),
                                            did_you_mean(subject, known)));
}

int print_verdict(int code, const std::string& subject, const std::string& why, bool json) {
  fmt::print(json ? stderr : stdout, "exit code {} is about {}: {}\n", code, subject, why);
  return code;
}

}  // namespace touchstone::cli
