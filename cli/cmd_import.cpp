#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "cli/command.h"
#include "cli/import_options.h"
#include "cli/mcap_trajectory.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "reports/text/text.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/text/printable.h"
#include "scenarios/value/candidate_pairs.h"

namespace touchstone::cli {
namespace {

struct ImportArguments {
  std::string file, out;
  ImportOptions import;
};

std::string kinds_of(const Scene& scene) {
  std::map<std::string, std::uint64_t> count;
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i)
    ++count[std::string(type_name(scene.shape_of(i)))];
  std::vector<std::string> words;
  for (const auto& [kind, n] : count) words.push_back(fmt::format("{} {}", n, kind));
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

std::vector<std::string> variables_of(const Model& model) {
  std::vector<std::string> names;
  for (const ModelJoint& j : model.joints)
    if (!j.mimic)
      for (const std::string& n : variable_names(j)) names.push_back(printable(n));
  return names;
}

std::string pairs_words(const Scene& scene) {
  const int n = static_cast<int>(scene.bodies.size());
  std::uint64_t asked = 0, filtered = 0;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      asked += is_reportable(scene, a, b);
      filtered += is_filtered(scene, a, b);
    }
  const std::uint64_t all = n > 0 ? static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(n - 1) / 2 : 0;
  return fmt::format("{} asked, {} filtered, {} of two static bodies", reports::grouped(asked),
                     reports::grouped(filtered), reports::grouped(all - asked - filtered));
}

std::string summary(const ImportArguments& o, const ImportedModel& m, const Scene& scene) {
  const auto line = [](const std::string& label, const std::string& words) {
    constexpr std::size_t label_width = 10;
    return reports::labelled(label, label_width, words);
  };
  std::string text = fmt::format("{}: {}\n", printable(o.file), printable(m.model.name));
  text += line("links", fmt::format("{}, {} joints", m.model.links.size(), m.model.joints.size()));
  const auto variables = variables_of(m.model);
  if (!variables.empty())
    text += line("variables", fmt::format("{}: {}", variables.size(), fmt::join(variables, ", ")));
  text += line("bodies", fmt::format("{}: {}", scene.bodies.size(), kinds_of(scene)));
  text += line("pairs", pairs_words(scene));
  if (m.adjacent_filters > 0)
    text +=
        line("", fmt::format("no SRDF says which pairs to check: {} pairs of links that one joint connects "
                             "or that cannot move relative to each other are filtered",
                             m.adjacent_filters));
  std::vector<std::string> states;
  for (const NamedState& s : m.model.states) states.push_back(printable(s.name));
  if (!states.empty()) text += line("states", fmt::format("{}", fmt::join(states, ", ")));
  if (m.configurations.size() > 1) text += line("steps", reports::grouped(m.configurations.size()));
  return text;
}

int run(const ImportArguments& o) {
  prepare_output(o.out);
  const ImportedModel imported = import_model(o.file, with_trajectory_text(o.import));
  const Scene scene = scene_of(imported);
  print_import_notes(o.file, imported);
  if (!o.out.empty()) save_scene(scene, o.out);
  fmt::print("{}", summary(o, imported, scene));
  if (!o.out.empty()) fmt::print("{}\n", printable(o.out));
  return exit_clean;
}

}  // namespace

Run declare_import(CLI::App& app) {
  auto o = std::make_shared<ImportArguments>();
  app.add_option("file", o->file, "robot, world or mesh: " + importable_endings())->required();
  add_import_options(app, o->import);
  app.add_option("-o,--out", o->out, "file for the scene (JSON)");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
