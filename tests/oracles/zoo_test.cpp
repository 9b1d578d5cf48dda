// Every animal of the zoo (tests/zoo): its outcome is reported correctly, the other answers are unchanged,
// and nothing is left behind: no process, no file, no change, no connection.
#include <arpa/inet.h>
#include <dirent.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>
#include <thread>

#include "core/base/input_error.h"
#include "tests/oracles/remote_fixture.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::testing;

namespace {

namespace fs = std::filesystem;

struct Row {
  const char* animal;
  Outcome outcome;
  const char* detail;  // what the detail must contain
};
constexpr Outcome fine = Outcome::answered, crashed = Outcome::crashed, late = Outcome::timed_out,
                  threw = Outcome::threw, nonsense = Outcome::invalid_answer;

// AddressSanitizer reports these deaths itself, in its own words, or needs the memory that they take.
#ifdef TS_ADDRESS_SANITIZER
const std::set<std::string_view> not_under_sanitizers{"writes_to_null", "frees_twice", "asks_for_all_memory",
                                                      "leaves_fifty_children"};
#else
const std::set<std::string_view> not_under_sanitizers;
#endif

std::vector<Row> runnable(std::vector<Row> rows) {
  std::erase_if(rows, [](const Row& r) { return not_under_sanitizers.contains(r.animal); });
  return rows;
}

// They cost one answer of a case; the others are unaffected.
const std::vector<Row> of_one_question = runnable({{"aborts", crashed, "SIGABRT"},
                                       {"aborts_in_latin1", crashed, "SIGABRT"},
                                       {"aborts_with_control_characters", crashed, "SIGABRT"},
                                       {"aborts_after_a_megabyte", crashed, "the end"},
                                       {"writes_to_null", crashed, "SIGSEGV"},
                                       {"dies_of_bus", crashed, "SIGBUS"},
                                       {"dies_of_fpe", crashed, "SIGFPE"},
                                       {"traps", crashed, "SIG"},
                                       {"dies_of_kill", crashed, "SIGKILL"},
                                       {"dies_of_term", crashed, "SIGTERM"},
                                       {"dies_of_pipe", crashed, "SIGPIPE"},
                                       {"dies_of_alarm", crashed, "SIGALRM"},
                                       {"dies_of_user_signal", crashed, "SIGUSR1"},
                                       {"dies_of_hangup", crashed, "SIGHUP"},
                                       {"exits_0", crashed, "exit code 0"},
                                       {"exits_3", crashed, "exit code 3"},
                                       {"exits_quickly", crashed, "exit code 4"},
                                       {"exits_at_once", crashed, "exit code 5"},
                                       {"throws", threw, "no such luck"},
                                       {"throws_bad_alloc", threw, "bad_alloc"},
                                       {"throws_int", threw, "other than a std::exception"},
                                       {"throws_text", threw, "other than a std::exception"},
                                       {"throws_latin1", threw, "Gr"},
                                       {"throws_through_noexcept", crashed, "SIGABRT"},
                                       {"terminates", crashed, "SIGABRT"},
                                       {"overflows_the_stack", crashed, ""},
                                       {"frees_twice", crashed, "SIGABRT"},
                                       {"frees_the_host's_memory", crashed, ""},
                                       {"loops", late, "CPU time"},
                                       {"loops_in_signal_handler", late, "CPU time"},
                                       {"loops_deaf", late, "CPU time"},
                                       {"sleeps", late, "uses no CPU"},
                                       {"pauses", late, "uses no CPU"},
                                       {"reads_its_input_for_ever", late, "uses no CPU"},
                                       {"stops_itself", late, "stopped by a signal"},
                                       {"stops_its_parent", crashed, "SIGKILL"},
                                       {"kills_its_parent", crashed, "SIGKILL"},
                                       {"kills_its_group", crashed, "SIGKILL"},
                                       {"kills_everybody", crashed, ""},
                                       {"closes_all", crashed, "closed its answer stream"},
                                       {"closes_all_and_goes_on", crashed, ""},
                                       {"sprays_rubbish", crashed, "rubbish"},
                                       {"sprays_zeros", crashed, "rubbish"},
                                       {"sprays_a_hello", crashed, "rubbish"},
                                       {"sprays_an_answer", crashed, "rubbish"},
                                       {"sprays_an_unknown_type", crashed, "rubbish"},
                                       {"crashes_in_a_thread", crashed, "SIGABRT"},
                                       {"good", fine, ""},
                                       {"outcome_77", nonsense, "outcome that does not exist"},
                                       {"outcome_minus_1", nonsense, "outcome that does not exist"},
                                       {"outcome_crashed", nonsense, "outcome that does not exist"},
                                       {"outcome_not_asked", nonsense, "outcome that does not exist"},
                                       {"contact_of_a_stranger", nonsense, "bodies that do not exist"},
                                       {"contact_of_a_negative_body", nonsense, "bodies that do not exist"},
                                       {"contact_with_itself", nonsense, "bodies that do not exist"},
                                       {"pair_of_strangers", nonsense, "does not exist"},
                                       {"pair_in_a_step_of_its_own", nonsense, "does not exist"},
                                       {"pair_in_step_minus_1", nonsense, "does not exist"},
                                       {"pair_of_the_largest_numbers", nonsense, "does not exist"},
                                       {"a_million_points", fine, ""},
                                       {"nan_everywhere", fine, ""},
                                       {"infinity_everywhere", fine, ""},
                                       {"minus_infinity_everywhere", fine, ""},
                                       {"denormals_everywhere", fine, ""},
                                       {"largest_everywhere", fine, ""},
                                       {"unknown_bits", fine, ""},
                                       {"overlap_17", fine, ""},
                                       {"claims_nan", fine, ""},
                                       {"claims_less_than_nothing", fine, ""},
                                       {"claims_infinity", fine, ""},
                                       {"detail_without_end", fine, "ddd"},
                                       {"detail_in_latin1", fine, "Gr"},
                                       {"detail_of_controls", fine, ""},
                                       {"prints_megabytes", fine, ""},
                                       {"leaves_a_thread", fine, ""},
                                       {"leaves_fifty_threads", fine, ""},
                                       {"flushes_to_zero", fine, ""},
                                       {"rounds_up", fine, ""},
                                       {"reaps_all_children", fine, ""},
                                       {"blocks_all_signals", fine, ""},
                                       {"rings_every_millisecond", fine, ""},
                                       {"forgets_the_environment", fine, ""},
                                       {"speaks_with_decimal_commas", fine, ""},
                                       {"makes_files_for_nobody", fine, ""},
                                       {"is_nice", fine, ""},
                                       {"wants_core_files", fine, ""},
                                       {"closes_its_standard_streams", fine, ""},
                                       {"makes_a_file", fine, ""},
                                       {"changes_a_file", fine, ""},
                                       {"empties_a_file", fine, ""},
                                       {"removes_a_file", fine, ""},
                                       {"renames_a_file", fine, ""},
                                       {"opens_a_file_to_all", fine, ""},
                                       {"makes_a_directory", fine, ""},
                                       {"makes_a_link", fine, ""},
                                       {"makes_a_fifo", fine, ""},
                                       {"removes_the_working_directory", fine, ""},
                                       {"writes_its_scratch", fine, ""},
                                       {"fills_its_scratch", fine, ""},
                                       {"goes_to_the_root", fine, ""},
                                       {"remounts", fine, ""},
                                       {"connects_by_tcp", fine, ""},
                                       {"connects_by_name", fine, ""},
                                       {"follows_its_parent", fine, ""},
                                       {"leaves_a_child", fine, ""},
                                       {"leaves_fifty_children", fine, ""},
                                       {"leaves_a_daemon", fine, ""},
                                       {"leaves_a_deaf_daemon", fine, ""},
                                       {"leaves_a_daemon_and_dies", crashed, "SIGABRT"},
                                       {"leaves_a_command", fine, ""},
                                       {"eats_memory", crashed, "memory limit"},
                                       {"eats_memory_in_a_child", crashed, "memory limit"},
                                       {"leaves_descriptors", fine, ""},
                                       {"asks_for_all_memory", threw, "other than a std::exception"},
                                       {"receives_nan", fine, ""},
                                       {"receives_a_million_times", fine, ""},
                                       {"scribbles_on_the_scene", fine, ""}});

// They cost all answers of the case, because the scene was not accepted.
const std::vector<Row> of_one_scene = runnable({{"load_aborts", crashed, "SIGABRT"},
                                    {"load_throws", threw, "not today"},
                                    {"load_exits", crashed, "exit code 9"},
                                    {"load_loops", late, "CPU time while loading the scene"},
                                    {"load_sleeps", late, "uses no CPU"},
                                    {"load_stops", late, "stopped by a signal while loading"},
                                    {"load_eats_memory", crashed, "memory limit"},
                                    {"load_outcome_99", nonsense, "outcome that does not exist"},
                                    {"load_outcome_threw", threw, ""},
                                    {"load_detail_in_latin1", Outcome::invalid_input, "Gr"},
                                    {"receives_strangers", nonsense, "that the scene does not have"},
                                    {"receives_negative_shapes", nonsense, "that the scene does not have"}});

// They cost nothing, or the first answer of the scene that follows.
const std::vector<Row> of_the_next_scene{
    {"unload_throws", fine, ""},           {"unload_leaves_a_daemon", fine, ""},
    {"load_leaves_a_daemon", fine, ""},    {"create_leaves_a_daemon", fine, ""},
    {"unload_aborts", crashed, "SIGABRT"}, {"unload_exits", crashed, "exit code 9"},
    {"unload_loops", late, "CPU time"},    {"unload_sleeps", late, "uses no CPU"},
    {"unload_stops", late, "stopped"},     {"unload_eats_memory", crashed, "memory limit"}};

// They do not become engines.
const std::vector<Row> of_the_start = runnable({{"create_aborts", crashed, "died while loading it: SIGABRT"},
                                    {"create_throws", crashed, "not today"},
                                    {"create_exits", crashed, "exit code 9"},
                                    {"create_loops", crashed, "CPU time while starting"},
                                    {"create_sleeps", crashed, "uses no CPU: wall time while starting"},
                                    {"create_stops", crashed, "stopped by a signal while starting"},
                                    {"create_eats_memory", crashed, "memory limit"},
                                    {"creates_nothing", crashed, "created no engine"}});
const std::vector<Row> of_the_loading = runnable({{"aborts", crashed, "died while loading it: SIGABRT"},
                                      {"throws", crashed, "not today"},
                                      {"exits", crashed, "exit code 9"},
                                      {"loops", crashed, "CPU time while starting"},
                                      {"sleeps", crashed, "uses no CPU: wall time while starting"},
                                      {"stops", crashed, "wall time while starting"},
                                      {"eats_memory", crashed, "memory limit"}});

const std::vector<Row> of_pipes = runnable({{"good", fine, ""},
                                {"slow_bytes", fine, ""},
                                {"leaves_a_child", fine, ""},
                                {"prints_to_stderr", fine, ""},
                                {"cut_utf8", crashed, "not a JSON object"},
                                {"garbage", crashed, "not a JSON object"},
                                {"bad_utf8", crashed, "not a JSON object"},
                                {"line_without_end", crashed, "memory limit"},
                                {"no_newline", late, "uses no CPU"},
                                {"closes_its_output", crashed, "closed its output"},
                                {"wrong_types", crashed, "does not have the required form"},
                                {"short_vector", crashed, "does not have the required form"},
                                {"number_too_large", crashed, ""},
                                {"unknown_outcome", crashed, "an unknown outcome"},
                                {"outcome_crashed", crashed, "an unknown outcome"},
                                {"a_list", crashed, "not a JSON object"},
                                {"nothing", crashed, "not a JSON object"},
                                {"twice", crashed, "more than one line"},
                                {"left_over_bytes", crashed, "more than one line"},
                                {"deep", crashed, ""},
                                {"deep_objects", crashed, ""},
                                {"nulls", crashed, "not a JSON object"},
                                {"pair_of_strangers", nonsense, "does not exist"},
                                {"pairs_of_text", crashed, "does not have the required form"},
                                {"contact_of_strangers", nonsense, "bodies that do not exist"},
                                {"huge_indices", nonsense, "does not exist"},
                                {"exits", crashed, "exit code 0"},
                                {"exits_7", crashed, "exit code 7"},
                                {"aborts_in_latin1", crashed, ""},
                                {"kills_itself", crashed, "signal 9"},
                                {"stops_itself", late, "uses no CPU"},
                                {"stops_its_parent", late, ""},
                                {"kills_its_parent", crashed, "SIGKILL"},
                                {"spams", crashed, "more than one line"}});
const std::vector<Row> of_pipe_starts = runnable({{"no_card", crashed, "uses no CPU: wall time while starting"},
                                      {"garbage_card", crashed, "not a JSON object"},
                                      {"empty_card", crashed, "not a card"},
                                      {"list_card", crashed, "not a JSON object"},
                                      {"card_of_version_7", crashed, "speaks version 7"},
                                      {"card_without_end", crashed, "uses no CPU: wall time while starting"},
                                      {"card_in_latin1", crashed, "not a JSON object"},
                                      {"deep_card", crashed, ""},
                                      {"exits_at_once", crashed, "exit code 3"},
                                      {"spams_before_its_card", crashed, "not a JSON object"}});

/// A directory that must not change, with a local socket in it and a network socket, both listening.
class Outside {
 public:
  Outside() {
    char pattern[] = "/tmp/ts-zoo-XXXXXX";
    directory_ = mkdtemp(pattern);
    std::ofstream(directory_ / "file") << "as it was\n";
    mark_ = "zoo" + std::to_string(getpid());
    listen_at_a_name();
    listen_at_a_port();
    setenv("TOUCHSTONE_ZOO_VICTIM", directory_.c_str(), 1);
    setenv("TOUCHSTONE_ZOO_MARK", mark_.c_str(), 1);
  }
  ~Outside() {
    close(by_name_);
    close(by_port_);
    fs::remove_all(directory_);
    for (const char* v : {"VICTIM", "MARK", "PORT", "FENCED", "LOADING"})
      unsetenv((std::string("TOUCHSTONE_ZOO_") + v).c_str());
  }
  /// Only then may an animal send a signal to all processes that it can reach.
  void fence(const std::string& sandbox) {
    fenced_ = sandbox.find("PID namespace") != std::string::npos;
    if (fenced_) setenv("TOUCHSTONE_ZOO_FENCED", "1", 1);
    files_ = sandbox.find("files NOT") == std::string::npos;
    network_ = sandbox.find("NOT closed") == std::string::npos;
  }
  void check() {
    if (files_) CHECK(is_untouched());
    if (network_) CHECK_FALSE(was_visited());
    CHECK(nobody_left());
  }

 private:
  bool is_untouched() const {
    std::set<std::string> names;
    for (const auto& e : fs::directory_iterator(directory_)) names.insert(e.path().filename());
    std::ifstream in(directory_ / "file");
    std::string line;
    struct stat s {};
    stat((directory_ / "file").c_str(), &s);
    return names == std::set<std::string>{"file", "socket"} && std::getline(in, line) &&
           line == "as it was" && (s.st_mode & 0777) != 0777;
  }
  bool was_visited() const {
    return accept4(by_name_, nullptr, nullptr, SOCK_CLOEXEC) >= 0 ||
           accept4(by_port_, nullptr, nullptr, SOCK_CLOEXEC) >= 0;
  }
  bool is_there() const {
    for (const auto& e : fs::directory_iterator("/proc")) {
      std::ifstream in(e.path() / "comm");
      std::string name;
      if (std::getline(in, name) && name == mark_) return true;
    }
    return false;
  }
  bool nobody_left() const {
    for (int i = 0; i < 500 && is_there(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return !is_there();
  }
  void listen_at_a_name() {
    by_name_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_un at{};
    at.sun_family = AF_UNIX;
    std::snprintf(at.sun_path, sizeof at.sun_path, "%s/socket", directory_.c_str());
    REQUIRE(bind(by_name_, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0);
    REQUIRE(listen(by_name_, 8) == 0);
  }
  void listen_at_a_port() {
    by_port_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    const bool listens = bind(by_port_, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0 &&
                         listen(by_port_, 8) == 0 &&
                         getsockname(by_port_, reinterpret_cast<sockaddr*>(&at), &size) == 0;
    setenv("TOUCHSTONE_ZOO_PORT", std::to_string(listens ? ntohs(at.sin_port) : 1).c_str(), 1);
  }

  fs::path directory_;
  std::string mark_;
  bool fenced_ = false, files_ = true, network_ = true;
  int by_name_ = -1, by_port_ = -1;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

WorkerLimits zoo_limits(const Row& row) {
  WorkerLimits l = short_limits();
  const std::string name = row.animal, detail = row.detail;
  l.start_cpu_seconds = 0.5;
  l.resident_bytes = std::uint64_t{256} << 20;
  if (has(detail, "no CPU") || has(detail, "stopped") || has(name, "stops_its_parent"))
    l.blocked_seconds = 0.4;
  // The first access to a page is slow on some machines; the memory limit must be hit, not the time limit.
  if (has(name, "eats_memory") || has(name, "without_end") || has(name, "million") || has(name, "prints"))
    l.query_cpu_seconds = l.load_cpu_seconds = l.start_cpu_seconds = 60;
  return l;
}

RemoteSpec zoo_spec(const Row& row) {
  return {host_path(), plugin_path("ts_zoo"), row.animal, zoo_limits(row)};
}

RemoteSpec pipe_spec(const Row& row) {
  const fs::path program = fs::path(TS_BINARY_DIR) / "bin/ts_zoo_pipe";
  return {host_path(), "pipe:'" + program.string() + "' " + row.animal, "", zoo_limits(row)};
}

void check_answer(const Row& row, const Observation& o) {
  INFO("outcome: " << to_string(o.outcome) << ", detail: " << o.detail);
  CHECK(o.outcome == row.outcome);
  CHECK(has(o.detail, row.detail));
}

constexpr int cases = 3, bad = 1;

template <class IsGood>
void check_the_others(const std::vector<CaseObservations>& results, int first_bad, int bad_count,
                      IsGood good) {
  for (int i = 0, k = 0; i < cases; ++i)
    for (const Observation& o : results[static_cast<std::size_t>(i)].answers) {
      if (k < first_bad || k >= first_bad + bad_count) CHECK(good(o, i, k % 3));
      ++k;
    }
}

bool is_good_of_zoo(const Observation& o, int i, int k) {
  return is_good(o, i, make_case(i, false).queries[static_cast<std::size_t>(k)]);
}
bool is_good_of_pipe(const Observation& o, int, int) {
  return o.outcome == Outcome::answered && o.overlap == false && o.distance == 0.0;
}

/// A well-behaved engine, queried before and after each of the others.
class Neighbour {
 public:
  Neighbour() : engine_({host_path(), plugin_path("ts_zoo"), "good", {}}), before_(answers()) {}
  void check() { CHECK(answers() == before_); }
  std::string sandbox() const { return engine_.sandbox(); }

 private:
  std::vector<Observation> answers() {
    std::vector<Observation> all;
    for (CaseObservations& c : engine_.run(make_cases(cases, bad)))
      for (Observation& o : c.answers) all.push_back(std::move(o));
    return all;
  }
  RemoteEngine engine_;
  std::vector<Observation> before_;
};

template <class Visit>
std::size_t visit_all(const std::vector<Row>& rows, Visit visit) {
  Outside outside;
  Neighbour neighbour;
  outside.fence(neighbour.sandbox());
  for (const Row& row : rows) {
    INFO("animal " << row.animal);
    visit(row);
    outside.check();
    neighbour.check();
  }
  return rows.size();
}

std::string refusal(const RemoteSpec& spec) {
  try {
    RemoteEngine engine(spec);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("an animal of the zoo costs one answer at most", "[oracles][zoo]") {
  CHECK(visit_all(of_one_question, [](const Row& row) {
          RemoteEngine engine(zoo_spec(row));
          const auto results = engine.run(make_cases(cases, bad));
          check_answer(row, results[bad].answers[1]);
          check_the_others(results, 3 * bad + 1, 1, is_good_of_zoo);
        }) >= 100);
}

TEST_CASE("an animal that does not accept a scene costs that scene", "[oracles][zoo]") {
  visit_all(of_one_scene, [](const Row& row) {
    RemoteEngine engine(zoo_spec(row));
    const auto results = engine.run(make_cases(cases, bad));
    for (const Observation& o : results[bad].answers) check_answer(row, o);
    check_the_others(results, 3 * bad, 3, is_good_of_zoo);
  });
}

TEST_CASE("an animal that misbehaves between two scenes costs the next one at most", "[oracles][zoo]") {
  visit_all(of_the_next_scene, [](const Row& row) {
    RemoteEngine engine(zoo_spec(row));
    const auto results = engine.run(make_cases(cases, bad));
    for (const Observation& o : results[bad + 1].answers) check_answer(row, o);
    check_the_others(results, 3 * (bad + 1), 3, is_good_of_zoo);
  });
}

TEST_CASE("an animal that cannot be started is an input error with the reason", "[oracles][zoo]") {
  visit_all(of_the_start,
            [](const Row& row) { CHECK_THAT(refusal(zoo_spec(row)), Catch::Contains(row.detail)); });
  visit_all(of_the_loading, [](const Row& row) {
    setenv("TOUCHSTONE_ZOO_LOADING", row.animal, 1);
    RemoteSpec spec = zoo_spec(row);
    spec.engine = "good";
    const std::string why = refusal(spec);
    unsetenv("TOUCHSTONE_ZOO_LOADING");
    CHECK_THAT(why, Catch::Contains(row.detail));
  });
  visit_all(of_pipe_starts,
            [](const Row& row) { CHECK_THAT(refusal(pipe_spec(row)), Catch::Contains(row.detail)); });
}

TEST_CASE("a command of the zoo costs one answer at most", "[oracles][zoo]") {
  visit_all(of_pipes, [](const Row& row) {
    RemoteEngine engine(pipe_spec(row));
    const auto results = engine.run(make_cases(cases, bad));
    check_answer(row, results[bad].answers[1]);
    check_the_others(results, 3 * bad + 1, 1, is_good_of_pipe);
  });
}
