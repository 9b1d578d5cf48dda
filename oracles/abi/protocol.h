// The messages between harness and worker, over two byte streams. A frame is a header of 16 bytes (magic,
// version, type, payload length, zero) and a payload; all numbers are little-endian, doubles as their bits.
// Every decoder throws Malformed on anything that is not exactly one message.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oracles/abi/bytes.h"
#include "oracles/abi/source_id.h"
#include "scenarios/value/observation.h"

namespace touchstone::protocol {

inline constexpr std::uint16_t version = 3;
/// A frame longer than this is malformed.
inline constexpr std::uint32_t max_payload_bytes = std::uint32_t{1} << 30;

enum class Type : std::uint16_t { hello = 1, question = 2, received = 3, answer = 4 };

struct Frame {
  Type type;
  std::string_view payload;  // into the FrameReader; valid until its next append()
};

/// Splits a byte stream into frames. Memory grows with the bytes received, never with an announced length.
class FrameReader {
 public:
  void append(const char* data, std::size_t n);
  /// The next complete frame, if there is one yet. Throws Malformed on a bad header.
  std::optional<Frame> next();

 private:
  std::string buffer_;
  std::size_t begin_ = 0;
};

/// Worker → harness, once: the plug-in's engines and the one that this worker serves, or an error.
struct Hello {
  std::vector<std::string> cards;  // JSON
  std::int32_t chosen = -1;        // index into cards; -1: cards only
  std::string error;               // not empty: why the plug-in cannot be used
  std::string sandbox{};           // for people: which parts of the sandbox are in force
  bool batches = false;            // answers several cases at once, so the first unanswered one need not be
                                   // the one that ended the worker
  std::string built_from = message_id();
  bool operator==(const Hello&) const = default;
};

/// Harness → worker. `sequence` is echoed; queries before `first_query` are not asked.
struct QuestionRef {
  std::uint64_t sequence;
  std::uint32_t first_query;
  const Scene& scene;
  std::span<const Query> queries;
  std::uint8_t fill = 0;  // content of memory that the engine has not written yet
  bool alone = false;     // not to be answered together with others
};
struct QuestionMessage {
  std::uint64_t sequence = 0;
  std::uint32_t first_query = 0;
  Scene scene;  // names and ids left out
  std::vector<Query> queries;
  std::uint8_t fill = 0;
  bool alone = false;
};

/// Worker → harness after loading, before the first query.
struct ReceivedMessage {
  std::uint64_t sequence = 0;
  ReceivedScene scene;
};

struct AnswerMessage {
  std::uint64_t sequence = 0;
  std::uint32_t query = 0;
  Observation observation;
};

// Each appends one whole frame to `out`.
void append(std::string& out, const Hello& m);
void append(std::string& out, const QuestionRef& m);
void append(std::string& out, const ReceivedMessage& m);
void append(std::string& out, const AnswerMessage& m);

Hello decode_hello(std::string_view payload);
QuestionMessage decode_question(std::string_view payload);
/// `scene`: the one that was sent; a message with a different number of shapes or bodies is malformed.
ReceivedMessage decode_received(std::string_view payload, const Scene& scene);
AnswerMessage decode_answer(std::string_view payload);

// Scenes, received scenes and observations as bytes: parts of messages, and of files of kept answers
// (fuzz/campaign/answers_file.h), so a change needs a new version of both.

/// Writes the scene without names. get_scene(put_scene(s)) has the same numbers, including faces and
/// dimensions of hulls, and the same script.
void put_scene(Writer& w, const Scene& scene);
Scene get_scene(Reader& r);

void put_received(Writer& w, const ReceivedScene& received);
/// A scene with more shapes or bodies than the given one is malformed.
ReceivedScene get_received(Reader& r, const Scene& sent);

/// All but Observation::slow and Observation::site.
void put_observation(Writer& w, const Observation& o);
Observation get_observation(Reader& r);

}  // namespace touchstone::protocol
