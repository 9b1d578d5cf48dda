// touchstone-host PLUGIN.so [ENGINE | --cards] [SCRATCH BYTES]: started by the harness, not by users. If
// SCRATCH and BYTES are given, it confines itself to that directory and that much memory (sandbox.h). It
// loads a plug-in, reports its engines on standard output (oracles/abi/protocol.h) and then, unless only the
// cards were requested, forks workers on request (oracles/abi/fork_server_protocol.h). Each worker creates
// the engine and answers questions.
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#include "oracles/abi/native_engine.h"
#include "oracles/abi/protocol.h"
#include "oracles/host/diagnosis.h"
#include "oracles/host/fork_server.h"
#include "oracles/host/plugin.h"
#include "oracles/host/sandbox.h"
#include "oracles/host/serve.h"
#include "scenarios/codec/value_codec.h"

#ifdef TS_ADDRESS_SANITIZER
// A sanitized worker still dies of the original signal, like an ordinary one, and does not report leaks of
// third-party libraries.
extern "C" const char* __asan_default_options() {
  return "handle_segv=0:handle_sigbus=0:handle_abort=0:handle_sigfpe=0:handle_sigill=0:detect_leaks=0";
}
#endif

namespace {

using namespace touchstone;

struct Streams {
  int requests, answers;
};

// Engines may print. Standard output is redirected to standard error, standard input becomes empty, and the
// protocol moves to descriptors that no printf reaches.
Streams protect_streams() {
  const int requests = host::duplicate_high(0), answers = host::duplicate_high(1);
  const int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (requests < 0 || answers < 0 || null < 0 || dup2(null, 0) < 0 || dup2(2, 1) < 0) {
    std::perror("touchstone-host: no descriptor available (ulimit -n)");
    _exit(3);
  }
  close(null);
  return {requests, answers};
}

struct Loaded {
  protocol::Hello hello;
  const ts_plugin* plugin = nullptr;
  MakeNativeEngine* native = nullptr;  // instead of a plug-in
};

Loaded load(const std::string& file, const std::string& engine) {
  Loaded l;
  try {
    // In a native library, each worker chooses its engine.
    l.native = host::load_native(file);
    if (l.native) return l;
    l.plugin = &host::load_plugin(file);
    l.hello.cards = host::cards_of(*l.plugin);
    if (engine != "--cards") l.hello.chosen = host::choose_engine(l.hello.cards, engine);
  } catch (const std::exception& e) {
    l.hello.error = e.what();
    l.hello.chosen = -1;
  }
  return l;
}

void say(int fd, const protocol::Hello& hello) {
  std::string out;
  protocol::append(out, hello);
  host::write_all(fd, out.data(), out.size());
}

/// Runs a worker of a library of native engines.
void work_natively(protocol::Hello hello, MakeNativeEngine& make, const host::WorkerStreams& streams) {
  const std::unique_ptr<NativeEngine> engine(make(streams.engine.c_str()));
  if (engine) {
    hello.cards = {to_json_text(engine->card())};
    hello.chosen = 0;
  } else {
    hello.error = "offers no engine '" + streams.engine + "'";
  }
  say(streams.answers, hello);
  if (engine) host::serve_native(*engine, streams);
}

/// Runs a forked worker.
void work(const Loaded& l, host::WorkerStreams streams) {
  host::report_crashes();
  protocol::Hello hello = l.hello;
  if (l.native) return work_natively(hello, *l.native, streams);
  ts_engine* engine = nullptr;
  try {
    hello.batches = l.plugin->ask_many != nullptr;
    engine = l.plugin->create(static_cast<std::uint32_t>(hello.chosen));
    if (!engine) hello.error = "created no engine";
  } catch (const std::exception& e) {
    hello.error = std::string("could not create its engine: ") + e.what();
  }
  say(streams.answers, hello);
  if (engine)
    host::serve(*l.plugin, engine, card_from_json(hello.cards[static_cast<std::size_t>(hello.chosen)]),
                streams.questions, streams.answers);
}

struct Arguments {
  std::string plugin, engine;
  host::SandboxWish wish;
};

Arguments read_arguments(int argc, char** argv) {
  Arguments a{argv[1], argc > 2 ? argv[2] : "", {}};
  if (argc == 5) {
    a.wish.scratch = argv[3];
    a.wish.memory_bytes = std::strtoull(argv[4], nullptr, 10);
  }
  a.wish.is_command = a.plugin.starts_with(host::pipe_prefix);
  return a;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 5 || argc == 4) {
    std::fprintf(stderr, "usage: touchstone-host PLUGIN.so [ENGINE | --cards] [SCRATCH BYTES]\n");
    return 2;
  }
  // A plug-in must not see the files that the harness has open. Older kernels lack the call.
  syscall(SYS_close_range, 3U, ~0U, 0U);
  // If the harness died between spawn and this point, the first read of a request sees the end of the stream.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const Arguments a = read_arguments(argc, argv);
  host::Sandbox sandbox{"none", {}};
  if (!a.wish.scratch.empty()) sandbox = host::enter_sandbox(a.wish);
  prctl(PR_SET_DUMPABLE, 0);  // expected crashes leave no core files
  const Streams streams = protect_streams();
  host::announce_pid(streams.requests);
  Loaded l = load(a.plugin, a.engine);
  l.hello.sandbox = sandbox.description;
  say(streams.answers, l.hello);
  close(streams.answers);
  if (l.hello.chosen < 0 && !l.native) _exit(l.hello.error.empty() ? 0 : 2);
  host::prepare_crash_reports();
  const host::ForkServer fork_server{streams.requests, sandbox.apart, a.wish.scratch, a.wish.is_command,
                                     l.native != nullptr};
  host::run_fork_server(fork_server, [&](host::WorkerStreams worker) { work(l, worker); });
}
