// Speed against accuracy: the results of `touchstone chart`, one row per engine, question and group of cases.
// Times depend on the machine named; everything else depends only on the seed.
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
  std::string regime, pair, scale;  // empty: all
  std::uint64_t bodies = 0;         // candidates only: bodies in the scene
  /// Of `asked` queries, `answers` were answered and `failed` were neither answered nor unsupported. Of the
  /// answers: `missed` and `ghost` verdicts; `no_number` (NaN, missing number, normal not of unit length);
  /// `wrong` in any way, of which `rounding` are right for the scene as received; `undecided` by the referee;
  /// `not_judged`: a claim that could have been checked was not; `wide_claim`: the engine claims a tolerance
  /// above 1e-2 L.
  std::uint64_t asked = 0, answers = 0, failed = 0, missed = 0, ghost = 0, no_number = 0, wrong = 0,
                rounding = 0, undecided = 0, not_judged = 0, wide_claim = 0;
  /// Statistics of each query's minimum time over the rounds. Spread: (median − least) / least of the
  /// rounds' medians.
  double ns_min = 0, ns_median = 0, ns_p99 = 0, ns_spread = 0;
  double error_p50 = 0, error_p99 = 0, error_max = 0;  // by the referee, in L
  std::uint64_t pairs_true = 0, pairs_reported = 0;    // candidates only
  std::string unsound;                                 // why it is excluded from the front; empty: it is not
  bool front = false;  // no sound row is both faster (median) and as accurate (p99; candidates: precision)
  bool tie = false;    // on the front, but a row as accurate is as fast within noise
  double precision() const {
    return pairs_reported ? static_cast<double>(pairs_true) / static_cast<double>(pairs_reported) : 1;
  }
};

/// False if the engine's own times are not known.
inline bool is_timed(const ChartRow& r) { return r.ns_median > 0; }

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

/// Rows are arrays with the columns "columns"; a cell in one of "text_columns" is an index into "strings".
Json to_json(const Chart& c);
/// Reads a document written by to_json. Throws InputError naming `file`.
Chart chart_from_json(const Json& j, const std::string& file);
std::string to_csv(const Chart& c);

}  // namespace touchstone::fuzz
