// Which part of a campaign this process runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace touchstone::fuzz {

struct Shard {
  std::uint64_t index = 0, count = 1;  // 0 <= index < count
  std::string source;                  // who said so, for people
};

/// The value of an environment variable, empty when it is not set.
using Variable = std::function<std::optional<std::string>(const char* name)>;

/// `text` is "i/n"; empty: of a Slurm array (SLURM_ARRAY_TASK_ID, _COUNT, _MIN, _STEP) or of an indexed job
/// of Kubernetes (JOB_COMPLETION_INDEX, and JOB_COMPLETIONS, which the job's template must set); else the
/// whole. Throws InputError naming what is missing or out of range.
Shard which_shard(const std::string& text, const Variable& variable);

}  // namespace touchstone::fuzz
