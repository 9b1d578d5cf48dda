#include "fuzz/campaign/shard.h"

#include <charconv>

#include "core/base/input_error.h"

namespace touchstone::fuzz {
namespace {

std::uint64_t number(const std::string& place, const std::string& text) {
  std::uint64_t v = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty())
    throw InputError(place, "'" + text + "' is not a number");
  return v;
}

Shard checked(const std::string& place, std::uint64_t index, std::uint64_t count) {
  if (count == 0 || index >= count)
    throw InputError(place, "shard " + std::to_string(index) + " of " + std::to_string(count) +
                                ": expected i/n with 0 <= i < n");
  return {index, count, place};
}

std::uint64_t number_or(const Variable& variable, const char* name, std::uint64_t otherwise) {
  const auto text = variable(name);
  return text ? number(name, *text) : otherwise;
}

std::uint64_t required(const Variable& variable, const char* name, const char* beside) {
  const auto text = variable(name);
  if (!text)
    throw InputError(name, std::string("is not set, although ") + beside + " is: how many shards are there?");
  return number(name, *text);
}

}  // namespace

Shard which_shard(const std::string& text, const Variable& variable) {
  if (!text.empty()) {
    const std::string place = "--shard " + text;
    const auto slash = text.find('/');
    if (slash == std::string::npos) throw InputError(place, "expected i/n with 0 <= i < n");
    return checked(place, number(place, text.substr(0, slash)), number(place, text.substr(slash + 1)));
  }
  if (const auto id = variable("SLURM_ARRAY_TASK_ID")) {
    const std::uint64_t count = required(variable, "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_ID");
    const std::uint64_t first = number_or(variable, "SLURM_ARRAY_TASK_MIN", 0),
                        step = number_or(variable, "SLURM_ARRAY_TASK_STEP", 1),
                        task = number("SLURM_ARRAY_TASK_ID", *id);
    if (step == 0 || task < first || (task - first) % step != 0)
      throw InputError("SLURM_ARRAY_TASK_ID", "is not a task of the array that _MIN and _STEP describe");
    return checked("SLURM_ARRAY_TASK_ID", (task - first) / step, count);
  }
  if (const auto index = variable("JOB_COMPLETION_INDEX"))
    return checked("JOB_COMPLETION_INDEX", number("JOB_COMPLETION_INDEX", *index),
                   required(variable, "JOB_COMPLETIONS", "JOB_COMPLETION_INDEX"));
  return {};
}

}  // namespace touchstone::fuzz
