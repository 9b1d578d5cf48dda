#include "oracles/core/broad_engine.h"

#include <array>
#include <limits>

#include "core/broad/body_box.h"
#include "core/broad/catalog.h"
#include "core/math/roundoff.h"
#include "core/tolerance.h"
#include "core/world/world.h"
#include "oracles/core/timed_answer.h"

namespace touchstone {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

const Body& body_of(const Scene& s, int i) { return s.bodies[static_cast<std::size_t>(i)]; }

struct NoBox {};

// A rotation by a third of a turn about (1,1,1), in either direction, permutes the extents cyclically and
// exactly.
Vec3 upright_extents(const Vec3& h, const Quat& q) {
  if (q.x == 0 && q.y == 0 && q.z == 0) return h;
  if (q.x != q.y || q.y != q.z || std::abs(q.w) != std::abs(q.x)) throw NoBox{};
  return q.w == q.x ? Vec3(h.z(), h.x(), h.y()) : Vec3(h.y(), h.z(), h.x());
}

Aabb exact_box(const Shape& shape, const Pose& pose) {
  if (const auto* b = std::get_if<Box>(&shape)) {
    const Vec3 h = upright_extents(b->half_extents, pose.rotation);
    return {pose.translation - h, pose.translation + h};
  }
  const auto* s = std::get_if<HalfSpace>(&shape);
  if (!s || pose.rotation != Quat{}) throw NoBox{};
  Aabb box{Vec3::Constant(-inf), Vec3::Constant(inf)};
  for (int k = 0; k < 3; ++k) {
    if (s->normal[k] == 0) continue;
    if (std::abs(s->normal[k]) != 1 || std::abs(s->normal.sum()) != 1) throw NoBox{};
    (s->normal[k] > 0 ? box.hi : box.lo)[k] = pose.translation[k] + s->normal[k] * s->offset;
  }
  return box;
}

// Runs a script through one broad phase. Consecutive moves become one update.
class Run {
 public:
  Run(const Scene& s, broad::BroadPhase& phase, BroadBoxes boxes, Observation& out)
      : s_(s), phase_(phase), boxes_(boxes), out_(out) {}

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
    if (boxes_ == BroadBoxes::exact) return exact_box(s_.shape_of(step.body), p);
    return swept_ ? box_of(s_, step.body, p) : broad::body_box(s_.shape_of(step.body), p);
  }
  void apply(const Step& step) {
    if (step.op == Step::Op::move) {
      moves_.push_back({step.body, box(step)});
      return;
    }
    flush();
    if (step.op == Step::Op::query) return query();
    if (step.op == Step::Op::remove) return attempt([&] { phase_.remove(step.body); });
    const auto mobility = body_of(s_, step.body).is_static ? broad::Mobility::fixed : broad::Mobility::moving;
    attempt([&] { phase_.insert(step.body, box(step), mobility); });
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
  std::vector<broad::BoxUpdate> moves_;
  std::vector<broad::IdPair> found_;
};

class BroadEngine final : public NativeEngine {
 public:
  BroadEngine(const broad::CatalogRow& row, BroadBoxes boxes) : row_(row), boxes_(boxes) {
    card_.name = row.name;
    card_.library = "Touchstone core";
    card_.version = "0.1.0";
    card_.settings = "broad phase alone; refuses NaN and inverted boxes and leaves out the body";
    card_.unit_roundoff = double_roundoff;
    card_.tau_factor = tolerance::core_tau_factor;
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
      Run run(s, *phase, boxes_, o);
      if (swept)
        run.step();
      else
        run.script();
      o.outcome = Outcome::answered;
    } catch (const NoBox&) {
      o = {};
      o.detail = "a body without an exact box";
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
