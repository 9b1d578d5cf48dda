#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "core/base/input_error.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

// Families that are in the mix of all.
std::size_t mixed_families() {
  return static_cast<std::size_t>(
      std::ranges::count_if(fuzz::families(), [](const fuzz::Family& f) { return f.weight > 0; }));
}

}  // namespace

TEST_CASE("every case of every family is valid and reproducible from its seed and index", "[generate]") {
  std::size_t n = 0;
  for (const fuzz::Family& f : fuzz::families())
    for (std::uint64_t i = 0; i < 200; ++i, ++n) {
      const Case a = fuzz::make_case(11, i, f.name);
      REQUIRE_NOTHROW(validate(a.scene));
      REQUIRE(a == fuzz::make_case(11, i, f.name));
      REQUIRE_FALSE(a.queries.empty());
    }
  CHECK(n == 200 * fuzz::families().size());
}

TEST_CASE("the mix reaches every family and every pair of convex shapes", "[generate]") {
  std::set<std::string> families, pairs;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Case c = fuzz::make_case(3, i);
    families.insert(c.family);
    if (c.scene.bodies.size() == 2)
      pairs.insert(std::string(type_name(c.scene.shape_of(0))) + "-" +
                   std::string(type_name(c.scene.shape_of(1))));
  }
  CHECK(families.size() == mixed_families());
  CHECK(pairs.size() >= 49 + 7 + 7);
}

TEST_CASE("cases of given kinds have no others, in nearly all families, and depend on nothing else",
          "[generate]") {
  const std::vector<ShapeKind> kinds{ShapeKind::sphere, ShapeKind::box, ShapeKind::cylinder};
  std::set<std::string> families, pairs;
  std::size_t others = 0;
  constexpr std::uint64_t cases = 3000;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Case c = fuzz::make_case(3, i, {}, kinds);
    for (const Shape& s : c.scene.shapes)
      if (std::find(kinds.begin(), kinds.end(), kind_of(s)) == kinds.end()) {
        ++others;
        break;
      }
    families.insert(c.family);
    if (c.scene.bodies.size() == 2)
      pairs.insert(std::string(type_name(c.scene.shape_of(0))) + "-" +
                   std::string(type_name(c.scene.shape_of(1))));
    if (i % 100 != 0) continue;
    REQUIRE_NOTHROW(validate(c.scene));
    const Case plain = fuzz::make_case(3, i);
    CHECK(fuzz::make_case(3, i, {}, kinds) == c);
    CHECK(fuzz::make_case(3, i) == plain);
  }
  CHECK(others == 0);
  CHECK(pairs.size() >= 9);
  // Without those of meshes and height fields, of hulls of many vertices, of rounded boxes and with
  // half-spaces and meshes.
  CHECK(families.size() >= mixed_families() - 6);
  // No body can be made of these alone: they are drawn as ever.
  const std::vector<ShapeKind> unbounded{ShapeKind::half_space};
  CHECK(fuzz::make_case(3, 1, "deep", unbounded).scene.bodies.size() == 2);
}

TEST_CASE("different seeds give different cases; unknown families are refused", "[generate]") {
  CHECK(hash(fuzz::make_case(1, 0).scene) != hash(fuzz::make_case(2, 0).scene));
  for (const char* names : {"nonsense", "deep,", ",", "deep,nonsense"})
    CHECK_THROWS_AS(fuzz::make_case(1, 0, names), InputError);
}

TEST_CASE("several families mix by their weights", "[generate]") {
  std::map<std::string, int> count;
  for (std::uint64_t i = 0; i < 2000; ++i) ++count[fuzz::make_case(3, i, "throng,deep,contained").family];
  CHECK(count.size() == 3);
  // Weights 1, 14 and 8.
  CHECK(count["deep"] > count["contained"]);
  CHECK(count["contained"] > 4 * count["throng"]);
  CHECK(count["throng"] > 40);
}

TEST_CASE("a family outside of the mix is drawn by its name, alone and beside others", "[generate]") {
  std::set<std::string> families;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = fuzz::make_case(3, i, "endless,throng");
    families.insert(c.family);
    if (c.family == "endless") CHECK(c.queries.size() >= 300);
  }
  CHECK(families.size() == 2);
  CHECK(fuzz::make_case(3, 0, "endless").family == "endless");
}

TEST_CASE("the default mix has every regime as often as stated", "[generate]") {
  constexpr std::uint64_t cases = 6000;
  std::map<std::string_view, std::uint64_t> count;
  Case before = fuzz::make_case(7, 0);
  for (std::uint64_t i = 1; i <= cases; ++i) {
    Case c = fuzz::make_case(7, i);
    for (const fuzz::Regime& r : fuzz::regimes()) count[r.name] += r.shown(c, before);
    before = std::move(c);
  }
  for (const fuzz::Regime& r : fuzz::regimes()) {
    INFO(r.name << ": one case in " << r.one_in << " is stated, of " << cases << " there are "
                << count[r.name]);
    CHECK(count[r.name] * static_cast<std::uint64_t>(r.one_in) >= cases);
  }
}
