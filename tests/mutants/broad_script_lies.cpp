// Lies about what happened before a query: stale boxes, lost and half re-inserted bodies, ghosts.
#include <algorithm>

#include "tests/mutants/replay.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

const BodyHistory& history(const QueryState& q, int i) { return q.bodies[static_cast<std::size_t>(i)]; }

// A box from the pose before the last move where `stale` holds, otherwise from the current pose.
Lie stale_where(std::function<bool(const BodyHistory&)> stale) {
  return keep_overlapping([stale = std::move(stale)](const Scene& s, const QueryState& q, int i) {
    const BodyHistory& h = history(q, i);
    const bool old = h.moves > 0 && h.before && stale(h);
    return plain_box(s.shape_of(i), old ? *h.before : h.pose.value_or(Pose{}));
  });
}

double way(const BodyHistory& h) { return (h.pose->translation - h.before->translation).norm(); }

bool always(const BodyHistory&) { return true; }
bool small_move(const BodyHistory& h) { return way(h) < 0.2; }
bool tiny_move(const BodyHistory& h) { return way(h) < 1e-3; }
bool teleport(const BodyHistory& h) { return way(h) > 20; }
bool moved_twice(const BodyHistory& h) { return h.moves_in_frame >= 2; }
bool after_reinsert(const BodyHistory& h) { return h.inserts >= 2; }
bool fourth_move(const BodyHistory& h) { return h.moves == 4; }

Aabb at_first_pose(const Scene& s, const QueryState& q, int i) {
  const BodyHistory& h = history(q, i);
  return plain_box(s.shape_of(i), h.inserts >= 2 && h.moves == 0 ? *h.first : h.pose.value_or(Pose{}));
}

bool inserted_once(const Scene&, const QueryState& q, int a, int b) {
  return history(q, a).inserts < 2 && history(q, b).inserts < 2;
}
bool inserted_thrice(const Scene&, const QueryState& q, int a, int b) {
  return history(q, a).inserts < 3 && history(q, b).inserts < 3;
}
bool unmoved_since_query(const Scene&, const QueryState& q, int a, int b) {
  return q.query == 0 || history(q, a).moves_in_frame > 0 || history(q, b).moves_in_frame > 0;
}
bool both_moved(const Scene&, const QueryState& q, int a, int b) {
  return history(q, a).moves_in_frame == 0 || history(q, b).moves_in_frame == 0;
}
bool static_moved(const Scene& s, const QueryState& q, int a, int b) {
  const auto moved = [&](int i) {
    return s.bodies[static_cast<std::size_t>(i)].is_static && history(q, i).moves > 0;
  };
  return !moved(a) && !moved(b);
}

// A removed body still pairs with what stands where it stood.
void ghosts(const Scene& s, const QueryState& q, std::vector<BodyPair>& pairs) {
  const int n = static_cast<int>(q.bodies.size());
  for (int g = 0; g < n; ++g) {
    const BodyHistory& gone = history(q, g);
    if (gone.pose || !gone.before) continue;
    const Aabb was = plain_box(s.shape_of(g), *gone.before);
    for (int i = 0; i < n; ++i)
      if (history(q, i).pose && overlaps(was, plain_box(s.shape_of(i), *history(q, i).pose)))
        pairs.push_back(std::minmax(g, i));
  }
}

// After a removal the slots of the array are reported, not the ids that they hold.
void slots_for_ids(const Scene&, const QueryState& q, std::vector<BodyPair>& pairs) {
  if (q.removals == 0) return;
  for (BodyPair& p : pairs) p = std::minmax(history(q, p.first).slot, history(q, p.second).slot);
}
void last_lost_after_removal(const Scene&, const QueryState& q, std::vector<BodyPair>& pairs) {
  if (q.removals > 0 && !pairs.empty()) pairs.pop_back();
}

}  // namespace

std::vector<Mutant> broad_script_lies() {
  return {
      {"stale_after_move", "missed", "script", "boxes from before the last move", stale_where(always)},
      {"stale_after_small_move", "missed", "errands",
       "moves of less than 0.2 are ignored, and boxes have no margin", stale_where(small_move)},
      {"stale_after_tiny_move", "missed", "errands", "moves of less than 1e-3 are ignored",
       stale_where(tiny_move)},
      {"stale_after_teleport", "missed", "script", "moves of more than 20 are ignored",
       stale_where(teleport)},
      {"stale_after_second_move", "missed", "errands", "the second of two moves between queries is lost",
       stale_where(moved_twice)},
      {"stale_after_reinsert", "missed", "errands", "moves of a reinserted body are ignored",
       stale_where(after_reinsert)},
      {"stale_at_fourth_move", "missed", "errands", "the fourth move of a body is lost",
       stale_where(fourth_move)},
      {"reinsert_at_first_pose", "missed", "errands", "a reinserted body gets its first pose",
       keep_overlapping(at_first_pose)},
      {"lost_on_reinsert", "missed", "script", "a reinserted body is in no pair", keep_pairs(inserted_once)},
      {"lost_on_second_reinsert", "missed", "errands", "a body inserted a third time is in no pair",
       keep_pairs(inserted_thrice)},
      {"resting_pairs_forgotten", "missed", "script",
       "a pair is lost if neither body has moved since the last query", keep_pairs(unmoved_since_query)},
      {"both_moved_forgotten", "missed", "errands", "a pair is lost if both bodies have moved",
       keep_pairs(both_moved)},
      {"moved_static_lost", "missed", "errands", "a static body that was moved is in no pair",
       keep_pairs(static_moved)},
      {"ghost_of_removed", "stale", "script", "a removed body is still in pairs", change_list(ghosts)},
      {"slots_for_ids", "missed", "script", "after a removal, slots are reported in place of ids",
       change_list(slots_for_ids)},
      {"last_lost_after_removal", "missed", "script", "after a removal the last pair is lost",
       change_list(last_lost_after_removal)},
  };
}

}  // namespace touchstone::mutants
