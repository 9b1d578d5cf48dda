#include <array>

#include "core/broad/body_box.h"
#include "core/broad/catalog.h"
#include "core/world/world.h"
#include "oracles/core/core_answers.h"
#include "oracles/core/core_engine.h"
#include "scenarios/value/candidate_pairs.h"

namespace touchstone {
namespace {

const Body& body_of(const Scene& s, int i) { return s.bodies[static_cast<std::size_t>(i)]; }

struct NoBox {};

// Runs a script through one broad phase. Consecutive moves become one update.
class Run {
 public:
  /// `margin`: every box is widened by half of it.
  Run(const Scene& s, broad::BroadPhase& phase, BroadBoxes boxes, double margin, Observation& out)
      : s_(s), phase_(phase), boxes_(boxes), out_(out), margin_(margin) {}

  /// Runs one step of the bodies' motions, from their own poses.
  void step() {
    swept_ = true;
    for (int i = 0; i < static_cast<int>(s_.bodies.size()); ++i) apply({Step::Op::insert, i, std::nullopt});
    query();
  }

  void script() {
    if (!s_.script.empty()) {
      for (const Step& step : s_.script) apply(step);
    } else {
      for (const Step& step : effective_script(s_)) apply(step);
    }
    flush();
  }

 private:
  Aabb box(const Step& step) const {
    const Pose& p = step.pose ? *step.pose : body_of(s_, step.body).pose;
    if (boxes_ == BroadBoxes::exact) {
      if (const auto exact = exact_box(s_.shape_of(step.body), p)) return *exact;
      throw NoBox{};
    }
    return swept_ ? box_of(s_, step.body, p) : broad::body_box(s_.shape_of(step.body), p);
  }
  // An inverted box stays inverted.
  Aabb box_with_margin(const Step& step) const {
    const Aabb own = box(step);
    return margin_ > 0 && (own.lo.array() <= own.hi.array()).all() ? widened(own, margin_ / 2) : own;
  }
  void apply(const Step& step) {
    if (step.op == Step::Op::move) {
      moves_.push_back({step.body, box_with_margin(step)});
      return;
    }
    flush();
    if (step.op == Step::Op::query) return query();
    if (step.op == Step::Op::remove) return attempt([&] { phase_.remove(step.body); });
    const auto mobility = body_of(s_, step.body).is_static ? broad::Mobility::fixed : broad::Mobility::moving;
    attempt([&] { phase_.insert(step.body, box_with_margin(step), mobility); });
  }
  void flush() {
    if (moves_.size() == 1) attempt([&] { phase_.move(moves_[0].id, moves_[0].box); });
    if (moves_.size() > 1) update();
    moves_.clear();
  }
  // An update is all or nothing: if it is refused, the moves are made one by one, so that only the refused
  // ones are left out.
  void update() {
    try {
      phase_.update(moves_);
    } catch (const broad::Refused&) {
      for (const broad::BoxUpdate& m : moves_) attempt([&] { phase_.move(m.id, m.box); });
    }
  }
  template <class Operation>
  void attempt(Operation&& operation) {
    try {
      operation();
    } catch (const broad::Refused& why) {
      if (out_.detail.empty()) out_.detail = std::string("left out: ") + why.what();
    }
  }
  void query() {
    phase_.pairs(found_);
    std::vector<BodyPair>& pairs = out_.candidate_pairs.emplace_back();
    for (const broad::IdPair& p : found_)
      if (!is_filtered(s_, p.first, p.second)) pairs.emplace_back(p.first, p.second);
  }

  const Scene& s_;
  broad::BroadPhase& phase_;
  BroadBoxes boxes_;
  Observation& out_;
  bool swept_ = false;
  double margin_;
  std::vector<broad::BoxUpdate> moves_;
  std::vector<broad::IdPair> found_;
};

class BroadEngine final : public NativeEngine {
 public:
  BroadEngine(const broad::CatalogRow& row, BroadBoxes boxes)
      : row_(row),
        boxes_(boxes),
        card_(core_card(row.name,
                        "broad phase alone; refuses NaN and inverted boxes and leaves out the body")) {
    card_.source = "core/broad/broad_phase.h: no pair of closed boxes is lost";
  }
  const EngineCard& card() const override { return card_; }
  void answer(const Case& c, const Tell& tell) override {
    for (const Query& q : c.queries) tell(timed_answer([&](Observation& o) { ask(c.scene, q, o); }));
  }

 private:
  void ask(const Scene& s, const Query& q, Observation& o) const {
    const bool swept = q.question == Question::swept_candidates;
    if (!is_broad_question(q.question) || (swept && boxes_ == BroadBoxes::exact)) {
      o.detail = swept ? "exact boxes do not move within a step" : "a broad phase only";
      return;
    }
    try {
      const auto phase = row_.make();
      Run run(s, *phase, boxes_, q.question == Question::candidates_within ? s.margin : 0, o);
      if (swept)
        run.step();
      else
        run.script();
      o.outcome = Outcome::answered;
    } catch (const NoBox&) {
      o = no_answer(Outcome::unsupported, "a body without an exact box");
    }
  }
  const broad::CatalogRow& row_;
  BroadBoxes boxes_;
  EngineCard card_;
};

}  // namespace

std::span<const std::string_view> core_broad_phases() {
  static const auto names = [] {
    std::array<std::string_view, broad::catalog.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = broad::catalog[i].name;
    return all;
  }();
  return names;
}

std::unique_ptr<NativeEngine> make_broad_engine(std::string_view name, BroadBoxes boxes) {
  for (const broad::CatalogRow& row : broad::catalog)
    if (row.name == name) return std::make_unique<BroadEngine>(row, boxes);
  return nullptr;
}

}  // namespace touchstone
