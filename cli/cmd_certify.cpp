// touchstone certify --subject X: is a broad phase conservative? The result is a certificate, or the smallest
// script that loses a pair. --check CERT re-runs a certificate from its own data alone and compares.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/installed.h"
#include "cli/output.h"
#include "cli/program_for.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/store.h"
#include "oracles/core/core_engine.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;
using fuzz::BroadCertificate;

struct CertifyOptions {
  std::string subject, scope = "quick", level = "both", out, page, script, check;
  std::vector<std::string> without;
  std::uint64_t seed = 1, limit = 0;
  double minutes = 0;
  std::optional<double> margin;
  int jobs = 1;
  bool sweeps = false, first_fault = false, json = false, list = false, memcheck = false;
  WorkerLimits limits{.patience = 1};
};

class CertifyProgress {
 public:
  void operator()(const fuzz::EvidenceCount& e, std::size_t index, std::size_t count) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + (live_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(10000));
    fmt::print(stderr, "{}{}/{} {}: {} of {} cases{}", live_ ? "\r\033[K" : "", index + 1, count, e.name,
               reports::grouped(e.cases), reports::grouped(e.planned), live_ ? "" : "\n");
    std::fflush(stderr);
  }
  ~CertifyProgress() {
    if (live_) fmt::print(stderr, "\r\033[K");
  }

 private:
  bool live_ = isatty(2) == 1;
  std::chrono::steady_clock::time_point next_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(live_ ? 0 : 10);
};

fuzz::Scope scope_named(const std::string& name) {
  return name == "full" ? fuzz::Scope::full : fuzz::Scope::quick;
}

fuzz::CertifyConfig config_of(const CertifyOptions& o) {
  fuzz::CertifyConfig c;
  c.scope = scope_named(o.scope);
  c.seed = o.seed;
  c.limit = o.limit;
  if (o.minutes > 0) c.minutes = o.minutes;
  c.jobs = o.jobs;
  c.without = o.without;
  c.first_fault = o.first_fault;
  c.margin = o.margin;
  if (o.level == "boxes") c.levels = {BroadLevel::boxes};
  if (o.level == "bodies") c.levels = {BroadLevel::bodies};
  c.program = "touchstone " TOUCHSTONE_VERSION;
  return c;
}

std::optional<BroadCertificate> make(const fuzz::Subject& s, const fuzz::CertifyConfig& c) {
  catch_stop_signals();
  CertifyProgress printer;
  return fuzz::certify(s, c, std::ref(printer), interrupted);
}

// The script's file beside the certificate, for `touchstone replay`: c.case.json, or c.boxes.case.json if
// both levels are certified. Further classes of fault add their name: c.boxes.crashed-numbers.case.json.
std::string script_file(const CertifyOptions& o, const BroadCertificate& c, const fuzz::Refutation& r) {
  const std::string base = !o.script.empty() ? o.script
                           : o.out.empty()
                               ? ""
                               : std::filesystem::path(o.out).replace_extension().string() + ".case.json";
  if (base.empty()) return base;
  std::string tag = o.level == "both" ? "." + std::string(to_string(r.level)) : "";
  const auto first = std::find_if(c.refutations.begin(), c.refutations.end(),
                                  [&](const fuzz::Refutation& x) { return x.level == r.level; });
  if (&*first != &r) tag += fmt::format(".{}-{}", r.what.fault, to_string(r.what.kind));
  const std::filesystem::path p(base);
  const std::string name = p.filename().string();
  const auto dot = std::min(name.find('.'), name.size());
  return (p.parent_path() / (name.substr(0, dot) + tag + name.substr(dot))).string();
}

// Longer scripts are not printed on the terminal.
constexpr auto max_printed_lines = 80;

void print_script(const fuzz::Refutation& r, const std::string& text) {
  const std::string what = fmt::format("{}, level of {}", in_words(r.what), to_string(r.level));
  const auto lines = std::count(text.begin(), text.end(), '\n');
  if (lines > max_printed_lines)
    fmt::print("script that shows it ({}): {} lines;\n  write it with -o FILE or --script FILE\n", what,
               reports::grouped(static_cast<std::uint64_t>(lines)));
  else
    fmt::print("script that shows it ({}):\n{}", what, text);
}

void write_scripts(const CertifyOptions& o, const BroadCertificate& c) {
  for (const auto& r : c.refutations) {
    if (!r.script) continue;
    StoredCase stored;
    stored.c = *r.script;
    stored.description = fmt::format("{}: {}: {}", c.subject, in_words(r.what), r.words);
    stored.source = fmt::format("certify {}, level of {}, shrunk from {} case {}, seed {}", c.subject,
                                to_string(r.level), r.evidence, r.index, c.seed);
    const std::string file = script_file(o, c, r), text = to_text(stored);
    if (file.empty()) {
      if (!o.json) print_script(r, text);
      continue;
    }
    write_file(file, text);
    if (!o.json) fmt::print("script ({}): {}\n", in_words(r.what), file);
  }
}

// In two columns, the second wrapped.
void print_subject(std::string_view name, const std::string& words) {
  constexpr std::size_t column = 34;
  const std::string blank(column, '_');  // takes the first column's room in the first line
  fmt::print("{:<{}}{}\n", name, column, reports::wrapped(blank + words, 78, column).substr(column));
}

int list_subjects() {
  for (const auto name : core_broad_phases()) print_subject(name, "core");
  for (const std::string_view folder : engine_folders()) {
    if (!is_present(folder)) fmt::print("{:<34}absent: not built\n", folder);
    for (const PluginEngine& e : engines_of_folder(folder))
      if (e.kind == EngineKind::broad) print_subject(e.card.name, e.card.library + ", " + e.card.settings);
  }
  fmt::print("also every engine listed by `touchstone engines`, ./libmine.so, pipe:COMMAND\n");
  return exit_clean;
}

// The data that reports/web/src/certificate draws: the certificate as stored, and where its files are.
bool write_certificate_page(const CertifyOptions& o, const BroadCertificate& c) {
  Json scripts = Json::array();  // one per refutation; empty if not written
  for (const auto& r : c.refutations) scripts.push_back(r.script ? script_file(o, c, r) : "");
  const Json page = {{"page", "certificate"},
                     {"version", 2},
                     {"title", reports::certificate_line(c)},
                     {"subject", o.subject},
                     {"file", o.out},
                     {"scripts", std::move(scripts)},
                     {"has_writer", has_program(o.subject)},
                     {"certificate", to_json(c)}};
  return write_page("certificate", page.dump(), o.page, o.out);
}

// The path at which the shell would find the program; empty if it would not.
// Under Valgrind everything is slower, so fewer cases are run and each gets more time.
void use_memcheck(CertifyOptions& o) {
  constexpr std::uint64_t cases_per_suite = 60;
  constexpr double slower = 60;
  o.limits.memcheck = program_on_path("valgrind");
  if (o.limits.memcheck.empty())
    throw std::runtime_error("--memcheck needs Valgrind (Debian: apt-get install valgrind)");
  if (o.limit == 0) o.limit = cases_per_suite;
  o.limits = scaled_limits(o.limits, slower);
  o.limits.start_cpu_seconds *= slower;
  o.limits.start_wall_seconds *= slower;
  fmt::print(stderr, "running under Valgrind, without a sandbox: at most {} cases per suite\n", o.limit);
}

int certify_subject(CertifyOptions o) {
  if (o.subject.empty()) throw InputError("certify", "needs --subject NAME or --check CERT");
  if (o.margin && (!std::isfinite(*o.margin) || *o.margin < 0))
    throw InputError("--margin", "must be a finite number that is not negative");
  if (o.margin && o.sweeps) throw InputError("--margin", "is about bodies at rest; leave out --sweeps");
  for (const std::string& file : {o.out, o.page, o.script}) prepare_output(file);
  if (o.memcheck) use_memcheck(o);
  const auto c = make(broad_subject(o.subject, o.limits, o.sweeps), config_of(o));
  if (!c) {
    fmt::print(stderr, "interrupted: no certificate\n");
    return exit_failed;
  }
  if (!o.out.empty()) write_file(o.out, to_json(*c).dump(1) + "\n");
  const bool page = !o.page.empty() && write_certificate_page(o, *c);
  if (o.json) {
    fmt::print("{}\n", to_json(*c).dump(1));
    write_scripts(o, *c);
  } else {
    fmt::print("{}", reports::certificate_text(*c, true));
    write_scripts(o, *c);
    if (page) fmt::print("page: {}\n", o.page);
    fmt::print("{}\n", reports::certificate_line(*c));
  }
  return exit_code(*c);
}

// The first field in which two certificates differ, as a message.
std::string first_difference(const Json& was, const Json& is, const std::string& place) {
  if (was == is) return "";
  if (was.is_structured() && is.is_structured() && was.is_object() == is.is_object() &&
      was.size() == is.size()) {
    const Json a = was.flatten(), b = is.flatten();
    for (const auto& [key, value] : a.items())
      if (!b.contains(key) || b.at(key) != value)
        return fmt::format("{}{}: {} is now {}", place, key, value.dump(),
                           b.contains(key) ? b.at(key).dump() : "absent");
  }
  return place + "the number of entries differs";
}

int differs(const std::string& file, const std::string& why) {
  fmt::print("{}: not valid: {}\n", file, why);
  return exit_wrong;
}

// The name in the file is only a label: a path or a command is run only if the command line gives the same
// one.
void require_same_subject(const CertifyOptions& o, const std::string& named) {
  const auto phases = core_broad_phases();
  const bool known = std::find(phases.begin(), phases.end(), named) != phases.end() || is_catalogued(named);
  if (o.subject.empty() && !known)
    throw InputError(o.check,
                     "subject: " + json_text(named) +
                         " is not in the catalogue, and files cannot choose what is run; pass the same "
                         "name with --subject to run it");
  if (!o.subject.empty() && o.subject != named)
    throw InputError(
        o.check, "subject: the certificate is for " + json_text(named) + ", not for --subject " + o.subject);
}

int check(const CertifyOptions& o) {
  const Json stored = load_json(o.check);
  bool digest_holds = false;
  BroadCertificate was;
  try {
    was = fuzz::broad_certificate_from_json(stored, digest_holds);
  } catch (const InputError& e) {
    throw e.within(o.check);
  }
  if (!digest_holds) return differs(o.check, "its digest does not match its contents");
  fuzz::CertifyConfig c = config_of(o);
  c.scope = scope_named(was.scope);
  c.seed = was.seed;
  c.limit = was.limit;
  c.minutes.reset();
  for (const fuzz::EvidenceCount& e : was.evidence)
    if (e.out_of_time) c.most_cases[e.name] = e.cases;
  c.levels = was.levels;
  c.margin = was.margin;
  c.without = was.without;
  c.first_fault = was.first_fault;
  if (was.program != c.program)
    return differs(o.check, "it was made by " + json_text(was.program) + ", but this is " + c.program);
  require_same_subject(o, was.subject);
  const fuzz::Subject s = broad_subject(was.subject, o.limits, was.sweeps);
  if (s.plugin_hash != was.plugin_hash)
    return differs(o.check, "the plug-in is a different build from the one certified");
  const auto again = make(s, c);
  if (!again) {
    fmt::print(stderr, "interrupted: the certificate was not checked\n");
    return exit_failed;
  }
  const std::string difference = first_difference(stored, to_json(*again), "");
  if (!difference.empty()) return differs(o.check, difference);
  fmt::print("{}: valid, re-run with the same digest\n{}\n", o.check, reports::certificate_line(was));
  return exit_code(was);
}

}  // namespace

Run declare_certify(CLI::App& app) {
  auto o = std::make_shared<CertifyOptions>();
  app.add_option("--subject", o->subject,
                 "a core broad phase, an engine (`touchstone engines`), ./libmine.so, or pipe:COMMAND");
  app.add_option("--scope", o->scope, "quick (a minute) or full (half an hour)")
      ->check(CLI::IsMember({"quick", "full"}))
      ->capture_default_str();
  app.add_option("--level", o->level, "boxes, bodies or both")
      ->check(CLI::IsMember({"boxes", "bodies", "both"}))
      ->capture_default_str();
  app.add_option("-o,--out", o->out, "file for the certificate (JSON)");
  app.add_option("--page", o->page, "file for the certificate as a page (self-contained HTML)");
  app.add_option("--script", o->script,
                 "file for the script of a refutation (default: beside the certificate)");
  app.add_option("--check", o->check, "a certificate to re-run and compare; exit code 1 if it does not hold");
  app.add_option("--without", o->without,
                 "suites to leave out, separated by commas; recorded in the certificate")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--seed", o->seed, "same seed, same certificate")->capture_default_str();
  app.add_option("--limit", o->limit, "maximum number of cases per suite; recorded in the certificate");
  app.add_option("--minutes", o->minutes,
                 "time for all suites together, shared equally; each runs as many of its cases, in order, as "
                 "its share allows, and --check runs the same ones")
      ->check(a_positive_number());
  add_jobs(app, o->jobs);
  app.add_option(
      "--margin", o->margin,
      "every pair whose distance is at most this must be a candidate (candidates_within), in the unit of "
      "the suites' scenes, whose boxes are about 1 wide");
  app.add_flag("--sweeps", o->sweeps,
               "also query the subject for swept_candidates: pairs that meet while the bodies move");
  app.add_flag("--first-fault", o->first_fault,
               "stop a level at its first fault instead of listing all; recorded in the certificate");
  app.add_flag(
      "--memcheck", o->memcheck,
      "run the subject under Valgrind: reads or writes of freed or unallocated memory count as crashes");
  app.add_flag("--list", o->list, "list the subjects available by name");
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "the certificate as one JSON document on stdout");
  return [o] { return o->list ? list_subjects() : o->check.empty() ? certify_subject(*o) : check(*o); };
}

}  // namespace touchstone::cli
