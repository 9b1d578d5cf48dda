// Shared by the animals of the zoo.
#pragma once

#include <cstddef>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::zoo {

using Act = void (*)(ts_answer*, const ts_sink*);
struct Animal {
  const char* name;
  Act act;
};

/// Animals that end, hang, or write unexpected output.
extern const Animal deaths[];
extern const std::size_t death_count;
/// Animals that give invalid or odd answers.
extern const Animal answers[];
extern const std::size_t answer_count;
/// Animals that reach outside: files, network, processes, memory.
extern const Animal reaches[];
extern const std::size_t reach_count;

void loop_for_ever();
void sleep_for_ever();
void eat_memory();
/// Starts a process that leaves its session and its parent, and sleeps.
void leave_daemon();
/// The name of every process that may be left behind: $TOUCHSTONE_ZOO_MARK.
void take_mark();
/// A path in the directory that must not change: $TOUCHSTONE_ZOO_VICTIM.
const char* victim(const char* name);

}  // namespace touchstone::zoo
