#include "tests/support/parsed.h"

namespace touchstone::test {

template <>
nlohmann::json parsed(std::string_view text) {
  return nlohmann::json::parse(text);
}

template <>
nlohmann::ordered_json parsed(std::string_view text) {
  return nlohmann::ordered_json::parse(text);
}

}  // namespace touchstone::test
