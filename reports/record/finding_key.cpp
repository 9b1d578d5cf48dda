// The key of a finding: its parts, and which texts are one.
#include <fmt/format.h>

#include <algorithm>

#include "reports/record/result.h"
#include "reports/record/stored.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::fuzz {
namespace {

bool is_key_word(const std::string& s) {
  return !s.empty() && std::all_of(s.begin(), s.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

constexpr std::size_t longest_key = 240;  // a file name may have 255 bytes

}  // namespace

std::string Finding::key() const {
  return fmt::format("{}.{}.{}.{}.{}.{}.{}", engine, question, fault, shapes, blame, degeneracy, magnitude);
}

bool has_plain_key(const Finding& f) {
  return is_engine_name(f.engine) && is_key_word(f.question) && is_key_word(f.fault) &&
         is_key_word(f.shapes) && is_key_word(f.blame) && is_key_word(f.degeneracy) &&
         is_key_word(f.magnitude) && f.key().size() <= longest_key;
}

std::optional<Finding> finding_of_key(const std::string& engine, const std::string& key) {
  if (!key.starts_with(engine + ".")) return std::nullopt;
  Finding f;
  f.engine = engine;
  std::size_t at = engine.size() + 1;
  for (std::string* part : {&f.question, &f.fault, &f.shapes, &f.blame, &f.degeneracy, &f.magnitude}) {
    const std::size_t dot = std::min(key.find('.', at), key.size());
    *part = key.substr(std::min(at, key.size()), dot - std::min(at, key.size()));
    at = dot + 1;
  }
  return f.key() == key && has_plain_key(f) ? std::optional(f) : std::nullopt;
}

}  // namespace touchstone::fuzz
