// The GitHub action: its file is well formed, and its last step runs as a runner would run it.
#include <filesystem>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/python.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using touchstone::test::has_command;
using touchstone::test::Run;
using touchstone::test::Workspace;
namespace fs = std::filesystem;

namespace {

// Writes the step's script to step.sh after checking what a runner asks of the file.
constexpr const char* extract = R"(
import sys, yaml
action = yaml.safe_load(open(sys.argv[1]))
assert action['runs']['using'] == 'composite'
steps = action['runs']['steps']
for step in steps:
    assert 'uses' in step or step['shell'] == 'bash'
    for text in step.get('env', {}).values():
        assert text[len('${{ inputs.'):-len(' }}')] in action['inputs'], text
assert '${{' not in ''.join(s.get('run', '') for s in steps)
open('step.sh', 'w').write(steps[-1]['run'])
)";

struct Step {
  Workspace w{"action"};
  Run prepare() {
    fs::create_directory(w.dir / "action");
    fs::create_symlink(TS_BINARY_DIR "/bin/touchstone", w.dir / "action/touchstone");
    return w.run("python3 " + w.write("extract.py", extract).string() + " " TS_SOURCE_DIR "/action.yml");
  }
  Run run(const std::string& command, const std::string& plugin, const std::string& arguments) {
    return w.run("COMMAND='" + command + "' PLUGIN='" + plugin + "' ARGUMENTS='" + arguments +
                 "' RESULTS=results GITHUB_STEP_SUMMARY=summary.md GITHUB_ACTION_PATH=$PWD/action bash "
                 "--noprofile --norc -eo pipefail step.sh");
  }
};

}  // namespace

TEST_CASE("the action certifies a broad phase, fuzzes an engine, and refuses other commands",
          "[packages][optional]") {
  if (!touchstone::test::has_python_with("yaml") || !has_command("bash"))
    return touchstone::test::skip("python3-yaml or bash is not installed");
  Step step;
  const Run prepared = step.prepare();
  INFO(prepared.err);
  REQUIRE(prepared.code == 0);

  const Run certified =
      step.run("certify", TS_BINARY_DIR "/lib/libtouchstone_example_broad.so", "--limit 40");
  INFO(certified.out << certified.err);
  CHECK(certified.code == 0);
  CHECK(fs::exists(step.w.dir / "results/certificate.json"));
  CHECK(touchstone::test::read_all(step.w.dir / "summary.md").find("certified") != std::string::npos);

  const Run fuzzed = step.run("fuzz", TS_BINARY_DIR "/lib/libtouchstone_example.so", "--cases 60");
  INFO(fuzzed.out << fuzzed.err);
  CHECK(fuzzed.code == 0);
  CHECK(fuzzed.out.find("exit code 0 is about") != std::string::npos);
  CHECK(fs::exists(step.w.dir / "results/campaign"));

  // Words of the arguments are words of the command, and nothing else of them is run.
  const Run hostile =
      step.run("fuzz", TS_BINARY_DIR "/lib/libtouchstone_example.so", "--cases 1; touch injected");
  CHECK(hostile.code == 2);
  CHECK_FALSE(fs::exists(step.w.dir / "injected"));

  CHECK(step.run("erase", "core", "").code == 2);
  CHECK(step.run("certify", "./absent.so", "").code == 2);
}
