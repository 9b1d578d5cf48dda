// The ledger of known findings: one SQLite file, one row a key. It outlives campaigns, so that a nightly run
// says only what is new. Rows expire when their case stops reproducing, and come back when it does again.
//
//   finding(key TEXT PRIMARY KEY, engine, question, fault, shapes, blame, degeneracy, magnitude TEXT,
//           first_seen, last_seen TEXT, first_build, last_build TEXT, count INTEGER, bodies, steps, bits
//           INTEGER, smallest TEXT, words TEXT, expired TEXT)
// Dates are ISO 8601, UTC; builds name the engine's library and version; smallest is the case as JSON;
// expired is empty while the finding reproduces, else the date when it was first found not to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/triage.h"

namespace touchstone::fuzz {

/// One transaction from construction to commit(): a run that is killed half-way changes nothing. Others wait
/// for it. All functions throw InputError naming the file: no ledger, of a later version, locked for a
/// minute, disk full. The file may be a stranger's: views, triggers and functions in it are not run, a schema
/// other than the one above is refused, and so is a row whose key is not that of its fields or names no
/// directory.
class Ledger {
 public:
  enum class For { reading, writing };
  /// For writing, it makes the file when there is none.
  explicit Ledger(const std::filesystem::path& file, For purpose = For::writing);
  ~Ledger();
  Ledger(const Ledger&) = delete;
  Ledger& operator=(const Ledger&) = delete;

  std::optional<KnownFinding> find(const std::string& key) const;
  /// Sorted by key.
  std::vector<KnownFinding> all() const;
  /// Inserts, or replaces the row of the same key.
  void put(const KnownFinding& f);
  /// Ends the transaction: afterwards it is only read.
  void commit();

 private:
  struct Database;
  std::unique_ptr<Database> db_;
  bool is_empty_ = false;  // a file without the table, which is there to be read only
};

}  // namespace touchstone::fuzz
