#pragma once

#include <urdf_model/link.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "physics/description/link_tree.h"

namespace tera {

/// Where the meshes of a URDF are: relative to it; of `package://name/path`, as Gazebo's
/// `model://`, in the folder that `packages` gives, else `path`, with or without the package's
/// name, in the folders above the URDF.
struct UrdfMeshes {
  std::filesystem::path urdf;
  std::map<std::string, std::filesystem::path> packages;  ///< folders by the packages' names
  AbsentMeshes absent = AbsentMeshes::kFault;
  std::vector<std::string> left_out = {};  ///< what is not there, each once
};

Pose PoseOf(const urdf::Pose& pose);

/// Adds to `link` what the link of a URDF shows and collides with.
///
/// Model   boxes, cylinders, spheres and mesh files are visuals; the colour of a material is what
///         a screen shows, and goes to solids and to STL files, which have none of their own. A
///         mesh mirrored along one axis is one mirrored along all three and turned by half a turn.
///         In collisions each is the box around it, a mesh along the axes of its own frame.
/// Omits   textures.
void AddUrdfShapes(const urdf::Link& in, const PartPlace& place, UrdfMeshes* meshes, Link* link);

}  // namespace tera
