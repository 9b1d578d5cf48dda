// ODE's spaces, each as an engine that answers only `candidates`: dSpaceCollide calls back for every pair
// whose AABBs it finds to overlap.
#include <optional>

#include "core/math/roundoff.h"
#include "oracles/ode/shapes.h"

namespace touchstone::ode_adapter {
namespace {

// The extent of the quadtree along its x and y axes; geometries outside belong to its root.
const dVector3 centre{0, 0, 0, 0}, extents{1000, 1000, 1000, 0};

struct Row {
  const char *name, *settings;
  dSpaceID (*make)();
};
constexpr Row rows[] = {
    {"ode-simple", "dSimpleSpace", [] { return dSimpleSpaceCreate(nullptr); }},
    {"ode-hash", "dHashSpace, levels as shipped", [] { return dHashSpaceCreate(nullptr); }},
    {"ode-quadtree", "dQuadTreeSpace of ±1000, depth 6",
     [] { return dQuadTreeSpaceCreate(nullptr, centre, extents, 6); }},
    {"ode-sap", "dSweepAndPruneSpace, axes x, y, z",
     [] { return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ); }},
};

struct DestroySpace {
  void operator()(dSpaceID s) const { dSpaceDestroy(s); }
};

// A geometry must be removed from its space before either is destroyed. (For a quadtree, dSpaceGetGeom aborts
// as not implemented.)
class Space {
 public:
  Space(const Row& row, const std::vector<GeomPtr>& geoms) : geoms_(geoms), space_(row.make()) {
    dSpaceSetCleanup(space_.get(), 0);
  }
  ~Space() {
    for (const GeomPtr& g : geoms_)
      if (dGeomGetSpace(g.get()) == space_.get()) dSpaceRemove(space_.get(), g.get());
  }
  Space(const Space&) = delete;
  Space& operator=(const Space&) = delete;
  dSpaceID id() const { return space_.get(); }

 private:
  const std::vector<GeomPtr>& geoms_;
  std::unique_ptr<dxSpace, DestroySpace> space_;
};

struct Report {
  const ts_sink& sink;
  const kit::PairFilter& filter;
  std::int32_t query;
};

void on_pair(void* data, dGeomID one, dGeomID two) {
  const Report& r = *static_cast<const Report*>(data);
  const auto number = [](dGeomID g) {
    return static_cast<int>(reinterpret_cast<std::intptr_t>(dGeomGetData(g)));
  };
  const int a = number(one), b = number(two);
  if (r.filter.is_reportable(a, b)) r.sink.pair(r.sink.ctx, r.query, a, b);
}

void run_steps(const Row& row, const World& world, const ts_sink& sink) {
  const ts_scene& scene = world.scene();
  Space space(row, world.geoms());
  const kit::PairFilter filter(scene);
  const auto apply = [&](const ts_step& step) {
    if (step.op == TS_REMOVE) return dSpaceRemove(space.id(), world.geom(step.body));
    world.put(step.body, step.pose);
    if (step.op == TS_INSERT) dSpaceAdd(space.id(), world.geom(step.body));
  };
  kit::run_script(scene, apply, [&](int k) {
    Report report{sink, filter, k};
    dSpaceCollide(space.id(), &report, on_pair);
  });
}

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> all;
    for (const Row& r : rows)
      all.push_back({r.name, "ODE", dODE_VERSION, std::string(r.settings) + " alone", double_roundoff,
                     kit::oracle_tau_factor, "collision_space.cpp: no tolerance"});
    return all;
  }
  explicit Engine(unsigned index) : row_(rows[index]) {}
  void load(const ts_scene& scene, const ts_received& received) { world_.emplace(scene, received); }
  void unload() { world_.reset(); }
  void ask(ts_question question, int, int, ts_answer&, const ts_sink& sink) {
    if (question != TS_CANDIDATES) throw kit::Unsupported("a broad phase only");
    world_->require_sizes();
    run_steps(row_, *world_, sink);
  }

 private:
  const Row& row_;
  std::optional<World> world_;
};

}  // namespace
}  // namespace touchstone::ode_adapter

TS_PLUGIN(touchstone::ode_adapter::Engine)
