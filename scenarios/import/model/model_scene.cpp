#include <algorithm>

#include "scenarios/import/model/model.h"
#include "scenarios/import/pose_algebra.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

// The bodies of link i are those from first[i] on.
std::vector<int> first_bodies(const Model& m) {
  std::vector<int> first{0};
  for (const ModelLink& l : m.links) first.push_back(first.back() + static_cast<int>(l.shapes.size()));
  return first;
}

std::string body_name(const ModelLink& link, std::size_t shape) {
  if (link.shapes.size() == 1) return printable(link.name);
  const std::string& own = link.shapes[shape].name;
  return printable(own.empty() ? link.name + "#" + std::to_string(shape) : link.name + "/" + own);
}

// Equal shapes are stored once.
int shape_index(Scene& scene, const Shape& shape) {
  const auto it = std::find(scene.shapes.begin(), scene.shapes.end(), shape);
  if (it != scene.shapes.end()) return static_cast<int>(it - scene.shapes.begin());
  scene.shapes.push_back(shape);
  return static_cast<int>(scene.shapes.size()) - 1;
}

bool are_asked(const ModelShape& a, const ModelShape& b) {
  return (a.category & b.mask) != 0 || (b.category & a.mask) != 0;
}

void filter_by_masks(const Model& m, Scene& scene) {
  std::vector<const ModelShape*> shapes;
  for (const ModelLink& l : m.links)
    for (const ModelShape& s : l.shapes) shapes.push_back(&s);
  for (std::size_t b = 0; b < shapes.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (!are_asked(*shapes[a], *shapes[b]))
        scene.ignored.emplace_back(static_cast<int>(a), static_cast<int>(b));
}

void add_moves(const Model& m, const std::vector<Pose>& poses, const std::vector<char>& anchored,
               Scene& scene) {
  int body = 0;
  for (std::size_t i = 0; i < m.links.size(); ++i)
    for (const ModelShape& s : m.links[i].shapes) {
      if (!anchored[i]) scene.script.push_back({Step::Op::move, body, compose(poses[i], s.in_link)});
      ++body;
    }
  scene.script.push_back({});
}

}  // namespace

void place_bodies(const Model& model, const Configuration& at, Scene& scene) {
  const std::vector<Pose> poses = link_poses(model, at);
  std::size_t body = 0;
  for (std::size_t i = 0; i < model.links.size(); ++i)
    for (const ModelShape& s : model.links[i].shapes)
      scene.bodies[body++].pose = compose(poses[i], s.in_link);
}

Scene scene_of(const Model& model, std::span<const Configuration> configurations) {
  Scene scene;
  scene.name = printable(model.name);
  const std::vector<char> anchored = anchored_links(model);
  const std::vector<Pose> poses = link_poses(model, configurations[0]);
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const ModelLink& link = model.links[i];
    for (std::size_t k = 0; k < link.shapes.size(); ++k) {
      Body body;
      body.name = body_name(link, k);
      body.shape = shape_index(scene, link.shapes[k].shape);
      body.pose = compose(poses[i], link.shapes[k].in_link);
      body.is_static = anchored[i] != 0;
      body.group = link.shapes.size() > 1 ? static_cast<int>(i) : -1;
      scene.bodies.push_back(std::move(body));
    }
  }
  const std::vector<int> first = first_bodies(model);
  for (const auto& [a, b] : model.filters) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    for (int x = first[i]; x < first[i + 1]; ++x)
      for (int y = first[j]; y < first[j + 1]; ++y) scene.ignored.push_back(std::minmax(x, y));
  }
  filter_by_masks(model, scene);
  std::sort(scene.ignored.begin(), scene.ignored.end());
  scene.ignored.erase(std::unique(scene.ignored.begin(), scene.ignored.end()), scene.ignored.end());
  if (configurations.size() == 1) return scene;
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b)
    scene.script.push_back({Step::Op::insert, b, std::nullopt});
  scene.script.push_back({});
  for (const Configuration& c : configurations.subspan(1))
    add_moves(model, link_poses(model, c), anchored, scene);
  return scene;
}

}  // namespace touchstone
