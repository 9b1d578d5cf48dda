#include "oracles/client/remote_engine.h"

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <optional>
#include <utility>

#include "core/base/input_error.h"
#include "oracles/abi/last_words.h"
#include "oracles/client/patience.h"
#include "oracles/client/process_usage.h"
#include "oracles/client/watchdog.h"
#include "oracles/client/worker_session.h"
#include "scenarios/codec/value_codec.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

constexpr std::size_t send_ahead_bytes = std::size_t{1} << 18;  // of questions encoded ahead of the worker
constexpr int max_failed_starts = 3;
// Fill byte for run_again(): read as a double it gives about 2e6, as an index or a pointer it is far out of
// range, so reads of uninitialised memory show. Ordinary runs fill with zeros, the most benign content.
constexpr std::uint8_t other_fill = 0x41;

/// The position of the next observation.
struct Cursor {
  std::size_t item = 0;
  std::uint32_t query = 0;
  bool loaded = false;  // the worker has loaded the scene of `item`
  bool operator==(const Cursor&) const = default;
};

// Tells whether a file was written again. The same for everything that is no file, as a command behind a
// pipe.
using FileStamp = std::pair<std::filesystem::file_time_type, std::uintmax_t>;
FileStamp stamp_of(const std::filesystem::path& file) {
  std::error_code none;
  return {std::filesystem::last_write_time(file, none), std::filesystem::file_size(file, none)};
}

Observation failure(Outcome outcome, const std::string& detail, std::string site = "") {
  return no_answer(outcome, printable(detail, "\n\t"), std::move(site));
}

}  // namespace

class RemoteEngine::Impl {
 public:
  explicit Impl(RemoteSpec spec)
      : spec_(std::move(spec)), stamp_(stamp_of(spec_.plugin)), watchdog_(spec_.limits) {
    if (spec_.native) {
      card_ = *spec_.native;
      return;
    }
    start();
    const auto chosen = static_cast<std::size_t>(fork_server_->hello.chosen);
    try {
      card_ = card_from_json(fork_server_->hello.cards[chosen]);
    } catch (const InputError& e) {
      throw e.within(spec_.plugin.string() + ": card");
    }
    if (!spec_.shown_name.empty()) card_.name = spec_.shown_name;
    if (!spec_.shown_version.empty()) card_.version = spec_.shown_version;
  }

  std::vector<CaseObservations> run(std::span<const Case> cases, std::uint8_t fill) try {
    fill_ = fill;
    prepare(cases);
    while (at_.item < cases_.size() && patience_.left()) {
      if (is_ready())
        converse();
      else if (at_.item < cases_.size())
        charge_failed_start();
    }
    leave_unasked();
    if (lost_) results_[lost_->at.item].answers[lost_->at.query] = std::move(lost_->what);
    return std::move(results_);
  } catch (const Stopped&) {
    session_.reset();  // the worker is in the middle of a query
    throw;
  }

  void resume() {
    if (!patience_.left()) session_.reset();
    patience_ = {};
  }

  EngineCard card_;
  int restarts_ = 0;
  Patience patience_;
  std::string sandbox() const { return fork_server_ ? fork_server_->hello.sandbox : ""; }
  int pid() const { return session_ ? session_->process->pid() : -1; }

 private:
  void prepare(std::span<const Case> cases) {
    cases_ = cases;
    results_.assign(cases.size(), {});
    for (std::size_t i = 0; i < cases.size(); ++i) {
      results_[i].received.bodies.resize(cases[i].scene.bodies.size());
      results_[i].received.shapes.resize(cases[i].scene.shapes.size());
      results_[i].answers.resize(cases[i].queries.size());
    }
    at_ = {};
    skip_done();
    if (std::exchange(one_by_one_, false) && spec_.native) session_.reset();
    lost_.reset();
    // Memory that earlier batches left behind must not be charged to a query of this one.
    // (Native engines do not need this: questions that end their worker are repeated in a new one.)
    if (session_ && !spec_.native &&
        usage_of(session_->process->pid()).resident_bytes > spec_.limits.resident_bytes / 2)
      session_.reset();
    continue_from_cursor();
  }

  /// Makes sure that there is a worker, restarting it if necessary.
  bool is_ready() {
    if (session_ && !has_ended()) return true;
    if (session_) replace_worker();
    for (int tries = 1;; ++tries) try {
        start();
        return true;
      } catch (const ProgramMismatch&) {
        throw;  // no answer of the engine
      } catch (const InputError& e) {
        failed_start_ = std::string("the worker cannot be restarted: ") + e.what();
        if (tries == max_failed_starts) return false;
      }
  }

  /// A request to the fork server costs more than a native engine's answers. A native engine's worker has no
  /// children that would hold the pipe open, so a closed pipe is enough.
  bool has_ended() {
    if (!spec_.native) return session_->process->has_ended();
    pollfd fd{session_->process->answers_fd(), POLLIN, 0};
    return poll(&fd, 1, 0) > 0 && (fd.revents & POLLHUP);
  }

  /// Starts a new worker, and also a new fork server if there is none or it has died.
  void start() {
    if (!fork_server_ || fork_server_->process->has_ended()) {
      fork_server_.reset();
      if (stamp_of(spec_.plugin) != stamp_)
        throw ProgramMismatch(spec_.plugin.string(), "was changed while it was in use: start the run again");
      fork_server_ = spec_.native ? share_native_fork_server(spec_.host, spec_.plugin, spec_.limits)
                                  : std::make_shared<const WorkerSession>(start_fork_server(
                                        spec_.host, spec_.plugin, spec_.engine, spec_.limits));
    }
    const WorkerProcess::Native native{spec_.engine, !one_by_one_};
    session_.emplace(
        start_worker(*fork_server_, spec_.plugin, spec_.limits, spec_.native ? &native : nullptr));
    continue_from_cursor();
  }

  /// Forgets what the previous worker was sent: questions continue from the cursor.
  void continue_from_cursor() {
    at_.loaded = false;
    next_to_send_ = at_.item;
    first_sequence_ = sequence_;
    outgoing_.clear();
    outgoing_begin_ = 0;
    if (session_) watchdog_.progress(*session_->process);
  }

  void replace_worker() {
    session_.reset();
    ++restarts_;
  }

  void skip_done() {
    while (at_.item < cases_.size() && at_.query == cases_[at_.item].queries.size())
      at_ = {at_.item + 1, 0, false};
  }

  /// Sends questions and reads answers until everything is answered or the worker has to be replaced.
  void converse() {
    while (at_.item < cases_.size()) {
      send_questions();
      const ReadResult r = read_available(session_->process->answers_fd(), session_->frames);
      try {
        if (r == ReadResult::some && take_frames()) watchdog_.progress(*session_->process);
      } catch (const protocol::Malformed& e) {
        const std::string why = std::string("rubbish instead of an answer: ") + e.what();
        if (!retries_one_by_one(failure(Outcome::crashed, why))) charge(Outcome::crashed, why);
        return;
      }
      if (r == ReadResult::closed) return charge_death();
      if (at_.item == cases_.size()) return;
      if (watchdog_.is_due()) {
        throw_if_stopped(spec_.limits);
        if (const auto verdict = watchdog_.check(*session_->process, phase())) return charge_late(*verdict);
        // Usually the closed answer stream tells; but a child of the worker may hold it open.
        if (r == ReadResult::nothing_yet && session_->process->has_ended() && drained())
          return charge_death();
      }
      if (r == ReadResult::nothing_yet) wait();
    }
  }

  Watchdog::Phase phase() const {
    // A native engine uses the scene as it is, without a loading phase.
    // A batch is loaded and answered at once.
    const bool batch = session_->hello.batches && !one_by_one_;
    return at_.loaded || spec_.native || batch ? Watchdog::Phase::answering : Watchdog::Phase::loading_scene;
  }

  /// True when nothing is left to read from a process that has ended.
  bool drained() {
    pollfd fd{session_->process->answers_fd(), POLLIN, 0};
    return poll(&fd, 1, 0) <= 0 || !(fd.revents & POLLIN);
  }

  void wait() {
    WorkerProcess& w = *session_->process;
    const short want_out = outgoing_begin_ < outgoing_.size() ? POLLOUT : 0;
    pollfd fds[3] = {
        {w.answers_fd(), POLLIN, 0}, {w.errors_fd(), POLLIN, 0}, {w.questions_fd(), want_out, 0}};
    poll(fds, 3, static_cast<int>(Watchdog::tick.count()));
    if (fds[1].revents != 0 && w.errors_fd() >= 0) w.drain_errors();
  }

  void send_questions() {
    while (next_to_send_ < cases_.size() && outgoing_.size() - outgoing_begin_ < send_ahead_bytes) {
      const Case& c = cases_[next_to_send_];
      const std::uint32_t first = next_to_send_ == at_.item ? at_.query : 0;
      if (first < c.queries.size()) {
        protocol::append(outgoing_, protocol::QuestionRef{sequence_of(next_to_send_), first, c.scene,
                                                          c.queries, fill_, one_by_one_});
        sequence_ = sequence_of(next_to_send_) + 1;
      }
      ++next_to_send_;
    }
    while (outgoing_begin_ < outgoing_.size()) {
      const ssize_t n = send(session_->process->questions_fd(), outgoing_.data() + outgoing_begin_,
                             outgoing_.size() - outgoing_begin_, MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;  // full, or the worker is gone, which the other stream will show
      outgoing_begin_ += static_cast<std::size_t>(n);
    }
    if (outgoing_begin_ == outgoing_.size()) {
      outgoing_.clear();
      outgoing_begin_ = 0;
    }
  }

  /// Unique over the lifetime of this object, so that an answer to an earlier question is never taken for a
  /// new one.
  std::uint64_t sequence_of(std::size_t item) const { return first_sequence_ + item; }

  /// True if at least one message from the worker arrived.
  bool take_frames() {
    bool any = false;
    while (const auto frame = session_->frames.next()) {
      any = true;
      if (at_.item == cases_.size()) throw protocol::Malformed("an unsolicited answer");
      if (frame->type == protocol::Type::received)
        take_received(frame->payload);
      else if (frame->type == protocol::Type::answer)
        take_answer(frame->payload);
      else
        throw protocol::Malformed("an unexpected type of message");
    }
    return any;
  }

  void take_received(std::string_view payload) {
    auto m = protocol::decode_received(payload, cases_[at_.item].scene);
    if (m.sequence != sequence_of(at_.item) || at_.loaded) throw protocol::Malformed("an unexpected scene");
    results_[at_.item].received = std::move(m.scene);
    at_.loaded = true;
  }

  void take_answer(std::string_view payload) {
    auto m = protocol::decode_answer(payload);
    if (m.sequence != sequence_of(at_.item) || m.query != at_.query || !at_.loaded)
      throw protocol::Malformed("an answer out of order");
    if (m.observation.outcome == Outcome::threw) m.observation.site = site_of_exception(m.observation.detail);
    m.observation.slow = watchdog_.was_slow(*session_->process, m.observation.elapsed_ns);
    results_[at_.item].answers[at_.query++] = std::move(m.observation);
    patience_.note_answer();
    skip_done();
  }

  void charge_late(const Watchdog::Verdict& v) {
    if (retries_one_by_one(failure(v.outcome, v.why))) return;
    if (v.outcome == Outcome::timed_out) patience_.note_time_out(v.blocked);
    charge(v.outcome, v.why);
  }

  void charge_death() {
    // A process may close its answer stream and live on.
    const bool by_itself = session_->process->ends_within(death_wait_seconds);
    const LastWords last = session_->process->end();
    if (retries_one_by_one(failure(Outcome::crashed, last.detail, last.site))) return;
    if (by_itself)
      charge(Outcome::crashed, last.detail, last.site);
    else
      charge(Outcome::crashed, "closed its answer stream");
  }

  /// Charges the running query; while a scene is being loaded, all remaining queries of its case.
  void charge(Outcome outcome, const std::string& why, const std::string& site = "") {
    auto& answers = results_[at_.item].answers;
    if (at_.loaded) {
      answers[at_.query] = failure(outcome, why, site);
      answers[at_.query++].elapsed_ns = watchdog_.since_progress_ns();
    } else {
      const std::string detail = outcome == Outcome::crashed ? why + " while loading the scene" : why;
      while (at_.query < answers.size()) answers[at_.query++] = failure(outcome, detail, site);
    }
    skip_done();
    replace_worker();
  }

  /// A native engine's worker buffers its answers, and others may answer several cases at once; the question
  /// that ended the worker is then found by repeating the unanswered ones one by one. If the crash does not
  /// recur, the first of them is charged. A time-out that does not recur is not charged.
  bool retries_one_by_one(Observation what) {
    lost_.reset();
    if (!(spec_.native || session_->hello.batches) || one_by_one_) return false;
    what.detail += "; it did not recur when asked again";
    if (what.outcome == Outcome::crashed) lost_ = Lost{at_, std::move(what)};
    one_by_one_ = true;
    replace_worker();
    return true;
  }

  void charge_failed_start() {
    results_[at_.item].answers[at_.query++] = failure(Outcome::crashed, failed_start_);
    skip_done();
    patience_.end("set aside: " + failed_start_);
  }

  void leave_unasked() {
    for (; at_.item < cases_.size(); at_ = {at_.item + 1, 0, false})
      for (; at_.query < results_[at_.item].answers.size(); ++at_.query)
        results_[at_.item].answers[at_.query] = failure(Outcome::not_asked, patience_.why());
  }

  RemoteSpec spec_;
  const FileStamp stamp_;  // of the plug-in, when its first worker was started
  Watchdog watchdog_;
  std::shared_ptr<const WorkerSession> fork_server_;
  std::optional<WorkerSession> session_;  // ends before its fork server
  std::span<const Case> cases_;
  std::vector<CaseObservations> results_;
  Cursor at_;
  std::size_t next_to_send_ = 0;
  std::uint8_t fill_ = 0;
  std::uint64_t sequence_ = 0, first_sequence_ = 0;
  std::string outgoing_;
  std::size_t outgoing_begin_ = 0;
  std::string failed_start_;
  struct Lost {
    Cursor at;
    Observation what;
  };
  std::optional<Lost> lost_;
  bool one_by_one_ = false;  // until the end of this run()
};

RemoteEngine::RemoteEngine(RemoteSpec spec) : impl_(std::make_unique<Impl>(std::move(spec))) {}
RemoteEngine::~RemoteEngine() = default;
const EngineCard& RemoteEngine::card() const { return impl_->card_; }
std::vector<CaseObservations> RemoteEngine::run(std::span<const Case> cases) { return impl_->run(cases, 0); }
std::vector<CaseObservations> RemoteEngine::run_again(std::span<const Case> cases) {
  return impl_->run(cases, other_fill);
}
std::string RemoteEngine::set_aside() const { return impl_->patience_.why(); }
void RemoteEngine::resume() { impl_->resume(); }
void RemoteEngine::suspend(const std::string& why) { impl_->patience_.end(why); }
std::string RemoteEngine::sandbox() const { return impl_->sandbox(); }
int RemoteEngine::restarts() const { return impl_->restarts_; }
int RemoteEngine::worker_pid() const { return impl_->pid(); }

std::vector<EngineCard> list_plugin_engines(const std::filesystem::path& host,
                                            const std::filesystem::path& plugin) {
  const WorkerSession s = start_fork_server(host, plugin, "--cards", WorkerLimits{});
  std::vector<EngineCard> cards;
  for (std::size_t i = 0; i < s.hello.cards.size(); ++i) try {
      cards.push_back(card_from_json(s.hello.cards[i]));
    } catch (const InputError& e) {
      throw e.within(plugin.string() + ": card " + std::to_string(i));
    }
  return cards;
}

}  // namespace touchstone
