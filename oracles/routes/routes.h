// What is known of a library beyond its engines' cards: which routine it chooses for a question about two
// shapes, which of its faults its documentation states, which of its engines differ in one respect, and what
// a plan is in its classes and settings. Faults on one route may have one cause. Each library's part is in
// its folder, in routes.cpp, which defines `Library <folder>_library()`; the build finds it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// The respect in which two engines of a library differ.
enum class Respect {
  settings,    // as shipped or tuned
  tighter,     // tolerances
  looser,      // tolerances
  iterations,  // their limit
  precision,   // of the numbers
  solver,      // another algorithm of the library
  path,        // another interface of the library, such as that of its simulation
};

/// A way to put a question differently: the other engine's name is that of the engine with `part` replaced by
/// `by` (appended if `part` is empty).
struct Related {
  std::string_view engines;  // those whose names begin so
  std::string_view part, by;
  Respect respect;
  std::string_view change;   // for people: "asked in double precision"
  std::string_view if_gone;  // what it means when a fault vanishes by it
  /// Questions that the other engine answers by another call of the library, so that a fault that vanishes
  /// says nothing about the change.
  std::vector<Question> other_calls = {};
};

/// Engines whose names begin with `begins` share their code with that whose name begins with `code` instead.
struct SameCode {
  std::string_view begins, code;
};

/// What `touchstone plan` found that a scene needs, to be put in a library's own terms. Lengths in the
/// scene's unit.
struct Needs {
  enum class Broad { tree, sweep, all_pairs };
  Broad broad = Broad::tree;
  double error = 0;           // of gaps and depths
  double float_rounding = 0;  // of the largest coordinate, when it is stored as a float
  double margin = 0;          // pairs this near are reported
  bool verdict_only = false;  // no gaps and depths
  bool curved = false, half_spaces = false, surfaces = false;  // shapes among the pairs; surfaces: meshes
  bool travel = false, turning = false;                        // why bodies must be swept; neither: none must
  double travel_share = 0;  // bodies that move farther in a step than this times their inner radius are swept
};

/// Engines are given by the names that they have in the library's adapter.
struct Library {
  std::string_view name;    // for people
  std::string_view prefix;  // its engines: this name, and those that begin with it and a dash
  /// The routine, as a word: "sphere", "box-box", "convex", "mesh".
  std::string_view (*route)(std::string_view engine, const Pair& p);
  /// Where the library's documentation states that its answers have this fault; empty: nowhere. Null: there
  /// is no such fault.
  std::string_view (*documents)(std::string_view engine, Question question, std::string_view route,
                                Fault fault) = nullptr;
  std::vector<Related> related = {};
  std::vector<SameCode> same_code = {};
  /// Where the library's documentation states that impacts of bodies that are in contact at the start and
  /// move apart are not reported; empty: nowhere.
  std::string_view parting = {};
  /// The library's classes, functions and settings that give what a scene needs, a sentence or two each.
  /// Null: not known.
  std::vector<std::string> (*terms)(const Needs& n) = nullptr;
};

/// Those that have a part in their folder, sorted by folder.
std::vector<Library> libraries();

/// The library of an engine; null if nothing is known of it.
const Library* library_of(std::string_view engine);

/// The routine that the engine's library chooses; common_route() if nothing is known of the library.
std::string_view route_of(std::string_view engine, const Pair& p);
/// As Library::documents; empty if nothing is known of the library.
std::string_view documented(std::string_view engine, Question question, std::string_view route, Fault fault);
/// As Library::parting; empty if nothing is known of the library.
std::string_view documented_of_parting(std::string_view engine);

/// By what any library must tell apart.
std::string_view common_route(const Pair& p);

}  // namespace touchstone::routes
