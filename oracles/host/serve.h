// Reads questions and writes answers until the harness closes its end.
#pragma once

#include <cstddef>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::host {

/// Writes all of `bytes` to `fd`; ends the process if the other end is closed.
void write_all(int fd, const char* bytes, std::size_t n);

/// Returns at the end of the input.
void serve(const ts_plugin& plugin, ts_engine* engine, int questions_fd, int answers_fd);

}  // namespace touchstone::host
