#include "oracles/abi/protocol.h"

#include <algorithm>

#include "scenarios/text/printable.h"

namespace touchstone::protocol {
namespace {

constexpr std::uint32_t magic = 0x31505354;  // "TSP1"
constexpr const char* not_a_frame = "not the start of a frame";
constexpr std::size_t header_bytes = 16;
constexpr std::size_t compact_beyond_bytes = std::size_t{1} << 16;  // consumed bytes kept before compacting

/// Writes the header with a placeholder for the length, runs `body`, then fills in the length.
template <class F>
void framed(std::string& out, Type type, F&& body) {
  const std::size_t start = out.size();
  Writer w(out);
  w.put(magic).put(version).put(static_cast<std::uint16_t>(type)).put(std::uint32_t{0}).put(std::uint32_t{0});
  body(w);
  const auto length = static_cast<std::uint32_t>(out.size() - start - header_bytes);
  std::memcpy(out.data() + start + 8, &length, sizeof length);
}

enum Present : std::uint16_t {
  has_overlap = 1,
  has_distance = 2,
  has_witness = 4,
  has_normal = 8,
  has_depth = 16,
  has_toi = 32,
  has_lists = 64,
  has_lower = 128,
  has_upper = 256,
  has_moment = 512,
  has_unique = 1024,
  has_ids = 2048,
  all_present = 4095
};

bool has_id(const ManifoldPoint& p) { return p.id.has_value(); }

void put_ids(Writer& w, const std::vector<ManifoldPoint>& manifold) {
  for (const ManifoldPoint& p : manifold) {
    w.put(static_cast<std::uint8_t>(has_id(p)));
    if (p.id) w.put(*p.id);
  }
}

void get_ids(Reader& r, std::vector<ManifoldPoint>& manifold) {
  for (ManifoldPoint& p : manifold)
    if (r.flag()) p.id = r.get<std::uint64_t>();
}

void put_lists(Writer& w, const Observation& o) {
  w.count(o.manifold.size());
  for (const ManifoldPoint& p : o.manifold) w.put(p.position).put(p.depth);
  w.count(o.candidate_pairs.size());
  for (const auto& pairs : o.candidate_pairs) {
    w.count(pairs.size());
    for (auto [a, b] : pairs) w.put(a).put(b);
  }
  w.count(o.contacts.size());
  for (const SceneContact& c : o.contacts) w.put(c.a).put(c.b).put(c.normal).put(c.depth);
}

void get_lists(Reader& r, Observation& o) {
  o.manifold.resize(r.count(32));
  for (ManifoldPoint& p : o.manifold) {
    p.position = r.vec3();
    p.depth = r.get<double>();
  }
  o.candidate_pairs.resize(r.count(4));
  for (auto& pairs : o.candidate_pairs) {
    pairs.resize(r.count(8));
    for (auto& [a, b] : pairs) {
      a = r.get<std::int32_t>();
      b = r.get<std::int32_t>();
    }
  }
  o.contacts.resize(r.count(40));
  for (SceneContact& c : o.contacts) {
    c.a = r.get<std::int32_t>();
    c.b = r.get<std::int32_t>();
    c.normal = r.vec3();
    c.depth = r.get<double>();
  }
}

}  // namespace

void put_observation(Writer& w, const Observation& o) {
  const bool lists = !o.manifold.empty() || !o.candidate_pairs.empty() || !o.contacts.empty();
  const bool ids = std::any_of(o.manifold.begin(), o.manifold.end(), has_id);
  const auto present = static_cast<std::uint16_t>(
      (o.overlap ? has_overlap : 0) | (o.distance ? has_distance : 0) | (o.witness ? has_witness : 0) |
      (o.normal ? has_normal : 0) | (o.depth ? has_depth : 0) | (o.toi ? has_toi : 0) |
      (lists ? has_lists : 0) | (o.lower_bound ? has_lower : 0) | (o.upper_bound ? has_upper : 0) |
      (o.moment ? has_moment : 0) | (o.unique_gradient ? has_unique : 0) | (ids ? has_ids : 0));
  w.put(static_cast<std::uint8_t>(o.outcome)).put(present).text(o.detail);
  w.put(o.claimed_tolerance).put(o.elapsed_ns);
  if (o.overlap) w.put(static_cast<std::uint8_t>(*o.overlap));
  if (o.distance) w.put(*o.distance);
  if (o.witness) w.put((*o.witness)[0]).put((*o.witness)[1]);
  if (o.normal) w.put(*o.normal);
  if (o.depth) w.put(*o.depth);
  if (o.toi) w.put(*o.toi);
  if (o.lower_bound) w.put(*o.lower_bound);
  if (o.upper_bound) w.put(*o.upper_bound);
  if (o.moment) w.put(*o.moment);
  if (o.unique_gradient) w.put(static_cast<std::uint8_t>(*o.unique_gradient));
  if (lists) put_lists(w, o);
  if (ids) put_ids(w, o.manifold);
}

Observation get_observation(Reader& r) {
  Observation o;
  o.outcome = static_cast<Outcome>(r.tag(static_cast<std::uint8_t>(outcome_names.size())));
  const auto present = r.get<std::uint16_t>();
  if (present > all_present) throw Malformed("an unknown field");
  o.detail = printable(r.text(), "\n\t");
  o.claimed_tolerance = r.get<double>();
  o.elapsed_ns = r.get<std::int64_t>();
  if (present & has_overlap) o.overlap = r.flag();
  if (present & has_distance) o.distance = r.get<double>();
  if (present & has_witness) {
    const Vec3 a = r.vec3(), b = r.vec3();
    o.witness = {a, b};
  }
  if (present & has_normal) o.normal = r.vec3();
  if (present & has_depth) o.depth = r.get<double>();
  if (present & has_toi) o.toi = r.get<double>();
  if (present & has_lower) o.lower_bound = r.get<double>();
  if (present & has_upper) o.upper_bound = r.get<double>();
  if (present & has_moment) o.moment = r.vec3();
  if (present & has_unique) o.unique_gradient = r.flag();
  if (present & has_lists) get_lists(r, o);
  if (present & has_ids) get_ids(r, o.manifold);
  return o;
}

void FrameReader::append(const char* data, std::size_t n) {
  if (begin_ == buffer_.size()) {
    buffer_.clear();
    begin_ = 0;
  }
  if (begin_ > compact_beyond_bytes) {
    buffer_.erase(0, begin_);
    begin_ = 0;
  }
  buffer_.append(data, n);
}

std::optional<Frame> FrameReader::next() {
  const std::string_view rest = std::string_view(buffer_).substr(begin_);
  if (rest.size() < header_bytes) {
    // Stray output shorter than a header must not make us wait for bytes that never come.
    const std::size_t n = std::min(rest.size(), sizeof magic);
    if (n > 0 && std::memcmp(rest.data(), &magic, n) != 0) throw Malformed(not_a_frame);
    return std::nullopt;
  }
  Reader header(rest.substr(0, header_bytes));
  if (header.get<std::uint32_t>() != magic) throw Malformed(not_a_frame);
  if (header.get<std::uint16_t>() != version) throw Malformed("a different protocol version");
  const auto type = header.get<std::uint16_t>();
  const auto length = header.get<std::uint32_t>();
  if (type < 1 || type > 4 || header.get<std::uint32_t>() != 0) throw Malformed("a bad frame header");
  if (length > max_payload_bytes) throw Malformed("a frame longer than the limit");
  if (rest.size() - header_bytes < length) return std::nullopt;
  begin_ += header_bytes + length;
  return Frame{static_cast<Type>(type), rest.substr(header_bytes, length)};
}

void append(std::string& out, const Hello& m) {
  framed(out, Type::hello, [&](Writer& w) {
    w.count(m.cards.size());
    for (const std::string& c : m.cards) w.text(c);
    w.put(m.chosen)
        .text(m.error)
        .text(m.sandbox)
        .put(static_cast<std::uint8_t>(m.batches))
        .text(m.built_from);
  });
}

void append(std::string& out, const QuestionRef& m) {
  framed(out, Type::question, [&](Writer& w) {
    w.put(m.sequence).put(m.first_query).put(m.fill).put(static_cast<std::uint8_t>(m.alone));
    put_scene(w, m.scene);
    w.count(m.queries.size());
    for (const Query& q : m.queries) w.put(static_cast<std::uint8_t>(q.question)).put(q.a).put(q.b);
  });
}

void append(std::string& out, const ReceivedMessage& m) {
  framed(out, Type::received, [&](Writer& w) {
    w.put(m.sequence);
    put_received(w, m.scene);
  });
}

void append(std::string& out, const AnswerMessage& m) {
  framed(out, Type::answer, [&](Writer& w) {
    w.put(m.sequence).put(m.query);
    put_observation(w, m.observation);
  });
}

Hello decode_hello(std::string_view payload) {
  Reader r(payload);
  Hello m;
  m.cards.resize(r.count(4));
  for (std::string& c : m.cards) c = valid_utf8(r.text());
  m.chosen = r.get<std::int32_t>();
  m.error = valid_utf8(r.text());
  m.sandbox = printable(r.text());
  m.batches = r.flag();
  m.built_from = printable(r.text());
  r.finish();
  if (m.chosen < -1 || m.chosen >= static_cast<std::int32_t>(m.cards.size()))
    throw Malformed("hello names an engine that it does not list");
  return m;
}

QuestionMessage decode_question(std::string_view payload) {
  Reader r(payload);
  QuestionMessage m;
  m.sequence = r.get<std::uint64_t>();
  m.first_query = r.get<std::uint32_t>();
  m.fill = r.get<std::uint8_t>();
  m.alone = r.flag();
  m.scene = get_scene(r);
  m.queries.resize(r.count(9));
  for (Query& q : m.queries) {
    q.question = static_cast<Question>(r.tag(static_cast<std::uint8_t>(question_names.size())));
    q.a = r.get<std::int32_t>();
    q.b = r.get<std::int32_t>();
  }
  r.finish();
  return m;
}

ReceivedMessage decode_received(std::string_view payload, const Scene& scene) {
  Reader r(payload);
  ReceivedMessage m;
  m.sequence = r.get<std::uint64_t>();
  m.scene = get_received(r, scene);
  r.finish();
  if (m.scene.shapes.size() != scene.shapes.size() || m.scene.bodies.size() != scene.bodies.size())
    throw Malformed("a wrong number of shapes or bodies");
  return m;
}

AnswerMessage decode_answer(std::string_view payload) {
  Reader r(payload);
  AnswerMessage m;
  m.sequence = r.get<std::uint64_t>();
  m.query = r.get<std::uint32_t>();
  m.observation = get_observation(r);
  r.finish();
  // Only the harness can decide that a query was not asked.
  if (m.observation.outcome == Outcome::not_asked) throw Malformed("an unknown tag");
  return m;
}

}  // namespace touchstone::protocol
