// Scenes and received scenes as bytes; used only by protocol.cpp.
#pragma once

#include "oracles/abi/bytes.h"
#include "scenarios/value/observation.h"

namespace touchstone::protocol {

/// Writes the scene without names. get_scene(put_scene(s)) has the same numbers, including faces and
/// dimensions of hulls, and the same script.
void put_scene(Writer& w, const Scene& scene);
Scene get_scene(Reader& r);

void put_received(Writer& w, const ReceivedScene& received);
ReceivedScene get_received(Reader& r, const Scene& sent);

}  // namespace touchstone::protocol
