#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "core/base/input_error.h"
#include "reports/text/junit.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::Standing;
using fuzz::Triaged;

// What is said of a cause besides its title, one sentence a line.
std::vector<std::string> remarks(const Triaged& t) {
  const fuzz::KnownCause& k = t.cause;
  std::vector<std::string> r;
  r.push_back(fmt::format("{}, {}; {}; {}", to_string(k.severity),
                          counted(k.count, "wrong answer", "wrong answers"), fmt::join(k.engines, ", "),
                          fmt::join(k.shapes, ", ")));
  if (!k.documented.empty()) r.push_back("documented: " + k.documented);
  if (!k.words.empty()) r.push_back("its case: " + k.words);
  if (t.standing != Standing::fresh && !t.new_shapes.empty())
    r.push_back(fmt::format("not seen before: {}", fmt::join(t.new_shapes, ", ")));
  if (t.standing == Standing::gone)
    r.push_back(fmt::format("first seen {}, {}; not shown in {} of {} runs", k.first_seen, k.first_build,
                            t.asked - t.shown, t.asked));
  if (t.standing == Standing::flaky) r.push_back(fmt::format("shown in {} of {} runs", t.shown, t.asked));
  if (t.standing == Standing::suppressed) r.push_back(fmt::format("until {}: {}", k.until, k.reason));
  if (t.suppression_ended) r.push_back(fmt::format("its suppression ended on {}: {}", k.until, k.reason));
  return r;
}

template <class Is>
std::string listed(const std::vector<Triaged>& all, const char* title, const Is& is) {
  std::string r;
  for (const Triaged& t : all) {
    if (!is(t)) continue;
    if (r.empty()) r = fmt::format("{}\n", title);
    r += fmt::format("  {}\n    {}\n", t.cause.id, wrapped(t.cause.title, 76, 4));
    for (const std::string& remark : remarks(t)) r += fmt::format("    {}\n", wrapped(remark, 76, 6));
  }
  return r;
}

std::string with_standing(const std::vector<Triaged>& all, Standing s, const char* title) {
  return listed(all, title, [s](const Triaged& t) { return t.standing == s && !t.suppression_ended; });
}

std::string message_of(const Triaged& t) {
  if (t.standing == Standing::fresh || t.standing == Standing::back)
    return std::string(to_string(t.standing));
  if (t.suppression_ended) return "its suppression ended on " + t.cause.until + ": " + t.cause.reason;
  if (t.standing == Standing::suppressed) return "suppressed until " + t.cause.until + ": " + t.cause.reason;
  std::string r = fmt::format(
      "{} since {}", t.standing == Standing::changed ? "known" : to_string(t.standing), t.cause.first_seen);
  if (t.standing == Standing::flaky) r += fmt::format(", shown in {} of {} runs", t.shown, t.asked);
  if (t.standing == Standing::changed) r += fmt::format("; new: {}", fmt::join(t.new_shapes, ", "));
  return r;
}

JUnitTest test_of(const Triaged& t) {
  JUnitTest r{t.cause.path, t.cause.id, TestResult::passed, "", ""};
  if (t.standing == Standing::gone) return r;
  r.result = t.counts() ? TestResult::failed : TestResult::skipped;
  r.message = message_of(t);
  r.text = t.cause.title;
  for (const std::string& remark : remarks(t)) r.text += "\n" + remark;
  return r;
}

// A ledger may be damaged.
fuzz::Json case_json(const fuzz::KnownCause& k) try {
  return fuzz::case_json_of(k);
} catch (const InputError&) {
  return {};  // asking it again reports the reason; the other causes are still shown
}

}  // namespace

std::string triage_text(const std::vector<Triaged>& all) {
  std::map<Standing, std::size_t> count;
  for (const Triaged& t : all) ++count[t.standing];
  std::string r = with_standing(all, Standing::fresh, "new:");
  r += with_standing(all, Standing::back, "back after being gone:");
  r += listed(all, "no longer suppressed:", [](const Triaged& t) { return t.suppression_ended; });
  r += with_standing(all, Standing::changed, "known, with other shapes:");
  r += with_standing(all, Standing::flaky, "flaky (their cases do not always show them):");
  r += with_standing(all, Standing::gone, "gone (their cases no longer show them):");
  r += with_standing(all, Standing::suppressed, "suppressed:");
  return r + fmt::format(
                 "{} new, {} back, {} known and seen ({} with other shapes),\n"
                 "{} known and shown again, {} flaky, {} gone, {} suppressed,\n"
                 "{} not asked (without their engine or a case)\n",
                 count[Standing::fresh], count[Standing::back],
                 count[Standing::known] + count[Standing::changed], count[Standing::changed],
                 count[Standing::still], count[Standing::flaky], count[Standing::gone],
                 count[Standing::suppressed], count[Standing::not_asked]);
}

fuzz::Json triage_json(const std::vector<Triaged>& all) {
  fuzz::Json j = fuzz::Json::array();
  for (const Triaged& t : all) {
    const fuzz::KnownCause& k = t.cause;
    j.push_back({{"id", k.id},
                 {"standing", to_string(t.standing)},
                 {"new_shapes", t.new_shapes},
                 {"suppression_ended", t.suppression_ended},
                 {"asked", t.asked},
                 {"shown", t.shown},
                 {"trouble", t.trouble},
                 {"path", k.path},
                 {"title", k.title},
                 {"severity", to_string(k.severity)},
                 {"documented", k.documented},
                 {"engines", k.engines},
                 {"shapes", k.shapes},
                 {"first_seen", k.first_seen},
                 {"last_seen", k.last_seen},
                 {"first_build", k.first_build},
                 {"last_build", k.last_build},
                 {"count", k.count},
                 {"engine", k.engine},
                 {"key", k.key},
                 {"words", k.words},
                 {"bodies", k.size.bodies},
                 {"steps", k.size.steps},
                 {"bits", k.size.bits},
                 {"reason", k.reason},
                 {"until", k.until},
                 {"case", case_json(k)}});
  }
  return j;
}

std::string triage_junit(const std::vector<Triaged>& all) {
  std::vector<JUnitTest> tests;
  for (const Triaged& t : all) tests.push_back(test_of(t));
  return junit(tests);
}

}  // namespace touchstone::reports
