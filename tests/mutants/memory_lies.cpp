// Lies about state that an engine must not keep: the previous question, pair or scene, and the number of
// queries.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

double size_of_pair(const Case& c, const Query& q) {
  return std::max(extent(c.scene.shape_of(q.a)), extent(c.scene.shape_of(q.b)));
}

// f(previous question, observation) for every answer to a question about a pair.
Lie after_question(Question before, Question now, void (*f)(const Case&, const Query&, Observation&)) {
  return [=, last = std::optional<Question>{}](const Case& c, const Query& q, Observation& o) mutable {
    if (last == before && asks(q, now) && o.outcome == Outcome::answered) f(c, q, o);
    last = q.question;
  };
}
void no_depth_left(const Case&, const Query&, Observation& o) {
  if (o.distance) o.distance = std::max(0.0, *o.distance);
}
void twice_as_deep(const Case&, const Query&, Observation& o) {
  if (o.depth) *o.depth *= 2;
}
void says_apart(const Case&, const Query&, Observation& o) { o.overlap = false; }
void points_of_contact(const Case&, const Query&, Observation& o) {
  if (o.witness) (*o.witness)[1] = (*o.witness)[0];
}

// A question and its answer.
struct Memory {
  std::vector<Shape> shapes;
  Query query;
  Observation answer;
};

// When the same question is asked about the same bodies, identified by their shapes: f(previous answer,
// answer). Poses are ignored.
Lie when_shapes_return(Question question, void (*f)(const Observation& before, Observation& now)) {
  return [=, last = std::optional<Memory>{}](const Case& c, const Query& q, Observation& o) mutable {
    if (!asks(q, question) || o.outcome != Outcome::answered) return;
    const Observation right = o;
    if (last && last->query == q && last->shapes == c.scene.shapes) f(last->answer, o);
    last = Memory{c.scene.shapes, q, right};
  };
}
void the_same(const Observation& before, Observation& now) { now = before; }
void same_normal(const Observation& before, Observation& now) {
  if (before.normal && now.normal) now.normal = before.normal;
}
void deepest_so_far(const Observation& before, Observation& now) {
  if (before.depth && now.depth) now.depth = std::max(*before.depth, *now.depth);
}
void still_overlapping(const Observation& before, Observation& now) {
  now.overlap = *now.overlap || *before.overlap;
}
void same_points(const Observation& before, Observation& now) { now.witness = before.witness; }

// When this pair was just asked in the other order.
Lie when_exchanged(Question question, void (*f)(const Observation& before, Observation& now)) {
  return [=, last = std::optional<Memory>{}](const Case& c, const Query& q, Observation& o) mutable {
    if (!asks(q, question) || o.outcome != Outcome::answered) return;
    const Observation right = o;
    if (last && last->query.a == q.b && last->query.b == q.a && last->shapes == c.scene.shapes)
      f(last->answer, o);
    last = Memory{c.scene.shapes, q, right};
  };
}

// The answer of another pair with the same two shapes, asked since then in this scene.
Lie cached_by_shape() {
  return [last = std::optional<Memory>{}, scene = Scene{}](const Case& c, const Query& q,
                                                           Observation& o) mutable {
    if (!asks(q, Question::distance) || !o.distance) return;
    const double right = *o.distance;
    if (last && scene == c.scene && body(c, q.a).shape == body(c, last->query.a).shape &&
        body(c, q.b).shape == body(c, last->query.b).shape)
      o.distance = last->answer.distance;
    if (!last || scene != c.scene) scene = c.scene;
    last = Memory{{}, q, {}};
    last->answer.distance = right;
  };
}

// The second time that a case asks the same question.
Lie farther_again() {
  return
      [seen = std::vector<Query>{}, scene = Scene{}](const Case& c, const Query& q, Observation& o) mutable {
        if (scene != c.scene) {
          scene = c.scene;
          seen.clear();
        }
        const bool again = std::find(seen.begin(), seen.end(), q) != seen.end();
        seen.push_back(q);
        if (again && asks(q, Question::distance) && o.distance) *o.distance += 1e-6 * size_of_pair(c, q);
      };
}

// The same, if another pair was asked since then.
Lie spoilt_between() {
  return
      [seen = std::vector<Query>{}, scene = Scene{}](const Case& c, const Query& q, Observation& o) mutable {
        if (scene != c.scene) {
          scene = c.scene;
          seen.clear();
        }
        const bool other = !seen.empty() && (seen.back().a != q.a || seen.back().b != q.b);
        const bool again = std::find(seen.begin(), seen.end(), q) != seen.end();
        seen.push_back(q);
        if (again && other && asks(q, Question::overlap) && o.overlap) o.overlap = !*o.overlap;
      };
}

Lie every_hundredth_apart() {
  return [calls = 0](const Case&, const Query& q, Observation& o) mutable {
    if (asks(q, Question::overlap) && ++calls % 100 == 0) o.overlap = false;
  };
}

Lie worse_every_time() {
  return [calls = 0](const Case& c, const Query& q, Observation& o) mutable {
    if (asks(q, Question::distance) && o.distance)
      *o.distance += 1e-16 * static_cast<double>(++calls) * size_of_pair(c, q);
  };
}

// A counter of questions that overflows.
Lie denied_after(long questions) {
  return [questions, asked = 0L](const Case&, const Query& q, Observation& o) mutable {
    if (++asked > questions && asks(q, Question::overlap) && o.overlap) o.overlap = false;
  };
}

// The same, of the questions about one scene.
Lie doubled_after(long questions) {
  return [questions, asked = 0L, scene = Scene{}](const Case& c, const Query& q, Observation& o) mutable {
    if (scene != c.scene) {
      scene = c.scene;
      asked = 0;
    }
    if (++asked > questions && asks(q, Question::contact) && o.depth) *o.depth *= 2;
  };
}

// Pairs are kept by the smaller number of a body, and the normal always from it.
Lie from_smaller_number() {
  return [](const Case&, const Query& q, Observation& o) {
    if (asks(q, Question::contact) && o.normal && q.a > q.b) o.normal = -*o.normal;
  };
}

// The answers of a pair are kept from question to question, except its last one: distance, then contact.
Lie depth_of_last_distance() {
  return [last = std::optional<Memory>{}](const Case& c, const Query& q, Observation& o) mutable {
    if (asks(q, Question::distance) && o.distance) last = Memory{c.scene.shapes, q, o};
    if (!asks(q, Question::contact) || !o.depth || !last || last->shapes != c.scene.shapes) return;
    if (last->query.a != q.a || last->query.b != q.b) o.depth = std::max(*o.depth, -*last->answer.distance);
  };
}

// A buffer that a mesh leaves dirty.
Lie dirty_after_mesh() {
  return [dirty = false](const Case& c, const Query& q, Observation& o) mutable {
    if (!is_pair_question(q.question)) return;
    const bool mesh = kind(c, q.a) == ShapeKind::mesh || kind(c, q.b) == ShapeKind::mesh;
    if (dirty && !mesh && o.distance) *o.distance += 1e-6 * size_of_pair(c, q);
    dirty = mesh;
  };
}

// A plane that is taken from the previous half-space.
Lie plane_before() {
  return [last = std::optional<double>{}](const Case& c, const Query& q, Observation& o) mutable {
    if (!asks(q, Question::distance) || !o.distance || kind(c, q.a) != ShapeKind::half_space) return;
    const double right = *o.distance;
    if (last) o.distance = *last;
    last = right;
  };
}

// Results cached by the hull's number of vertices for the engine's lifetime.
Lie kept_by_vertex_count() {
  return [kept = std::map<std::size_t, double>{}](const Case& c, const Query& q, Observation& o) mutable {
    const auto* h = std::get_if<Hull>(&c.scene.shape_of(std::max(q.b, 0)));
    if (!asks(q, Question::distance) || !o.distance || !h || h->vertices.size() < 64) return;
    o.distance = kept.try_emplace(h->vertices.size(), *o.distance).first->second;
  };
}

// The pairs of the previous scene, if it had as many bodies.
Lie pairs_of_scene_before() {
  return [bodies = std::size_t{0}, last = std::vector<std::vector<BodyPair>>{}](const Case& c, const Query& q,
                                                                                Observation& o) mutable {
    if (!asks(q, Question::candidates)) return;
    auto right = o.candidate_pairs;
    if (bodies == c.scene.bodies.size() && last.size() == right.size()) o.candidate_pairs = last;
    bodies = c.scene.bodies.size();
    last = std::move(right);
  };
}

// A list that is not cleared: the entries of the previous scene beyond the end of the current one.
Lie contacts_not_cleared() {
  return [last = std::vector<SceneContact>{}](const Case&, const Query& q, Observation& o) mutable {
    if (!asks(q, Question::scene_contacts)) return;
    const auto right = o.contacts;
    for (std::size_t i = right.size(); i < last.size(); ++i) o.contacts.push_back(last[i]);
    last = right;
  };
}

}  // namespace

std::vector<Mutant> memory_lies() {
  constexpr auto over = Question::overlap, dist = Question::distance, cont = Question::contact,
                 impact = Question::time_of_impact;
  return {
      {"memory_distance_after_contact", "distance_off", "deep", "no depth right after a contact",
       after_question(cont, dist, no_depth_left), false},
      {"memory_points_after_contact", "witness_off", "separate", "one point twice right after a contact",
       after_question(cont, dist, points_of_contact), false},
      {"memory_contact_after_overlap", "depth_excess", "shallow", "twice the depth right after an overlap",
       after_question(over, cont, twice_as_deep), false},
      {"memory_overlap_after_contact", "missed", "shallow", "apart, right after a contact",
       after_question(cont, over, says_apart), false},
      {"memory_distance_kept", "distance_off", "separate", "the distance before a body was moved",
       when_shapes_return(dist, the_same), false},
      {"memory_points_kept", "witness_off", "separate", "the points before a body was moved",
       when_shapes_return(dist, same_points), false},
      {"memory_contact_kept", "infeasible", "shallow", "the contact before a body was moved",
       when_shapes_return(cont, the_same), false},
      {"memory_normal_kept", "not_minimal", "shallow", "the normal before a body was moved",
       when_shapes_return(cont, same_normal), false},
      {"memory_deepest", "depth_excess", "shallow", "the largest depth of a pair so far",
       when_shapes_return(cont, deepest_so_far), false},
      {"memory_overlap_stays", "ghost", "near", "bodies that overlapped before one was moved still overlap",
       when_shapes_return(over, still_overlapping), false},
      {"memory_impact_kept", "early", "translate", "the time of impact before a body was moved",
       when_shapes_return(impact, the_same), false},
      {"memory_normal_exchanged", "infeasible", "dialogue", "the normal of (a, b) for (b, a)",
       when_exchanged(cont, same_normal), false},
      {"memory_points_exchanged", "witness_off", "dialogue", "the points of (a, b) for (b, a)",
       when_exchanged(dist, same_points), false},
      {"memory_cached_by_shape", "distance_off", "dialogue",
       "the distance of another pair of the same shapes", cached_by_shape(), false},
      {"memory_farther_again", "distance_off", "dialogue", "1e-6 farther when asked again", farther_again(),
       false},
      {"memory_spoilt_between", "ghost", "dialogue",
       "the opposite verdict after a question about another pair", spoilt_between(), false},
      {"memory_hundredth", "missed", "shallow", "every hundredth overlap is denied", every_hundredth_apart(),
       false},
      {"memory_eight_bits", "depth_excess", "endless", "twice the depth after 256 questions about a scene",
       doubled_after(256), false},
      {"memory_many_questions", "missed", "endless", "overlaps are denied after 100,000 questions",
       denied_after(100'000), false},
      {"order_smaller_first", "infeasible", "dialogue",
       "normals always from the body with the smaller number", from_smaller_number()},
      {"memory_depth_of_distance", "depth_excess", "endless",
       "the depth of the last pair whose distance was asked, if larger", depth_of_last_distance(), false},
      {"memory_worse", "distance_off", "separate", "an error that grows by 1e-16 a call", worse_every_time(),
       false},
      {"memory_after_mesh", "distance_off", "mesh,separate", "1e-6 farther after a mesh", dirty_after_mesh(),
       false},
      {"memory_plane_before", "distance_off", "separate", "the distance to the previous half-space",
       plane_before(), false},
      {"memory_vertex_count", "distance_off", "vertices",
       "the distance of an earlier hull with as many vertices", kept_by_vertex_count(), false},
      {"memory_pairs_before", "missed", "company",
       "the pairs of the previous scene, if it had as many bodies", pairs_of_scene_before(), false},
      {"memory_contacts_left", "ghost", "company", "contacts of the previous scene at the end of the list",
       contacts_not_cleared(), false},
  };
}

}  // namespace touchstone::mutants
