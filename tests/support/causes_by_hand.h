// Causes of a campaign without `touchstone causes`: one for each engine, question and kind of fault, with the
// first of its findings as its case. Not distinct bugs, but a causes.json that triage accepts.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "reports/record/causes.h"
#include "reports/record/result.h"

namespace touchstone::test {

inline fuzz::Json json_of(const std::filesystem::path& file) {
  std::ifstream f(file);
  return fuzz::Json::parse(f);
}

/// A word that may name a directory.
inline std::string cause_id(std::string words) {
  for (char& c : words) c = c == '.' || c == ' ' || c == ':' ? '-' : c;
  return words;
}

inline fuzz::Cause cause_of(const fuzz::Json& finding, const fuzz::Json& shown) {
  const auto text = [&](const char* field) { return finding.at(field).get<std::string>(); };
  fuzz::Cause c;
  c.path = text("engine");
  c.id = cause_id(c.path + "-" + text("question") + "-" + std::string(fuzz::kind_of_fault(text("fault"))));
  c.library = "made by hand 1";
  c.title = "answers to " + text("question") + " are " + text("fault");
  c.engines = {c.path};
  c.questions = {text("question")};
  c.faults = {text("fault")};
  c.severity = text("fault") == "missed" ? fuzz::Severity::missed : fuzz::Severity::infeasible;
  c.smallest.engine = c.path;
  c.smallest.key = text("key");
  c.smallest.c = shown;
  c.smallest.words = text("words");
  c.smallest.size.bodies = shown.at("scene").at("bodies").size();
  const std::string kind =
      finding.contains("certificate") ? finding.at("certificate").value("kind", "none") : "none";
  if (kind != "none" && kind != "deferred") c.certificate = finding.at("certificate");
  c.no_program = "it was not asked for one";
  return c;
}

/// The causes of the findings in DIR/findings, sorted by id.
inline fuzz::Causes causes_by_hand(const std::filesystem::path& campaign) {
  std::set<std::filesystem::path> findings;
  if (std::filesystem::exists(campaign / "findings"))
    for (const auto& e : std::filesystem::directory_iterator(campaign / "findings"))
      findings.insert(e.path());
  std::map<std::string, fuzz::Cause> by_id;
  for (const auto& directory : findings) {
    const fuzz::Json finding = json_of(directory / "finding.json");
    const fuzz::Cause one = cause_of(finding, json_of(directory / "case.json"));
    fuzz::Cause& c = by_id.try_emplace(one.id, one).first->second;
    c.wrong += finding.at("count").get<std::uint64_t>();
    c.keys.push_back(finding.at("key"));
    std::set<std::string> shapes(c.shapes.begin(), c.shapes.end());
    shapes.insert(finding.at("shapes").get<std::string>());
    c.shapes.assign(shapes.begin(), shapes.end());
  }
  fuzz::Causes all;
  all.campaign = campaign.filename().string();
  all.digest = json_of(campaign / "summary.json").value("digest", "");
  for (const auto& [id, c] : by_id) all.causes.push_back(c);
  all.keys = findings.size();
  return all;
}

/// Writes DIR/causes.json.
inline void write_causes_by_hand(const std::filesystem::path& campaign) {
  std::ofstream(campaign / "causes.json") << fuzz::to_json(causes_by_hand(campaign)).dump(1);
}

}  // namespace touchstone::test
