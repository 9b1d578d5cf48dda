#include "library/touchstone.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <optional>
#include <string>

#include "core/base/input_error.h"
#include "fuzz/answer/pair_answer.h"
#include "fuzz/answer/query_line.h"
#include "fuzz/answer/stated_answer.h"
#include "oracles/checker/checker.h"
#include "oracles/referee/referee.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/value_codec.h"

struct touchstone_shape {
  touchstone::Shape shape;
};

namespace touchstone {
namespace {

using Json = nlohmann::ordered_json;

thread_local std::string last_error;

void remember(const char* words) noexcept {
  try {
    last_error = words;
  } catch (...) {
    last_error.clear();
  }
}

// The wall that no exception passes.
template <class F>
touchstone_status guarded(F&& f) noexcept {
  try {
    f();
    return TOUCHSTONE_OK;
  } catch (const InputError& e) {
    remember(e.what());
    return TOUCHSTONE_INVALID;
  } catch (const std::exception& e) {
    remember(e.what());
    return TOUCHSTONE_FAILED;
  } catch (...) {
    remember("unknown error");
    return TOUCHSTONE_FAILED;
  }
}

template <class T>
T& given(T* p, const char* name) {
  if (p == nullptr) throw InputError(name, "is NULL");
  return *p;
}

Vec3 vector_at(const double* v) { return {v[0], v[1], v[2]}; }
// Adding 0 turns -0 into 0.
void store(const Vec3& v, double* to) {
  for (int i = 0; i < 3; ++i) to[i] = v[i] + 0.0;
}

constexpr std::size_t pose_numbers = 7, motion_numbers = 6;

Pose pose_at(const double* poses, std::size_t i, const char* name) {
  if (poses == nullptr) return {};
  const double* p = poses + pose_numbers * i;
  const auto place = [&] { return std::string(name) + "[" + std::to_string(i) + "]"; };
  for (std::size_t k = 0; k < pose_numbers; ++k)
    if (!std::isfinite(p[k])) throw InputError(place(), "has a number that is not finite");
  const Pose pose{vector_at(p), {p[3], p[4], p[5], p[6]}};
  if (pose.rotation == Quat{0, 0, 0, 0}) throw InputError(place(), "has the quaternion 0");
  return pose;
}

std::optional<Motion> motion_at(const double* motions, std::size_t i, const char* name,
                                const touchstone_shape& of) {
  if (motions == nullptr) return std::nullopt;
  const double* m = motions + motion_numbers * i;
  const auto place = [&] { return std::string(name) + "[" + std::to_string(i) + "]"; };
  for (std::size_t k = 0; k < motion_numbers; ++k)
    if (!std::isfinite(m[k])) throw InputError(place(), "has a number that is not finite");
  const Motion motion{vector_at(m), vector_at(m + 3)};
  if (motion == Motion{}) return std::nullopt;
  if (!is_convex(kind_of(of.shape))) throw InputError(place(), "moves a half-space or a mesh");
  return motion;
}

double length_of(double x, const char* name) {
  if (!(std::isfinite(x) && x >= 0)) throw InputError(name, "must be a length, 0 or more");
  return x;
}

int verdict_of(referee::Verdict v) {
  return v == referee::Verdict::disjoint  ? TOUCHSTONE_DISJOINT
         : v == referee::Verdict::overlap ? TOUCHSTONE_OVERLAP
                                          : TOUCHSTONE_UNDECIDED;
}

touchstone_gap gap_of(const Placed& a, const Placed& b, double margin) {
  const referee::PairTruth t = referee::with_witness(referee::judge_pair(a, b), a, b);
  touchstone_gap g{};
  g.lo = t.gap.lo;
  g.hi = t.gap.hi;
  store(t.normal, g.normal);
  store(t.witness[0], g.witness_a);
  store(t.witness[1], g.witness_b);
  g.verdict = verdict_of(t.verdict);
  const referee::Verdict within = referee::judge_within(a, b, margin, t);
  g.within_margin = within == referee::Verdict::undecided ? -1 : within == referee::Verdict::overlap;
  return g;
}

touchstone_impact impact_of(const referee::TimeTruth& t) {
  using Verdict = referee::TimeTruth::Verdict;
  int verdict = TOUCHSTONE_UNDECIDED;
  if (t.verdict == Verdict::hit) verdict = TOUCHSTONE_IMPACT;
  if (t.verdict == Verdict::none) verdict = TOUCHSTONE_NO_IMPACT;
  return {t.t_lo, t.t_hi, t.least_gap.lo, t.least_gap.hi, verdict};
}

// One pair in question, from the arrays of a call.
struct Pair {
  Placed a, b;
  std::optional<Motion> motion_a, motion_b;
  bool moves() const { return motion_a || motion_b; }
  Scene scene() const {
    Scene s;
    s.shapes = {*a.shape, *b.shape};
    s.bodies.resize(2);
    s.bodies[0].pose = std::get<Pose>(a.pose);
    s.bodies[1].shape = 1;
    s.bodies[1].pose = std::get<Pose>(b.pose);
    s.bodies[0].motion = motion_a;
    s.bodies[1].motion = motion_b;
    return s;
  }
};

struct Pairs {
  const touchstone_shape *a, *b;
  const double *poses_a, *poses_b, *motions_a = nullptr, *motions_b = nullptr;
  Pair at(std::size_t i) const {
    given(a, "a");
    given(b, "b");
    return {{&a->shape, pose_at(poses_a, i, "poses_a")},
            {&b->shape, pose_at(poses_b, i, "poses_b")},
            motion_at(motions_a, i, "motions_a", *a),
            motion_at(motions_b, i, "motions_b", *b)};
  }
};

fuzz::StatedAnswer stated_of(const touchstone_stated& s) {
  constexpr int all = 63;  // the sum of all TOUCHSTONE_STATES_...
  if (s.stated <= 0 || s.stated > all) throw InputError("stated", "names nothing, or what does not exist");
  const auto has = [&](int what) { return (s.stated & what) != 0; };
  fuzz::StatedAnswer r;
  r.pair.outcome = Outcome::answered;
  if (has(TOUCHSTONE_STATES_OVERLAP)) r.pair.overlap = s.overlap != 0;
  if (has(TOUCHSTONE_STATES_DISTANCE)) r.pair.distance = s.distance;
  if (has(TOUCHSTONE_STATES_NORMAL)) r.pair.normal = vector_at(s.normal);
  if (has(TOUCHSTONE_STATES_DEPTH)) r.pair.depth = s.depth;
  if (has(TOUCHSTONE_STATES_WITNESS)) r.pair.witness = {vector_at(s.witness_a), vector_at(s.witness_b)};
  r.says_impact = has(TOUCHSTONE_STATES_IMPACT);
  if (r.says_impact && !std::isnan(s.time_of_impact)) r.pair.toi = s.time_of_impact;
  fuzz::complete(r);
  return r;
}

Judgement judged(const Pair& pair, const touchstone_stated& s, double tolerance, int single) {
  return fuzz::judge_stated(pair.scene(), stated_of(s),
                            {.single = single != 0, .tolerance = length_of(tolerance, "tolerance")});
}

int ruling_of(const Judgement& j) {
  switch (j.ruling()) {
    case Ruling::right:
      return TOUCHSTONE_RIGHT;
    case Ruling::wrong:
      return TOUCHSTONE_WRONG;
    case Ruling::undecided:
      return TOUCHSTONE_OPEN;
    default:
      return TOUCHSTONE_NOT_JUDGED;
  }
}

char* text_for_caller(const std::string& s) {
  char* copy = new char[s.size() + 1];
  std::memcpy(copy, s.c_str(), s.size() + 1);
  return copy;
}

std::string line_of(const Json& j) { return j.dump(-1, ' ', false, Json::error_handler_t::replace); }

Shape valid(Shape s) {
  validate(s);
  return s;
}

// The shape and the body that places it.
std::pair<Shape, Body> parsed_body(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  const bool is_json = first != std::string::npos && text[first] == '{';
  const Json any{{"type", "sphere"}, {"radius", 0}};
  Scene s = fuzz::scene_of_bodies(is_json ? parse_json(text, "body", {}) : Json(text), any, "");
  return {std::move(s.shapes[0]), s.bodies[0]};
}

Shape parsed_shape(const std::string& text) {
  auto [shape, body] = parsed_body(text);
  if (!(body.pose == Pose{}) || body.motion)
    throw InputError("shape", "has a place or a motion; parse a body");
  return std::move(shape);
}

void store(const Body& body, double* pose, double* motion) {
  const Quat& q = body.pose.rotation;
  store(body.pose.translation, pose);
  const double rotation[] = {q.x, q.y, q.z, q.w};
  std::memcpy(pose + 3, rotation, sizeof rotation);
  const Motion m = body.motion.value_or(Motion{});
  store(m.linear, motion);
  store(m.angular, motion + 3);
}

std::vector<Vec3> points_of(const double* points, std::size_t n) {
  if (n > 0) given(points, "points");
  std::vector<Vec3> all;
  for (std::size_t i = 0; i < n; ++i) {
    all.push_back(vector_at(points + 3 * i));
    if (!all.back().allFinite())
      throw InputError("points[" + std::to_string(i) + "]", "has a number that is not finite");
  }
  return all;
}

Json answer_json(const Pair& p) {
  Json j{{"touchstone_answer", 1}, {"scene", to_json(p.scene())}};
  j.update(fuzz::to_json(fuzz::answer_pair(p.a, p.b)));
  if (p.moves())
    j["time_of_impact"] = fuzz::to_json(
        fuzz::answer_motion(p.a, p.motion_a.value_or(Motion{}), p.b, p.motion_b.value_or(Motion{})));
  return j;
}

bool holds(const Pair& p, const std::string& certificate) {
  const Json j = parse_json(certificate, "certificate", {});
  if (!j.is_object()) throw InputError("certificate", "must be an object");
  if (j.contains("kind") && j["kind"] == "impact")
    return checker::check(impact_certificate_from_json(j), p.a, p.motion_a.value_or(Motion{}), p.b,
                          p.motion_b.value_or(Motion{}));
  return checker::check(certificate_from_json(j), p.a, p.b);
}

}  // namespace
}  // namespace touchstone

using namespace touchstone;

const char* touchstone_version(void) { return TOUCHSTONE_VERSION; }
const char* touchstone_last_error(void) { return last_error.c_str(); }

touchstone_status touchstone_parse_shape(const char* text, touchstone_shape** out) {
  return guarded([&] {
    touchstone_shape*& to = given(out, "out");
    to = new touchstone_shape{parsed_shape(&given(text, "text"))};
  });
}

touchstone_status touchstone_parse_body(const char* text, touchstone_shape** out, double* pose,
                                        double* motion) {
  return guarded([&] {
    touchstone_shape*& to = given(out, "out");
    given(pose, "pose");
    given(motion, "motion");
    auto [shape, body] = parsed_body(&given(text, "text"));
    to = new touchstone_shape{std::move(shape)};
    store(body, pose, motion);
  });
}

touchstone_status touchstone_hull(const double* points, size_t n, touchstone_shape** out) {
  return guarded([&] {
    touchstone_shape*& to = given(out, "out");
    to = new touchstone_shape{valid(Shape(make_hull(points_of(points, n))))};
  });
}

touchstone_status touchstone_mesh(const double* points, size_t n, const int* triangles, size_t m,
                                  touchstone_shape** out) {
  return guarded([&] {
    touchstone_shape*& to = given(out, "out");
    TriangleMesh mesh;
    mesh.vertices = points_of(points, n);
    if (m > 0) given(triangles, "triangles");
    for (std::size_t i = 0; i < m; ++i)
      mesh.triangles.push_back({triangles[3 * i], triangles[3 * i + 1], triangles[3 * i + 2]});
    to = new touchstone_shape{valid(Shape(std::move(mesh)))};
  });
}

void touchstone_free_shape(touchstone_shape* shape) { delete shape; }
void touchstone_free_text(char* text) { delete[] text; }

touchstone_status touchstone_gaps(const touchstone_shape* a, const double* poses_a, const touchstone_shape* b,
                                  const double* poses_b, size_t n, double margin, touchstone_gap* out) {
  return guarded([&] {
    const Pairs pairs{a, b, poses_a, poses_b};
    if (n > 0) given(out, "out");
    length_of(margin, "margin");
    for (std::size_t i = 0; i < n; ++i) pairs.at(i);  // all are valid before the first answer
    for (std::size_t i = 0; i < n; ++i) {
      const Pair p = pairs.at(i);
      out[i] = gap_of(p.a, p.b, margin);
    }
  });
}

touchstone_status touchstone_normals(const touchstone_shape* a, const double* pose_a,
                                     const touchstone_shape* b, const double* pose_b, double* normals,
                                     size_t capacity, size_t* count, int* complete) {
  return guarded([&] {
    const Pair p = Pairs{a, b, pose_a, pose_b}.at(0);
    if (capacity > 0) given(normals, "normals");
    int& is_complete = given(complete, "complete");
    std::size_t& found = given(count, "count");
    const referee::NearMinimalNormals all = referee::near_minimal_normals(p.a, p.b);
    is_complete = all.certified && !all.capped && !all.continuum;
    found = all.normals.size();
    for (std::size_t i = 0; i < std::min(capacity, all.normals.size()); ++i)
      store(all.normals[i], normals + 3 * i);
  });
}

touchstone_status touchstone_impacts(const touchstone_shape* a, const double* poses_a,
                                     const double* motions_a, const touchstone_shape* b,
                                     const double* poses_b, const double* motions_b, size_t n,
                                     touchstone_impact* out) {
  return guarded([&] {
    const Pairs pairs{a, b, poses_a, poses_b, motions_a, motions_b};
    if (n > 0) given(out, "out");
    for (std::size_t i = 0; i < n; ++i) pairs.at(i);
    for (std::size_t i = 0; i < n; ++i) {
      const Pair p = pairs.at(i);
      out[i] = impact_of(
          referee::judge_motion(p.a, p.motion_a.value_or(Motion{}), p.b, p.motion_b.value_or(Motion{})));
    }
  });
}

touchstone_status touchstone_answer(const touchstone_shape* a, const double* pose_a, const double* motion_a,
                                    const touchstone_shape* b, const double* pose_b, const double* motion_b,
                                    char** json) {
  return guarded([&] {
    const Pair p = Pairs{a, b, pose_a, pose_b, motion_a, motion_b}.at(0);
    char*& to = given(json, "json");
    to = text_for_caller(line_of(answer_json(p)));
  });
}

touchstone_status touchstone_check(const touchstone_shape* a, const double* pose_a, const double* motion_a,
                                   const touchstone_shape* b, const double* pose_b, const double* motion_b,
                                   const char* certificate, int* valid) {
  return guarded([&] {
    const Pair p = Pairs{a, b, pose_a, pose_b, motion_a, motion_b}.at(0);
    int& proves = given(valid, "valid");
    proves = holds(p, &given(certificate, "certificate"));
  });
}

touchstone_status touchstone_judge(const touchstone_shape* a, const double* poses_a, const double* motions_a,
                                   const touchstone_shape* b, const double* poses_b, const double* motions_b,
                                   size_t n, const touchstone_stated* stated, double tolerance,
                                   int single_precision, int* rulings) {
  return guarded([&] {
    const Pairs pairs{a, b, poses_a, poses_b, motions_a, motions_b};
    if (n > 0) given(stated, "stated");
    if (n > 0) given(rulings, "rulings");
    for (std::size_t i = 0; i < n; ++i) {
      pairs.at(i);
      stated_of(stated[i]);
    }
    for (std::size_t i = 0; i < n; ++i)
      rulings[i] = ruling_of(judged(pairs.at(i), stated[i], tolerance, single_precision));
  });
}

touchstone_status touchstone_explain(const touchstone_shape* a, const double* pose_a, const double* motion_a,
                                     const touchstone_shape* b, const double* pose_b, const double* motion_b,
                                     const touchstone_stated* stated, double tolerance, int single_precision,
                                     char** json) {
  return guarded([&] {
    char*& to = given(json, "json");
    const Pair p = Pairs{a, b, pose_a, pose_b, motion_a, motion_b}.at(0);
    const Judgement j = judged(p, given(stated, "stated"), tolerance, single_precision);
    to = text_for_caller(line_of(fuzz::judgement_to_json(j)));
  });
}
