// Which release of an engine has which cause: what `touchstone versions` prints and stores. Plain values,
// with their JSON.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/record/causes.h"

namespace touchstone::fuzz {

/// What a release does with a case that shows a fault in some release.
enum class Showing : std::uint8_t {
  shows,    // the same fault of the same question
  differs,  // wrong about the question in another way
  right,
  open,  // no verdict: the referee could not decide, or nothing was judged
  lacks  // it cannot be asked
};
inline constexpr auto showing_names =
    std::to_array<std::string_view>({"shows", "wrong otherwise", "right", "open", "cannot be asked"});
static_assert(showing_names.size() == static_cast<std::size_t>(Showing::lacks) + 1);
constexpr std::string_view to_string(Showing s) { return showing_names[static_cast<std::size_t>(s)]; }

struct ReleaseSays {
  Showing showing = Showing::open;
  std::string words;  // the fault with its numbers, or why it cannot be asked
};

struct VersionTable {
  struct Release {
    std::string number;  // "0.29.0"
    /// Of the easy questions of `engines --check`: how many it answers, and how many of those wrongly.
    std::size_t answered = 0, wrong = 0;
    std::string cannot;  // why it cannot be asked at all; empty: it can
  };
  struct Row {
    std::string id, title, engine;  // `engine`: the name without a release
    std::string question, fault;
    Severity severity = Severity::relation;
    Json c;                         // the case that every release was asked
    std::vector<ReleaseSays> says;  // by release
  };
  std::string engine, package;
  std::vector<Release> releases;  // ascending
  std::vector<Row> rows;          // the gravest first
};

/// The releases listed between which a cause came and went, as indices.
struct Lifetime {
  std::optional<std::size_t> first;    // that shows it; empty: none does
  std::optional<std::size_t> not_yet;  // the last one before, that was right; empty: none was
  std::optional<std::size_t> gone;     // the first that is right after all that show it
  bool comes_and_goes = false;         // one between the first and the last that show it is right
};
Lifetime lifetime_of(const std::vector<ReleaseSays>& says);

Json to_json(const VersionTable& t);

}  // namespace touchstone::fuzz
