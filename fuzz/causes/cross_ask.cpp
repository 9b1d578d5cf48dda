// Which engines of one path are right about each other's cases.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "fuzz/causes/group.h"
#include "fuzz/causes/respond.h"

namespace touchstone::fuzz {
namespace {

// Errors of one law in one case, but for roundings; or of faults that have none.
bool is_same_error(const Deviation& x, const Deviation& y) {
  constexpr double same_within = 0.1;  // relative
  return x.manner == y.manner &&
         std::abs(x.error - y.error) <= same_within * std::max(std::abs(x.error), std::abs(y.error));
}

class CrossAsking {
 public:
  CrossAsking(const GroupInput& in, EnginePool& pool) : in_(in), pool_(pool) {}

  bool is_to_be_divided(const Group& g) const {
    if (!g.documented.empty()) return false;
    const auto noise = in_.noise.find(in_.classes[at(g.members.front()).of_class].path);
    return noise == in_.noise.end() || is_exact(noise->second);
  }

  // Every engine of the group's members, and the part that it is in.
  std::map<std::string, std::size_t> parts(const Group& g) {
    std::map<std::string, std::vector<std::size_t>> shown;
    for (const std::size_t m : g.members)
      if (at(m).asked && at(m).first.responses.shown) shown[at(m).finding->engine].push_back(m);
    std::map<std::string, std::size_t> part;
    std::size_t n = 0;
    for (const auto& [engine, members] : shown) {
      const auto same = std::ranges::find_if(part, [&](const auto& other) {
        return show_each_other(engine, members, other.first, shown.at(other.first));
      });
      const std::size_t of = same == part.end() ? n++ : same->second;
      part.emplace(engine, of);
    }
    return part;
  }

 private:
  using Members = std::vector<std::size_t>;
  const Representative& at(std::size_t i) const { return in_.representatives[i]; }

  bool shows(const std::string& engine, std::size_t m) {
    const auto [known, is_new] = known_.try_emplace({engine, m}, false);
    if (!is_new) return known->second;
    const Examined& e = at(m).first;
    const auto found = shown_by(engine, e.shown(), at(m).symptom, pool_);
    known->second = found && is_same_error(*found, e.responses.deviation);
    return known->second;
  }
  bool show_each_other(const std::string& x, const Members& of_x, const std::string& y, const Members& of_y) {
    return std::ranges::any_of(of_x, [&](std::size_t m) { return shows(y, m); }) &&
           std::ranges::any_of(of_y, [&](std::size_t m) { return shows(x, m); });
  }

  const GroupInput& in_;
  EnginePool& pool_;
  std::map<std::pair<std::string, std::size_t>, bool> known_;
};

// The parts of one group.
class Division {
 public:
  explicit Division(std::map<std::string, std::size_t> part) : part_(std::move(part)) {}

  std::vector<Group> of(const Group& g, std::span<const Representative> all) {
    const auto engine = [&](std::size_t m) { return all[m].finding->engine; };
    for (const std::size_t m : g.members) groups_[part_of(engine(m))].members.push_back(m);
    for (const std::size_t m : g.consequences) nearest(engine(m)).consequences.push_back(m);
    for (const Finding* f : g.explained) nearest(f->engine).explained.push_back(f);
    std::vector<Group> parts;
    for (auto& [k, part] : groups_) {
      part.documented = g.documented;
      if (groups_.size() > 1) part.shown_only_by = engines_of(k);
      parts.push_back(std::move(part));
    }
    return parts;
  }

 private:
  std::size_t part_of(const std::string& engine) const {
    const auto found = part_.find(engine);
    return found == part_.end() ? 0 : found->second;
  }
  // That of the engine, if it has a member.
  Group& nearest(const std::string& engine) {
    const auto found = groups_.find(part_of(engine));
    return found == groups_.end() ? groups_.begin()->second : found->second;
  }
  std::string engines_of(std::size_t k) const {
    std::string all;
    for (const auto& [engine, part] : part_)
      if (part == k) all += engine + " ";
    return all;
  }

  std::map<std::string, std::size_t> part_;
  std::map<std::size_t, Group> groups_;
};

}  // namespace

std::vector<Group> told_apart(std::vector<Group> groups, const GroupInput& in, EnginePool& pool) {
  CrossAsking asking(in, pool);
  std::vector<Group> all;
  for (Group& g : groups) {
    if (!asking.is_to_be_divided(g)) {
      all.push_back(std::move(g));
      continue;
    }
    for (Group& part : Division(asking.parts(g)).of(g, in.representatives)) all.push_back(std::move(part));
  }
  return all;
}

}  // namespace touchstone::fuzz
