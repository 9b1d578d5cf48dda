#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "fuzz/causes/group.h"
#include "fuzz/causes/intervention.h"

namespace touchstone::fuzz {
namespace {

bool is_decided(Response r) { return r == Response::stays || r == Response::gone; }

// Other engines do not apply where there are none, which says nothing about the fault.
bool is_change_of_case(std::size_t i) { return i < interventions.size(); }

Response effective(const Responses& r, std::size_t i) {
  const Response response = r.responses[i].response;
  return response == Response::not_applicable && is_change_of_case(i) ? Response::stays : response;
}

double octaves_between(double x, double y) {
  if (x == y) return 0;
  if (!(x > 0) || !(y > 0) || !std::isfinite(x) || !std::isfinite(y))
    return std::numeric_limits<double>::infinity();
  return std::abs(std::log2(x / y));
}

// Whether the errors change alike. Not compared where there is no error: a verdict, a crash.
bool errors_change_alike(const Responses& x, const Responses& y, std::size_t i) {
  constexpr double octaves_apart = 4;
  for (const double error : {x.error_in_l, y.error_in_l, x.errors_in_l[i], y.errors_in_l[i]})
    if (!(error > 0) || !std::isfinite(error)) return true;
  return octaves_between(x.errors_in_l[i] / x.error_in_l, y.errors_in_l[i] / y.error_in_l) <= octaves_apart;
}

using Steps = std::array<std::size_t, 4>;  // by Step::Op

Steps steps_of(const Case& c) {
  Steps n{};
  for (const Step& s : c.scene.script) ++n[static_cast<std::size_t>(s.op)];
  return n;
}

std::set<ShapeKind> kinds_of(const Case& c) {
  std::set<ShapeKind> kinds;
  for (const Body& b : c.scene.bodies)
    kinds.insert(kind_of(c.scene.shapes[static_cast<std::size_t>(b.shape)]));
  return kinds;
}

bool have_common_fault(const Responses& x, const Responses& y) {
  return std::ranges::any_of(x.faults, [&](const std::string& f) { return y.faults.contains(f); });
}

std::size_t parts_that_differ(const Examined& a, const Examined& b) {
  const Case &x = a.shown(), &y = b.shown();
  return std::size_t{x.scene.bodies.size() != y.scene.bodies.size()} +
         std::size_t{steps_of(x) != steps_of(y)} + std::size_t{kinds_of(x) != kinds_of(y)} +
         std::size_t{!have_common_fault(a.responses, b.responses)};
}

}  // namespace

Difference difference(const Examined& a, const Examined& b) {
  const Responses &x = a.responses, &y = b.responses;
  if (x.responses.empty() || y.responses.empty()) return {};
  constexpr std::size_t parts_of_case = 4;
  std::size_t compared = parts_of_case, different = parts_that_differ(a, b);
  for (std::size_t i = 0; i < x.responses.size() && i < y.responses.size(); ++i) {
    if (x.responses[i].intervention != y.responses[i].intervention) break;
    const Response p = effective(x, i), q = effective(y, i);
    if (!is_decided(p) || !is_decided(q)) continue;
    ++compared;
    different += p != q || (p == Response::stays && !errors_change_alike(x, y, i));
  }
  return {static_cast<double>(different) / static_cast<double>(compared),
          octaves_between(x.error_in_l, y.error_in_l)};
}

Difference difference(const Representative& x, const Representative& y) {
  return difference(x.first, y.first);
}

bool is_fragile(const Responses& r) {
  std::size_t gone = 0, decided = 0;
  for (const Responded& x : r.responses) {
    decided += is_decided(x.response);
    gone += x.response == Response::gone;
  }
  return 3 * gone >= 2 * decided;
}

}  // namespace touchstone::fuzz
