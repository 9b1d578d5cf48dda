// The ledger of known causes: one SQLite file, one row per cause. It outlives campaigns, so that a nightly
// run reports only what is new. A row expires when its case stops showing the cause, and comes back when the
// cause is seen again.
//
//   cause(id TEXT PRIMARY KEY, path, title, documented, severity, engines, shapes, first_seen, last_seen,
//         first_build, last_build TEXT, count, bodies, steps, bits INTEGER, engine, key, shown, words,
//         expired, reason, until TEXT)
// The fields of KnownCause; lists are arrays in JSON. Dates are ISO 8601, UTC. Builds name the engine's
// library and version.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/record/triage.h"

namespace touchstone::fuzz {

/// One transaction from construction to commit(): a run that is killed half-way changes nothing, and other
/// processes wait for it. All functions throw InputError naming the file when it is not a ledger, has a later
/// version, is an older ledger of findings, stays locked for a minute, or the disk is full. The file is
/// untrusted: views, triggers and functions in it are not run. Any schema other than the one above is
/// rejected, and so is a row whose id cannot name a directory or whose key is not one of its engine.
class Ledger {
 public:
  enum class For { reading, writing };
  /// With For::writing, creates the file if it does not exist.
  explicit Ledger(const std::filesystem::path& file, For purpose = For::writing);
  ~Ledger();
  Ledger(const Ledger&) = delete;
  Ledger& operator=(const Ledger&) = delete;

  std::optional<KnownCause> find(const std::string& id) const;
  /// Sorted by id.
  std::vector<KnownCause> all() const;
  /// Inserts, or replaces the row of the same id. Refuses what could not be read back.
  void put(const KnownCause& k);
  /// Ends the transaction; afterwards the ledger may only be read.
  void commit();

 private:
  struct Database;
  std::unique_ptr<Database> db_;
  bool is_empty_ = false;  // the file has no table, and is only read
};

// Merges several ledgers into one.

/// Merges two rows of the same cause: the earlier first sighting; the later last sighting, with what was said
/// of the cause then; the graver severity; all engines and shapes; the expiry date of the row updated last;
/// the smaller case; the suppression that lasts longer; and the larger count (not the sum: both ledgers may
/// have counted the same runs, so a sum would grow with every merge). Commutative, associative, idempotent.
KnownCause merged(const KnownCause& x, const KnownCause& y);

/// Adds the rows of all `in` to `out`, which is created if needed. Returns the number of rows in `out`.
/// Throws InputError.
std::size_t merge_ledgers(const std::filesystem::path& out, std::span<const std::filesystem::path> in);

}  // namespace touchstone::fuzz
