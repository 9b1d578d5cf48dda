// A table with a row for each ordered pair of shape types, filled by types and read by kinds.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "core/shape/shape.h"

namespace touchstone::narrow {

/// Position of the type S in Shape.
template <class S>
inline constexpr std::size_t index_of = [] {
  constexpr auto is_s =
      touchstone::detail::per_shape([]<class T>(std::type_identity<T>) { return std::is_same_v<S, T>; });
  return static_cast<std::size_t>(std::ranges::find(is_s, true) - is_s.begin());
}();

/// A default Row is empty and converts to false. Where the cell (A, B) is empty, the row of (B, A) serves the
/// pair, mirrored; where both are empty, the pair is unsupported.
template <class Row>
class PairTable {
 public:
  struct Entry {
    const Row& row;
    bool mirrored;
  };

  /// of.template row<A, B>(): the row for two types that no call of set() names.
  template <class Of>
  constexpr explicit PairTable(const Of& of)
      : rows_(touchstone::detail::per_shape([&]<class A>(std::type_identity<A>) {
          return touchstone::detail::per_shape(
              [&]<class B>(std::type_identity<B>) { return of.template row<A, B>(); });
        })) {}

  template <class A, class B>
  constexpr void set(const Row& row) {
    rows_[index_of<A>][index_of<B>] = row;
  }

  constexpr Entry find(std::size_t a, std::size_t b) const {
    const bool mirrored = !rows_[a][b];
    return {mirrored ? rows_[b][a] : rows_[a][b], mirrored};
  }

 private:
  std::array<std::array<Row, shape_kind_count>, shape_kind_count> rows_;
};

}  // namespace touchstone::narrow
