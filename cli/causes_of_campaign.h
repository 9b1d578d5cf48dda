// The causes behind a stored campaign, as `causes` and `triage` need them: those stored beside it if they are
// of the same results, else found by asking the engines.
#pragma once

#include <string>

#include "fuzz/causes/classes.h"
#include "oracles/client/worker_limits.h"
#include "reports/record/causes.h"
#include "reports/record/result.h"

namespace touchstone::cli {

struct CausesSearch {
  std::string directory;  // of the campaign
  std::string engines;    // engines outside the catalogue that may be asked, as given on the command line
  std::string error;      // the user's tolerance (--error); empty: the engines' own claims
  double minutes = 10;
  int jobs = 1;
  WorkerLimits limits;
};

struct FoundCauses {
  fuzz::Causes causes;
  bool interrupted = false;  // the causes are incomplete and not stored
  std::size_t kept = 0;      // if interrupted: findings examined that the same command need not ask again
  std::string not_kept;      // not empty: why those of this call could not be kept
  std::string not_stored;    // not empty: why DIR/causes.json could not be written
};

/// Reads DIR/causes.json, or finds the causes and writes that file, unless interrupted; then the next call
/// with the same `again` goes on with what DIR/causes.examined has. Nobody else may write to DIR meanwhile.
/// Throws InputError when DIR holds no campaign, or a damaged one.
FoundCauses causes_of_campaign(CausesSearch& search, bool again);

/// Asks no engine: the causes of the campaign in DIR as known_causes gives them. Throws InputError when DIR
/// holds no campaign, or a damaged one.
fuzz::Causes causes_without_asking(const std::string& directory);

/// Asks no engine, and leaves DIR/causes.json aside: the causes that `fuzz` names at its end. Throws as
/// above.
fuzz::Causes causes_before_asking(const std::string& directory);

/// Asks no engine: those in DIR/causes.json if they are of this result, else what is stored alone tells.
/// `directory` may be empty: the result is stored nowhere.
fuzz::Causes known_causes(const std::string& directory, const fuzz::CampaignResult& result);

// What is known about the catalogued engines beyond their cards: which of them share code, which routine a
// library chooses for two shapes, and which engines differ in one respect.

fuzz::EngineKnowledge catalogued_knowledge();

/// The library of an engine path, or of the first of "a, b": "FCL" for "fcl-libccd"; what is given itself for
/// engines outside the catalogue.
std::string library_of(const std::string& path);

}  // namespace touchstone::cli
