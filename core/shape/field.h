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
};

template <class S, class T>
Field(std::string_view, T S::*, Domain) -> Field<S, T>;

}  // namespace touchstone
