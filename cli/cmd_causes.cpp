// touchstone causes DIR: the distinct causes behind the findings of a campaign.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "cli/causes_of_campaign.h"
#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/judged_by.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "reports/text/causes_text.h"
#include "reports/text/web_page.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

struct CausesOptions {
  CausesSearch search;
  std::string engine, cause, out, page;
  bool again = false, json = false, markdown = false;
};

bool is_of(const fuzz::Cause& c, const std::string& engine) {
  return c.path == engine || std::ranges::find(c.engines, engine) != c.engines.end();
}

void keep_engine(fuzz::Causes& causes, const std::string& engine) {
  std::vector<std::string> known;
  for (const fuzz::Cause& c : causes.causes) {
    known.push_back(c.path);
    known.insert(known.end(), c.engines.begin(), c.engines.end());
  }
  std::erase_if(causes.causes, [&](const fuzz::Cause& c) { return !is_of(c, engine); });
  if (causes.causes.empty() && std::ranges::find(known, engine) == known.end())
    throw InputError("--engine " + engine, "no cause is of this engine" + did_you_mean(engine, known));
}

// By its id, or by last words of it, its code. Null when there is none. Throws InputError when there are
// several.
const fuzz::Cause* find_cause(const fuzz::Causes& causes, const std::string& id) {
  const fuzz::Cause* found = nullptr;
  for (const fuzz::Cause& c : causes.causes) {
    if (c.id == id) return &c;
    if (!reports::is_named(c, id)) continue;
    if (found) throw InputError("--cause " + id, "is the code of several causes: " + found->id + ", " + c.id);
    found = &c;
  }
  return found;
}

std::size_t findings_in_common(const fuzz::Cause& a, const fuzz::Cause& b) {
  std::vector<std::string> both;
  std::ranges::set_intersection(a.keys, b.keys, std::back_inserter(both));
  return both.size();
}

// Findings are grouped anew once they are examined. `fuzz` named a cause before that: the one with the most
// of its findings. Null when it named none so.
const fuzz::Cause* find_regrouped(const fuzz::Causes& causes, const CausesOptions& o) {
  const fuzz::Causes before = causes_before_asking(o.search.directory);
  const fuzz::Cause* named = find_cause(before, o.cause);
  if (!named) return nullptr;
  const auto common = [&](const fuzz::Cause& c) { return findings_in_common(*named, c); };
  const auto most = std::ranges::max_element(causes.causes, {}, common);
  if (most == causes.causes.end() || common(*most) == 0) return nullptr;
  fmt::print(
      stderr,
      "touchstone: {}: its findings were grouped anew when they were examined; this cause has {} of {}\n",
      o.cause, common(*most), named->keys.size());
  return &*most;
}

const fuzz::Cause& cause_named(const fuzz::Causes& causes, const CausesOptions& o) {
  const std::string& id = o.cause;
  if (const fuzz::Cause* c = find_cause(causes, id)) return *c;
  if (const fuzz::Cause* c = find_regrouped(causes, o)) return *c;
  std::vector<std::string> known;
  for (const fuzz::Cause& c : causes.causes) known.push_back(c.id);
  throw InputError("--cause " + id, "there is no such cause" + did_you_mean(id, known));
}

std::string how_to_report(const CausesOptions& o, const fuzz::Cause& c) {
  return fmt::format("\nTo report it, with its case and program\n  {} causes {} --cause {} --markdown\n",
                     program_name(), shell_word(o.search.directory), shell_word(c.id));
}

std::string one_cause(const CausesOptions& o, const fuzz::Cause& c) {
  if (o.json) return json_text(to_json(c), 1) + "\n";
  return o.markdown ? reports::cause_markdown(c) : reports::cause_text(c) + how_to_report(o, c);
}

std::string how_to_go_on(const FoundCauses& found) {
  if (!found.not_kept.empty())
    return fmt::format("The same command starts again, because what was asked could not be kept: {}",
                       printable(found.not_kept, "\n"));
  return fmt::format("The same command goes on after the {} findings that were examined", found.kept);
}

// Whether DIR/causes.json holds what is printed; if not, says so last.
int stored_or_not(const FoundCauses& found) {
  if (found.interrupted)
    fmt::print(stderr,
               "touchstone: interrupted: these causes are incomplete and not stored. {}; --budget MINUTES "
               "limits its time\n",
               how_to_go_on(found));
  else if (!found.not_stored.empty())
    fmt::print(stderr, "touchstone: these causes are not stored with the campaign: {}\n",
               printable(found.not_stored, "\n"));
  else
    return exit_clean;
  return exit_failed;
}

int print_causes(const CausesOptions& o, fuzz::Causes& causes) {
  if (!o.engine.empty()) keep_engine(causes, o.engine);
  if (!o.out.empty()) write_file(o.out, json_text(to_json(causes), 1) + "\n");
  if (!o.cause.empty()) {
    fmt::print("{}", one_cause(o, cause_named(causes, o)));
    return exit_clean;
  }
  if (o.json)
    fmt::print("{}\n", json_text(to_json(causes), 1));
  else
    fmt::print("{}", reports::causes_text(causes, fmt::format("{} causes {}", program_name(),
                                                              shell_word(o.search.directory))));
  if (o.page.empty()) return exit_clean;
  if (!write_page("causes", json_text(reports::causes_page(causes)), o.page)) return exit_failed;
  fmt::print(stderr, "{}: open it in a browser\n", o.page);
  return exit_clean;
}

// As it was printed at the end of the campaign, if its case has not been reduced and asked in other forms.
bool print_at_once(const CausesOptions& o) {
  if (o.cause.empty() || o.again || o.json || o.markdown || !o.out.empty() || !o.page.empty()) return false;
  const fuzz::Causes causes = causes_without_asking(o.search.directory);
  const fuzz::Cause* c = find_cause(causes, o.cause);
  if (!c) return false;
  fmt::print("{}", reports::cause_text(*c));
  const std::filesystem::path finding =
      std::filesystem::path(o.search.directory) / "findings" / c->shown().key;
  if (!c->shown().key.empty() && std::filesystem::exists(finding))
    fmt::print("\nIts answer beside the referee's\n  {} replay {}\n", program_name(),
               shell_word(finding.string()));
  if (c->response.empty())
    fmt::print(
        "\nNot examined yet: to reduce its case and to find out what makes it vanish\n  {} causes {}\n",
        program_name(), shell_word(o.search.directory));
  else
    fmt::print("{}", how_to_report(o, *c));
  return true;
}

int run(CausesOptions& o) {
  prepare_output(o.out);
  prepare_output(o.page);
  if (o.markdown && o.cause.empty())
    throw InputError("--markdown", "needs --cause ID: the issue is about one");
  if (print_at_once(o)) return exit_clean;
  catch_stop_signals();
  FoundCauses found = causes_of_campaign(o.search, o.again);
  const int printed = print_causes(o, found.causes);
  std::fflush(stdout);
  const int stored = stored_or_not(found);
  return printed == exit_clean ? stored : printed;
}

}  // namespace

Run declare_causes(CLI::App& app) {
  auto o = std::make_shared<CausesOptions>();
  app.add_option("directory", o->search.directory, "directory of a campaign (`fuzz --out`)")->required();
  app.add_option("--engine", o->engine,
                 "only causes of this engine, or of this path (fcl-libccd, bullet-query)");
  app.add_option("--cause", o->cause,
                 "print the cause with this id, or with this code (the last word of its id), in full");
  app.add_flag("--markdown", o->markdown, "with --cause: as text for an issue tracker");
  app.add_option("--budget", o->search.minutes,
                 "minutes for asking the engines again; findings that remain are grouped by what is stored")
      ->check(a_positive_number())
      ->capture_default_str();
  app.add_option("--engines", o->search.engines,
                 "plug-ins and pipes whose findings are to be asked again: ./libmine.so, pipe:COMMAND");
  app.add_flag("--again", o->again,
               "find the causes again, even if DIR/causes.json holds those of this campaign");
  app.add_option("-o,--out", o->out,
                 "also write the causes as JSON to this file (DIR/causes.json always has them)");
  app.add_option("--page", o->page, "write a page (self-contained HTML) to this file");
  add_jobs(app, o->search.jobs, "number of findings examined in parallel");
  add_error(app, o->search.error);
  add_case_seconds(app, o->search.limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
