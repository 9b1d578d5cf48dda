// What a campaign prints at its end, and its exit code: of `fuzz`, and of `judge`, which judges it again.
#pragma once

#include <filesystem>
#include <string>

#include "reports/record/result.h"

namespace touchstone::cli {

struct CampaignEnd {
  const fuzz::CampaignResult& result;
  std::string subject;
  std::string family;         // empty: the default mix of cases
  std::filesystem::path out;  // where the findings are; empty: nowhere
};

/// The whole result with digest, directory and open questions.
fuzz::Json campaign_json(const CampaignEnd& end);
/// The table and the findings as text; `finished`: name the command that makes a page of them.
void print_campaign(const CampaignEnd& end, bool finished);
/// "WRONG in 3 and failed in 0 of 1,200 answers".
std::string counts_of_subject(const CampaignEnd& end);
/// Prints the last line; returns the exit code.
int campaign_verdict(const CampaignEnd& end, bool json);

}  // namespace touchstone::cli
