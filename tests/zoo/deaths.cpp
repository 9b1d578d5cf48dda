// Animals that end, hang, or write unexpected output.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "tests/zoo/zoo.h"

namespace touchstone::zoo {
namespace {

volatile std::uint64_t sink_value = 0;

int overflow_the_stack(int depth) {
  volatile char frame[4096];
  frame[depth % 4096] = static_cast<char>(depth);
  return depth < 0 ? 0 : overflow_the_stack(depth + 1) + frame[depth % 4096];
}

void throw_error() { throw std::runtime_error("through a wall"); }
void throw_through_noexcept() noexcept { throw_error(); }

void for_each_descriptor(void (*f)(int)) {
  for (int fd = 0; fd < 1024; ++fd) f(fd);
}

/// Writes to every pipe that this process can write to, including the protocol's.
void spray(const std::string& bytes) {
  for (int fd = 3; fd < 1024; ++fd) {
    struct stat s;
    const bool is_pipe = fstat(fd, &s) == 0 && S_ISFIFO(s.st_mode);
    if (is_pipe && (fcntl(fd, F_GETFL) & O_ACCMODE) != O_RDONLY)
      if (write(fd, bytes.data(), bytes.size()) < 0) return;
  }
}

std::string frame(char type, std::uint32_t length, std::size_t payload) {
  std::string f("TSP1\x01\x00", 6);
  f += type;
  f += '\0';
  f.append(reinterpret_cast<const char*>(&length), 4);
  f.append(4 + payload, '\0');
  return f;
}

void loop_in_handler(int) { loop_for_ever(); }

void double_free() {
  char* volatile p = static_cast<char*>(std::malloc(100));
  std::free(p);
  std::free(p);
}

void die_of(int signal_number) {
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

}  // namespace

void loop_for_ever() {
  for (;;) sink_value = sink_value + 1;
}
void sleep_for_ever() {
  for (;;) sleep(3600);
}

#define ANIMAL(name, ...)                                 \
  Animal {                                                \
    name, [](ts_answer*, const ts_sink*) { __VA_ARGS__; } \
  }

const Animal deaths[] = {
    ANIMAL("aborts", std::fputs("zoo: assertion failed\n", stderr); std::abort()),
    ANIMAL("aborts_in_latin1", std::fputs("zoo: Gr\xf6\xdf"
                                          "e ist falsch\n",
                                          stderr);
           std::abort()),
    ANIMAL("aborts_with_control_characters", std::fputs("zoo:\x1b[2J\x07 gone\n", stderr); std::abort()),
    ANIMAL("aborts_after_a_megabyte", std::fputs((std::string(1 << 20, 'x') + "\nthe end\n").c_str(), stderr);
           std::abort()),
    ANIMAL("writes_to_null", *static_cast<volatile int*>(nullptr) = 1),
    ANIMAL("dies_of_bus", die_of(SIGBUS)),
    ANIMAL("dies_of_fpe", die_of(SIGFPE)),
    ANIMAL("traps", __builtin_trap()),
    ANIMAL("dies_of_kill", die_of(SIGKILL)),
    ANIMAL("dies_of_term", die_of(SIGTERM)),
    ANIMAL("dies_of_pipe", die_of(SIGPIPE)),
    ANIMAL("dies_of_alarm", die_of(SIGALRM)),
    ANIMAL("dies_of_user_signal", die_of(SIGUSR1)),
    ANIMAL("dies_of_hangup", die_of(SIGHUP)),
    ANIMAL("exits_0", std::exit(0)),
    ANIMAL("exits_3", std::exit(3)),
    ANIMAL("exits_quickly", std::quick_exit(4)),
    ANIMAL("exits_at_once", _exit(5)),
    ANIMAL("throws", throw std::runtime_error("no such luck")),
    ANIMAL("throws_bad_alloc", throw std::bad_alloc()),
    ANIMAL("throws_int", throw 7),
    ANIMAL("throws_text", throw "text"),
    ANIMAL("throws_latin1", throw std::runtime_error("Gr\xf6\xdf"
                                                     "e")),
    ANIMAL("throws_through_noexcept", throw_through_noexcept()),
    ANIMAL("terminates", std::terminate()),
    ANIMAL("overflows_the_stack", sink_value = static_cast<unsigned>(overflow_the_stack(1))),
    ANIMAL("frees_twice", double_free()),
    ANIMAL("loops", loop_for_ever()),
    ANIMAL("loops_in_signal_handler", signal(SIGSEGV, loop_in_handler); raise(SIGSEGV)),
    ANIMAL("loops_deaf", for (int s = 1; s < 32; ++s) signal(s, SIG_IGN); loop_for_ever()),
    ANIMAL("sleeps", sleep_for_ever()),
    ANIMAL("pauses", pause()),
    ANIMAL("reads_its_input_for_ever", for (char c = 0;;) if (read(0, &c, 1) <= 0) pause()),
    ANIMAL("stops_itself", raise(SIGSTOP)),
    ANIMAL("stops_its_parent", kill(getppid(), SIGSTOP); sleep_for_ever()),
    ANIMAL("kills_its_parent", kill(getppid(), SIGKILL); sleep_for_ever()),
    ANIMAL("kills_its_group", kill(0, SIGKILL)),
    ANIMAL("kills_everybody", if (std::getenv("TOUCHSTONE_ZOO_FENCED")) kill(-1, SIGKILL); _exit(6)),
    ANIMAL("closes_all", for_each_descriptor([](int fd) { close(fd); }); sleep_for_ever()),
    ANIMAL("closes_all_and_goes_on", for_each_descriptor([](int fd) { close(fd); })),
    ANIMAL("sprays_rubbish", spray("this is no answer")),
    ANIMAL("sprays_zeros", spray(std::string(100, '\0'))),
    ANIMAL("sprays_a_hello", spray(frame(1, 12, 12))),
    ANIMAL("sprays_an_answer", spray(frame(4, 12, 12))),
    ANIMAL("sprays_an_unknown_type", spray(frame(9, 0, 0))),
    ANIMAL("crashes_in_a_thread", std::thread([] { std::abort(); }).join()),
    ANIMAL("frees_the_host's_memory", std::free(stdout)),
};
const std::size_t death_count = std::size(deaths);

}  // namespace touchstone::zoo
