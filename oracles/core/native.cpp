#include <algorithm>

#include "oracles/core/core_engine.h"

namespace touchstone {
namespace {

constexpr std::string_view exact_boxes = "exact:";

}  // namespace

std::string native_name(std::string_view broad_phase, BroadBoxes boxes) {
  return std::string(boxes == BroadBoxes::exact ? exact_boxes : "") + std::string(broad_phase);
}

std::unique_ptr<NativeEngine> make_native_core(std::string_view name) {
  if (name == "core") return std::make_unique<CoreEngine>();
  if (name == "core-f32") return std::make_unique<CoreEngine>(Arithmetic::float32);
  if (name == "core-kept") return make_kept_engine();
  const auto others = core_alternatives();
  if (std::find(others.begin(), others.end(), name) != others.end()) return make_core_alternative(name);
  if (name.starts_with(exact_boxes))
    return make_broad_engine(name.substr(exact_boxes.size()), BroadBoxes::exact);
  return make_broad_engine(name, BroadBoxes::bodies);
}

}  // namespace touchstone
