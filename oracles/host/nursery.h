// The host process after loading its plug-in: forks workers on request and reaps them.
#pragma once

#include <functional>

namespace touchstone::host {

struct WorkerStreams {
  int questions, answers;
};

/// Serves requests (oracles/api/nursery_protocol.h) until the harness closes its end; never returns. `work`
/// runs in each forked worker, whose standard streams have been protected.
[[noreturn]] void run_nursery(int control_fd, const std::function<void(WorkerStreams)>& work);

}  // namespace touchstone::host
