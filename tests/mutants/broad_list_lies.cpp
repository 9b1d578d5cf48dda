// Lies about the list of pairs: pairs that a broad phase drops, overwrites or misnames after finding them.
#include <algorithm>
#include <cmath>

#include "tests/mutants/replay.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

using Pairs = std::vector<BodyPair>;

bool is_static(const Scene& s, int i) { return s.bodies[static_cast<std::size_t>(i)].is_static; }

void drop_last(const Scene&, const QueryState&, Pairs& p) {
  if (!p.empty()) p.pop_back();
}
void drop_first(const Scene&, const QueryState&, Pairs& p) {
  if (!p.empty()) p.erase(p.begin());
}
void keep_sixteen(const Scene&, const QueryState&, Pairs& p) {
  if (p.size() > 16) p.resize(16);
}
void drop_middle(const Scene&, const QueryState&, Pairs& p) {
  if (p.size() > 2) p.erase(p.begin() + static_cast<std::ptrdiff_t>(p.size() / 2));
}
void overwrite_by_duplicate(const Scene&, const QueryState&, Pairs& p) {
  if (p.size() > 1) p[1] = p[0];
}
void second_id_off_by_one(const Scene&, const QueryState&, Pairs& p) {
  if (!p.empty()) ++p.back().second;
}
void pair_of_one(const Scene&, const QueryState& s, Pairs& p) {
  if (!s.bodies.empty() && s.bodies[0].pose) p.emplace_back(0, 0);
}
void body_that_never_was(const Scene& scene, const QueryState&, Pairs& p) {
  p.emplace_back(0, static_cast<int>(scene.bodies.size()));
}
// A set of pairs keyed by a 5-bit hash of the two ids, in which the first entry of a bucket wins.
void hash_collides(const Scene&, const QueryState&, Pairs& p) {
  std::uint32_t used = 0;
  std::erase_if(p, [&](const BodyPair& x) {
    const auto bit = std::uint32_t{1}
                     << ((static_cast<unsigned>(x.first) * 31U + static_cast<unsigned>(x.second)) % 32U);
    const bool taken = (used & bit) != 0;
    used |= bit;
    return taken;
  });
}

Lie every_eighth() {
  return change_list([n = 0](const Scene&, const QueryState&, Pairs& p) mutable {
    std::erase_if(p, [&](const BodyPair&) { return ++n % 8 == 0; });
  });
}

Lie drop_beyond(int capacity) {
  return keep_pairs([capacity](const Scene&, const QueryState&, int, int b) { return b < capacity; });
}

bool not_below_static(const Scene& s, const QueryState&, int a, int) { return !is_static(s, a); }
bool not_above_static(const Scene& s, const QueryState&, int, int b) { return !is_static(s, b); }
// A two-bit flag instead of one bit: bodies 2 apart are in one group.
bool group_mask(const Scene& s, const QueryState&, int a, int b) { return s.bodies.size() < 8 || b - a != 2; }

// The pairs of the previous query: computed too late.
void lag(const Case&, const Query& q, Observation& o) {
  if (q.question != Question::candidates || o.candidate_pairs.size() < 2) return;
  std::rotate(o.candidate_pairs.begin(), o.candidate_pairs.end() - 1, o.candidate_pairs.end());
  o.candidate_pairs.front().clear();
}
void last_query_unanswered(const Case&, const Query& q, Observation& o) {
  if (q.question == Question::candidates && !o.candidate_pairs.empty()) o.candidate_pairs.pop_back();
}
void one_answer_more(const Case&, const Query& q, Observation& o) {
  if (q.question == Question::candidates) o.candidate_pairs.push_back({{0, 1}});
}

}  // namespace

std::vector<Mutant> broad_list_lies() {
  return {
      {"last_pair_dropped", "missed", "crowd", "the last pair of a query is lost", change_list(drop_last)},
      {"first_pair_dropped", "missed", "crowd", "the first pair of a query is lost", change_list(drop_first)},
      {"middle_pair_dropped", "missed", "crowd", "of three or more pairs, one in the middle is lost",
       change_list(drop_middle)},
      {"eighth_pair_dropped", "missed", "crowd", "every eighth pair is lost, counted over all queries",
       every_eighth(), false},
      {"sixteen_pairs", "missed", "throng", "a buffer of 16 pairs", change_list(keep_sixteen)},
      {"capacity_32", "missed", "throng", "body 32 and later ones are in no pair", drop_beyond(32)},
      {"capacity_128", "missed", "throng", "body 128 and later ones are in no pair", drop_beyond(128)},
      {"capacity_256", "missed", "throng", "body 256 and later ones are in no pair", drop_beyond(256)},
      {"duplicate_overwrites", "missed", "crowd", "the first pair is repeated in place of the second",
       change_list(overwrite_by_duplicate)},
      {"hash_collides", "missed", "throng", "pairs with equal hashes count as one pair",
       change_list(hash_collides)},
      {"id_off_by_one", "missed", "crowd", "the second id of the last pair is one too large",
       change_list(second_id_off_by_one)},
      {"pair_of_one_body", "stale", "tiles", "body 0 is in a pair with itself", change_list(pair_of_one)},
      {"pair_of_no_body", "stale", "script", "a pair names a body that does not exist",
       change_list(body_that_never_was)},
      {"static_first_dropped", "missed", "tiles",
       "pairs of a static and a moving body are lost if the static id is lower",
       keep_pairs(not_below_static)},
      {"static_second_dropped", "missed", "tiles",
       "pairs of a static and a moving body are lost if the static id is higher",
       keep_pairs(not_above_static)},
      {"group_mask_too_wide", "missed", "crowd", "in scenes of 8 or more bodies, ids two apart are filtered",
       keep_pairs(group_mask)},
      {"answers_lag", "missed", "script", "each query gets the pairs of the query before", lag},
      {"last_query_unanswered", "missed", "script", "the last query of a script gets no list",
       last_query_unanswered},
      {"one_answer_more", "no_number", "script", "one list more than the script has queries",
       one_answer_more},
  };
}

}  // namespace touchstone::mutants
