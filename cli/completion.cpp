// Completion scripts. The name of the program in them is `touchstone`, however it was called.
#include <fmt/format.h>

#include <algorithm>

#include "cli/command_tree.h"
#include "core/base/input_error.h"

namespace touchstone::cli {
namespace {

std::string spaced(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : " ") + w;
  return text;
}

// In single quotes of a POSIX shell.
std::string quoted(const std::string& text) {
  std::string r = "'";
  for (const char c : text) r += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return r + "'";
}

std::vector<std::string> option_names(const CommandNode& n, bool with_value_only) {
  std::vector<std::string> names;
  for (const OptionNode& o : n.options)
    if (!with_value_only || !o.value.empty()) names.insert(names.end(), o.names.begin(), o.names.end());
  return names;
}

std::vector<std::string> command_names(const CommandNode& n) {
  std::vector<std::string> names;
  for (const CommandNode& c : n.commands) names.push_back(c.name);
  return names;
}

// --- bash

// One branch for each command: path, its options, those that take a value, its commands.
void add_bash_branches(const CommandNode& n, const std::string& path, std::string& to) {
  to += fmt::format("    {})\n      options={} valued={} commands={} ;;\n", quoted(path),
                    quoted(spaced(option_names(n, false))), quoted(spaced(option_names(n, true))),
                    quoted(spaced(command_names(n))));
  for (const CommandNode& c : n.commands) add_bash_branches(c, path + " " + c.name, to);
}

void add_paths(const CommandNode& n, const std::string& path, std::vector<std::string>& to) {
  for (const CommandNode& c : n.commands) {
    to.push_back(path + " " + c.name);
    add_paths(c, path + " " + c.name, to);
  }
}

std::string bash(const CommandNode& root) {
  std::vector<std::string> paths;
  add_paths(root, "", paths);
  std::string known;
  for (const std::string& p : paths) known += (known.empty() ? "" : " | ") + quoted(p);
  std::string branches;
  add_bash_branches(root, "", branches);
  return fmt::format(R"bash(# Completion of touchstone in bash: eval "$(touchstone completion bash)"
_touchstone() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} path='' i
  local options='' valued='' commands=''
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$path ${{COMP_WORDS[i]}}" in
      {}) path+=" ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case "$path" in
{}  esac
  COMPREPLY=()
  [[ " $valued " == *" $previous "* ]] && return
  if [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  elif [[ -n $commands ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
  fi
}}
complete -o default -F _touchstone touchstone ./touchstone
)bash",
                     known, branches);
}

// --- zsh

// Text within [...] of an _arguments specification.
std::string zsh_text(const std::string& text) {
  std::string r;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') r += '\\';
    r += c == '\n' ? ' ' : c;
  }
  return r;
}

void add_zsh_function(const CommandNode& n, const std::string& function, std::string& to) {
  for (const CommandNode& c : n.commands) add_zsh_function(c, function + "_" + c.name, to);
  to += function + "() {\n";
  std::string specifications;
  for (const OptionNode& o : n.options)
    for (const std::string& name : o.names)
      specifications += " \\\n    " + quoted(name + "[" + zsh_text(o.description) + "]" +
                                             (o.value.empty() ? "" : ":value:_files"));
  if (n.commands.empty()) {
    to += "  _arguments" + specifications + " \\\n    '*:file:_files'\n}\n";
    return;
  }
  to += "  local context state line\n  local -a commands\n  commands=(\n";
  for (const CommandNode& c : n.commands)
    to += "    " + quoted(c.name + ":" + zsh_text(c.description)) + "\n";
  to += "  )\n  _arguments -C" + specifications +
        " \\\n    '1:command:->command' '*::argument:->argument'\n"
        "  case $state in\n    command) _describe command commands ;;\n    argument)\n"
        "      case $words[1] in\n";
  for (const CommandNode& c : n.commands)
    to += fmt::format("        {}) {}_{} ;;\n", c.name, function, c.name);
  to += "      esac ;;\n  esac\n}\n";
}

std::string zsh(const CommandNode& root) {
  std::string functions;
  add_zsh_function(root, "_touchstone", functions);
  return "#compdef touchstone\n# Completion of touchstone in zsh: as the file _touchstone in a directory "
         "of "
         "$fpath.\n" +
         functions + "_touchstone \"$@\"\n";
}

// --- fish

std::string fish_text(const std::string& text) {
  std::string r = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') r += '\\';
    r += c == '\n' ? ' ' : c;
  }
  return r + "'";
}

void add_fish_lines(const CommandNode& n, const std::string& condition, std::string& to) {
  const std::string start =
      "complete -c touchstone" + (condition.empty() ? std::string() : " -n " + fish_text(condition));
  for (const OptionNode& o : n.options) {
    if (o.is_positional()) continue;
    to += start;
    for (const std::string& name : o.names)
      to += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    to += (o.value.empty() ? "" : " -r") + std::string(" -d ") + fish_text(o.description) + "\n";
  }
  const std::string names = spaced(command_names(n));
  for (const CommandNode& c : n.commands) {
    const std::string none = "not __fish_seen_subcommand_from " + names;
    to += fmt::format("complete -c touchstone -n {} -f -a {} -d {}\n",
                      fish_text(condition.empty() ? none : condition + "; and " + none), c.name,
                      fish_text(c.description));
    const std::string seen = "__fish_seen_subcommand_from " + c.name;
    add_fish_lines(c, condition.empty() ? seen : condition + "; and " + seen, to);
  }
}

std::string fish(const CommandNode& root) {
  std::string lines = "# Completion of touchstone in fish: touchstone completion fish | source\n";
  add_fish_lines(root, "", lines);
  return lines;
}

}  // namespace

std::string completion(const CommandNode& root, std::string_view shell) {
  if (shell == "bash") return bash(root);
  if (shell == "zsh") return zsh(root);
  if (shell == "fish") return fish(root);
  throw InputError(std::string(shell), "is not a shell with completion: bash, zsh or fish");
}

}  // namespace touchstone::cli
