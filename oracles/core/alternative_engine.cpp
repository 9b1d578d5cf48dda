#include "core/impact/alternatives.h"
#include "core/narrow/narrow_phase.h"
#include "oracles/core/core_answers.h"
#include "oracles/core/core_engine.h"

namespace touchstone {
namespace {

struct Row {
  std::string_view name, settings;
  double margin;  // of speculative contact; 0: narrow phase
};
constexpr Row rows[] = {
    {"core-extended", "every pair by separation() in extended precision, no manifold; no motion", 0},
    {"core-speculative@0.25", "speculative_impact, margin a quarter of the farthest approach", 0.25},
    {"core-speculative@0.5", "speculative_impact, margin half of the farthest approach", 0.5},
    {"core-speculative@1", "speculative_impact, margin the farthest approach", 1},
};
constexpr auto names = [] {
  std::array<std::string_view, std::size(rows)> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = rows[i].name;
  return all;
}();

const Body& body_of(const Scene& s, int i) { return s.bodies.at(static_cast<std::size_t>(i)); }
PlacedShape placed(const Scene& s, int i) { return {&s.shape_of(i), body_of(s, i).pose}; }
MovingShape moving(const Scene& s, int i) {
  return {&s.shape_of(i), body_of(s, i).pose, body_of(s, i).motion.value_or(Motion{})};
}
Vec3 to_double(const WideVec& v) { return v.cast<double>(); }

void ask_extended(const Scene& s, const Query& q, Observation& o) {
  const PlacedShape a = placed(s, q.a), b = placed(s, q.b);
  const Separation r = separation(a, b);
  o.outcome = r.outcome;
  if (r.outcome != Outcome::answered) return;
  const bool overlap = r.gap <= 0;
  if (q.question != Question::distance) o.overlap = overlap;
  if (q.question == Question::distance) {
    o.distance = static_cast<double>(r.gap);
    o.witness = {a.pose.translation + to_double(r.a), a.pose.translation + to_double(r.b)};
  } else if (q.question == Question::contact && overlap) {
    o.normal = to_double(r.normal);
    o.depth = static_cast<double>(-r.gap);
  }
}

class AlternativeEngine final : public NativeEngine {
 public:
  explicit AlternativeEngine(const Row& row)
      : row_(row), card_(core_card(row.name, std::string(row.settings))) {}
  const EngineCard& card() const override { return card_; }
  void answer(const Case& c, const Tell& tell) override {
    for (const Query& q : c.queries)
      tell(measured_answer(measure_ns(), [&](Observation& o) { ask(c.scene, q, o); }));
  }

 private:
  void ask(const Scene& s, const Query& q, Observation& o) const {
    const bool pairs = q.question <= Question::contact, motion = q.question == Question::time_of_impact;
    if (row_.margin > 0 ? !motion : !pairs) return;  // unsupported
    if (pairs) return ask_extended(s, q, o);
    const ImpactAnswer r = speculative_impact(moving(s, q.a), moving(s, q.b), row_.margin);
    o.outcome = r.outcome;
    o.toi = r.toi;
  }

  const Row& row_;
  EngineCard card_;
};

}  // namespace

std::span<const std::string_view> core_alternatives() { return names; }

std::unique_ptr<NativeEngine> make_core_alternative(std::string_view name) {
  for (const Row& row : rows)
    if (row.name == name) return std::make_unique<AlternativeEngine>(row);
  throw std::logic_error("no alternative of the core is called " + std::string(name));
}

}  // namespace touchstone
