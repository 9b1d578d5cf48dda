// The data of the page `causes`: the record with what the page does not work out itself.
#include "reports/text/cause_words.h"
#include "reports/text/causes_text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using fuzz::Cause;
using fuzz::Json;

// The page draws one case a cause; the others are in causes.json.
void drop_cases_not_drawn(const Cause& c, Json& j) {
  if (!c.defensible.c.is_null()) j.at("smallest").erase("case");
  j.at("worst").erase("case");
  j.erase("keys");
  j["key_count"] = c.keys.size();
}

std::string command_for(const std::string& directory) {
  return "./touchstone causes " + shell_word(one_line(directory));
}

}  // namespace

Json cause_rows(const fuzz::Causes& c, const std::string& directory) {
  const std::string command = command_for(directory);
  Json list = Json::array();
  for (const Cause& cause : c.causes)
    list.push_back({{"id", cause.id},
                    {"path", one_line(cause.path)},
                    {"severity", to_string(cause.severity)},
                    {"documented", one_line(cause.documented)},
                    {"wrong", cause.wrong},
                    {"title", one_line(cause.title)},
                    {"command", command_of(cause, command)}});
  return {{"command", command + " --page " + shell_word(one_line(directory) + "/causes.html")},
          {"list", std::move(list)}};
}

Json causes_page(const fuzz::Causes& c) {
  Json record = fuzz::to_json(c);
  const std::string command = command_for(c.campaign);
  for (std::size_t i = 0; i < c.causes.size(); ++i) {
    const Cause& cause = c.causes[i];
    Json& j = record.at("causes").at(i);
    drop_cases_not_drawn(cause, j);
    j["rate_text"] = rate_text(cause);
    j["expected"] = expected_of(cause.severity);
    j["command"] = command_of(cause, command);
    j["markdown"] = cause_markdown(cause);
  }
  record["unseen_text"] = share_text(c.unseen);
  return {{"page", "causes"},
          {"version", 1},
          {"title", "causes of " + one_line(c.campaign)},
          {"command", command},
          {"record", std::move(record)}};
}

}  // namespace touchstone::reports
