// An answer of a command behind a pipe, as a line of JSON (oracles/abi/pipe_protocol.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::host {

inline constexpr std::size_t quoted_bytes = 80;  // of a command's output in a message

/// Throws std::runtime_error if the line is not an object.
nlohmann::ordered_json parsed(const std::string& line);

/// Throws std::runtime_error for an unknown name.
std::int32_t outcome_of(const std::string& name);

/// The time that a command whose card promises it states with each answer. Throws std::runtime_error or a
/// JSON exception if there is none.
std::int64_t stated_ns(const nlohmann::ordered_json& answer);

/// Throws std::runtime_error or a JSON exception if the answer has not the required form.
void read_answer(const nlohmann::ordered_json& j, bool states_times, ts_answer& out, const ts_sink& sink);

/// The answers to a batch as lines, one a pair, each with what was received. Throws as above.
void read_answer_lines(const nlohmann::ordered_json& header, const ts_batch& batch, bool states_times,
                       const std::function<std::string()>& next_line, ts_answer* answers,
                       const ts_batch_sink& sink);

}  // namespace touchstone::host
