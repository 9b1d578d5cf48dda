// A shape lists its numeric fields in a table. Codec, hash, validation, generator and shrinker all read that
// table.
#pragma once

#include <string_view>

namespace touchstone {

enum class Domain {
  any,           // finite
  non_negative,  // a size; zero gives a flat but meaningful closed set
  positive,
  nonzero_vector
};

template <class S, class T>
struct Field {
  std::string_view name;
  T S::*member;
  Domain domain;

  constexpr auto& of(auto& shape) const { return shape.*member; }
};

template <class S, class T>
Field(std::string_view, T S::*, Domain) -> Field<S, T>;

/// A field of a shape that is a member of another.
template <class Outer, class S, class T>
struct InnerField {
  S Outer::*inner;
  T S::*member;
  std::string_view name;
  Domain domain;

  constexpr InnerField(S Outer::*in, const Field<S, T>& f)
      : inner(in), member(f.member), name(f.name), domain(f.domain) {}
  constexpr auto& of(auto& shape) const { return shape.*inner.*member; }
};

}  // namespace touchstone
