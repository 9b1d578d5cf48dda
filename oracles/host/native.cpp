#include "oracles/host/serve.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <exception>

#include "oracles/abi/protocol.h"
#include "oracles/host/diagnosis.h"
#include "oracles/host/plugin.h"

namespace touchstone::host {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_bytes_buffered = std::size_t{1} << 15;
constexpr auto most_time_buffered = std::chrono::milliseconds(5);

class NativeServer {
 public:
  NativeServer(NativeEngine& engine, const WorkerStreams& streams) : engine_(engine), streams_(streams) {}

  void answer(protocol::QuestionMessage m) {
    fill_heap(m.fill);
    Case c;
    c.scene = std::move(m.scene);
    c.queries.assign(m.queries.begin() + static_cast<std::ptrdiff_t>(m.first_query), m.queries.end());
    std::uint32_t next = m.first_query;
    const auto tell = [&](Observation o) {
      send(protocol::AnswerMessage{m.sequence, next++, std::move(o)});
      if (m.fill != 0) fill_free_stack(m.fill);
    };
    send(protocol::ReceivedMessage{m.sequence, engine_.received(c.scene)});
    if (m.fill != 0) fill_free_stack(m.fill);
    try {
      engine_.answer(c, tell);
    } catch (const std::exception& e) {
      while (next < m.queries.size()) tell(no_answer(Outcome::threw, e.what()));
    }
  }

  void flush() {
    if (!buffer_.empty()) write_all(streams_.answers, buffer_.data(), buffer_.size());
    buffer_.clear();
    written_ = Clock::now();
  }

 private:
  /// Leaves memory as malloc returns it, which is fastest, until a different fill byte is first requested.
  void fill_heap(std::uint8_t byte) {
    filled_ |= byte != 0;
    if (filled_) fill_new_memory(byte);
  }
  template <class Message>
  void send(const Message& m) {
    protocol::append(buffer_, m);
    if (!streams_.buffers_answers || buffer_.size() > most_bytes_buffered ||
        Clock::now() - written_ > most_time_buffered)
      flush();
  }

  NativeEngine& engine_;
  WorkerStreams streams_;
  std::string buffer_;
  bool filled_ = false;
  Clock::time_point written_ = Clock::now();
};

}  // namespace

MakeNativeEngine* load_native(const std::string& file) {
  if (file.starts_with(pipe_prefix)) return nullptr;
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) return nullptr;  // load_plugin() says why
  const auto make = reinterpret_cast<MakeNativeEngine*>(dlsym(library, make_native_engine_symbol));
  if (make) require_same_sources(library);
  return make;
}

void serve_native(NativeEngine& engine, const WorkerStreams& streams) {
  NativeServer server(engine, streams);
  protocol::FrameReader frames;
  char buffer[1 << 16];
  for (;;) {
    while (const auto frame = frames.next()) server.answer(protocol::decode_question(frame->payload));
    server.flush();
    const ssize_t n = read(streams.questions, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    frames.append(buffer, static_cast<std::size_t>(n));
  }
}

}  // namespace touchstone::host
