#include "scenarios/exhaustive/suites.h"

#include <map>
#include <mutex>
#include <tuple>

namespace touchstone::fuzz {
namespace {

struct Walk {
  int bodies, places;
  std::size_t length;
  std::vector<std::string> found = {};
  std::string done = {};
  unsigned present = 0, seen = 0;

  void go() {
    if (done.size() == length) return found.push_back(done);
    for (int b = 0; b < bodies; ++b) {
      const unsigned bit = 1U << b;
      if (b > 0 && (seen & bit) == 0 && (seen & (bit >> 1)) == 0) break;
      for (int place = 0; place < places; ++place) step(b, place, present | bit);
      if ((present & bit) != 0) step(b, places, present & ~bit);
    }
    step(bodies, 0, present);
  }
  void step(int b, int what, unsigned now) {
    const unsigned before = present, seen_before = seen;
    done.push_back(static_cast<char>(b * (places + 1) + what));
    present = now;
    seen |= now;
    go();
    done.pop_back();
    present = before;
    seen = seen_before;
  }
};

struct Course {
  int bodies, places, length;
  std::array<double, 3> at;  // places of the boxes of side 1 along the axis
  double far;                // along z the places are this many times as far apart: a move is a teleport
};

// Two separate places, or three places each touching the next.
Course course_of_two(const Draw&) { return {2, 2, 6, {-0.5, 1.5, 0}, 16}; }
Course course_of_three(const Draw& d) { return {3, 3, d.scope == Scope::quick ? 5 : 6, {-1, 0, 1}, 1}; }

const std::vector<std::string>& all_of(const Course& c) { return histories(c.bodies, c.places, c.length); }

// The index also encodes the axis and whether body 0 is fixed.
constexpr std::uint64_t variants = 2;

void play(const Course& course, std::uint64_t index, Case& out) {
  const std::string& ops = all_of(course)[index / variants];
  Scene& s = out.scene;
  for (int b = 0; b < course.bodies; ++b)
    add_box(s, {Vec3::Zero(), Vec3::Constant(0.5)}, b == 0 && index % variants == 1);
  const auto axis = static_cast<Eigen::Index>(index / variants % 3);
  std::vector<bool> present(static_cast<std::size_t>(course.bodies));
  for (const char op : ops) {
    const int body = op / (course.places + 1), what = op % (course.places + 1);
    if (body == course.bodies) {
      step_query(s);
      continue;
    }
    const auto b = static_cast<std::size_t>(body);
    if (what == course.places) {
      step_remove(s, body);
      present[b] = false;
      continue;
    }
    Pose p;
    p.translation[axis] = course.at[static_cast<std::size_t>(what)] * (axis == 2 ? course.far : 1);
    present[b] ? step_move(s, body, p) : step_insert(s, body, p);
    present[b] = true;
  }
  step_query(s);
  out.queries = {{Question::candidates, -1, -1}};
}

}  // namespace

const std::vector<std::string>& histories(int bodies, int places, int length) {
  static std::mutex guard;
  static std::map<std::tuple<int, int, int>, std::vector<std::string>> kept;
  const std::lock_guard lock(guard);
  auto& all = kept[{bodies, places, length}];
  if (all.empty()) {
    Walk w{bodies, places, static_cast<std::size_t>(length)};
    w.go();
    all = std::move(w.found);
  }
  return all;
}

std::uint64_t count_histories_of_two(const Draw& d) { return all_of(course_of_two(d)).size() * variants; }
std::uint64_t count_histories_of_three(const Draw& d) { return all_of(course_of_three(d)).size() * variants; }
void histories_of_two(const Draw& d, std::uint64_t i, Case& out) { play(course_of_two(d), i, out); }
void histories_of_three(const Draw& d, std::uint64_t i, Case& out) { play(course_of_three(d), i, out); }

}  // namespace touchstone::fuzz
