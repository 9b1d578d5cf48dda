#include "cli/campaign_end.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cli/causes_of_campaign.h"
#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "reports/text/causes_text.h"
#include "reports/text/text.h"

namespace touchstone::cli {

fuzz::Json campaign_json(const CampaignEnd& end) {
  auto j = fuzz::to_json(end.result, true);
  j["digest"] = fuzz::digest(end.result);
  j["out"] = end.out.string();
  j["too_open"] = end.result.too_open(end.subject);
  return j;
}

void add_verbose(CLI::App& app, bool& verbose) {
  app.add_flag("--verbose", verbose, "print every count, error and time, and the kinds of findings");
}

namespace {

// So many causes of each library that all fit on one screen.
std::size_t causes_per_library(const fuzz::Causes& c) {
  std::set<std::string> libraries;
  for (const fuzz::Cause& cause : c.causes) libraries.insert(library_of(cause.path));
  constexpr std::size_t lines = 28, around = 2, most = 5;  // of all libraries; of each besides its causes
  const std::size_t each = lines / std::max<std::size_t>(1, libraries.size());
  return std::clamp<std::size_t>(each > around ? each - around : 1, 1, most);
}

std::string next_steps(const CampaignEnd& end, const Printing& how) {
  const fuzz::CampaignResult& r = end.result;
  const std::string out = end.out.string(), kinds = reports::grouped(r.findings.size());
  if (r.findings.empty()) return fmt::format("no findings; the counts are in {}/summary.json\n", out);
  if (how.causes)
    return fmt::format(
        "{0} behind {1} kinds of findings. To see one, or all on a page:\n"
        "  {2} causes {3}{6} --cause {4}\n  {2} causes {3}{6} --page {5}\n",
        reports::counted(how.causes->causes.size(), "cause", "causes"), kinds, program_name(),
        shell_word(out), reports::code_of(how.causes->causes.front(), *how.causes),
        shell_word(out + "/causes.html"), end.foreign.empty() ? "" : " --engines " + shell_word(end.foreign));
  std::string s =
      fmt::format("{} kinds of findings in {}/findings; to see one:\n  {} replay {}\n", kinds, out,
                  program_name(), shell_word(out + "/findings/" + r.findings.begin()->first));
  if (how.finished)
    s += fmt::format("To see all of them as a page:\n  {} report {} -o {}\n", program_name(), shell_word(out),
                     shell_word(out + "/report.html"));
  return s;
}

}  // namespace

std::string results_text(const fuzz::CampaignResult& r, const Printing& how) {
  std::string s = (how.verbose ? reports::full_campaign_table(r) : reports::campaign_table(r)) + "\n";
  if (!r.findings.empty() && (how.verbose || !how.causes))
    s += fmt::format("Findings by engine (the three most frequent kinds of each):\n{}\n",
                     reports::findings_summary(r, 3));
  if (how.causes && !how.causes->causes.empty())
    s += fmt::format("Causes: code, wrong answers, what is wrong\n{}\n",
                     reports::causes_of_libraries(*how.causes, causes_per_library(*how.causes), library_of));
  return s + reports::campaign_footer(r, how.verbose);
}

void print_campaign(const CampaignEnd& end, const Printing& how) {
  for (const std::string& line : end.result.too_open(end.subject))
    fmt::print("{}\n", reports::wrapped(line, 79, 2));
  fmt::print("{}", results_text(end.result, how));
  if (!end.out.empty()) fmt::print("{}", next_steps(end, how));
}

std::string counts_of_subject(const CampaignEnd& end) {
  const auto wrong = end.result.wrong_of(end.subject), failed = end.result.failed_of(end.subject);
  return fmt::format("WRONG in {} and failed in {} of {} answers", reports::grouped(wrong),
                     reports::grouped(failed),
                     reports::grouped(end.result.answered_by(end.subject) + failed));
}

int campaign_verdict(const CampaignEnd& end, bool json) {
  const fuzz::CampaignResult& r = end.result;
  const auto say = [&](int code, const std::string& why) {
    return print_verdict(code, end.subject, why, json);
  };
  const std::uint64_t answers = r.answered_by(end.subject);
  if (r.wrong_of(end.subject) + r.failed_of(end.subject) > 0) return say(exit_wrong, counts_of_subject(end));
  if (answers == 0) return say(exit_failed, "it answered nothing; this run proves nothing");
  // A campaign in which nearly all pairs overlap, or nearly none, tests only half of what it claims to.
  // Shares of the pairs, and the number of pairs from which they count.
  constexpr double least_hit_rate = 0.3, most_hit_rate = 0.7;
  constexpr std::uint64_t enough_pairs = 200;
  if (end.family.empty() && r.pair_cases >= enough_pairs &&
      (r.hit_rate() < least_hit_rate || r.hit_rate() > most_hit_rate))
    return say(exit_failed,
               fmt::format("{:.0f} % of the pairs overlap, outside 30-70 %: this run proves nothing",
                           100 * r.hit_rate()));
  if (const auto open = r.too_open(end.subject); !open.empty())
    return say(exit_failed, fmt::format("0 wrong, but too many answers are open: {}", open.front()));
  const auto exempt = r.by_definition_of(end.subject);
  return say(exit_clean,
             fmt::format("0 wrong in {} answers{}", reports::grouped(answers),
                         exempt > 0 ? fmt::format(" ({} not judged)", reports::grouped(exempt)) : ""));
}

}  // namespace touchstone::cli
