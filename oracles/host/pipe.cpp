#include "oracles/host/plugin.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "oracles/abi/pipe_scene.h"
#include "oracles/host/pipe_answer.h"
#include "oracles/host/pipe_batch.h"
#include "scenarios/value/observation.h"

namespace touchstone::host {
namespace {

using pipe::Json;
using pipe::NotFinite;

constexpr int protocol_version = 1;
constexpr std::size_t longest_line = std::size_t{1} << 28;

// Set once by load_pipe(); a process serves a single command.
std::string command_line, card_text;
bool gives_receipts = false, states_times = false;

/// The command and its three streams.
class Child {
 public:
  explicit Child(const std::string& command) {
    int to[2], from[2], errors[2];
    if (::pipe(to) != 0 || ::pipe(from) != 0 || ::pipe(errors) != 0)
      throw std::runtime_error("cannot create a pipe");
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("cannot be started");
    if (pid_ == 0) {
      dup2(to[0], 0);
      dup2(from[1], 1);
      dup2(errors[1], 2);
      for (int fd : {to[0], to[1], from[0], from[1], errors[0], errors[1]}) close(fd);
      execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    close(to[0]);
    close(from[1]);
    close(errors[1]);
    to_ = to[1];
    from_ = from[0];
    errors_ = errors[0];
    for (int fd : {to_, errors_}) fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK);
  }
  ~Child() {
    close(to_);
    close(from_);
    close(errors_);
    if (pid_ < 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Throws if there is unsolicited output, which would be taken for the answer to the next question.
  void require_silence() const {
    pollfd fd{from_, POLLIN, 0};
    const bool more = poll(&fd, 1, 0) > 0 && (fd.revents & POLLIN);
    if (more || !buffer_.empty())
      throw std::runtime_error(
          "the command wrote more than one line for a question, or a line without one: " +
          buffer_.substr(0, std::min(buffer_.find('\n'), quoted_bytes)));
  }
  void write_line(std::string line) {
    line.push_back('\n');
    write_all(line);
  }
  /// A message as it is.
  void write_all(std::string_view line) {
    require_silence();
    for (std::size_t done = 0; done < line.size();) {
      const ssize_t n = write(to_, line.data() + done, line.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0 && errno == EAGAIN)
        wait({to_, POLLOUT, 0});
      else if (n <= 0)
        throw std::runtime_error(how_it_ended());
      else
        done += static_cast<std::size_t>(n);
    }
  }
  std::string read_line() {
    for (std::size_t seen = 0;;) {
      const auto end = buffer_.find('\n', seen);
      if (end != std::string::npos) return take(end, 1);
      seen = buffer_.size();
      read_some();
      if (buffer_.size() > longest_line) throw std::runtime_error("the command wrote a line without an end");
    }
  }
  std::string read_bytes(std::size_t n) {
    while (buffer_.size() < n) read_some();
    return take(n, 0);
  }

 private:
  static constexpr std::size_t kept_bytes = 400, kept_lines = 4;
  // A command that has closed its output gets a second to end.
  static constexpr int end_tries = 100;
  static constexpr unsigned end_try_microseconds = 10000;

  /// The first n bytes; drops `more` after them.
  std::string take(std::size_t n, std::size_t more) {
    std::string bytes = buffer_.substr(0, n);
    buffer_.erase(0, n + more);
    return bytes;
  }
  void read_some() {
    char bytes[1 << 16];
    for (;;) {
      wait({from_, POLLIN, 0});
      const ssize_t n = read(from_, bytes, sizeof bytes);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) throw std::runtime_error(how_it_ended());
      buffer_.append(bytes, static_cast<std::size_t>(n));
      return;
    }
  }

  /// Waits until that stream is ready. Reads the command's standard error meanwhile: otherwise the command
  /// could block on it while we wait for the command.
  void wait(pollfd wanted) {
    for (;;) {
      pollfd fds[2] = {wanted, {errors_, POLLIN, 0}};
      if (poll(fds, errors_ < 0 ? 1 : 2, -1) < 0 && errno != EINTR) return;
      if (errors_ >= 0 && fds[1].revents != 0) take_errors();
      if (fds[0].revents != 0) return;
    }
  }

  void take_errors() {
    char bytes[1 << 12];
    for (;;) {
      const ssize_t n = errors_ < 0 ? 0 : read(errors_, bytes, sizeof bytes);
      if (n < 0 && errno == EINTR) continue;
      if (n == 0 && errors_ >= 0) {
        close(errors_);
        errors_ = -1;
      }
      if (n <= 0) return;
      error_text_.append(bytes, static_cast<std::size_t>(n));
      if (error_text_.size() > 4 * kept_bytes) error_text_.erase(0, error_text_.size() - kept_bytes);
    }
  }

  /// ": " and the last lines of its standard error, in order; empty if it wrote nothing there.
  std::string last_lines() {
    take_errors();
    std::vector<std::string> lines;
    for (std::size_t end = error_text_.size(); end > 0 && lines.size() < kept_lines;) {
      const auto before = error_text_.rfind('\n', end - 1);
      const std::size_t begin = before == std::string::npos ? 0 : before + 1;
      if (const std::string line = error_text_.substr(begin, end - begin);
          line.find_first_not_of(" \r\n") != line.npos)
        lines.push_back(line.substr(line.find_first_not_of(' ')));
      end = begin > 0 ? begin - 1 : 0;
    }
    std::string text;
    for (auto line = lines.rbegin(); line != lines.rend(); ++line)
      text += (text.empty() ? ": " : " | ") + *line;
    if (text.size() > kept_bytes) text = ": ..." + text.substr(text.size() - kept_bytes);
    return text;
  }

  // Called when the output has ended: usually the command has ended too.
  std::string how_it_ended() {
    int status = 0;
    for (int tries = 0; tries < end_tries && waitpid(pid_, &status, WNOHANG) == 0; ++tries)
      usleep(end_try_microseconds);
    if (kill(pid_, 0) == 0) return "the command closed its output without an answer" + last_lines();
    pid_ = -1;
    return end_of(status) + last_lines();
  }

  // The shell itself exits with 127 and 126.
  static std::string end_of(int status) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127) return "there is no such command";
    if (WIFEXITED(status) && WEXITSTATUS(status) == 126) return "the command is not executable";
    if (WIFEXITED(status))
      return "the command ended without an answer, exit code " + std::to_string(WEXITSTATUS(status));
    return "the command ended without an answer, by signal " + std::to_string(WTERMSIG(status));
  }

  pid_t pid_ = -1;
  int to_ = -1, from_ = -1, errors_ = -1;
  std::string buffer_, error_text_;
};

// A command that breaks the protocol counts as a crash with a reason: its later output cannot be trusted.
[[noreturn]] void abort_with(const char* why) {
  std::fprintf(stderr, "%s\n", why);
  std::fflush(stderr);
  std::abort();
}

Child& child(ts_engine* e) { return *reinterpret_cast<Child*>(e); }

const char* card(std::uint32_t) { return card_text.c_str(); }
ts_engine* create(std::uint32_t) {
  auto* c = new Child(command_line);
  c->read_line();  // its card again
  return reinterpret_cast<ts_engine*>(c);
}
void destroy(ts_engine* e) { delete &child(e); }
std::int32_t load(ts_engine* e, const ts_scene* scene, const ts_received* received, char* detail) {
  try {
    child(e).write_line(Json{{"scene", pipe::scene_of(*scene)}}.dump());
    if (!gives_receipts) return TS_ANSWERED;
    const Json receipt = parsed(child(e).read_line());
    std::snprintf(detail, 256, "%s", receipt.value("detail", "").c_str());
    if (receipt.contains("received")) pipe::read_receipt(receipt["received"], *scene, *received);
    return outcome_of(receipt.value("outcome", "answered"));
  } catch (const NotFinite&) {
    std::snprintf(detail, 256, "JSON cannot represent a number that is not finite");
    return TS_INVALID_INPUT;
  } catch (const Json::exception& why) {
    abort_with(("the command's receipt does not have the required form: " + std::string(why.what())).c_str());
  } catch (const std::exception& why) {
    abort_with(why.what());
  }
}
void unload(ts_engine*) {}

void ask(ts_engine* e, std::int32_t question, std::int32_t a, std::int32_t b, ts_answer* out,
         const ts_sink* sink) {
  Json j = {{"ask", std::string(question_names.at(static_cast<std::size_t>(question)))}};
  if (is_pair_question(static_cast<Question>(question))) {
    j["a"] = a;
    j["b"] = b;
  }
  try {
    child(e).write_line(j.dump());
    read_answer(parsed(child(e).read_line()), states_times, *out, *sink);
    child(e).require_silence();
  } catch (const Json::exception& why) {
    abort_with(("the command's answer does not have the required form: " + std::string(why.what())).c_str());
  } catch (const std::exception& why) {
    abort_with(why.what());
  }
}

void ask_many(ts_engine* e, const ts_batch* batch, ts_answer* answers, const ts_batch_sink* sink) {
  try {
    child(e).write_all(batch_message(*batch));
    const Json header = parsed(child(e).read_line());
    if (header.value("lines", false)) {
      const auto next_line = [&] { return child(e).read_line(); };
      read_answer_lines(header, *batch, states_times, next_line, answers, *sink);
      return child(e).require_silence();
    }
    const BatchAnswers form(header, *batch);
    form.read(child(e).read_bytes(form.bytes()), answers, *sink);
    child(e).require_silence();
    if (!states_times) return;
    const std::int64_t each = stated_ns(header) / static_cast<std::int64_t>(batch->count);
    for (std::size_t i = 0; i < batch->count; ++i) answers[i].ns = std::max<std::int64_t>(1, each);
  } catch (const Json::exception& why) {
    abort_with(("the command's answers do not have the required form: " + std::string(why.what())).c_str());
  } catch (const std::exception& why) {
    abort_with(why.what());
  }
}

}  // namespace

const ts_plugin& load_pipe(const std::string& command) {
  signal(SIGPIPE, SIG_IGN);
  command_line = command;
  Child first(command);
  Json j = parsed(first.read_line());
  if (!j.contains("touchstone_pipe"))
    throw std::runtime_error("its first line is not a card: \"touchstone_pipe\" is missing");
  if (j["touchstone_pipe"] != protocol_version)
    throw std::runtime_error("speaks version " + j["touchstone_pipe"].dump() +
                             " of the pipe protocol instead of 1");
  gives_receipts = j.value("receipts", false);
  states_times = j.value("states_ns", false);
  const bool takes_batches = j.value("batches", false);
  for (const char* of_the_pipe : {"touchstone_pipe", "receipts", "states_ns", "batches"})
    j.erase(of_the_pipe);
  if (!states_times) j["times_include_pipe"] = true;
  card_text = j.dump();
  static const ts_plugin table{
      TS_ABI_VERSION, 1, card, create, destroy, load, unload, ask, takes_batches ? ask_many : nullptr, {}};
  return table;
}

}  // namespace touchstone::host
