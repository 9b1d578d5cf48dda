// The engine-specific part of a reproducer; the rest is common to all engines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// The question, its bodies, and the query step of the script.
struct EngineQuestion {
  const Scene& scene;
  Question question;
  int a, b, step;
  std::string_view engine;
  const Body& body(int i) const { return scene.bodies[static_cast<std::size_t>(i)]; }
  bool tuned() const { return engine.ends_with("-tuned"); }
};

struct EngineSource {
  std::string compile;   // arguments after "g++ -std=c++17 reproduce.cpp -o reproduce"
  std::string includes;  // #include lines
  std::string code;      // defines `Answer ask()`
  /// Not empty: the program is a JavaScript module that uses this package. `includes` imports it, and `code`
  /// defines `ask()`, which returns {overlap, distance, depth, normal, impact} as far as the question asks
  /// for them, about the constant `bodies` of the program: {a, b}, each {shape, at, quaternion, rows}.
  std::string npm_package = {};
  /// Of a JavaScript module: whether it makes shapes of {type: "mesh", vertices, triangles} and, for those
  /// that are height fields (oracles/abi/height_field.h), of {type: "field", rows, columns, cell, heights}.
  bool makes_meshes = false;
  /// The points of a distance, of an `Answer x`.
  std::string point_a = "x.points[0]", point_b = "x.points[1]";
};

/// Each engine's part is in its folder, in reproducer_source.cpp, which defines `SourceWriter
/// <folder>_source_writer()`; the build finds it.
struct SourceWriter {
  /// Names of engines in the library's adapter; one that ends with a dash stands for all that begin so.
  std::vector<std::string_view> engines;
  /// Throws InputError if the engine's API does not offer the question or a shape.
  EngineSource (*write)(const EngineQuestion& q);
};

/// Sorted by folder.
std::vector<SourceWriter> source_writers();

}  // namespace touchstone::fuzz
