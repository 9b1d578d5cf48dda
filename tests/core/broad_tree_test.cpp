// The hierarchy's trees insert and remove boxes without being rebuilt, and do not degrade.
#include "core/broad/bounding_volume_hierarchy.h"
#include "core/broad/stored_phase.h"
#include "core/tolerance.h"
#include "tests/core/broad_script.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::broad;
using namespace touchstone::test;

namespace {

long number_after(const std::string& text, const std::string& before, const std::string& word) {
  const auto end = text.find(word);
  REQUIRE(end != std::string::npos);
  const auto begin = text.rfind(before, end - 1);
  return std::stol(text.substr(begin + before.size(), end - begin));
}

double reach(const std::string& text) { return std::stod(text.substr(text.find("growth ") + 7)); }

// A scene in which boxes are inserted, removed and moved elsewhere, a few at a time.
struct Storm {
  Rng r{21};
  std::vector<BoxUpdate> here, away;
  BroadPhasePtr tree = make_bounding_volume_hierarchy(), reference = make_brute_force();

  explicit Storm(int n) : here(uniform_scene(r, n, 0.005, 12)) {
    for (const BoxUpdate& u : here) insert(u);
  }
  void insert(const BoxUpdate& u) {
    const Mobility m = u.id % 3 == 0 ? Mobility::fixed : Mobility::moving;
    tree->insert(u.id, u.box, m);
    reference->insert(u.id, u.box, m);
  }
  void carry(BoxUpdate& u) {
    const auto elsewhere = uniform_scene(r, static_cast<int>(here.size() + away.size()), 0.005, 12);
    u.box = elsewhere[r.below(elsewhere.size())].box;
  }
  void go() {
    const std::size_t i = r.below(here.size());
    tree->remove(here[i].id);
    reference->remove(here[i].id);
    away.push_back(here[i]);
    here[i] = here.back();
    here.pop_back();
  }
  void come() {
    if (away.empty()) return;
    carry(away.back());
    insert(away.back());
    here.push_back(away.back());
    away.pop_back();
  }
  void move() {
    BoxUpdate& u = here[r.below(here.size())];
    carry(u);
    tree->move(u.id, u.box);
    reference->move(u.id, u.box);
  }
  std::size_t compare() {
    std::vector<IdPair> a, b;
    tree->pairs(a);
    reference->pairs(b);
    REQUIRE(a == b);
    tree->validate();
    return a.size();
  }
};

}  // namespace

TEST_CASE("storms of inserts, removals and moves do not rebuild the hierarchy's trees", "[broad][tree]") {
  Storm storm(1500);
  std::size_t pairs = storm.compare();
  const long builds = number_after(storm.tree->explain(), "; ", " builds");
  CHECK(builds == 2);  // one of the fixed boxes, one of the moving ones
  for (int frame = 0; frame < 300; ++frame) {
    while (!storm.away.empty()) storm.come();  // those that went in the frame before
    for (int k = 0; k < 20; ++k) storm.go();
    for (int k = 0; k < 20; ++k) storm.move();
    pairs += storm.compare();
  }
  const std::string text = storm.tree->explain();
  INFO(text);
  CHECK(number_after(text, "; ", " builds") == builds);
  CHECK(number_after(text, ", ", " boxes inserted") > 2500);
  CHECK(number_after(text, " and ", " removed") > 2500);
  CHECK(reach(text) > 0.5);
  CHECK(reach(text) < tolerance::tree_local_decay);
  CHECK(pairs > 300 * 1500 / 2);
}

TEST_CASE("a hierarchy that shrinks to nothing and grows again stays correct", "[broad][tree]") {
  Storm storm(700);
  storm.compare();
  for (int round = 0; round < 3; ++round) {
    while (!storm.here.empty()) {
      for (std::size_t k = 0; k <= storm.here.size() / 9 && !storm.here.empty(); ++k) storm.go();
      storm.compare();
      if (round == 1 && storm.here.size() == 1) {
        storm.move();
        storm.compare();
      }
    }
    CHECK(storm.compare() == 0);
    for (std::size_t pairs = 0; !storm.away.empty(); pairs = storm.compare()) {
      for (std::size_t k = 0, n = storm.here.size() / 9; k <= n; ++k) storm.come();
      if (storm.away.empty()) CHECK(pairs > 300);
    }
  }
}

TEST_CASE("a tree built box by box is correct for infinite, equal and touching boxes", "[broad][tree]") {
  for (int k = 0; k < box_kinds; ++k) {
    Rng r(static_cast<std::uint64_t>(k));
    BoxStore store;
    WideTree tree;
    PairSink found;
    Reference reference;
    for (int id = 0; id < 400; ++id) {
      const Aabb box = make_box(r, static_cast<BoxKind>(k));
      store.insert(id, box, Mobility::moving);
      reference.bodies[id] = {box, false};
      tree.insert(store, static_cast<BoxStore::Slot>(id));
    }
    for (int id = 0; id < 400; ++id)
      if (id % 7 < 3) {
        tree.remove(static_cast<BoxStore::Slot>(id));
        store.remove(id);
        reference.bodies.erase(id);
      }
    tree.validate();
    CHECK(tree.size() == store.present());
    tree.self_pairs(found);
    std::vector<IdPair> out;
    found.finish(store, out);
    REQUIRE(out == reference.pairs());
    CHECK(!out.empty());
  }
}
