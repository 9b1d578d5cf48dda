#include "fuzz/triage/cause_files.h"

#include <fmt/format.h>

#include <set>

#include "core/base/input_error.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "causes.json";

// Throws unless triage can ask the cause again.
void require_usable(const Cause& c, const JsonReader& j) {
  for (const auto* list : {&c.engines, &c.shapes})
    for (const std::string& word : *list)
      if (printable(word) != word) j.fail("has a name with control characters: " + printable(word));
  const CauseCase& shown = c.shown();
  if (shown.c.is_null()) return;
  const JsonReader place = j[c.defensible.c.is_null() ? "smallest" : "defensible"];
  if (!finding_of_key(shown.engine, shown.key))
    place["key"].fail("is not the key of a finding of " + shown.engine + ": " + printable(shown.key));
  case_from_json(shown.c, place["case"].place());
}

bool is_lines_for_a_pipe(const std::string& program) { return program.starts_with('{'); }

bool is_certificate(const Json& j) { return j.is_object() && j.contains("kind") && j["kind"] != "none"; }

}  // namespace

bool has_causes(const fs::path& directory) { return fs::exists(directory / file_name); }

std::optional<Causes> stored_causes(const fs::path& directory, const std::string& digest) {
  if (!has_causes(directory)) return std::nullopt;
  const fs::path file = directory / file_name;
  const Json json = load_json(file, campaign_limits);
  const JsonReader j(json, file.string());
  if (j["digest"].string() != digest) return std::nullopt;
  Causes causes = causes_from_json(j);
  const auto items = j["causes"].items();
  std::set<std::string> ids;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!ids.insert(causes.causes[i].id).second) items[i]["id"].fail("is the id of two causes");
    require_usable(causes.causes[i], items[i]);
  }
  return causes;
}

void store_causes(const fs::path& directory, const Causes& causes) {
  write_file(directory / file_name, json_text(to_json(causes), 1) + "\n");
}

Json finding_json_of(const Cause& c) {
  const CauseCase& shown = c.shown();
  auto f = finding_of_key(shown.engine, shown.key);
  if (shown.c.is_null() || !f) throw InputError(c.id, "has no case that shows it");
  f->count = c.wrong;
  f->worst_in_l = shown.error_in_l;
  f->first_index = c.first_index;
  f->words = shown.words;
  Json j = {{"key", shown.key}};
  j.update(to_json(*f));
  j["certificate"] = is_certificate(c.certificate) ? c.certificate : Json{{"kind", "none"}};
  return j;
}

Written write_cause(const fs::path& directory, const Cause& c,
                    const std::function<std::string(const Cause&)>& issue) {
  if (!is_cause_id(c.id)) throw InputError(printable(c.id), "is not the id of a cause");
  const fs::path to = directory / c.id, part = directory / (".part-" + c.id);
  if (fs::exists(to)) return Written::before;
  if (c.shown().c.is_null()) return Written::no_case;
  const Json finding = finding_json_of(c);
  StoredCase stored;
  stored.c = case_from_json(c.shown().c, c.id);
  stored.description = fmt::format("shows {}: {}", c.shown().key, c.title);
  fs::remove_all(part);
  fs::create_directories(part);
  save_case(stored, part / "case.json");
  write_file(part / "finding.json", json_text(finding, 1) + "\n");
  if (is_certificate(c.certificate))
    write_file(part / "certificate.json", json_text(c.certificate, 1) + "\n");
  if (issue) write_file(part / "issue.md", issue(c));
  if (!c.program.empty())
    write_file(part / (is_lines_for_a_pipe(c.program) ? "reproduce.jsonl" : "reproduce.cpp"), c.program);
  else if (!c.no_program.empty())
    write_file(part / "no_reproducer.txt", c.no_program + "\n");
  fs::rename(part, to);
  return Written::now;
}

}  // namespace touchstone::fuzz
