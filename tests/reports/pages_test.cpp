// The pages: their data in a browser when Node, playwright-core and Chromium are installed, and what happens
// when the pages are not built.
#include <zlib.h>
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <sstream>

#include "core/base/input_error.h"
#include "core/shape/shape.h"
#include "reports/text/causes_text.h"
#include "reports/text/web_page.h"
#include "scenarios/codec/json_file.h"
#include "tests/reports/cause_sample.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

namespace fs = std::filesystem;
using touchstone::test::read_all;
using touchstone::test::Workspace;
using Json = nlohmann::json;

namespace {

const fs::path built = TS_BINARY_DIR "/share/touchstone/web";

// Empty when everything that a browser test needs is present.
std::string missing_for_browser() {
  for (const char* kind :
       {"assess", "broad", "case", "causes", "report", "chart", "stability", "certificate", "index", "plan"})
    if (!fs::exists(built / (std::string(kind) + ".html"))) return "the built pages";
  if (!fs::exists(TS_BINARY_DIR "/web/node_modules/playwright-core")) return "playwright-core";
  if (!touchstone::test::has_command("node")) return "node";
  if (!fs::exists("/usr/bin/chromium")) return "/usr/bin/chromium";
  return "";
}

std::string inflated(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    held += 6;
    if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 255);
  }
  std::string text(1 << 20, '\0');
  uLongf size = text.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                     reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) == Z_OK);
  return text.substr(0, size);
}

// The measurements of the browser test: sizes and times, which no check uses.
std::string figures_of(const std::string& out) {
  std::istringstream lines(out);
  std::string figures;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("     ")) figures += line.substr(5) + "\n";
  return figures;
}

// Kept for inspection (continuous integration stores them as artefacts).
std::string pictures_directory() {
  const char* wanted = std::getenv("TOUCHSTONE_SCREENSHOTS");
  return fs::absolute(wanted && *wanted ? wanted : TS_BINARY_DIR "/screenshots").string();
}

// Repeats the findings of a campaign with other shapes and numbers until there are `count`.
void many_findings(const fs::path& from, const fs::path& to, std::size_t count) {
  using Sorted = nlohmann::json;
  Sorted summary = touchstone::test::parsed<Sorted>(read_all(from));
  const std::vector<Sorted> base(summary["findings"].begin(), summary["findings"].end());
  REQUIRE(base.size() > 10);
  std::mt19937_64 random(5);
  Sorted findings = Sorted::object();
  for (std::size_t i = 0; i < count; ++i) {
    Sorted f = base[i % base.size()];
    f.erase("evidence");
    f["shapes"] = f["shapes"].get<std::string>() + "-" + std::to_string(i / base.size());
    f["count"] = 1 + random() % 1000;
    f["worst_in_l"] = static_cast<double>(random() >> 11) * 0x1p-60;
    std::string words = f["words"];
    for (std::size_t k = 1; k < words.size(); ++k)  // other digits: as hard to compress as real ones
      if (std::isdigit(words[k]) && std::isdigit(words[k - 1]))
        words[k] = static_cast<char>('0' + random() % 10);
    f["words"] = words;
    std::string key;
    for (const char* part : {"engine", "question", "fault", "shapes", "blame", "degeneracy", "magnitude"})
      key += (key.empty() ? "" : ".") + f[part].get<std::string>();
    findings[key] = std::move(f);
  }
  REQUIRE(findings.size() == count);
  summary["findings"] = std::move(findings);
  fs::create_directories(to.parent_path());
  std::ofstream(to) << summary.dump();
}

}  // namespace

TEST_CASE("the pages have a row for every kind of shape", "[pages]") {
  const std::string table = read_all(fs::path(TS_SOURCE_DIR) / "reports/web/src/case/shapes.ts");
  for (int k = 0; k < touchstone::shape_kind_count; ++k) {
    const std::string name(type_name(static_cast<touchstone::ShapeKind>(k)));
    INFO(name);
    CHECK(table.find("\n  " + name + ": {\n") != std::string::npos);
  }
}

TEST_CASE("pages load, show the numbers of their JSON, draw, move and link in a browser",
          "[pages][optional]") {
  if (const std::string missing = missing_for_browser(); !missing.empty())
    return touchstone::test::skip("missing: " + missing);
  const Workspace w("pages");
  const std::string engines = " --engines core,fcl-libccd,libccd-mpr";
  const std::string few = fs::exists(TS_BINARY_DIR "/lib/libtouchstone_fcl.so") &&
                                  fs::exists(TS_BINARY_DIR "/lib/libtouchstone_libccd.so")
                              ? engines
                              : " --engines core,core-f32";
  for (const std::string& line :
       {"view " TS_SOURCE_DIR "/scenarios/corpus/drake-1668-cubes-corner-overlap.json -o case.html" + few,
        "view bullet_through_thin_wall -o motion.html" + few,
        "view rods_crossed_apart -o separate.html" + few, "view spheres_kiss -o touching.html" + few,
        "view cylinder_in_box -o curved.html" + few, "view mesh_cut_by_box -o mesh.html" + few,
        "view swap_places -o script.html" + few,
        std::string("view thousand_balls -o crowd.html --engines core"),
        std::string("view swap_places --broad -o broad.html --json > broad.json"),
        std::string("plan ball_into_the_ground --rounds 1 --judged 8 --page plan.html"),
        "stability --quick --ladder gap --out ." + few,
        "chart --quick --measure 0 --broad grid,brute_force --out ." + few}) {
    const auto r = w.touchstone(line);
    INFO(line << "\n" << r.err);
    REQUIRE(r.code <= 1);  // 1: some engine is wrong
  }
  CHECK(w.touchstone("fuzz --cases 200 --seed 7 --relations 0 --out run --subject core" + few).code == 0);
  REQUIRE(w.touchstone("report run -o report.html").code == 0);
  many_findings(w.dir / "run/summary.json", w.dir / "many/summary.json", 100000);
  REQUIRE(w.touchstone("report many -o many.html").code == 0);
  CHECK(w.touchstone("certify --subject grid --limit 60 --page certified.html").code == 0);
  CHECK(w.touchstone(
             "certify --subject " TS_BINARY_DIR
             "/lib/libtouchstone_mutants.so:stale_after_move --level boxes --without no_boxes --limit 2000 "
             "-o refuted.json --page refuted.html")
            .code == 1);
  CHECK(w.touchstone(
             "plan 'ball_into_the_ground' --steps 9 --error 1e-3 --verdict-only --rounds 1 --judged 8 -o "
             "again.json --page again.html")
            .code == 0);
  CHECK(
      read_all(w.dir / "again.html")
          .find("plan ball_into_the_ground --error 1e-3 --verdict-only --steps 9 --rounds 1 --judged 8\"") !=
      std::string::npos);
  REQUIRE(w.touchstone("open .").code == 0);
  const std::string pictures = pictures_directory();
  const auto node =
      w.run("node " TS_BINARY_DIR "/web/test/pages.mjs /usr/bin/chromium " + w.dir.string() + " " + pictures);
  std::cout << figures_of(node.out) << "screenshots: " << pictures << "\n";
  INFO(node.out << node.err);
  CHECK(node.code == 0);
  CHECK(node.out.find("all checks hold") != std::string::npos);
  for (const char* name : {"case-1280", "motion-390-dark", "report-print", "curved-contact"})
    CHECK(fs::file_size(fs::path(pictures) / (std::string(name) + ".png")) > 5000);
}

TEST_CASE("the page of causes shows, filters and hands out its causes in a browser", "[pages][optional]") {
  if (const std::string missing = missing_for_browser(); !missing.empty())
    return touchstone::test::skip("missing: " + missing);
  const Workspace w("causes");
  const std::string shell = read_all(built / "causes.html");
  const auto write = [&](const char* name, const touchstone::fuzz::Causes& c) {
    using namespace touchstone;
    w.write(name, reports::web_page(shell, json_text(reports::causes_page(c))));
  };
  write("causes.html", touchstone::test::sample_causes());
  write("causes-many.html", touchstone::test::many_causes(60));
  write("causes-hostile.html", touchstone::test::hostile_causes());
  const auto node = w.run("node " TS_BINARY_DIR "/web/test/causes.mjs /usr/bin/chromium " + w.dir.string() +
                          " " + pictures_directory());
  std::cout << figures_of(node.out);
  INFO(node.out << node.err);
  CHECK(node.code == 0);
  CHECK(node.out.find("all checks hold") != std::string::npos);
}

TEST_CASE("the page of assess shows the robot and what engines get wrong, in a browser",
          "[pages][optional]") {
  if (const std::string missing = missing_for_browser(); !missing.empty())
    return touchstone::test::skip("missing: " + missing);
  const Workspace w("assess");
  const std::string files = TS_SOURCE_DIR "/tests/scenarios/import/files/";
  const std::string command = "assess " + files + "cell/arm7.urdf --srdf " + files +
                              "cell/arm7.srdf --package-path " + files + " --world " + files +
                              "cell/table15.scene ";
  const auto wrong = w.touchstone(
      command + "--samples 40 --page assess.html --subject core --engines core,core-f32," TS_BINARY_DIR
                "/lib/libtouchstone_mutants.so:overlap_one_order_denied," TS_BINARY_DIR
                "/lib/libtouchstone_mutants.so:overlap_spheres");
  INFO(wrong.err);
  REQUIRE(wrong.code == 0);
  REQUIRE(w.touchstone(command + "--samples 3 --page clean.html --engines core").code == 0);
  const auto replayed = w.touchstone("replay assess.case.json --engines core --json");
  CHECK(replayed.code == 0);
  const auto node = w.run("node " TS_BINARY_DIR "/web/test/assess.mjs /usr/bin/chromium " + w.dir.string() +
                          " " + pictures_directory());
  INFO(node.out << node.err);
  CHECK(node.code == 0);
  CHECK(node.out.find("all checks hold") != std::string::npos);
}

TEST_CASE("the pages can be built and tested with Debian 12's Node 18 and npm 9", "[pages]") {
  const fs::path web = TS_SOURCE_DIR "/reports/web";
  // npm 9 cannot read an alias ("npm:…") among overrides: npm ci ends with "Invalid comparator".
  CHECK_FALSE(touchstone::test::parsed<Json>(read_all(web / "package.json")).contains("overrides"));
  int asked = 0;
  const Json lock = touchstone::test::parsed<Json>(read_all(web / "package-lock.json"));
  for (const auto& [name, package] : lock["packages"].items()) {
    if (package.value("optional", false) || !package.contains("engines")) continue;
    const std::string node = package["engines"].value("node", ">=18");
    // The first number after an operator is the lowest version.
    static const std::regex lower_bound(R"((>=|\^)\s*(\d+))");
    bool runs = false;
    for (std::sregex_iterator m(node.begin(), node.end(), lower_bound), end; m != end; ++m)
      runs |= (*m)[1] == "^" ? (*m)[2] == "18" : std::stoi((*m)[2]) <= 18;
    INFO(name << " wants node " << node);
    CHECK(runs);
    ++asked;
  }
  CHECK(asked >= 5);
}

TEST_CASE("without built pages the data is kept and one line names what is missing", "[pages][cli]") {
  const Workspace w("nopages");
  fs::create_directories(w.dir / "bin");
  fs::create_symlink(TS_BINARY_DIR "/lib", w.dir / "lib");
  fs::copy_file(TS_BINARY_DIR "/bin/touchstone", w.dir / "bin/touchstone");
  const auto alone = w.run("bin/touchstone view spheres_kiss --engines core -o page.html");
  CHECK(alone.code == 2);
  CHECK(alone.err.find("touchstone-host: is missing") != std::string::npos);
  fs::create_symlink(TS_BINARY_DIR "/bin/touchstone-host", w.dir / "bin/touchstone-host");
  const auto r = w.run("bin/touchstone view spheres_kiss --engines core -o page.html");
  CHECK(r.code == 3);
  CHECK(r.err.find("./touchstone pages --install") != std::string::npos);
  CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(w.dir / "page.html"));
  const Json j = touchstone::test::parsed<Json>(read_all(w.dir / "page.html.json"));
  CHECK(j["queries"].size() == 3);
  CHECK(j["queries"][2]["engines"]["core"]["right"] == true);
  const auto b = w.run("bin/touchstone view swap_places --broad --json -o broad.html");
  CHECK(b.code == 3);
  CHECK(b.err.find("./touchstone pages --install") != std::string::npos);
  CHECK_FALSE(fs::exists(w.dir / "broad.html"));
  CHECK(touchstone::test::parsed<Json>(read_all(w.dir / "broad.json")) ==
        touchstone::test::parsed<Json>(b.out));  // nothing is rounded
  // The record beside a page has the page's name.
  CHECK(w.run("bin/touchstone fuzz --cases 64 --relations 0 --subject core --engines core,core-f32 --out run")
            .code == 0);
  CHECK(w.run("bin/touchstone causes run --page run/causes.html").code == 3);
  CHECK(fs::exists(w.dir / "run/causes.html.json"));
  CHECK(w.run("bin/touchstone causes run").code == 0);
  const auto s = w.run("bin/touchstone stability --quick --ladder angle --engines core --out s");
  CHECK(s.code == 0);
  CHECK(fs::exists(w.dir / "s/stability.json"));
  CHECK_FALSE(fs::exists(w.dir / "s/stability.html"));
}

TEST_CASE("findings are packed without loss, including words and the numbers of the key", "[pages]") {
  using touchstone::fuzz::Json;
  using namespace touchstone::reports;
  std::string numbers;
  const std::string text = template_of("says -2.5e-05 in [-inf, 3.]; 2^20, e17 x_9 1e 12", numbers);
  CHECK(numbers == "-2.5e-05 3 2 20 1 12");
  CHECK(std::count(text.begin(), text.end(), number_mark) == 6);
  const auto finding = [](const char* engine, const char* words, const Json& worst) {
    return Json{{"engine", engine},    {"question", "contact"}, {"fault", "missed"},    {"shapes", "box-box"},
                {"blame", "none"},     {"degeneracy", "solid"}, {"magnitude", "small"}, {"count", 3},
                {"worst_in_l", worst}, {"words", words}};
  };
  const Json j = findings_columns(
      {{"b", finding("fcl", "off by 0.25", 0.123456)}, {"a", finding("core", "off by 7", "inf")}});
  CHECK(j["count"] == 2);
  CHECK(j["coded"]["engine"]["values"] == Json({"core", "fcl"}));
  CHECK(j["coded"]["engine"]["codes"] == Json({1, 0}));
  CHECK(j["worst_in_l"] == Json({0.123, "inf"}));
  CHECK(j["words"]["templates"].size() == 1);
  CHECK(j["words"]["numbers"] == "0.25 7");
}

TEST_CASE("long data is stored in a page compressed and decompresses to the same bytes", "[pages]") {
  using namespace touchstone::reports;
  const std::string shell = "<script>__TOUCHSTONE_DATA__</script>";
  CHECK(web_page(shell, R"(["<b>"])") == "<script>[\"\\u003cb>\"]</script>");
  std::string json = "[0";
  for (int i = 1; json.size() < compressed_from; ++i) json += "," + std::to_string(i * 7919 % 10007);
  json += "]";
  for (int cut = 0; cut < 3; ++cut) {  // most likely every remainder of base64's three bytes
    const std::string page = web_page(shell, json);
    CHECK(page.size() < json.size());
    CHECK(page.rfind("<script>{\"deflate\":\"", 0) == 0);
    const std::string packed = touchstone::test::parsed<Json>(deflated(json))["deflate"];
    CHECK(packed.size() % 4 == 0);
    CHECK(inflated(packed) == json);
    json.insert(1, "1,");
  }
  CHECK_THROWS(web_page("no place", "{}"));
}

TEST_CASE("the data of a page is read back as it was, and damaged data is refused", "[pages]") {
  using namespace touchstone;
  using namespace touchstone::reports;
  const std::string shell =
      "<div></div><script id=\"data\" "
      "type=\"application/json\">__TOUCHSTONE_DATA__</script><script></script>";
  std::string json = "[0";
  for (int i = 1; json.size() < compressed_from; ++i) json += "," + std::to_string(i * 7919 % 10007);
  json += "]";
  for (int cut = 0; cut < 3; ++cut) {
    CHECK(data_of_page(web_page(shell, json), "x").value() == json);
    json.insert(1, "1,");
  }
  CHECK(touchstone::test::parsed<Json>(data_of_page(web_page(shell, R"(["</script>"])"), "x").value())[0] ==
        "</script>");
  CHECK_FALSE(data_of_page("<html></html>", "x").has_value());
  const std::string page = web_page(shell, json);
  CHECK_THROWS_AS(data_of_page(page, "x", json.size() - 1), InputError);
  CHECK_THROWS_AS(data_of_page(page.substr(0, page.size() / 2), "x"), InputError);
  const std::size_t at = page.find("deflate") + 100;
  for (const char* wrong : {"!", "AAAAAAAA", "="}) {
    std::string damaged = page;
    damaged.replace(at, std::string(wrong).size(), wrong);
    CHECK_THROWS_AS(data_of_page(damaged, "x"), InputError);
  }
}

TEST_CASE("report refuses a directory that is not a campaign", "[pages][cli]") {
  const Workspace w("noreport");
  CHECK(w.touchstone("report .").code == 2);
  w.write("summary.json", "{}");
  const auto r = w.touchstone("report .");
  CHECK(r.code == 2);
  CHECK(r.err.find("summary.json") != std::string::npos);
  w.write("summary.json", "no JSON");
  CHECK(w.touchstone("report .").code == 2);
}
