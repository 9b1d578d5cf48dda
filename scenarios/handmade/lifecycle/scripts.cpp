// Scripts that insert, move, teleport and remove: stale pairs, lost pairs, reused ids. Unless stated
// otherwise, all bodies are axis-aligned unit cubes, so two meet when their centres are at most 1 apart along
// every axis.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

using Pairs = std::vector<BodyPair>;

Step insert(int b) { return {Step::Op::insert, b, std::nullopt}; }
Step insert(int b, const Pose& p) { return {Step::Op::insert, b, p}; }
Step move(int b, const Pose& p) { return {Step::Op::move, b, p}; }
Step remove(int b) { return {Step::Op::remove, b, std::nullopt}; }
Step query() { return {}; }

Scene cubes_in_a_row(int n, double spacing) {
  std::vector<Part> parts;
  for (int i = 0; i < n; ++i) parts.push_back({Box{Vec3(0.5, 0.5, 0.5)}, at(spacing * i, 0, 0), {}});
  return scene_of("", std::move(parts));
}

Scenario script(const std::string& name, const std::string& line, Scene scene, std::vector<Step> steps,
                std::vector<Pairs> pairs,
                const std::string& reason = "centres at most 1 apart along every axis") {
  scene.script = std::move(steps);
  Expectation e;
  e.pairs_at_query = std::move(pairs);
  e.reason = reason;
  return scenario("lifecycle", name, line, std::move(scene), std::move(e));
}

Scene with_filters() {
  Scene s = cubes_in_a_row(4, 0.25);
  s.bodies[0].group = s.bodies[1].group = 3;
  s.ignored = {{2, 3}};
  return s;
}

Scenario chain_grows() {
  std::vector<Step> steps;
  std::vector<Pairs> pairs;
  Pairs now;
  for (int i = 0; i < 8; ++i) {
    steps.push_back(insert(i));
    steps.push_back(query());
    if (i > 0) now.emplace_back(i - 1, i);
    pairs.push_back(now);
  }
  return script("chain_grows", "a query after every insertion", cubes_in_a_row(8, 1), steps, pairs);
}

Scene plank_and_cube() {
  return scene_of("", {{Box{Vec3(2, 0.125, 0.125)}, {}, {}}, {Box{Vec3(0.5, 0.5, 0.5)}, at(0, 2.5, 0), {}}});
}

}  // namespace

List lifecycle_scripts() {
  const double far = 0x1p30;
  return {
      script("remove_and_insert_again", "an id is reused, once at its own pose and once elsewhere",
             cubes_in_a_row(2, 1),
             {insert(0), insert(1), query(), remove(1), query(), insert(1), query(), remove(0),
              insert(0, at(9, 0, 0)), query(), remove(0), insert(0), query()},
             {{{0, 1}}, {}, {{0, 1}}, {}, {{0, 1}}}),
      script("teleport_there_and_back", "a jump of 2^30 and the return", cubes_in_a_row(3, 1),
             {insert(0), insert(1), insert(2), query(), move(1, at(far, -far, far)), query(),
              move(1, at(1, 0, 0)), query()},
             {{{0, 1}, {1, 2}}, {}, {{0, 1}, {1, 2}}}),
      script("nothing_there", "queries of an empty world and of a single body", cubes_in_a_row(1, 1),
             {query(), insert(0), query(), remove(0), query()}, {{}, {}, {}}),
      script("ask_twice", "the second answer must not depend on the first", cubes_in_a_row(3, 1),
             {insert(0), insert(1), insert(2), query(), query(), query()},
             {{{0, 1}, {1, 2}}, {{0, 1}, {1, 2}}, {{0, 1}, {1, 2}}}),
      script("approach_to_touching", "touching is reported exactly when it is reached", cubes_in_a_row(2, 4),
             {insert(0), insert(1), query(), move(1, at(1 + 0x1p-52, 0, 0)), query(), move(1, at(1, 0, 0)),
              query(), move(1, at(0.5, 0, 0)), query(), move(1, at(1 + 0x1p-52, 0, 0)), query()},
             {{}, {}, {{0, 1}}, {{0, 1}}, {}}),
      script("cross_the_origin", "touching from the left, passing through, touching on the right",
             cubes_in_a_row(2, -2),
             {insert(0), insert(1), query(), move(1, at(-1, 0, 0)), query(), move(1, at(-0.0, 0, -0.0)),
              query(), move(1, at(1, 0, 0)), query(), move(1, at(2, 0, 0)), query()},
             {{}, {{0, 1}}, {{0, 1}}, {{0, 1}}, {}}),
      script("empty_and_fill_again", "everything leaves and returns in another order", cubes_in_a_row(4, 1),
             {insert(0), insert(1), insert(2), insert(3), query(), remove(2), remove(0), remove(3), remove(1),
              query(), insert(3), insert(1), query(), insert(2), insert(0), query()},
             {{{0, 1}, {1, 2}, {2, 3}}, {}, {}, {{0, 1}, {1, 2}, {2, 3}}}),
      script("swap_places", "two bodies exchange their poses beside a third", cubes_in_a_row(3, 1),
             {insert(0), insert(1), insert(2), query(), move(0, at(2, 0, 0)), move(2, at(0, 0, 0)), query(),
              move(0, at(9, 0, 0)), query()},
             {{{0, 1}, {1, 2}}, {{0, 1}, {1, 2}}, {{1, 2}}}),
      script(
          "move_to_the_same_place", "a move that changes nothing but the sign of zero", cubes_in_a_row(2, 1),
          {insert(0), insert(1), query(), move(0, at(-0.0, 0, -0.0)), query(), move(1, at(1, 0, 0)), query()},
          {{{0, 1}}, {{0, 1}}, {{0, 1}}}),
      script("filters_hold", "groups and ignored pairs stay filtered through moves", with_filters(),
             {insert(0), insert(1), insert(2), insert(3), query(), move(3, at(9, 0, 0)), query(),
              move(3, at(0, 0, 0)), query()},
             {{{0, 2}, {0, 3}, {1, 2}, {1, 3}}, {{0, 2}, {1, 2}}, {{0, 2}, {0, 3}, {1, 2}, {1, 3}}},
             "all overlap when present; (0,1) is in one group, (2,3) is ignored"),
      script("turn_into_contact", "a rotation in place, exactly to touching", plank_and_cube(),
             {insert(0), insert(1), query(), move(0, at(0, 0, 0, quarter_turn_z)), query(),
              move(0, at(0, 0, 0)), query()},
             {{}, {{0, 1}}, {}}, "turned, the plank reaches y = 2, where the cube begins"),
      script("late_arrival_early_leave", "the middle of a chain is inserted last and removed first",
             cubes_in_a_row(3, 1),
             {insert(0), insert(2), query(), insert(1), query(), remove(1), query(), remove(0), remove(2),
              query()},
             {{}, {{0, 1}, {1, 2}}, {}, {}}),
      script("everything_in_one_cell", "one body moves within another's box", cubes_in_a_row(2, 0.25),
             {insert(0), insert(1), query(), move(1, at(0.5, 0.5, 0.5)), query(), move(1, at(-0.5, -0.5, 1)),
              query(), move(1, at(-0.5, -0.5, 1 + 0x1p-50)), query()},
             {{{0, 1}}, {{0, 1}}, {{0, 1}}, {}}),
      chain_grows(),
  };
}

}  // namespace touchstone::scenarios
