// Records as text: for a terminal, for README.md, and for tools that read JUnit.
#pragma once

#include <string>
#include <vector>

#include "reports/record/assessment.h"
#include "reports/record/broad_certificate.h"
#include "reports/record/changes.h"
#include "reports/record/chart.h"
#include "reports/record/fingerprint.h"
#include "reports/record/judged_case.h"
#include "reports/record/motions.h"
#include "reports/record/observation_json.h"
#include "reports/record/plan.h"
#include "reports/record/stability.h"
#include "reports/record/triage.h"
#include "reports/record/versions.h"

namespace touchstone::reports {

/// What to run and how much it saves, then the evidence; in 80 columns.
std::string plan_text(const fuzz::Plan& p);

/// The data that reports/web/src/plan draws: the record with sentences about it. `command` makes or measures
/// the plan again.
fuzz::Json plan_page(const fuzz::Plan& p, const std::string& command);

/// Wrong answers, worst errors, times and the padding by engine, and the advice; in 80 columns. Lengths in
/// millimetres, for scenes in metres.
std::string assessment_text(const fuzz::Assessment& a);

/// The same in paragraphs, without the table.
struct AssessmentWords {
  std::string heading;  // what was asked
  std::vector<std::string> legend, notes, advice;
};
AssessmentWords assessment_words(const fuzz::Assessment& a);

// The chart as text in 80 columns.

/// One table per question over all regimes, then the Pareto front of each regime, crowds, and the machine.
std::string chart_text(const fuzz::Chart& c);

// The documents' comparison of the core with the engines as shipped: an excerpt of a chart, its block of
// Markdown, and its picture.

/// The engines of the block's table that answer about pairs.
std::vector<std::string> engines_of_excerpt();

/// The rows that the block needs and the engines that they name. Idempotent.
fuzz::Chart chart_excerpt(const fuzz::Chart& c);

/// Whether the row's engine runs as WebAssembly, so that its times include the calls from JavaScript.
bool is_wasm(const fuzz::Chart& c, const fuzz::ChartRow& row);

/// A table of the excerpt and a description of the measurement, to stand between the markers below.
std::string chart_markdown(const fuzz::Chart& excerpt);

/// `text` with everything between the markers replaced by `block`. Throws InputError, naming `file`, if the
/// markers are missing or out of order.
std::string with_chart_block(const std::string& text, const std::string& block, const std::string& file);

/// The excerpt as a picture (SVG): median time across, worst error upwards, both logarithmic, one panel a
/// question; for a light or a dark page.
std::string chart_svg(const fuzz::Chart& excerpt, bool for_dark);

inline constexpr const char* chart_begin = "<!-- chart: generated -->\n";
inline constexpr const char* chart_end = "<!-- chart: end -->\n";

// Ladders as text in 80 columns.

/// One table per question (engine × ladder) of the rung where each begins to fail; then a list of the
/// ladders.
std::string stability_text(const fuzz::Stability& s);

/// Tables engine × motion of flicker, wrong answers and state, the kinds of flicker, and evidence of each.
std::string motions_text(const fuzz::Motions& m);

// A broad-phase certificate as text in 80 columns.

/// `times`: with the seconds that each suite took.
std::string certificate_text(const fuzz::BroadCertificate& c, bool times);

/// "SUBJECT: boxes certified, bodies refuted", followed by the suites that were too slow and the time they
/// need.
std::string certificate_line(const fuzz::BroadCertificate& c);

// The result of a triage, for people and for continuous integration.

/// Lists new, back, changed, flaky and gone causes, suppressed ones and those whose suppression has ended,
/// and counts the others. 80 columns, except for ids.
std::string triage_text(const std::vector<fuzz::Triaged>& triaged);
fuzz::Json triage_json(const std::vector<fuzz::Triaged>& triaged);
/// JUnit: one suite per path and one test per cause. New and back causes fail, and so do those whose
/// suppression has ended; known ones are skipped, gone ones pass.
std::string triage_junit(const std::vector<fuzz::Triaged>& triaged);

/// At most 80 columns, except for the keys of findings; long lists are cut.
std::string changes_text(const fuzz::ResultChanges& c);

/// At most 80 columns.
std::string replay_text(const fuzz::JudgedCase& judged);

/// A block a cause, in 80 columns for up to six releases. Text from data is made printable.
std::string versions_text(const fuzz::VersionTable& t);

/// A heading and a table with one row a cause. Text from data is escaped.
std::string versions_markdown(const fuzz::VersionTable& t);

/// One line a question, and one for all.
std::string fingerprint_text(const fuzz::Fingerprint& f);

/// Which answers differ: one line a question and pair of shapes.
std::string difference_text(const fuzz::Fingerprint& a, const fuzz::Fingerprint& b,
                            const fuzz::FingerprintDifference& d);

}  // namespace touchstone::reports
