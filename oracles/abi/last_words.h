// What a process wrote before it died, made short: how it ended, what it said, where it was.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace touchstone {

/// How much of a process's standard error is kept, from the end.
inline constexpr std::size_t last_words_bytes = 8192;
/// A worker's call stack is a line that begins so (oracles/host/crash_report.cpp).
inline constexpr const char* frames_prefix = "touchstone-frames:";
inline constexpr const char* host_program_name = "touchstone-host";

struct LastWords {
  /// For people: "SIGABRT: distance-inl.h:177: Assertion `index != -1' failed in fcl::distance(...); called
  /// by ...".
  std::string detail;
  /// What tells one crash from another, whatever was asked and wherever modules were loaded:
  /// "distance-inl.h:177", "libfcl:detail::collide"; empty when it is not known.
  std::string site;
};

/// `how`: "SIGABRT", "exit code 3". `speaks`: the end itself prints, so that the last line is about it.
LastWords last_words(std::string_view how, std::string_view standard_error, bool speaks);

/// The site as a part of a key: small letters, digits, '_' and '-', at most 48 of them.
std::string site_word(std::string_view site);

}  // namespace touchstone
