// Several threads report the same bytes as one.
#include <mutex>
#include <set>

#include "tests/core/broad_script.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::broad;
using namespace touchstone::test;

namespace {

constexpr int thread_counts[] = {1, 2, 3, 8};

// As many parts as threads, however little there is to do.
Options always(int threads) { return {threads, 1}; }

}  // namespace

TEST_CASE("parts run on their own threads and their failures are propagated", "[broad][parallel]") {
  std::mutex lock;
  std::set<std::thread::id> seen;
  std::set<std::size_t> parts;
  run_parts(5, [&](std::size_t p) {
    const std::lock_guard hold(lock);
    seen.insert(std::this_thread::get_id());
    parts.insert(p);
  });
  CHECK(parts == std::set<std::size_t>{0, 1, 2, 3, 4});
  CHECK(seen.contains(std::this_thread::get_id()));
  CHECK(seen.size() >= 2);
  CHECK_THROWS_AS(run_parts(4,
                            [](std::size_t p) {
                              if (p == 2) throw std::bad_alloc();
                            }),
                  std::bad_alloc);
  for (const std::size_t n : {0UL, 1UL, 7UL, 1000UL})
    for (const std::size_t many : {1UL, 3UL, 8UL}) {
      std::vector<int> dealt(n, 0);
      for (std::size_t p = 0; p < many; ++p) {
        REQUIRE(part_begin(n, many, p) <= part_begin(n, many, p + 1));
        deal_chunks(n, 4, many, p, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) ++dealt[i];
        });
      }
      CHECK(part_begin(n, many, many) == n);
      CHECK(std::count(dealt.begin(), dealt.end(), 1) == static_cast<long>(n));
    }
}

TEST_CASE("a thread count of zero is refused", "[broad][parallel]") {
  for (const CatalogRow& row : catalog) CHECK_THROWS_AS(row.make({0}), std::invalid_argument);
}

TEST_CASE("any number of threads reports the overlapping pairs of scripts", "[broad][parallel]") {
  for (const CatalogRow& row : catalog)
    for (const int threads : thread_counts) {
      Count count;
      for (int kind = 0; kind < box_kinds; ++kind)
        for (const int many : {5, 250}) {
          INFO(row.name << ", " << threads << " threads, kind " << kind);
          Script script(row, static_cast<std::uint64_t>(10 * kind + many), static_cast<BoxKind>(kind),
                        many == 5 ? 200001 : 1, always(threads));
          script.insert_many(many);
          for (int step = 0; step < 12; ++step) {
            script.step();
            REQUIRE(script.agrees(count));
          }
        }
      CHECK(count.queries == 24 * box_kinds);
      CHECK(count.pairs > count.possible / 200);
    }
}

TEST_CASE("any number of threads reports the same bytes on crowds", "[broad][parallel]") {
  for (const CatalogRow& row : catalog)
    for (const int kind : {0, 1, 2}) {
      INFO(row.name << ", " << (kind == 0 ? "uniform" : kind == 1 ? "1 % large" : "clusters"));
      Rng r(11);
      const auto make_scene = [&] {
        return kind == 2 ? clustered_scene(r, 2000, 4, 200, 3)
                         : uniform_scene(r, 2000, kind == 1 ? 0.01 : 0, 50);
      };
      auto scene = make_scene();
      std::vector<BroadPhasePtr> phases;
      for (const int threads : thread_counts) {
        phases.push_back(row.make(always(threads)));
        for (const BoxUpdate& u : scene)
          phases.back()->insert(u.id, u.box, u.id % 5 == 0 ? Mobility::fixed : Mobility::moving);
      }
      std::vector<IdPair> one, some;
      for (int frame = 0; frame < 12; ++frame) {
        phases[0]->pairs(one);
        CHECK(one.size() > 500);
        for (std::size_t p = 1; p < phases.size(); ++p) {
          phases[p]->pairs(some);
          REQUIRE(one == some);
          phases[p]->validate();
        }
        if (frame == 9) scene = make_scene();
        for (BoxUpdate& u : scene) {
          const Vec3 v = r.vector(0, 0.03);
          u.box.lo += v;
          u.box.hi += v;
        }
        const auto moved = std::span<const BoxUpdate>(scene).first(frame % 4 != 3 ? 2000 : 100);
        for (const BroadPhasePtr& p : phases) p->update(moved);
      }
    }
}
