#include "oracles/host/pipe_batch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "oracles/abi/pipe_scene.h"
#include "scenarios/value/observation.h"

namespace touchstone::host {

using pipe::Json;
using pipe::NotFinite;

static_assert(std::endian::native == std::endian::little, "the arrays are sent as they are");
static_assert(sizeof(ts_pose) == 7 * sizeof(double));

namespace {

template <class T>
void append(std::string& out, const T* numbers, std::size_t n) {
  out.append(reinterpret_cast<const char*>(numbers), n * sizeof(T));
}

void append_finite(std::string& out, const double* numbers, std::size_t n) {
  if (!std::all_of(numbers, numbers + n, [](double x) { return std::isfinite(x); })) throw NotFinite{};
  append(out, numbers, n);
}

struct Sums {
  std::size_t vertices = 0, triangles = 0;
};

Sums sums_of(const ts_batch& b) {
  Sums s;
  for (std::size_t i = 0; i < b.shape_count; ++i) {
    s.vertices += b.shapes[i].vertex_count;
    s.triangles += b.shapes[i].triangle_count;
  }
  return s;
}

void append_integers(std::string& out, const ts_batch& b) {
  const auto of_shapes = [&](auto number) {
    for (std::size_t i = 0; i < b.shape_count; ++i) {
      const auto n = static_cast<std::int32_t>(number(b.shapes[i]));
      append(out, &n, 1);
    }
  };
  const std::size_t start = out.size();
  of_shapes([](const ts_shape& s) { return s.kind; });
  of_shapes([](const ts_shape& s) { return s.vertex_count; });
  of_shapes([](const ts_shape& s) { return s.triangle_count; });
  append(out, b.shape_a, b.count);
  append(out, b.shape_b, b.count);
  for (std::size_t i = 0; i < b.shape_count; ++i)
    append(out, b.shapes[i].triangles, 3 * b.shapes[i].triangle_count);
  if ((out.size() - start) % sizeof(double) != 0) out.append(sizeof(std::int32_t), '\0');
}

void append_numbers(std::string& out, const ts_batch& b) {
  for (std::size_t i = 0; i < b.shape_count; ++i) append_finite(out, b.shapes[i].size, 4);
  for (std::size_t i = 0; i < b.shape_count; ++i)
    append_finite(out, b.shapes[i].vertices, 3 * b.shapes[i].vertex_count);
  for (const ts_pose* poses : {b.pose_a, b.pose_b}) append_finite(out, poses->translation, 7 * b.count);
  if (!b.motion_a) return;
  append_finite(out, b.motion_a, 6 * b.count);
  append_finite(out, b.motion_b, 6 * b.count);
}

}  // namespace

std::string batch_message(const ts_batch& b) {
  std::string arrays;
  append_integers(arrays, b);
  append_numbers(arrays, b);
  const Sums s = sums_of(b);
  const Json line = {{"ask_many", std::string(question_names.at(static_cast<std::size_t>(b.question)))},
                     {"count", b.count},
                     {"shapes", b.shape_count},
                     {"vertices", s.vertices},
                     {"triangles", s.triangles},
                     {"moving", b.motion_a != nullptr},
                     {"bytes", arrays.size()}};
  return line.dump() + "\n" + arrays;
}

/// The numbers of one pair, and where they go.
struct BatchAnswers::PairNumbers {
  const double* numbers;
  ts_answer& answer;
};

namespace {

using PairNumbers = BatchAnswers::PairNumbers;

constexpr std::size_t most_points_per_pair = 1024;

std::int32_t whole(double x, double least, double most) {
  if (!(x >= least && x <= most && x == std::floor(x)))
    throw std::runtime_error("the command's answers contain a number that is not one of those possible");
  return static_cast<std::int32_t>(x);
}

template <std::uint32_t bit, double ts_answer::*member>
void put_number(const PairNumbers& p) {
  p.answer.has |= bit;
  p.answer.*member = *p.numbers;
}
template <std::uint32_t bit, double (ts_answer::*member)[3]>
void put_vector(const PairNumbers& p) {
  p.answer.has |= bit;
  std::copy_n(p.numbers, 3, p.answer.*member);
}

}  // namespace

/// One of the arrays of an answer: `width` numbers a pair.
struct BatchAnswers::Field {
  std::string_view name;
  std::size_t width;
  void (*put)(const PairNumbers&);  // null: a receipt
};

namespace {

constexpr BatchAnswers::Field fields[] = {
    {"outcome", 1, [](const PairNumbers& p) { p.answer.outcome = whole(*p.numbers, TS_ANSWERED, TS_THREW); }},
    {"overlap", 1,
     [](const PairNumbers& p) {
       p.answer.has |= TS_HAS_OVERLAP;
       p.answer.overlap = whole(*p.numbers, 0, 1);
     }},
    {"distance", 1, put_number<TS_HAS_DISTANCE, &ts_answer::distance>},
    {"point_a", 3, put_vector<0, &ts_answer::point_a>},
    {"point_b", 3, put_vector<TS_HAS_POINTS, &ts_answer::point_b>},
    {"normal", 3, put_vector<TS_HAS_NORMAL, &ts_answer::normal>},
    {"depth", 1, put_number<TS_HAS_DEPTH, &ts_answer::depth>},
    {"toi", 1,
     [](const PairNumbers& p) {
       if (!std::isnan(*p.numbers)) put_number<TS_HAS_TOI, &ts_answer::toi>(p);
     }},
    {"claimed_tolerance", 1, [](const PairNumbers& p) { p.answer.claimed_tolerance = *p.numbers; }},
    {"size_a", 4, nullptr},
    {"size_b", 4, nullptr},
    {"matrix_a", 9, nullptr},
    {"matrix_b", 9, nullptr},
    {"translation_a", 3, nullptr},
    {"translation_b", 3, nullptr},
};

const BatchAnswers::Field& field_named(const std::string& name) {
  for (const BatchAnswers::Field& f : fields)
    if (f.name == name) return f;
  throw std::runtime_error("the command's answers have an unknown field: " + name.substr(0, 40));
}

/// What an answer that is none, or one about bodies that are apart, does not say.
void drop_unsaid(std::int32_t question, ts_answer& a) {
  if (a.outcome != TS_ANSWERED) a.has = 0;
  if (question == TS_CONTACT && (a.has & TS_HAS_OVERLAP) && a.overlap == 0) a.has = TS_HAS_OVERLAP;
}

}  // namespace

BatchAnswers::BatchAnswers(const nlohmann::ordered_json& line, const ts_batch& batch) : batch_(batch) {
  if (line.at("answers") != batch.count)
    throw std::runtime_error("the command answers another number of pairs than asked");
  for (const Json& name : line.at("fields")) fields_.push_back(&field_named(name.get<std::string>()));
  for (std::size_t i = 0; i < fields_.size(); ++i)
    if (std::find(fields_.begin(), fields_.begin() + static_cast<std::ptrdiff_t>(i), fields_[i]) !=
        fields_.begin() + static_cast<std::ptrdiff_t>(i))
      throw std::runtime_error("the command's answers have a field twice");
  const auto has = [&](std::string_view name) {
    return std::any_of(fields_.begin(), fields_.end(), [&](const Field* f) { return f->name == name; });
  };
  for (const auto& [one, other] : {std::pair("point_a", "point_b"),
                                   {"size_a", "size_b"},
                                   {"matrix_a", "translation_a"},
                                   {"matrix_b", "translation_b"}})
    if (has(one) != has(other))
      throw std::runtime_error("the command's answers have only one of the fields " + std::string(one) +
                               " and " + other);
  const std::size_t most_points = batch.count * most_points_per_pair;
  points_ = line.value("points", std::size_t{0});
  if (points_ > most_points) throw std::runtime_error("the command's answers have too many points");
  has_vertices_ = line.value("vertices", false);
  if (has_vertices_ && !has("size_a"))
    throw std::runtime_error("the command's answers have vertices, but neither size_a nor size_b");
  details_ = line.value("details", std::vector<std::string>());
  if (!details_.empty() && details_.size() != batch.count)
    throw std::runtime_error("the command's answers have another number of details than of pairs");
}

std::size_t BatchAnswers::vertex_numbers() const { return has_vertices_ ? 3 * sums_of(batch_).vertices : 0; }

std::size_t BatchAnswers::bytes() const {
  std::size_t numbers = vertex_numbers() + 5 * points_;
  for (const Field* f : fields_) numbers += f->width * batch_.count;
  return numbers * sizeof(double);
}

namespace {

/// The arrays of an answer by name; null if it has none of that name.
class Arrays {
 public:
  void add(std::string_view name, const double* numbers) { all_.push_back({name, numbers}); }
  const double* of_pair(std::string_view name, std::size_t i, std::size_t width) const {
    for (const auto& [n, numbers] : all_)
      if (n == name) return numbers + i * width;
    return nullptr;
  }

 private:
  std::vector<std::pair<std::string_view, const double*>> all_;
};

void report_received(const ts_batch& b, const Arrays& arrays, const double* vertices,
                     const ts_batch_sink& sink) {
  std::vector<const double*> vertices_of(b.shape_count);
  for (std::size_t s = 0; vertices && s < b.shape_count; ++s) {
    vertices_of[s] = vertices;
    vertices += 3 * b.shapes[s].vertex_count;
  }
  constexpr std::string_view size[] = {"size_a", "size_b"}, matrix[] = {"matrix_a", "matrix_b"},
                             translation[] = {"translation_a", "translation_b"};
  for (std::size_t i = 0; i < b.count; ++i)
    for (std::int32_t body = 0; body < 2; ++body) {
      const auto number = static_cast<std::size_t>((body == 0 ? b.shape_a : b.shape_b)[i]);
      const bool listed = b.shapes[number].vertex_count > 0;
      const double* const sizes = arrays.of_pair(size[body], i, 4);
      if (sizes && (!listed || vertices_of[number]))
        sink.received_shape(sink.ctx, i, body, sizes, vertices_of[number],
                            vertices_of[number] ? b.shapes[number].vertex_count : 0);
      if (const double* const m = arrays.of_pair(matrix[body], i, 9))
        sink.received_body(sink.ctx, i, body, m, arrays.of_pair(translation[body], i, 3));
    }
}

}  // namespace

void BatchAnswers::read(std::string_view bytes, ts_answer* answers, const ts_batch_sink& sink) const {
  std::vector<double> numbers(bytes.size() / sizeof(double));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  const double* next = numbers.data();
  Arrays receipts;
  for (std::size_t i = 0; i < batch_.count; ++i) answers[i].outcome = TS_ANSWERED;
  for (const Field* f : fields_) {
    if (!f->put) receipts.add(f->name, next);
    for (std::size_t i = 0; f->put && i < batch_.count; ++i) f->put({next + i * f->width, answers[i]});
    next += f->width * batch_.count;
  }
  const double* const points = next;
  const double* const vertices = has_vertices_ ? points + 5 * points_ : nullptr;
  for (std::size_t i = 0; i < batch_.count; ++i) {
    drop_unsaid(batch_.question, answers[i]);
    if (!details_.empty())
      std::snprintf(answers[i].detail, sizeof answers[i].detail, "%s", details_[i].c_str());
  }
  for (std::size_t k = 0; k < points_; ++k) {
    const double* const p = points + 5 * k;
    sink.point(sink.ctx, static_cast<std::size_t>(whole(p[0], 0, static_cast<double>(batch_.count - 1))),
               p + 1, p[4]);
  }
  report_received(batch_, receipts, vertices, sink);
}

}  // namespace touchstone::host
