// Merges several ledgers into one.
#pragma once

#include <filesystem>
#include <span>

#include "fuzz/triage/ledger.h"

namespace touchstone::fuzz {

/// Merges two rows with the same key: the earlier first sighting, the later last sighting, the expiry of the
/// row updated last, the smaller case, and the larger count (not the sum: both ledgers may have counted the
/// same runs, so a sum would grow with every merge). Commutative, associative, idempotent.
KnownFinding merged(const KnownFinding& x, const KnownFinding& y);

/// Adds the rows of all `in` to `out`, which is created if needed. Returns the number of rows in `out`.
/// Throws InputError.
std::size_t merge_ledgers(const std::filesystem::path& out, std::span<const std::filesystem::path> in);

}  // namespace touchstone::fuzz
