// Scenes on their way through a pipe (oracles/abi/pipe_protocol.md): out as JSON, back as they were received.
#pragma once

#include <nlohmann/json.hpp>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::host {

using Json = nlohmann::ordered_json;

/// A number that JSON cannot hold.
struct NotFinite {};

/// Throws NotFinite.
Json scene_of(const ts_scene& s);

/// Throws Json::exception when it is not of the form agreed, std::runtime_error when it names what is not
/// there.
void read_receipt(const Json& j, const ts_scene& scene, const ts_received& received);

}  // namespace touchstone::host
