// The ledger remembers causes, and triage tells new, known and gone ones apart.
#include "fuzz/triage/triage.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/base/input_error.h"
#include "fuzz/triage/cause_files.h"
#include "reports/record/stored.h"
#include "reports/text/record_text.h"
#include "scenarios/codec/case_codec.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"

using namespace touchstone;
using namespace touchstone::fuzz;
namespace fs = std::filesystem;

namespace {

struct Place {
  fs::path dir = fs::temp_directory_path() / ("touchstone-triage-" + std::to_string(getpid()));
  fs::path ledger = dir / "causes.db";
  Place() {
    fs::remove_all(dir);
    fs::create_directories(dir);
  }
  ~Place() { fs::remove_all(dir); }
};

Json spheres(const std::string& name) {
  Case c;
  c.scene.name = name;
  c.scene.shapes = {Sphere{1}};
  c.scene.bodies.resize(2);
  c.queries = {{Question::contact, 0, 1}};
  return case_to_json(c);
}

std::string key_of(const std::string& engine, const std::string& fault,
                   const std::string& magnitude = "gross") {
  return engine + ".contact." + fault + ".box-box.algorithm.solid." + magnitude;
}

Cause cause(const std::string& engine, const std::string& fault) {
  Cause c;
  c.id = engine + "-" + fault;
  c.path = engine;
  c.library = "Lib 1";
  c.title = "it is <wrong> & \"off\"";
  c.severity = Severity::not_minimal;
  c.wrong = 3;
  c.engines = {engine};
  c.shapes = {"box-box"};
  c.smallest.engine = engine;
  c.smallest.key = key_of(engine, fault);
  c.smallest.c = spheres("small");
  c.smallest.words = "too deep by 0.1";
  c.smallest.size = {2, 0, 20};
  return c;
}

Cause with_shapes(Cause c, std::vector<std::string> shapes) {
  c.shapes = std::move(shapes);
  return c;
}

// An engine that shows a fixed set of keys in every case.
struct Fake {
  std::set<std::string> shows;
  std::set<std::string> here{"one", "two"};
  int asked = 0;
  TriageConfig config(const std::string& date) {
    TriageConfig c;
    c.date = date;
    c.build_of = [this](const std::string& e) { return here.contains(e) ? "Lib 2" : std::string(); };
    c.ask = [this](const std::string& engine, const Case&) {
      ++asked;
      std::map<std::string, Finding> r;
      for (const auto& key : shows)
        if (const auto f = finding_of_key(engine, key)) r[key] = *f;
      return r;
    };
    return c;
  }
};

// Runs a night and commits it.
std::vector<Triaged> night(const Place& place, const std::vector<Cause>& found, const TriageConfig& config) {
  Ledger ledger(place.ledger);
  const auto r = triage(found, ledger, config);
  ledger.commit();
  return r;
}

std::map<std::string, Standing> standings(const std::vector<Triaged>& all) {
  std::map<std::string, Standing> r;
  for (const auto& t : all) r[t.cause.id] = t.standing;
  return r;
}
using S = std::map<std::string, Standing>;

KnownCause row_of(const std::string& id) {
  KnownCause k;
  k.id = id;
  k.engine = "e";
  k.key = key_of("e", "depth_off");
  k.shown = "{}";
  return k;
}

}  // namespace

TEST_CASE("a cause is new once, then known, still present, gone, and back", "[triage]") {
  const Place place;
  const Cause missed = cause("one", "missed"), ghost = cause("two", "ghost");
  Fake fake;
  const auto on = [&](const std::vector<Cause>& found, const std::string& date) {
    return standings(night(place, found, fake.config(date)));
  };
  CHECK(on({missed, ghost}, "d1") == S{{"one-missed", Standing::fresh}, {"two-ghost", Standing::fresh}});
  CHECK(on({missed, ghost}, "d2") == S{{"one-missed", Standing::known}, {"two-ghost", Standing::known}});
  CHECK(fake.asked == 0);
  fake.shows = {missed.smallest.key};
  CHECK(on({}, "d3") == S{{"one-missed", Standing::still}, {"two-ghost", Standing::gone}});
  CHECK(fake.asked == 1 + asks_before_gone);
  CHECK(on({}, "d4") == S{{"one-missed", Standing::still}});
  CHECK(on({ghost}, "d5") == S{{"one-missed", Standing::still}, {"two-ghost", Standing::back}});
  fake.here.erase("one");
  CHECK(on({ghost}, "d6") == S{{"one-missed", Standing::not_asked}, {"two-ghost", Standing::known}});
  const Ledger ledger(place.ledger);
  const auto m = ledger.find("one-missed"), g = ledger.find("two-ghost");
  REQUIRE(m.has_value());
  REQUIRE(g.has_value());
  CHECK(m->first_seen == "d1");
  CHECK(m->last_seen == "d5");
  CHECK(m->count == 6);
  CHECK(m->first_build == "Lib 1");
  CHECK(m->last_build == "Lib 2");  // of the engine that showed it again
  CHECK(g->first_seen == "d1");
  CHECK(g->last_seen == "d6");
  CHECK(g->expired.empty());
  CHECK(case_of(*m).scene.name == "small");
}

TEST_CASE("a known cause with other kinds of shapes is changed, and names them", "[triage]") {
  const Place place;
  const Cause c = cause("one", "missed");
  Fake fake;
  night(place, {c}, fake.config("d1"));
  const auto changed =
      night(place, {with_shapes(c, {"box-box", "box-cone", "box-hull"})}, fake.config("d2")).at(0);
  CHECK(changed.standing == Standing::changed);
  CHECK(changed.new_shapes == std::vector<std::string>{"box-cone", "box-hull"});
  CHECK_FALSE(changed.counts());
  CHECK(reports::triage_text({changed}).find("not seen before: box-cone, box-hull") != std::string::npos);
  // All shapes ever seen are remembered.
  CHECK(night(place, {with_shapes(c, {"box-hull"})}, fake.config("d3")).at(0).standing == Standing::known);
  CHECK(Ledger(place.ledger).find(c.id)->shapes.size() == 3);
  // Of a failure at one place in the code, they are no news.
  Finding f = *finding_of_key("one", c.smallest.key);
  f.shapes = "any";
  Cause crash = c;
  crash.id = "one-crash";
  crash.smallest.key = f.key();
  night(place, {crash}, fake.config("d1"));
  CHECK(night(place, {with_shapes(crash, {"box-hull"})}, fake.config("d2")).at(0).standing ==
        Standing::known);
}

TEST_CASE("a smaller case replaces the one in the ledger, and so does one of a cause that is back",
          "[triage]") {
  const Place place;
  Cause c = cause("one", "missed");
  Fake fake;
  const auto stored = [&](const std::string& name, std::uint64_t bits) {
    c.smallest.c = spheres(name);
    c.smallest.size.bits = bits;
    night(place, {c}, fake.config("d"));
    return case_of(*Ledger(place.ledger).find(c.id)).scene.name;
  };
  CHECK(stored("first", 20) == "first");
  CHECK(stored("larger", 30) == "first");
  CHECK(stored("smaller", 10) == "smaller");
  CHECK(night(place, {}, fake.config("d")).at(0).standing == Standing::gone);
  CHECK(stored("of its return", 40) == "of its return");
}

TEST_CASE("a cause is shown again by the same question and kind of fault", "[triage]") {
  const auto shown = [](const std::string& stored, const std::string& now) {
    return shows_again("e", stored, {{now, finding_of_key("e", now).value()}});
  };
  CHECK(shown(key_of("e", "missed", "gross"), key_of("e", "missed", "small")));
  CHECK(shown("e.contact.missed.box-box.algorithm.solid.gross",
              "e.contact.missed.box-box.representation.flat.gross"));
  // A crash at another line.
  CHECK(shown(key_of("e", "crashed_epa-h-177"), key_of("e", "crashed_epa-h-180")));
  CHECK_FALSE(shown(key_of("e", "crashed_epa-h-177"), key_of("e", "timed_out")));
  CHECK_FALSE(shown(key_of("e", "late"), key_of("e", "early")));
  CHECK_FALSE(shown(key_of("e", "missed"), "e.overlap.missed.box-box.algorithm.solid.gross"));
  CHECK_FALSE(shows_again("e", key_of("e", "missed"), {}));
}

TEST_CASE("a cause that shows only sometimes is flaky, not gone", "[triage]") {
  const Place place;
  const Cause missed = cause("one", "missed");
  Fake fake;
  const auto shown_at = [&](const std::vector<Cause>& found, int shows_at) {
    TriageConfig c = fake.config("d");
    int asked = 0;
    c.ask = [&](const std::string&, const Case&) {
      std::map<std::string, Finding> r;
      if (++asked == shows_at) r[missed.smallest.key] = finding_of_key("one", missed.smallest.key).value();
      return r;
    };
    return night(place, found, c).at(0);
  };
  shown_at({missed}, 0);
  const Triaged flaky = shown_at({}, 3);
  CHECK(flaky.standing == Standing::flaky);
  CHECK(flaky.shown == 1);
  CHECK(flaky.asked == asks_before_gone);
  CHECK(flaky.cause.expired.empty());
  CHECK(reports::triage_text({flaky}).find("shown in 1 of 5 runs") != std::string::npos);
  CHECK(shown_at({}, 1).standing == Standing::still);
  CHECK(shown_at({}, 0).standing == Standing::gone);
}

TEST_CASE("a cause that cannot be asked again does not affect the others", "[triage]") {
  const Place place;
  Fake fake;
  Cause without_case = cause("two", "late");
  without_case.smallest = {};
  night(place, {cause("one", "missed"), cause("two", "ghost"), without_case}, fake.config("d"));
  TriageConfig c = fake.config("d");
  c.ask = [](const std::string& engine, const Case&) {
    if (engine == "one") throw std::runtime_error("its worker does not start");
    return std::map<std::string, Finding>();
  };
  const auto r = night(place, {}, c);
  REQUIRE(r.size() == 3);
  CHECK(r[0].standing == Standing::not_asked);
  CHECK(r[0].trouble.find("its worker does not start") != std::string::npos);
  CHECK(r[1].standing == Standing::gone);
  CHECK(r[2].standing == Standing::not_asked);
  CHECK(r[2].trouble.empty());
  CHECK(Ledger(place.ledger).find("one-missed")->expired.empty());
}

TEST_CASE("a suppressed cause does not count through a date; then it counts until it is decided again",
          "[triage]") {
  const Place place;
  const Cause c = cause("one", "missed");
  Fake fake;
  fake.shows = {c.smallest.key};
  const auto on = [&](const std::vector<Cause>& found, const std::string& date) {
    return night(place, found, fake.config(date)).at(0);
  };
  const auto change = [&](const auto& what) {
    Ledger ledger(place.ledger);
    what(ledger);
    ledger.commit();
  };
  CHECK(on({c}, "2026-11-01T03:00:00Z").standing == Standing::fresh);
  change([&](Ledger& l) { suppress(l, c.id, "upstream #12", "2026-11-23", "2026-11-02"); });
  const Triaged last_day = on({with_shapes(c, {"box-cone"})}, "2026-11-23T23:59:59Z");
  CHECK(last_day.standing == Standing::suppressed);
  CHECK_FALSE(last_day.counts());
  CHECK(last_day.new_shapes.size() == 1);
  CHECK(reports::triage_junit({last_day})
            .find("<skipped message=\"suppressed until 2026-11-23: upstream #12\"/>") != std::string::npos);
  CHECK(on({}, "2026-11-23").standing == Standing::suppressed);
  for (const auto& found : {std::vector{c}, std::vector<Cause>{}}) {
    const Triaged after = on(found, "2026-11-24");
    CHECK(after.suppression_ended);
    CHECK(after.counts());
    CHECK(reports::triage_text({after}).find("its suppression ended on 2026-11-23: upstream #12") !=
          std::string::npos);
    CHECK(reports::triage_junit({after}).find("failures=\"1\"") != std::string::npos);
  }
  change([&](Ledger& l) { unsuppress(l, c.id); });
  CHECK_FALSE(on({c}, "2026-11-25").counts());
  change([&](Ledger& l) { suppress(l, c.id, "again", "2026-12-31", "2026-11-25"); });
  fake.shows.clear();
  CHECK(on({}, "2026-11-26").standing == Standing::gone);  // good news is told
  CHECK(on({c}, "2026-11-27").standing == Standing::suppressed);
}

TEST_CASE("a suppression needs a known cause, a reason and a date to come", "[triage]") {
  const Place place;
  Ledger ledger(place.ledger);
  ledger.put(row_of("convex-late"));
  const auto refused = [&](const char* id, const char* reason, const char* until, const char* words) {
    try {
      suppress(ledger, id, reason, until, "2026-11-23T01:00:00Z");
      return false;
    } catch (const InputError& e) {
      return std::string(e.what()).find(words) != std::string::npos;
    }
  };
  CHECK(refused("convex-latr", "r", "2026-12-01", "did you mean convex-late?"));
  CHECK(refused("convex-late", "  ", "2026-12-01", "--reason"));
  CHECK(refused("convex-late", "r", "2026-02-29", "--until"));
  CHECK(refused("convex-late", "r", "tomorrow", "--until"));
  CHECK(refused("convex-late", "r", "2026-11-22", "has passed"));
  CHECK_THROWS_AS(unsuppress(ledger, "convex-late"), InputError);
  suppress(ledger, "convex-late", "r", "2026-11-23", "2026-11-23T01:00:00Z");
  CHECK(ledger.find("convex-late")->until == "2026-11-23");
  unsuppress(ledger, "convex-late");
  CHECK(ledger.find("convex-late") == row_of("convex-late"));
}

TEST_CASE("two causes of the same id are refused", "[triage]") {
  const Place place;
  Ledger ledger(place.ledger);
  const Cause c = cause("one", "missed");
  CHECK_THROWS_AS(triage({c, c}, ledger, Fake().config("d")), InputError);
}

TEST_CASE("uncommitted causes are not in the ledger", "[triage]") {
  const Place place;
  const KnownCause k = row_of("a");
  {
    Ledger ledger(place.ledger);
    ledger.put(k);
  }
  CHECK(Ledger(place.ledger).all().empty());
  {
    Ledger ledger(place.ledger);
    ledger.put(k);
    ledger.commit();
  }
  CHECK(Ledger(place.ledger).all() == std::vector<KnownCause>{k});
}

TEST_CASE("a row that could not be read back is not written", "[triage]") {
  const Place place;
  Ledger ledger(place.ledger);
  for (const char* id : {"", "../../victim", "A", "a.b", "-a"})
    CHECK_THROWS_AS(ledger.put(row_of(id)), InputError);
  const auto refused = [&](const auto& damage) {
    KnownCause k = row_of("a");
    damage(k);
    try {
      ledger.put(k);
      return false;
    } catch (const InputError&) {
      return true;
    }
  };
  CHECK(refused([](KnownCause& k) { k.key = key_of("other", "late"); }));
  CHECK(refused([](KnownCause& k) { k.key = "e.x/y.late.box-box.algorithm.solid.gross"; }));
  CHECK(refused([](KnownCause& k) { k.shown.clear(); }));
  CHECK(refused([](KnownCause& k) { k.engines = {"b", "a"}; }));
  CHECK(refused([](KnownCause& k) { k.shapes = {"a", "a"}; }));
  CHECK(refused([](KnownCause& k) { k.shapes = {"\x1b[2J"}; }));
  CHECK(refused([](KnownCause& k) { k.reason = "for ever"; }));
  CHECK(refused([](KnownCause& k) { k.until = "2026-11-23"; }));
  KnownCause largest = row_of("a");
  largest.count = ~std::uint64_t{0};  // more than the database can hold
  largest.title = "a\xff";
  ledger.put(largest);
  CHECK(ledger.find("a")->count == static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()));
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
    CHECK(std::string(e.what()).find("causes.db") != std::string::npos);
  }
  CHECK(fs::file_size(place.ledger) == size);
  CHECK_THROWS_AS(Ledger(place.dir / "absent" / "x.db"), InputError);
}

TEST_CASE("causes are read from a campaign's directory, and only those of its state", "[triage]") {
  const Place place;
  const auto read = [&] { return stored_causes(place.dir, "1234"); };
  const auto says = [&](const std::string& words) {
    try {
      read();
    } catch (const InputError& e) {
      INFO(e.what());
      return std::string(e.what()).find(words) != std::string::npos;
    }
    return false;
  };
  CHECK(!read());
  Causes all;
  all.digest = "1234";
  all.causes = {cause("one", "missed"), cause("two", "ghost")};
  const auto write = [&] { store_causes(place.dir, all); };
  write();
  REQUIRE(read());
  CHECK(read()->causes.size() == 2);
  all.causes[1].id = all.causes[0].id;
  write();
  CHECK(says("causes[1].id: is the id of two causes"));
  all.causes[1] = cause("two", "ghost");
  all.causes[1].smallest.key = key_of("one", "ghost");
  write();
  CHECK(says("causes[1].smallest.key: is not the key of a finding of two"));
  all.causes[1] = cause("two", "ghost");
  all.causes[1].smallest.c["scene"] = 7;
  write();
  CHECK(says("causes[1].smallest.case"));
  all.digest = "another";
  write();
  CHECK(!read());
  std::ofstream(place.dir / "causes.json") << "{";
  CHECK(says("causes.json"));
}

TEST_CASE("a cause's directory has its case, finding, certificate, issue and program", "[triage]") {
  const Place place;
  Cause c = cause("one", "missed");
  c.certificate = {{"kind", "common_point"}, {"point", {0, 0, 0}}};
  c.program = "int main() { return 1; }\n";
  const auto issue = [](const Cause& of) { return "# " + of.title + "\n"; };
  CHECK(write_cause(place.dir, c, issue) == Written::now);
  const fs::path to = place.dir / c.id;
  const auto text = [&](const char* file) {
    std::ifstream f(to / file);
    return std::string(std::istreambuf_iterator<char>(f), {});
  };
  CHECK(load_stored_case(to / "case.json").c.scene.name == "small");
  CHECK(test::parsed<Json>(text("certificate.json")) == c.certificate);
  CHECK(test::parsed<Json>(text("finding.json")).at("key") == c.smallest.key);
  CHECK(text("issue.md") == "# " + c.title + "\n");
  CHECK(text("reproduce.cpp") == c.program);
  CHECK_FALSE(fs::exists(to / "no_reproducer.txt"));
  CHECK(write_cause(place.dir, c, issue) == Written::before);
  Cause other = cause("two", "late");
  other.no_program = "its API has no such question";
  CHECK(write_cause(place.dir, other, {}) == Written::now);
  CHECK(fs::exists(place.dir / other.id / "no_reproducer.txt"));
  for (const char* absent : {"issue.md", "reproduce.cpp", "certificate.json"})
    CHECK_FALSE(fs::exists(place.dir / other.id / absent));
  other.id = "../../victim";
  CHECK_THROWS_AS(write_cause(place.dir, other, {}), InputError);
  other = cause("two", "early");
  other.smallest = {};
  CHECK(write_cause(place.dir, other, {}) == Written::no_case);
}

TEST_CASE("the report for continuous integration is well-formed and its counts are right", "[triage]") {
  std::vector<Triaged> all(3);
  all[0].cause.id = "one-a";
  all[0].cause.path = "one";
  all[0].cause.title = "x < y & \"z\"";
  all[1] = all[2] = all[0];
  all[1].standing = Standing::still;
  all[2].standing = Standing::gone;
  const std::string xml = reports::triage_junit(all);
  CHECK(xml.find("tests=\"3\" failures=\"1\" skipped=\"1\"") != std::string::npos);
  CHECK(xml.find("x &lt; y &amp; &quot;z&quot;") != std::string::npos);
  CHECK(reports::triage_json(all).size() == 3);
  CHECK(reports::triage_text(all).find("1 new, 0 back") != std::string::npos);
}
