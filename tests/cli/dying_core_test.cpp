// The program with a core that dies (tests/oracles/bad/dying_core.cpp): every command continues and reports
// it.
#include <filesystem>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/causes_by_hand.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

/// The program as installed except for its core, with its libraries beside it.
Workspace with_dying_core() {
  Workspace w("dying");
  fs::create_directories(w.dir / "bin");
  fs::create_directories(w.dir / "lib");
  for (const char* program : {"touchstone", "touchstone-host"})
    fs::copy_file(fs::path(TS_BINARY_DIR "/bin") / program, w.dir / "bin" / program);
  fs::copy_file(TS_BINARY_DIR "/lib/libts_dying_core.so", w.dir / "lib/libtouchstone_core.so");
  return w;
}

const std::string dies = "TS_DYING_CORE=segv TS_DEADLY=3 bin/touchstone ";
const std::string site = "libtouchstone_core:touchstone::dies_in_the_core";

std::string nothing_found(const fs::path& campaign) {
  auto all = causes_by_hand(campaign);
  all.causes.clear();
  return touchstone::fuzz::to_json(all).dump();
}

bool says(const Run& r, const std::string& words) { return (r.out + r.err).find(words) != std::string::npos; }

}  // namespace

TEST_CASE("a campaign survives a core that dies; triage and replay query it again", "[cli][dying]") {
  const Workspace w = with_dying_core();
  const std::string fuzz = dies + "fuzz --cases 32 --seed 3 --engines core,core-kept --subject core ";
  for (const std::string jobs : {"1", "2"}) {
    const Run r = w.run(fuzz + "--jobs " + jobs + " --out with" + jobs);
    INFO(r.out << r.err);
    CHECK(r.code == 1);
    CHECK(says(r, site));
    CHECK(says(r, "32 cases;"));
  }
  CHECK(w.run("diff -r with1/findings with2/findings").code == 0);
  write_causes_by_hand(w.dir / "with1");
  const Run triage = w.run(dies + "triage with1 --ledger ledger.db");
  INFO(triage.out << triage.err);
  CHECK(says(triage, "crashed at " + site));
  CHECK(says(triage, " new, 0 back"));
  // Without causes of its own, a later run asks for the crash again.
  w.write("with2/causes.json", nothing_found(w.dir / "with2"));
  const Run later = w.run(dies + "triage with2 --ledger ledger.db");
  INFO(later.out << later.err);
  CHECK(later.code != 2);
  CHECK(says(later, "0 new, 0 back"));
  CHECK(says(later, " 0 gone"));
  const Run replay =
      w.run(dies + "replay with1/findings/core.contact.crashed_* --engines core --subject core");
  INFO(replay.out << replay.err);
  CHECK(replay.code == 1);
  CHECK(says(replay, "(touchstone::dies_in_the_core)"));
}

TEST_CASE("a broad phase of the core that dies is refuted, and the other evidence is gathered",
          "[cli][dying]") {
  const Workspace w = with_dying_core();
  const Run r =
      w.run("TS_DYING_CORE=segv TS_DEADLY=197 bin/touchstone certify --subject grid --limit 50 --json");
  INFO(r.err);
  CHECK(r.code == 1);
  CHECK(says(r, "\"crashed\""));
  CHECK(says(r, "\"grounded\""));  // the last piece of evidence
}

TEST_CASE("stability and chart continue when the core dies", "[cli][dying]") {
  const Workspace w = with_dying_core();
  const std::string seldom = "TS_DYING_CORE=segv TS_DEADLY=97 bin/touchstone ";
  const Run stability = w.run(seldom + "stability --quick --ladder angle --engines core --out s");
  INFO(stability.out << stability.err);
  CHECK(stability.code == 1);
  CHECK(says(stability, "it fails on"));
  const Run chart = w.run(seldom + "chart --quick --engines core --broad grid --measure 0 --out c");
  INFO(chart.out << chart.err);
  CHECK(chart.code == 1);
  CHECK(says(chart, " failed of "));
}
