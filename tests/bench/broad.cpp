// The core's broad phases on scripts, and plain competitors, interleaved in one run (other engines are
// measured by `chart`): for each scene and size, each contestant in turn on the same frames, several rounds,
// in rotated order. The thread's CPU time covers passing the moves, the update, and the whole set of pairs.
// The pairs of three frames per cell are compared, as sets, with those of the plain grid, which shares no
// code with ours; a contestant that differs is marked and never counts as the best. With --threads N ours may
// use N threads, and all are timed by wall clock.
//   bench_broad --cells uniform/10000,mixed/ --methods touchstone,plain --rounds 3 --csv out.csv --json
//   out.json
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "core/broad/catalog.h"
#include "tests/bench/broad_scenes.h"
#include "tests/bench/broad_table.h"

namespace {

using namespace touchstone;
using namespace touchstone::bench;

using Pairs = std::vector<broad::IdPair>;

class Ours final : public Contestant {
 public:
  explicit Ours(broad::BroadPhasePtr phase) : phase_(std::move(phase)) {}
  void start(const std::vector<Aabb>& boxes) override {
    for (std::size_t i = 0; i < boxes.size(); ++i) phase_->insert(static_cast<int>(i), boxes[i]);
  }
  void frame(const std::vector<broad::BoxUpdate>& moves, Pairs& out) override {
    phase_->update(moves);
    phase_->pairs(out);
  }
  std::string note() const override { return phase_->explain(); }
  std::size_t memory_bytes() const override { return phase_->memory_bytes(); }

 private:
  broad::BroadPhasePtr phase_;
};

struct Entrant {
  std::string name;
  std::unique_ptr<Contestant> (*make_other)();
  const broad::CatalogRow* row;
  int most;  // boxes; with more, a frame takes seconds
  std::unique_ptr<Contestant> make(std::size_t pairs, int threads) const {
    if (row != nullptr) return std::make_unique<Ours>(row->make({threads}));
    return make_other != nullptr ? make_other() : make_bound(pairs);
  }
};

std::vector<Entrant> entrants() {
  std::vector<Entrant> all;
  for (const broad::CatalogRow& row : broad::catalog)
    all.push_back(
        {"touchstone:" + std::string(row.name), nullptr, &row, row.name == "brute_force" ? 10000 : 1000000});
  all.push_back({"plain_sweep", &make_plain_sweep, nullptr, 100000});
  all.push_back({"plain_grid", &make_plain_grid, nullptr, 1000000});
  all.push_back({"plain_sweep_sorted", &make_plain_sweep_sorted, nullptr, 100000});
  all.push_back({"plain_grid_sorted", &make_plain_grid_sorted, nullptr, 1000000});
  all.push_back({"bound", nullptr, nullptr, 1000000});
  return all;
}

// Sweeps over so many boxes take seconds a frame.
bool is_hopeless(const Entrant& e, int n) {
  const bool sweeps = e.name == "touchstone:sort_and_sweep" || e.name == "touchstone:incremental_sweep";
  return sweeps && n > 100000;
}

struct Options {
  std::vector<std::string> cells, methods;
  int rounds = 3, frames = 0, threads = 1;
  std::string csv, json;
};

bool chosen(const std::vector<std::string>& wanted, const std::string& name) {
  return wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const std::string& w) {
           return (name + "/").find(w) != std::string::npos;
         });
}

double now_ms(int threads) {
  timespec t{};
  clock_gettime(threads > 1 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

// The frames of a cell, generated beforehand so that generating them does not disturb any contestant's cache.
struct Script {
  std::vector<Aabb> start;
  std::vector<std::vector<broad::BoxUpdate>> frames;
  std::vector<Pairs> expected;  // of the first frames, sorted
};

constexpr std::size_t warm_frames = 2, frames_compared = 3;

Script make_script(std::string_view name, int n, int frames) {
  BoxScene scene(name, n, 2);
  Script s;
  s.start = scene.boxes();
  for (std::size_t f = 0; f < warm_frames + static_cast<std::size_t>(frames); ++f)
    s.frames.push_back(scene.step());
  const auto reference = make_plain_grid();
  reference->start(s.start);
  for (std::size_t f = 0; f < std::min(frames_compared, s.frames.size()); ++f) {
    s.expected.emplace_back();
    reference->frame(s.frames[f], s.expected.back());
    std::sort(s.expected.back().begin(), s.expected.back().end());
  }
  return s;
}

bool agrees(Contestant& c, const Script& s) {
  c.start(s.start);
  Pairs out;
  for (std::size_t f = 0; f < s.expected.size(); ++f) {
    c.frame(s.frames[f], out);
    std::sort(out.begin(), out.end());
    if (out != s.expected[f]) return false;
  }
  return true;
}

void run_round(const Entrant& e, const Script& s, int threads, BroadRow& row) {
  const auto subject = e.make(s.expected.back().size(), threads);
  subject->start(s.start);
  Pairs out;
  for (std::size_t f = 0; f < s.frames.size(); ++f) {
    const double before = now_ms(threads);
    subject->frame(s.frames[f], out);
    if (f >= warm_frames) row.frame_ms.push_back(now_ms(threads) - before);
  }
  ++row.rounds;
  row.pairs = out.size();
  row.reported = subject->reported();
  row.bytes = subject->memory_bytes();
  row.note = subject->note();
  row.answers = subject->answers();
}

int frames_of(const Options& o, int n) {
  if (o.frames > 0) return o.frames;
  // Long enough for structures that are rebuilt every ten frames or so to be rebuilt several times.
  return n <= 1000 ? 240 : n <= 10000 ? 80 : n <= 100000 ? 40 : 24;
}

std::vector<BroadRow> run_cell(const Options& o, const std::vector<Entrant>& all, std::string_view scene,
                               int n) {
  const Script script = make_script(scene, n, frames_of(o, n));
  std::vector<BroadRow> rows;
  std::vector<const Entrant*> who;
  for (const Entrant& e : all) {
    if (n > e.most || is_hopeless(e, n) || !chosen(o.methods, e.name)) continue;
    BroadRow r;
    r.scene = scene;
    r.n = n;
    r.method = e.name;
    const auto subject = e.make(0, o.threads);
    r.wrong = subject->answers() && !agrees(*subject, script);
    rows.push_back(r);
    who.push_back(&e);
  }
  for (int round = 0; round < o.rounds; ++round)
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::size_t i = (k + static_cast<std::size_t>(round)) % rows.size();
      run_round(*who[i], script, o.threads, rows[i]);
    }
  return rows;
}

std::vector<std::string> split(const std::string& s) {
  std::vector<std::string> all;
  for (std::size_t at = 0; at <= s.size();) {
    const std::size_t end = std::min(s.find(',', at), s.size());
    all.push_back(s.substr(at, end - at));
    at = end + 1;
  }
  return all;
}

bool parse(int argc, char** argv, Options& o) {
  for (int i = 1; i < argc; ++i) {
    if (i + 1 == argc) return false;
    const std::string name = argv[i], value = argv[++i];
    if (name == "--cells")
      o.cells = split(value);
    else if (name == "--methods")
      o.methods = split(value);
    else if (name == "--rounds")
      o.rounds = std::max(1, std::atoi(value.c_str()));
    else if (name == "--frames")
      o.frames = std::max(1, std::atoi(value.c_str()));
    else if (name == "--threads")
      o.threads = std::max(1, std::atoi(value.c_str()));
    else if (name == "--csv")
      o.csv = value;
    else if (name == "--json")
      o.json = value;
    else
      return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  if (!parse(argc, argv, o)) {
    fmt::print(
        stderr,
        "bench_broad [--cells SCENE/N,...] [--methods NAME,...] [--rounds R] [--frames F] [--threads N] "
        "[--csv FILE] [--json FILE]\nscenes: uniform mixed clustered static95 teleport; n: 1000 10000 100000 "
        "1000000\n");
    return 2;
  }
  const auto all = entrants();
  std::vector<BroadRow> rows;
  for (const int n : {1000, 10000, 100000, 1000000})
    for (const std::string_view scene : scene_names) {
      if (!chosen(o.cells, fmt::format("{}/{}", scene, n))) continue;
      const auto cell = run_cell(o, all, scene, n);
      fmt::print("{}", broad_text(cell));
      std::fflush(stdout);
      rows.insert(rows.end(), cell.begin(), cell.end());
    }
  fmt::print("{}", broad_summary(rows));
  if (!o.csv.empty()) std::ofstream(o.csv) << broad_csv(rows);
  if (!o.json.empty()) std::ofstream(o.json) << broad_json(rows);
  return std::any_of(rows.begin(), rows.end(),
                     [](const BroadRow& r) { return r.wrong && r.method.starts_with("touchstone"); });
}
