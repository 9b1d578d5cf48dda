// Which routine serves a pair: faults of one routine may have one cause.
#include "oracles/routes/routes.h"

#include "tests/support/catch.h"

using namespace touchstone;
using routes::Pair;

TEST_CASE("MuJoCo's pairs take the routes of its table of colliders", "[routes]") {
  using K = ShapeKind;
  const auto contact = [](K a, K b) { return routes::mujoco_route({Question::contact, a, b}); };
  CHECK(contact(K::cylinder, K::sphere) == "closed form");
  CHECK(contact(K::capsule, K::capsule) == "closed form");
  CHECK(contact(K::capsule, K::box) == "box-capsule");
  CHECK(contact(K::box, K::box) == "box-box");
  CHECK(contact(K::ellipsoid, K::sphere) == "convex");
  CHECK(contact(K::cylinder, K::cylinder) == "convex");
  CHECK(contact(K::half_space, K::box) == "half-space");
  // Distances of boxes go through the convex pipeline.
  CHECK(routes::mujoco_route({Question::distance, K::box, K::box}) == "convex");
}

TEST_CASE("MuJoCo's documentation disclaims depths of its legacy pipeline alone", "[routes]") {
  const auto documents = [](std::string_view engine, std::string_view route, Fault fault) {
    return !routes::mujoco_documents(engine, Question::contact, route, fault).empty();
  };
  CHECK(documents("mujoco-libccd", "convex", Fault::not_minimal));
  CHECK_FALSE(documents("mujoco-libccd", "convex", Fault::missed));
  CHECK_FALSE(documents("mujoco-libccd", "box-capsule", Fault::not_minimal));
  CHECK_FALSE(documents("mujoco", "convex", Fault::not_minimal));
}

TEST_CASE("PhysX's pairs take the routes of its tables", "[routes]") {
  using K = ShapeKind;
  const auto overlap = [](std::string_view engine, K a, K b) {
    return routes::physx_route(engine, {Question::overlap, a, b});
  };
  CHECK(overlap("physx-query", K::box, K::capsule) == "closed form");
  CHECK(overlap("physx-query", K::box, K::box) == "box-box");
  CHECK(overlap("physx-query", K::hull, K::sphere) == "convex mesh");
  CHECK(overlap("physx-sim", K::cone, K::half_space) == "convex core");
  CHECK(overlap("physx-gjk", K::cone, K::box) == "convex");  // one routine for all
  CHECK(routes::physx_route("physx-sap", {Question::candidates, K::box, K::box}) == "pairs");
}
