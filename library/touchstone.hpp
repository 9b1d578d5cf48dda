// touchstone.h for C++17: values instead of pointers, exceptions instead of status codes.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "touchstone.h"

namespace touchstone_c {

using Vector = std::array<double, 3>;

/// Thrown where a function of touchstone.h does not return TOUCHSTONE_OK.
class Error : public std::runtime_error {
 public:
  explicit Error(touchstone_status s) : std::runtime_error(touchstone_last_error()), status(s) {}
  touchstone_status status;
};
inline void require(touchstone_status s) {
  if (s != TOUCHSTONE_OK) throw Error(s);
}

/// Immutable; copies share it.
class Shape {
 public:
  /// "box 1 1 1", or JSON; also from a string literal.
  Shape(const std::string& text) : Shape(text.c_str()) {}
  Shape(const char* text) {
    touchstone_shape* s = nullptr;
    require(touchstone_parse_shape(text, &s));
    shape_.reset(s, touchstone_free_shape);
  }
  static Shape hull(const double* points, std::size_t n) {
    touchstone_shape* s = nullptr;
    require(touchstone_hull(points, n, &s));
    return Shape(s);
  }
  static Shape mesh(const double* points, std::size_t n, const int* triangles, std::size_t m) {
    touchstone_shape* s = nullptr;
    require(touchstone_mesh(points, n, triangles, m, &s));
    return Shape(s);
  }
  const touchstone_shape* get() const { return shape_.get(); }

 private:
  explicit Shape(touchstone_shape* s) : shape_(s, touchstone_free_shape) {}
  std::shared_ptr<const touchstone_shape> shape_;
};

/// Position x y z, quaternion x y z w; and the motion over the step, linear and angular.
struct Body {
  Shape shape;
  std::array<double, 7> pose{0, 0, 0, 0, 0, 0, 1};
  std::optional<std::array<double, 6>> motion = std::nullopt;
  const double* motion_or_null() const { return motion ? motion->data() : nullptr; }
};

inline touchstone_gap gap(const Body& a, const Body& b, double margin = 0) {
  touchstone_gap g{};
  require(touchstone_gaps(a.shape.get(), a.pose.data(), b.shape.get(), b.pose.data(), 1, margin, &g));
  return g;
}

inline touchstone_impact impact(const Body& a, const Body& b) {
  touchstone_impact t{};
  require(touchstone_impacts(a.shape.get(), a.pose.data(), a.motion_or_null(), b.shape.get(), b.pose.data(),
                             b.motion_or_null(), 1, &t));
  return t;
}

inline std::string owned(char* text) {
  const std::unique_ptr<char, void (*)(char*)> p(text, touchstone_free_text);
  return p.get();
}

/// One line of JSON with certificates.
inline std::string answer(const Body& a, const Body& b) {
  char* json = nullptr;
  require(touchstone_answer(a.shape.get(), a.pose.data(), a.motion_or_null(), b.shape.get(), b.pose.data(),
                            b.motion_or_null(), &json));
  return owned(json);
}

inline bool check(const Body& a, const Body& b, const std::string& certificate) {
  int valid = 0;
  require(touchstone_check(a.shape.get(), a.pose.data(), a.motion_or_null(), b.shape.get(), b.pose.data(),
                           b.motion_or_null(), certificate.c_str(), &valid));
  return valid != 0;
}

/// What an engine says: `Stated().distance(0.5).normal({0, 0, 1})`.
class Stated {
 public:
  Stated& overlap(bool x) { return set(TOUCHSTONE_STATES_OVERLAP, s_.overlap, x ? 1 : 0); }
  Stated& distance(double x) { return set(TOUCHSTONE_STATES_DISTANCE, s_.distance, x); }
  Stated& depth(double x) { return set(TOUCHSTONE_STATES_DEPTH, s_.depth, x); }
  Stated& normal(const Vector& n) { return copy(TOUCHSTONE_STATES_NORMAL, s_.normal, n); }
  Stated& witness(const Vector& a, const Vector& b) {
    copy(TOUCHSTONE_STATES_WITNESS, s_.witness_a, a);
    return copy(TOUCHSTONE_STATES_WITNESS, s_.witness_b, b);
  }
  Stated& impact(std::optional<double> t) {
    return set(TOUCHSTONE_STATES_IMPACT, s_.time_of_impact,
               t.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  const touchstone_stated& get() const { return s_; }

 private:
  template <class T>
  Stated& set(int what, T& to, T x) {
    s_.stated |= what;
    to = x;
    return *this;
  }
  Stated& copy(int what, double* to, const Vector& x) {
    s_.stated |= what;
    for (std::size_t i = 0; i < 3; ++i) to[i] = x[i];
    return *this;
  }
  touchstone_stated s_{};
};

/// How an answer is judged: see touchstone_judge.
struct Precision {
  double tolerance = 0;
  bool single = false;
};

/// TOUCHSTONE_RIGHT, TOUCHSTONE_WRONG, ...
inline int judge(const Body& a, const Body& b, const Stated& s, const Precision& p = {}) {
  int ruling = 0;
  require(touchstone_judge(a.shape.get(), a.pose.data(), a.motion_or_null(), b.shape.get(), b.pose.data(),
                           b.motion_or_null(), 1, &s.get(), p.tolerance, p.single, &ruling));
  return ruling;
}

/// The reasons as JSON.
inline std::string explain(const Body& a, const Body& b, const Stated& s, const Precision& p = {}) {
  char* json = nullptr;
  require(touchstone_explain(a.shape.get(), a.pose.data(), a.motion_or_null(), b.shape.get(), b.pose.data(),
                             b.motion_or_null(), &s.get(), p.tolerance, p.single, &json));
  return owned(json);
}

}  // namespace touchstone_c
