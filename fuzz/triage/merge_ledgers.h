// Several ledgers into one.
#pragma once

#include <filesystem>
#include <span>

#include "fuzz/triage/ledger.h"

namespace touchstone::fuzz {

/// Of two rows of one key: seen first by the earlier, last by the later, which also says whether it has
/// expired; the smaller case; the larger count (counts of two ledgers may be of the same runs, so that their
/// sum would grow with every merge). Commutative, associative, idempotent.
KnownFinding merged(const KnownFinding& x, const KnownFinding& y);

/// Adds the rows of all `in` to `out`, which is made when it is not there; returns its rows. Throws
/// InputError.
std::size_t merge_ledgers(const std::filesystem::path& out, std::span<const std::filesystem::path> in);

}  // namespace touchstone::fuzz
