#include "oracles/host/serve.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "oracles/abi/measure.h"
#include "oracles/abi/plugin_scene.h"
#include "oracles/abi/protocol.h"
#include "oracles/host/diagnosis.h"
#include "oracles/host/pair_batch.h"

namespace touchstone::host {
namespace {

using Clock = std::chrono::steady_clock;

int query_steps(const Scene& scene, const Query& q) {
  if (q.question == Question::swept_candidates || scene.script.empty()) return 1;
  return static_cast<int>(std::count_if(scene.script.begin(), scene.script.end(),
                                        [](const Step& s) { return s.op == Step::Op::query; }));
}

/// A ts_batch has no margin.
bool is_batched(Question q) { return q <= Question::time_of_impact; }

struct LoadResult {
  bool asked = false;  // the engine's load() was called
  ReceivedScene received;
  std::optional<Observation> refusal;  // the answer to every query if the engine refused the scene
};

class Server {
 public:
  Server(const ts_plugin& plugin, ts_engine* engine, const EngineCard& card, int answers_fd)
      : plugin_(plugin), engine_(engine), card_(card), answers_fd_(answers_fd) {}

  bool takes_batches() const { return plugin_.ask_many && measure_ns_ == 0; }

  /// Runs of scenes that can be asked about together are, the others one after the other.
  void answer(std::span<const protocol::QuestionMessage> messages) {
    while (!messages.empty()) {
      const auto end =
          std::find_if_not(messages.begin(), messages.end(), [&](const auto& m) { return can_share(m); });
      const auto n = static_cast<std::size_t>(end - messages.begin());
      if (n > 1 && answer_together(messages.first(n))) {
        messages = messages.subspan(n);
        continue;
      }
      const std::size_t alone = std::max<std::size_t>(n, 1);
      for (const protocol::QuestionMessage& m : messages.first(alone)) answer(m);
      messages = messages.subspan(alone);
    }
  }

  void answer(const protocol::QuestionMessage& m) {
    fill_ = m.fill;
    fill_new_memory(fill_);
    const bool broad = std::any_of(m.queries.begin(), m.queries.end(),
                                   [](const Query& q) { return is_script_question(q.question); });
    const PluginScene scene(m.scene, broad);
    LoadResult loaded = load(m.scene, scene.view());
    // Each message is written immediately, so that a crash loses only the running query.
    send(protocol::ReceivedMessage{m.sequence, std::move(loaded.received)});
    flush();
    for (std::uint32_t i = m.first_query; i < m.queries.size(); ++i) {
      send(protocol::AnswerMessage{m.sequence, i,
                                   loaded.refusal ? *loaded.refusal : ask(m.scene, m.queries[i])});
      flush();
    }
    if (loaded.asked) unload();
  }

 private:
  // A pair of bodies and questions about it. What a batch reports as received is that of its pairs: all of
  // the scene.
  bool can_share(const protocol::QuestionMessage& m) const {
    if (!takes_batches() || m.alone || m.fill != 0) return false;
    if (m.scene.bodies.size() != 2 || refusal_of(m.scene)) return false;
    const auto uses = [&](std::size_t shape) {
      return std::any_of(m.scene.bodies.begin(), m.scene.bodies.end(),
                         [&](const Body& b) { return static_cast<std::size_t>(b.shape) == shape; });
    };
    for (std::size_t s = 0; s < m.scene.shapes.size(); ++s)
      if (!uses(s)) return false;
    return m.first_query < m.queries.size() &&
           std::all_of(m.queries.begin(), m.queries.end(), [](const Query& q) {
             return is_batched(q.question) && std::min(q.a, q.b) == 0 && std::max(q.a, q.b) == 1;
           });
  }

  // Asks each question about all its pairs at once. False, with nothing sent, if an answer is to be had one
  // by one only.
  bool answer_together(std::span<const protocol::QuestionMessage> messages) {
    std::vector<std::vector<Observation>> answers(messages.size());
    std::deque<ReceivedCollector> received;
    for (std::size_t i = 0; i < messages.size(); ++i) {
      received.emplace_back(messages[i].scene);
      answers[i].resize(messages[i].queries.size());
    }
    fill_ = 0;
    fill_new_memory(fill_);
    for (int k = 0; is_batched(static_cast<Question>(k)); ++k)
      if (!ask_together(static_cast<Question>(k), messages, received, answers)) return false;
    for (const ReceivedCollector& r : received)
      if (r.rejected() > 0) return false;
    for (std::size_t i = 0; i < messages.size(); ++i) {
      send(protocol::ReceivedMessage{messages[i].sequence, received[i].take()});
      for (std::uint32_t q = messages[i].first_query; q < answers[i].size(); ++q)
        send(protocol::AnswerMessage{messages[i].sequence, q, std::move(answers[i][q])});
    }
    flush();
    return true;
  }

  bool ask_together(Question question, std::span<const protocol::QuestionMessage> messages,
                    std::deque<ReceivedCollector>& received, std::vector<std::vector<Observation>>& answers) {
    PairBatch batch(question);
    std::vector<Observation*> places;
    for (std::size_t i = 0; i < messages.size(); ++i)
      for (std::uint32_t q = messages[i].first_query; q < messages[i].queries.size(); ++q)
        if (messages[i].queries[q].question == question) {
          batch.add(messages[i].scene, messages[i].queries[q], received[i]);
          places.push_back(&answers[i][q]);
        }
    if (batch.empty()) return true;
    auto given = batch.ask(plugin_, engine_);
    if (given.empty()) return false;
    for (std::size_t k = 0; k < places.size(); ++k) *places[k] = std::move(given[k]);
    return true;
  }

  std::optional<Observation> refusal_of(const Scene& scene) const {
    for (const Shape& s : scene.shapes)
      if (!is_sent(card_, kind_of(s)))
        return no_answer(
            Outcome::unsupported,
            (card_.shapes.empty() ? "more_shapes of its card does not list " : "its card does not list ") +
                std::string(type_name(s)));
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
      const std::int64_t took = std::chrono::duration_cast<std::chrono::nanoseconds>(stop - start).count();
      const std::int64_t stated = answer.answer().ns;
      o.elapsed_ns = stated > 0 ? std::min(stated, took) : took;
      if (measure_ns_ > 0 && o.outcome == Outcome::answered && is_pair_question(q.question))
        o.elapsed_ns = ask_again(q, took, o.elapsed_ns);
      return o;
    } catch (const std::exception& e) {
      o = no_answer(Outcome::threw, e.what());
    } catch (...) {
      o = no_answer(Outcome::threw, "something other than a std::exception");
    }
    o.elapsed_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
    return o;
  }

  // Repeats the query with a sink that ignores its input, so that only the engine is timed; the least time
  // that the engine states, if it states any. Failures are ignored, since the first answer succeeded.
  std::int64_t ask_again(const Query& q, std::int64_t took, std::int64_t stated) {
    const ts_sink sink{nullptr, [](void*, const double*, double) {},
                       [](void*, std::int32_t, std::int32_t, std::int32_t) {},
                       [](void*, std::int32_t, std::int32_t, const double*, double) {},
                       [](void*, const double*, double, std::uint64_t) {}};
    const ts_answer blank = blank_answer();
    std::int64_t least = stated;
    try {
      const std::int64_t measured = least_mean_ns(took, measure_ns_, [&] {
        ts_answer answer = blank;
        plugin_.ask(engine_, static_cast<std::int32_t>(q.question), q.a, q.b, &answer, &sink);
        if (answer.ns > 0) least = std::min(least, answer.ns);
      });
      return std::min(least, measured);
    } catch (...) {
      return least;
    }
  }

  template <class Message>
  void send(const Message& m) {
    protocol::append(out_, m);
  }
  void flush() {
    write_all(answers_fd_, out_.data(), out_.size());
    out_.clear();
  }

  const ts_plugin& plugin_;
  ts_engine* engine_;
  const EngineCard& card_;
  int answers_fd_;
  std::uint8_t fill_ = 0;
  std::string out_;
  const std::int64_t measure_ns_ = measure_ns();
};

/// Scenes asked about at once.
constexpr std::size_t most_together = 4096;

bool has_input(int fd) {
  pollfd p{fd, POLLIN, 0};
  return poll(&p, 1, 0) > 0;
}

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
  std::vector<protocol::QuestionMessage> together;
  char buffer[1 << 16];
  for (;;) {
    while (const auto frame = frames.next()) {
      if (!server.takes_batches()) {
        server.answer(protocol::decode_question(frame->payload));
        continue;
      }
      together.push_back(protocol::decode_question(frame->payload));
      if (together.size() < most_together) continue;
      server.answer(together);
      together.clear();
    }
    if (!together.empty() && !has_input(questions_fd)) {
      server.answer(together);
      together.clear();
    }
    const ssize_t n = read(questions_fd, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    frames.append(buffer, static_cast<std::size_t>(n));
  }
}

}  // namespace touchstone::host
