// How much work the referee does on one question before it leaves it open. Work is counted where it is done
// and never timed, so that the same question has the same answer on every machine.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>

namespace touchstone::referee {

/// A unit is about a nanosecond. The dearest pair of the scenarios and of the campaigns takes a hundredth of
/// this.
inline constexpr std::int64_t most_work = 20'000'000'000;

/// What a public function says in a note instead of an answer.
inline constexpr const char* too_expensive =
    "too expensive: beyond the limit of work";

/// Thrown by `spend`; it never leaves a public function of the referee.
struct TooExpensive {};

namespace detail {
struct Work {
  std::int64_t limit = most_work;
  std::int64_t left = std::numeric_limits<std::int64_t>::max();
  bool is_metered = false;
};
inline Work& work() {
  thread_local Work w;
  return w;
}
}  // namespace detail

/// Before work of about this many units. Work outside of a question is not limited.
inline void spend(std::int64_t units) {
  detail::Work& w = detail::work();
  if (!w.is_metered) return;
  w.left -= units;
  if (w.left < 0) throw TooExpensive{};
}

/// Another limit for this thread, while it lives.
class WorkLimit {
 public:
  explicit WorkLimit(std::int64_t units) : before_(std::exchange(detail::work().limit, units)) {}
  ~WorkLimit() { detail::work().limit = before_; }
  WorkLimit(const WorkLimit&) = delete;
  WorkLimit& operator=(const WorkLimit&) = delete;

 private:
  std::int64_t before_;
};

/// One question: what `answer` returns, or `otherwise` once the limit is passed. A question within another is
/// part of that.
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
