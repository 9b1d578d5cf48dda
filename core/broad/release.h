// Memory that is given back: what a query no longer needs when it is over, if it is much.
#pragma once

#include <cstddef>
#include <vector>

namespace touchstone::broad {

/// Less is kept for the next query, which would only ask for it again.
inline constexpr std::size_t little_memory = std::size_t{1} << 16;  // bytes

template <class T>
void release(std::vector<T>& v) {
  if (v.capacity() * sizeof(T) > little_memory) std::vector<T>().swap(v);
}

/// Gives back what is beyond the size, if it is more than one part in 16.
template <class T>
void trim(std::vector<T>& v) {
  const std::size_t spare = v.capacity() - v.size();
  if (spare > v.size() / 16 && spare * sizeof(T) > little_memory) v.shrink_to_fit();
}

/// A vector that must grow takes what it is asked for; resize() alone may take twice what it has.
template <class T>
void resize_exactly(std::vector<T>& v, std::size_t n) {
  v.reserve(n);
  v.resize(n);
}

/// Room for one more; grows by a quarter, not to the double.
template <class T>
void make_room(std::vector<T>& v) {
  if (v.size() == v.capacity()) v.reserve(v.size() + v.size() / 4 + 16);
}

}  // namespace touchstone::broad
