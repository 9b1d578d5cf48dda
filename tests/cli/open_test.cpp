// `touchstone open DIR`: what the index lists, that no name of a file can be more than a name, and refusals.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "reports/text/web_page.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using touchstone::test::read_all;
using touchstone::test::Workspace;
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

// The data of the index. Without Node there are no pages, and it is in a JSON file.
Json index_in(const fs::path& directory) {
  const fs::path page = directory / "index.html";
  if (!fs::exists(page)) return touchstone::test::parsed<Json>(read_all(directory / "index.html.json"));
  return touchstone::test::parsed<Json>(
      touchstone::reports::data_of_page(read_all(page), page.string()).value());
}

bool has_pages() { return fs::exists(TS_BINARY_DIR "/share/touchstone/web/index.html"); }

const Json* find(const Json& index, const std::string& kind, const std::string& record) {
  for (const Json& r : index["results"])
    if (r["kind"] == kind && r["record"].is_object() && r["record"]["name"] == record) return &r;
  return nullptr;
}

std::string unescaped(const std::string& address) {
  std::string text;
  for (std::size_t i = 0; i < address.size(); ++i) {
    if (address[i] != '%') {
      text += address[i];
      continue;
    }
    text += static_cast<char>(std::stoi(address.substr(i + 1, 2), nullptr, 16));
    i += 2;
  }
  return text;
}

const std::string hostile = "\"><img src=x onerror=alert(1)> & 50%25 javascript:'`$(x)";

}  // namespace

TEST_CASE("open lists what a directory holds, with its verdict", "[cli][open]") {
  const Workspace w("open");
  fs::create_directories(w.dir / "results");
  const auto at = [&](const std::string& line) { return w.touchstone(line).code; };
  REQUIRE(at("fuzz --cases 40 --engines core --relations 0 --out results/run") == 0);
  REQUIRE(at("fuzz --cases 60 --relations 0 --out results/lies --subject core --engines core," TS_BINARY_DIR
             "/lib/libtouchstone_mutants.so:overlap_spheres") == 0);
  REQUIRE(at("causes results/lies --budget 0.05 --engines " TS_BINARY_DIR
             "/lib/libtouchstone_mutants.so:overlap_spheres") == 0);
  REQUIRE(at("certify --subject grid --limit 40 -o results/grid.json") == 0);
  REQUIRE(at("fingerprint core --cases 20 -o results/core.json") == 0);
  REQUIRE(at("plan cubes_on_a_wide_floor --error 1e-3 -o results/plan.json") == 0);
  REQUIRE(at("scenarios spheres_kiss > results/kiss.case.json") == 0);
  w.write("results/notes.json", R"({"mine": true})");
  const auto r = w.touchstone("open results");
  INFO(r.out << r.err);
  CHECK(r.code == (has_pages() ? 0 : 3));
  const Json index = index_in(w.dir / "results");
  const Json* run = find(index, "campaign", "run/summary.json");
  REQUIRE(run);
  CHECK((*run)["subject"] == "core");
  CHECK((*run)["verdict"] == "no wrong answer");
  CHECK((*run)["mood"] == "good");
  CHECK((*run)["content"].get<std::string>().starts_with("40 cases, "));
  const Json* lies = find(index, "campaign", "lies/summary.json");
  REQUIRE(lies);
  CHECK((*lies)["mood"] == "bad");
  CHECK((*lies)["verdict"].get<std::string>().starts_with("wrong: overlap_spheres "));
  const Json* causes = find(index, "causes", "lies/causes.json");
  REQUIRE(causes);
  CHECK((*causes)["mood"] == "bad");
  const Json* grid = find(index, "certificate", "grid.json");
  REQUIRE(grid);
  CHECK((*grid)["subject"] == "grid");
  CHECK((*grid)["verdict"] == "boxes certified, bodies certified");
  CHECK(find(index, "fingerprint", "core.json"));
  const Json* plan = find(index, "plan", "plan.json");
  REQUIRE(plan);
  CHECK((*plan)["mood"] == "good");
  CHECK(find(index, "case", "kiss.case.json"));
  CHECK(index["unreadable"].empty());
  for (const Json& each : index["results"])
    for (const char* place : {"page", "record"})
      if (each[place].is_object()) {
        const std::string address = each[place]["address"];
        INFO(address);
        CHECK(fs::exists(w.dir / "results" / unescaped(address)));
        CHECK(address.find("findings/") == std::string::npos);  // evidence is reached from its campaign
      }
}

TEST_CASE("a record and its page are one result, and the index does not list itself",
          "[cli][open][optional]") {
  if (!has_pages()) return touchstone::test::skip("the pages are not built");
  const Workspace w("open-pages");
  REQUIRE(w.touchstone("certify --subject grid --limit 40 -o grid.json --page pages.html").code == 0);
  REQUIRE(w.touchstone("view spheres_kiss --engines core -o kiss.html").code == 0);
  for (int again = 0; again < 2; ++again) {
    REQUIRE(w.touchstone("open .").code == 0);
    const Json index = index_in(w.dir);
    REQUIRE(index["results"].size() == 2);
    CHECK(index["results"][0]["record"]["name"] == "grid.json");
    CHECK(index["results"][0]["page"]["address"] == "./pages.html");
    CHECK(index["results"][1]["verdict"] == "no wrong answer");
  }
  fs::create_directories(w.dir / "elsewhere");
  REQUIRE(w.touchstone("open . -o elsewhere/list.html").code == 0);
  const std::string page = read_all(w.dir / "elsewhere/list.html");
  CHECK(page.find("./../pages.html") != std::string::npos);
}

TEST_CASE("names in files and of files stay names", "[cli][open]") {
  const Workspace w("open-hostile");
  fs::create_directories(w.dir / hostile);
  const std::string text = read_all(TS_SOURCE_DIR "/scenarios/corpus/jolt-epa-coincident-spheres.json");
  REQUIRE_FALSE(text.empty());
  Json c = touchstone::test::parsed<Json>(text);
  c["id"] = "</script><script>alert(2)</script>";
  w.write(hostile + "/" + hostile + ".json", c.dump());
  w.write("broken.json", R"({"touchstone_causes": 1, "causes": [)");
  w.write("odd.json", R"({"touchstone_plan": 1, "scene": 5})");
  w.write("cut.html", R"(<script id="data" type="application/json">{"deflate":"AAAA)");
  const auto r = w.touchstone("open .");
  INFO(r.out << r.err);
  CHECK(r.code == (has_pages() ? 0 : 3));
  const Json index = index_in(w.dir);
  REQUIRE(index["results"].size() == 1);
  const std::string address = index["results"][0]["record"]["address"];
  CHECK(address.starts_with("./"));
  CHECK(address.find_first_of("\"'<>:&?# $`(") == std::string::npos);
  CHECK(fs::exists(w.dir / unescaped(address)));
  REQUIRE(index["unreadable"].size() == 3);
  CHECK(index["unreadable"][0]["file"]["name"] == "broken.json");
  CHECK(index["unreadable"][2]["reason"].get<std::string>().find("scene") != std::string::npos);
  CHECK(r.err.find("broken.json") != std::string::npos);
  if (has_pages()) {
    const std::string page = read_all(w.dir / "index.html");
    CHECK(page.find("<script>alert(2)") == std::string::npos);
    CHECK(page.find("<img src=x") == std::string::npos);
  }
}

TEST_CASE("open refuses what is no directory of results", "[cli][open]") {
  const Workspace w("open-refused");
  const auto refused = [&](const std::string& args, const std::string& reason) {
    INFO(args);
    const auto r = w.touchstone("open " + args);
    CHECK(r.code == 2);
    CHECK(r.err.find(reason) != std::string::npos);
  };
  refused("nowhere", "nowhere: is not a directory");
  refused(w.write("file", "text").string(), "is not a directory");
  fs::create_directories(w.dir / "empty");
  refused("empty", "empty: holds no results");
  refused("", "directory is required");
  fs::create_directories(w.dir / "site");
  w.write("site/index.html", "<html>mine</html>");
  refused("site", "exists and is not a page of this command");
  CHECK(read_all(w.dir / "site/index.html") == "<html>mine</html>");
  refused("site -o file/index.html", "cannot be created");
}
