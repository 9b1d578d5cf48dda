#include "cli/chosen_engines.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/engine_catalog.h"
#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "oracles/core/core_engine.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

std::string hash_of(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) return "";
  Hasher h;
  constexpr std::uintmax_t largest_program = std::uintmax_t{1} << 30;
  for (const auto& file : files) {
    const std::string program = read_file(file, largest_program);
    h.bytes(program.data(), program.size());
  }
  return fmt::format("{:016x}", h.value());
}

BroadBoxes boxes_at(BroadLevel level) {
  return level == BroadLevel::boxes ? BroadBoxes::exact : BroadBoxes::bodies;
}

}  // namespace

WorkerLimits scaled_limits(WorkerLimits limits, double times) {
  limits.query_cpu_seconds *= times;
  limits.load_cpu_seconds *= times;
  limits.wall_seconds *= times;
  return limits;
}

fuzz::Subject broad_subject(const std::string& name, const WorkerLimits& limits, bool sweeps) {
  const auto phases = core_broad_phases();
  if (std::find(phases.begin(), phases.end(), name) != phases.end())
    return {name,
            "",
            true,
            [name, limits](BroadLevel level) { return make_core_broad_phase(name, boxes_at(level), limits); },
            limits.query_cpu_seconds,
            [name, limits](BroadLevel level, double times) {
              return make_core_broad_phase(name, boxes_at(level), scaled_limits(limits, times));
            }};
  if (!is_foreign(name) && name != "all" && name.find(',') == std::string::npos && !is_catalogued(name)) {
    std::vector<std::string> known = catalogued_names();
    known.insert(known.begin(), phases.begin(), phases.end());
    const std::string near = did_you_mean(name, known);
    throw InputError("--subject " + name,
                     "unknown" + (near.empty() ? "; `touchstone certify --list` lists the subjects" : near));
  }
  if (engine_names(name).size() != 1 || name == "all")
    throw InputError("--subject " + name, "names more than one engine");
  fuzz::Subject s{
      name,
      hash_of(engine_files(name)),
      sweeps || name == "core",
      [name, limits](BroadLevel) { return make_engine(name, limits); },
      limits.query_cpu_seconds,
      [name, limits](BroadLevel, double times) { return make_engine(name, scaled_limits(limits, times)); }};
  s.make(BroadLevel::boxes);  // reports a broken subject before the first question
  return s;
}

}  // namespace touchstone::cli
