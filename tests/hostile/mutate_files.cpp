// Damaged files of every kind that a command reads: cases, findings, states, certificates, plans, charts,
// ledgers, recordings. A reader must terminate quickly and in little memory, and give a reason for refusing
// the file; a command must end with an exit code of its contract. Most are read by the functions that
// commands use, in child processes that each try many; some by whole commands. ctest runs a few; by hand,
// many:
//   build/release/bin/mutate_files --seed 7 --count 1000000 --commands 10000 --keep out/mutants
// --originals DIR stores the good files there, or reads them if they exist: then another build, for instance
// with sanitizers, needs no program (--commands 0). --only KIND: one kind of file.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/input_error.h"
#include "core/math/rng.h"
#include "tests/hostile/file_readers.h"
#include "tests/hostile/mutation.h"
#include "tests/support/causes_by_hand.h"

namespace {

using namespace touchstone;
using namespace touchstone::test;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

#ifdef TS_ADDRESS_SANITIZER
constexpr rlim_t memory_bytes = RLIM_INFINITY;  // the sanitizer's shadow memory is terabytes of address space
#else
constexpr rlim_t memory_bytes = rlim_t{1} << 30;
#endif
constexpr rlim_t cpu_seconds = 5;

std::string read_all(const fs::path& p) {
  std::ifstream f(p, std::ios::binary);
  return {std::istreambuf_iterator<char>(f), {}};
}
void write_all(const fs::path& p, const std::string& text) { std::ofstream(p, std::ios::binary) << text; }

struct Options {
  std::uint64_t seed = 1, count = 100, commands = 100;
  std::string keep, originals, only;
};

Options options_of(int argc, char** argv) {
  const std::map<std::string, std::string> given = [&] {
    std::map<std::string, std::string> m;
    for (int i = 1; i + 1 < argc; i += 2) m[argv[i]] = argv[i + 1];
    return m;
  }();
  const auto text = [&](const char* name) { return given.contains(name) ? given.at(name) : std::string(); };
  const auto number = [&](const char* name, std::uint64_t otherwise) {
    return given.contains(name) ? std::stoull(given.at(name)) : otherwise;
  };
  Options o;
  o.seed = number("--seed", o.seed);
  o.count = number("--count", o.count);
  o.commands = number("--commands", o.commands);
  o.keep = text("--keep");
  o.originals = text("--originals");
  o.only = text("--only");
  return o;
}

// The failures, and how many mutants were tried.
struct Report {
  std::map<std::string, std::uint64_t> tried;  // by kind
  std::uint64_t refused = 0, failed = 0;
};

void complain(Report& report, const Options& o, const std::string& what, const std::string& why,
              const std::string& name, const std::string& bytes) {
  ++report.failed;
  std::printf("%s: %s\n", what.c_str(), why.c_str());
  std::fflush(stdout);
  if (!o.keep.empty()) write_all(fs::path(o.keep) / name, bytes);
}

// --- whole commands

struct Ended {
  int code = -1, signal = 0;
  std::string out, err;
};

// Runs one command in `dir` with limits.
Ended run(const fs::path& dir, const std::string& arguments) {
  const std::string line =
      "exec " TS_BINARY_DIR "/bin/touchstone " + arguments + " >out.txt 2>err.txt </dev/null";
  const pid_t pid = fork();
  if (pid == 0) {
    const rlimit cpu{cpu_seconds, cpu_seconds}, memory{memory_bytes, memory_bytes}, core{0, 0};
    setrlimit(RLIMIT_CPU, &cpu);
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &core);
    if (chdir(dir.c_str()) == 0) execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  Ended e;
  if (WIFEXITED(status)) e.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) e.signal = WTERMSIG(status);
  e.out = read_all(dir / "out.txt");
  e.err = read_all(dir / "err.txt");
  return e;
}

// Which commands read which files: files are damaged one at a time, then the commands run, each in a fresh
// copy of the originals.
struct Target {
  std::vector<std::string> files, commands;
};

const std::vector<Target>& targets() {
  static const std::vector<Target> all{
      {{"case.json", "scene.json"},
       {"replay case.json --engines core", "shrink case.json --engine core",
        "replay scene.json --engines core", "plan case.json --rounds 1 --judged 4",
        "view case.json --engines core --json", "check certificate.json --case case.json",
        "bisect bodies case.json --engine core", "reproduce case.json --engine libccd-gjk",
        "replay case.json --engines core --json"}},
      {{"certificate1.json", "pair1.json"}, {"check certificate1.json --case pair1.json"}},
      {{"certificate2.json", "pair2.json"}, {"check certificate2.json --case pair2.json"}},
      {{"impact.json", "hits.json"}, {"check impact.json --case hits.json"}},
      {{"moving.json"}, {"replay moving.json --engines core", "plan moving.json --rounds 1 --judged 4"}},
      {{"odd.json"}, {"replay odd.json --engines core"}},
      {{"finding/finding.json", "finding/case.json"},
       {"check finding/finding.json", "shrink finding", "reproduce finding",
        "replay finding --engines core"}},
      {{"campaign/state.json"}, {"merge merged campaign", "report campaign"}},
      {{"half/state.json"},
       {"fuzz --cases 32 --seed 5 --jobs 1 --relations 0 --shard 1/2 --engines core --out half",
        "merge merged campaign half"}},
      {{"kept/answers.bin", "kept/state.json"}, {"judge kept --jobs 1", "judge kept --jobs 1 --json"}},
      {{"campaign/summary.json"}, {"report campaign", "triage campaign --ledger ledger.db"}},
      {{"expected.json"},
       {"replay case.json --engines core --expected expected.json --junit j.xml",
        "replay case.json --engines core --expected expected.json --write-expected now.json --json"}},
      {{"campaign/causes.json"}, {"triage campaign --ledger ledger.db --reproducers r --junit j.xml"}},
      {{"broad.json"}, {"certify --check broad.json --jobs 1"}},
      {{"plan.json"}, {"plan case.json --use plan.json --rounds 1 --judged 4"}},
      {{"chart.json"}, {"chart --from chart.json"}},
      {{"ledger.db"},
       {"triage campaign --ledger ledger.db", "merge --ledgers sum.db ledger.db",
        "triage campaign --ledger ledger.db --json --reproducers r"}},
      {{"recording/scene.txt", "recording/frames.npy", "recording/frames.csv"},
       {"replay recording --engines core", "plan recording --rounds 1 --judged 4 --steps 2"}}};
  return all;
}

// What is wrong with how a command ended, or "".
std::string complaint(const Ended& e) {
  const auto says = [&](const char* words) { return e.err.find(words) != std::string::npos; };
  if (e.signal == SIGXCPU || e.signal == SIGKILL) return "more than 5 CPU-seconds";
  if (e.signal != 0) return "signal " + std::to_string(e.signal);
  if (e.code < 0 || e.code > 3) return "exit code " + std::to_string(e.code);
  if (says("bad_alloc")) return "more than 1 GB";
  if (says("AddressSanitizer") || says("runtime error:")) return "a sanitizer's report";
  if (e.code == 2 && e.err.empty()) return "exit code 2 without a message";
  if (e.code == 3 && says("failed:")) return "reported a failure, although the file is at fault: " + e.err;
  if (says("json.exception")) return "a library's message: " + e.err;
  for (const char c : e.out + e.err)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n') return "a control character on the terminal";
  return "";
}

void try_command(const fs::path& originals, const fs::path& dir, const Options& o, std::uint64_t index,
                 Report& report) {
  Rng rng = Rng::stream(o.seed ^ 0x636f6d6d616e6473ULL, index);
  const Target& t = targets()[index % targets().size()];
  const std::string file = t.files[rng.below(t.files.size())],
                    command = t.commands[rng.below(t.commands.size())];
  fs::remove_all(dir);
  fs::copy(originals, dir, fs::copy_options::recursive);
  const std::string bytes = mutated(original_of(read_all(originals / file)), rng);
  write_all(dir / file, bytes);
  const Ended e = run(dir, command);
  ++report.tried["whole commands"];
  report.refused += e.code == 2;
  if (const std::string why = complaint(e); !why.empty())
    complain(report, o, file + ", " + command, why, "command-" + std::to_string(index), bytes);
}

// --- readers, many mutants per child

/// A child's progress, for the parent that finds it dead.
struct Shared {
  std::atomic<std::uint64_t> next{0}, refused{0};
  char why[400] = {};  // not empty: the mutant before `next` is a failure that the child survived
};

struct Job {
  const FileReader& reader;
  const Options& options;
  fs::path originals, work;
  std::vector<Original> good{};
};

std::string mutant(const Job& job, std::uint64_t index, std::size_t& file) {
  Rng rng = Rng::stream(job.options.seed, index);
  file = rng.below(job.good.size());
  return mutated(job.good[file], rng);
}

// What is wrong with how the reader handled the file, or "".
std::string complaint_of_reader(const Job& job, const std::string& file, Shared& shared) {
  try {
    job.reader.read(job.work);
    return "";
  } catch (const InputError& e) {
    ++shared.refused;
    const std::string top = fs::path(file).begin()->string(), words = e.what();
    if (words.find(top) == std::string::npos) return "the error does not name the file: " + words;
    return e.reason().find("json.exception") == std::string::npos ? "" : "a library's message: " + words;
  } catch (const std::bad_alloc&) {
    return "more than 1 GB";
  } catch (const std::exception& e) {
    return std::string("not said to be the file's fault: ") + e.what();
  }
}

[[noreturn]] void child(const Job& job, std::uint64_t last, Shared& shared) {
  const rlimit memory{memory_bytes, memory_bytes}, core{0, 0};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &core);
  for (std::uint64_t i = shared.next; i < last; ++i) {
    std::size_t which = 0;
    const std::string bytes = mutant(job, i, which);
    const std::string& file = job.reader.files[which];
    write_all(job.work / file, bytes);
    const itimerval limit{{0, 0}, {cpu_seconds, 0}};  // CPU time: SIGPROF ends the child
    setitimer(ITIMER_PROF, &limit, nullptr);
    shared.next = i + 1;
    const std::string why = complaint_of_reader(job, file, shared);
    write_all(job.work / file, job.good[which].text);
    if (why.empty()) continue;
    std::snprintf(shared.why, sizeof shared.why, "%s", why.c_str());
    _exit(0);
  }
  _exit(0);
}

std::string how_it_ended(int status, const Shared& shared) {
  if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? shared.why : "a sanitizer's report, or an exit";
  return WTERMSIG(status) == SIGPROF ? "more than 5 CPU-seconds"
                                     : "signal " + std::to_string(WTERMSIG(status));
}

void try_reader(Job job, std::uint64_t first, std::uint64_t last, Shared& shared, Report& report) {
  for (const std::string& file : job.reader.files)
    job.good.push_back(original_of(read_all(job.originals / file)));
  shared.next = first;
  shared.refused = 0;
  while (shared.next < last) {
    fs::remove_all(job.work);
    fs::copy(job.originals, job.work, fs::copy_options::recursive);
    shared.why[0] = 0;
    const pid_t pid = fork();
    if (pid == 0) child(job, last, shared);
    int status = 0;
    waitpid(pid, &status, 0);
    const std::string why = how_it_ended(status, shared);
    if (why.empty()) continue;
    std::size_t which = 0;
    const std::string bytes = mutant(job, shared.next - 1, which);
    const std::string number = std::to_string(shared.next - 1);
    complain(report, job.options, job.reader.kind + ", " + job.reader.files[which] + ", mutant " + number,
             why, "reader-" + number, bytes);
  }
  report.tried[job.reader.kind] += last - first;
  report.refused += shared.refused;
}

// --- good files

// Files that the program creates itself. False if one of them is missing.
bool make_campaigns(const fs::path& dir) {
  const std::string liar = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:depth_halved";
  const std::string lies = "--subject " + liar + " --engines " + liar + " --relations 0 --jobs 1 --seed 5 ";
  const std::pair<std::string, const char*> made[] = {
      {"fuzz --cases 24 --out campaign " + lies, "campaign/summary.json"},
      {"fuzz --cases 32 --shard 1/2 --out half --engines core --relations 0 --jobs 1 --seed 5",
       "half/state.json"},
      {"fuzz --cases 16 --keep-answers --out kept --engines core --relations 4 --jobs 1 --seed 5",
       "kept/answers.bin"},
      {"certify --subject sort_and_sweep --limit 2 --jobs 1 -o broad.json", "broad.json"}};
  for (const auto& [command, file] : made) {
    const Ended e = run(dir, command);
    if (fs::exists(dir / file)) continue;
    std::fprintf(stderr, "%s did not create %s: %s\n", command.c_str(), file, e.err.c_str());
    return false;
  }
  return true;
}

bool make_originals(const fs::path& dir) {
  write_plain_originals(dir);
  if (!make_campaigns(dir)) return false;
  std::vector<fs::path> findings;
  for (const auto& entry : fs::directory_iterator(dir / "campaign/findings"))
    findings.push_back(entry.path());
  std::sort(findings.begin(), findings.end());
  fs::copy(findings.front(), dir / "finding", fs::copy_options::recursive);
  write_causes_by_hand(dir / "campaign");
  run(dir, "triage campaign --ledger ledger.db");
  for (std::size_t i = 1; i < findings.size(); ++i) fs::remove_all(findings[i]);
  fs::rename(findings.front(), dir / "campaign/findings/one");
  fs::copy(dir / "finding/case.json", dir / "case.json");
  write_all(dir / "certificate.json",
            Json::parse(read_all(dir / "finding/finding.json"))["certificate"].dump());
  Json half = Json::parse(read_all(dir / "half/state.json"));
  half["finished"] = false;
  half["next_chunk"] = 0;
  write_all(dir / "half/state.json", half.dump());
  write_all(dir / "half.settings", half["settings"].dump());
  run(dir, "plan case.json --rounds 1 --judged 4 -o plan.json");
  return true;
}

// The first missing file of all readers, or "".
std::string missing(const fs::path& dir) {
  for (const FileReader& r : file_readers())
    for (const std::string& file : r.files)
      if (!fs::exists(dir / file)) return file;
  return "";
}

// Good files must be accepted; otherwise every mutant would be refused and nothing would be tested.
bool all_are_good(const fs::path& originals, const fs::path& work) {
  for (const FileReader& r : file_readers()) try {
      fs::remove_all(work);
      fs::copy(originals, work, fs::copy_options::recursive);
      r.read(work);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s: the good file is refused: %s\n", r.kind.c_str(), e.what());
      return false;
    }
  return true;
}

void say(const Report& report, const Options& o, double seconds) {
  std::uint64_t all = 0;
  for (const auto& [kind, n] : report.tried) {
    std::printf("%10llu %s\n", static_cast<unsigned long long>(n), kind.c_str());
    all += n;
  }
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  std::printf("%llu mutants, %llu refused, %llu failed, seed %llu, %.0f s, %.0f CPU-s, at most %ld MB\n",
              static_cast<unsigned long long>(all), static_cast<unsigned long long>(report.refused),
              static_cast<unsigned long long>(report.failed), static_cast<unsigned long long>(o.seed),
              seconds, static_cast<double>(children.ru_utime.tv_sec + children.ru_stime.tv_sec),
              children.ru_maxrss >> 10);
}

void try_all(const Options& o, const fs::path& originals, const fs::path& work, Report& report) {
  void* page = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) std::abort();
  auto& shared = *new (page) Shared;
  const auto& readers = file_readers();
  for (std::size_t k = 0; k < readers.size(); ++k)
    if (o.only.empty() || o.only == readers[k].kind)
      try_reader({readers[k], o, originals, work}, o.count * k / readers.size(),
                 o.count * (k + 1) / readers.size(), shared, report);
  for (std::uint64_t i = 0; i < o.commands; ++i) try_command(originals, work, o, i, report);
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = options_of(argc, argv);
  const auto start = std::chrono::steady_clock::now();
  if (!o.keep.empty()) fs::create_directories(o.keep);
  // In memory if possible: a mutant is one or two files.
  const fs::path memory = "/dev/shm",
                 base = access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path();
  const fs::path top = base / ("touchstone-mutate-" + std::to_string(getpid()));
  const fs::path originals = o.originals.empty() ? top / "originals" : fs::path(o.originals);
  fs::create_directories(top);
  bool good = fs::exists(originals);
  if (!good) {
    fs::create_directories(originals);
    good = make_originals(originals);
  }
  if (const std::string file = good ? missing(originals) : ""; !file.empty()) {
    std::fprintf(stderr, "%s was not created\n", file.c_str());
    good = false;
  }
  good = good && all_are_good(originals, top / "m");
  Report report;
  if (good) try_all(o, originals, top / "m", report);
  fs::remove_all(top);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  say(report, o, seconds.count());
  return good && report.failed == 0 ? 0 : 1;
}
