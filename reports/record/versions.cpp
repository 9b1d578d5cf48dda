#include "reports/record/versions.h"

namespace touchstone::fuzz {
namespace {

Json release_or_null(const VersionTable& t, const std::optional<std::size_t>& index) {
  return index ? Json(t.releases[*index].number) : Json(nullptr);
}

Json to_json(const VersionTable& t, const VersionTable::Row& row) {
  const Lifetime life = lifetime_of(row.says);
  Json j{{"id", row.id},
         {"title", row.title},
         {"severity", to_string(row.severity)},
         {"engine", row.engine},
         {"question", row.question},
         {"fault", row.fault},
         {"introduced_in", release_or_null(t, life.first)},
         {"not_in", release_or_null(t, life.not_yet)},
         {"gone_since", release_or_null(t, life.gone)},
         {"comes_and_goes", life.comes_and_goes}};
  for (std::size_t i = 0; i < row.says.size(); ++i)
    j["releases"][t.releases[i].number] = {{"says", to_string(row.says[i].showing)},
                                           {"words", row.says[i].words}};
  j["case"] = row.c;
  return j;
}

}  // namespace

Lifetime lifetime_of(const std::vector<ReleaseSays>& says) {
  Lifetime life;
  bool right_since = false;
  for (std::size_t i = 0; i < says.size(); ++i) {
    const bool shows = says[i].showing == Showing::shows, right = says[i].showing == Showing::right;
    if (shows) {
      if (!life.first) life.first = i;
      if (right_since) life.comes_and_goes = true;
      life.gone.reset();
      right_since = false;
    } else if (right && !life.first) {
      life.not_yet = i;
    } else if (right && !right_since) {
      life.gone = i;
      right_since = true;
    }
  }
  return life;
}

Json to_json(const VersionTable& t) {
  Json j{{"touchstone_versions", 1}, {"engine", t.engine}, {"package", t.package}};
  j["releases"] = Json::array();
  for (const VersionTable::Release& r : t.releases)
    j["releases"].push_back(
        {{"release", r.number}, {"answered", r.answered}, {"wrong", r.wrong}, {"cannot", r.cannot}});
  j["causes"] = Json::array();
  for (const VersionTable::Row& row : t.rows) j["causes"].push_back(to_json(t, row));
  return j;
}

}  // namespace touchstone::fuzz
