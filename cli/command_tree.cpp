#include "cli/command_tree.h"

#include <algorithm>

namespace touchstone::cli {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string value_of(const CLI::Option& o, bool shows_default) {
  if (o.get_items_expected_max() == 0) return "";
  // After a colon: what CLI11 checks.
  const std::string checked = o.get_type_name();
  const std::string type = checked.empty() ? "VALUE" : checked.substr(0, checked.find(':'));
  const std::string& by_default = o.get_default_str();
  if (!shows_default || by_default.empty()) return type;
  if (by_default.front() == '[') return type + " " + by_default;  // a list
  return type + " [" + replaced(by_default, TOUCHSTONE_SOURCE "/", "") + "]";
}

OptionNode node_of(const CLI::Option& o) {
  OptionNode n;
  for (const std::string& s : o.get_snames()) n.names.push_back("-" + s);
  for (const std::string& l : o.get_lnames()) n.names.push_back("--" + l);
  const bool depends_on_machine = std::find(n.names.begin(), n.names.end(), "--jobs") != n.names.end();
  if (n.names.empty()) n.positional = o.get_name(true);
  n.description = o.get_description();
  n.value = value_of(o, !depends_on_machine);
  return n;
}

}  // namespace

CommandNode command_tree(const CLI::App& app) {
  CommandNode n{app.get_name(), app.get_description(), app.get_group(), app.get_footer(), {}, {}};
  for (const CLI::Option* o : app.get_options(std::function<bool(const CLI::Option*)>{}))
    n.options.push_back(node_of(*o));
  // Commands inherit the footer of the program.
  for (const CLI::App* sub : app.get_subcommands(std::function<bool(const CLI::App*)>{})) {
    n.commands.push_back(command_tree(*sub));
    if (n.commands.back().footer == n.footer) n.commands.back().footer.clear();
  }
  return n;
}

}  // namespace touchstone::cli
