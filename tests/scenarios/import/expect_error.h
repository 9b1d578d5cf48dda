// Runs f, which must refuse its input, and returns its message of one line.
#pragma once

#include <string>

#include "core/base/input_error.h"
#include "tests/support/catch.h"

namespace touchstone::test {

template <class F>
std::string refusal(F&& f) {
  try {
    f();
  } catch (const InputError& e) {
    const std::string what = e.what();
    CHECK(what.find('\n') == std::string::npos);
    CHECK(!e.reason().empty());
    return what;
  }
  return "(accepted)";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace touchstone::test
