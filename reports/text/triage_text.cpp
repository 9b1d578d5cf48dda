#include "reports/text/record_text.h"

#include <fmt/format.h>

#include <map>

#include "core/base/input_error.h"
#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::Standing;
using fuzz::Triaged;

std::string escaped(const std::string& s) {
  std::string r;
  for (const char c : s) {
    if (c == '&')
      r += "&amp;";
    else if (c == '<')
      r += "&lt;";
    else if (c == '>')
      r += "&gt;";
    else if (c == '"')
      r += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n')
      r += c;
    else
      r += ' ';
  }
  return r;
}

bool is_failure(Standing s) { return s == Standing::fresh || s == Standing::back; }
bool is_skipped(Standing s) {
  return s == Standing::known || s == Standing::still || s == Standing::flaky || s == Standing::not_asked;
}

std::string flaky_share(const Triaged& t) {
  return t.standing == Standing::flaky ? fmt::format(", shown in {} of {} runs", t.shown, t.asked) : "";
}

std::string named(const std::vector<Triaged>& all, Standing standing, const char* title) {
  std::string r;
  for (const Triaged& t : all) {
    if (t.standing != standing) continue;
    if (r.empty()) r = fmt::format("{}\n", title);
    r += fmt::format("  {}\n    {}\n", t.finding.key, wrapped(t.finding.words, 76, 4));
    if (standing == Standing::gone)
      r += fmt::format("    first seen {}, {}; not shown in {} of {} runs\n", t.finding.first_seen,
                       t.finding.first_build, t.asked - t.shown, t.asked);
    if (standing == Standing::flaky) r += fmt::format("    shown in {} of {} runs\n", t.shown, t.asked);
  }
  return r;
}

std::string junit_case(const Triaged& t) {
  std::string r = fmt::format("  <testcase classname=\"{}\" name=\"{}\">", escaped(t.finding.engine),
                              escaped(t.finding.key));
  if (is_failure(t.standing))
    r += fmt::format("<failure message=\"{}\">{}</failure>", to_string(t.standing), escaped(t.finding.words));
  if (is_skipped(t.standing))
    r += fmt::format("<skipped message=\"{} since {}{}\"/>", to_string(t.standing),
                     escaped(t.finding.first_seen), flaky_share(t));
  return r + "</testcase>\n";
}

}  // namespace

std::string triage_text(const std::vector<Triaged>& all) {
  std::map<Standing, std::size_t> count;
  for (const Triaged& t : all) ++count[t.standing];
  std::string r = named(all, Standing::fresh, "new:") + named(all, Standing::back, "back after being gone:") +
                  named(all, Standing::flaky, "flaky (their cases do not always show them):") +
                  named(all, Standing::gone, "gone (their cases no longer show them):");
  return r + fmt::format(
                 "{} new, {} back, {} known and seen, {} known and shown again,\n"
                 "{} flaky, {} gone, {} not asked (their engines are not available)\n",
                 count[Standing::fresh], count[Standing::back], count[Standing::known],
                 count[Standing::still], count[Standing::flaky], count[Standing::gone],
                 count[Standing::not_asked]);
}

// A ledger may be damaged.
static fuzz::Json case_json(const fuzz::KnownFinding& f) try {
  return fuzz::case_json_of(f);
} catch (const InputError&) {
  return {};  // asking it again reports the reason; the other findings are still shown
}

fuzz::Json triage_json(const std::vector<Triaged>& all) {
  fuzz::Json j = fuzz::Json::array();
  for (const Triaged& t : all) {
    const auto& f = t.finding;
    j.push_back({{"key", f.key},
                 {"standing", to_string(t.standing)},
                 {"asked", t.asked},
                 {"shown", t.shown},
                 {"trouble", t.trouble},
                 {"engine", f.engine},
                 {"words", f.words},
                 {"first_seen", f.first_seen},
                 {"last_seen", f.last_seen},
                 {"first_build", f.first_build},
                 {"last_build", f.last_build},
                 {"count", f.count},
                 {"bodies", f.size.bodies},
                 {"steps", f.size.steps},
                 {"bits", f.size.bits},
                 {"case", case_json(f)}});
  }
  return j;
}

std::string triage_junit(const std::vector<Triaged>& all) {
  std::map<std::string, std::vector<const Triaged*>> suites;
  for (const Triaged& t : all) suites[t.finding.engine].push_back(&t);
  std::string r = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"touchstone\">\n";
  for (const auto& [engine, cases] : suites) {
    std::size_t failures = 0, skipped = 0;
    for (const Triaged* t : cases) {
      failures += is_failure(t->standing);
      skipped += is_skipped(t->standing);
    }
    r += fmt::format(" <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" errors=\"0\">\n",
                     escaped(engine), cases.size(), failures, skipped);
    for (const Triaged* t : cases) r += junit_case(*t);
    r += " </testsuite>\n";
  }
  return r + "</testsuites>\n";
}

}  // namespace touchstone::reports
