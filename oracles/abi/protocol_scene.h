// Scenes, received scenes and observations as bytes: parts of messages, and of files of kept answers
// (fuzz/campaign/answers_file.h), so a change needs a new version of both.
#pragma once

#include "oracles/abi/bytes.h"
#include "scenarios/value/observation.h"

namespace touchstone::protocol {

/// Writes the scene without names. get_scene(put_scene(s)) has the same numbers, including faces and
/// dimensions of hulls, and the same script.
void put_scene(Writer& w, const Scene& scene);
Scene get_scene(Reader& r);

void put_received(Writer& w, const ReceivedScene& received);
/// A scene with more shapes or bodies than the given one is malformed.
ReceivedScene get_received(Reader& r, const Scene& sent);

/// All but Observation::slow and Observation::site.
void put_observation(Writer& w, const Observation& o);
Observation get_observation(Reader& r);

}  // namespace touchstone::protocol
