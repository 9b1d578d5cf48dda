// All lying engines as a plug-in, so that any command can use one like a user's engine:
//
//   touchstone fuzz --subject build/lib/libtouchstone_mutants.so:depth_halved
#include "oracles/abi/plugin_kit.h"
#include "oracles/abi/plugin_scene.h"

#include "tests/mutants/lying_engine.h"

namespace touchstone::mutants {
namespace {

Shape shape(const ts_shape& s) {
  if (auto known = shape_from(s)) return *std::move(known);
  throw kit::Unsupported("an unknown kind of shape");
}

std::vector<std::string> more_shapes() {
  std::vector<std::string> names;
  for (int k = TS_LAST_COMMON_SHAPE + 1; k <= TS_LAST_SHAPE; ++k)
    names.emplace_back(type_name(static_cast<ShapeKind>(k)));
  return names;
}

Body body(const ts_body& b) {
  Body r;
  r.shape = b.shape;
  r.pose = kit::pose_of(b.pose);
  r.is_static = b.is_static != 0;
  r.group = b.group;
  if (b.has_motion) r.motion = kit::motion_of(b);
  return r;
}

Step step(const ts_step& s) {
  const auto op = static_cast<Step::Op>(s.op);
  const bool placed = op == Step::Op::insert || op == Step::Op::move;
  return {op, op == Step::Op::query ? -1 : s.body,
          placed ? std::optional(kit::pose_of(s.pose)) : std::nullopt};
}

Scene scene_of(const ts_scene& s) {
  Scene r;
  for (std::size_t i = 0; i < s.shape_count; ++i) r.shapes.push_back(shape(s.shapes[i]));
  for (std::size_t i = 0; i < s.body_count; ++i) r.bodies.push_back(body(s.bodies[i]));
  for (std::size_t i = 0; i < s.step_count; ++i) r.script.push_back(step(s.steps[i]));
  for (std::size_t i = 0; i < s.ignored_count; ++i)
    r.ignored.emplace_back(s.ignored[2 * i], s.ignored[2 * i + 1]);
  r.margin = s.margin;
  return r;
}

void fill_lists(const Observation& o, const ts_sink& sink) {
  for (const ManifoldPoint& p : o.manifold)
    if (p.id)
      kit::report_point(sink, p.position, p.depth, *p.id);
    else
      sink.point(sink.ctx, p.position.data(), p.depth);
  for (std::size_t k = 0; k < o.candidate_pairs.size(); ++k)
    for (const auto& [a, b] : o.candidate_pairs[k]) sink.pair(sink.ctx, static_cast<int>(k), a, b);
  for (const SceneContact& c : o.contacts) sink.contact(sink.ctx, c.a, c.b, c.normal.data(), c.depth);
}

void fill(const Observation& o, ts_answer& out, const ts_sink& sink) {
  out.outcome = static_cast<std::int32_t>(o.outcome);
  kit::set_detail(out, o.detail);
  if (o.outcome != Outcome::answered) return;
  if (o.overlap) kit::set_overlap(out, *o.overlap);
  if (o.distance) kit::set_distance(out, *o.distance);
  if (o.witness) kit::set_points(out, (*o.witness)[0], (*o.witness)[1]);
  if (o.normal) kit::set_normal(out, *o.normal);
  if (o.depth) kit::set_depth(out, *o.depth);
  if (o.toi) kit::set_toi(out, *o.toi);
  out.claimed_tolerance = o.claimed_tolerance;
  fill_lists(o, sink);
}

class Plugin {
 public:
  static constexpr ts_question later_questions[] = {TS_WITHIN, TS_CANDIDATES_WITHIN, TS_RAY,
                                                    TS_CONTACT_WITHIN};
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> all;
    for (const Mutant& m : mutants()) {
      const EngineCard c = make_lying_engine(m)->card();
      all.push_back({c.name, c.library, c.version, "a lie: " + std::string(m.line), c.unit_roundoff,
                     c.tau_factor, c.source, c.complete_manifolds, more_shapes()});
    }
    return all;
  }
  explicit Plugin(unsigned index) : engine_(make_lying_engine(mutants()[index])) {}
  void load(const ts_scene& scene, const ts_received&) { case_.scene = scene_of(scene); }
  void unload() { case_ = {}; }
  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    case_.queries = {{static_cast<Question>(question), a, b}};
    fill(engine_->run({&case_, 1})[0].answers[0], out, sink);
  }

 private:
  EnginePtr engine_;
  Case case_;
};

}  // namespace
}  // namespace touchstone::mutants

TS_PLUGIN(touchstone::mutants::Plugin)
