// Animals that give invalid or odd answers, or change the process that they live in.
#include <fenv.h>
#include <locale.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <thread>

#include "core/math/roundoff.h"
#include "tests/zoo/zoo.h"

namespace touchstone::zoo {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double up[3] = {0, 0, 1};

void all_numbers(ts_answer* a, double x) {
  a->has = TS_HAS_OVERLAP | TS_HAS_DISTANCE | TS_HAS_NORMAL | TS_HAS_DEPTH | TS_HAS_POINTS;
  a->distance = a->depth = x;
  for (double* v : {a->point_a, a->point_b, a->normal}) v[0] = v[1] = v[2] = x;
}

void detail(ts_answer* a, const char* text) { std::strcpy(a->detail, text); }

void flood_streams() {
  const std::string line(1000, 'x');
  for (int i = 0; i < 2000; ++i) {
    std::puts(line.c_str());
    std::fputs(line.c_str(), stderr);
  }
  std::fflush(stdout);
}

void start_threads(int n) {
  for (int i = 0; i < n; ++i) std::thread([] { sleep_for_ever(); }).detach();
}

void ring_every_millisecond() {
  signal(SIGALRM, [](int) {});
  const itimerval often{{0, 1000}, {0, 1000}};
  setitimer(ITIMER_REAL, &often, nullptr);
}

void flush_to_zero() {
#if defined(__SSE__)
  __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040U);
#endif
}

}  // namespace

#define ANIMAL(name, ...)                                                                       \
  Animal {                                                                                      \
    name, []([[maybe_unused]] ts_answer* a, [[maybe_unused]] const ts_sink* s) { __VA_ARGS__; } \
  }

const Animal answers[] = {
    ANIMAL("good", ),
    ANIMAL("outcome_77", a->outcome = 77),
    ANIMAL("outcome_minus_1", a->outcome = -1),
    ANIMAL("outcome_crashed", a->outcome = 5),
    ANIMAL("outcome_not_asked", a->outcome = 8),
    ANIMAL("contact_of_a_stranger", s->contact(s->ctx, 0, 99, up, 1)),
    ANIMAL("contact_of_a_negative_body", s->contact(s->ctx, -1, 1, up, 1)),
    ANIMAL("contact_with_itself", s->contact(s->ctx, 1, 1, up, 1)),
    ANIMAL("pair_of_strangers", s->pair(s->ctx, 0, 5000, 5001)),
    ANIMAL("pair_in_a_step_of_its_own", s->pair(s->ctx, 77, 0, 1)),
    ANIMAL("pair_in_step_minus_1", s->pair(s->ctx, -1, 0, 1)),
    ANIMAL("pair_of_the_largest_numbers", s->pair(s->ctx, 0x7fffffff, 0x7fffffff, -0x7fffffff)),
    ANIMAL("a_million_points", for (int i = 0; i < 1000000; ++i) s->point(s->ctx, up, i)),
    ANIMAL("nan_everywhere", all_numbers(a, nan_value)),
    ANIMAL("infinity_everywhere", all_numbers(a, infinity)),
    ANIMAL("minus_infinity_everywhere", all_numbers(a, -infinity)),
    ANIMAL("denormals_everywhere", all_numbers(a, 5e-324)),
    ANIMAL("largest_everywhere", all_numbers(a, 1.7e308)),
    ANIMAL("unknown_bits", a->has |= 0xffff0000U),
    ANIMAL("overlap_17", a->overlap = 17),
    ANIMAL("claims_nan", a->claimed_tolerance = nan_value),
    ANIMAL("claims_less_than_nothing", a->claimed_tolerance = -1),
    ANIMAL("claims_infinity", a->claimed_tolerance = infinity),
    ANIMAL("detail_without_end", std::memset(a->detail, 'd', sizeof a->detail)),
    ANIMAL("detail_in_latin1", detail(a,
                                      "Gr\xf6\xdf"
                                      "e")),
    ANIMAL("detail_of_controls", detail(a, "\x1b[31m\x07\r\n\x01")),
    ANIMAL("prints_megabytes", flood_streams()),
    ANIMAL("leaves_a_thread", start_threads(1)),
    ANIMAL("leaves_fifty_threads", start_threads(50)),
    ANIMAL("flushes_to_zero", flush_to_zero()),
    ANIMAL("rounds_up", fesetround(FE_UPWARD)),
    ANIMAL("reaps_all_children", signal(SIGCHLD, SIG_IGN)),
    ANIMAL("blocks_all_signals", sigset_t m; sigfillset(&m); sigprocmask(SIG_BLOCK, &m, nullptr)),
    ANIMAL("rings_every_millisecond", ring_every_millisecond()),
    ANIMAL("forgets_the_environment", clearenv()),
    ANIMAL("speaks_with_decimal_commas", setlocale(LC_ALL, "de_DE.UTF-8")),
    ANIMAL("makes_files_for_nobody", umask(0777)),
    ANIMAL("is_nice", if (nice(19) < 0) return ),
    ANIMAL("wants_core_files", const rlimit all{RLIM_INFINITY, RLIM_INFINITY}; setrlimit(RLIMIT_CORE, &all)),
    ANIMAL("closes_its_standard_streams", close(0); close(1); close(2)),
};
const std::size_t answer_count = std::size(answers);

}  // namespace touchstone::zoo
