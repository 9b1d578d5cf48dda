// Run by hand: `ts_core_broad_stress MINUTES [SEED]` of CPU time. Every broad phase of the catalog on random
// scripts of every kind of box and on crowds (uniform, a few large, clustered, with some fixed; coherent,
// fast, teleported, with inserts and removals). Each answer is compared with the definition (small scenes) or
// with brute force (large ones), each structure is validated. SIGTERM ends it early and prints the counts.
// Exit code 1 at the first difference.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "tests/core/broad_script.h"

using namespace touchstone;
using namespace touchstone::broad;
using namespace touchstone::test;

namespace {

struct Totals {
  Count scripts, crowds;
  long missed = 0, superfluous = 0;
};

// One run in five uses several threads, however little there is to do.
Options some_threads(Rng& r) {
  return r.chance(0.2) ? Options{2 + static_cast<int>(r.below(3)), 1} : Options{};
}

bool run_script(const CatalogRow& row, std::uint64_t seed, Totals& t) {
  Rng r = Rng::stream(seed, 1);
  Script script(row, seed, static_cast<BoxKind>(r.below(box_kinds)), r.chance(0.3) ? 200001 : 1,
                some_threads(r));
  if (r.chance(0.6)) script.insert_many(static_cast<int>(r.below(400)));
  for (int step = 0; step < 150; ++step) {
    script.step();
    if (!script.agrees(t.scripts)) return false;
  }
  return true;
}

// How a crowd moves in a frame.
void stir(Rng& r, std::vector<BoxUpdate>& boxes, int kind, double scale, std::vector<BoxUpdate>& moves) {
  const double speed = (kind == 0 ? 0.02 : kind == 1 ? 0.2 : 3) * scale;
  const double share = kind == 3 ? 0.05 : 1;
  moves.clear();
  for (BoxUpdate& u : boxes) {
    if (!r.chance(share)) continue;
    const Vec3 v = r.vector(0, speed);
    u.box.lo += v;
    u.box.hi += v;
    moves.push_back(u);
  }
}

void count_difference(const std::vector<IdPair>& got, const std::vector<IdPair>& expected, Totals& t) {
  std::vector<IdPair> d;
  std::set_difference(expected.begin(), expected.end(), got.begin(), got.end(), std::back_inserter(d));
  t.missed += static_cast<long>(d.size());
  d.clear();
  std::set_difference(got.begin(), got.end(), expected.begin(), expected.end(), std::back_inserter(d));
  t.superfluous += static_cast<long>(d.size());
}

bool run_crowd(const CatalogRow& row, std::uint64_t seed, Totals& t) {
  Rng r = Rng::stream(seed, 2);
  const int n = 170 + static_cast<int>(r.below(r.chance(0.2) ? 6000 : 1200));
  const double scale = r.chance(0.3) ? r.binary_scale(-30, 30) : 1;
  const auto crowd = [&] {
    auto all = r.chance(0.4) ? clustered_scene(r, n, 1 + static_cast<int>(r.below(8)), r.uniform(1, 400), 3)
                             : uniform_scene(r, n, r.chance(0.5) ? 0.02 : 0, r.uniform(1, 100));
    for (BoxUpdate& u : all) {
      u.box.lo *= scale;
      u.box.hi *= scale;
    }
    return all;
  };
  const auto subject = row.make(some_threads(r)), reference = make_brute_force();
  auto boxes = crowd();
  const double fixed = r.chance(0.3) ? 0.7 : 0.05;
  for (const BoxUpdate& u : boxes) {
    const Mobility m = r.chance(fixed) ? Mobility::fixed : Mobility::moving;
    subject->insert(u.id, u.box, m);
    reference->insert(u.id, u.box, m);
  }
  std::vector<BoxUpdate> moves;
  std::vector<IdPair> a, b;
  for (int frame = 0, kind = 0; frame < 40; ++frame) {
    subject->pairs(a);
    reference->pairs(b);
    subject->validate();
    ++t.crowds.queries;
    t.crowds.pairs += static_cast<long>(b.size());
    t.crowds.possible += static_cast<long>(n) * (n - 1) / 2;
    if (a != b) {
      count_difference(a, b, t);
      return false;
    }
    if (r.chance(0.15)) kind = static_cast<int>(r.below(5));
    if (kind == 4) {
      const auto elsewhere = crowd();
      for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].box = elsewhere[i].box;
    }
    stir(r, boxes, kind, scale, moves);
    subject->update(moves);
    reference->update(moves);
    for (std::uint64_t k = r.chance(0.3) ? r.below(20) : 0; k-- > 0;) {
      const auto i = r.below(boxes.size());
      subject->remove(boxes[i].id);
      reference->remove(boxes[i].id);
      if (r.chance(0.5)) boxes[i].id += n;  // comes back under another id
      const Mobility m = r.chance(fixed) ? Mobility::fixed : Mobility::moving;
      subject->insert(boxes[i].id, boxes[i].box, m);
      reference->insert(boxes[i].id, boxes[i].box, m);
    }
  }
  return true;
}

double cpu_minutes() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC / 60; }

volatile std::sig_atomic_t told_to_end = 0;

}  // namespace

int main(int argc, char** argv) {
  const double minutes = argc > 1 ? std::atof(argv[1]) : 1;
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  std::signal(SIGTERM, [](int) { told_to_end = 1; });
  Totals t;
  std::uint64_t seed = first;
  for (; cpu_minutes() < minutes && told_to_end == 0; ++seed)
    for (const CatalogRow& row : catalog) {
      bool right = false;
      try {
        right = run_script(row, seed, t) && run_crowd(row, seed, t);
      } catch (const std::exception& e) {
        std::printf("%s\n", e.what());
      }
      if (!right) {
        std::printf("%s differs, seed %llu: %ld missed, %ld superfluous\n", std::string(row.name).c_str(),
                    static_cast<unsigned long long>(seed), t.missed, t.superfluous);
        return 1;
      }
    }
  std::printf(
      "%.1f CPU minutes, seeds %llu to %llu, %zu methods: scripts %ld queries, %ld pairs of %ld; crowds %ld "
      "queries, %ld pairs of %ld; 0 missed, 0 superfluous\n",
      cpu_minutes(), static_cast<unsigned long long>(first), static_cast<unsigned long long>(seed - 1),
      catalog.size(), t.scripts.queries, t.scripts.pairs, t.scripts.possible, t.crowds.queries,
      t.crowds.pairs, t.crowds.possible);
  return t.scripts.pairs > 0 && t.crowds.pairs > 0 ? 0 : 3;
}
