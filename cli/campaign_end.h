// What a campaign prints at its end, and its exit code: of `fuzz`, and of `judge`, which judges it again.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "reports/record/causes.h"
#include "reports/record/result.h"

namespace touchstone::cli {

struct CampaignEnd {
  const fuzz::CampaignResult& result;
  std::string subject;
  std::string family;         // empty: the default mix of cases
  std::filesystem::path out;  // where the findings are; empty: nowhere
  /// The plug-ins and commands asked, separated by commas: further commands need to be given them again.
  std::string foreign = {};
};

/// The whole result with digest, directory and open questions.
fuzz::Json campaign_json(const CampaignEnd& end);
/// How a campaign is printed.
struct Printing {
  bool finished = true;                  // name the command that makes a page of the findings
  bool verbose = false;                  // all counts and times instead of one screen
  const fuzz::Causes* causes = nullptr;  // null: kinds of findings instead
};

/// --verbose, of the commands that print a campaign.
void add_verbose(CLI::App& app, bool& verbose);

/// The table, the causes of each library or the findings of each engine, and the counts of the campaign.
std::string results_text(const fuzz::CampaignResult& r, const Printing& how);
/// The results as text, and what to do next.
void print_campaign(const CampaignEnd& end, const Printing& how);
/// "WRONG in 3 and failed in 0 of 1,200 answers".
std::string counts_of_subject(const CampaignEnd& end);
/// Prints the last line; returns the exit code.
int campaign_verdict(const CampaignEnd& end, bool json);

}  // namespace touchstone::cli
