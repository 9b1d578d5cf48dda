// What docs/findings.md and the README's picture state about engines agrees with the stored numbers and with
// the engines themselves.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "core/base/input_error.h"
#include "reports/text/record_text.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using fuzz::Json;
using touchstone::test::read_all;
using touchstone::test::Workspace;

namespace {

const std::string findings_file = TS_SOURCE_DIR "/docs/findings.md",
                  chart_file = TS_SOURCE_DIR "/docs/chart.json";

fuzz::Chart kept_chart() {
  return fuzz::chart_from_json(test::parsed<Json>(read_all(chart_file)), chart_file);
}

struct Claim {
  std::string engine, question, fault, file;
};

// The rows | `engine` | question | fault | words | `case` |.
std::vector<Claim> claims() {
  const std::string text = read_all(findings_file);
  const std::regex row(R"(\n\| `([^`]+)` \| (\w+) \| (\w+) \| [^|]+ \| `([^`]+)` \|)");
  std::vector<Claim> all;
  for (auto m = std::sregex_iterator(text.begin(), text.end(), row); m != std::sregex_iterator(); ++m)
    all.push_back({(*m)[1], (*m)[2], (*m)[3], TS_SOURCE_DIR "/scenarios/corpus/" + (*m)[4].str() + ".json"});
  return all;
}

}  // namespace

TEST_CASE("the chart in the findings is that of docs/chart.json", "[readme][chart]") {
  const std::string text = read_all(findings_file);
  const fuzz::Chart kept = kept_chart();
  const fuzz::Chart excerpt = reports::chart_excerpt(kept);
  CHECK(fuzz::to_json(excerpt) == fuzz::to_json(kept));
  CHECK(reports::with_chart_block(text, reports::chart_markdown(kept), findings_file) == text);
  CHECK(kept.rows.size() >= 20);
  std::set<std::string> questions;
  for (const fuzz::ChartRow& r : kept.rows) questions.insert(r.question);
  CHECK(questions.size() == 9);
  fuzz::Chart other = kept;
  other.rows[3].ns_median *= 2;
  CHECK(reports::chart_markdown(other) != reports::chart_markdown(kept));
}

TEST_CASE("the README's picture is that of docs/chart.json", "[readme][chart]") {
  const fuzz::Chart kept = kept_chart();
  for (const bool dark : {false, true}) {
    const std::string file = dark ? "chart-dark.svg" : "chart-light.svg";
    INFO(file);
    const std::string picture = reports::chart_svg(kept, dark);
    CHECK(read_all(TS_SOURCE_DIR "/docs/" + file) == picture);
    CHECK(read_all(TS_SOURCE_DIR "/README.md").find("docs/" + file) != std::string::npos);
    const std::set<std::string> drawn = {"overlap", "distance", "contact", "time_of_impact"};
    for (const fuzz::ChartRow& r : kept.rows)
      if (drawn.contains(r.question)) CHECK(picture.find(">" + r.engine + "</text>") != std::string::npos);
  }
}

TEST_CASE("a stored chart is read back unchanged, and an invalid one is refused", "[chart]") {
  const fuzz::Chart kept = kept_chart();
  CHECK(fuzz::to_json(fuzz::chart_from_json(fuzz::to_json(kept), "x")) == fuzz::to_json(kept));
  Json broken = fuzz::to_json(kept);
  broken["rows"][0][0] = 1000000;
  CHECK_THROWS_AS(fuzz::chart_from_json(broken, "x"), InputError);
  broken["version"] = 1;
  CHECK_THROWS_AS(fuzz::chart_from_json(broken, "x"), InputError);
  CHECK_THROWS_AS(fuzz::chart_from_json(Json(), "x"), InputError);
  CHECK_THROWS_AS(reports::with_chart_block("no markers", "", "x"), InputError);
}

TEST_CASE("every fault in the table of findings is shown by its case, and has a reproducer",
          "[readme][optional]") {
  const Workspace w("readme_findings");
  const auto all = claims();
  CHECK(all.size() >= 10);
  const std::string engines = w.touchstone("engines").out;
  std::size_t shown = 0;
  for (const Claim& c : all) {
    INFO(c.engine << " " << c.question << " " << c.fault << " " << c.file);
    if (engines.find(c.engine + " ") == std::string::npos) continue;  // its library is not installed
    const auto r = w.touchstone("replay " + c.file + " --case-seconds 0.3 --json --engines " + c.engine);
    const Json cases = test::parsed<Json>(r.out);
    bool found = false;
    for (const Json& q : cases[0]["queries"]) {
      if (q["question"] != c.question) continue;
      const Json& e = q["engines"][c.engine];
      found |= e["answer"]["outcome"] == c.fault;
      for (const Json& f : e["faults"]) found |= f["fault"] == c.fault;
    }
    CHECK(found);
    const std::string reproduce = "reproduce " + c.file + " --case-seconds 0.3 -o r.cpp --engine " + c.engine;
    auto written = w.touchstone(reproduce);
    if (written.code == 2) {  // several findings: the message lists their keys
      const std::regex key(c.engine + "\\." + c.question + "\\." + c.fault + "(_[a-z0-9_-]+)?\\.\\S+");
      std::smatch m;
      REQUIRE(std::regex_search(written.err, m, key));
      written = w.touchstone(reproduce + " --key " + m.str());
    }
    CHECK(written.code == 0);
    CHECK(read_all(w.dir / "r.cpp").find("int main") != std::string::npos);
    ++shown;
  }
  if (shown == 0) test::skip("no engine of the table is installed");
}
