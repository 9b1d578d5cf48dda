// One line about one stored result: what is in it, and its verdict. For lists of results.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "reports/record/observation_json.h"

namespace touchstone::reports {

/// How a verdict is to be shown. `none`: the result judges nothing.
enum class Mood { none, good, bad, open };
std::string_view to_string(Mood m);

struct ResultLine {
  std::string kind = {};     // "campaign", "causes", "certificate", …; a page has the kind of its record
  std::string subject = {};  // whom or what it is about: engines, a robot, a scene
  std::string content = {};  // what was done, with numbers
  std::string verdict = {};
  Mood mood = Mood::none;
  std::string identity = {};  // equal for a record and for the page that was made of it
};

/// `document`: a record, or the data of a page, as a command wrote it; `place` names it in errors. nullopt if
/// it is not a result. Throws InputError if it says that it is one and cannot be read.
std::optional<ResultLine> result_line(const fuzz::Json& document, const std::string& place);

}  // namespace touchstone::reports
