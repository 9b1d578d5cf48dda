#include <algorithm>
#include <array>
#include <set>

#include "fuzz/causes/group.h"
#include "fuzz/causes/intervention.h"
#include "fuzz/causes/interventions/true_pair.h"

namespace touchstone::fuzz {
namespace {

bool is_decided(Response r) { return r == Response::stays || r == Response::gone; }

// Other engines do not apply where there are none, which says nothing about the fault.
bool is_change_of_case(std::size_t i) { return i < interventions.size(); }

Response effective(const Responses& r, std::size_t i) {
  const Response response = r.responses[i].response;
  return response == Response::not_applicable && is_change_of_case(i) ? Response::stays : response;
}

using Steps = std::array<std::size_t, 4>;  // by Step::Op

Steps steps_of(const Case& c) {
  Steps n{};
  for (const Step& s : c.scene.script) ++n[static_cast<std::size_t>(s.op)];
  return n;
}

bool is_gone(const Responses& r, std::string_view intervention) {
  return std::ranges::any_of(r.responses, [&](const Responded& x) {
    return x.intervention == intervention && x.response == Response::gone;
  });
}

// The kinds of shapes that the fault needs: those that cannot be a sphere or a cube instead.
std::set<ShapeKind> needed_kinds(const Examined& e) {
  std::set<ShapeKind> kinds;
  const auto pair = pair_of(e.shown());
  if (!pair) return kinds;
  const auto add_if_needed = [&](int body, std::string_view as_sphere, std::string_view as_cube) {
    if (is_gone(e.responses, as_sphere) || is_gone(e.responses, as_cube))
      kinds.insert(kind_of(e.shown().scene.shape_of(body)));
  };
  add_if_needed(pair->first, "a_as_sphere", "a_as_cube");
  add_if_needed(pair->second, "b_as_sphere", "b_as_cube");
  return kinds;
}

constexpr std::size_t parts_of_case = 5;
std::size_t parts_that_differ(const Examined& a, const Examined& b) {
  const Case &x = a.shown(), &y = b.shown();
  return std::size_t{x.scene.bodies.size() != y.scene.bodies.size()} +
         std::size_t{steps_of(x) != steps_of(y)} + std::size_t{needed_kinds(a) != needed_kinds(b)} +
         std::size_t{a.responses.deviation.manner != b.responses.deviation.manner} +
         std::size_t{!obey_one_law(a.responses.laws, b.responses.laws)};
}

}  // namespace

double difference(const Examined& a, const Examined& b) {
  const Responses &x = a.responses, &y = b.responses;
  if (x.responses.empty() || y.responses.empty()) return 0;
  std::size_t compared = parts_of_case, different = parts_that_differ(a, b);
  for (std::size_t i = 0; i < x.responses.size() && i < y.responses.size(); ++i) {
    if (x.responses[i].intervention != y.responses[i].intervention) break;
    const Response p = effective(x, i), q = effective(y, i);
    if (!is_decided(p) || !is_decided(q)) continue;
    ++compared;
    different += p != q;
  }
  return static_cast<double>(different) / static_cast<double>(compared);
}

double difference(const Representative& x, const Representative& y) { return difference(x.first, y.first); }

bool is_fragile(const Responses& r) {
  std::size_t gone = 0, decided = 0;
  for (const Responded& x : r.responses) {
    decided += is_decided(x.response);
    gone += x.response == Response::gone;
  }
  return 3 * gone >= 2 * decided;
}

}  // namespace touchstone::fuzz
