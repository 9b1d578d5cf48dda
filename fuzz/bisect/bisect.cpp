#include "fuzz/bisect/bisect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "core/base/input_error.h"
#include "fuzz/judge/truth.h"
#include "fuzz/shrink/reductions.h"
#include "scenarios/codec/case_codec.h"

namespace touchstone::fuzz {
namespace {

bool shows_one(const StillShows& shows, const Case& c) { return shows({&c, 1}).front(); }

const ListPart& bodies_part() {
  for (const ListPart& p : list_parts())
    if (p.name == "bodies") return p;
  throw std::logic_error("the reductions have no list of bodies");
}

// The case with its script cut after the k-th query.
Case up_to_query(const Case& c, int k) {
  Case r = c;
  r.scene.script.clear();
  int seen = 0;
  for (const Step& s : c.scene.script) {
    r.scene.script.push_back(s);
    if (s.op == Step::Op::query && seen++ == k) break;
  }
  return r;
}

int queries_of(const Scene& s) {
  return static_cast<int>(
      std::count_if(s.script.begin(), s.script.end(), [](const Step& x) { return x.op == Step::Op::query; }));
}

std::vector<Step> changes_before(const Scene& s, int query) {
  std::vector<Step> changes;
  int seen = 0;
  for (const Step& x : s.script) {
    if (x.op != Step::Op::query)
      changes.push_back(x);
    else if (seen++ == query)
      return changes;
    else
      changes.clear();
  }
  return changes;
}

struct StageRow {
  std::string_view name;
  bool (*belongs)(const Finding& f);
};

bool is_verdict(const Finding& f) { return f.fault == "missed" || f.fault == "ghost"; }
bool is_answer(const Finding& f) {
  static const std::set<std::string> faults(fault_names.begin(), fault_names.end());
  return faults.contains(f.fault);
}

// In the order in which an engine passes through them: the first faulty stage is the place to look.
constexpr StageRow stages[] = {
    {"representation", [](const Finding& f) { return f.blame == "representation"; }},
    {"failure", [](const Finding& f) { return !is_answer(f); }},
    {"broad phase", [](const Finding& f) { return f.question == "candidates"; }},
    {"overlap", [](const Finding& f) { return f.question == "overlap"; }},
    {"simplex (distance)", [](const Finding& f) { return f.question == "distance"; }},
    {"contact verdict",
     [](const Finding& f) { return f.question == "contact" && (is_verdict(f) || f.fault == "no_number"); }},
    {"normal",
     [](const Finding& f) {
       return f.question == "contact" &&
              (f.fault == "normal_not_unit" || f.fault == "not_minimal" || f.fault == "inner_edge");
     }},
    {"depth",
     [](const Finding& f) {
       return f.question == "contact" && (f.fault == "infeasible" || f.fault == "depth_excess");
     }},
    {"manifold",
     [](const Finding& f) {
       return f.question == "contact" &&
              (f.fault == "point_off" || f.fault == "point_depth" || f.fault == "incomplete");
     }},
    {"cast", [](const Finding& f) { return f.question == "time_of_impact"; }},
};

Case alone(const Case& c, int a, int b, int step) {
  Case r;
  r.id = c.id;
  r.scene.name = c.scene.name;
  std::vector<std::optional<Pose>> at;
  if (step >= 0) {
    Truth truth(c.scene);
    const auto& steps = truth.steps();
    if (step < static_cast<int>(steps.size())) at = steps[static_cast<std::size_t>(step)].pose;
  }
  for (const int i : {a, b}) {
    const auto k = static_cast<std::size_t>(i);
    Body body = c.scene.bodies[k];
    r.scene.shapes.push_back(c.scene.shape_of(i));
    body.shape = static_cast<int>(r.scene.shapes.size()) - 1;
    body.is_static = false;  // a broad phase ignores pairs of two static bodies
    if (k < at.size() && at[k]) body.pose = *at[k];
    r.scene.bodies.push_back(std::move(body));
  }
  for (const Question q : {Question::overlap, Question::distance, Question::contact, Question::candidates})
    r.queries.push_back({q, 0, 1});
  if (r.scene.bodies[0].motion || r.scene.bodies[1].motion)
    r.queries.push_back({Question::time_of_impact, 0, 1});
  return r;
}

}  // namespace

StillShows commits_fault(const EnginePtr& engine, const Finding& finding) {
  return [&engine, finding](std::span<const Case> cases) {
    std::vector<bool> r;
    for (const auto& found : findings_of(cases, engine, found_by(finding.key())))
      r.push_back(std::any_of(found.begin(), found.end(), [&](const auto& x) {
        const Finding& f = x.second;
        return f.question == finding.question && f.fault == finding.fault && f.shapes == finding.shapes;
      }));
    return r;
  };
}

BodiesNeeded which_bodies(const Case& c, const StillShows& shows) {
  const ListPart& part = bodies_part();
  BodiesNeeded r{std::vector<int>(c.scene.bodies.size()), c};
  std::iota(r.bodies.begin(), r.bodies.end(), 0);
  for (std::size_t n = std::max<std::size_t>(1, r.bodies.size() / 2);;) {
    bool dropped = false;
    for (std::size_t first = 0; first + n <= r.bodies.size();) {
      const auto less = part.drop(r.smallest, 0, first, n);
      if (less && shows_one(shows, *less)) {
        r.smallest = *less;
        r.bodies.erase(r.bodies.begin() + static_cast<std::ptrdiff_t>(first),
                       r.bodies.begin() + static_cast<std::ptrdiff_t>(first + n));
        dropped = true;
      } else {
        first += n;
      }
    }
    if (n == 1 && !dropped) return r;
    n = std::max<std::size_t>(1, n / 2);
  }
}

StepNeeded which_step(const Case& c, const StillShows& shows) {
  StepNeeded r;
  r.queries = queries_of(c.scene);
  if (r.queries == 0) throw InputError("bisect step", "the case has no script");
  int lo = 0, hi = r.queries - 1;  // the prefix up to hi shows the finding
  while (lo < hi) {
    const int middle = (lo + hi) / 2;
    if (shows_one(shows, up_to_query(c, middle)))
      hi = middle;
    else
      lo = middle + 1;
  }
  r.query = hi;
  r.changes = changes_before(c.scene, hi);
  r.shortest = up_to_query(c, hi);
  return r;
}

std::vector<Stage> which_stage(const Case& c, int a, int b, int step, const EnginePtr& engine) {
  const Case pair = alone(c, a, b, step);
  const auto found = findings_of({&pair, 1}, engine)[0];
  std::vector<Stage> r;
  for (const StageRow& row : stages) {
    std::set<std::string> faults;
    for (const auto& [key, f] : found)
      if (row.belongs(f)) faults.insert(f.question + " " + f.fault);
    r.push_back({row.name, {faults.begin(), faults.end()}});
  }
  return r;
}

Threshold which_value(const Case& c, const std::string& pointer, double to, const StillShows& shows) {
  nlohmann::ordered_json j = case_to_json(c);
  const auto at = [&] {
    try {
      const nlohmann::ordered_json::json_pointer p(pointer);
      if (j.at(p).is_number()) return p;
    } catch (const nlohmann::json::exception&) {
    }
    throw InputError(pointer,
                     "is not a number in the case (a JSON pointer such as "
                     "/scene/bodies/1/pose/translation/0; rotations and motions must be written out)");
  }();
  Threshold t;
  const auto shows_at = [&](double x) {
    ++t.tried;
    j[at] = x;
    return shows_one(shows, case_from_json(j, pointer));
  };
  t.shows = j.at(at).get<double>();
  t.shows_not = to;
  if (shows_at(to)) throw InputError(fmt::format("--to {}", to), "also shows the finding");
  for (;;) {
    const double middle = t.shows + (t.shows_not - t.shows) / 2;
    if (middle == t.shows || middle == t.shows_not) break;
    (shows_at(middle) ? t.shows : t.shows_not) = middle;
  }
  t.neighbours = std::nextafter(t.shows, t.shows_not) == t.shows_not;
  return t;
}

}  // namespace touchstone::fuzz
