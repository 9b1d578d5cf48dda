// Which routine a library chooses for a question about two shapes, and which of its faults its documentation
// states: faults on one route may have one cause. Each library's part is in its folder.
#pragma once

#include <string_view>

#include "scenarios/value/case.h"
#include "scenarios/value/judgement.h"

namespace touchstone::routes {

/// A question about two shapes, whatever their order.
struct Pair {
  Question question;
  ShapeKind a, b;
  bool has(ShapeKind k) const { return a == k || b == k; }
  bool is(ShapeKind x, ShapeKind y) const { return (a == x && b == y) || (a == y && b == x); }
};

/// The routine, as a word: "sphere", "box-box", "convex", "mesh".
std::string_view fcl_route(const Pair& p);
std::string_view bullet_route(const Pair& p, bool simulates);
std::string_view libccd_route(const Pair& p);
std::string_view ode_route(const Pair& p);
std::string_view mujoco_route(const Pair& p);
std::string_view physx_route(std::string_view engine, const Pair& p);
/// `engine`: a name of the adapter's.
std::string_view dart_route(std::string_view engine, const Pair& p);
std::string_view mujoco2_route(const Pair& p);
/// For a library of which nothing is known: by what any library must tell apart.
std::string_view common_route(const Pair& p);

/// Where the library's documentation states that its answers have this fault; empty: nowhere. `fault` is a
/// name of judgement.h, `engine` that of a catalogued engine.
std::string_view fcl_documents(std::string_view engine, Question question, std::string_view route,
                               Fault fault);
std::string_view libccd_documents(std::string_view engine, Question question, std::string_view route,
                                  Fault fault);

std::string_view mujoco_documents(std::string_view engine, Question question, std::string_view route,
                                  Fault fault);

}  // namespace touchstone::routes
