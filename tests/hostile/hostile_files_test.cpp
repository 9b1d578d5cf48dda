// Files from untrusted sources. What they name is a label: nothing in them is run, nothing is written where
// they say, no command waits for them, and the errors name them.
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "fuzz/triage/ledger.h"
#include "reports/record/causes.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using namespace touchstone::test;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

// An engine behind a pipe that refuses everything and leaves a mark that it ran.
const std::string engine_script = R"(touch "$MARK"
echo '{"touchstone_pipe": 1, "name": "NAME", "library": "l", "version": "1", "settings": "",
  "unit_roundoff": 1e-16, "tau_factor": 64, "source": ""}' | tr -d '\n'; echo
while read -r line; do
  case $line in '{"scene"'*) ;; *) echo '{"outcome": "unsupported"}';; esac
done
)";

struct Marked : Workspace {
  using Workspace::Workspace;
  bool ran() const { return fs::remove(dir / "mark"); }
  // A script with that engine name. The mark's path is absolute, so the script may run in any directory.
  void engine(const std::string& file, const std::string& name) const {
    std::string text = engine_script;
    text.replace(text.find("$MARK"), 5, (dir / "mark").string());
    text.replace(text.find("NAME"), 4, name);
    write(file, text);
  }
};

Json two_spheres() {
  Case c;
  c.scene.shapes = {Sphere{1}};
  c.scene.bodies.resize(2);
  c.queries = {{Question::overlap, 0, 1}};
  return case_to_json(c);
}

Json finding(const std::string& engine) {
  Json f = {
      {"engine", engine},     {"question", "overlap"}, {"fault", "missed"},      {"shapes", "sphere-sphere"},
      {"blame", "algorithm"}, {"degeneracy", "solid"}, {"magnitude", "gross"},   {"count", 1},
      {"worst_in_l", 1.0},    {"first_index", 0},      {"words", "it is missed"}};
  return f;
}

std::string key(const std::string& engine) {
  return engine + ".overlap.missed.sphere-sphere.algorithm.solid.gross";
}

fuzz::KnownCause ledger_row(const std::string& engine) {
  fuzz::KnownCause k;
  k.id = "one";
  k.engines = {engine};
  k.engine = engine;
  k.key = key(engine);
  k.shown = two_spheres().dump();
  return k;
}

Json empty_result() {
  return {{"cases", 1},
          {"pair_cases", 1},
          {"overlapping", 1},
          {"undecided", 0},
          {"families", Json::object()},
          {"engines", Json::object()},
          {"findings", Json::object()}};
}

std::string digest_of(const Json& result) {
  return fuzz::digest(fuzz::result_from_json(JsonReader(result, "result")));
}

// The causes of a campaign without findings, with one that the engine shows.
Json causes(const std::string& engine) {
  fuzz::Causes all;
  all.digest = digest_of(empty_result());
  fuzz::Cause c;
  c.id = "one";
  c.library = "l 1";
  c.engines = {engine};
  c.shapes = {"sphere-sphere"};
  c.smallest.engine = engine;
  c.smallest.key = key(engine);
  c.smallest.c = two_spheres();
  all.causes = {c};
  return fuzz::to_json(all);
}

Json evidence() {
  return {{"case", two_spheres()},
          {"observation", {{"outcome", "answered"}, {"overlap", false}}},
          {"certificate", {{"kind", "none"}}},
          {"received", Json::object()}};
}

Json state(Json result) {
  return {{"settings", {{"touchstone_campaign", 1}, {"shard", 0}, {"shards", 1}}},
          {"finished", true},
          {"next_chunk", 1},
          {"result", std::move(result)}};
}

// A campaign with one finding in its state, under any key.
Json state(const std::string& under, Json f) {
  Json result = empty_result();
  result["findings"][under] = std::move(f);
  return state(std::move(result));
}

void write_campaign(const Workspace& w, const std::string& engine) {
  fs::create_directories(w.dir / "out/findings/f");
  w.write("out/state.json", state(empty_result()).dump());
  w.write("out/summary.json", empty_result().dump());
  w.write("out/causes.json", causes(engine).dump());
  w.write("out/findings/f/case.json", two_spheres().dump());
  Json f = finding(engine);
  f["key"] = key(engine);
  w.write("out/findings/f/finding.json", f.dump());
}

void write_no_causes(const Workspace& w) {
  Json none = causes("core");
  none["causes"] = Json::array();
  w.write("out/causes.json", none.dump());
}

}  // namespace

TEST_CASE("a certificate's subject runs only when the command line names the same one",
          "[hostile][certify]") {
  const Marked w("hostile-certify");
  w.engine("e.sh", "stranger");
  const std::string subject = "'pipe:sh e.sh'";
  REQUIRE(w.touchstone("certify --limit 2 --jobs 1 -o c.json --subject " + subject).code != 2);
  w.ran();  // removes the mark; in a sandbox there is none
  const Run alone = w.touchstone("certify --check c.json --no-sandbox");
  INFO(alone.err);
  CHECK(alone.code == 2);
  CHECK(alone.err.find("c.json: subject: \"pipe:sh e.sh\"") != std::string::npos);
  CHECK_FALSE(w.ran());
  CHECK(w.touchstone("certify --check c.json --subject core").code == 2);
  CHECK_FALSE(w.ran());
  const Run same = w.touchstone("certify --check c.json --jobs 1 --subject " + subject);
  INFO(same.out << same.err);
  CHECK(same.out.find("valid, re-run with the same digest") != std::string::npos);
  w.ran();
  // A certificate of another build is not valid, even with a correct digest.
  w.run("cp e.sh f.sh; echo '# other' >> e.sh");
  CHECK(w.touchstone("certify --check c.json --subject " + subject).code == 1);
  CHECK_FALSE(w.ran());
}

TEST_CASE("findings, causes and ledgers name engines but never run them", "[hostile][triage]") {
  const Marked w("hostile-triage");
  w.engine("e.sh", "stranger");
  for (const char* engine :
       {"pipe:sh e.sh", "./evil.so", "pipe:touch mark", "stranger", "core,core", "all"}) {
    INFO(engine);
    write_campaign(w, engine);
    const Run r = w.touchstone("triage out --ledger l.db --no-sandbox");
    CHECK((r.code == 1 || r.code == 2));
    for (const char* command : {"replay", "shrink", "reproduce", "view", "bisect stage"})
      CHECK_FALSE(w.touchstone(std::string(command) + " out/findings/f").code == -1);
    CHECK_FALSE(w.ran());
    fs::remove(w.dir / "l.db");
  }
  write_no_causes(w);
  {
    fuzz::Ledger ledger(w.dir / "l.db");
    ledger.put(ledger_row("pipe:touch mark"));
    ledger.commit();
  }
  const Run r = w.touchstone("triage out --ledger l.db --no-sandbox");
  INFO(r.out << r.err);
  CHECK(r.code == 3);  // the campaign has queried no engine
  CHECK(r.out.find("1 not asked") != std::string::npos);
  CHECK_FALSE(w.ran());
}

TEST_CASE("a plug-in's causes are asked again when the command line names it", "[hostile][triage]") {
  const Marked w("hostile-given");
  w.engine("e.sh", "stranger");
  write_campaign(w, "stranger");
  REQUIRE(w.touchstone("triage out --ledger l.db").code == 1);
  write_no_causes(w);
  const Run without = w.touchstone("triage out --ledger l.db");
  CHECK(without.out.find("1 not asked") != std::string::npos);
  const Run r = w.touchstone("triage out --ledger l.db --engines 'pipe:sh e.sh'");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  CHECK(r.out.find("1 gone") != std::string::npos);
  const auto known = fuzz::Ledger(w.dir / "l.db").find("one");
  REQUIRE(known);
  CHECK(known->first_build == "l 1");
  CHECK_FALSE(known->expired.empty());
}

TEST_CASE("two engines of the same name are refused in one run", "[hostile]") {
  const Marked w("hostile-names");
  w.engine("core.sh", "core");
  w.engine("a.sh", "same");
  w.engine("b.sh", "same");
  for (const char* command : {"replay two_spheres.json --engines 'core,pipe:sh core.sh'",
                              "fuzz --cases 1 --out o --engines 'core,pipe:sh core.sh'",
                              "view two_spheres.json --json --engines 'pipe:sh a.sh,pipe:sh b.sh'",
                              "fuzz --cases 1 --out p --subject 'pipe:sh core.sh' --engines core"}) {
    w.write("two_spheres.json", two_spheres().dump());
    const Run r = w.touchstone(command);
    INFO(command << ": " << r.out << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("could not be told apart") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(w.dir / "o/summary.json"));
  CHECK_FALSE(fs::exists(w.dir / "p/summary.json"));
}

TEST_CASE("nothing is written to a path given by a key", "[hostile][merge]") {
  const Workspace w("hostile-merge");
  fs::create_directories(w.dir / "in");
  fs::create_directories(w.dir / "victim");
  Json f = finding("core");
  f["evidence"] = evidence();
  for (const std::string& under : {std::string("../../victim"), (w.dir / "victim").string(), key("other")}) {
    w.write("in/state.json", state(under, f).dump());
    const Run r = w.touchstone("merge out in");
    INFO(r.out << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("in/state.json: result.findings.") != std::string::npos);
    CHECK_FALSE(fs::exists(w.dir / "out"));
  }
  for (const char* engine : {"../../victim", "/tmp/x", "a\nb"}) {
    f["engine"] = engine;
    w.write("in/state.json", state(key(engine), f).dump());
    CHECK(w.touchstone("merge out in").code == 2);
    CHECK_FALSE(fs::exists(w.dir / "out"));
  }
  CHECK(fs::is_empty(w.dir / "victim"));
  f["engine"] = "core";
  w.write("in/state.json", state(key("core"), f).dump());
  CHECK(w.touchstone("merge out in").code == 0);
  CHECK(fs::exists(w.dir / "out/findings" / key("core") / "case.json"));
}

TEST_CASE("a state is read completely before anything is written", "[hostile][merge]") {
  const Workspace w("hostile-state");
  fs::create_directories(w.dir / "in");
  Json bare = finding("core"), half = bare;
  half["evidence"] = {{"case", two_spheres()}};
  for (const Json& f : {bare, half}) {
    w.write("in/state.json", state(key("core"), f).dump());
    const Run r = w.touchstone("merge out in");
    INFO(r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("in/state.json: result.findings.core.overlap") != std::string::npos);
    CHECK_FALSE(fs::exists(w.dir / "out"));
  }
}

TEST_CASE("damaged examples of a finding are refused with their place", "[hostile][merge]") {
  const Workspace w("hostile-examples");
  fs::create_directories(w.dir / "in");
  const Json good = {{"index", 3}, {"error_in_l", 0.5}, {"bodies", 2},
                     {"steps", 0}, {"bits", 4},         {"case", "a"}};
  const auto changed = [&](const char* field, const Json& to) {
    Json e = good;
    e[field] = to;
    return e;
  };
  Json bare = good;
  bare.erase("case");
  const auto merge = [&](const Json& examples, const Json& document) {
    Json f = finding("core");
    f["evidence"] = evidence();
    f["examples"] = examples;
    Json s = state(key("core"), f);
    s["result"]["documents"] = {{"a", document}};
    w.write("in/state.json", s.dump());
    return w.touchstone("merge out in");
  };
  const auto list = [](const std::vector<Json>& examples) { return Json(examples); };
  const std::pair<Json, const char*> wrong[] = {
      {Json::object(), "examples: "},
      {Json(std::vector<Json>(9, good)), "examples: "},
      {list({good, good}), "examples[1].index: "},
      {list({changed("index", 4), good}), "examples[1].index: "},
      {list({changed("index", -1)}), "examples[0].index: "},
      {list({changed("error_in_l", "nan")}), "examples[0].error_in_l: "},
      {list({changed("error_in_l", Json())}), "examples[0].error_in_l: "},
      {list({changed("bits", 0.5)}), "examples[0].bits: "},
      {list({changed("bodies", 3)}), "examples[0]: "},
      {list({changed("steps", 1)}), "examples[0]: "},
      {list({changed("case", "b")}), "examples[0].case: "},
      {list({changed("case", two_spheres())}), "examples[0].case: "},
      {list({Json(7)}), "examples[0]: "}};
  const auto refused = [&](const Run& r, const std::string& place) {
    INFO(r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("in/state.json: result." + place) != std::string::npos);
    CHECK_FALSE(fs::exists(w.dir / "out"));
  };
  for (const auto& [examples, place] : wrong)
    refused(merge(examples, two_spheres()), "findings." + key("core") + ": " + place);
  refused(merge(list({bare}), two_spheres()), "findings." + key("core") + ".examples: ");
  Json torn = two_spheres();
  torn["scene"]["bodies"][0]["shape"] = 7;
  refused(merge(list({good}), torn), "documents.a");
  refused(merge(list({good}), Json::array()), "documents.a");
  CHECK(merge(list({good}), two_spheres()).code == 0);
}

TEST_CASE("a certificate names a query of the case", "[hostile][check]") {
  const Workspace w("hostile-check");
  w.write("case.json", two_spheres().dump());
  const Json point = {{"kind", "common_point"}, {"point", {0, 0, 0}}, {"step", -5}};
  w.write("c.json", point.dump());
  const Run r = w.touchstone("check c.json");
  CHECK(r.code == 2);
  CHECK(r.err.find("c.json: step: ") != std::string::npos);
}

TEST_CASE("bytes of one engine that are not text do not prevent the other results from being written",
          "[hostile]") {
  const Marked w("hostile-utf8");
  w.engine("e.sh", "latin");
  w.run("sed -i 's/echo .{\"outcome\".*;;/printf \"caf\\\\351 \\\\033[2J\\\\n\";;/' e.sh");
  w.write("two_spheres.json", two_spheres().dump());
  const Run fuzz =
      w.touchstone("fuzz --cases 2 --jobs 1 --relations 0 --engines 'core,pipe:sh e.sh' --out o");
  INFO(fuzz.out << fuzz.err);
  CHECK(fuzz.code == 0);
  CHECK(Json::accept(read_all(w.dir / "o/summary.json")));
  const Run replay = w.touchstone("replay two_spheres.json --engines 'core,pipe:sh e.sh'");
  CHECK(replay.code == 0);
  CHECK(replay.out.find("caf\xef\xbf\xbd") != std::string::npos);
  CHECK(replay.out.find('\x1b') == std::string::npos);
  const Run view = w.touchstone("view two_spheres.json --json --engines 'core,pipe:sh e.sh'");
  CHECK(view.code == 0);
  CHECK(Json::accept(view.out));
}

TEST_CASE("names in files reach a terminal without control characters", "[hostile]") {
  const Workspace w("hostile-terminal");
  Json c = two_spheres();
  c["id"] = "a\x1b[2J\x07 b\ntouchstone: 0 wrong";
  w.write("case.json", c.dump());
  const Run good = w.touchstone("replay case.json --engines core");
  CHECK(good.code == 0);
  CHECK(good.out.find('\x1b') == std::string::npos);
  CHECK(good.out.find("\ntouchstone: 0 wrong") == std::string::npos);
  c["\x1b[2J"] = 1;
  w.write("case.json", c.dump());
  const Run bad = w.touchstone("replay case.json --engines core");
  CHECK(bad.code == 2);
  CHECK(bad.err.find('\x1b') == std::string::npos);
}

TEST_CASE("every reader of JSON has the limits of the case reader", "[hostile]") {
  const Workspace w("hostile-deep");
  const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
  fs::create_directories(w.dir / "in/findings/f");
  w.write("deep.json", deep);
  w.write("two_spheres.json", two_spheres().dump());
  for (const char* file :
       {"in/state.json", "in/summary.json", "in/causes.json", "in/findings/f/finding.json"})
    w.write(file, R"({"key": )" + deep + "}");
  w.write("in/findings/f/case.json", two_spheres().dump());
  const std::pair<const char*, const char*> commands[] = {
      {"check deep.json", "deep.json"},
      {"replay two_spheres.json --engines core --expected deep.json", "deep.json"},
      {"certify --check deep.json", "deep.json"},
      {"merge out in", "in/state.json"},
      {"report in", "in/summary.json"},
      {"fuzz --cases 1 --out in", "in/state.json"},
      {"triage in --ledger l.db", "in/summary.json"},
      {"shrink in/findings/f", "finding.json"},
      {"reproduce in/findings/f", "finding.json"},
      {"chart --from deep.json", "deep.json"},
      {"plan two_spheres.json --use deep.json", "deep.json"}};
  for (const auto& [command, place] : commands) {
    const Run r = w.touchstone(command);
    INFO(command << ": " << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find(place) != std::string::npos);
    CHECK(r.err.find("nested more than 64 levels") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(w.dir / "out"));
}

namespace {

void make_ledger(const fs::path& file) {
  fuzz::Ledger ledger(file);
  ledger.put(ledger_row("core"));
  ledger.commit();
}

// Runs SQL on a ledger, as an attacker with full access would.
void tamper(const fs::path& file, const char* sql) {
  sqlite3* db = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &db) == SQLITE_OK);
  char* error = nullptr;
  const int code = sqlite3_exec(db, sql, nullptr, nullptr, &error);
  INFO(sql << ": " << (error ? error : ""));
  sqlite3_free(error);
  sqlite3_close(db);
  REQUIRE(code == SQLITE_OK);
}

}  // namespace

TEST_CASE("a ledger is a table of causes and nothing else", "[hostile][triage]") {
  const Workspace w("hostile-ledger");
  write_campaign(w, "core");
  // An endless view in place of the table; triggers; another definition; rows of other types, ids or keys.
  for (const char* sql :
       {"DROP TABLE cause; CREATE VIEW cause AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM "
        "n) SELECT i AS id FROM n",
        "CREATE TRIGGER t AFTER INSERT ON cause BEGIN DELETE FROM cause; END",
        "CREATE TABLE other(x)",
        "CREATE INDEX other ON cause(engine)",
        "ALTER TABLE cause ADD COLUMN more TEXT",
        "UPDATE cause SET id = '../../victim'",
        "UPDATE cause SET id = '.'",
        "UPDATE cause SET id = 'A'",
        "UPDATE cause SET key = '../../victim'",
        "UPDATE cause SET engine = '../../victim'",
        "UPDATE cause SET shown = ''",
        "UPDATE cause SET severity = 'none'",
        "UPDATE cause SET engines = 'core'",
        "UPDATE cause SET engines = '[\"b\",\"a\"]'",
        "UPDATE cause SET shapes = '[1]'",
        "UPDATE cause SET shapes = '[\"a\\nb\"]'",
        "UPDATE cause SET reason = 'for ever'",
        "UPDATE cause SET until = '2026-01-01'",
        "UPDATE cause SET reason = 'r', until = 'never'",
        "UPDATE cause SET count = -1",
        "UPDATE cause SET count = 'many'",
        "UPDATE cause SET bits = 1e300",
        "UPDATE cause SET words = x'ff00'",
        "UPDATE cause SET words = CAST(x'ff' AS TEXT)",
        "UPDATE cause SET shown = NULL",
        "PRAGMA application_id = 7",
        "PRAGMA application_id = 1414745137"}) {
    INFO(sql);
    fs::remove(w.dir / "l.db");
    make_ledger(w.dir / "l.db");
    tamper(w.dir / "l.db", sql);
    const std::string before = read_all(w.dir / "l.db");
    for (const char* command : {"triage out --ledger l.db --reproducers r", "merge --ledgers sum.db l.db",
                                "triage --ledger l.db --suppress one --reason r --until 2099-01-01"}) {
      const Run r = w.touchstone(command);
      INFO(command << ": " << r.out << r.err);
      CHECK(r.code == 2);
      CHECK(r.err.find("l.db: ") != std::string::npos);
    }
    CHECK(read_all(w.dir / "l.db") == before);
  }
  CHECK_FALSE(fs::exists(w.dir / "victim"));
}

TEST_CASE("a ledger of findings, from an earlier version, is refused with what to do", "[hostile][triage]") {
  const Workspace w("hostile-old-ledger");
  write_campaign(w, "core");
  tamper(w.dir / "l.db",
         "PRAGMA application_id = 1414745137; CREATE TABLE finding(key TEXT PRIMARY KEY, engine TEXT)");
  const std::string before = read_all(w.dir / "l.db");
  for (const char* command : {"triage out --ledger l.db", "merge --ledgers sum.db l.db"}) {
    const Run r = w.touchstone(command);
    INFO(command << ": " << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("l.db: is a ledger of findings, from an earlier version") != std::string::npos);
    CHECK(r.err.find("Give --ledger another file") != std::string::npos);
  }
  CHECK(read_all(w.dir / "l.db") == before);
}

TEST_CASE("a ledger's case is read with the limits of every reader, and does not affect the others",
          "[hostile][triage]") {
  const Workspace w("hostile-case");
  write_campaign(w, "core");
  write_no_causes(w);
  for (const std::string& shown :
       {std::string(100'000, '['), std::string("{}"), std::string("\"\\ud800\"")}) {
    fs::remove(w.dir / "l.db");
    {
      fuzz::Ledger ledger(w.dir / "l.db");
      fuzz::KnownCause known = ledger_row("core");
      known.shown = shown;
      ledger.put(known);
      ledger.commit();
    }
    const Run r = w.touchstone("triage out --ledger l.db --json");
    INFO(r.out << r.err);
    CHECK(r.code == 3);
    CHECK(r.err.find("not asked: ledger, one") != std::string::npos);
    CHECK(Json::accept(r.out));
  }
}

TEST_CASE("causes.json names nothing to run and no place to write", "[hostile][triage]") {
  const Marked w("hostile-causes");
  w.engine("e.sh", "stranger");
  write_campaign(w, "core");
  const Json good = causes("core");
  const std::string triage = "triage out --ledger l.db --reproducers r";
  const auto refused = [&](const char* place, const auto& damage) {
    Json j = good;
    damage(j["causes"][0]);
    w.write("out/causes.json", j.dump());
    const Run r = w.touchstone(triage);
    INFO(r.out << r.err);
    CHECK(r.err.find(std::string("out/causes.json: causes[0]") + place) != std::string::npos);
    CHECK_FALSE(fs::exists(w.dir / "l.db"));
    CHECK(fs::is_empty(w.dir / "r"));
    return r.code == 2;
  };
  for (const char* id : {"../../victim", "/tmp/x", ".", "", "a/b", "-rf"})
    CHECK(refused(".id", [&](Json& c) { c["id"] = id; }));
  CHECK(refused(".smallest.key", [](Json& c) { c["smallest"]["key"] = "../../victim"; }));
  CHECK(refused(".smallest.key", [](Json& c) { c["smallest"]["engine"] = "pipe:sh e.sh"; }));
  CHECK(refused(".smallest.case", [](Json& c) { c["smallest"]["case"] = "x"; }));
  CHECK(refused("", [](Json& c) { c["shapes"] = {"\n"}; }));
  CHECK_FALSE(w.ran());
  w.write("out/causes.json", good.dump());
  CHECK(w.touchstone(triage).code == 1);
  CHECK(fs::exists(w.dir / "r/one/case.json"));
}

TEST_CASE("a ledger that is only read need not be writable", "[hostile][merge]") {
  const Workspace w("hostile-read-only");
  make_ledger(w.dir / "l.db");
  fs::permissions(w.dir / "l.db", fs::perms::owner_read);
  const auto written = fs::last_write_time(w.dir / "l.db");
  CHECK(w.touchstone("merge --ledgers sum.db l.db").code == 0);
  CHECK(fs::last_write_time(w.dir / "l.db") == written);
  w.write("empty.db", "");
  CHECK(w.touchstone("merge --ledgers sum.db empty.db").code == 0);
  CHECK(fs::file_size(w.dir / "empty.db") == 0);
  CHECK(fuzz::Ledger(w.dir / "sum.db").all().size() == 1);
}

// SQLite rolls a journal back when it opens the file, and then removes the file that the journal names last.
TEST_CASE("a journal beside a ledger removes no other file", "[hostile][triage]") {
  const Workspace w("hostile-journal");
  write_campaign(w, "core");
  make_ledger(w.dir / "l.db");
  const std::string victim = w.write("victim", "kept\n");
  const std::string magic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  const auto number = [](std::uint32_t n) {
    std::string four;
    for (int shift = 24; shift >= 0; shift -= 8) four += static_cast<char>(n >> shift);
    return four;
  };
  const auto pages = static_cast<std::uint32_t>(fs::file_size(w.dir / "l.db") / 4096);
  std::string journal = magic + number(0) + number(0) + number(pages) + number(512) + number(4096);
  journal.resize(512, '\0');
  std::uint32_t sum = 0;
  for (const char c : victim) sum += static_cast<std::uint32_t>(static_cast<signed char>(c));
  journal += number(0x40000000 / 4096 + 1) + victim + number(static_cast<std::uint32_t>(victim.size())) +
             number(sum) + magic;
  for (const char* command :
       {"triage out --ledger l.db", "merge --ledgers sum.db l.db", "merge --ledgers l.db l.db"}) {
    w.write("l.db-journal", journal);
    const Run r = w.touchstone(command);
    INFO(command << ": " << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("l.db-journal: ") != std::string::npos);
    CHECK(fs::exists(victim));
  }
}

TEST_CASE("nothing is written through a link at the path of a temporary file", "[hostile][merge]") {
  const Workspace w("hostile-part");
  fs::create_directories(w.dir / "in");
  fs::create_directories(w.dir / "out");
  w.write("victim", "kept\n");
  fs::create_symlink(w.dir / "victim", w.dir / "out/state.json.part");
  REQUIRE(mkfifo((w.dir / "out/summary.json.part").c_str(), 0600) == 0);
  Json f = finding("core");
  f["evidence"] = evidence();
  w.write("in/state.json", state(key("core"), f).dump());
  const Run r = w.touchstone("merge out in");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  CHECK(read_all(w.dir / "victim") == "kept\n");
  CHECK_FALSE(fs::is_symlink(w.dir / "out/state.json"));
  CHECK(fs::is_regular_file(w.dir / "out/summary.json"));
}

namespace {

// Runs the program while a writer waits for the pipe: a program that reads from it gets nothing and returns.
Run with_writer(const Workspace& w, const std::string& pipe, const std::string& arguments) {
  fs::remove(w.dir / pipe);
  REQUIRE(mkfifo((w.dir / pipe).c_str(), 0600) == 0);
  const Run r = w.run("(: > " + pipe + ") & writer=$!; " TS_BINARY_DIR "/bin/touchstone " + arguments +
                      "; code=$?; kill $writer 2>/dev/null; wait; exit $code");
  fs::remove(w.dir / pipe);
  return r;
}

}  // namespace

TEST_CASE("a pipe in place of a file is refused without waiting for it", "[hostile]") {
  const Workspace w("hostile-pipe");
  w.write("case.json", two_spheres().dump());
  w.write("plane.json", R"({"kind": "separating_plane", "direction": [1, 0, 0], "offset": 0})");
  for (const char* directory : {"s", "u", "finding", "r", "out/findings/f", "t/findings", "l"})
    fs::create_directories(w.dir / directory);
  w.write("u/summary.json", "{}");
  w.write("r/scene.txt", "");
  write_campaign(w, "core");
  w.write("t/state.json", "{}");
  w.write("t/causes.json", causes("core").dump());
  const std::pair<const char*, const char*> commands[] = {
      {"p", "replay p --engines core"},
      {"p", "shrink p"},
      {"p", "reproduce p --engine libccd-gjk"},
      {"p", "bisect bodies p --engine core"},
      {"p", "view p --engines core --json"},
      {"p", "plan p"},
      {"p", "plan case.json --use p"},
      {"p", "check p"},
      {"p", "check plane.json --case p"},
      {"p", "replay case.json --engines core --expected p"},
      {"p", "certify --check p"},
      {"p", "chart --from p"},
      {"finding/case.json", "replay finding --engines core"},
      {"out/findings/f/finding.json", "shrink out/findings/f"},
      {"out/causes.json", "triage out --ledger l.db"},
      {"t/summary.json", "triage t --ledger l.db"},
      {"l/l.db", "triage out --ledger l/l.db"},
      {"l/l.db", "merge --ledgers sum.db l/l.db"},
      {"s/state.json", "merge m s"},
      {"s/state.json", "fuzz --cases 1 --engines core --out s"},
      {"u/summary.json", "report u"},
      {"r/scene.txt", "replay r --engines core"},
      {"p.so", "replay case.json --engines ./p.so"},
      {"p.so", "certify --subject ./p.so"}};
  for (const auto& [pipe, command] : commands) {
    const Run r = with_writer(w, pipe, command);
    INFO(command << ": " << r.out << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find(std::string(pipe) + ": is a pipe, not a file") != std::string::npos);
    if (std::string(pipe).starts_with("out/")) write_campaign(w, "core");
  }
  CHECK_FALSE(fs::exists(w.dir / "m"));
}

TEST_CASE("faults that the mutator found", "[hostile]") {
  const Workspace w("hostile-found");
  // A motion that leaves the range of doubles in a few steps; the name of a recording that clears the screen.
  Json fast = two_spheres();
  fast["scene"]["bodies"][0]["motion"] = {{"linear", {1e308, 0, 0}}, {"angular", {0, 0, 0}}};
  w.write("fast.json", fast.dump());
  const Run plan = w.touchstone("plan fast.json --rounds 1 --judged 4");
  INFO(plan.err);
  CHECK(plan.code == 2);
  CHECK(plan.err.find("fast.json: bodies[0]: moves to coordinates beyond") != std::string::npos);
  // What replay reports about one file among several.
  fs::create_directories(w.dir / "r");
  w.write("r/scene.txt", "cdh-scene 1\nname small\ncounts shapes \x1b[2J\xff");
  for (const char* json : {"", " --json"}) {
    const Run replay = w.touchstone("replay r --engines core" + std::string(json));
    CHECK(replay.code == 2);
    CHECK((replay.out + replay.err).find('\x1b') == std::string::npos);
  }
  // As many unusual numbers as numbers: each was searched for among all.
  Json many = two_spheres();
  constexpr int bodies = 10'000;
  many["queries"] = {{{"question", "candidates"}}};
  for (int i = 0; i < bodies; ++i) {
    many["scene"]["bodies"][i] = {{"shape", 0}};
    many["invalid_numbers"]["/bodies/" + std::to_string(bodies - 1 - i) + "/pose/translation/0"] = "NaN";
  }
  many["invalid_numbers"]["/bodies/0/pose/translation/3"] = "NaN";
  w.write("many.json", many.dump());
  const Run odd = w.run("ulimit -t 10; " TS_BINARY_DIR "/bin/touchstone replay many.json --engines core");
  INFO(odd.err);
  CHECK(odd.code == 2);
  CHECK(odd.err.find("many.json: invalid_numbers: ") != std::string::npos);
  // Sixteen characters that the library accepted as hexadecimal, or for which it threw its own exception.
  REQUIRE(w.touchstone("certify --subject sort_and_sweep --limit 2 --jobs 1 -o c.json").code == 0);
  for (const char* digest : {"-00000000000000f", "zzzzzzzzzzzzzzzz", " 0x0000000000001"}) {
    Json j = parsed<Json>(read_all(w.dir / "c.json"));
    j["digest"] = digest;
    w.write("d.json", j.dump());
    const Run r = w.touchstone("certify --check d.json");
    INFO(r.out << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("is not 16 hexadecimal digits") != std::string::npos);
  }
}
