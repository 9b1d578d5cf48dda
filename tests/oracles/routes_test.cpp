// Which routine serves a pair: faults of one routine may have one cause.
#include "oracles/routes/routes.h"

#include "tests/support/catch.h"

using namespace touchstone;
using routes::Pair;

TEST_CASE("MuJoCo's pairs take the routes of its table of colliders", "[routes]") {
  using K = ShapeKind;
  const auto contact = [](K a, K b) { return routes::route_of("mujoco", {Question::contact, a, b}); };
  CHECK(contact(K::cylinder, K::sphere) == "closed form");
  CHECK(contact(K::capsule, K::capsule) == "closed form");
  CHECK(contact(K::capsule, K::box) == "box-capsule");
  CHECK(contact(K::box, K::box) == "box-box");
  CHECK(contact(K::ellipsoid, K::sphere) == "convex");
  CHECK(contact(K::cylinder, K::cylinder) == "convex");
  CHECK(contact(K::half_space, K::box) == "half-space");
  // Distances of boxes go through the convex pipeline.
  CHECK(routes::route_of("mujoco-single", {Question::distance, K::box, K::box}) == "convex");
}

TEST_CASE("MuJoCo's documentation disclaims depths of its legacy pipeline alone", "[routes]") {
  const auto documents = [](std::string_view engine, std::string_view route, Fault fault) {
    return !routes::documented(engine, Question::contact, route, fault).empty();
  };
  CHECK(documents("mujoco-libccd", "convex", Fault::not_minimal));
  CHECK_FALSE(documents("mujoco-libccd", "convex", Fault::missed));
  CHECK_FALSE(documents("mujoco-libccd", "box-capsule", Fault::not_minimal));
  CHECK_FALSE(documents("mujoco", "convex", Fault::not_minimal));
}

TEST_CASE("Bullet's source says that bodies that move apart have no impact", "[routes]") {
  CHECK(routes::documented_of_parting("bullet-f32-query").starts_with("btContinuousConvexCollision.cpp"));
  CHECK(routes::documented("bullet-f32-query", Question::time_of_impact, "convex", Fault::missed).empty());
  CHECK(routes::documented_of_parting("fcl-libccd").empty());
  CHECK(routes::documented_of_parting("odeon").empty());
}

TEST_CASE("PhysX's pairs take the routes of its tables", "[routes]") {
  using K = ShapeKind;
  const auto overlap = [](std::string_view engine, K a, K b) {
    return routes::route_of(engine, {Question::overlap, a, b});
  };
  CHECK(overlap("physx-query", K::box, K::capsule) == "closed form");
  CHECK(overlap("physx-query", K::box, K::box) == "box-box");
  CHECK(overlap("physx-query", K::hull, K::sphere) == "convex mesh");
  CHECK(overlap("physx-sim", K::cone, K::half_space) == "convex core");
  CHECK(overlap("physx-gjk", K::cone, K::box) == "convex");  // one routine for all
  CHECK(routes::route_of("physx-sap", {Question::candidates, K::box, K::box}) == "pairs");
}

TEST_CASE("an engine belongs to the library whose name its own begins with", "[routes]") {
  const auto name = [](std::string_view engine) {
    const routes::Library* library = routes::library_of(engine);
    return library ? library->name : "";
  };
  CHECK(name("mujoco-single") == "MuJoCo");
  CHECK(name("mujoco2") == "MuJoCo 2");
  CHECK(name("ode") == "ODE");
  CHECK(name("core-f32") == "the core");
  CHECK(name("odeon").empty());
  CHECK(name("physxx-sap").empty());
  // Of an unknown library, what is common to all.
  CHECK(routes::route_of("odeon", {Question::contact, ShapeKind::box, ShapeKind::box}) == "convex");
  CHECK(routes::documented("odeon", Question::contact, "convex", Fault::missed).empty());
}

TEST_CASE("related engines differ in one respect by name, and say so", "[routes]") {
  for (const routes::Library& library : routes::libraries())
    for (const routes::Related& r : library.related) {
      INFO(r.engines << " " << r.part << " " << r.by);
      CHECK(routes::library_of(std::string(r.engines) + (r.engines.ends_with('-') ? "x" : ""))->name ==
            library.name);
      CHECK((r.part.empty() || r.engines.find(r.part) != std::string_view::npos));
      CHECK(r.part != r.by);
      CHECK_FALSE(r.change.empty());
      CHECK_FALSE(r.if_gone.empty());
    }
}

TEST_CASE("what a scene needs is put in the terms of FCL and Bullet", "[routes]") {
  const auto terms = [](std::string_view engine, const routes::Needs& n) {
    std::string all;
    for (const std::string& line : routes::library_of(engine)->terms(n)) all += line + "\n";
    return all;
  };
  const auto has = [](const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
  };
  routes::Needs n{.error = 1e-8, .float_rounding = 1e-6, .curved = true, .travel_share = 1};
  CHECK(has(terms("fcl-libccd", n), "DynamicAABBTreeCollisionManager"));
  CHECK(has(terms("fcl-libccd", n), "distance_tolerance 1e-12"));
  CHECK(has(terms("fcl-libccd", n), "may be taken for gaps"));
  CHECK(has(terms("bullet-f32-query", n), "BT_USE_DOUBLE_PRECISION"));
  CHECK(has(terms("bullet-f32-query", n), "setMargin(0)"));
  for (const std::string_view engine : {"fcl-libccd", "bullet-f32-query"})
    CHECK_FALSE(has(terms(engine, n), "swept"));
  n = {.broad = routes::Needs::Broad::sweep,
       .error = 0.1,
       .margin = 0.25,
       .half_spaces = true,
       .turning = true,
       .travel_share = 0.5};
  CHECK(has(terms("fcl-libccd", n), "SSaPCollisionManager"));
  CHECK(has(terms("fcl-libccd", n), "Pairs within 0.25"));
  CHECK(has(terms("fcl-libccd", n), "Half-spaces: collide() only"));
  CHECK(has(terms("fcl-libccd", n), "CCDC_CONSERVATIVE_ADVANCEMENT"));
  CHECK_FALSE(has(terms("fcl-libccd", n), "may be taken for gaps"));
  CHECK(has(terms("bullet-f32-query", n), "btAxisSweep3"));
  CHECK(has(terms("bullet-f32-query", n), "setCcdMotionThreshold(0.5 * r)"));
  CHECK(has(terms("bullet-f32-query", n), "need shorter steps"));
  CHECK_FALSE(has(terms("bullet-f32-query", n), "setMargin"));
  const std::string verdicts = terms("fcl-libccd", {.verdict_only = true, .curved = true});
  CHECK(has(verdicts, "gjk_tolerance 1e-12"));
  CHECK_FALSE(has(verdicts, "Depths"));
}
