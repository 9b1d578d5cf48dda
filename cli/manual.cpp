// The manual page and the command reference.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "cli/command_tree.h"

namespace touchstone::cli {
namespace {

constexpr std::string_view exit_codes[][2] = {{"0", "clean: the subject was not found wrong"},
                                              {"1", "the subject was found wrong"},
                                              {"2", "bad usage or input"},
                                              {"3", "the run failed or proved nothing"},
                                              {"125", "it cannot be told (bisect commit)"}};

std::string names_of(const OptionNode& o) {
  if (o.is_positional()) return o.positional;
  std::string text;
  for (const std::string& name : o.names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

bool is_shown(const OptionNode& o) {
  return std::find(o.names.begin(), o.names.end(), "--help") == o.names.end();
}

// As a sentence.
std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text.ends_with('?') ? text : text + ".";
}

std::string synopsis(const CommandNode& n, const std::string& path) {
  std::string text = path;
  if (!n.commands.empty()) return text + " COMMAND";
  if (std::any_of(n.options.begin(), n.options.end(),
                  [](const OptionNode& o) { return !o.is_positional() && is_shown(o); }))
    text += " [OPTIONS]";
  for (const OptionNode& o : n.options)
    if (o.is_positional()) text += " " + o.positional;
  return text;
}

// --- roff

std::string roff(const std::string& text) {
  std::string r;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) r += "\\&";
    if (c == '\\')
      r += "\\e";
    else if (c == '-')
      r += "\\-";
    else
      r += c;
    at_start = c == '\n';
  }
  return r;
}

void add_roff_command(const CommandNode& n, const std::string& path, std::string& to) {
  to += ".SS " + roff(synopsis(n, path)) + "\n" + roff(sentence(n.description)) + "\n";
  for (const OptionNode& o : n.options) {
    if (!is_shown(o)) continue;
    to += ".TP\n.B " + roff(names_of(o)) + (o.value.empty() ? "" : " \\fI" + roff(o.value) + "\\fR") + "\n" +
          roff(o.description) + "\n";
  }
  if (!n.footer.empty()) to += ".PP\n.nf\n" + roff(n.footer) + "\n.fi\n";
  for (const CommandNode& c : n.commands) add_roff_command(c, path + " " + c.name, to);
}

// --- Markdown

// Outside code: what Markdown and HTML would take for markup.
std::string markdown(const std::string& text) {
  std::string r;
  for (const char c : text) {
    if (c == '<') {
      r += "&lt;";
      continue;
    }
    if (c == '*' || c == '_' || c == '|' || c == '[' || c == '`') r += '\\';
    r += c == '\n' ? ' ' : c;
  }
  return r;
}

void add_markdown_command(const CommandNode& n, const std::string& path, std::string& to) {
  to += fmt::format("### {}\n\n{}\n\n```console\n{}\n```\n\n", path, markdown(sentence(n.description)),
                    synopsis(n, "./" + path));
  bool any = false;
  for (const OptionNode& o : n.options) {
    if (!is_shown(o)) continue;
    if (!any) to += "| option | |\n|---|---|\n";
    any = true;
    to += fmt::format("| `{}{}` | {} |\n", names_of(o), o.value.empty() ? "" : " " + o.value,
                      markdown(o.description));
  }
  if (any) to += "\n";
  if (!n.footer.empty()) to += "```console\n" + n.footer + "\n```\n\n";
  for (const CommandNode& c : n.commands) add_markdown_command(c, path + " " + c.name, to);
}

}  // namespace

std::string manual_page(const CommandNode& root, std::string_view version) {
  std::string page = fmt::format(
      ".TH TOUCHSTONE 1 \"\" \"Touchstone {}\" \"User commands\"\n.SH NAME\ntouchstone \\- {}\n"
      ".SH SYNOPSIS\n.B touchstone\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n",
      version, roff("finds which collision engine is wrong, with a certificate"));
  page += roff(
      "Touchstone puts the same questions about the same scenes to several 3-D collision detectors. An "
      "exact, independent referee judges every answer.\n");
  std::string group;
  for (const CommandNode& c : root.commands) {
    if (c.group != group) page += ".SH " + roff(group = c.group) + "\n";
    add_roff_command(c, "touchstone " + c.name, page);
  }
  page += ".SH EXIT STATUS\n";
  for (const auto& [code, words] : exit_codes)
    page += fmt::format(".TP\n.B {}\n{}\n", code, roff(std::string(words)));
  return page;
}

std::string command_reference(const CommandNode& root) {
  std::string text =
      "# Commands\n\nWritten by `touchstone man --markdown`: every command and option of the program. "
      "`--help` after a command\nprints the same. Defaults are in brackets.\n\n## Exit codes\n\n| code | "
      "|\n|---|---|\n";
  for (const auto& [code, words] : exit_codes) text += fmt::format("| {} | {} |\n", code, words);
  std::string group;
  for (const CommandNode& c : root.commands) {
    text += c.group != group ? "\n## " + c.group + "\n\n" : "";
    group = c.group;
    add_markdown_command(c, "touchstone " + c.name, text);
  }
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace touchstone::cli
