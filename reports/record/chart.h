// Speed against accuracy as a record: what `touchstone chart` measured, one row an engine, question and group
// of cases. Times are of the machine named; everything else is of the seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reports/record/observation_json.h"

namespace touchstone::fuzz {

struct Machine {
  std::string processor, system, compiler, date;
  unsigned cores = 0;
  double load = 0;  // one-minute average at the start
};
Json to_json(const Machine& m);

struct ChartRow {
  std::string engine, question;
  std::string regime, pair, scale;  // empty: all of them
  std::uint64_t bodies = 0;         // candidates: of the scene
  /// Of `asked` queries: `answers` answered, `failed` neither answered nor unsupported. Of the answers:
  /// `missed`, `ghost` verdicts, `no_number` (NaN, no unit normal, no number), `wrong` in any way, `rounding`
  /// of them right for the scene as received; `undecided` by the referee; `not_judged`: a claim was not
  /// checked, and could have been; `wide_claim`: the engine claims a tolerance above 1e-2 L.
  std::uint64_t asked = 0, answers = 0, failed = 0, missed = 0, ghost = 0, no_number = 0, wrong = 0,
                rounding = 0, undecided = 0, not_judged = 0, wide_claim = 0;
  /// Of the least time of each query over the rounds; spread: of the rounds' medians, (largest − least) /
  /// least.
  double ns_min = 0, ns_median = 0, ns_p99 = 0, ns_spread = 0;
  double error_p50 = 0, error_p99 = 0, error_max = 0;  // referee's, in L
  std::uint64_t pairs_true = 0, pairs_reported = 0;    // candidates
  std::string unsound;                                 // why it cannot be on the front; empty: it can
  bool front = false;  // nobody sound is both faster (median) and as accurate (p99; candidates: precision)
  bool tie = false;    // on the front, but somebody as accurate is as fast within noise
  double precision() const {
    return pairs_reported ? static_cast<double>(pairs_true) / static_cast<double>(pairs_reported) : 1;
  }
};

struct ChartEngine {
  std::string name, library, version, settings;
};

struct Chart {
  Machine machine;
  std::uint64_t seed = 0;
  int rounds = 0;
  std::int64_t measure_ns = 0;
  std::string scope;  // quick, full
  std::vector<ChartEngine> engines;
  std::vector<ChartRow> rows;
};

/// Rows as arrays, named by "columns"; of "text_columns" a cell is a place in "strings".
Json to_json(const Chart& c);
/// Of a document that to_json wrote. Throws InputError, which names `file`.
Chart chart_from_json(const Json& j, const std::string& file);
std::string to_csv(const Chart& c);

}  // namespace touchstone::fuzz
