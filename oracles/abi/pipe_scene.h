// JSON conversion for the pipe protocol (oracles/abi/pipe_protocol.md): writes scenes, reads receipts.
#pragma once

#include <nlohmann/json.hpp>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::pipe {

using Json = nlohmann::ordered_json;

/// A number that JSON cannot represent.
struct NotFinite {};

/// Throws NotFinite.
Json scene_of(const ts_scene& s);

/// Throws Json::exception if the receipt does not have the required form, std::runtime_error if it refers to
/// something that does not exist.
void read_receipt(const Json& j, const ts_scene& scene, const ts_received& received);

}  // namespace touchstone::pipe
