// Pieces of C++ that every reproducer needs.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "core/scene/scene.h"

namespace touchstone::fuzz {

/// The text with each @NAME@ replaced. Throws std::logic_error for a name that the text does not have.
std::string filled(std::string_view text,
                   std::initializer_list<std::pair<std::string_view, std::string>> values);

/// The double as a literal that reads back as itself; "INFINITY", "NAN" from <cmath>.
std::string literal(double x);
std::string literals(const Vec3& v);  // "x, y, z"
/// "{{r00, r01, r02, r10, ..., r22}, {x, y, z}}": rotation by rows, translation.
std::string pose_literal(const Pose& p);

/// A function `Vec support_<name>(Vec d)`: a point of the placed body farthest along d, world frame. Empty
/// for a half-space or a mesh, which have no such function or are not convex.
std::string support_function(std::string_view name, const Shape& shape, const Pose& pose);
bool has_support(const Shape& shape);

/// "box 1 x 2 x 3 (half extents)" and the like, for comments.
std::string in_words(const Shape& shape);

}  // namespace touchstone::fuzz
