// Releases large buffers that are not needed after a query.
#pragma once

#include <cstddef>
#include <vector>

namespace touchstone::broad {

/// Smaller buffers are kept for the next query, which would only allocate them again.
inline constexpr std::size_t little_memory = std::size_t{1} << 16;  // bytes

template <class T>
void release(std::vector<T>& v) {
  if (v.capacity() * sizeof(T) > little_memory) std::vector<T>().swap(v);
}

/// Releases spare capacity when it is more than 1/16 of the size.
template <class T>
void trim(std::vector<T>& v) {
  const std::size_t spare = v.capacity() - v.size();
  if (spare > v.size() / 16 && spare * sizeof(T) > little_memory) v.shrink_to_fit();
}

/// A vector that must grow allocates exactly n; resize() alone may double the capacity.
template <class T>
void resize_exactly(std::vector<T>& v, std::size_t n) {
  v.reserve(n);
  v.resize(n);
}

/// Ensures room for one more element; grows by a quarter instead of doubling.
template <class T>
void make_room(std::vector<T>& v) {
  if (v.size() == v.capacity()) v.reserve(v.size() + v.size() / 4 + 16);
}

}  // namespace touchstone::broad
