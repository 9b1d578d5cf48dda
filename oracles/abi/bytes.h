// Little-endian serialisation. A Reader never trusts a length: it checks it against the bytes that are left
// before anything is allocated.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/math/pose.h"

namespace touchstone::protocol {

static_assert(std::endian::native == std::endian::little,
              "harness and worker run on the same little-endian machine");

/// The bytes are not a message of this protocol.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Writer {
 public:
  explicit Writer(std::string& out) : out_(out) {}
  template <class T>
  requires std::is_arithmetic_v<T> Writer& put(T v) {
    out_.append(reinterpret_cast<const char*>(&v), sizeof v);
    return *this;
  }
  Writer& put(const Vec3& v) { return put(v.x()).put(v.y()).put(v.z()); }
  Writer& put(const Quat& q) { return put(q.x).put(q.y).put(q.z).put(q.w); }
  Writer& text(std::string_view s) {
    put(static_cast<std::uint32_t>(s.size()));
    out_.append(s);
    return *this;
  }
  Writer& count(std::size_t n) { return put(static_cast<std::uint32_t>(n)); }

 private:
  std::string& out_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  requires std::is_arithmetic_v<T> T get() {
    need(sizeof(T));
    T v;
    std::memcpy(&v, rest_.data(), sizeof v);
    rest_.remove_prefix(sizeof v);
    return v;
  }
  Vec3 vec3() {
    const double x = get<double>(), y = get<double>(), z = get<double>();
    return {x, y, z};
  }
  Quat quat() {
    const double x = get<double>(), y = get<double>(), z = get<double>(), w = get<double>();
    return {x, y, z, w};
  }
  std::string text() {
    const std::size_t n = count(1);
    std::string s(rest_.substr(0, n));
    rest_.remove_prefix(n);
    return s;
  }
  /// The length of a list whose items take at least `item_bytes` each.
  std::size_t count(std::size_t item_bytes) {
    const std::size_t n = get<std::uint32_t>();
    if (n > rest_.size() / item_bytes) throw Malformed("a length exceeds the message");
    return n;
  }
  /// A tag below `limit`.
  std::uint8_t tag(std::uint8_t limit) {
    const auto t = get<std::uint8_t>();
    if (t >= limit) throw Malformed("an unknown tag");
    return t;
  }
  bool flag() { return tag(2) != 0; }
  void finish() const {
    if (!rest_.empty()) throw Malformed("trailing bytes");
  }

 private:
  void need(std::size_t n) const {
    if (rest_.size() < n) throw Malformed("the message ends early");
  }
  std::string_view rest_;
};

}  // namespace touchstone::protocol
