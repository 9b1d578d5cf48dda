#include "oracles/host/serve.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <optional>
#include <string>

#include "oracles/abi/measure.h"
#include "oracles/abi/plugin_scene.h"
#include "oracles/abi/protocol.h"
#include "oracles/host/diagnosis.h"

namespace touchstone::host {
namespace {

using Clock = std::chrono::steady_clock;

int query_steps(const Scene& scene, const Query& q) {
  if (q.question == Question::swept_candidates || scene.script.empty()) return 1;
  return static_cast<int>(std::count_if(scene.script.begin(), scene.script.end(),
                                        [](const Step& s) { return s.op == Step::Op::query; }));
}

struct LoadResult {
  bool asked = false;  // the engine's load() was called
  ReceivedScene received;
  std::optional<Observation> refusal;  // the answer to every query if the engine refused the scene
};

class Server {
 public:
  Server(const ts_plugin& plugin, ts_engine* engine, const EngineCard& card, int answers_fd)
      : plugin_(plugin), engine_(engine), card_(card), answers_fd_(answers_fd) {}

  void answer(const protocol::QuestionMessage& m) {
    fill_ = m.fill;
    fill_new_memory(fill_);
    const PluginScene scene(m.scene);
    LoadResult loaded = load(m.scene, scene.view());
    send(protocol::ReceivedMessage{m.sequence, std::move(loaded.received)});
    for (std::uint32_t i = m.first_query; i < m.queries.size(); ++i)
      send(protocol::AnswerMessage{m.sequence, i,
                                   loaded.refusal ? *loaded.refusal : ask(m.scene, m.queries[i])});
    if (loaded.asked) unload();
  }

 private:
  std::optional<Observation> refusal_of(const Scene& scene) const {
    for (const Shape& s : scene.shapes)
      if (!is_sent(card_, kind_of(s)))
        return no_answer(Outcome::unsupported,
                         "more_shapes of its card does not list " + std::string(type_name(s)));
    return std::nullopt;
  }

  LoadResult load(const Scene& scene, const ts_scene& view) {
    ReceivedCollector received(scene);
    const ts_received callbacks = received.callbacks();
    char detail[256] = {};
    LoadResult result;
    result.refusal = refusal_of(scene);
    result.asked = !result.refusal;
    if (result.asked) try {
        fill_free_stack(fill_);
        const std::int32_t outcome = plugin_.load(engine_, &view, &callbacks, detail);
        const std::string why(detail, strnlen(detail, sizeof detail));
        if (outcome < TS_ANSWERED || outcome > TS_THREW)
          result.refusal =
              no_answer(Outcome::invalid_answer, "load() returned an outcome that does not exist");
        else if (outcome != TS_ANSWERED)
          result.refusal = no_answer(static_cast<Outcome>(outcome), why);
      } catch (const std::exception& e) {
        result.refusal = no_answer(Outcome::threw, std::string(e.what()) + " while loading the scene");
      } catch (...) {
        result.refusal =
            no_answer(Outcome::threw, "something other than a std::exception, while loading the scene");
      }
    if (received.rejected() > 0 && !result.refusal)
      result.refusal = no_answer(Outcome::invalid_answer,
                                 "reported shapes or bodies as received that the scene does not have");
    result.received = received.take();
    return result;
  }

  void unload() {
    // An engine that throws here has already answered; its next load will show whether it still works.
    try {
      plugin_.unload(engine_);
    } catch (...) {
    }
  }

  Observation ask(const Scene& scene, const Query& q) {
    const int bodies = static_cast<int>(scene.bodies.size());
    if (is_pair_question(q.question) && (q.a < 0 || q.b < 0 || q.a >= bodies || q.b >= bodies || q.a == q.b))
      return no_answer(Outcome::invalid_input, "the query does not name a pair of bodies of the scene");
    AnswerCollector answer(bodies, query_steps(scene, q));
    const ts_sink sink = answer.callbacks();
    Observation o;
    fill_free_stack(fill_);
    const auto start = Clock::now();
    try {
      plugin_.ask(engine_, static_cast<std::int32_t>(q.question), q.a, q.b, &answer.answer(), &sink);
      const auto stop = Clock::now();
      o = answer.take(q.question);
      o.elapsed_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(stop - start).count();
      if (measure_ns_ > 0 && o.outcome == Outcome::answered && is_pair_question(q.question))
        o.elapsed_ns = ask_again(q, o.elapsed_ns);
      return o;
    } catch (const std::exception& e) {
      o = no_answer(Outcome::threw, e.what());
    } catch (...) {
      o = no_answer(Outcome::threw, "something other than a std::exception");
    }
    o.elapsed_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
    return o;
  }

  // Repeats the query with a sink that ignores its input, so that only the engine is timed. Failures are
  // ignored, since the first answer succeeded.
  std::int64_t ask_again(const Query& q, std::int64_t first) {
    const ts_sink sink{nullptr, [](void*, const double*, double) {},
                       [](void*, std::int32_t, std::int32_t, std::int32_t) {},
                       [](void*, std::int32_t, std::int32_t, const double*, double) {}};
    const ts_answer blank = AnswerCollector(0, 0).answer();
    try {
      return least_mean_ns(first, measure_ns_, [&] {
        ts_answer answer = blank;
        plugin_.ask(engine_, static_cast<std::int32_t>(q.question), q.a, q.b, &answer, &sink);
      });
    } catch (...) {
      return first;
    }
  }

  // Each message is written immediately, so that a crash loses only the running query.
  template <class Message>
  void send(const Message& m) {
    out_.clear();
    protocol::append(out_, m);
    write_all(answers_fd_, out_.data(), out_.size());
  }

  const ts_plugin& plugin_;
  ts_engine* engine_;
  const EngineCard& card_;
  int answers_fd_;
  std::uint8_t fill_ = 0;
  std::string out_;
  const std::int64_t measure_ns_ = measure_ns();
};

}  // namespace

void write_all(int fd, const char* bytes, std::size_t n) {
  while (n > 0) {
    const ssize_t written = write(fd, bytes, n);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(0);
    bytes += written;
    n -= static_cast<std::size_t>(written);
  }
}

void serve(const ts_plugin& plugin, ts_engine* engine, const EngineCard& card, int questions_fd,
           int answers_fd) {
  Server server(plugin, engine, card, answers_fd);
  protocol::FrameReader frames;
  char buffer[1 << 16];
  for (;;) {
    while (const auto frame = frames.next()) server.answer(protocol::decode_question(frame->payload));
    const ssize_t n = read(questions_fd, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    frames.append(buffer, static_cast<std::size_t>(n));
  }
}

}  // namespace touchstone::host
