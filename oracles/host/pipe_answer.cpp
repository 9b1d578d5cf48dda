#include "oracles/host/pipe_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "oracles/abi/pipe_scene.h"

namespace touchstone::host {

using pipe::Json;

namespace {

constexpr double longest_ns = 1e15;  // of a time that a command states

void read3(const Json& j, double out[3]) {
  for (std::size_t k = 0; k < 3; ++k) out[k] = j.at(k).get<double>();
}

// Missing or null: not stated.
double depth_of_point(const Json& p) {
  return p.contains("depth") && !p.at("depth").is_null() ? p.at("depth").get<double>()
                                                         : std::numeric_limits<double>::quiet_NaN();
}

std::uint64_t id_of_point(const Json& p) {
  if (!p.at("id").is_number_unsigned())
    throw std::runtime_error("the command's id of a point is not a whole number from 0 to 2^64 - 1");
  return p.at("id").get<std::uint64_t>();
}

void read_lists(const Json& j, const ts_sink& sink) {
  double v[3];
  if (j.contains("pairs")) {
    std::int32_t k = 0;
    for (const Json& list : j.at("pairs")) {
      for (const Json& p : list)
        sink.pair(sink.ctx, k, p.at(0).get<std::int32_t>(), p.at(1).get<std::int32_t>());
      ++k;
    }
  }
  for (const Json& p : j.value("points", Json::array())) {
    read3(p.at("position"), v);
    if (p.contains("id"))
      sink.named_point(sink.ctx, v, depth_of_point(p), id_of_point(p));
    else
      sink.point(sink.ctx, v, depth_of_point(p));
  }
  for (const Json& c : j.value("contacts", Json::array())) {
    read3(c.at("normal"), v);
    sink.contact(sink.ctx, c.at("a").get<std::int32_t>(), c.at("b").get<std::int32_t>(), v,
                 c.at("depth").get<double>());
  }
}

// Which pair of a batch a line is about.
struct OfPair {
  const ts_batch_sink& sink;
  std::size_t i;
};

ts_sink sink_of(OfPair& pair) {
  return {&pair,
          [](void* ctx, const double position[3], double depth) {
            const OfPair& p = *static_cast<OfPair*>(ctx);
            p.sink.point(p.sink.ctx, p.i, position, depth);
          },
          [](void*, std::int32_t, std::int32_t, std::int32_t) {
            throw std::runtime_error("the command lists pairs in an answer about one");
          },
          [](void*, std::int32_t, std::int32_t, const double*, double) {
            throw std::runtime_error("the command lists contacts in an answer about one pair");
          },
          [](void* ctx, const double position[3], double depth, std::uint64_t id) {
            const OfPair& p = *static_cast<OfPair*>(ctx);
            p.sink.named_point(p.sink.ctx, p.i, position, depth, id);
          }};
}

// Body i of a line's scene has shape i.
ts_received received_of(OfPair& pair) {
  return {&pair,
          [](void* ctx, std::int32_t shape, const double size[4], const double* vertices, std::size_t n) {
            const OfPair& p = *static_cast<OfPair*>(ctx);
            p.sink.received_shape(p.sink.ctx, p.i, shape, size, vertices, n);
          },
          [](void* ctx, std::int32_t body, const double matrix[9], const double translation[3]) {
            const OfPair& p = *static_cast<OfPair*>(ctx);
            p.sink.received_body(p.sink.ctx, p.i, body, matrix, translation);
          },
          [](void* ctx, std::int32_t shape, const ts_shape* held) {
            const OfPair& p = *static_cast<OfPair*>(ctx);
            p.sink.received_other_shape(p.sink.ctx, p.i, shape, held);
          }};
}

}  // namespace

Json parsed(const std::string& line) {
  Json j = Json::parse(line, nullptr, false);
  if (!j.is_object())
    throw std::runtime_error("the command wrote a line that is not a JSON object: " +
                             line.substr(0, quoted_bytes));
  return j;
}

std::int32_t outcome_of(const std::string& name) {
  constexpr auto names =
      std::to_array<std::string_view>({"answered", "unsupported", "not_converged", "invalid_input", "threw"});
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<std::int32_t>(i);
  throw std::runtime_error("the command names an unknown outcome: " + name);
}

std::int64_t stated_ns(const Json& j) {
  const double ns = j.at("ns").get<double>();
  if (!(ns >= 0 && ns <= longest_ns)) throw std::runtime_error("the command states a time that is none");
  return std::max<std::int64_t>(1, std::llround(ns));
}

void read_answer(const Json& j, bool states_times, ts_answer& out, const ts_sink& sink) {
  out.outcome = outcome_of(j.value("outcome", "answered"));
  std::snprintf(out.detail, sizeof out.detail, "%s", j.value("detail", "").c_str());
  if (out.outcome != TS_ANSWERED) return;
  const auto number = [&](const char* name, std::uint32_t bit, double& field) {
    if (j.contains(name) && j.at(name).is_number()) {
      out.has |= bit;
      field = j.at(name).get<double>();
    }
  };
  number("distance", TS_HAS_DISTANCE, out.distance);
  number("depth", TS_HAS_DEPTH, out.depth);
  number("toi", TS_HAS_TOI, out.toi);
  number("lower", TS_HAS_LOWER, out.lower);
  number("upper", TS_HAS_UPPER, out.upper);
  if (j.contains("overlap")) {
    out.has |= TS_HAS_OVERLAP;
    out.overlap = j.at("overlap").get<bool>();
  }
  if (j.contains("normal")) {
    out.has |= TS_HAS_NORMAL;
    read3(j.at("normal"), out.normal);
  }
  if (j.contains("moment")) {
    out.has |= TS_HAS_MOMENT;
    read3(j.at("moment"), out.moment);
  }
  if (j.contains("unique_gradient")) {
    out.has |= TS_HAS_UNIQUE;
    out.unique_gradient = j.at("unique_gradient").get<bool>();
  }
  if (j.contains("point_a") && j.contains("point_b")) {
    out.has |= TS_HAS_POINTS;
    read3(j.at("point_a"), out.point_a);
    read3(j.at("point_b"), out.point_b);
  }
  out.claimed_tolerance = j.value("claimed_tolerance", 0.0);
  if (states_times) out.ns = stated_ns(j);
  read_lists(j, sink);
}

void read_answer_lines(const Json& header, const ts_batch& batch, bool states_times,
                       const std::function<std::string()>& next_line, ts_answer* answers,
                       const ts_batch_sink& sink) {
  if (header.at("answers") != batch.count)
    throw std::runtime_error("the command answers another number of pairs than asked");
  ts_scene two_bodies{};
  two_bodies.shape_count = two_bodies.body_count = 2;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const Json line = parsed(next_line());
    OfPair pair{sink, i};
    if (line.contains("received")) pipe::read_receipt(line["received"], two_bodies, received_of(pair));
    read_answer(line, states_times, answers[i], sink_of(pair));
  }
}

}  // namespace touchstone::host
