#include "fuzz/causes/group.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "fuzz/judge/relation.h"

namespace touchstone::fuzz {
namespace {

class Grouping {
 public:
  explicit Grouping(const GroupInput& in) : in_(in) {
    for (const FindingClass& c : in.classes) places_.insert({c.path, c.symptom.question, c.symptom.stage});
  }

  std::vector<Group> run() {
    std::vector<std::size_t> order(in_.representatives.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // The clearest first: they lead the groups that the others join.
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t x, std::size_t y) { return clarity(x) > clarity(y); });
    std::vector<std::size_t> following, contradictions;
    for (const std::size_t i : order) {
      if (is_relation(at(i).finding->fault))
        contradictions.push_back(i);
      else if (earlier_symptom(i))
        following.push_back(i);
      else
        join_or_found(i);
    }
    merge_single_responses();
    for (const std::size_t i : following) follow(i);
    for (const std::size_t i : contradictions) explain(i);
    return std::move(groups_);
  }

 private:
  using Place = std::tuple<std::string, Question, FaultStage>;

  const Representative& at(std::size_t i) const { return in_.representatives[i]; }
  const FindingClass& class_of(std::size_t i) const { return in_.classes[at(i).of_class]; }
  const Symptom& symptom(std::size_t i) const { return at(i).symptom; }
  bool is_usable(std::size_t i) const { return at(i).asked && at(i).first.responses.shown; }

  // Shown and not fragile first, then by the number of wrong answers.
  std::pair<int, std::uint64_t> clarity(std::size_t i) const {
    const int clear = is_usable(i) ? (is_fragile(at(i).first.responses) ? 1 : 2) : 0;
    std::uint64_t count = 0;
    for (const Finding* f : at(i).stands_for) count += f->count;
    return {clear, count};
  }

  // The earliest stage before its own at which the engine is wrong about the same bodies, in a class that
  // exists.
  std::optional<Symptom> earlier_symptom(std::size_t i) const {
    if (symptom(i).stage <= FaultStage::state) return std::nullopt;
    std::optional<Symptom> earliest;
    for (const Symptom& s : at(i).first.responses.also) {
      if (s.stage <= FaultStage::state || s.stage >= symptom(i).stage) continue;
      if (!places_.contains({class_of(i).path, s.question, s.stage})) continue;
      if (!earliest || s.stage < earliest->stage) earliest = s;
    }
    return earliest;
  }

  std::string documented(std::size_t i) const {
    const Finding& f = *at(i).finding;
    const auto fault = std::find(fault_names.begin(), fault_names.end(), f.fault);
    if (fault == fault_names.end()) return "";
    return in_.knowledge.documented(f.engine, symptom(i), class_of(i).route,
                                    static_cast<Fault>(fault - fault_names.begin()), class_of(i).parting);
  }

  double noise(const std::string& path) const {
    const auto found = in_.noise.find(path);
    return found == in_.noise.end() ? 0 : found->second;
  }
  bool are_exact(std::size_t i, std::size_t j) const {
    return is_exact(noise(class_of(i).path)) && is_exact(noise(class_of(j).path));
  }
  // Twice the usual difference is allowed: one in four pairs of one cause exceeds the usual one.
  bool respond_alike(std::size_t i, std::size_t j) const {
    const double d = difference(at(i), at(j));
    if (are_exact(i, j)) return d == 0;
    return d <= 2 * std::max(noise(class_of(i).path), noise(class_of(j).path));
  }
  // Reduced to one case, up to symmetry and precision.
  bool is_same_case(std::size_t i, std::size_t j) const {
    return is_usable(i) && is_usable(j) && at(i).first.canonical == at(j).first.canonical &&
           at(i).first.responses.deviation.manner == at(j).first.responses.deviation.manner;
  }
  // One of them is right when asked in the other precision, the other is not.
  bool differ_in_precision(std::size_t i, std::size_t j) const {
    const auto of = [&](std::size_t k) {
      for (const Responded& r : at(k).first.responses.responses)
        if (r.intervention == other_precision) return r.response;
      return Response::not_applicable;
    };
    const Response x = of(i), y = of(j);
    return (x == Response::gone && y == Response::stays) || (x == Response::stays && y == Response::gone);
  }

  // One place in the library's code, whatever was asked.
  bool is_same_site(std::size_t i, std::size_t j) const {
    if (symptom(i).stage != FaultStage::failure || symptom(i).detail != symptom(j).detail) return false;
    return class_of(i).route == "any" && class_of(j).route == "any" && is_same_library(i, j);
  }
  bool is_same_library(std::size_t i, std::size_t j) const {
    const std::string &x = class_of(i).path, &y = class_of(j).path;
    return x.substr(0, x.find('-')) == y.substr(0, y.find('-'));
  }

  // Another path of the library shows the fault in the same case, so that the code is shared.
  bool stays_in(std::size_t i, const std::string& path) const {
    for (const OtherEngine& other : in_.knowledge.others(at(i).finding->engine)) {
      if (in_.knowledge.path_of(other.engine) != path) continue;
      for (const Responded& r : at(i).first.responses.responses)
        if (r.intervention == other.name && r.response == Response::stays) return true;
    }
    return false;
  }
  bool shares_code(std::size_t i, std::size_t j) const {
    const std::string &x = class_of(i).path, &y = class_of(j).path;
    return x == y || (stays_in(i, y) && stays_in(j, x));
  }

  // A fault of every route comes before the routes divide: it is about as frequent on each.
  bool is_of_all_routes(std::size_t i, std::size_t j) const {
    const double x = in_.rates[at(i).of_class], y = in_.rates[at(j).of_class];
    return std::min(x, y) > 0 && std::max(x, y) <= 2 * std::min(x, y);
  }

  // Where responses of one cause are equal, a cause may be of several routes; elsewhere, that responses of
  // two routes are alike is chance.
  bool may_share_route(std::size_t i, std::size_t j) const {
    if (class_of(i).route == class_of(j).route || symptom(i).stage == FaultStage::state) return true;
    return are_exact(i, j) && ((is_usable(i) && is_usable(j)) || is_of_all_routes(i, j));
  }

  // Another question about the same bodies has the same fault.
  bool is_same_question(std::size_t i, std::size_t j) const {
    if (symptom(i).question == symptom(j).question) return true;
    const auto shows = [](const Representative& r, const Symptom& s) {
      return r.first.responses.also.contains({s.question, s.stage, ""});
    };
    return shows(at(i), symptom(j)) && shows(at(j), symptom(i));
  }

  bool have_one_cause(std::size_t i, std::size_t j) const {
    if (is_same_site(i, j)) return true;
    if (symptom(i).stage != symptom(j).stage || symptom(i).detail != symptom(j).detail) return false;
    if (differ_in_precision(i, j)) return false;
    if (is_same_case(i, j) && is_same_library(i, j) && respond_alike(i, j)) return true;
    if (!shares_code(i, j) || !is_same_question(i, j)) return false;
    return may_share_route(i, j) && respond_alike(i, j);
  }

  // Asked alone, neither case shows its fault: as far as anyone can see, one cause.
  bool are_silent_alike(std::size_t i, std::size_t j) const {
    return !is_usable(i) && !is_usable(j) && is_same_library(i, j) &&
           class_of(i).route == class_of(j).route && symptom(i) == symptom(j);
  }

  // A case that proves nothing about its cause joins the first group of its class; where responses are exact,
  // the first one whose cases prove nothing either.
  bool fits(std::size_t i, const Group& g) const {
    const std::size_t leader = g.members.front();
    const std::string why = documented(i);
    if (why != g.documented) return false;
    if (!why.empty()) return shares_code(i, leader) || is_same_library(i, leader);
    if (have_one_cause(leader, i)) return true;
    const bool exact = is_exact(noise(class_of(i).path));
    if (is_usable(i) && (exact || !is_fragile(at(i).first.responses))) return false;
    if (exact && is_usable(leader)) return false;  // what shows when asked alone has another cause
    return std::ranges::any_of(
        g.members, [&](std::size_t m) { return at(m).of_class == at(i).of_class || are_silent_alike(m, i); });
  }

  void join_or_found(std::size_t i) {
    for (Group& g : groups_)
      if (fits(i, g)) {
        g.members.push_back(i);
        return;
      }
    Group g;
    g.members = {i};
    g.documented = documented(i);
    groups_.push_back(std::move(g));
  }

  std::uint64_t wrong(const Group& g) const {
    std::uint64_t n = 0;
    for (const std::size_t m : g.members)
      for (const Finding* f : at(m).stands_for) n += f->count;
    return n;
  }

  // The most frequent other group with a member of the class.
  Group* largest_of_class(std::size_t of_class, const Group& besides) {
    Group* best = nullptr;
    for (Group& g : groups_) {
      if (&g == &besides || g.documented != besides.documented) continue;
      if (std::ranges::none_of(g.members, [&](std::size_t m) { return at(m).of_class == of_class; }))
        continue;
      if (!best || wrong(g) > wrong(*best)) best = &g;
    }
    return best;
  }

  // Where the responses of one cause differ by chance, one response that is unlike the others of its class is
  // no evidence of another cause; two alike are.
  void merge_single_responses() {
    for (Group& g : groups_) {
      if (g.members.size() != 1 || is_exact(noise(class_of(g.members[0]).path))) continue;
      Group* to = largest_of_class(at(g.members[0]).of_class, g);
      if (!to) continue;
      to->members.push_back(g.members[0]);
      g.members.clear();
    }
    std::erase_if(groups_, [](const Group& g) { return g.members.empty(); });
  }

  // Joins, as a consequence, the group of the same path and route that has the earlier symptom; if there is
  // only one on other routes, that; else it stands by itself.
  void follow(std::size_t i) {
    const Symptom s = *earlier_symptom(i);
    Group* best = nullptr;
    double least = 2;
    for (Group& g : groups_)
      for (const std::size_t m : g.members) {
        if (class_of(m).path != class_of(i).path || symptom(m).stage != s.stage) continue;
        if (folded(symptom(m).question) != s.question) continue;
        const double d = difference(at(m), at(i)) + (class_of(m).route == class_of(i).route ? 0 : 1);
        if (d >= least) continue;
        least = d;
        best = &g;
      }
    if (best)
      best->consequences.push_back(i);
    else
      join_or_found(i);
  }

  // How likely it is that a group's member explains a contradiction, where responses vary by chance: the same
  // fault, the same engine, the same shapes. Negative: not at all.
  int explains(std::size_t m, std::size_t i) const {
    if (class_of(m).path != class_of(i).path || symptom(m).question != symptom(i).question) return -1;
    if (class_of(m).route != class_of(i).route && class_of(m).route != "any") return -1;
    const Finding &x = *at(m).finding, &y = *at(i).finding;
    return 4 * (symptom(m).stage == symptom(i).stage && symptom(m).detail == symptom(i).detail) +
           2 * (x.engine == y.engine) + (x.shapes == y.shapes);
  }

  // A contradiction is evidence of the cause whose fault it shows; a cause of its own if there is none.
  void explain(std::size_t i) {
    Group* best = nullptr;
    int most = -1;
    for (Group& g : groups_)
      for (const std::size_t m : g.members) {
        const bool alike = have_one_cause(m, i);
        if (!alike && is_exact(noise(class_of(i).path))) continue;
        const int likely = explains(m, i) + (alike ? 8 : 0);
        if (likely <= most) continue;
        most = likely;
        best = &g;
      }
    if (best)
      best->explained.insert(best->explained.end(), at(i).stands_for.begin(), at(i).stands_for.end());
    else
      join_or_found(i);
  }

  const GroupInput& in_;
  std::set<Place> places_;
  std::vector<Group> groups_;
};

}  // namespace

std::vector<Group> grouped(const GroupInput& in) { return Grouping(in).run(); }

}  // namespace touchstone::fuzz
