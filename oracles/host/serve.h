// Reads questions and writes answers until the harness closes its end.
#pragma once

#include <cstddef>

#include "oracles/abi/touchstone_engine.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::host {

/// Writes all of `bytes` to `fd`; ends the process if the other end is closed.
void write_all(int fd, const char* bytes, std::size_t n);

/// Returns at the end of the input. A scene with a shape that the engine is not sent (engine_card.h) is not
/// loaded.
void serve(const ts_plugin& plugin, ts_engine* engine, const EngineCard& card, int questions_fd,
           int answers_fd);

}  // namespace touchstone::host
