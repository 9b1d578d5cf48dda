#include "cli/date.h"

#include <chrono>
#include <ctime>

#include "core/base/input_error.h"
#include "scenarios/text/iso_date.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {

std::string utc_now() {
  const std::time_t t = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&t, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

std::string date_of_run(const std::string& given) {
  if (given.empty()) return utc_now();
  if (!is_iso_time(given))
    throw InputError("--date",
                     "is not a date such as 2026-11-23 or 2026-11-23T02:00:00Z: " + printable(given));
  return given;
}

}  // namespace touchstone::cli
