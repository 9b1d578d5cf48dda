#include "cli/stop_signals.h"

#include <csignal>

namespace touchstone::cli {
namespace {

void on_signal(int) { interrupted = true; }

}  // namespace

std::atomic<bool> interrupted{false};

void catch_stop_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

}  // namespace touchstone::cli
