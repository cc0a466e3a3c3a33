#pragma once

#include <urdf_model/link.h>

#include <filesystem>

#include "physics/description/link_tree.h"

namespace tera {

Pose PoseOf(const urdf::Pose& pose);

/// Adds to `link` what the link of the URDF at `file` shows and collides with.
///
/// Model   boxes, cylinders, spheres and mesh files are visuals; the colour of a material is what
///         a screen shows, and goes to solids and to STL files, which have none of their own. A
///         mesh mirrored along one axis is one mirrored along all three and turned by half a turn.
///         In collisions each is the box around it, a mesh along the axes of its own frame.
/// Omits   textures.
void AddUrdfShapes(const urdf::Link& in, const std::filesystem::path& file, const PartPlace& place,
                   Link* link);

}  // namespace tera
