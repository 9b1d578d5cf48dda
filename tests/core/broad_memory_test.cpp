// The memory that a broad phase reports, against every byte that it has allocated, and against the limit.
#include <malloc.h>

#include <cstdlib>
#include <new>
#include <utility>

#include "tests/core/broad_script.h"
#include "tests/support/catch.h"

namespace {

// Bytes allocated and not freed; a header of 64 bytes precedes each block.
constexpr std::size_t header = 64;
long live = 0;

void* take(std::size_t size, std::size_t alignment) {
  const std::size_t before = std::max(header, alignment);
  auto* const raw = static_cast<char*>(std::aligned_alloc(before, (size + 2 * before - 1) / before * before));
  if (raw == nullptr) throw std::bad_alloc();
  char* const block = raw + before;
  reinterpret_cast<std::size_t*>(block)[-1] = size;
  reinterpret_cast<std::size_t*>(block)[-2] = before;
  live += static_cast<long>(size);
  return block;
}

void give_back(void* block) noexcept {
  if (block == nullptr) return;
  live -= static_cast<long>(static_cast<std::size_t*>(block)[-1]);
  std::free(static_cast<char*>(block) - static_cast<std::size_t*>(block)[-2]);
}

}  // namespace

void* operator new(std::size_t size) { return take(size, header); }
void* operator new(std::size_t size, std::align_val_t a) { return take(size, static_cast<std::size_t>(a)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return take(size, header); }
void* operator new(std::size_t size, std::align_val_t a, const std::nothrow_t&) noexcept {
  return take(size, static_cast<std::size_t>(a));
}
void operator delete(void* block) noexcept { give_back(block); }
void operator delete(void* block, std::size_t) noexcept { give_back(block); }
void operator delete(void* block, std::align_val_t) noexcept { give_back(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { give_back(block); }

using namespace touchstone;
using namespace touchstone::broad;
using namespace touchstone::test;

namespace {

struct Held {
  double reported = 0, counted = 0, pairs = 0;  // per box, at the query that uses most
};

// Measures coherent frames, or frames in which all boxes are elsewhere.
Held hold(const CatalogRow& row, std::vector<BoxUpdate> scene, bool elsewhere) {
  const auto n = static_cast<double>(scene.size());
  std::vector<IdPair> out;
  Rng r(3);
  const long before = live;
  const auto phase = row.make();
  for (const BoxUpdate& u : scene) phase->insert(u.id, u.box);
  Held most;
  for (int frame = 0; frame < (elsewhere ? 3 : 14); ++frame) {
    if (elsewhere) std::rotate(scene.begin(), scene.begin() + 777, scene.end());
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const Vec3 v = r.vector(0, 0.015);
      scene[i].box.lo += v;
      scene[i].box.hi += v;
      scene[i].id = static_cast<int>(i);
    }
    phase->update(scene);
    phase->pairs(out);
    if (frame == 0) continue;  // the boxes have only just been inserted
    const auto of_out = static_cast<long>(out.capacity() * sizeof(IdPair));
    const Held held{static_cast<double>(phase->memory_bytes()) / n,
                    static_cast<double>(live - before - of_out) / n, static_cast<double>(out.size()) / n};
    REQUIRE(held.reported == Approx(held.counted).epsilon(0.01));
    if (held.reported > most.reported) most = held;
  }
  return most;
}

}  // namespace

TEST_CASE("a broad phase of 100,000 boxes uses at most 200 bytes per box, and reports how many",
          "[broad][memory]") {
  Rng r(1);
  constexpr int n = 100000;
  const auto uniform = uniform_scene(r, n, 0, 1);
  auto mixed = uniform_scene(r, n, 0.01, 50);
  for (BoxUpdate& u : mixed) {  // large boxes need room: three pairs per box
    const Vec3 centre = (u.box.lo + u.box.hi) / 2 * 7.3, half = (u.box.hi - u.box.lo) / 2;
    u.box = {centre - half, centre + half};
  }
  const auto clusters = clustered_scene(r, n, 100, 20, 2.2);
  for (const CatalogRow& row : catalog) {
    if (row.name == "brute_force") continue;  // takes half a minute
    for (const bool elsewhere : {false, true})
      for (const auto* scene : {&uniform, &std::as_const(mixed), &clusters}) {
        // These do not depend on a sweep axis.
        if (row.name.ends_with("_sweep") && scene != &uniform) continue;
        const Held held = hold(row, *scene, elsewhere);
        const std::string what = scene == &uniform ? "uniform" : scene == &mixed ? "mixed" : "clusters";
        INFO(row.name << ", " << what << (elsewhere ? ", elsewhere: " : ", coherent: ") << held.reported
                      << " reported, " << held.counted << " counted, " << held.pairs << " pairs a box");
        if (std::getenv("TOUCHSTONE_SHOW") != nullptr)
          std::printf("%-26s %-8s %d  %6.1f reported %6.1f counted %5.2f pairs\n",
                      std::string(row.name).c_str(), what.c_str(), elsewhere, held.reported, held.counted,
                      held.pairs);
        CHECK(held.pairs > 0.5);
        // Clusters have eight pairs per box, which must be stored: 16 bytes each beyond two, and some room.
        CHECK(held.reported <= 200 + 17 * std::max(0.0, held.pairs - 2));
      }
  }
}
