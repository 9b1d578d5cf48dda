// Long scripts and crowds of boxes on a lattice, fine enough for random contacts and coarse enough for ties.
#include <cmath>

#include "scenarios/exhaustive/suites.h"

namespace touchstone::fuzz {
namespace {

double on_lattice(Rng& rng, double most, double step) {
  const auto n = static_cast<std::uint64_t>(2 * most / step) + 1;
  return static_cast<double>(rng.below(n)) * step - most;
}

Vec3 lattice_point(Rng& rng, double most, double step) {
  Vec3 p;
  for (double& x : p) x = on_lattice(rng, most, step);
  return p;
}

struct Script {
  Rng rng;
  Scene& s;
  double world = 4;
  std::vector<std::optional<Pose>> at;

  void bodies(std::uint64_t n) {
    for (std::uint64_t i = 0; i < n; ++i) {
      Vec3 h;
      for (double& x : h) x = static_cast<double>(rng.below(rng.chance(0.1) ? 40 : 9)) / 8;
      const bool fixed = rng.chance(0.2);
      add_box(s, {lattice_point(rng, world, 0.125), h}, fixed);
    }
    at.resize(s.bodies.size());
  }
  Pose somewhere() {
    return {lattice_point(rng, world, 0.125), turn_by_thirds(static_cast<unsigned>(rng.below(3)))};
  }

  void move(std::size_t b) {
    Pose p = *at[b];
    const auto kind = rng.below(8);
    if (kind == 0) p = somewhere();                                                   // teleport
    if (kind == 1) p.rotation = turn_by_thirds(static_cast<unsigned>(rng.below(3)));  // resize
    if (kind == 2) p.translation += lattice_point(rng, 256, 128);                     // may leave the world
    if (kind > 2) p.translation += lattice_point(rng, 0.125, 0.125);                  // drift
    for (double& x : p.translation)
      if (std::abs(x) > 1024) x = 0;
    at[b] = p;
    step_move(s, static_cast<int>(b), p);
  }
  void one() {
    const auto b = rng.below(at.size());
    if (!at[b]) {
      at[b] = somewhere();
      step_insert(s, static_cast<int>(b), *at[b]);
    } else if (rng.chance(0.12)) {
      at[b].reset();
      step_remove(s, static_cast<int>(b));
    } else if (rng.chance(0.03)) {  // refit: all move
      for (std::size_t i = 0; i < at.size(); ++i)
        if (at[i]) move(i);
    } else {
      move(b);
    }
  }
  void play(std::size_t steps) {
    while (s.script.size() < steps) {
      one();
      if (rng.chance(0.3)) step_query(s);
    }
    step_query(s);
  }
};

void scripted(const Draw& d, std::uint64_t stream, std::uint64_t most, std::size_t steps, Case& out) {
  Script script{Rng::stream(d.seed + 9, stream), out.scene, 4, {}};
  const std::uint64_t n = 2 + script.rng.below(most - 1);
  script.world = std::ceil(std::cbrt(static_cast<double>(n)));
  script.bodies(n);
  script.play(steps);
  out.queries = {{Question::candidates, -1, -1}};
}

}  // namespace

void long_scripts(const Draw& d, std::uint64_t index, Case& out) { scripted(d, index, 24, 500, out); }

void longest_script(const Draw& d, std::uint64_t index, Case& out) {
  scripted(d, index + (std::uint64_t{1} << 40), 40, d.scope == Scope::quick ? 20000 : 100000, out);
}

// 100 to 1,500 boxes, for which subjects that choose a method by the number of boxes choose another; five
// frames.
void moving_crowds(const Draw& d, std::uint64_t index, Case& out) {
  Script script{Rng::stream(d.seed + 10, index), out.scene, 4, {}};
  const std::uint64_t n = 100 + script.rng.below(script.rng.chance(0.2) ? 1400 : 400);
  script.world = std::ceil(std::cbrt(static_cast<double>(n)) * (script.rng.chance(0.3) ? 3 : 1));
  script.bodies(n);
  for (std::size_t b = 0; b < n; ++b) {
    script.at[b] = out.scene.bodies[b].pose;
    step_insert(out.scene, static_cast<int>(b));
  }
  step_query(out.scene);
  for (int frame = 0; frame < 4; ++frame) {
    const double share = script.rng.chance(0.5) ? 1 : 0.1;
    for (std::size_t b = 0; b < n; ++b)
      if (script.rng.chance(share)) script.move(b);
    step_query(out.scene);
  }
  out.queries = {{Question::candidates, -1, -1}};
}

void uniform_boxes(const Draw& d, std::uint64_t index, Case& out) {
  Rng rng = Rng::stream(d.seed + 11, index);
  const std::uint64_t n = 2 + rng.below(32);
  const double half = std::cbrt(2.0 * static_cast<double>(n)) / 2;
  const auto grid = [](double x) { return std::round(x * 1024) / 1024; };
  for (std::uint64_t i = 0; i < n; ++i) {
    Placing p;
    for (double& x : p.t) x = grid(rng.uniform(-half, half));
    for (double& x : p.h) x = grid(rng.uniform(0.125, 0.875));
    add_box(out.scene, p, rng.chance(0.2));
  }
  insert_all(out.scene);
  step_query(out.scene);
  out.queries = {{Question::candidates, -1, -1}};
}

}  // namespace touchstone::fuzz
