#include "scenarios/import/real_scene.h"

#include <algorithm>
#include <charconv>

#include "core/base/input_error.h"
#include "oracles/referee/referee.h"
#include "scenarios/value/candidate_pairs.h"

namespace touchstone::fuzz {
namespace {

Aabb box_of(const Scene& s, int i) {
  const Body& b = s.bodies[static_cast<std::size_t>(i)];
  const Placed p{&s.shape_of(i), b.pose};
  return b.motion ? referee::outer_box(p, *b.motion) : referee::outer_box(p);
}

// The pairs that count whose boxes overlap, sorted.
std::vector<BodyPair> near_pairs(const Scene& s) {
  std::vector<BoxedBody> boxed;
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) boxed.push_back({box_of(s, i), i});
  auto pairs = overlapping_boxes(std::move(boxed));
  std::erase_if(pairs, [&](const BodyPair& p) { return !is_reportable(s, p.first, p.second); });
  return pairs;
}

int integer(const std::string& text, const std::string& whole) {
  int v = 0;
  const auto r = std::from_chars(text.data(), text.data() + text.size(), v);
  if (r.ec != std::errc{} || r.ptr != text.data() + text.size())
    throw InputError("--frames " + whole, "'" + text + "' is not an integer; expected first:end:step");
  return v;
}

}  // namespace

std::vector<int> frames_from_text(const std::string& text, int count) {
  std::vector<int> parts;
  for (std::size_t start = 0; start <= text.size() && !text.empty();) {
    const std::size_t end = std::min(text.find(':', start), text.size());
    parts.push_back(integer(text.substr(start, end - start), text));
    start = end + 1;
  }
  if (parts.size() == 1) parts.push_back(parts[0] + 1);
  const int first = parts.empty() ? 0 : parts[0], end = parts.empty() ? count : parts[1];
  const int step = parts.size() > 2 ? parts[2] : (parts.empty() ? std::max(1, count / 5) : 1);
  if (parts.size() > 3 || step <= 0 || first < 0 || end > count || first >= end)
    throw InputError("--frames " + text,
                     "not a range within the scene's " + std::to_string(count) + " frames");
  std::vector<int> frames;
  for (int f = first; f < end; f += step) frames.push_back(f);
  return frames;
}

std::vector<Case> real_scene_cases(const RealScene& scene, int frame) {
  const Scene moving = scene.frame_with_motion(frame);
  const std::string id = scene.name + "/" + std::to_string(frame);
  std::vector<Case> cases{{id,
                           scene.name,
                           scene.frame(frame),
                           {{Question::candidates, -1, -1}, {Question::scene_contacts, -1, -1}}}};
  for (const auto& [a, b] : near_pairs(moving)) {
    Case c{id + "/" + std::to_string(a) + "-" + std::to_string(b),
           scene.name,
           extract_pair(moving, a, b),
           {{Question::overlap, 0, 1}, {Question::distance, 0, 1}, {Question::contact, 0, 1}}};
    if (c.scene.bodies[0].motion || c.scene.bodies[1].motion)
      c.queries.push_back({Question::time_of_impact, 0, 1});
    cases.push_back(std::move(c));
  }
  return cases;
}

}  // namespace touchstone::fuzz
