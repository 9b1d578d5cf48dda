// Metamorphic relations, which need no truth (truth.md): an engine's answer to a case constrains its answer
// to a case derived from it, whatever the truth is.
//
// Every right answer implies that the signed gap g of the pair lies in an interval:
//   overlap            g in (-inf, τ]                apart            g in [-τ, inf)
//   distance d         g in [d - τ, d + τ]           contact, depth p g in [-p - τ, -p + 2τ]
//   within a margin m  g in (-inf, m + τ]            not within       g in [m - τ, inf)
//   lower bound l      g in [l - τ, inf)             upper bound u    g in (-inf, u + τ]
// (a right depth lies between d* - τ, else infeasible, and d* + 2τ, else excess or regret). A derivation maps
// g exactly, or up to a stated rounding: the intervals of the base's and of the derived answers, mapped, must
// intersect. Where they do not, one of the two answers is wrong, and both are from the same engine. Nothing
// that the definition of a right answer allows is reported.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/roundoff.h"
#include "fuzz/judge/tau.h"
#include "scenarios/value/engine_card.h"
#include "scenarios/value/judgement.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

/// Closed; empty when lo > hi.
struct GapInterval {
  double lo = -infinity;
  double hi = infinity;
  bool says_nothing() const { return lo == -infinity && hi == infinity; }
};

/// What the answer to one query of the base implies about the gap of the derived pair.
struct Expected {
  int query = 0;  // of the base
  GapInterval gap;
};

/// The same pair in another form, and how its gap maps back.
struct Form {
  Case c;
  double scale = 1;     // lengths here / lengths in the base
  double rounding = 0;  // of the derivation: g is known up to this error
};
/// How far apart the intervals of one gap are, given in the base and found here; at most 0 when they
/// intersect.
double miss(const Form& form, const GapInterval& in_base, const GapInterval& here);
/// What `in_base` says about the gap here.
GapInterval mapped(const Form& form, const GapInterval& in_base);
/// True when one of the two is an answer and the other is not. A time-out depends on the machine and proves
/// nothing.
bool is_answered_once(Outcome in_base, Outcome here);

/// A case derived from a base case, and what the answers to the base imply about it.
struct Derived : Form {
  std::vector<Expected> expected;  // pair questions
  /// The queries correspond one to one to the base's: an engine that answers one must answer the other.
  bool same_questions = false;
  std::vector<int> body_of;  // scene questions: body i here is body_of[i] in the base
  std::string words;         // what was done: "scaled by 2^10"
};

struct RelationInput {
  const Case& c;
  const EngineCard& card;
  const CaseObservations& base;
};

/// An engine contradicts itself.
struct RelationBreak {
  std::string_view relation;
  int query = 0;  // of the base
  int a = -1, b = -1;
  double error_in_l = 0;  // distance between the intervals; 0: an answer is missing
  Blame blame = Blame::algorithm;
  std::string words;
};

struct Relation {
  std::string_view name;  // as a fault in the key of a finding
  std::string_view line;
  std::vector<Derived> (*derive)(const RelationInput& in);
};
std::span<const Relation> relations();
/// True for a fault that is the name of a relation.
bool is_relation(std::string_view fault);

/// Whether a derived case stays within range: it may not leave the doubles, nor come near their limits where
/// its base did not, for no engine can be expected to answer there.
bool is_within_numbers(const Scene& base, const Scene& derived);

/// The worst break between the base's answers and those to one derived case, if there is one.
std::optional<RelationBreak> find_break(const Relation& r, const RelationInput& in, const Derived& d,
                                        const CaseObservations& observed);

// ---- shared by the relations; one file per topic in relations/

/// The pair that all pair questions of the case (except time of impact) are about; nullopt when there is no
/// such pair.
std::optional<BodyPair> pair_asked(const Case& c);
/// The interval that a right answer implies; says_nothing() when it implies none.
GapInterval implied_gap(const Scene& s, const Query& q, const Observation& o, const EngineCard& card);
/// One entry per pair question of the base that implies something, in the base's units.
std::vector<Expected> implied_gaps(const RelationInput& in);
/// The pair queries of the base, as queries about bodies 0 and 1.
std::vector<Query> same_queries(const Case& c);
/// Upper bound of the effect on g of rounding when poses are recomputed: each body moves by at most 16
/// roundings of its coordinates and extent.
double pose_rounding(const Scene& pair);

std::vector<Derived> derive_swap(const RelationInput& in);
std::vector<Derived> derive_axes(const RelationInput& in);
std::vector<Derived> derive_scale(const RelationInput& in);
std::vector<Derived> derive_rigid(const RelationInput& in);
std::vector<Derived> derive_questions(const RelationInput& in);
std::vector<Derived> derive_push(const RelationInput& in);
std::vector<Derived> derive_grow(const RelationInput& in);
std::vector<Derived> derive_slope(const RelationInput& in);
std::vector<Derived> derive_step(const RelationInput& in);
std::vector<Derived> derive_order(const RelationInput& in);
std::vector<Derived> derive_reinsert(const RelationInput& in);
std::optional<RelationBreak> find_scene_break(const Relation& r, const RelationInput& in, const Derived& d,
                                              const CaseObservations& observed);

}  // namespace touchstone::fuzz
