// Dates of runs, UTC, ISO 8601 (scenarios/text/iso_date.h).
#pragma once

#include <string>

namespace touchstone::cli {

/// The date and time now: "2026-11-23T02:00:00Z".
std::string utc_now();

/// The text of --date, or now if it is empty. Throws InputError unless it is a date, with or without a time.
std::string date_of_run(const std::string& given);

}  // namespace touchstone::cli
