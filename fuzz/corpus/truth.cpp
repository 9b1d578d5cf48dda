#include "fuzz/corpus/truth.h"

#include <algorithm>
#include <cmath>

#include "scenarios/codec/json_file.h"
#include "scenarios/codec/value_codec.h"

namespace touchstone::fuzz::corpus {
namespace {

// Bytes of JSON. A certificate of polytopes and balls has a few hundred.
constexpr std::size_t longest_certificate = 4096;

void drop_if_long(Certificate& c) {
  c.note.clear();
  if (json_text(to_json(c)).size() > longest_certificate) c = {};
}

double size_of(const Shape& s) { return bounding_radius(s); }

// Where the axes of capsules cross, the search for all normals takes minutes.
bool has_quick_normals(const Scene& s) {
  return kind_of(s.shapes[0]) != ShapeKind::capsule && kind_of(s.shapes[1]) != ShapeKind::capsule;
}

// Which of them is flat, and how the bodies lie to each other, as far as an engine notices.
std::vector<std::string> degeneracy_of(const Scene& s, const referee::Bracket& gap, double l,
                                       const PairAnswer* pair) {
  std::vector<std::string> flags;
  const double most = std::max(std::abs(gap.lo), std::abs(gap.hi));
  if (most <= std::ldexp(l, -exponent_of_double))
    flags.emplace_back("touching");
  else if (most <= std::ldexp(l, -exponent_of_single))
    flags.emplace_back("near-touching");
  const auto flat = [](const Shape& x) {
    return std::visit([](const auto& y) { return y.inner_radii().anywhere; }, x) == 0;
  };
  if (flat(s.shapes[0]) || flat(s.shapes[1])) flags.emplace_back("flat");
  if (pair && pair->normals && pair->truth.verdict == referee::Verdict::overlap &&
      (pair->normals->continuum || pair->normals->normals.size() > 1))
    flags.emplace_back("ties");
  if (s.bodies[0].pose.translation == s.bodies[1].pose.translation) flags.emplace_back("concentric");
  const auto quaternion_off = [](const Quat& q) {
    constexpr double visible = 1e-6;  // more than rounding in floats
    return std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) > visible;
  };
  if (quaternion_off(s.bodies[0].pose.rotation) || quaternion_off(s.bodies[1].pose.rotation))
    flags.emplace_back("quaternion");
  if (flags.empty()) flags.emplace_back("none");
  return flags;
}

std::string size_class(const Scene& s) {
  const double a = size_of(s.shapes[0]), b = size_of(s.shapes[1]), large = std::max(a, b),
               small = std::min(a, b);
  const double far = std::max(s.bodies[0].pose.translation.norm(), s.bodies[1].pose.translation.norm());
  // Where flags begin: sizes in the scene's unit, ratios of sizes, and distances in sizes.
  constexpr double tiny = 0.01, huge = 1000, many = 100;
  if (large < tiny) return "tiny";
  if (far > many * large) return "far";
  if (large > many * small) return "unequal";
  if (large > huge) return "huge";
  return "unit";
}

}  // namespace

std::variant<CorpusCase, std::string> with_truth(const Seed& seed) {
  CorpusCase c;
  c.seed = seed;
  const Scene& s = c.seed.scene;
  c.scale = scale_of_pair(s, 0, 1);
  if (c.scale == 0) return "both bodies are the origin: no tolerance can be stated";
  c.size = size_class(s);
  if (questions_about(s)[0] == Question::time_of_impact) {
    c.motion = motion_facts(s);
    if (!c.motion) return "the first contact, or when it may be reported, is not decided";
    if (c.motion->answer.certificate &&
        json_text(to_json(*c.motion->answer.certificate)).size() > longest_certificate)
      c.motion->answer.certificate.reset();
    c.degeneracy = degeneracy_of(s, c.motion->answer.truth.least_gap, c.scale, nullptr);
    return c;
  }
  const Placed a{&s.shapes[0], s.bodies[0].pose}, b{&s.shapes[1], s.bodies[1].pose};
  c.pair = answer_pair(a, b, {.certificates = true, .normals = has_quick_normals(s), .gradients = false});
  if (c.pair->truth.verdict == referee::Verdict::undecided || !std::isfinite(c.pair->truth.gap.lo))
    return "the verdict is not decided";
  for (Certificate* x : {&c.pair->proof->verdict, &c.pair->proof->at_least, &c.pair->proof->at_most})
    drop_if_long(*x);
  c.exact = exact_gap(a, b, c.pair->truth.gap);
  c.degeneracy = degeneracy_of(s, c.pair->truth.gap, c.scale, &*c.pair);
  return c;
}

}  // namespace touchstone::fuzz::corpus
