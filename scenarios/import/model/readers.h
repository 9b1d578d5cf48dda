// The readers of robots and worlds, one a format. Each throws InputError "file:line: <element>: reason" for
// what is wrong, and passes what no scene can represent to ImportContext::refuse.
#pragma once

#include <filesystem>

#include "scenarios/import/import_context.h"
#include "scenarios/import/model/model.h"

namespace touchstone {

/// URDF: the specification of http://wiki.ros.org/urdf/XML, with capsules. The root link is fixed to the
/// world.
Model read_urdf(const std::filesystem::path& file, ImportContext& context);

/// SRDF of a model read from URDF: collisions that are disabled become filters, group states become states,
/// and a virtual joint that is not fixed holds the root link.
void add_srdf(Model& model, const std::filesystem::path& file, ImportContext& context);

/// MJCF: bodies, geoms, joints, defaults, keyframes and contact exclusions as MuJoCo's compiler reads them.
Model read_mjcf(const std::filesystem::path& file, ImportContext& context);

/// SDFormat 1.4 to 1.10: worlds and models, nested ones too.
Model read_sdf(const std::filesystem::path& file, ImportContext& context);

/// MoveIt's text form of a planning scene: objects that are fixed to the world.
Model read_planning_scene(const std::filesystem::path& file, ImportContext& context);

/// glTF with KHR_physics_rigid_bodies: nodes with a motion are bodies of their own, other colliders are fixed.
/// Without the extension, one link with one mesh.
Model read_gltf(const std::filesystem::path& file, ImportContext& context);

/// One link with one mesh.
Model read_mesh_model(const std::filesystem::path& file, ImportContext& context);

}  // namespace touchstone
