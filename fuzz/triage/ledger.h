// The ledger of known findings: one SQLite file, one row per key. It outlives campaigns, so that a nightly
// run reports only what is new. A row expires when its case stops reproducing, and comes back when it does
// again.
//
//   finding(key TEXT PRIMARY KEY, engine, question, fault, shapes, blame, degeneracy, magnitude TEXT,
//           first_seen, last_seen TEXT, first_build, last_build TEXT, count INTEGER, bodies, steps, bits
//           INTEGER, smallest TEXT, words TEXT, expired TEXT)
// Dates are ISO 8601, UTC. Builds name the engine's library and version. `smallest` is the case as JSON.
// `expired` is empty while the finding reproduces, else the date on which it first did not.
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
/// version, stays locked for a minute, or the disk is full. The file is untrusted: views, triggers and
/// functions in it are not run. Any schema other than the one above is rejected, and so is a row whose key
/// does not match its fields or cannot name a directory.
class Ledger {
 public:
  enum class For { reading, writing };
  /// With For::writing, creates the file if it does not exist.
  explicit Ledger(const std::filesystem::path& file, For purpose = For::writing);
  ~Ledger();
  Ledger(const Ledger&) = delete;
  Ledger& operator=(const Ledger&) = delete;

  std::optional<KnownFinding> find(const std::string& key) const;
  /// Sorted by key.
  std::vector<KnownFinding> all() const;
  /// Inserts, or replaces the row of the same key.
  void put(const KnownFinding& f);
  /// Ends the transaction; afterwards the ledger may only be read.
  void commit();

 private:
  struct Database;
  std::unique_ptr<Database> db_;
  bool is_empty_ = false;  // the file has no table, and is only read
};

// Merges several ledgers into one.

/// Merges two rows with the same key: the earlier first sighting, the later last sighting, the expiry of the
/// row updated last, the smaller case, and the larger count (not the sum: both ledgers may have counted the
/// same runs, so a sum would grow with every merge). Commutative, associative, idempotent.
KnownFinding merged(const KnownFinding& x, const KnownFinding& y);

/// Adds the rows of all `in` to `out`, which is created if needed. Returns the number of rows in `out`.
/// Throws InputError.
std::size_t merge_ledgers(const std::filesystem::path& out, std::span<const std::filesystem::path> in);

}  // namespace touchstone::fuzz
