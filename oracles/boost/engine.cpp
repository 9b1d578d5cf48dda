// Boost.Geometry's R-trees as broad phases: a value is the box of a body and its number; a body that moves is
// removed and inserted; the pairs are those that query(intersects(box)) finds for each body. Boxes are
// doubles.
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/version.hpp>
#include <iterator>
#include <map>
#include <memory>

#include "core/math/roundoff.h"
#include "oracles/abi/plugin_kit.h"

namespace touchstone::boost_adapter {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Value = std::pair<Box, int>;

constexpr int most_elements = 16;  // of a node, as in the library's examples

// Infinite sides become the largest double.
Point point(const Vec3& p) {
  const double most = std::numeric_limits<double>::max();
  return {std::clamp(p.x(), -most, most), std::clamp(p.y(), -most, most), std::clamp(p.z(), -most, most)};
}
Box tree_box(const Aabb& b) {
  if (!(b.lo.array() <= b.hi.array()).all())
    throw kit::Unsupported("Boost.Geometry refuses boxes that are not valid");
  return {point(b.lo), point(b.hi)};
}

class Phase {
 public:
  virtual ~Phase() = default;
  virtual void put(int body, const Box& box) = 0;
  virtual void remove(int body) = 0;
  /// Pairs a < b.
  virtual std::vector<std::pair<int, int>> pairs() const = 0;
};

template <class Parameters>
class Tree : public Phase {
 public:
  void put(int body, const Box& box) override {
    if (boxes_.contains(body)) remove(body);
    tree_.insert({box, body});
    boxes_.emplace(body, box);
  }
  void remove(int body) override {
    tree_.remove(Value{boxes_.at(body), body});
    boxes_.erase(body);
  }
  std::vector<std::pair<int, int>> pairs() const override {
    std::vector<std::pair<int, int>> found;
    for (const auto& [a, box] : boxes_) {
      std::vector<Value> near;
      tree_.query(bg::index::intersects(box), std::back_inserter(near));
      for (const Value& v : near)
        if (a < v.second) found.emplace_back(a, v.second);
    }
    return found;
  }

 private:
  bg::index::rtree<Value, Parameters> tree_;
  std::map<int, Box> boxes_;
};

struct Row {
  const char *name, *settings;
  std::unique_ptr<Phase> (*make)();
};
template <class Parameters>
std::unique_ptr<Phase> make() {
  return std::make_unique<Tree<Parameters>>();
}
constexpr Row rows[] = {
    {"boost-rtree", "rstar<16>", &make<bg::index::rstar<most_elements>>},
    {"boost-rtree-quadratic", "quadratic<16>", &make<bg::index::quadratic<most_elements>>},
    {"boost-rtree-linear", "linear<16>", &make<bg::index::linear<most_elements>>},
};

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> all;
    for (const Row& r : rows)
      all.push_back({r.name, "Boost.Geometry", BOOST_LIB_VERSION,
                     std::string("index::rtree, ") + r.settings + ", query(intersects(box)) for each body",
                     double_roundoff, kit::oracle_tau_factor, "boost/geometry/index: no tolerance"});
    return all;
  }
  explicit Engine(unsigned index) : row_(rows[index]) {}

  void load(const ts_scene& scene, const ts_received&) {
    scene_ = &scene;
    filter_ = kit::PairFilter(scene);
  }
  void unload() { scene_ = nullptr; }

  void ask(ts_question question, int, int, ts_answer&, const ts_sink& sink) {
    if (question != TS_CANDIDATES) throw kit::Unsupported("a broad phase only");
    const auto phase = row_.make();
    const auto apply = [&](const ts_step& step) {
      if (step.op == TS_REMOVE) return phase->remove(step.body);
      phase->put(step.body, tree_box(kit::box_of(*scene_, step)));
    };
    kit::run_script(*scene_, apply, [&](int k) {
      for (const auto& [a, b] : phase->pairs())
        if (filter_.is_reportable(a, b)) sink.pair(sink.ctx, k, a, b);
    });
  }

 private:
  const Row& row_;
  const ts_scene* scene_ = nullptr;
  kit::PairFilter filter_;
};

}  // namespace
}  // namespace touchstone::boost_adapter

TS_PLUGIN(touchstone::boost_adapter::Engine)
