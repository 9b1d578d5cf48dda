// The ledger remembers findings, and triage tells new, known and gone ones apart.
#include "fuzz/triage/triage.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/base/input_error.h"
#include "reports/text/record_text.h"
#include "scenarios/codec/case_codec.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::fuzz;
namespace fs = std::filesystem;

namespace {

struct Place {
  fs::path dir = fs::temp_directory_path() / ("touchstone-triage-" + std::to_string(getpid()));
  fs::path ledger = dir / "findings.db";
  Place() {
    fs::remove_all(dir);
    fs::create_directories(dir);
  }
  ~Place() { fs::remove_all(dir); }
};

StoredFinding finding(const std::string& engine, const std::string& fault) {
  StoredFinding s;
  s.finding.engine = engine;
  s.finding.fault = fault;
  s.finding.question = "contact";
  s.finding.shapes = "box-box";
  s.finding.blame = "algorithm";
  s.finding.degeneracy = "solid";
  s.finding.magnitude = "gross";
  s.finding.count = 3;
  s.finding.words = "it is <wrong> & \"off\"";
  s.c.scene.shapes = {Sphere{1}};
  s.c.scene.bodies.resize(2);
  s.c.queries = {{Question::contact, 0, 1}};
  return s;
}

// An engine that shows a fixed set of keys in every case.
struct Fake {
  std::set<std::string> shows;
  std::set<std::string> here{"one", "two"};
  int asked = 0, shrunk = 0;
  TriageConfig config(const std::string& date) {
    TriageConfig c;
    c.date = date;
    c.build_of = [this](const std::string& e) { return here.contains(e) ? "Lib 1" : std::string(); };
    c.ask = [this](const std::string&, const Case&) {
      ++asked;
      std::map<std::string, Finding> r;
      for (const auto& key : shows) r[key] = {};
      return r;
    };
    c.smallest = [this](const std::string&, const std::string&, Case c2) {
      ++shrunk;
      c2.scene.name = "small";
      return c2;
    };
    return c;
  }
};

KnownFinding row_of(const std::string& engine) {
  const Finding f = finding(engine, "depth_off").finding;
  KnownFinding known;
  known.key = f.key();
  known.engine = f.engine;
  known.question = f.question;
  known.fault = f.fault;
  known.shapes = f.shapes;
  known.blame = f.blame;
  known.degeneracy = f.degeneracy;
  known.magnitude = f.magnitude;
  return known;
}

std::map<std::string, Standing> by_fault(const std::vector<Triaged>& all) {
  std::map<std::string, Standing> r;
  for (const auto& t : all) r[t.finding.engine + " " + t.finding.fault] = t.standing;
  return r;
}

}  // namespace

TEST_CASE("a finding is new once, then known, still present, gone, and back", "[triage]") {
  const Place place;
  const auto missed = finding("one", "missed"), ghost = finding("two", "ghost");
  Fake fake;
  const auto night = [&](const std::vector<StoredFinding>& found, const std::string& date) {
    Ledger ledger(place.ledger);
    const auto r = triage(found, ledger, fake.config(date));
    ledger.commit();
    return by_fault(r);
  };
  using S = std::map<std::string, Standing>;
  CHECK(night({missed, ghost}, "d1") == S{{"one missed", Standing::fresh}, {"two ghost", Standing::fresh}});
  CHECK(fake.shrunk == 2);
  CHECK(night({missed, ghost}, "d2") == S{{"one missed", Standing::known}, {"two ghost", Standing::known}});
  CHECK(fake.shrunk == 2);
  CHECK(fake.asked == 0);
  fake.shows = {missed.finding.key()};
  CHECK(night({}, "d3") == S{{"one missed", Standing::still}, {"two ghost", Standing::gone}});
  CHECK(fake.asked == 1 + asks_before_gone);
  CHECK(night({}, "d4") == S{{"one missed", Standing::still}});
  CHECK(night({ghost}, "d5") == S{{"one missed", Standing::still}, {"two ghost", Standing::back}});
  fake.here.erase("one");
  CHECK(night({ghost}, "d6") == S{{"one missed", Standing::not_asked}, {"two ghost", Standing::known}});
  const Ledger ledger(place.ledger);
  const auto m = ledger.find(missed.finding.key()), g = ledger.find(ghost.finding.key());
  REQUIRE(m.has_value());
  REQUIRE(g.has_value());
  CHECK(m->first_seen == "d1");
  CHECK(m->last_seen == "d5");
  CHECK(m->count == 6);
  CHECK(m->first_build == "Lib 1");
  CHECK(g->first_seen == "d1");
  CHECK(g->last_seen == "d6");
  CHECK(g->expired.empty());
  CHECK(case_from_json(nlohmann::ordered_json::parse(m->smallest)).scene.name == "small");
}

TEST_CASE("a finding that shows only sometimes is flaky, not gone", "[triage]") {
  const Place place;
  const auto missed = finding("one", "missed");
  Fake fake;
  const auto night = [&](const std::vector<StoredFinding>& found, int shows_at) {
    TriageConfig c = fake.config("d");
    int asked = 0;
    c.ask = [&](const std::string&, const Case&) {
      std::map<std::string, Finding> r;
      if (++asked == shows_at) r[missed.finding.key()] = {};
      return r;
    };
    Ledger ledger(place.ledger);
    const auto r = triage(found, ledger, c);
    ledger.commit();
    return r.at(0);
  };
  night({missed}, 0);
  const Triaged flaky = night({}, 3);
  CHECK(flaky.standing == Standing::flaky);
  CHECK(flaky.shown == 1);
  CHECK(flaky.asked == asks_before_gone);
  CHECK(flaky.finding.expired.empty());
  CHECK(reports::triage_text({flaky}).find("shown in 1 of 5 runs") != std::string::npos);
  CHECK(night({}, 1).standing == Standing::still);
  CHECK(night({}, 0).standing == Standing::gone);
}

TEST_CASE("a finding that cannot be shrunk or asked does not affect the others", "[triage]") {
  const Place place;
  Fake fake;
  const auto with_trouble = [&](const std::vector<StoredFinding>& found) {
    TriageConfig c = fake.config("d");
    const auto fail_for_one = [](const std::string& engine) {
      if (engine == "one") throw std::runtime_error("its worker does not start");
    };
    c.smallest = [=](const std::string& engine, const std::string&, const Case& as_found) {
      fail_for_one(engine);
      return as_found;
    };
    c.ask = [=](const std::string& engine, const Case&) {
      fail_for_one(engine);
      return std::map<std::string, Finding>();
    };
    Ledger ledger(place.ledger);
    const auto r = triage(found, ledger, c);
    ledger.commit();
    return r;
  };
  const auto first = with_trouble({finding("one", "missed"), finding("two", "ghost")});
  REQUIRE(first.size() == 2);
  CHECK(first[0].standing == Standing::fresh);
  CHECK(first[0].trouble.find("its worker does not start") != std::string::npos);
  CHECK(first[1].trouble.empty());
  const auto second = with_trouble({});
  REQUIRE(second.size() == 2);
  CHECK(second[0].standing == Standing::not_asked);
  CHECK(!second[0].trouble.empty());
  CHECK(second[1].standing == Standing::gone);
  CHECK(Ledger(place.ledger).find(second[0].finding.key)->expired.empty());
}

TEST_CASE("uncommitted findings are not in the ledger", "[triage]") {
  const Place place;
  const KnownFinding f = row_of("a");
  {
    Ledger ledger(place.ledger);
    ledger.put(f);
  }
  CHECK(Ledger(place.ledger).all().empty());
  {
    Ledger ledger(place.ledger);
    ledger.put(f);
    ledger.commit();
  }
  CHECK(Ledger(place.ledger).all() == std::vector<KnownFinding>{f});
}

TEST_CASE("two runs that write at the same time both succeed", "[triage]") {
  const Place place;
  const auto write = [&](const std::string& prefix) {
    for (int i = 0; i < 20; ++i) {
      Ledger ledger(place.ledger);
      ledger.put(row_of(prefix + std::to_string(i)));
      ledger.commit();
    }
  };
  std::thread other([&] { write("x"); });
  write("y");
  other.join();
  CHECK(Ledger(place.ledger).all().size() == 40);
}

TEST_CASE("a file that is not a ledger is refused by name and left unchanged", "[triage]") {
  const Place place;
  std::ofstream(place.ledger) << "this is a text, and long enough that nobody takes it for an empty database";
  const auto size = fs::file_size(place.ledger);
  try {
    const Ledger ledger(place.ledger);
    FAIL("it was taken for a ledger");
  } catch (const InputError& e) {
    CHECK(std::string(e.what()).find("findings.db") != std::string::npos);
  }
  CHECK(fs::file_size(place.ledger) == size);
  CHECK_THROWS_AS(Ledger(place.dir / "absent" / "x.db"), InputError);
  CHECK_THROWS_AS(load_findings(place.dir), InputError);
}

TEST_CASE("the report for continuous integration is well-formed and its counts are right", "[triage]") {
  std::vector<Triaged> all(3);
  all[0].finding.key = "one.a";
  all[0].finding.engine = "one";
  all[0].finding.words = "x < y & \"z\"";
  all[0].finding.smallest = "{}";
  all[1] = all[2] = all[0];
  all[1].standing = Standing::still;
  all[2].standing = Standing::gone;
  const std::string xml = reports::triage_junit(all);
  CHECK(xml.find("tests=\"3\" failures=\"1\" skipped=\"1\"") != std::string::npos);
  CHECK(xml.find("x &lt; y &amp; &quot;z&quot;") != std::string::npos);
  CHECK(reports::triage_json(all).size() == 3);
  CHECK(reports::triage_text(all).find("1 new, 0 back") != std::string::npos);
}
