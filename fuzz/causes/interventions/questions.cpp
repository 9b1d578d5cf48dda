// What was asked before, and what is asked besides.
#include <algorithm>
#include <utility>

#include "fuzz/causes/intervention.h"

namespace touchstone::fuzz {
namespace {

std::optional<Case> with_questions_first(const Case& c, const std::vector<Query>& first) {
  if (!asks_about_pair(c) || is_motion_question(c.queries[0].question)) return std::nullopt;
  Case r = c;
  r.queries.insert(r.queries.begin(), first.begin(), first.end());
  return r;
}

}  // namespace

std::optional<Case> ask_twice(const Case& c) {
  if (!asks_about_pair(c)) return std::nullopt;
  Case r = c;
  r.queries.insert(r.queries.begin(), c.queries.begin(), c.queries.end());
  return r;
}

std::optional<Case> ask_last_only(const Case& c) {
  if (!asks_about_pair(c) || c.queries.size() < 2) return std::nullopt;
  Case r = c;
  r.queries = {c.queries.back()};
  return r;
}

std::optional<Case> ask_overlap_first(const Case& c) {
  if (c.queries.empty()) return std::nullopt;
  return with_questions_first(c, {{Question::overlap, c.queries[0].a, c.queries[0].b}});
}

std::optional<Case> ask_contact_first(const Case& c) {
  if (c.queries.empty()) return std::nullopt;
  return with_questions_first(c, {{Question::contact, c.queries[0].a, c.queries[0].b}});
}

std::optional<Case> ask_exchanged_first(const Case& c) {
  if (c.queries.empty()) return std::nullopt;
  const Query& q = c.queries[0];
  return with_questions_first(c, {{q.question, q.b, q.a}});
}

}  // namespace touchstone::fuzz
