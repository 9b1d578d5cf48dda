// touchstone corpus, the corpus that is stored, and its runners.
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "scenarios/handmade/ladders/mechanism.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/python.h"
#include "tests/support/shared_data.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

const fs::path corpus = TS_SOURCE_DIR "/corpus";
const std::string mutants = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<Json> stored_cases() {
  std::vector<Json> all;
  for (const auto& entry : fs::directory_iterator(corpus / "cases")) {
    const Json file = parsed<Json>(read_all(entry.path()));
    for (const Json& c : file.at("cases")) all.push_back(c);
  }
  return all;
}

// Case and question to result.
using Results = std::map<std::pair<std::string, std::string>, std::string>;

Results results_of_program(const std::string& json) {
  Results r;
  const Json document = parsed<Json>(json);
  for (const Json& x : document.at(0).at("results")) r[{x.at("case"), x.at("question")}] = x.at("result");
  return r;
}

Results results_of_runner(const std::string& json) {
  Results r;
  const Json document = parsed<Json>(json);
  for (const Json& x : document) r[{x.at(0), x.at(1)}] = x.at(2);
  return r;
}

void require_equal(const Results& program, const Results& runner, const std::string& name) {
  REQUIRE(program.size() == runner.size());
  std::string different;
  for (const auto& [asked, result] : program)
    if (const auto it = runner.find(asked); it == runner.end() || it->second != result)
      different += asked.first + " " + asked.second + ": " + result + ", " + name + ": " +
                   (it == runner.end() ? "none" : it->second) + "\n";
  INFO(different);
  CHECK(different.empty());
}

// The runners and the program rule alike on the answers of an engine. Returns how many are wrong or failed.
std::size_t compare_runners(const Workspace& w, const std::string& engine) {
  INFO(engine);
  const Run run = w.touchstone("corpus run --engine " + engine + " --answers answers.jsonl --json");
  INFO(run.err);
  REQUIRE((run.code == 0 || run.code == 1));
  const Results program = results_of_program(run.out);
  const Run python = w.run("python3 " + (corpus / "run.py").string() + " answers.jsonl --json");
  INFO(python.err);
  REQUIRE(python.code == 0);
  require_equal(program, results_of_runner(python.out), "run.py");
  if (has_command("node")) {
    const Run node = w.run("node " + (corpus / "run.mjs").string() + " answers.jsonl --json");
    INFO(node.err);
    REQUIRE(node.code == 0);
    require_equal(program, results_of_runner(node.out), "run.mjs");
  }
  return static_cast<std::size_t>(std::count_if(program.begin(), program.end(), [](const auto& r) {
    return r.second == "wrong" || r.second == "failed";
  }));
}

}  // namespace

TEST_CASE("the stored corpus is large, compact and of sound mechanisms", "[cli][corpus]") {
  const std::vector<Json> cases = stored_cases();
  CHECK(cases.size() >= 500);
  std::set<std::string> mechanisms, ids;
  for (const Json& c : cases) {
    ids.insert(c.at("id"));
    mechanisms.insert(c.at("flags").at("mechanism"));
  }
  CHECK(ids.size() == cases.size());
  CHECK(mechanisms.size() >= 30);
  for (const std::string& m : mechanisms) {
    INFO(m);
    CHECK(touchstone::scenarios::mechanism_named(m) != nullptr);
  }
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(corpus))
    if (entry.is_regular_file()) bytes += entry.file_size();
  CHECK(bytes <= 3'000'000);
  for (const char* runner : {"run.py", "run.mjs"}) CHECK(lines_of(read_all(corpus / runner)).size() <= 100);
}

TEST_CASE("every known failure with two shapes is in the corpus", "[cli][corpus][data]") {
  const fs::path file = shared_data() / "../known-failures.json";
  if (!fs::exists(file)) return skip("known-failures.json is not there");
  std::set<std::string> ids;
  for (const Json& c : stored_cases()) ids.insert(c.at("id"));
  std::size_t found = 0;
  const Json known = parsed<Json>(read_all(file));
  for (const Json& e : known) {
    if (!e.contains("shape_a") || e.at("shape_a").is_null()) continue;
    INFO(e.at("id"));
    CHECK(ids.count("known/" + e.at("id").get<std::string>()) == 1);
    ++found;
  }
  CHECK(found > 50);
}

TEST_CASE("the schema of the corpus describes it", "[cli][corpus][optional]") {
  if (!has_python_with("jsonschema")) return skip("python3-jsonschema is not there");
  const Workspace w("corpus-schema");
  const auto script = w.write("validate.py", R"(
import glob, json, sys
from jsonschema import Draft202012Validator
schema = json.load(open(sys.argv[1] + '/schema.json'))
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)
files = sorted(glob.glob(sys.argv[1] + '/cases/*.json'))
assert files
for file in files:
    corpus = json.load(open(file))
    for error in validator.iter_errors(corpus):
        sys.exit('%s: %s: %s' % (file, list(error.path), error.message[:300]))
    del corpus['cases'][0]['truth']
    assert not validator.is_valid(corpus)
)");
  const Run r = w.run("python3 " + script.string() + " " + corpus.string());
  INFO(r.out << r.err);
  CHECK(r.code == 0);
}

TEST_CASE("every certificate of the stored corpus holds", "[cli][corpus]") {
  const Workspace w("corpus-check");
  const Run r = w.touchstone("corpus check");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  CHECK(r.out.find(" hold; ") != std::string::npos);
}

TEST_CASE("the checker in Python accepts the certificates of known failures", "[cli][corpus][optional]") {
  if (!has_command("python3")) return skip("python3 is not there");
  const Workspace w("corpus-second-checker");
  std::string lines;
  std::size_t count = 0;
  const Json known = parsed<Json>(read_all(corpus / "cases/known.json"));
  for (const Json& c : known.at("cases")) {
    Json scene{{"touchstone_scene", 1}, {"shapes", Json::array()}, {"bodies", Json::array()}};
    for (const char* name : {"a", "b"}) {
      Json body = c.at(name);
      scene["shapes"].push_back(body.at("shape"));
      body["shape"] = scene["bodies"].size();
      scene["bodies"].push_back(body);
    }
    for (const Json& certificate : c.at("truth").at("certificates")) {
      lines += Json{{"scene", scene}, {"certificate", certificate}}.dump() + "\n";
      ++count;
    }
  }
  w.write("certificates.jsonl", lines);
  const Run r =
      w.run("python3 " TS_SOURCE_DIR "/tests/second_checker/check_certificates.py certificates.jsonl");
  INFO(r.err);
  CHECK(r.code == 0);
  const auto said = lines_of(r.out);
  CHECK(count > 200);
  CHECK(static_cast<std::size_t>(std::count(said.begin(), said.end(), "valid")) == count);
}

TEST_CASE("a certificate or a truth that was changed is refused", "[cli][corpus]") {
  const Workspace w("corpus-changed");
  fs::create_directories(w.dir / "cases");
  const Json stored = parsed<Json>(read_all(corpus / "cases/handmade.json"));
  const auto check_with = [&](const std::function<void(Json&)>& change) {
    Json one = stored;
    const auto& cases = stored.at("cases");
    const auto at_rest = std::find_if(cases.begin(), cases.end(), [](const Json& c) {
      return c.at("truth").contains("gap") && c.at("truth").at("certificates").contains("at_least");
    });
    one["cases"] = Json::array({*at_rest});
    change(one["cases"][0]["truth"]);
    w.write("cases/one.json", one.dump());
    return w.touchstone("corpus check .").code;
  };
  CHECK(check_with([](Json&) {}) == 0);
  CHECK(check_with([](Json& t) {
          t["gap"] = {t["gap"][0].get<double>() + 1, t["gap"][1].get<double>() + 1};
        }) == 1);
  CHECK(check_with([](Json& t) {
          Json& c = t["certificates"]["at_least"]["offset"];
          c = c.get<double>() - 0.125;
        }) == 1);
  CHECK(check_with([](Json& t) { t["verdict"] = t["verdict"] == "apart" ? "overlap" : "apart"; }) == 1);
  CHECK(check_with([](Json& t) { t["certificates"]["at_least"]["kind"] = "nonsense"; }) == 2);
}

TEST_CASE("making the corpus again gives the same bytes", "[cli][corpus]") {
  const Workspace w("corpus-make");
  for (const std::string part : {"known", "handmade"}) {
    const Run r = w.touchstone("corpus make again --only " + part + "/");
    INFO(r.out << r.err);
    REQUIRE(r.code == 0);
    CHECK(read_all(w.dir / "again/cases" / (part + ".json")) ==
          read_all(corpus / "cases" / (part + ".json")));
  }
  // A part of the ladders: the same lines, for any number of threads.
  REQUIRE(w.touchstone("corpus make again --only ladders/s --jobs 3").code == 0);
  const std::vector<std::string> stored = lines_of(read_all(corpus / "cases/ladders.json"));
  std::set<std::string> known;
  for (std::string line : stored) {
    if (line.ends_with(",")) line.pop_back();
    known.insert(line);
  }
  std::size_t same = 0;
  for (std::string line : lines_of(read_all(w.dir / "again/cases/ladders.json"))) {
    if (line.ends_with(",")) line.pop_back();
    INFO(line);
    CHECK(known.count(line) == 1);
    same += line.starts_with("{\"id\"");
  }
  CHECK(same > 50);
}

TEST_CASE("the runners agree with the program case by case", "[cli][corpus][optional]") {
  if (!has_command("python3")) return skip("python3 is not there");
  const Workspace w("corpus-runners");
  CHECK(compare_runners(w, "core") == 0);
  for (const char* lie : {"normal_of_centres", "normal_not_unit", "normal_not_a_number", "depth_halved",
                          "depth_not_a_number", "distance_in_float", "distance_sign_lost",
                          "impact_late_little", "impact_early_little", "impact_denied", "impact_invented"})
    CHECK(compare_runners(w, mutants + lie) > 0);
  for (const char* engine : {"libccd-gjk", "libccd-mpr", "bullet-f64-query", "ode", "fcl-libccd-tuned"})
    if (w.touchstone("engines").out.find(std::string("\n") + engine + " ") != std::string::npos)
      CHECK(compare_runners(w, engine) > 0);
  if (!has_command("node")) skip("node is not there; only run.py was compared");
}

TEST_CASE("expected classes of verdicts are what the runner says", "[cli][corpus][optional]") {
  if (!has_command("python3")) return skip("python3 is not there");
  const Workspace w("corpus-expect");
  const auto script = w.write("expect.py", R"(
import sys
sys.path.insert(0, sys.argv[1])
import run
roundoff = {'double': 2.0**-53, 'single': 2.0**-24}
compared = 0
for case in run.cases():
    at_rest = case['questions'] != ['time_of_impact']
    for precision, u in roundoff.items():
        limits = {'tau': 64 * u * case['scale'], 'unit': 64 * u}
        classes = case['expect'][precision]
        def is_wrong(verdict):
            if at_rest:
                return run.fault(case, 'overlap', {'overlap': verdict == 'overlap'}, limits) is not None
            if verdict == 'no hit':
                return run.fault(case, 'time_of_impact', {'time_of_impact': None}, limits) is not None
            row = next(r for r in case['truth']['right_times'] if limits['tau'] <= 2.0**-r[0] * case['scale'])
            t = row[1] if len(row) > 1 else 0.5
            return run.fault(case, 'time_of_impact', {'time_of_impact': t}, limits) is not None
        for verdict, other in (sorted(classes), sorted(classes)[::-1]):
            want = 'must not' if is_wrong(verdict) else 'must' if is_wrong(other) else 'may'
            assert classes[verdict] == want, (case['id'], precision, verdict, want)
            compared += 1
assert compared > 2000, compared
)");
  const Run r = w.run("python3 " + script.string() + " " + corpus.string());
  INFO(r.out << r.err);
  CHECK(r.code == 0);
}

TEST_CASE("corpus run prints one screen and writes JUnit", "[cli][corpus]") {
  const Workspace w("corpus-run");
  const Run r =
      w.touchstone("corpus run --engine " + mutants + "depth_halved --only handmade/ --junit j.xml");
  INFO(r.out << r.err);
  CHECK(r.code == 1);
  const auto lines = lines_of(r.out);
  CHECK(lines.size() <= 45);
  CHECK(std::all_of(lines.begin(), lines.end(), [](const std::string& l) { return l.size() <= 80; }));
  CHECK(r.out.find("exit code 1 is about depth_halved") != std::string::npos);
  const std::string junit = read_all(w.dir / "j.xml");
  CHECK(junit.find("<testsuite name=\"depth_halved\"") != std::string::npos);
  CHECK(junit.find("<failure") != std::string::npos);
  CHECK(w.touchstone("corpus run --engine core --only handmade/").code == 0);
  CHECK(w.touchstone("corpus run --engine core --only nothing/").code == 2);
  CHECK(w.touchstone("corpus run nowhere --engine core").code == 2);
  CHECK(w.touchstone("corpus").code == 2);
}
