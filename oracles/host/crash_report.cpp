#include "oracles/host/diagnosis.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <signal.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "oracles/abi/last_words.h"

namespace touchstone::host {
namespace {

constexpr std::array fatal_signals{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
constexpr std::size_t most_frames = 48, most_printed = 8;
constexpr unsigned patience_seconds = 10;  // then give up: the crashed thread may hold a lock that we need
// Addresses below this are in the null page: the signal came from calling a null pointer.
constexpr std::uintptr_t first_page_end = 4096;

alignas(16) std::array<char, 1 << 16> signal_stack;  // separate, since the crash may be a stack overflow
volatile sig_atomic_t dying_of = 0;

void die(int) {
  signal(dying_of, SIG_DFL);
  raise(dying_of);
}

// The instruction at which the signal arrived. After a call through a null pointer, the caller is found only
// on the stack or in the link register.
void* interrupted_at([[maybe_unused]] const ucontext_t& u) {
#if defined(__x86_64__)
  const auto at = static_cast<std::uintptr_t>(u.uc_mcontext.gregs[REG_RIP]);
  if (at >= first_page_end) return reinterpret_cast<void*>(at);
  return *reinterpret_cast<void* const*>(u.uc_mcontext.gregs[REG_RSP]);
#elif defined(__aarch64__)
  const std::uintptr_t at = u.uc_mcontext.pc >= first_page_end ? u.uc_mcontext.pc : u.uc_mcontext.regs[30];
  return reinterpret_cast<void*>(at);
#else
  return nullptr;
#endif
}

class Line {
 public:
  Line() {
    add("\n");
    add(frames_prefix);
  }
  void add(const char* s) {
    const std::size_t n = std::min(strlen(s), text_.size() - 1 - used_);
    std::memcpy(text_.data() + used_, s, n);
    used_ += n;
  }
  void add_hex(std::uintptr_t x) {
    char digits[24];
    std::snprintf(digits, sizeof digits, "%#lx", static_cast<unsigned long>(x));
    add(digits);
  }
  void print() {
    text_[used_++] = '\n';
    if (write(2, text_.data(), used_) < 0) return;
  }

 private:
  std::array<char, last_words_bytes / 2> text_;
  std::size_t used_ = 0;
};

const char* file_name(const char* path) {
  const char* const slash = std::strrchr(path, '/');
  return slash ? slash + 1 : path;
}

// System libraries only abort, throw or copy on behalf of their callers: the fault is not there.
bool is_of_the_system(const char* module) {
  return std::strncmp(module, "libc.so", 7) == 0 || std::strncmp(module, "libstdc++.so", 12) == 0 ||
         std::strncmp(module, "libgcc_s.so", 11) == 0 || std::strncmp(module, "ld-linux", 8) == 0;
}

/// Prints "module+0x12 _ZN3fcl4nameEv+0x3 | ...", from the innermost frame outside the system libraries up to
/// the host.
void print_frames(void* const* frames, std::size_t count) {
  Line line;
  std::size_t printed = 0;
  for (std::size_t i = 0; i < count && printed < most_printed; ++i) {
    Dl_info where;
    const auto at = reinterpret_cast<std::uintptr_t>(frames[i]);
    // A return address may already belong to the next function.
    if (at == 0 || dladdr(reinterpret_cast<void*>(i == 0 ? at : at - 1), &where) == 0) continue;
    const char* const module = file_name(where.dli_fname);
    if (printed == 0 && is_of_the_system(module)) continue;
    if (std::strcmp(module, host_program_name) == 0) break;
    line.add(printed++ ? " | " : " ");
    line.add(module);
    line.add("+");
    line.add_hex(at - reinterpret_cast<std::uintptr_t>(where.dli_fbase));
    if (!where.dli_sname) continue;
    line.add(" ");
    line.add(where.dli_sname);
    line.add("+");
    line.add_hex(at - reinterpret_cast<std::uintptr_t>(where.dli_saddr));
  }
  if (printed > 0) line.print();
}

void on_fatal_signal(int number, siginfo_t*, void* context) {
  dying_of = number;
  signal(SIGALRM, die);
  alarm(patience_seconds);
  std::array<void*, most_frames + 1> frames;
  frames[0] = interrupted_at(*static_cast<const ucontext_t*>(context));
  const int seen = backtrace(frames.data() + 1, static_cast<int>(most_frames));
  void** const end = frames.data() + 1 + std::max(seen, 0);
  // The frames before the interrupted one belong to this handler.
  void** const at = std::find(frames.data() + 1, end, frames[0]);
  if (at != end)
    print_frames(at, static_cast<std::size_t>(end - at));
  else
    print_frames(frames.data(), 1);
  die(number);
}

}  // namespace

void prepare_crash_reports() {
  std::array<void*, 4> frames;
  backtrace(frames.data(), static_cast<int>(frames.size()));
}

void report_crashes() {
  stack_t stack{};
  stack.ss_sp = signal_stack.data();
  stack.ss_size = signal_stack.size();
  if (sigaltstack(&stack, nullptr) != 0) return;
  struct sigaction action {};
  action.sa_sigaction = on_fatal_signal;
  // A fault in the handler itself kills the process.
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int s : fatal_signals) sigaction(s, &action, nullptr);
}

}  // namespace touchstone::host
