// Which part of a campaign this process runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace touchstone::fuzz {

struct Shard {
  std::uint64_t index = 0, count = 1;  // 0 <= index < count
  std::string source;                  // option or variable that chose it, for messages
};

/// Returns the value of an environment variable, or nothing when it is not set.
using Variable = std::function<std::optional<std::string>(const char* name)>;

/// `text` is "i/n". If it is empty, the shard is that of a Slurm array task (SLURM_ARRAY_TASK_ID, _COUNT,
/// _MIN, _STEP) or of an indexed Kubernetes job (JOB_COMPLETION_INDEX, and JOB_COMPLETIONS, which the job's
/// template must set); without either, the whole campaign. Throws InputError naming what is missing or out of
/// range.
Shard which_shard(const std::string& text, const Variable& variable);

}  // namespace touchstone::fuzz
