// Fragments of C++ source that every reproducer needs.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "core/scene/scene.h"

namespace touchstone::fuzz {

/// The text with each @NAME@ replaced. Throws std::logic_error if the text does not contain the name.
std::string filled(std::string_view text,
                   std::initializer_list<std::pair<std::string_view, std::string>> values);

/// The double as a literal that round-trips; "INFINITY" and "NAN" from <cmath>.
std::string literal(double x);
std::string literals(const Vec3& v);  // "x, y, z"
/// "{{r00, r01, r02, r10, ..., r22}, {x, y, z}}": rotation by rows, translation.
std::string pose_literal(const Pose& p);

/// A function `Vec support_<name>(Vec d)`: the support mapping of the placed body, in the world frame. Empty
/// for a half-space, which is unbounded, and for a mesh, which is not convex.
std::string support_function(std::string_view name, const Shape& shape, const Pose& pose);
bool has_support(const Shape& shape);

/// A description such as "box of half extents 1, 2, 3", for comments.
std::string describe(const Shape& shape);

}  // namespace touchstone::fuzz
