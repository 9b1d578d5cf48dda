// The final output of a process that died, summarised: how it ended, what it printed, where it was. Also
// where an exception that an engine reports was thrown.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace touchstone {

/// How much of a process's standard error is kept, from the end.
inline constexpr std::size_t last_words_bytes = 8192;
/// Prefix of the line with a worker's call stack (oracles/host/crash_report.cpp).
inline constexpr const char* frames_prefix = "touchstone-frames:";
inline constexpr const char* host_program_name = "touchstone-host";

struct LastWords {
  /// For people: "SIGABRT: distance-inl.h:177: Assertion `index != -1' failed in fcl::distance(...); called
  /// by ...".
  std::string detail;
  /// Identifies the crash, independently of the query and of where modules were loaded:
  /// "distance-inl.h:177", "libfcl:detail::collide"; empty when unknown.
  std::string site;
};

/// `how`: "SIGABRT", "exit code 3". `speaks`: this kind of end prints a message, which is the last line.
LastWords last_words(std::string_view how, std::string_view standard_error, bool speaks);

/// Where an exception was thrown, if its text names a file and a line: "gjk_libccd-inl.h:1270"; else empty.
std::string site_of_exception(std::string_view text);

/// The site as part of a key: at most 48 lower-case letters, digits, '_' and '-'.
std::string site_word(std::string_view site);

}  // namespace touchstone
