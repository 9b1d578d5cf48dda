// Every broad phase of the catalog against the definition, on scripts.
#include "core/broad/catalog.h"
#include "core/broad/float_key.h"
#include "tests/core/broad_boxes.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::broad;
using namespace touchstone::test;

namespace {

struct Count {
  long pairs = 0, possible = 0, queries = 0;
};

// A phase and the definition, driven by the same random operations.
class Script {
 public:
  Script(const CatalogRow& row, std::uint64_t seed, BoxKind kind, int id_step)
      : subject_(row.make()), r_(seed), kind_(kind), id_step_(id_step) {}

  void insert_many(int n) {
    for (int i = 0; i < n; ++i) insert();
  }
  void step() {
    const double what = r_.uniform();
    if (reference_.bodies.empty() || what < 0.2) {
      insert();
    } else if (what < 0.35) {
      const int id = any();
      subject_->remove(id), reference_.bodies.erase(id), removed_.push_back(id);
    } else if (what < 0.8) {
      move_some(1 + r_.below(3));
    } else if (what < 0.9) {  // small, coherent motion of all
      drift();
    } else if (what < 0.93) {
      move_some(reference_.bodies.size());
    } else {
      move_some(reference_.bodies.size() / 8 + 1);
    }
  }
  void compare(Count& count) {
    subject_->pairs(out_);
    const auto expected = reference_.pairs();
    REQUIRE(out_ == expected);
    subject_->validate();
    const auto n = static_cast<long>(reference_.bodies.size());
    count.pairs += static_cast<long>(out_.size()), count.possible += n * (n - 1) / 2, ++count.queries;
  }

 private:
  int any() {
    auto it = reference_.bodies.begin();
    std::advance(it, static_cast<long>(r_.below(reference_.bodies.size())));
    return it->first;
  }
  void insert() {
    int id = (next_++ * 7919 % 10007 - 5000) * id_step_;
    if (!removed_.empty() && r_.chance(0.5)) id = removed_.back(), removed_.pop_back();
    if (reference_.bodies.contains(id)) return;
    const bool fixed = r_.chance(0.3);
    const Aabb box = make_box(r_, kind_);
    subject_->insert(id, box, fixed ? Mobility::fixed : Mobility::moving);
    reference_.bodies[id] = {box, fixed};
  }
  void move_some(std::size_t n) {
    std::vector<BoxUpdate> moves;
    for (std::size_t i = 0; i < n; ++i) {
      const int id = any();
      moves.push_back({id, make_box(r_, kind_)});
      reference_.bodies[id].box = moves.back().box;
    }
    if (n == 1)
      subject_->move(moves[0].id, moves[0].box);
    else
      subject_->update(moves);
  }
  void drift() {
    std::vector<BoxUpdate> moves;
    for (auto& [id, body] : reference_.bodies) {
      if (body.fixed) continue;
      const Vec3 v = r_.vector(0, 0.1);
      body.box.lo += v, body.box.hi += v;
      moves.push_back({id, body.box});
    }
    subject_->update(moves);
  }
  BroadPhasePtr subject_;
  Reference reference_;
  Rng r_;
  BoxKind kind_;
  int id_step_, next_ = 0;
  std::vector<int> removed_;
  std::vector<IdPair> out_;
};

// Boxes of side 1/2..3/2 in a cube with two units of volume a box: about four partners each.
std::vector<BoxUpdate> uniform_scene(Rng& r, int n, double large_share, double large) {
  const double side = std::cbrt(2.0 * n);
  std::vector<BoxUpdate> all;
  for (int i = 0; i < n; ++i) {
    const double scale = r.chance(large_share) ? large : 1;
    Aabb b;
    for (int k = 0; k < 3; ++k) {
      const double c = r.uniform(-side / 2, side / 2), h = r.uniform(0.25, 0.75) * scale;
      b.lo[k] = c - h, b.hi[k] = c + h;
    }
    all.push_back({i, b});
  }
  return all;
}

}  // namespace

TEST_CASE("every broad phase reports the overlapping pairs on scripts of every kind of box", "[broad]") {
  for (const CatalogRow& row : catalog)
    for (int kind = 0; kind < box_kinds; ++kind) {
      Count count;
      for (std::uint64_t seed = 0; seed < 6; ++seed) {
        INFO(row.name << ", kind " << kind << ", seed " << seed);
        Script script(row, seed * 100 + static_cast<std::uint64_t>(kind), static_cast<BoxKind>(kind),
                      seed % 3 == 2 ? 200001 : 1);
        if (seed % 2 == 1) script.insert_many(seed == 3 ? 300 : 60);
        for (int step = 0; step < 120; ++step) script.step(), script.compare(count);
      }
      INFO(row.name << ", kind " << kind << ": " << count.pairs << " of " << count.possible);
      CHECK(count.queries == 720);
      CHECK(count.pairs > count.possible / 200);
      CHECK(count.pairs < count.possible);
    }
}

TEST_CASE("thousands of steps leave every broad phase right", "[broad]") {
  for (const CatalogRow& row : catalog) {
    Count count;
    INFO(row.name);
    Script script(row, 77, BoxKind::sizes, 1);
    for (int step = 0; step < 4000; ++step) {
      script.step();
      if (step % 40 == 0) script.compare(count);
    }
    CHECK(count.queries == 100);
    CHECK(count.pairs > 0);
  }
}

TEST_CASE("every broad phase finds the same pairs in large scenes, coherent or teleported", "[broad]") {
  for (const double share : {0.0, 0.01})
    for (const CatalogRow& row : catalog) {
      INFO(row.name << ", share of large boxes " << share);
      Rng r(5);
      const auto subject = row.make(), reference = make_brute_force();
      auto scene = uniform_scene(r, 3000, share, 50);
      for (const BoxUpdate& u : scene) {
        const Mobility m = u.id % 4 == 0 ? Mobility::fixed : Mobility::moving;
        subject->insert(u.id, u.box, m), reference->insert(u.id, u.box, m);
      }
      std::vector<IdPair> a, b;
      for (int frame = 0; frame < 8; ++frame) {
        subject->pairs(a), reference->pairs(b);
        REQUIRE(a == b);
        CHECK(a.size() > 1000);
        subject->validate();
        if (frame == 5) scene = uniform_scene(r, 3000, share, 50);
        for (BoxUpdate& u : scene) {
          const Vec3 v = r.vector(0, 0.02);
          u.box.lo += v, u.box.hi += v;
        }
        const std::span<const BoxUpdate> all(scene), some = all.first(frame % 2 == 0 ? 3000 : 150);
        subject->update(some), reference->update(some);
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

TEST_CASE("a batch with one bad move makes no move", "[broad]") {
  for (const CatalogRow& row : catalog) {
    const auto phase = row.make();
    const Aabb unit{Vec3::Zero(), Vec3::Ones()}, away{Vec3::Constant(5), Vec3::Constant(6)};
    phase->insert(1, unit), phase->insert(2, unit);
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

TEST_CASE("a swept box holds both ends", "[broad][box]") {
  const Aabb a{Vec3(0, 0, 0), Vec3(1, 1, 1)}, b{Vec3(-1, 2, 0), Vec3(0, 3, 1)};
  CHECK(swept(a, b) == Aabb{Vec3(-1, 0, 0), Vec3(1, 3, 1)});
}
