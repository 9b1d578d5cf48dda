#include "cli/page_contents.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/input_error.h"
#include "core/broad/catalog.h"
#include "core/world/world.h"

namespace touchstone::fuzz {
namespace {

constexpr std::size_t pruned_shown = 4000;

bool meet(const Aabb& a, const Aabb& b, int axis) {
  return a.lo[axis] <= b.hi[axis] && b.lo[axis] <= a.hi[axis];
}

long cell_of(const BroadView::Grid& g, double x, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  const double t = (x - g.origin[k]) / g.cell[k];
  return t > 0 ? static_cast<long>(std::min(t, static_cast<double>(g.count[k] - 1))) : 0;
}

// True if some grid stores both boxes in a common cell.
bool share_cell(const std::vector<BroadView::Grid>& grids, const Aabb& a, const Aabb& b) {
  return std::any_of(grids.begin(), grids.end(), [&](const BroadView::Grid& g) {
    for (int k = 0; k < 3; ++k)
      if (cell_of(g, a.lo[k], k) > cell_of(g, b.hi[k], k) || cell_of(g, b.lo[k], k) > cell_of(g, a.hi[k], k))
        return false;
    return true;
  });
}

// True if some leaf of the tree overlaps both boxes.
bool share_node(const std::vector<std::vector<Aabb>>& nodes, const Aabb& a, const Aabb& b) {
  return std::any_of(nodes[0].begin(), nodes[0].end(),
                     [&](const Aabb& node) { return overlaps(node, a) && overlaps(node, b); });
}

// True if the acceleration structure makes the method compare the two boxes. Without one, all pairs are.
bool considers(const BroadView::Look& l, const Aabb& a, const Aabb& b) {
  if (!l.nodes.empty()) return share_node(l.nodes, a, b);
  if (!l.grids.empty()) return share_cell(l.grids, a, b);
  return l.sweep_axis < 0 || meet(a, b, l.sweep_axis);
}

BroadView::Look look_of(const broad::BroadPhase& phase) {
  const broad::Structure s = phase.structure();
  BroadView::Look l;
  l.explanation = phase.explain();
  l.sweep_axis = s.sweep_axis;
  l.nodes = s.nodes;
  for (const auto& g : s.grids) {
    BroadView::Grid grid;
    grid.along = g.along;
    std::copy_n(g.origin, 3, grid.origin.begin());
    std::copy_n(g.cell, 3, grid.cell.begin());
    std::copy_n(g.count, 3, grid.count.begin());
    l.grids.push_back(grid);
  }
  return l;
}

struct Run {
  const Scene& scene;
  BroadView& view;
  std::vector<broad::BroadPhasePtr> phases;
  std::vector<std::optional<Aabb>> boxes;

  void query() {
    BroadView::Frame f;
    f.boxes = boxes;
    for (std::size_t m = 0; m < phases.size(); ++m) {
      std::vector<broad::IdPair> all;
      phases[m]->pairs(all);
      std::vector<BodyPair> kept;
      for (const broad::IdPair& p : all)
        if (is_reported(scene, p.first, p.second)) kept.emplace_back(p.first, p.second);
      if (m > 0 && kept != f.kept)
        throw std::logic_error(view.methods[m] + " and " + view.methods[0] + " report different pairs");
      f.kept = std::move(kept);
      f.looks.push_back(look_of(*phases[m]));
    }
    count(f);
    view.frames.push_back(std::move(f));
  }

  void count(BroadView::Frame& f) const {
    for (std::size_t a = 0; a < boxes.size(); ++a)
      for (std::size_t b = a + 1; b < boxes.size(); ++b) {
        if (!boxes[a] || !boxes[b] || !is_reported(scene, static_cast<int>(a), static_cast<int>(b))) continue;
        ++f.all_pairs;
        for (int k = 0; k < 3; ++k)
          f.overlap_on_axis[static_cast<std::size_t>(k)] += meet(*boxes[a], *boxes[b], k);
        for (BroadView::Look& l : f.looks) {
          if (!considers(l, *boxes[a], *boxes[b])) continue;
          ++l.considered;
          if (!overlaps(*boxes[a], *boxes[b]) && l.pruned.size() < pruned_shown)
            l.pruned.emplace_back(static_cast<int>(a), static_cast<int>(b));
        }
      }
  }

  void step(const Step& s) {
    const auto i = static_cast<std::size_t>(s.body);
    if (s.op == Step::Op::remove) {
      for (const auto& p : phases) p->remove(s.body);
      boxes[i].reset();
      return;
    }
    boxes[i] = box_of(scene, s.body, s.pose ? *s.pose : scene.bodies[i].pose);
    const auto mobility = view.fixed[i] ? broad::Mobility::fixed : broad::Mobility::moving;
    for (const auto& p : phases)
      s.op == Step::Op::insert ? p->insert(s.body, *boxes[i], mobility) : p->move(s.body, *boxes[i]);
  }
};

}  // namespace

BroadView broad_view(const Scene& scene, const std::vector<std::string>& methods, std::size_t most_frames) {
  if (scene.bodies.size() > broad_view_most_bodies)
    throw InputError("scene " + scene.name, std::to_string(scene.bodies.size()) +
                                                " bodies; a picture takes at most " +
                                                std::to_string(broad_view_most_bodies));
  BroadView view;
  view.name = scene.name;
  view.methods = methods;
  for (const Body& b : scene.bodies) {
    view.bodies.push_back(b.name.empty() ? std::to_string(view.bodies.size()) : b.name);
    view.fixed.push_back(b.is_static);
  }
  Run run{scene, view, {}, {}};
  for (const std::string& m : methods) {
    run.phases.push_back(broad::make_broad_phase(m));
    if (run.phases.back() != nullptr) continue;
    std::string names;
    for (const auto& row : broad::catalog) names += (names.empty() ? "" : ", ") + std::string(row.name);
    throw InputError("--method " + m, "unknown; expected " + names);
  }
  run.boxes.resize(scene.bodies.size());
  for (const Step& s : effective_script(scene)) {
    if (s.op != Step::Op::query)
      run.step(s);
    else if (view.frames.size() < most_frames)
      run.query();
  }
  return view;
}

}  // namespace touchstone::fuzz
