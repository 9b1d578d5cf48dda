// Every broad phase of the catalog against the definition, on scripts.
#include "core/broad/catalog.h"
#include "core/broad/float_key.h"
#include "tests/core/broad_script.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::broad;
using namespace touchstone::test;

TEST_CASE("every broad phase reports the overlapping pairs of scripts with every kind of box", "[broad]") {
  for (const CatalogRow& row : catalog)
    for (int kind = 0; kind < box_kinds; ++kind) {
      Count count;
      for (std::uint64_t seed = 0; seed < 6; ++seed) {
        INFO(row.name << ", kind " << kind << ", seed " << seed);
        Script script(row, seed * 100 + static_cast<std::uint64_t>(kind), static_cast<BoxKind>(kind),
                      seed % 3 == 2 ? 200001 : 1);
        if (seed % 2 == 1) script.insert_many(seed == 3 ? 300 : 60);
        for (int step = 0; step < 120; ++step) {
          script.step();
          REQUIRE(script.agrees(count));
        }
      }
      INFO(row.name << ", kind " << kind << ": " << count.pairs << " of " << count.possible);
      CHECK(count.queries == 720);
      CHECK(count.pairs > count.possible / 200);
      CHECK(count.pairs < count.possible);
    }
}

TEST_CASE("every broad phase is correct after thousands of steps", "[broad]") {
  for (const CatalogRow& row : catalog) {
    Count count;
    INFO(row.name);
    Script script(row, 77, BoxKind::sizes, 1);
    for (int step = 0; step < 4000; ++step) {
      script.step();
      if (step % 40 == 0) REQUIRE(script.agrees(count));
    }
    CHECK(count.queries == 100);
    CHECK(count.pairs > 0);
  }
}

TEST_CASE("every broad phase finds the same pairs in large scenes, coherent or teleported", "[broad]") {
  for (const int kind : {0, 1, 2})
    for (const CatalogRow& row : catalog) {
      INFO(row.name << ", "
                    << (kind == 0   ? "uniform"
                        : kind == 1 ? "1 % large"
                                    : "clusters in a wide world"));
      Rng r(5);
      const auto make_scene = [&] {
        return kind == 2 ? clustered_scene(r, 3000, 5, 200, 3)
                         : uniform_scene(r, 3000, kind == 1 ? 0.01 : 0, 50);
      };
      const auto subject = row.make(), reference = make_brute_force();
      auto scene = make_scene();
      for (const BoxUpdate& u : scene) {
        const Mobility m = u.id % 4 == 0 ? Mobility::fixed : Mobility::moving;
        subject->insert(u.id, u.box, m);
        reference->insert(u.id, u.box, m);
      }
      std::vector<IdPair> a, b;
      for (int frame = 0; frame < 24; ++frame) {
        subject->pairs(a);
        reference->pairs(b);
        REQUIRE(a == b);
        CHECK(a.size() > 1000);
        subject->validate();
        if (frame == 15) scene = make_scene();
        for (BoxUpdate& u : scene) {
          const Vec3 v = r.vector(0, 0.02);
          u.box.lo += v;
          u.box.hi += v;
        }
        const std::span<const BoxUpdate> all(scene), some = all.first(frame % 4 != 3 ? 3000 : 150);
        subject->update(some);
        reference->update(some);
      }
    }
}

TEST_CASE("a long box whose length rounds down is found by a box at its far end", "[broad]") {
  for (const CatalogRow& row : catalog)
    for (const double start : {-0.4, -0x1p-30, -0.9}) {
      INFO(row.name << ", start " << start);
      const auto phase = row.make();
      const Vec3 one = Vec3::Ones();
      for (int i = 0; i < 200; ++i) phase->insert(i, {Vec3(300.0 * i, 5, 5), Vec3(300.0 * i + 1, 6, 6)});
      phase->insert(500, {Vec3(start, 0, 0), Vec3(0x1p24, 1, 1)});
      phase->insert(501, {Vec3(0x1p24 + 2, 0, 0), Vec3(0x1p24 + 4, 0, 0) + one});
      std::vector<IdPair> out;
      phase->pairs(out);
      CHECK(out.empty());
      phase->move(501, {Vec3(0x1p24, 0, 0), Vec3(0x1p24 + 4, 0, 0) + one});
      phase->pairs(out);
      CHECK(out == std::vector<IdPair>{{500, 501}});
    }
}

TEST_CASE("a batch with one bad move moves nothing", "[broad]") {
  for (const CatalogRow& row : catalog) {
    const auto phase = row.make();
    const Aabb unit{Vec3::Zero(), Vec3::Ones()}, away{Vec3::Constant(5), Vec3::Constant(6)};
    phase->insert(1, unit);
    phase->insert(2, unit);
    const std::vector<BoxUpdate> moves = {{1, away}, {9, unit}};
    CHECK_THROWS_AS(phase->update(moves), Refused);
    std::vector<IdPair> out;
    phase->pairs(out);
    CHECK(out == std::vector<IdPair>{{1, 2}});
    CHECK(phase->memory_bytes() > 0);
    CHECK(!phase->explain().empty());
  }
}

TEST_CASE("float keys are outward, monotone and tight, to the last bit", "[broad][box]") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  long inexact = 0;
  const auto check = [&](double d) {
    const double below = value_of(key_below(d)), above = value_of(key_above(d));
    REQUIRE(below <= d);
    REQUIRE(above >= d);
    if (static_cast<double>(value_of(key_below(d))) == d) {
      REQUIRE(key_above(d) == key_below(d));
    } else {
      REQUIRE(key_above(d) == key_below(d) + 1);
      ++inexact;
    }
  };
  for (const double d : {0.0, -0.0, 0x1p-1074, -0x1p-1074, 0x1p-149, 0x1.8p-149, -0x1.8p-149, 0x1p-150, inf,
                         -inf, 1e300, -1e300, 0x1.fffffep127, 0x1.ffffffp127, -0x1.ffffffp127, 1.0, 0.1})
    check(d);
  Rng r(1);
  double last = -inf;
  for (int k = 0; k < 200000; ++k) {
    const double sign = r.chance(0.5) ? 1 : -1;
    const double d = sign * r.binary_scale(-170, 140);
    check(d);
    if (d < last) {
      REQUIRE(key_below(d) <= key_below(last));
      REQUIRE(key_above(d) <= key_above(last));
    }
    last = d;
  }
  CHECK(inexact > 150000);
  CHECK(key_below(-0.0) == key_below(0.0));
  CHECK(key_above(std::nextafter(0.0, 1)) == 1);
}

TEST_CASE("a swept box contains both ends", "[broad][box]") {
  const Aabb a{Vec3(0, 0, 0), Vec3(1, 1, 1)}, b{Vec3(-1, 2, 0), Vec3(0, 3, 1)};
  CHECK(swept(a, b) == Aabb{Vec3(-1, 0, 0), Vec3(1, 3, 1)});
}
