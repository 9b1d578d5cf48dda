// Batches as a command behind a pipe gets and answers them.
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "core/math/rng.h"
#include "oracles/abi/pipe_scene.h"
#include "oracles/abi/plugin_scene.h"
#include "oracles/host/pipe_answer.h"
#include "oracles/host/pipe_batch.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"

using namespace touchstone;
using host::BatchAnswers;
using pipe::Json;

namespace {

// Three pairs of a sphere, a tetrahedron and a mesh of one triangle.
struct Sample {
  std::vector<Shape> shapes{Sphere{2}, make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}),
                            TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}};
  std::vector<std::vector<double>> vertices{3};
  std::vector<ts_shape> as_sent;
  std::vector<std::int32_t> a{0, 1, 0}, b{1, 0, 2};
  std::vector<ts_pose> pose_a{3}, pose_b{3};
  std::vector<double> motion = std::vector<double>(18, 0.5);
  ts_batch batch{};

  explicit Sample(Question q) {
    for (std::size_t i = 0; i < 3; ++i) {
      as_sent.push_back(shape_to(shapes[i], vertices[i]));
      Pose p;
      p.translation.x() = static_cast<double>(i);
      pose_a[i] = pose_b[i] = pose_to(p);
    }
    batch = {static_cast<int>(q), 0,       3,      as_sent.data(), 3, a.data(), b.data(), pose_a.data(),
             pose_b.data(),       nullptr, nullptr};
    if (q == Question::time_of_impact) batch.motion_a = batch.motion_b = motion.data();
  }
};

struct Seen {
  std::map<std::pair<std::size_t, int>, std::vector<double>> sizes, matrices;
  std::map<std::pair<std::size_t, int>, std::size_t> vertices;
  std::vector<std::pair<std::size_t, double>> points;
  std::vector<std::uint64_t> ids;
  ts_batch_sink sink() {
    return {
        this,
        [](void* ctx, std::size_t i, const double*, double depth) {
          static_cast<Seen*>(ctx)->points.emplace_back(i, depth);
        },
        [](void* ctx, std::size_t i, std::int32_t body, const double* size, const double* v, std::size_t n) {
          auto& s = *static_cast<Seen*>(ctx);
          s.sizes[{i, body}].assign(size, size + 4);
          double sum = 0;
          for (std::size_t k = 0; k < 3 * n; ++k) sum += v[k];
          if (!std::isnan(sum)) s.vertices[{i, body}] = n;
        },
        [](void*, std::size_t, std::int32_t, const ts_shape*) {},
        [](void* ctx, std::size_t i, std::int32_t body, const double* m, const double* t) {
          auto& s = *static_cast<Seen*>(ctx);
          s.matrices[{i, body}].assign(m, m + 9);
          s.matrices[{i, body}].insert(s.matrices[{i, body}].end(), t, t + 3);
        },
        [](void* ctx, std::size_t i, const double*, double depth, std::uint64_t id) {
          static_cast<Seen*>(ctx)->points.emplace_back(i, depth);
          static_cast<Seen*>(ctx)->ids.push_back(id);
        }};
  }
};

std::string bytes_of(const std::vector<double>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

struct Read {
  std::vector<ts_answer> answers;
  Seen seen;
};

Read read(const Sample& s, const Json& line, const std::vector<double>& numbers) {
  Read r{std::vector<ts_answer>(3, blank_answer()), {}};
  const BatchAnswers form(line, s.batch);
  REQUIRE(form.bytes() == numbers.size() * sizeof(double));
  form.read(bytes_of(numbers), r.answers.data(), r.seen.sink());
  return r;
}

}  // namespace

TEST_CASE("a batch is a line and arrays of the sizes that the line states", "[oracles][pipe][batch]") {
  for (const Question q : {Question::distance, Question::time_of_impact}) {
    const Sample s(q);
    const std::string message = host::batch_message(s.batch);
    const std::size_t end = message.find('\n');
    const Json line = test::parsed<Json>(message.substr(0, end));
    const bool moving = q == Question::time_of_impact;
    CHECK(line == Json({{"ask_many", std::string(to_string(q))},
                        {"count", 3},
                        {"shapes", 3},
                        {"vertices", 7},
                        {"triangles", 5},
                        {"moving", moving},
                        {"bytes", message.size() - end - 1}}));
    const std::size_t integers = 3 * 3 + 2 * 3 + 3 * 5, padded = integers + integers % 2;
    const std::size_t doubles = 4 * 3 + 3 * 7 + 2 * 7 * 3 + (moving ? 2 * 6 * 3 : 0);
    CHECK(message.size() - end - 1 == 4 * padded + 8 * doubles);
    std::vector<std::int32_t> whole(integers);
    std::memcpy(whole.data(), message.data() + end + 1, 4 * integers);
    CHECK(whole[0] == TS_SPHERE);
    CHECK(whole[2] == TS_MESH);
    CHECK((whole[4] == 4 && whole[8] == 1));
    CHECK((whole[10] == 1 && whole[14] == 2));
    double radius = 0;
    std::memcpy(&radius, message.data() + end + 1 + 4 * padded, 8);
    CHECK(radius == 2);
  }
  Sample infinite(Question::overlap);
  infinite.pose_b[1].translation[0] = HUGE_VAL;
  CHECK_THROWS_AS(host::batch_message(infinite.batch), pipe::NotFinite);
}

TEST_CASE("the arrays of a batch's answer are its fields, in the order of the line",
          "[oracles][pipe][batch]") {
  const Sample s(Question::contact);
  const Json line = {{"answers", 3},
                     {"fields",
                      {"depth", "overlap", "normal", "outcome", "claimed_tolerance", "size_a", "size_b",
                       "matrix_b", "translation_b"}},
                     {"points", 1},
                     {"vertices", true},
                     {"details", {"one", "two", "three"}}};
  std::vector<double> n{0.5, 0.25, 7};              // depth
  n.insert(n.end(), {1, 0, 1});                     // overlap
  n.insert(n.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1});   // normal
  n.insert(n.end(), {0, 0, 2});                     // outcome
  n.insert(n.end(), {0.125, 0, 0});                 // claimed_tolerance
  for (int k = 0; k < 24; ++k) n.push_back(k);      // sizes
  for (int k = 0; k < 27 + 9; ++k) n.push_back(k);  // of b
  n.insert(n.end(), {2, 0, 0, 0, -1.5});            // a point
  for (int k = 0; k < 21; ++k) n.push_back(k);      // vertices
  const Read r = read(s, line, n);
  CHECK(r.answers[0].outcome == TS_ANSWERED);
  CHECK(r.answers[0].has == (TS_HAS_OVERLAP | TS_HAS_DEPTH | TS_HAS_NORMAL));
  CHECK(r.answers[0].depth == 0.5);
  CHECK(r.answers[0].claimed_tolerance == 0.125);
  CHECK(r.answers[1].has == TS_HAS_OVERLAP);  // apart: nothing else is said
  CHECK(r.answers[2].outcome == TS_NOT_CONVERGED);
  CHECK(r.answers[2].has == 0);
  CHECK(std::string(r.answers[2].detail) == "three");
  CHECK(r.seen.points == std::vector<std::pair<std::size_t, double>>{{2, -1.5}});
  CHECK(r.seen.sizes.at({1, 0}) == std::vector<double>{4, 5, 6, 7});
  CHECK(r.seen.sizes.at({0, 1}) == std::vector<double>{12, 13, 14, 15});
  CHECK(r.seen.vertices.at({1, 0}) == 4);
  CHECK(r.seen.matrices.size() == 3);
  CHECK(r.seen.matrices.at({2, 1})[11] == 35);
  const Sample toi(Question::time_of_impact);
  const Read times = read(toi, {{"answers", 3}, {"fields", {"toi"}}}, {0.5, std::nan(""), 0});
  CHECK(times.answers[0].has == TS_HAS_TOI);
  CHECK(times.answers[1].has == 0);
  CHECK(times.answers[1].outcome == TS_ANSWERED);
}

TEST_CASE("a batch's answer that cannot be is refused", "[oracles][pipe][batch][bad-input]") {
  const Sample s(Question::contact);
  for (const char* line :
       {R"({"answers": 2, "fields": []})", R"({"fields": []})", R"({"answers": 3})",
        R"({"answers": 3, "fields": ["overlap", "overlap"]})", R"({"answers": 3, "fields": ["lies"]})",
        R"({"answers": 3, "fields": [1]})", R"({"answers": 3, "fields": ["point_a"]})",
        R"({"answers": 3, "fields": ["size_a"]})", R"({"answers": 3, "fields": ["matrix_a"]})",
        R"({"answers": 3, "fields": [], "points": 100000})",
        R"({"answers": 3, "fields": [], "vertices": true})",
        R"({"answers": 3, "fields": [], "details": ["one"]})",
        R"({"answers": 3, "fields": [], "points": "x"})"}) {
    INFO(line);
    CHECK_THROWS_AS(BatchAnswers(test::parsed<Json>(line), s.batch), std::exception);
  }
  for (const double bad : {2.0, 0.5, -1.0, static_cast<double>(NAN)}) {
    std::vector<ts_answer> answers(3, blank_answer());
    Seen seen;
    const BatchAnswers form({{"answers", 3}, {"fields", {"overlap"}}}, s.batch);
    CHECK_THROWS_AS(form.read(bytes_of({0, 1, bad}), answers.data(), seen.sink()), std::runtime_error);
    const BatchAnswers points({{"answers", 3}, {"fields", Json::array()}, {"points", 1}}, s.batch);
    if (bad != 2.0)
      CHECK_THROWS_AS(points.read(bytes_of({bad, 0, 0, 0, 0}), answers.data(), seen.sink()),
                      std::runtime_error);
  }
}

TEST_CASE("any numbers in a batch's answer are refused or read, nothing worse",
          "[oracles][pipe][batch][fuzz]") {
  Rng rng(5);
  const Sample s(Question::contact);
  const char* const names[] = {"outcome", "overlap", "normal", "depth",    "point_a",       "point_b",
                               "toi",     "size_a",  "size_b", "matrix_a", "translation_a", "distance"};
  int refused = 0, taken = 0;
  for (int round = 0; round < 20000; ++round) {
    Json fields = Json::array();
    for (const char* name : names)
      if (rng.chance(0.5)) fields.push_back(name);
    const Json line = {
        {"answers", 3}, {"fields", fields}, {"points", rng.below(4)}, {"vertices", rng.chance(0.3)}};
    try {
      const BatchAnswers form(line, s.batch);
      std::vector<double> n(form.bytes() / sizeof(double));
      for (double& x : n) {
        const auto style = rng.below(20);
        x = style == 0   ? NAN
            : style == 1 ? HUGE_VAL
            : style == 2 ? rng.uniform(-1e300, 1e300)
                         : static_cast<double>(rng.below(2));
      }
      std::vector<ts_answer> answers(3, blank_answer());
      Seen seen;
      form.read(bytes_of(n), answers.data(), seen.sink());
      ++taken;
      for (const ts_answer& a : answers) CHECK((a.outcome >= TS_ANSWERED && a.outcome <= TS_THREW));
      for (const auto& [i, depth] : seen.points) CHECK(i < 3);
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  CHECK(refused > 1000);
  CHECK(taken > 200);
}

TEST_CASE("a batch may be answered in lines, each with what was received", "[oracles][pipe][batch]") {
  const Sample s(Question::contact);
  const Json header = {{"answers", 3}, {"lines", true}};
  const auto read_lines = [&](const Json& first, std::vector<std::string> lines) {
    Read r{std::vector<ts_answer>(3, blank_answer()), {}};
    std::size_t next = 0;
    const auto next_line = [&] { return lines.at(next++); };
    host::read_answer_lines(first, s.batch, /*states_times=*/true, next_line, r.answers.data(),
                            r.seen.sink());
    CHECK(next == lines.size());
    return r;
  };
  const std::string apart = R"({"overlap": false, "ns": 7})",
                    refused = R"({"outcome": "unsupported", "detail": "no meshes"})",
                    deep = R"({"received": {"shapes": [{"shape": 1, "size": [2.5]}], "bodies": [{"body": 0,
      "matrix": [1, 0, 0, 0, 1, 0, 0, 0, 1], "translation": [5, 6, 7]}]}, "overlap": true, "normal": [0, 0, 1],
      "points": [{"position": [1, 2, 3], "depth": 0.5}, {"position": [1, 2, 4], "depth": 0.25, "id": 8}], "ns": 9})";
  const Read r = read_lines(header, {apart, deep, refused});
  CHECK(r.answers[0].has == TS_HAS_OVERLAP);
  CHECK(r.answers[0].ns == 7);
  CHECK(r.answers[1].has == (TS_HAS_OVERLAP | TS_HAS_NORMAL));  // a depth was not stated
  CHECK(r.answers[1].ns == 9);
  CHECK(r.answers[2].outcome == TS_UNSUPPORTED);
  CHECK(std::string(r.answers[2].detail) == "no meshes");
  CHECK(r.seen.points == std::vector<std::pair<std::size_t, double>>{{1, 0.5}, {1, 0.25}});
  CHECK(r.seen.ids == std::vector<std::uint64_t>{8});
  CHECK(r.seen.sizes.size() == 1);
  CHECK(r.seen.sizes.at({1, 1})[0] == 2.5);
  CHECK(r.seen.matrices.size() == 1);
  CHECK(r.seen.matrices.at({1, 0})[9] == 5);

  CHECK_THROWS_AS(read_lines({{"answers", 2}}, {apart, apart}), std::runtime_error);
  CHECK_THROWS_AS(read_lines(header, {apart, apart, R"({"overlap": false})"}), std::exception);  // no time
  CHECK_THROWS_AS(read_lines(header, {R"({"pairs": [[[0, 1]]], "ns": 1})", apart, apart}),
                  std::runtime_error);
  const std::string stranger =
      R"({"received": {"shapes": [{"shape": 2, "size": [1]}]}, "overlap": true, "ns": 1})";
  CHECK_THROWS_AS(read_lines(header, {stranger, apart, apart}), std::runtime_error);
  for (const std::string id : {"-1", "0.5", "\"corner\"", "null", "18446744073709551616"}) {
    const std::string named =
        R"({"overlap": true, "points": [{"position": [1, 2, 3], "id": )" + id + R"(}], "ns": 1})";
    CHECK_THROWS_AS(read_lines(header, {named, apart, apart}), std::runtime_error);
  }
}
