// How much work the referee spends on one question before it gives up. Work is counted where it is done and
// never timed, so the same question has the same answer on every machine.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>

namespace touchstone::referee {

/// A unit is about a nanosecond. The most expensive pair in the scenarios and campaigns takes a hundredth of
/// this.
inline constexpr std::int64_t default_work_limit = 20'000'000'000;

/// The note with which a public function answers when it gives up.
inline constexpr const char* too_expensive = "too expensive: beyond the limit of work";

/// Thrown by `spend`; it never leaves a public function of the referee.
struct TooExpensive {};

namespace detail {
struct Work {
  std::int64_t limit = default_work_limit;
  std::int64_t left = std::numeric_limits<std::int64_t>::max();
  bool is_metered = false;
};
inline Work& work() {
  thread_local Work w;
  return w;
}
}  // namespace detail

/// Call before work of about this many units. Work outside a question is not limited.
inline void spend(std::int64_t units) {
  detail::Work& w = detail::work();
  if (!w.is_metered) return;
  w.left -= units;
  if (w.left < 0) throw TooExpensive{};
}

/// Sets another limit for this thread during its lifetime.
class WorkLimit {
 public:
  explicit WorkLimit(std::int64_t units) : before_(std::exchange(detail::work().limit, units)) {}
  ~WorkLimit() { detail::work().limit = before_; }
  WorkLimit(const WorkLimit&) = delete;
  WorkLimit& operator=(const WorkLimit&) = delete;

 private:
  std::int64_t before_;
};

/// One question: returns the result of `answer`, or `otherwise` once the limit is exceeded. A nested question
/// counts towards the outer one.
template <class R, class F>
R within_limit(R otherwise, F&& answer) {
  detail::Work& w = detail::work();
  const bool is_outermost = !std::exchange(w.is_metered, true);
  if (is_outermost) w.left = w.limit;
  struct End {
    detail::Work& work;
    bool is_outermost;
    ~End() {
      if (is_outermost) work.is_metered = false;
    }
  } const end{w, is_outermost};
  try {
    return answer();
  } catch (const TooExpensive&) {
    return otherwise;
  }
}

}  // namespace touchstone::referee
