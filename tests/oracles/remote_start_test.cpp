// Plug-ins that cannot be used at all: one InputError with place and reason.
#include "core/base/input_error.h"
#include "oracles/abi/protocol.h"
#include "tests/oracles/remote_fixture.h"
#include "tests/support/catch.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using namespace touchstone::testing;

namespace {

/// The message of the InputError, or "" without one.
template <class F>
std::string input_error_of(F&& f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

std::string start(const std::string& target, const std::string& engine = "") {
  return input_error_of([&] { RemoteEngine e({host_path(), plugin_path(target), engine, short_limits()}); });
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("an unusable plug-in is an input error that names file and reason",
          "[oracles][remote][bad-input]") {
  struct Row {
    const char *target, *engine, *reason;
  };
  for (const Row& row : {Row{"ts_absent", "", "there is no such plug-in file"},
                         Row{"ts_bad_abi", "", "uses ABI version 43; this host loads 1 to 2"},
                         Row{"ts_bad_symbol", "", "exports no touchstone_plugin_v1"},
                         Row{"ts_bad_source", "", "was built from other sources (0123456789abcdef) than"},
                         Row{"ts_bad_native_source", "", "was built from other sources (0123456789abcdef)"},
                         Row{"ts_bad_start", "", "died while loading it: SIGABRT: bad: cannot live here"},
                         Row{"ts_bad_card", "", "the engine card is not JSON"},
                         Row{"ts_bad_behaviours", "virtue", "offers no engine 'virtue', only: good, loops"},
                         Row{"ts_bad_behaviours", "", "offers several engines; name one of: good, loops"}}) {
    const std::string message = start(row.target, row.engine);
    INFO("message: " << message);
    CHECK(contains(message, row.reason));
    CHECK(contains(message, std::string("lib") + row.target + ".so"));
  }
}

TEST_CASE("a file that is not a shared object, a directory and a missing host are input errors",
          "[oracles][remote][bad-input]") {
  const std::filesystem::path text = std::filesystem::path(TS_SOURCE_DIR) / "CMakeLists.txt";
  CHECK(contains(input_error_of([&] { RemoteEngine e({host_path(), text, "", {}}); }), "CMakeLists.txt"));
  CHECK(contains(input_error_of([&] {
                   RemoteEngine e({host_path(), TS_SOURCE_DIR, "", {}});
                 }),
                 "no such plug-in file"));
  const auto missing = input_error_of([&] {
    RemoteEngine e({"/nonexistent/host", plugin_path("ts_plain_c"), "", {}});
  });
  CHECK(contains(missing, "/nonexistent/host"));
  CHECK(contains(missing, "cannot be started"));
}

TEST_CASE("a host built from other sources is refused", "[oracles][remote][bad-input]") {
  const test::Workspace w("other-host");
  const auto start_with = [&](const std::string& hello) {
    w.write("hello", hello);
    w.write("host", "#!/bin/sh\nexec cat " + (w.dir / "hello").string() + "\n");
    std::filesystem::permissions(w.dir / "host", std::filesystem::perms::owner_all);
    return input_error_of([&] { RemoteEngine e({w.dir / "host", plugin_path("ts_plain_c"), "", {}}); });
  };
  protocol::Hello hello{{"{}"}, 0, "", "none", false, "0123456789abcdef"};
  std::string bytes;
  protocol::append(bytes, hello);
  const std::string refused = start_with(bytes);
  INFO(refused);
  CHECK(contains(refused,
                 "touchstone-host: was built from other sources (0123456789abcdef) than this program ("));
  ++bytes[4];  // the version of the protocol
  CHECK(contains(start_with(bytes), "not a hello of this build: a different protocol version"));
}

TEST_CASE("a plug-in's engines are listed by its worker, not by the harness", "[oracles][remote]") {
  const auto cards = list_plugin_engines(host_path(), plugin_path("ts_bad_behaviours"));
  REQUIRE(cards.size() == 32);
  CHECK(cards[0].name == "good");
  CHECK(cards[1].name == "loops");
  CHECK(contains(input_error_of([] { list_plugin_engines(host_path(), plugin_path("ts_bad_start")); }),
                 "SIGABRT"));
}

TEST_CASE("a plug-in in plain C answers", "[oracles][remote]") {
  RemoteEngine engine({host_path(), plugin_path("ts_plain_c"), "", {}});
  CHECK(engine.card().name == "plain-c");
  Case c = make_case(0, false);
  c.scene.bodies[2].pose.translation = Vec3(5, 0, 0);
  c.queries.push_back({Question::candidates, 0, 0});
  const auto results = engine.run(std::span(&c, 1));
  CHECK(results[0].answers[0].overlap == true);
  CHECK(results[0].answers[1].overlap == false);
  CHECK(results[0].answers[2].outcome == Outcome::unsupported);
  CHECK(results[0].answers[3].outcome == Outcome::unsupported);
  CHECK_FALSE(results[0].received.bodies[0]);
}

TEST_CASE("an engine whose card does not list a newer kind of shape is not sent it", "[oracles][remote]") {
  RemoteEngine engine({host_path(), plugin_path("ts_plain_c"), "", {}});
  Case c = make_case(0, false);
  c.scene.shapes.push_back(RoundedBox{{1, 1, 1}, 0.5});
  c.scene.bodies[2].shape = 1;
  const auto results = engine.run(std::span(&c, 1));
  REQUIRE(results[0].answers.size() == c.queries.size());
  for (const Observation& o : results[0].answers) {
    CHECK(o.outcome == Outcome::unsupported);
    CHECK(o.detail == "more_shapes of its card does not list rounded_box");
  }
  // The next scene is answered as before.
  const Case plain = make_case(0, false);
  CHECK(engine.run(std::span(&plain, 1))[0].answers[0].overlap == true);
}
