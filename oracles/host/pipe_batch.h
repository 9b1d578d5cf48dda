// A batch of pairs as a command behind a pipe gets it, and its answers (oracles/abi/pipe_protocol.md): a line
// of JSON, followed by arrays of little-endian numbers.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::host {

/// Throws NotFinite if a number is not finite.
std::string batch_message(const ts_batch& batch);

/// The answers' line, checked against the batch.
class BatchAnswers {
 public:
  /// Throws std::runtime_error or a JSON exception if the line has not the required form.
  BatchAnswers(const nlohmann::ordered_json& line, const ts_batch& batch);
  /// What follows the line.
  std::size_t bytes() const;
  /// Throws std::runtime_error if a number is not one that its field may have.
  void read(std::string_view bytes, ts_answer* answers, const ts_batch_sink& sink) const;

  struct PairNumbers;
  struct Field;

 private:
  std::size_t vertex_numbers() const;
  const ts_batch& batch_;
  std::vector<const Field*> fields_;
  std::size_t points_ = 0;
  bool has_vertices_ = false;
  std::vector<std::string> details_;
};

}  // namespace touchstone::host
